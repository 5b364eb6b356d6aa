//! Printers that home themselves: their programs count in the machine's coordinates, and mean the sheet's.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::geom::{Point, Vec2};
use stargrip_cam::pipeline::{Built, read_back};
use stargrip_cam::resume::{ResumeAt, clamp_in_the_way, resume};
use stargrip_cam::spec::KeepOut;
use stargrip_cam::spec::units::Length;
use stargrip_cam::verify::gcode::Move;

use crate::{
    PRINTERS, findings_with, machine, profile, read_for, star_text, text, try_built, try_built_with,
};

const SEAL: &str = "star-1-seal.gcode";

/// The seal and its preview alone, for the profile `machine_text`.
fn built_for(name: &str, machine_text: &str) -> Built {
    let request = KindRequest::exactly(&[Kind::SealGcode, Kind::PreviewSvg]);
    try_built_with(&star_text(name), machine_text, &request)
        .unwrap_or_else(|refusals| panic!("{name}: {refusals:?}"))
}

/// The profile with `old` replaced by `new`.
fn changed(name: &str, old: &str, new: &str) -> String {
    assert!(profile(name).contains(old), "{name}: {old}");
    profile(name).replacen(old, new, 1)
}

/// A clamp of 100 x 100 mm around `middle`.
fn clamp(middle: Point) -> KeepOut {
    let [x, y, side] = [middle.x - 50.0, middle.y - 50.0, 100.0].map(Length);
    KeepOut { name: "vice".to_owned(), x, y, width: side, depth: side, height: None }
}

/// The moves of a program in the sheet's frame.
fn moves(machine_text: &str, program: &str) -> Vec<Move> {
    let read = read_for(&machine(machine_text), program);
    assert_eq!(read.findings, []);
    read.moves
}

#[test]
fn programs_of_printers_that_home_are_proven_and_resumed() {
    for name in PRINTERS {
        let build = built_for(name, profile(name));
        assert_eq!(read_back(&build.output_files()).findings, [], "{name}");
        let (code, preview) = (text(&build, SEAL), text(&build, "sheet-1-preview.svg"));
        assert!(
            code.contains("\nG28\n") && code.contains("\n; place: x_mm=20 y_mm=20 surface_mm="),
            "{name}"
        );
        assert!(preview.contains("X0 Y0 here is X20 Y20 of the machine"), "{name}");
        assert!(code.lines().any(|line| line.starts_with("G0 X20 Y20")), "{name}: the end");
        for share in [0.3, 0.9] {
            let rest =
                resume(&code, ResumeAt::Share(share), None).unwrap_or_else(|why| panic!("{name}: {why}"));
            let (old, new) = (moves(profile(name), &code), moves(profile(name), &rest.text));
            // The end of the rest is that of the job, and both lie on the sheet.
            assert_eq!(old.last().map(|step| step.to), new.last().map(|step| step.to), "{name}");
            assert!(
                new.iter().all(|step| step.to.x > -1e-9 && step.to.y > -1e-9 && step.to.x < 150.0),
                "{name}"
            );
            assert!(rest.text.contains("\nG28\n"), "{name}");
        }
        // Clamps lie in the sheet's frame: on the star's middle, and 200 mm to the right of it.
        let middle = build.forecast.design.placed()[0].placement.point(Point::ORIGIN);
        for (shift, is_met) in [(0.0, true), (200.0, false)] {
            let findings =
                clamp_in_the_way(&code, &[clamp(middle + Vec2::new(shift, 0.0))]).expect("our file");
            assert_eq!(findings.map(|finding| finding.code), is_met.then_some("clamp-in-the-way"), "{name}");
        }
    }
}

/// Wherever the sheet lies, its program is that of the sheet's frame, moved.
#[test]
fn a_place_moves_every_position_and_nothing_else() {
    let plain = profile("klipper");
    let at_origin = built_for("klipper", plain);
    let expected = moves(plain, &text(&at_origin, SEAL));
    for (x, y, surface) in [(20.0, 0.0, 0.0), (0.0, 13.7, 4.25), (123.456, 1.001, 31.0)] {
        let place =
            format!("surface = \"{surface} mm\"\n[origin]\nx = \"{x} mm\"\ny = \"{y} mm\"\n[work_area]");
        let placed = changed("klipper", "[work_area]", &place);
        let code = text(&built_for("klipper", &placed), SEAL);
        let placed_moves = moves(&placed, &code);
        assert_eq!(placed_moves.len(), expected.len());
        for (step, other) in placed_moves.iter().zip(&expected) {
            let differences = [step.to.x - other.to.x, step.to.y - other.to.y, step.to.z - other.to.z];
            // Both are rounded to four decimals, the first after it was moved.
            assert!(differences.iter().all(|d| d.abs() < 1.01e-4), "{differences:?}");
            assert_eq!(step.feed, other.feed);
        }
        // Read without the place, every number is the machine's.
        let raw = moves(plain, &code.replace("; place:", "; note:"));
        let (first, moved) = (placed_moves[0].to, raw[0].to);
        assert!((moved.x - first.x - x).abs() < 1e-9 && (moved.z - first.z - surface).abs() < 1e-9);
    }
    // A file that states another place than the profile is found.
    let build = built_for("ender", profile("ender"));
    let forged = text(&build, SEAL).replace("surface_mm=1", "surface_mm=2");
    assert!(findings_with(&build, SEAL, &forged).iter().any(|finding| finding.code == "other-comment"));
}

/// Work areas count from the machine's zero, so the sheet's corner takes a part of them.
#[test]
fn the_sheet_must_fit_beyond_its_corner() {
    let codes = |x: &str| {
        let shifted = changed("ender", "x = \"20 mm\"", &format!("x = \"{x}\""));
        try_built(&star_text("ender"), &shifted).map(|_| ()).map_err(|refusals| refusals[0].code.to_string())
    };
    assert_eq!((codes("20 mm"), codes("70 mm")), (Ok(()), Ok(())));
    assert_eq!(codes("90 mm"), Err("out-of-reach".to_owned()));
    let cornered = changed("ender", "x = \"20 mm\"", "x = \"220 mm\"");
    let faults = stargrip_cam::spec::read_machine(&stargrip_cam::spec::Source::new("own", cornered));
    assert_eq!(faults.expect_err("no room").list()[0].code, "conflict");
}

/// Marlin lifts a Z below 0 to 0 once it is homed, and tells nothing.
#[test]
fn a_contact_below_zero_needs_its_endstops_off() {
    let codes = |surface: &str, start: &str| {
        let text = changed("ender", "surface = \"1 mm\"", &format!("surface = \"{surface}\""));
        let text = text.replacen("\"G28\", ", start, 1);
        try_built(&star_text("ender"), &text).map(|_| ()).map_err(|refusals| refusals[0].code.to_string())
    };
    assert_eq!(codes("0.3 mm", "\"G28\", "), Ok(()));
    assert_eq!(codes("0.29 mm", "\"G28\", "), Err("clamped-contact".to_owned()));
    assert_eq!(codes("0 mm", "\"G28\", \"M211 S0\", "), Ok(()));
    assert_eq!(codes("0 mm", ""), Ok(()));
}

/// Coordinates of a machine that homes mean nothing before it has homed.
#[test]
fn a_placed_sheet_needs_a_machine_that_is_homed() {
    const BY_HAND: &str = "; requires: X, Y and Z homed first";
    let by_hand = built_for("ender", &changed("ender", "\"G28\", ", ""));
    assert_eq!(read_back(&by_hand.output_files()).findings, []);
    assert!(text(&by_hand, SEAL).contains(BY_HAND));
    for name in PRINTERS {
        assert!(!text(&built_for(name, profile(name)), SEAL).contains(BY_HAND), "{name}");
    }
    // The operator of a machine without a place sets Z 0 on the sheet.
    assert!(!text(&built_for("grbl", profile("grbl")), SEAL).contains(BY_HAND));
}

#[test]
fn heaters_have_numbers_and_names() {
    let second = changed("ender", "heating = \"hotend\"", "heating = \"hotend 1\"").replacen(
        "\"M104 S0\"",
        "\"M104 T1 S0\"",
        1,
    );
    let build = built_for("ender", &second);
    assert_eq!(read_back(&build.output_files()).findings, []);
    let code = text(&build, SEAL);
    assert!(code.contains("\nM109 T1 S200\n") && code.contains("heating=hotend-1"));
    for other in ["M109 S200", "M109 T0 S200", "M104 T1 S200", "M109 T1 S210"] {
        let forged = code.replace("M109 T1 S200", other);
        assert!(findings_with(&build, SEAL, &forged).iter().any(|f| f.code == "stray-heat"), "{other}");
    }
    assert!(resume(&code, ResumeAt::Share(0.5), None).expect("resumed").text.contains("\nM109 T1 S200\n"));

    let with_heater = changed("klipper-printer", "heating = \"hotend\"", "heating = \"heater tip\"")
        .replacen("\"M104 S0\"", "\"SET_HEATER_TEMPERATURE HEATER=tip TARGET=0\"", 1);
    let build = built_for("klipper-printer", &with_heater);
    assert_eq!(read_back(&build.output_files()).findings, []);
    let code = text(&build, SEAL);
    let wait = "TEMPERATURE_WAIT SENSOR=\"heater_generic tip\" MINIMUM=198\n";
    let heating = format!("\nSET_HEATER_TEMPERATURE HEATER=tip TARGET=200\n{wait}");
    assert!(code.contains(&heating));
    for (old, new, finding) in [
        (wait, "", "cold-seal"),
        ("MINIMUM=198", "MINIMUM=150", "cold-seal"),
        ("HEATER=tip TARGET=200", "HEATER=bed TARGET=200", "cold-seal"),
        ("TARGET=200", "TARGET=300", "cold-seal"),
        ("TARGET=0", "TARGET=200", "profile-line"),
    ] {
        let findings = findings_with(&build, SEAL, &code.replacen(old, new, 1));
        assert!(findings.iter().any(|f| f.code == finding), "{new}: {findings:?}");
    }
    let rest = resume(&code, ResumeAt::Share(0.5), None).expect("resumed").text;
    assert!(rest.contains(&heating) && rest.matches("TEMPERATURE_WAIT").count() == 1);
}

/// A heater that the controller does not know, and one that stays on.
#[test]
fn wrong_heaters_are_refused() {
    let codes = |name: &str, heating: &str| {
        let text = changed(name, "heating = \"hotend\"", &format!("heating = \"{heating}\""));
        let read = stargrip_cam::spec::read_machine(&stargrip_cam::spec::Source::new("own", text));
        read.map(|_| ()).map_err(|faults| faults.list().iter().map(|fault| fault.code).collect::<Vec<_>>())
    };
    assert_eq!(codes("ender", "hotend 1"), Err(vec!["program-line"]));
    assert_eq!(codes("ender", "heater tip"), Err(vec!["conflict", "program-line"]));
    assert_eq!(codes("klipper-printer", "heater tip"), Err(vec!["program-line"]));
    for heating in
        ["hotend 10", "hotend one", "heater", "heater a b", "heater a=1", "oven", "heater abcdefghijklmnopq"]
    {
        assert_eq!(codes("klipper-printer", heating), Err(vec!["unknown-choice"]), "{heating}");
    }
}
