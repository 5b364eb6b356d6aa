//! Marks of a sheet, and programs for a sheet that was moved: proven where it lies, refused where it cannot lie.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::design::{AlignmentFault, Design};
use stargrip_cam::geom::{Isometry, Point, Vec2};
use stargrip_cam::manifest::MANIFEST;
use stargrip_cam::pipeline::{self, AlignedFault, Built, Sources, align, prove_files, read_back};
use stargrip_cam::spec::{self, Machine, Source};

use crate::support::{files_of, read, replace};

const TEXT: &str = "schema = 1\nname = \"marked\"\n[star]\npoints = 5\ninner_radius = \"40 mm\"\ntube_width = \"24 mm\"\n\
    tip_angle = \"30 deg\"\n[stack]\ncount = 2\n[seal]\nspeed = \"10 mm/s\"\n[cut]\ntool = \"drag-knife\"\n\
    blade_offset = \"0.25 mm\"\nspeed = \"20 mm/s\"\nheight = \"-0.8 mm\"\n[machine]\nmarks = \"pause\"\n";

fn built(text: &str) -> Built {
    let spec = read(text);
    let machine = Machine::builtin(&spec.machine.profile).expect("built in");
    let sources =
        Sources { spec: text, machine: spec::builtin_machine(&spec.machine.profile).expect("built in") };
    pipeline::build(&spec, &machine, sources, &KindRequest::default())
        .unwrap_or_else(|refusals| panic!("{refusals}"))
}

fn design_of(text: &str) -> Design {
    let spec = read(text);
    let machine = Machine::builtin(&spec.machine.profile).expect("built in");
    Design::new(&spec, &machine).unwrap_or_else(|refusals| panic!("{refusals}"))
}

/// The marks of `design` after a motion of its sheet.
fn measured(design: &Design, degrees: f64, shift: Vec2) -> [Point; 2] {
    let motion = Isometry { shift, ..Isometry::rotation(degrees.to_radians()) };
    design.marks(1).expect("marks").map(|mark| motion.point(mark))
}

#[test]
fn trace_and_seal_stop_above_both_marks() {
    for profile in ["generic", "grbl", "linuxcnc", "marlin", "klipper", "reprapfirmware", "bambu"] {
        // Two of these stars do not fit a printer.
        let text = if profile == "bambu" {
            TEXT.replace("40 mm", "26 mm").replace("24 mm", "16 mm").replace("= 2", "= 1")
        } else {
            TEXT.to_owned()
        };
        let build = built(&format!("{text}profile = {profile:?}\n"));
        assert_eq!(read_back(&files_of(&build)).findings, [], "{profile}");
        for file in &build.artifacts {
            let kind = file.output.kind;
            if kind.format() == stargrip_cam::artifact::Format::Gcode {
                let text = std::str::from_utf8(&file.bytes).expect("text");
                let stops = text.lines().filter(|line| line.starts_with("; mark: ")).count();
                assert_eq!(stops, if kind == Kind::CutGcode { 0 } else { 2 }, "{profile}: {}", file.name);
            }
        }
    }
}

/// Turned and shifted, the programs are proven in the new frame, and in no other.
#[test]
fn programs_for_a_moved_sheet_are_proven_where_it_lies() {
    let (build, design) = (built(TEXT), design_of(TEXT));
    let files = files_of(&build);
    for (degrees, shift) in [(0.0, (0.0, 0.0)), (1.5, (3.0, -2.0)), (-1.2, (-4.0, 6.0))] {
        let marks = measured(&design, degrees, Vec2::new(shift.0, shift.1));
        let proven = align(&files, None, marks).unwrap_or_else(|fault| panic!("{fault}"));
        let moved = proven.built();
        let alignment = moved.forecast.design.alignment.expect("one");
        assert!((alignment.motion.rotation.to_degrees() - degrees).abs() < 1e-9, "{alignment:?}");
        let kinds: Vec<Kind> =
            moved.artifacts.iter().map(|file| file.output.kind).filter(|kind| !kind.is_source()).collect();
        for kind in [Kind::TraceGcode, Kind::SealGcode, Kind::CutGcode] {
            assert!(kinds.contains(&kind), "{kinds:?}");
        }
        let moved_files = files_of(moved);
        assert_eq!(prove_files(&moved_files).findings, []);
        // The manifest states another place: no program is there.
        let mut elsewhere = moved_files.clone();
        let mut manifest = moved.manifest.clone();
        let aligned = manifest.aligned.as_mut().expect("one");
        (aligned.mark1[0], aligned.mark2[0]) = (aligned.mark1[0] + 0.05, aligned.mark2[0] + 0.05);
        replace(&mut elsewhere, MANIFEST, manifest.to_json());
        let codes: Vec<&str> = read_back(&elsewhere).findings.iter().map(|finding| finding.code).collect();
        assert!(codes.contains(&"deviation") && codes.contains(&"missing-mark"), "{codes:?}");
        assert!(matches!(align(&moved_files, None, marks), Err(AlignedFault::Twice)));
    }
}

#[test]
fn marks_that_cannot_be_those_of_the_sheet_are_refused() {
    let design = design_of(TEXT);
    let [a, b] = design.marks(1).expect("marks");
    let fault = |marks| design.alignment(1, marks).expect_err("refused");
    let stretched = b + (b - a) * 0.0031;
    assert!(matches!(fault([a, stretched]), AlignmentFault::Stretch(..)));
    assert!(design.alignment(1, [a, b + (b - a) * 0.0029]).is_ok());
    assert!(matches!(fault([b, a]), AlignmentFault::Turn(_)));
    assert!(matches!(fault(measured(&design, 2.1, Vec2::new(0.0, 0.0))), AlignmentFault::Turn(_)));
    let side = design.sheets[0].width.max(design.sheets[0].height);
    assert!(matches!(
        fault([a, b].map(|mark| mark + Vec2::new(0.051 * side, 0.0))),
        AlignmentFault::Shift(..)
    ));
    for wrong in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        assert!(matches!(fault([Point::new(wrong, 0.0), b]), AlignmentFault::NotFinite));
        assert!(matches!(fault([a, Point::new(0.0, wrong)]), AlignmentFault::NotFinite));
    }
    for huge in [1e6, 1e300, f64::MAX] {
        let _ = fault([Point::new(huge, -huge), Point::new(-huge, huge)]);
    }
    assert!(matches!(fault([a, a]), AlignmentFault::Stretch(..)));
    assert!(matches!(design.alignment(2, [a, b]), Err(AlignmentFault::NoSheet(2))));
}

/// A sheet that the machine reaches where it was laid out, and not where it lies now.
#[test]
fn a_sheet_beyond_the_work_area_is_refused() {
    let text = TEXT.replace("[machine]\n", "[sheet]\nmargin = \"1 mm\"\n[machine]\nprofile = \"own.toml\"\n");
    let (spec, design) = (read(&text), design_of(TEXT));
    let size = design.sheets[0];
    let generic = spec::builtin_machine("generic").expect("built in");
    let reach = |axis: &str, mm: f64| (format!("{axis} = \"unknown\""), format!("{axis} = \"{mm} mm\""));
    let [(no_x, x), (no_y, y)] = [reach("x", size.width), reach("y", size.height)];
    let profile = generic.replacen(&no_x, &x, 1).replacen(&no_y, &y, 1);
    let machine = spec::read_machine(&Source::new("own.toml", profile.as_str()))
        .unwrap_or_else(|faults| panic!("{faults}"));
    let sources = Sources { spec: &text, machine: &profile };
    let request = KindRequest::exactly(&[Kind::SealGcode]);
    let build =
        pipeline::build(&spec, &machine, sources, &request).unwrap_or_else(|refusals| panic!("{refusals}"));
    let design = &build.forecast.design;
    let files = files_of(&build);
    assert!(align(&files, None, measured(design, 0.0, Vec2::new(0.5, 0.5))).is_ok());
    let outcome = align(&files, None, measured(design, 0.0, Vec2::new(-6.0, 0.0)));
    assert!(matches!(outcome, Err(AlignedFault::Refused(_))), "{outcome:?}");
}
