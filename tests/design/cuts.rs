//! The program that cuts the sheet after the seal: for every tool and dialect, proven from its file against the outline.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::pipeline::{self, Built, Sources, read_back};
use stargrip_cam::resume::{ResumeAt, ResumeFault, resume};
use stargrip_cam::spec::{self, Code, LASER_PROFILE, Machine};
use stargrip_cam::verify::Finding;

use crate::support::{files_of, read, replace, reseal};

const HOT: &str = "tool = \"hot-tip\"\ntemperature = \"350 C\"\nspeed = \"10 mm/s\"\nheight = \"-1 mm\"\n";
const KNIFE: &str =
    "tool = \"drag-knife\"\nblade_offset = \"0.25 mm\"\nspeed = \"20 mm/s\"\nheight = \"-0.8 mm\"\n";

const LASER: &str = "tool = \"laser\"\npower = \"60 %\"\nspeed = \"10 mm/s\"\nfocus = \"11 mm\"\n";

const PROFILES: [&str; 9] =
    ["generic", "grbl", "grblhal", "fluidnc", "linuxcnc", "marlin", "klipper", "reprapfirmware", "bambu"];

/// The stars of the sheet for `profile`: two, or a small one on a printer.
fn star_count(profile: &str) -> usize {
    if profile == "bambu" { 1 } else { 2 }
}

/// Stars whose sheet is cut by the keys `cut`, for `profile`.
fn text(profile: &str, cut: &str, kerf: &str) -> String {
    let count = star_count(profile);
    let [radius, width] = if count == 1 { [26, 16] } else { [40, 24] };
    let power = if profile == LASER_PROFILE { "power = \"8 %\"\ntip = \"1 mm\"\n" } else { "" };
    format!(
        "schema = 1\nname = \"cut\"\n[star]\npoints = 5\ninner_radius = \"{radius} mm\"\ntube_width = \"{width} mm\"\n\
         tip_angle = \"30 deg\"\n[stack]\ncount = {count}\n[seal]\nspeed = \"10 mm/s\"\n{power}[cut]\nkerf = {kerf:?}\n{cut}\
         [machine]\nprofile = {profile:?}\n[inlet]\nnone = true\n"
    )
}

fn built_for(profile: &str, cut: &str, kerf: &str) -> Result<Built, Vec<&'static str>> {
    let toml = text(profile, cut, kerf);
    let machine = Machine::builtin(profile).expect("built in");
    let sources = Sources { spec: &toml, machine: spec::builtin_machine(profile).expect("built in") };
    let request = KindRequest::exactly(&[Kind::CutGcode, Kind::OutlineSvg]);
    pipeline::build(&read(&toml), &machine, sources, &request)
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
    let mut files = files_of(build);
    replace(&mut files, &name, text.into_bytes());
    reseal(&mut files);
    read_back(&files).findings
}

/// The codes of these findings.
fn codes(findings: &[Finding]) -> Vec<&'static str> {
    findings.iter().map(|finding| finding.code).collect()
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

/// The lines of cut number `number`: the third is a registration hole.
fn cut_lines(text: &str, number: usize) -> &str {
    let (_, tail) = text.split_once(&format!("; cut: cut={number} ")).expect("a cut");
    tail.split_once(&format!("; cut: cut={} ", number + 1)).map_or(tail, |(lines, _)| lines)
}

/// The cut `text` on the other side of its edge: its distance from `outline`, the cut without a kerf, has the other sign.
fn on_other_side(text: &str, outline: &str) -> String {
    assert_eq!(text.lines().count(), outline.lines().count());
    let mut mirrored = String::new();
    for (line, middle) in text.lines().zip(outline.lines()) {
        if line.starts_with('G') {
            let words = line.split(' ').zip(middle.split(' '));
            mirrored +=
                &words.map(|(word, middle)| mirrored_word(word, middle)).collect::<Vec<_>>().join(" ");
        } else {
            mirrored += line;
        }
        mirrored.push('\n');
    }
    mirrored
}

/// The coordinate `word` as far beyond that of the word `middle` as it lies before it; another word as it is.
fn mirrored_word(word: &str, middle: &str) -> String {
    let [number, middle] = [word, middle].map(|word| word.get(1..).and_then(|text| text.parse::<f64>().ok()));
    match (word.chars().next(), number, middle) {
        (Some(letter @ ('X' | 'Y' | 'I' | 'J')), Some(number), Some(middle)) => {
            format!("{letter}{:.4}", 2.0 * middle - number)
        }
        _ => word.to_owned(),
    }
}

#[test]
fn every_dialect_cuts_along_the_outline_with_every_tool() {
    for profile in PROFILES.into_iter().chain([LASER_PROFILE]) {
        let count = star_count(profile);
        // Two stars have more than a metre of cuts.
        let [length, time] = [500.0, 50.0].map(|bound| if count == 1 { bound } else { 2.0 * bound });
        let tools: &[&str] = if profile == LASER_PROFILE { &[LASER] } else { &[HOT, KNIFE] };
        for cut in tools {
            let build = built(profile, cut);
            let (name, text) = program(&build);
            assert_eq!(findings_of(&build, &text), [], "{profile}: {name}");
            // Three registration holes of each star, a hole of each, and then all outlines.
            let edges: Vec<&str> = text
                .lines()
                .filter(|line| line.starts_with("; cut: "))
                .filter_map(|line| line.split(' ').nth(3))
                .collect();
            let kinds: Vec<&str> =
                edges.iter().filter_map(|edge| edge.rsplit_once('-')).map(|(kind, _)| kind).collect();
            let expected =
                [("edge=registration", 3 * count), ("edge=cut-hole", count), ("edge=cut-outside", count)]
                    .map(|(kind, number)| vec![kind; number])
                    .concat();
            assert_eq!(kinds, expected, "{profile}");
            let cuts = &build.manifest.cuts;
            assert!(cuts.len() == 1 && cuts[0].length_mm > length && cuts[0].time_s > time, "{cuts:?}");
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
        let missing_hole = text.replacen(&format!("; cut: cut=3 {}", cut_lines(&text, 3)), "", 1);
        assert_code(&missing_hole, "missing-seam", "a missing hole");
        let height = if cut == HOT { -1.0 } else { -0.8 };
        assert_code(&changed(&text, 'Z', |z| if z == height { z - 0.5 } else { z }), "too-deep", "too deep");
        let shallow = findings_of(&build, &changed(&text, 'Z', |z| if z == height { -0.2 } else { z }));
        assert!(!shallow.is_empty(), "too high");
        // The way of a tool that takes nothing away, in the place of one that takes away 0.4 mm.
        let findings = findings_of(&build, &program(&built_for("linuxcnc", cut, "0 mm").expect("a build")).1);
        assert!(codes(&findings).contains(&"deviation"), "another kerf: {:?}", codes(&findings));
        let outline = program(&built_for("linuxcnc", cut, "0 mm").expect("a build")).1;
        let other_side = on_other_side(cut_lines(&text, 3), cut_lines(&outline, 3));
        let other_side = text.replacen(cut_lines(&text, 3), &other_side, 1);
        assert_code(&other_side, "deviation", "the kerf on the other side");
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

/// A program whose tool goes along the wrong side of an edge, or beside it by the kerf, is refused for every cut: holes and outlines.
#[test]
fn a_cut_on_the_wrong_side_of_its_edge_is_found_wherever_it_is() {
    for cut in [HOT, KNIFE] {
        let build = built("linuxcnc", cut);
        let (_, text) = program(&build);
        let (_, outline) = program(&built_for("linuxcnc", cut, "0 mm").expect("a build"));
        let count = text.matches("; cut: cut=").count();
        for number in 1..=count {
            let [lines, middle] = [&text, &outline].map(|program| cut_lines(program, number));
            // A kerf rounds corners of an outline, so that its lines are others: it is shifted by the kerf instead.
            let is_alike = lines.lines().count() == middle.lines().count();
            let wrong_lines =
                if is_alike { on_other_side(lines, middle) } else { changed(lines, 'X', |x| x + 0.4) + "\n" };
            let wrong = text.replacen(lines, &wrong_lines, 1);
            let findings = findings_of(&build, &wrong);
            assert!(codes(&findings).contains(&"deviation"), "{cut}: cut {number}: {:?}", codes(&findings));
            // The kerf is 0.4 mm: the way is at least that far from where it should be.
            let distance =
                |finding: &Finding| finding.found.split(' ').find_map(|word| word.parse::<f64>().ok());
            let deviations = findings.iter().filter(|finding| finding.code == "deviation");
            let largest = deviations.filter_map(distance).fold(0.0, f64::max);
            assert!(largest > 0.39, "{cut}: cut {number}: {largest} mm");
        }
    }
}

#[test]
fn a_cut_that_cannot_be_made_is_refused_with_its_key() {
    for (profile, cut, code) in [
        ("generic", HOT.replace("-1 mm", "-0.3 mm"), "shallow-cut"),
        ("generic", KNIFE.replace("-0.8 mm", "0 mm"), "shallow-cut"),
        (LASER_PROFILE, LASER.replace("11 mm", "30 mm"), "high-focus"),
        (LASER_PROFILE, LASER.replace("10 mm/s", "0.1 mm/s"), "feed-floor"),
        ("grbl", HOT.replace("10 mm/s", "0.1 mm/s"), "feed-floor"),
        ("generic", format!("{KNIFE}[sheet]\nhole_diameter = \"0.9 mm\"\n"), "tight-cut"),
    ] {
        let codes = built_for(profile, &cut, "0.4 mm").map(|_| ()).expect_err("refused");
        assert_eq!(codes, [code], "{profile}: {cut}");
    }
}
