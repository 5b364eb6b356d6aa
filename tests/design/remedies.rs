//! What a refusal advises works: the design with that value, or drawn as it says, is not refused for the same reason.

use std::fmt::Write;

use stargrip_cam::design::{Design, Refusal, RefusalCode, Refusals};
use stargrip_cam::pipeline::Designed;
use stargrip_cam::spec::{self, Source};

use crate::support;

const FOUR: &str = "schema = 1\nname = \"x\"\n[star]\npoints = 4\ninner_radius = \"40 mm\"\ntube_width = \"20 mm\"\n\
                    tip_angle = \"30 deg\"\n[inlet]\nlength = \"70 mm\"\n";

/// The design of a drawing with these groups, on a page whose lower left is X -50 and Y -50 of the drawing.
fn drawn(groups: &[(&str, &str)], rest: &str) -> Result<Design, Refusals> {
    let mut svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"300mm\" height=\"300mm\" \
                   viewBox=\"-50 -50 300 300\">"
        .to_owned();
    let mut layers = Vec::new();
    for (role, curves) in groups.iter().filter(|(_, curves)| !curves.is_empty()) {
        let _ = write!(svg, "<g id=\"{role}\">{curves}</g>");
        layers.push(format!("{role} = [\"{role}\"]"));
    }
    svg += "</svg>";
    let text = format!(
        "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = {{ {} }}\n{rest}",
        layers.join(", ")
    );
    let reading = spec::read(&Source::new("x", &text)).unwrap_or_else(|faults| panic!("{faults}"));
    Design::new(&reading.with_drawing(svg.as_bytes()).spec, &support::machine())
}

fn port(y: f64) -> String {
    format!("<line id=\"p\" x1=\"-4\" y1=\"{y}\" x2=\"4\" y2=\"{y}\"/>")
}

/// The one refusal.
fn only(refusals: &Refusals) -> Refusal {
    let [refusal] = refusals.iter().as_slice() else { panic!("{refusals}") };
    refusal.clone()
}

/// The number before `unit`, after `words`.
fn number(text: &str, words: &str) -> f64 {
    let (_, rest) = text.split_once(words).unwrap_or_else(|| panic!("{words}: {text}"));
    rest.split_whitespace().next().and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("{text}"))
}

fn star(text: &str) -> Result<Design, Refusals> {
    Design::new(&support::read(text), &support::machine())
}

#[test]
fn the_bed_that_is_named_has_room_for_all_pieces() {
    for bed in ["50 mm x 50 mm", "128.8 mm x 128.8 mm", "200 mm x 60 mm", "20 mm x 300 mm"] {
        let with = |bed: &str| star(&format!("{FOUR}[mask]\nbed = \"{bed}\"\n"));
        let refusal = only(&with(bed).expect_err("too small"));
        assert_eq!(refusal.code, RefusalCode::SmallBed);
        let enough = refusal.remedy.split('"').nth(1).expect("a bed");
        assert!(with(enough).is_ok(), "{bed}: {refusal}");
    }
}

#[test]
fn the_kerf_that_is_named_leaves_a_hole() {
    for hole in ["1.3 mm", "1.5 mm", "1.8 mm", "2 mm", "3 mm"] {
        let with = |kerf: &str| {
            star(&format!(
                "{}[sheet]\nhole_diameter = \"{hole}\"\n[cut]\nkerf = \"{kerf}\"\n",
                support::PAPER
            ))
        };
        let refusal = only(&with(hole).expect_err("no hole"));
        let most = refusal.remedy.strip_prefix("kerf must be at most ").expect("a kerf");
        assert!(with(most).is_ok(), "{hole}: {refusal}");
    }
}

#[test]
fn the_speed_that_is_named_is_fast_enough() {
    let text = support::PAPER.replace("50 mm", "2500 mm").replace("30 mm", "800 mm");
    let with = |rest: &str| {
        let spec = support::read(&format!("{text}{rest}"));
        Designed::new(spec, support::machine()).and_then(Designed::plan).map(|_| ())
    };
    let refusal = only(&with("").expect_err("too long"));
    assert_eq!(refusal.code, RefusalCode::JobTooLarge);
    let speed = number(&refusal.remedy, "a speed of at least ");
    let seal = |speed: f64| with(&format!("[seal]\nspeed = \"{speed} mm/s\"\n"));
    assert_eq!(seal(speed), Ok(()), "{refusal}");
    assert!(seal(0.99 * speed).is_err(), "{refusal}");
}

const CURVED: &str = "<path id=\"s1\" d=\"M0 70.62 C 31.6 0 47.42 92.29 57.89 47.62\"/>";

/// A curved weld of many arcs: its strips fell apart at some widths.
#[test]
fn paper_is_made_around_a_curved_weld_with_any_creep() {
    let air = "<rect id=\"a\" x=\"0\" y=\"0\" width=\"94.84\" height=\"92.29\"/>";
    let ports = format!("{}{}", port(14.93), port(65.31).replace("\"p\"", "\"q\""));
    let groups = [("air", air), ("seam", CURVED), ("port", ports.as_str())];
    let with = |creep: f64| {
        drawn(
            &groups,
            &format!("[seal]\nband = \"1 mm\"\n[mask]\nkind = \"separator\"\ncreep = \"{creep} mm\"\n"),
        )
    };
    for creep in (0_u32..=31).map(|i| 0.05 * f64::from(i)).chain([0.29, 0.305, 0.31]) {
        assert!(with(creep).is_ok(), "{creep}");
    }
    // The passage between the weld and the lower port closes.
    for creep in [1.58, 1.6, 2.0, 2.5] {
        let refusal = only(&with(creep).expect_err("a passage is closed"));
        let most = number(&refusal.remedy, "at most ");
        assert!((1.55..1.58).contains(&most) && with(most).is_ok(), "{creep}: {refusal}");
    }
}
