//! Programs move as the design requires: every dialect, every fault, every way to resume.

mod airtight;
mod chopped;
mod clamps;
mod clock;
mod coupons;
mod danger;
mod dangerous_lines;
mod dialects;
mod disorder;
mod drawings;
mod every_machine;
mod faults;
mod job_size;
mod laser;
mod laser_resume;
mod lowest_feed;
#[path = "../design/readers/png.rs"]
mod png;
mod pouch;
mod printer_lines;
mod printers;
mod processes;
mod profile_lines;
mod resume;
mod resume_refusals;
mod speed;
mod thumbnails;
mod told;

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::design::Refusals;
use stargrip_cam::pipeline::read_back;
use stargrip_cam::pipeline::{Built, Sources, build};
use stargrip_cam::spec::{
    Dialect, DialectFamily, LASER_PROFILE, Machine, PRESS_PROFILE, Source, Spec, StepRate, builtin_machine,
    builtin_machines, read, read_machine,
};
use stargrip_cam::verify::Finding;
use stargrip_cam::verify::gcode::{Dialect as Reader, Program, read_program};

/// The profiles of machines whose operator sets Z 0 on the sheet: one for each dialect but Bambu's, by its name.
const PROFILES: [&str; 8] =
    ["generic", "linuxcnc", "grbl", "grblhal", "fluidnc", "marlin", "klipper", "reprapfirmware"];

/// The profiles of printers that home: their programs count in the machine's coordinates.
const PRINTERS: [&str; 4] = ["bambu", "ender", "prusa", "klipper-printer"];

/// The profiles of all machines with an iron, which run programs.
fn all_profiles() -> impl Iterator<Item = &'static str> {
    PROFILES.into_iter().chain(PRINTERS)
}

/// A profile for each dialect.
fn profiles_of_dialects() -> impl Iterator<Item = &'static str> {
    PROFILES.into_iter().chain(["bambu"])
}

/// The dialect of the profile `name`.
fn dialect(name: &str) -> Dialect {
    machine(profile(name)).controller.dialect
}

/// The profiles of `family`.
fn profiles_of(family: DialectFamily) -> impl Iterator<Item = &'static str> {
    PROFILES.into_iter().filter(move |name| dialect(name).family() == family)
}

/// Whether the profile `name` is of a printer.
fn is_printer(name: &str) -> bool {
    dialect(name).family() == DialectFamily::Printer
}

/// Whether G0 runs at the feed in force in the profile `name`, or may do so.
fn has_modal_travel(name: &str) -> bool {
    dialect(name).family() != DialectFamily::Mill
}

/// Whether the controller of profile `name` has a lowest step rate: programs for it may have to be chopped.
fn has_floor(name: &str) -> bool {
    matches!(machine(profile(name)).motion.step_rate, StepRate::AtLeast(_))
}

/// The profiles whose programs may have to be chopped.
fn with_floor() -> impl Iterator<Item = &'static str> {
    PROFILES.into_iter().filter(|name| has_floor(name))
}

#[test]
fn every_profile_is_tried() {
    let with_programs = builtin_machines().filter(|name| *name != PRESS_PROFILE);
    assert!(
        with_programs.eq(all_profiles().chain([LASER_PROFILE])),
        "PROFILES, PRINTERS and the laser are not those that come with the program"
    );
    assert!(Dialect::WORDS.iter().all(|word| profiles_of_dialects().any(|name| name == *word)));
}

/// A spec of a small star, with `rest` added.
fn spec_text(rest: &str) -> String {
    format!(
        "schema = 1\nname = \"small\"\n[star]\npoints = 4\ninner_radius = \"20 mm\"\ntube_width = \"10 mm\"\n\
         tip_angle = \"40 deg\"\ncorner_radius = \"2 mm\"\n{rest}"
    )
}

fn spec(text: &str) -> Spec {
    read(&Source::new("spec", text)).unwrap_or_else(|faults| panic!("{faults}")).spec
}

fn machine(text: &str) -> Machine {
    read_machine(&Source::new("machine", text)).unwrap_or_else(|faults| panic!("{faults}"))
}

fn profile(name: &str) -> &'static str {
    builtin_machine(name).expect("built in")
}

/// The section that has seals chopped on the profile `name`; empty where its controller runs them steadily.
fn chop_section(name: &str) -> &'static str {
    if has_floor(name) { "[machine]\nfeed_floor = \"chop\"\n" } else { "" }
}

/// A spec of the small star that the profile `name` can run.
fn star_text(name: &str) -> String {
    spec_text(chop_section(name))
}

/// The small star on the profile `name`.
fn star(name: &str) -> Built {
    built(&star_text(name), profile(name))
}

/// The program `code` as the controller of `machine` reads it.
fn read_for(machine: &Machine, code: &str) -> Program {
    read_program(code, Reader::for_controller(&machine.controller))
}

/// A build for any machine, from a spec whose profile is a file of the user's own.
fn try_built(spec_text: &str, machine_text: &str) -> Result<Built, Refusals> {
    try_built_with(spec_text, machine_text, &KindRequest::default())
}

/// A build of the files of `request`, as by [`try_built`].
fn try_built_with(spec_text: &str, machine_text: &str, request: &KindRequest) -> Result<Built, Refusals> {
    let section = "[machine]\nprofile = \"own.toml\"\n";
    let spec_text = match spec_text.split_once("[machine]\n") {
        Some((before, after)) => format!("{before}{section}{after}"),
        None => format!("{spec_text}{section}"),
    };
    let sources = Sources { spec: &spec_text, machine: machine_text };
    build(&spec(&spec_text), &machine(machine_text), sources, request)
}

fn built(spec_text: &str, machine_text: &str) -> Built {
    try_built(spec_text, machine_text).unwrap_or_else(|refusals| panic!("{refusals:?}"))
}

/// The name of a build's file; programs for LinuxCNC have another ending.
fn actual_name(build: &Built, name: &str) -> String {
    let ngc = name.replace(".gcode", ".ngc");
    let names = [name.to_owned(), ngc];
    names.into_iter().find(|name| build.artifacts.iter().any(|file| file.name == *name)).expect(name)
}

/// The text of a file of a build.
fn text(build: &Built, name: &str) -> String {
    let name = actual_name(build, name);
    let artifact = build.artifacts.iter().find(|artifact| artifact.name == name).expect("it");
    String::from_utf8(artifact.bytes.clone()).expect("text")
}

/// The program of `lines`, whose last line counts them.
fn recounted(lines: &[impl AsRef<str>]) -> String {
    let (last, body) = lines.split_last().expect("lines");
    let (mark, count) = last.as_ref().split_once("end of program").expect("a last line");
    let close = if count.ends_with(')') { ")" } else { "" };
    let mut text = String::new();
    for line in body {
        text += line.as_ref();
        text.push('\n');
    }
    text + &format!("{mark}end of program, {} lines{close}\n", lines.len())
}

/// The findings after `change` of the lines of the program `name`, whose last line counts them; all are in that file.
fn findings_after(build: &Built, name: &str, change: impl FnOnce(&mut Vec<String>)) -> Vec<Finding> {
    let good = text(build, name);
    let mut lines: Vec<String> = good.lines().map(str::to_owned).collect();
    change(&mut lines);
    let bad = recounted(&lines);
    assert!(bad != good, "{name}: the change changes nothing");
    let findings = findings_with(build, name, &bad);
    let file = actual_name(build, name);
    assert!(findings.iter().all(|finding| finding.file == file), "{findings:#?}");
    findings
}

/// The findings in a build with `text` in the file `name`; its hash and size are corrected.
fn findings_with(build: &Built, name: &str, text: &str) -> Vec<Finding> {
    let mut manifest = build.manifest.clone();
    let name = actual_name(build, name);
    let entry = manifest.files.iter_mut().find(|file| file.path == name).expect("it");
    entry.bytes = text.len();
    entry.sha256 = stargrip_cam::manifest::sha256(text.as_bytes());
    let json = manifest.to_json();
    let files = build.files().map(|(file, bytes)| {
        let bytes = match file {
            "manifest.json" => json.clone().into(),
            _ if file == name => text.as_bytes().to_vec().into(),
            _ => bytes,
        };
        (file, bytes)
    });
    read_back(&files.collect()).findings
}
