//! A drawn shape on every machine: a drawing has the same options as a star.

use std::fs;

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::coupon::{CouponGroup, StripGrid};
use stargrip_cam::design::Refusals;
use stargrip_cam::pipeline::{Built, MadeCoupons, Sources, build, read_back};
use stargrip_cam::resume::{ResumeAt, resume};
use stargrip_cam::spec::{Machine, Source, Spec, read};

use crate::{PROFILES, findings_with, machine, profile, read_for, text as text_of};

/// The shipped pillow with `rest` added to its spec: four copies, with a separator.
fn pillow(rest: &str) -> (String, Spec) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/drawings/");
    let text = fs::read_to_string(format!("{folder}pillow.toml")).expect("a design");
    let text =
        format!("{text}colours = \"ordered\"\n[sheet]\ncopies = 4\n[mask]\nkind = \"separator\"\n{rest}");
    let reading = read(&Source::new("spec", text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(&fs::read(format!("{folder}pillow.dxf")).expect("a drawing")).spec;
    (text, spec)
}

fn build_drawing(text: &str, spec: &Spec, machine: &Machine, name: &str) -> Built {
    let request = KindRequest { with: vec![Kind::OutlinePdf, Kind::PreviewPng], ..KindRequest::default() };
    let sources = Sources { spec: text, machine: profile(name) };
    build(spec, machine, sources, &request).unwrap_or_else(|refusals| panic!("{name}: {refusals}"))
}

/// The hand rest on `profile`; its bands are 3 mm wide.
fn hand_rest(profile: &str) -> Result<Built, Refusals> {
    hand_rest_with(str::to_owned, "", profile)
}

/// The hand rest with its spec changed, and with `machine_keys` in its section on the machine.
fn hand_rest_with(
    change: impl Fn(&str) -> String,
    machine_keys: &str,
    profile: &str,
) -> Result<Built, Refusals> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/drawings/");
    let text = fs::read_to_string(format!("{folder}hand-rest.toml")).expect("a design");
    let text = format!("{}\n[machine]\nprofile = \"own.toml\"\n{machine_keys}", change(&text));
    let reading = read(&Source::new("spec", text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(&fs::read(format!("{folder}hand-rest.svg")).expect("a drawing")).spec;
    let sources = Sources { spec: &text, machine: profile };
    build(&spec, &machine(profile), sources, &KindRequest::default())
}

/// With the iron 3 mm below the release layer, 3/5 of a ramp seal: past a weld's end 1.5 mm of that may, half a band.
#[test]
fn a_ramp_that_seals_far_past_a_weld_is_refused() {
    let deep = profile("generic")
        .replace("contact = \"-0.3 mm\"", "contact = \"-3 mm\"")
        .replace("travel = \"5 mm\"", "travel = \"2 mm\"");
    let with_ramp =
        |ramp: &str| hand_rest(&deep.replace("ramp = \"3 mm\"", &format!("ramp = \"{ramp} mm\"")));
    let refusals = with_ramp("30").map(|_| ()).expect_err("18 mm are sealed past the ends");
    assert_eq!(refusals[0].code, "long-ramp");
    assert!(
        refusals[0].found.contains("presses 18.000 mm past an end of crease-left of piece 1 "),
        "{}",
        refusals[0].found
    );
    assert!(refusals[0].remedy.contains("a ramp of at most 2.5 mm"), "{}", refusals[0].remedy);
    assert!(with_ramp("2.51").is_err());
    let built = with_ramp("2.5").unwrap_or_else(|refusals| panic!("{refusals}"));
    assert_eq!(read_back(&built.output_files()).findings, []);
    // Past the mouth of a star there is no fabric, and the ramps of a closed seam lie on its own band.
    let long = deep.replace("ramp = \"3 mm\"", "ramp = \"30 mm\"");
    assert!(crate::try_built(&crate::spec_text(""), &long).is_ok());
}

#[test]
fn a_drawing_is_made_on_every_machine() {
    for name in PROFILES {
        let chops = crate::has_floor(name);
        let scope = if name == "klipper" { "sheet" } else { "piece" };
        let floor = if chops { "chop" } else { "refuse" };
        let rest =
            format!("[machine]\nprofile = \"{name}\"\nprogram = \"{scope}\"\nfeed_floor = \"{floor}\"\n");
        let (text, spec) = pillow(&rest);
        let machine = machine(profile(name));
        let built = build_drawing(&text, &spec, &machine, name);
        assert_eq!(read_back(&built.output_files()).findings, [], "{name}");
        let has_file = |file: &str| built.artifacts.iter().any(|artifact| artifact.name == file);
        for file in
            ["sheet-1-outline-a4.pdf", "sheet-1-preview.png", "piece-1-mask.svg", "piece-1-mask-letter.pdf"]
        {
            assert!(has_file(file), "{name}: {file}");
        }
        let mask = text_of(&built, "piece-1-mask.svg");
        let moved = mask.replacen(" L", " L1", 1);
        assert!(moved != mask && !findings_with(&built, "piece-1-mask.svg", &moved).is_empty(), "{name}");
        // Half of the first program is done: the rest of it is sealed, and read like every program.
        let seal =
            built.artifacts.iter().find(|artifact| artifact.output.kind == Kind::SealGcode).expect("it");
        let job = String::from_utf8(seal.bytes.clone()).expect("text");
        let rest = resume(&job, ResumeAt::Line(job.lines().count() / 2), None);
        let rest = rest.unwrap_or_else(|fault| panic!("{name}: {fault}"));
        let program = read_for(&machine, &rest.text);
        assert_eq!(program.findings, [], "{name}");
        let grid = grid(&spec);
        let groups = CouponGroup::NAMES.map(|(_, group)| group);
        let coupons = MadeCoupons::new(&spec, &machine, Sources { spec: "", machine: "" }, &grid, &groups);
        let coupons = coupons.unwrap_or_else(|refusals| panic!("{name}: {refusals}"));
        assert!(coupons.prove().is_ok(), "{name}");
    }
}

/// A drawing in `bytes`, the file `file`, with its layers `air`, `port` and `weld`, for the machine `name`.
fn sealed(file: &str, bytes: &str, name: &str) -> Built {
    let chops = crate::has_floor(name);
    let floor = if chops { "chop" } else { "refuse" };
    let text = format!(
        "schema = 1\nname = \"crumbs\"\n[drawing]\nfile = \"{file}\"\nlayers = {{ air = [\"air\"], port = [\"port\"], seam = [\"weld\"] }}\n\
         [machine]\nprofile = \"{name}\"\nfeed_floor = \"{floor}\"\n"
    );
    let reading = read(&Source::new("spec", text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    build_drawing(&text, &reading.with_drawing(bytes.as_bytes()).spec, &machine(profile(name)), name)
}

/// Curves of other programs have segments of a micrometre and less. No seam begins on one, and the iron does not go straight down there: on
/// a round island between its halves, and at the corners of one whose sides are hardly longer than a ramp.
#[test]
fn crumbs_under_a_ramp_do_no_harm() {
    for crumb in [2e-5, 1e-4, 4e-4, 1e-3] {
        let weld = format!(
            "M 60,60 l {crumb},0 0,{crumb} L 100,80 l 0,{crumb} {crumb},0 0,{crumb} L 120,90 l {crumb},0 0,-{crumb}"
        );
        let round = format!("M60,100 a8 8 0 0 1 0 16 h-{crumb} a8 8 0 0 1 0 -16 z");
        let edged = format!(
            "M140,50 h4 v{crumb} l2.9,2.9 v4 h-{crumb} l-2.9,2.9 h-4 v-{crumb} l-2.9,-2.9 v-4 h{crumb} l2.9,-2.9 z"
        );
        let drawing = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='200mm' height='200mm' viewBox='0 0 200 200'><g id='air'>\
             <rect id='rim' x='20' y='20' width='150' height='120'/><path id='round' d='{round}'/><path id='edged' d='{edged}'/></g><g id='port'><path id='hose' d='M16,80H24'/></g>\
             <g id='weld'><path id='line' d='{weld}'/></g></svg>"
        );
        for name in PROFILES {
            let built = sealed("crumbs.svg", &drawing, name);
            assert_eq!(built.proof().findings, [], "{name}, {crumb} mm");
            let piece = &built.forecast.design.drawn_pieces().expect("a drawing").pieces[0];
            let weld = piece.shape.seams.iter().find(|seam| seam.name == "line").expect("the weld");
            // Straight on before its first long segment, which goes 40 mm to the right and 20 mm down.
            let direction = weld.lead_in(3.0).tangent_at(0.0).expect("a way");
            assert!((direction.y / direction.x + 0.5).abs() < 1e-3, "{direction:?}");
        }
    }
}

/// Lines, corners and arcs of zero length in a DXF: the seams equal those without them.
#[test]
fn elements_of_no_length_are_nothing() {
    let entity = |kind: &str, pairs: &str| format!("0|{kind}|8|air|{pairs}|");
    let corners = "10|20|20|20|10|20|20|20|10|170|20|20|10|170|20|140|10|170|20|140|10|20|20|140|10|20|20|20";
    let rim = |corners: &str, count: usize| entity("LWPOLYLINE", &format!("90|{count}|70|1|{corners}"));
    let crumbs = [
        entity("LINE", "10|20|20|70|11|20|21|70"),
        entity("LINE", "10|90|20|80|11|90|21|80"),
        entity("ARC", "10|90|20|20|40|0|50|0|51|90"),
        entity("LWPOLYLINE", "90|2|70|0|10|170|20|140|10|170|20|140"),
    ];
    let file = |entities: &str| {
        let head = "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|ENTITIES|";
        format!(
            "{head}{entities}0|LINE|8|weld|10|60|20|60|11|100|21|60|0|POINT|8|port|10|20|20|80|0|ENDSEC|0|EOF"
        )
        .replace('|', "\n")
    };
    let plain = rim("10|20|20|20|10|170|20|20|10|170|20|140|10|20|20|140", 4);
    let program =
        |entities: &str| text_of(&sealed("d.dxf", &file(entities), "generic"), "piece-1-seal.gcode");
    assert_eq!(program(&(rim(corners, 7) + &crumbs.concat())), program(&plain));
}

/// One strip, sealed with the spec's settings.
fn grid(spec: &Spec) -> StripGrid {
    let heights = vec![machine(profile("generic")).process.heights.contact];
    StripGrid {
        temperatures: vec![spec.seal.temperature],
        powers: Vec::new(),
        speeds: vec![spec.seal.speed],
        heights,
        repeats: 1,
    }
}

/// A piece far from X0 Y0 is reached slowly; a rest that begins on an arc can be resumed, too; where the strokes down have no dwell of their own,
/// the next ones are paced anew.
#[test]
fn drawings_are_resumed_wherever_they_lie_and_begin() {
    let shares = |job: &str, shares: &[f64]| {
        for share in shares {
            let rest =
                resume(job, ResumeAt::Share(*share), None).unwrap_or_else(|fault| panic!("{share}: {fault}"));
            let resumed = resume(&rest.text, ResumeAt::Share(0.95), None);
            let _ = resumed.unwrap_or_else(|fault| panic!("{share}, then 0.95: {fault}"));
        }
    };
    for (name, chop) in [("grbl", "feed_floor = \"chop\"\n"), ("linuxcnc", "")] {
        let (text, spec) = pillow(&format!("[machine]\nprofile = \"{name}\"\n{chop}"));
        let built = build_drawing(&text, &spec, &machine(profile(name)), name);
        let end = if name == "grbl" { "gcode" } else { "ngc" };
        for piece in [1, 2, 4] {
            shares(&text_of(&built, &format!("piece-{piece}-seal.{end}")), &[0.5, 0.64, 0.83]);
        }
    }
    let fast = |text: &str| text.replace("band = \"3 mm\"", "band = \"3 mm\"\nspeed = \"1 mm/s\"");
    let rest = hand_rest_with(fast, "feed_floor = \"chop\"\n", profile("marlin"));
    let built = rest.unwrap_or_else(|refusals| panic!("{refusals}"));
    shares(&text_of(&built, "piece-1-seal.gcode"), &[0.1, 0.14, 0.2, 0.22]);
}
