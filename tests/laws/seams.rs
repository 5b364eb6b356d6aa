//! Seams, inlet and plan: the starts of the iron, the closing of a loop, and the order of steps.

use std::f64::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;

use stargrip_cam::design::{Design, MOUTH_OVERRUN};
use stargrip_cam::geom::{Path, Point, Segment, Vec2};
use stargrip_cam::plan;
use stargrip_cam::plan::{Height, LONGEST_MOVE, Step};
use stargrip_cam::spec::{Spec, key};
use stargrip_cam::units::{Length, Temperature};

use crate::support;

fn paper(rest: &str) -> Spec {
    support::read(&format!("{}{rest}", support::PAPER))
}

fn design_of(spec: &Spec) -> Design {
    Design::new(spec, &support::machine()).expect("a gripper")
}

/// Along and across the ray of the inlet's tip, from the axis.
fn in_ray(p: Point, ray: f64) -> (f64, f64) {
    let v = p - Point::ORIGIN;
    (v.dot(Vec2::unit(ray)), v.dot(Vec2::unit(ray).perp()))
}

#[test]
fn the_inlet_is_a_channel_of_half_the_hoses_circumference() {
    let spec = paper("[inlet]\ntip = 3\ntube_diameter = \"6 mm\"\nlength = \"25 mm\"\n");
    let gripper = design_of(&spec);
    let part = &gripper.assembly().expect("stars").distinct[0];
    let (star, outer) = (&part.star, &part.shape.seams[1].center_line);
    let ray = star.tip_ray(3);
    assert!(!outer.closed);
    let (start, end) = (in_ray(outer.start().expect("one"), ray), in_ray(outer.end().expect("one"), ray));
    let mouth = star.tip_reach() + 25.0;
    let half = PI * 6.0 / 4.0 + 1.0;
    for (found, exact) in
        [(start.0, mouth + MOUTH_OVERRUN), (end.0, mouth + MOUTH_OVERRUN), (start.1, half), (end.1, -half)]
    {
        assert!((found - exact).abs() < 1e-9, "{found} {exact}");
    }
    // The cut is square across the mouth, band and flap to both sides of the channel.
    let corners: Vec<(f64, f64)> = part
        .outline
        .outside
        .segments
        .iter()
        .map(|segment| in_ray(segment.start(), ray))
        .filter(|(along, _)| (along - mouth).abs() < 1e-9)
        .collect();
    assert_eq!(corners.len(), 2);
    assert!(corners.iter().all(|(_, across)| (across.abs() - (half - 1.0 + 2.0 + 8.0)).abs() < 1e-9));
}

/// A fillet as large as the hose joins channel and arc without a corner, on the edge and on the centre line.
#[test]
fn a_fillet_is_tangent_on_both_ends() {
    let gripper = design_of(&paper("[inlet]\nfillet = \"4 mm\"\n"));
    let part = &gripper.assembly().expect("stars").distinct[0];
    for (path, radius) in [(&part.edges[1], 4.0), (&part.shape.seams[1].center_line, 3.0)] {
        let fillets: Vec<usize> = (0..path.segments.len())
            .filter(|i| matches!(path.segments[*i], Segment::Arc(arc) if (arc.radius - radius).abs() < 1e-9))
            .collect();
        assert_eq!(fillets.len(), 2);
        for i in fillets {
            let (before, middle, after) = (&path.segments[i - 1], &path.segments[i], &path.segments[i + 1]);
            for (a, b) in [(before, middle), (middle, after)] {
                assert!(a.end().distance(b.start()) < 1e-9);
                assert!(a.tangent(1.0).cross(b.tangent(0.0)).abs() < 1e-9, "a corner at a fillet");
                assert!(a.tangent(1.0).dot(b.tangent(0.0)) > 0.0);
            }
        }
    }
}

#[test]
fn an_inlet_that_is_too_wide_or_too_short_is_refused_with_its_numbers() {
    let refused = |rest: &str| Design::new(&paper(rest), &support::machine()).expect_err("refused");
    let wide = refused("[inlet]\ntube_diameter = \"45 mm\"\n");
    assert!(
        wide.iter().any(|r| r.code == "inlet-meets-arm" && r.key == key::inlet::TUBE_DIAMETER),
        "{wide:?}"
    );
    let short = refused("[inlet]\nlength = \"1 mm\"\n");
    assert!(
        short.iter().any(|r| r.code == "short-inlet" && r.found.contains("mm inside the flap")),
        "{short:?}"
    );
}

#[test]
fn what_bands_and_flaps_make_impossible_is_refused() {
    let refused = |rest: &str| Design::new(&paper(rest), &support::machine()).expect_err("refused");
    for (rest, code, key) in [
        ("[seal]\nband = \"45 mm\"\n", "band-eats-arm", "seal.band"),
        ("[seal]\nhole_allowance = \"48 mm\"\n", "hole-closed", "seal.hole_allowance"),
        ("[seal]\noverlap = \"500 mm\"\n", "long-overlap", "seal.overlap"),
        ("[sheet]\nhole_diameter = \"60 mm\"\n", "no-room-for-holes", "sheet.hole_diameter"),
        ("[sheet]\nwidth = \"300 mm\"\n", "sheet-too-small", "sheet.width"),
        ("[sheet]\nheight = \"300 mm\"\n", "sheet-too-small", "sheet.height"),
    ] {
        let refusals = refused(rest);
        assert!(refusals.iter().any(|r| r.code == code && r.key.to_string() == key), "{rest}: {refusals:?}");
    }
    // Both sides at once.
    let sheet = refused("[sheet]\nwidth = \"300 mm\"\nheight = \"300 mm\"\n")[0].clone();
    assert_eq!(sheet.remedy, "must be `width` at least 333.04 mm and `height` at least 336.437 mm");
}

/// A spec with the limit that a refusal names is not refused for it again.
#[test]
fn the_limit_that_is_named_will_do() {
    let number =
        |text: &str| text.split_whitespace().find_map(|word| word.parse::<f64>().ok()).expect("a number");
    for width in [29.1, 30.0, 30.3, 31.7, 33.3] {
        let spec = |rest: &str| {
            let mut spec = paper(rest);
            spec.stars[0].tube_width = Length(width);
            spec
        };
        for (key, rest) in [
            ("[sheet]\nwidth", "300"),
            ("[sheet]\nheight", "300"),
            ("[inlet]\nlength", "0.1"),
            ("[seal]\noverlap", "5000"),
            ("[seal]\nhole_allowance = \"8 mm\"\nband", "99"),
        ] {
            let with_value =
                |value: &str| Design::new(&spec(&format!("{key} = \"{value} mm\"\n")), &support::machine());
            let Err(refusals) = with_value(rest) else { continue };
            let first = refusals.iter().next().expect("a refusal");
            let remedy = first.remedy.rsplit(": ").next().expect("a text");
            // "above" and "below" leave the limit itself out.
            let limit = number(remedy) + if remedy.contains("above") { 1e-6 } else { 0.0 };
            let limit = if remedy.contains("below") { limit - 1e-6 } else { limit };
            let refusal = with_value(&limit.to_string()).err();
            let is_same_code = refusal.is_some_and(|refusal| refusal.iter().any(|r| r.code == first.code));
            assert!(!is_same_code, "{width}: {first}");
        }
    }
}

/// Several faults are reported at once.
#[test]
fn all_refusals_come_together() {
    let spec = paper("[seal]\nhole_allowance = \"48 mm\"\n[inlet]\nlength = \"1 mm\"\n");
    let mut codes: Vec<String> = Design::new(&spec, &support::machine())
        .expect_err("refused")
        .iter()
        .map(|r| r.code.to_string())
        .collect();
    codes.sort_unstable();
    assert_eq!(codes, ["hole-closed", "short-inlet"]);
}

#[test]
fn closed_loops_start_in_the_middle_of_opposite_arms() {
    let gripper = design_of(&paper("[inlet]\nnone = true\n"));
    let part = &gripper.assembly().expect("stars").distinct[0];
    let mut arms = Vec::new();
    for seam in &part.shape.seams {
        let path = &seam.center_line;
        assert!(path.closed);
        let (first, last) = (path.segments[0], path.segments[path.segments.len() - 1]);
        assert!(matches!((first, last), (Segment::Line(_), Segment::Line(_))));
        assert!((first.length() - last.length()).abs() < 1e-9, "not in the middle");
        arms.push(first.start());
    }
    let turn = arms[0].angle() - arms[1].angle();
    assert!(turn.cos() < 0.0, "the starts are on the same side of the star");
}

#[test]
fn an_overlap_longer_than_its_arm_goes_on_around_the_hinge() {
    let gripper = design_of(&paper("[seal]\noverlap = \"120 mm\"\n"));
    let part = &gripper.assembly().expect("stars").distinct[0];
    let inner = &part.shape.seams[0];
    let run = inner.run();
    assert!((run.length() - inner.center_line.length() - 120.0).abs() < 1e-9);
    let overlap = inner.center_line.part(0.0, 120.0);
    assert!(overlap.segments.len() > 2);
    assert!(run.end().expect("an end").distance(overlap.end().expect("an end")) < 1e-9);
}

/// Inner loop first; park, heat, and only then the fabric; every seam is reached on a ramp and left on one.
#[test]
fn the_program_does_things_in_order() {
    let (spec, machine) = (paper(""), support::machine());
    let design = design_of(&spec);
    let programs = plan::seal_programs(&spec, &machine, &design);
    assert_eq!(programs.len(), 1);
    let program = &programs[0];
    let words: Vec<&str> = program
        .steps
        .iter()
        .map(|step| match step {
            Step::Height(Height::Park) => "park",
            Step::Height(Height::Travel) => "height",
            Step::Heat(Temperature(t)) if *t == 200.0 => "heat",
            Step::Travel(_) => "travel",
            Step::Seam(0) => "inner",
            Step::Seam(1) => "outer",
            Step::TouchDown(_) => "down",
            Step::Seal(_) => "seal",
            Step::Lift(_) => "lift",
            _ => "?",
        })
        .collect();
    assert_eq!(
        words.join(" "),
        "park heat travel height inner down seal lift travel height outer down seal lift park travel"
    );
    assert_eq!(
        program.seams.iter().map(|seam| seam.name.seam.as_str()).collect::<Vec<_>>(),
        ["inner", "outer"]
    );
    let total: f64 = program.seams.iter().map(|seam| seam.time).sum();
    // Ramps of 3 mm and 5.3 mm height are 6.09 mm long in space; two of them a seam.
    let sealing: f64 = program.seams.iter().map(|seam| (seam.length + 2.0 * 3.0_f64.hypot(5.3)) / 0.1).sum();
    assert!((total - sealing).abs() < 1e-6 && program.time > total);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    /// Pieces are the path, cut up: short, at most a quarter turn each, without gaps.
    #[test]
    fn pieces_are_the_path_cut_up(shape in support::shapes()) {
        let Ok(design) = Design::new(&support::read(&shape.toml()), &support::machine()) else { return Ok(()) };
        for seam in &design.assembly().expect("stars").distinct[0].shape.seams {
            let run = seam.run();
            let pieces = plan::moves(&run, LONGEST_MOVE);
            for piece in &pieces {
                prop_assert!(piece.length() <= LONGEST_MOVE * (1.0 + 1e-9));
                if let Segment::Arc(arc) = piece {
                    prop_assert!(arc.sweep.abs() <= FRAC_PI_2 + 1e-9);
                }
            }
            let chain = Path::open(pieces);
            prop_assert!(chain.largest_gap() <= 1e-9 * design.assembly().expect("stars").distinct[0].star.tip_reach());
            prop_assert!((chain.length() - run.length()).abs() <= 1e-9 * run.length());
        }
    }

    /// Ramps begin and end where the seam does, and have the length of the machine's profile.
    #[test]
    fn ramps_join_the_seam(shape in support::shapes(), ramp in 0.1..20.0_f64) {
        let Ok(design) = Design::new(&support::read(&shape.toml()), &support::machine()) else { return Ok(()) };
        let size = design.assembly().expect("stars").distinct[0].star.tip_reach();
        for seam in &design.assembly().expect("stars").distinct[0].shape.seams {
            prop_assume!(seam.center_line.length() > 4.0 * ramp);
            let (run, down, up) = (seam.run(), seam.lead_in(ramp), seam.lead_out(ramp));
            for (a, b) in [(down.end(), run.start()), (run.end(), up.start())] {
                prop_assert!(a.expect("a point").distance(b.expect("a point")) <= 1e-9 * size);
            }
            prop_assert!((down.length() - ramp).abs() <= 1e-9 * size && (up.length() - ramp).abs() <= 1e-9 * size);
        }
    }
}
