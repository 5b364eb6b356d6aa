//! A drawn shape on every machine: all that a star can be made to be, a drawing can.

use std::fs;

use stargrip_cam::artifact::{Asked, Kind};
use stargrip_cam::coupon::{CouponGroup, StripGrid};
use stargrip_cam::pipeline::{Built, MadeCoupons, Sources, build, read_back};
use stargrip_cam::resume::{ResumeAt, resume};
use stargrip_cam::spec::{Machine, Source, Spec, read};
use stargrip_cam::verify::OutputFiles;
use stargrip_cam::verify::gcode::{Dialect, read_program};

use crate::{PROFILES, findings_with, machine, profile, text as text_of};

/// The shipped pillow, more of it in `rest`, four times, as paper for a press, too.
fn pillow(rest: &str) -> (String, Spec) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/drawings/");
    let text = fs::read_to_string(format!("{folder}pillow.toml")).expect("a design");
    let text =
        format!("{text}colours = \"ordered\"\n[sheet]\ncopies = 4\n[mask]\nkind = \"separator\"\n{rest}");
    let reading = read(&Source::new("spec", text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(&fs::read(format!("{folder}pillow.dxf")).expect("a drawing")).spec;
    (text, spec)
}

fn made(text: &str, spec: &Spec, machine: &Machine, name: &str) -> Built {
    let asked = Asked { with: vec![Kind::OutlinePdf, Kind::PreviewPng], ..Asked::default() };
    let sources = Sources { spec: text, machine: profile(name) };
    build(spec, machine, sources, &asked).unwrap_or_else(|refusals| panic!("{name}: {refusals}"))
}

#[test]
fn a_drawing_is_made_on_every_machine() {
    for name in PROFILES {
        let chops = ["grbl", "grblhal", "fluidnc", "marlin"].contains(&name);
        let scope = if name == "klipper" { "sheet" } else { "piece" };
        let floor = if chops { "chop" } else { "refuse" };
        let rest =
            format!("[machine]\nprofile = \"{name}\"\nprogram = \"{scope}\"\nfeed_floor = \"{floor}\"\n");
        let (text, spec) = pillow(&rest);
        let machine = machine(profile(name));
        let built = made(&text, &spec, &machine, name);
        let files = OutputFiles { files: built.files().map(|(file, bytes)| (file.into(), bytes)).collect() };
        assert_eq!(read_back(&files).findings, [], "{name}");
        let has = |file: &str| built.artifacts.iter().any(|artifact| artifact.name == file);
        for file in
            ["sheet-1-outline-a4.pdf", "sheet-1-preview.png", "piece-1-mask.svg", "piece-1-mask-letter.pdf"]
        {
            assert!(has(file), "{name}: {file}");
        }
        let mask = text_of(&built, "piece-1-mask.svg");
        let moved = mask.replacen(" L", " L1", 1);
        assert!(moved != mask && !findings_with(&built, "piece-1-mask.svg", &moved).is_empty(), "{name}");
        // Half of the first program is done: the rest of it is sealed, and read as every program is.
        let seal =
            built.artifacts.iter().find(|artifact| artifact.output.kind == Kind::SealGcode).expect("it");
        let job = String::from_utf8(seal.bytes.clone()).expect("text");
        let rest = resume(&job, ResumeAt::Line(job.lines().count() / 2), None);
        let rest = rest.unwrap_or_else(|fault| panic!("{name}: {fault}"));
        let program = read_program(&rest.text, Dialect::for_controller(&machine.controller));
        assert_eq!(program.findings, [], "{name}");
        let grid = grid(&spec);
        let groups = CouponGroup::NAMES.map(|(_, group)| group);
        let coupons = MadeCoupons::new(&spec, &machine, Sources { spec: "", machine: "" }, &grid, &groups);
        let coupons = coupons.unwrap_or_else(|refusals| panic!("{name}: {refusals}"));
        assert!(coupons.prove().is_ok(), "{name}");
    }
}

/// One strip, as the spec seals.
fn grid(spec: &Spec) -> StripGrid {
    let heights = vec![machine(profile("generic")).process.heights.contact];
    StripGrid {
        temperatures: vec![spec.seal.temperature],
        speeds: vec![spec.seal.speed],
        heights,
        repeats: 1,
    }
}
