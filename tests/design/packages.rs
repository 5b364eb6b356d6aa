//! Packages for Bambu Lab's printers: they hold the program that lies beside them, and are read back like it.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::coupon::{CouponGroup, StripGrid};
use stargrip_cam::pipeline::{
    self, Built, MadeCoupons, Sources, align, feed_check, no_requested_programs, prove_feed_check, read_back,
};
use stargrip_cam::resume::{ResumeAt, resume};
use stargrip_cam::spec::digest::md5;
use stargrip_cam::spec::{self, Code, Machine};
use stargrip_cam::units::{Length, Speed, Temperature};
use stargrip_cam::verify::{Finding, OutputFiles};

use crate::support::zip::{Part, archive, parts};
use crate::support::{files_of, read, replace, reseal};

const PACKAGE: &str = "star-1-seal.gcode.3mf";
const PROGRAM: &str = "Metadata/plate_1.gcode";
const CHECKSUM: &str = "Metadata/plate_1.gcode.md5";
const SETTINGS: &str = "Metadata/model_settings.config";

/// A star that fits a printer, for `profile`.
fn text(profile: &str) -> String {
    format!(
        "schema = 1\nname = \"packed\"\n[star]\npoints = 5\ninner_radius = \"26 mm\"\ntube_width = \"16 mm\"\n\
         tip_angle = \"30 deg\"\n[seal]\nspeed = \"10 mm/s\"\n[machine]\nprofile = {profile:?}\n"
    )
}

/// A build with programs alone.
fn built() -> Built {
    let toml = text("bambu");
    let machine = spec::builtin_machine("bambu").expect("built in");
    let request = KindRequest::exactly(&[Kind::SealGcode, Kind::Seal3mf]);
    pipeline::build(
        &read(&toml),
        &Machine::builtin("bambu").expect("built in"),
        Sources { spec: &toml, machine },
        &request,
    )
    .unwrap_or_else(|refusals| panic!("{refusals}"))
}

/// The content of the file `name`.
fn content<'a>(files: &'a OutputFiles<'_>, name: &str) -> &'a [u8] {
    files.get(name).unwrap_or_else(|| panic!("no {name}"))
}

/// The findings where the parts of the package are changed, and manifest and checksums of the archive agree.
fn findings_with(build: &Built, change: impl Fn(&mut Vec<Part>)) -> Vec<Finding> {
    let mut files = files_of(build);
    let mut list = parts(content(&files, PACKAGE));
    change(&mut list);
    replace(&mut files, PACKAGE, archive(&list));
    reseal(&mut files);
    read_back(&files).findings
}

/// The content of the part `name`.
fn part<'a>(list: &'a mut [Part], name: &str) -> &'a mut Vec<u8> {
    &mut list.iter_mut().find(|(part, _)| part == name).expect("a part").1
}

/// Replaces `old` in the text of a part.
fn edit(list: &mut [Part], name: &str, old: &str, new: &str) {
    let bytes = part(list, name);
    let text = String::from_utf8(bytes.clone()).expect("text");
    assert!(text.contains(old), "{name}: {old}");
    *bytes = text.replacen(old, new, 1).into_bytes();
}

#[test]
fn a_package_holds_the_program_that_lies_beside_it() {
    let build = built();
    let files = files_of(&build);
    assert_eq!(read_back(&files).findings, []);
    let mut list = parts(content(&files, PACKAGE));
    assert!(part(&mut list, PROGRAM) == content(&files, "star-1-seal.gcode"));
    assert_eq!(archive(&list), content(&files, PACKAGE), "no other bytes than those of the format");
}

/// A change of the parts of a package.
type Change<'c> = &'c dyn Fn(&mut Vec<Part>);

/// There is no second truth: a package is judged by the program in it, whose checksums may all be right.
#[test]
fn a_changed_program_in_a_package_is_found_by_the_judges_of_programs() {
    let build = built();
    for (old, new, code) in [(" F600\n", " F700\n", "wrong-feed"), ("M109 S200", "M109 S250", "stray-heat")] {
        let findings = findings_with(&build, |list| {
            edit(list, PROGRAM, old, new);
            let checksum = md5(&part(list, PROGRAM)[..]);
            *part(list, CHECKSUM) = checksum.into_bytes();
        });
        let of_package = |finding: &Finding| finding.file == PACKAGE && finding.code == code;
        assert!(findings.iter().any(of_package), "{code}: {findings:?}");
    }
}

#[test]
fn a_package_whose_parts_disagree_is_found() {
    let build = built();
    let changes: [(&str, Change); 7] = [
        ("the MD5", &|list| edit(list, PROGRAM, "G28", "G27")),
        ("the time", &|list| {
            edit(list, "Metadata/slice_info.config", "prediction\" value=\"", "prediction\" value=\"9");
        }),
        ("another program", &|list| edit(list, SETTINGS, "plate_1.gcode", "plate_2.gcode")),
        ("a second plate", &|list| edit(list, SETTINGS, "</plate>", "</plate><plate/>")),
        ("no model", &|list| list.retain(|(name, _)| name != "3D/3dmodel.model")),
        ("no relationship", &|list| edit(list, "_rels/.rels", "3dmodel\"", "thumbnail\"")),
        ("a second program", &|list| list.push(("Metadata/plate_2.gcode".to_owned(), b"G28\n".to_vec()))),
    ];
    for (what, change) in changes {
        let findings = findings_with(&build, change);
        assert_eq!(findings.iter().map(|one| one.code).collect::<Vec<_>>(), ["wrong-package"], "{what}");
    }
}

#[test]
fn a_damaged_archive_is_found() {
    let build = built();
    let mut files = files_of(&build);
    let mut bytes = content(&files, PACKAGE).to_vec();
    let place = bytes.windows(3).position(|window| window == b"G28").expect("the program");
    bytes[place + 2] = b'7';
    replace(&mut files, PACKAGE, bytes);
    reseal(&mut files);
    let findings = read_back(&files).findings;
    assert_eq!(findings.iter().map(|one| one.code).collect::<Vec<_>>(), ["bad-zip"]);
}

#[test]
fn other_machines_refuse_a_package_and_write_none() {
    for profile in ["generic", "ender", "prusa", "klipper-printer"] {
        let machine = Machine::builtin(profile).expect("built in");
        let request = KindRequest::exactly(&[Kind::Seal3mf]);
        let refusals = no_requested_programs(&read(&text(profile)), &machine, &request).expect_err("refused");
        let codes: Vec<&str> = refusals.iter().map(|refusal| refusal.code.as_str()).collect();
        assert_eq!(codes, ["no-package"], "{profile}");
    }
    let machine = Machine::builtin("bambu").expect("built in");
    let request = KindRequest::exactly(&[Kind::Seal3mf]);
    assert!(no_requested_programs(&read(&text("bambu")), &machine, &request).is_ok());
    let generic = crate::support::build(&text("generic")).unwrap_or_else(|refusals| panic!("{refusals}"));
    assert!(generic.artifacts.iter().all(|file| file.output.kind != Kind::Seal3mf));
}

/// A package is turned and shifted with the programs.
#[test]
fn an_aligned_build_has_packages() {
    let build = built();
    let files = files_of(&build);
    let marks = build.forecast.design.marks(1).expect("marks");
    // The machine shows its own coordinates, in which the sheet lies at X20 Y20.
    let shift = stargrip_cam::geom::Vec2::new(21.0, 20.5);
    let aligned =
        align(&files, None, marks.map(|mark| mark + shift)).unwrap_or_else(|fault| panic!("{fault}"));
    let names: Vec<&str> = aligned.built().artifacts.iter().map(|file| file.name.as_str()).collect();
    assert!(names.contains(&PACKAGE) && names.contains(&"star-1-seal.gcode"), "{names:?}");
}

/// The program in the package `bytes`.
fn packed(bytes: &[u8]) -> Vec<u8> {
    part(&mut parts(bytes), PROGRAM).clone()
}

/// Trace, seal and cut of a build, coupons, the feed check and the rest of a job.
#[test]
fn every_program_for_the_printer_has_a_package() {
    let cut = "[cut]\ntool = \"hot-tip\"\ntemperature = \"350 C\"\nspeed = \"10 mm/s\"\nheight = \"-1 mm\"\n";
    let (toml, profile) =
        (format!("{}{cut}", text("bambu")), spec::builtin_machine("bambu").expect("built in"));
    let (reading, machine) = (read(&toml), Machine::builtin("bambu").expect("built in"));
    let sources = Sources { spec: &toml, machine: profile };
    let build = pipeline::build(&reading, &machine, sources, &KindRequest::default())
        .unwrap_or_else(|refusals| panic!("{refusals}"));
    let files = files_of(&build);
    assert_eq!(read_back(&files).findings, []);
    // Coupons lie in a directory of their own; what is compared is the same.
    let coupons = MadeCoupons::new(&reading, &machine, sources, &grid(), &[CouponGroup::Strips]);
    let coupons = coupons.unwrap_or_else(|refusals| panic!("{refusals}")).prove();
    let coupons = coupons.unwrap_or_else(|findings| panic!("{findings:?}"));
    let built = files.names().map(|name| (name.to_owned(), content(&files, name).to_vec()));
    let of_coupons = coupons.files().into_iter().map(|(name, bytes)| (name.to_owned(), bytes));
    for list in [built.collect::<Vec<_>>(), of_coupons.collect()] {
        let packages: Vec<_> = list.iter().filter(|(name, _)| name.strip_suffix(".3mf").is_some()).collect();
        let programs = list.iter().filter(|(name, _)| name.strip_suffix(".gcode").is_some()).count();
        assert!(
            programs > 0 && packages.len() == programs,
            "{programs} programs, {} packages",
            packages.len()
        );
        for (name, bytes) in packages {
            let plain = list.iter().find(|(plain, _)| format!("{plain}.3mf") == *name).expect("a program");
            assert!(packed(bytes) == plain.1, "{name}");
        }
    }
    let seal = String::from_utf8(content(&files, "star-1-seal.gcode").to_vec()).expect("text");
    let rest = resume(&seal, ResumeAt::Share(0.5), None).unwrap_or_else(|fault| panic!("{fault}"));
    assert!(packed(&rest.package.expect("a package")) == rest.text.as_bytes());
    let check =
        feed_check(&reading, &machine, sources, "check.gcode").unwrap_or_else(|fault| panic!("{fault:?}"));
    let package = check.package.expect("a package");
    assert!(packed(&package) == check.text.as_bytes());
    assert_eq!(prove_feed_check("check.gcode.3mf", &package, &check.manifest).findings, []);
    let mut list = parts(&package);
    edit(&mut list, PROGRAM, "G1 ", "G0 ");
    let forged = prove_feed_check("check.gcode.3mf", &archive(&list), &check.manifest).findings;
    assert!(forged.iter().any(|finding| finding.code == "wrong-package"), "{forged:?}");
}

/// One setting.
fn grid() -> StripGrid {
    StripGrid {
        temperatures: vec![Temperature(200.0)],
        powers: Vec::new(),
        speeds: vec![Speed(10.0)],
        heights: vec![Length(-0.3)],
        repeats: 1,
    }
}
