//! What a refusal advises works: the design with that value, or drawn as it says, is not refused for the same reason.

use std::fmt::Write;

use stargrip_cam::design::{Design, Refusal, RefusalCode, Refusals};
use stargrip_cam::pipeline::Planned;
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

const SQUARE: &str = "<path id=\"a\" d=\"M0 0h100v100h-100z\"/>";

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

/// Masks for a bed, of stars of four points in the given `[stack]`.
fn masks_on(bed: &str, stack: &str) -> Result<Design, Refusals> {
    star(&format!("{FOUR}[mask]\nbed = \"{bed}\"\n{stack}"))
}

#[test]
fn the_bed_that_is_named_has_room_for_all_pieces() {
    let beds = ["50 mm x 50 mm", "128.8 mm x 128.8 mm", "200 mm x 60 mm", "20 mm x 300 mm"];
    // One refusal for masks of stars that differ, too.
    let stars = "[stack]\ncount = 3\n[[stack.star]]\nindex = 2\ninner_radius = \"41 mm\"\n";
    for (bed, stack) in beds.into_iter().flat_map(|bed| [(bed, ""), (bed, stars)]) {
        let refusal = only(&masks_on(bed, stack).expect_err("too small"));
        assert_eq!(refusal.code, RefusalCode::SmallBed);
        let enough = refusal.remedy.split('"').nth(1).expect("a bed");
        assert!(masks_on(enough, stack).is_ok(), "{bed}: {refusal}");
    }
}

/// Stars of a stack that differ, and stars that may be turned on the sheet.
#[test]
fn the_sheet_that_is_named_takes_all_parts() {
    let stack = "[stack]\ncount = 2\n[[stack.star]]\nindex = 1\ninner_radius = \"25 mm\"\n";
    for (sheet, sides) in [
        ("width = \"100 mm\"", 1),
        ("width = \"100 mm\"\nheight = \"120 mm\"", 2),
        ("width = \"240 mm\"\nheight = \"120 mm\"\nturn = true", 2),
    ] {
        let with = |sheet: &str| star(&format!("{FOUR}{stack}[sheet]\n{sheet}\n"));
        let refusal = only(&with(sheet).expect_err("too small"));
        assert_eq!(refusal.code, RefusalCode::SheetTooSmall);
        let mut enough = sheet.to_owned();
        for (key, now) in [("width", "100 mm"), ("width", "240 mm"), ("height", "120 mm")] {
            if refusal.remedy.contains(&format!("`{key}`")) {
                let least = number(&refusal.remedy, &format!("`{key}` at least "));
                enough = enough.replace(&format!("{key} = \"{now}\""), &format!("{key} = \"{least} mm\""));
            }
        }
        assert_eq!(refusal.remedy.matches("at least").count(), sides, "{refusal}");
        assert!(with(&enough).is_ok(), "{sheet}: {refusal}");
    }
}

/// Inlets in all directions, and one wide hose.
#[test]
fn the_posts_that_are_named_let_hoses_pass() {
    let text = "schema = 1\nname = \"x\"\n[star]\npoints = 4\ninner_radius = \"20 mm\"\ntube_width = \"12 mm\"\n\
                tip_angle = \"50 deg\"\n";
    let with = |count: u32, rotation: u32, posts: u32| {
        star(&format!(
            "{text}[stack]\ncount = {count}\nrotation = \"{rotation} deg\"\n[frame]\nposts = {posts}\n"
        ))
    };
    for (count, rotation, posts, fewer) in [(4, 30, 3, false), (1, 0, 64, true)] {
        let refusal = only(&with(count, rotation, posts).expect_err("in the way"));
        assert_eq!(refusal.code, RefusalCode::PostMeetsHose, "{refusal}");
        let remedy = refusal.remedy.as_str();
        assert_eq!(remedy.contains("make posts"), fewer, "{refusal}");
        let named = if remedy.contains("make posts") { whole(remedy) } else { posts };
        if fewer {
            assert!(
                with(count, rotation, named).is_ok() && with(count, rotation, named + 1).is_err(),
                "{refusal}"
            );
        }
        if remedy.contains("in line") {
            assert!(with(count, 0, named).is_ok(), "{refusal}");
        }
    }
}

/// The number of posts that a remedy names.
fn whole(remedy: &str) -> u32 {
    let word = remedy.split("make posts ").nth(1).and_then(|rest| rest.split([' ', ',']).next());
    word.and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("{remedy}"))
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
        Planned::new(spec, support::machine()).map(|_| ())
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

/// The edge at the port is an arc, and has more room than the hose needs.
#[test]
fn a_port_on_a_bend_is_told_how_far_the_edge_falls_back() {
    let air = "<rect id=\"a\" x=\"0\" y=\"0\" width=\"100\" height=\"100\" rx=\"10\"/>";
    let with = |y: f64| drawn(&[("air", air), ("port", &port(y))], "");
    let refusal = only(&with(3.15).expect_err("beside the corner"));
    assert_eq!(refusal.code, RefusalCode::PortTooWide);
    let (found, allowed) = (number(&refusal.found, "falls back by "), number(&refusal.remedy, "at most "));
    assert!(found > allowed, "{refusal}");
    // The place is on the arc: 10 - sqrt(10^2 - 6.85^2) from the edge's line.
    let at = refusal.drawn.as_ref().and_then(|place| place.at).expect("a place");
    assert!((at[0] - 52.715).abs() < 1e-3 && (at[1] - 246.85).abs() < 1e-3, "{at:?}");
    assert!(with(3.3).is_ok());
}

#[test]
fn a_port_at_the_end_of_a_weld_is_told_its_distance() {
    // The end lies on the air's edge, or on the middle of the band around it.
    for (end, most) in [(0, 4.0), (-1, 3.0)] {
        let seam = format!("<path id=\"s\" d=\"M{end} 50H60\"/>");
        let with = |far: f64| drawn(&[("air", SQUARE), ("seam", &seam), ("port", &port(50.0 + far))], "");
        for far in [0.5, 2.0, most] {
            let refusal = only(&with(far).expect_err("too near"));
            assert_eq!(refusal.code, RefusalCode::BandsOverlap, "{refusal}");
            // The port is to be moved, not the band made narrower.
            assert_eq!(refusal.key.to_string(), "drawing.layers");
            let found = format!("port 'p' lies {far:.3} mm from the end of 's'");
            assert!(refusal.found.starts_with(&found), "{refusal}");
            assert!(with(number(&refusal.remedy, "at least ")).is_ok(), "{refusal}");
        }
    }
}

#[test]
fn a_cut_at_a_port_is_told_its_distance_from_the_edge() {
    let with = |out: f64| {
        let cut =
            format!("<rect id=\"c\" x=\"{}\" y=\"-12\" width=\"{}\" height=\"124\"/>", -out, 122.0 + out);
        drawn(&[("air", SQUARE), ("port", &port(50.0)), ("cut", &cut)], "")
    };
    let refusal = only(&with(4.0).expect_err("too near"));
    assert_eq!(refusal.code, RefusalCode::CutInBand);
    let least = number(&refusal.remedy, "at port 'p' it must lie at least ");
    assert!((least - 4.182).abs() < 1e-9, "{refusal}");
    assert!(with(least).is_ok() && with(least - 0.01).is_err());
}

#[test]
fn a_hole_keeps_a_band_from_its_island() {
    let air =
        "<circle id=\"a\" cx=\"50\" cy=\"50\" r=\"50\"/><circle id=\"i\" cx=\"50\" cy=\"50\" r=\"30\"/>";
    let with = |radius: f64| {
        let hole = format!("<circle id=\"h\" cx=\"50\" cy=\"50\" r=\"{radius}\"/>");
        drawn(&[("air", air), ("port", &port(50.0)), ("hole", &hole)], "")
    };
    for (radius, found) in [(30.0, "'h' lies on the edge of the air"), (40.0, "'h' lies in the air")] {
        let refusal = only(&with(radius).expect_err("no band around it"));
        assert!(refusal.found.starts_with(found), "{refusal}");
        let band = number(&refusal.remedy, "whose edge keeps ");
        assert!(with(30.0 - band).is_ok() && with(30.01 - band).is_err(), "{refusal}");
    }
}
