//! The program that cuts the sheet after the seal: for every tool and dialect, proven from its file against the outline.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::manifest::{MANIFEST, Manifest, sha256};
use stargrip_cam::pipeline::{self, Built, Sources, read_back};
use stargrip_cam::resume::{ResumeAt, ResumeFault, resume};
use stargrip_cam::spec::{self, Code, Machine, Source};
use stargrip_cam::verify::{Finding, OutputFiles};

const HOT: &str = "tool = \"hot-tip\"\ntemperature = \"350 C\"\nspeed = \"10 mm/s\"\nheight = \"-1 mm\"\n";
const KNIFE: &str =
    "tool = \"drag-knife\"\nblade_offset = \"0.25 mm\"\nspeed = \"20 mm/s\"\nheight = \"-0.8 mm\"\n";

const PROFILES: [&str; 8] =
    ["generic", "grbl", "grblhal", "fluidnc", "linuxcnc", "marlin", "klipper", "reprapfirmware"];

/// Two stars whose sheet is cut by the keys `cut`, for `profile`.
fn text(profile: &str, cut: &str, kerf: &str) -> String {
    format!(
        "schema = 1\nname = \"cut\"\n[star]\npoints = 5\ninner_radius = \"40 mm\"\ntube_width = \"24 mm\"\n\
         tip_angle = \"30 deg\"\n[stack]\ncount = 2\n[seal]\nspeed = \"10 mm/s\"\n[cut]\nkerf = {kerf:?}\n{cut}\
         [machine]\nprofile = {profile:?}\n[inlet]\nnone = true\n"
    )
}

fn built_for(profile: &str, cut: &str, kerf: &str) -> Result<Built, Vec<&'static str>> {
    let toml = text(profile, cut, kerf);
    let spec = spec::read(&Source::new("cut", toml.clone())).unwrap_or_else(|faults| panic!("{faults}")).spec;
    let machine = Machine::builtin(profile).expect("built in");
    let sources = Sources { spec: &toml, machine: spec::builtin_machine(profile).expect("built in") };
    let request = KindRequest::exactly(&[Kind::CutGcode, Kind::OutlineSvg]);
    pipeline::build(&spec, &machine, sources, &request)
        .map_err(|refusals| refusals.iter().map(|refusal| refusal.code.as_str()).collect())
}

fn built(profile: &str, cut: &str) -> Built {
    built_for(profile, cut, "0.4 mm").unwrap_or_else(|codes| panic!("{profile}: {codes:?}"))
}

/// The cutting program among the files of `build`, by name and text.
fn program(build: &Built) -> (String, String) {
    let file = build.artifacts.iter().find(|file| file.output.kind == Kind::CutGcode).expect("a program");
    (file.name.clone(), String::from_utf8(file.bytes.clone()).expect("text"))
}

/// The findings where the cutting program of `build` is `text` instead, with a last line and a manifest that agree.
fn findings_of(build: &Built, text: &str) -> Vec<Finding> {
    let (name, _) = program(build);
    let lines: Vec<&str> = text.lines().filter(|line| !line.contains("end of program, ")).collect();
    let text = format!("{}\n; end of program, {} lines\n", lines.join("\n"), lines.len() + 1);
    let mut files: Vec<(String, Vec<u8>)> =
        build.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect();
    for (file, bytes) in &mut files {
        if *file == name {
            *bytes = text.clone().into_bytes();
        } else if file == MANIFEST {
            let mut manifest: Manifest = serde_json::from_slice(bytes).expect("JSON");
            let entry = manifest.files.iter_mut().find(|entry| entry.path == name).expect("an entry");
            (entry.bytes, entry.sha256) = (text.len(), sha256(text.as_bytes()));
            *bytes = manifest.to_json();
        }
    }
    let files = files.into_iter().map(|(name, bytes)| (name.into(), bytes.into())).collect();
    read_back(&OutputFiles { files, ..OutputFiles::default() }).findings
}

/// The codes of these findings, each once.
fn codes(findings: &[Finding]) -> Vec<&'static str> {
    let mut codes: Vec<&str> = findings.iter().map(|finding| finding.code).collect();
    codes.sort_unstable();
    codes.dedup();
    codes
}

/// `text` with every word of `letter` changed.
fn changed(text: &str, letter: char, change: impl Fn(f64) -> f64) -> String {
    let word = |word: &str| match word.strip_prefix(letter).and_then(|number| number.parse::<f64>().ok()) {
        Some(number) => format!("{letter}{:.4}", change(number)),
        None => word.to_owned(),
    };
    let line = |line: &str| {
        if line.starts_with('G') {
            line.split(' ').map(word).collect::<Vec<_>>().join(" ")
        } else {
            line.to_owned()
        }
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn every_dialect_cuts_along_the_outline_with_every_tool() {
    for profile in PROFILES {
        for cut in [HOT, KNIFE] {
            let build = built(profile, cut);
            let (name, text) = program(&build);
            assert_eq!(findings_of(&build, &text), [], "{profile}: {name}");
            // Two stars: three registration holes each, a hole each, and then both outlines.
            let edges: Vec<&str> = text
                .lines()
                .filter(|line| line.starts_with("; cut: "))
                .filter_map(|line| line.split(' ').nth(3))
                .collect();
            let kinds: Vec<&str> =
                edges.iter().filter_map(|edge| edge.rsplit_once('-')).map(|(kind, _)| kind).collect();
            let expected =
                [["edge=registration"; 6].as_slice(), &["edge=cut-hole"; 2], &["edge=cut-outside"; 2]]
                    .concat();
            assert_eq!(kinds, expected, "{profile}");
            let cuts = &build.manifest.cuts;
            assert!(cuts.len() == 1 && cuts[0].length_mm > 1000.0 && cuts[0].time_s > 100.0, "{cuts:?}");
            assert!(matches!(resume(&text, ResumeAt::Share(0.5), None), Err(ResumeFault::Cut)));
        }
    }
}

/// Programs that are wrong in one way, for both tools: a wrong blade is found where the tip goes, not the axis.
#[test]
fn a_wrong_cut_is_found_by_code() {
    for cut in [HOT, KNIFE] {
        let build = built("linuxcnc", cut);
        let (_, text) = program(&build);
        let assert_code = |text: &str, code: &str, what: &str| {
            let findings = findings_of(&build, text);
            assert!(codes(&findings).contains(&code), "{what}: {code} is not among {:?}", codes(&findings));
        };
        assert_code(&changed(&text, 'X', |x| if x == 0.0 { 0.0 } else { x + 0.05 }), "deviation", "shifted");
        let (head, tail) = text.split_once("; cut: cut=3 ").expect("a hole");
        let rest = tail.split_once("; cut: cut=4 ").expect("the next").1;
        assert_code(&format!("{head}; cut: cut=4 {rest}"), "missing-seam", "a missing hole");
        let height = if cut == HOT { -1.0 } else { -0.8 };
        assert_code(&changed(&text, 'Z', |z| if z == height { z - 0.5 } else { z }), "too-deep", "too deep");
        let shallow = findings_of(&build, &changed(&text, 'Z', |z| if z == height { -0.2 } else { z }));
        assert!(!shallow.is_empty(), "too high");
        // The way of a tool that takes nothing away, in the place of one that takes away 0.4 mm.
        let findings = findings_of(&build, &program(&built_for("linuxcnc", cut, "0 mm").expect("a build")).1);
        assert!(codes(&findings).contains(&"deviation"), "another kerf: {:?}", codes(&findings));
        assert_code(&text.replacen("M0\n", "", 1), "profile-line", "no pause for the tool");
        assert_code(&changed(&text, 'F', |f| f * 1.5), "wrong-feed", "too fast");
    }
    let build = built("linuxcnc", KNIFE);
    let other = program(&built("linuxcnc", &KNIFE.replace("0.25", "0.5")))
        .1
        .replace("offset_mm=0.5", "offset_mm=0.25");
    assert!(codes(&findings_of(&build, &other)).contains(&"deviation"), "another blade");
    let hot = built("linuxcnc", HOT);
    let cold: Vec<&str> = codes(&findings_of(&hot, &program(&build).1));
    assert!(cold.contains(&"cold-seal"), "a cold tip: {cold:?}");
}

#[test]
fn a_cut_that_cannot_be_made_is_refused_with_its_key() {
    for (profile, cut, code) in [
        ("generic", HOT.replace("-1 mm", "-0.3 mm"), "shallow-cut"),
        ("generic", KNIFE.replace("-0.8 mm", "0 mm"), "shallow-cut"),
        ("grbl", HOT.replace("10 mm/s", "0.1 mm/s"), "feed-floor"),
    ] {
        let codes = built_for(profile, &cut, "0.4 mm").map(|_| ()).expect_err("refused");
        assert_eq!(codes, [code], "{profile}: {cut}");
    }
}
