//! The lowest feed along a move: that of its worst direction, at any place in an arc.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;
use stargrip_cam::design::{Refusal, RefusalCode};
use stargrip_cam::geom::{Arc, Line, Point, Segment};
use stargrip_cam::plan::lowest_speed;
use stargrip_cam::spec::{Motion, StepRate};
use stargrip_cam::units::Speed;

use crate::{profile, spec_text, try_built};

/// Number of directions in the brute-force search.
const SAMPLES: u32 = 8_000;
/// GRBL's lowest step rate, steps/s.
const RATE: f64 = 30.52;

fn motion(steps: [f64; 3]) -> Motion {
    Motion { steps_per_mm: Some(steps), step_rate: StepRate::AtLeast(RATE), ..Motion::UNKNOWN }
}

/// The greatest of the lowest speeds of `SAMPLES` directions on the path, from the formula alone: the step rate over the steps per mm of
/// the axis with the most steps.
fn brute_force(steps: [f64; 3], piece: &Segment, rise: f64) -> f64 {
    let length = piece.length();
    let speed_at = |t: f64| {
        let u = piece.tangent(t);
        let way = [u.x * length, u.y * length, rise];
        let largest = steps.iter().zip(way).map(|(s, d)| s * d.abs()).fold(0.0, f64::max);
        RATE * length.hypot(rise) / largest
    };
    (0..=SAMPLES).map(|i| speed_at(f64::from(i) / f64::from(SAMPLES))).fold(0.0, f64::max)
}

fn steps() -> impl Strategy<Value = [f64; 3]> {
    ([60.0..240.0_f64, 60.0..240.0, 100.0..800.0])
        .prop_filter("different in X and Y", |[x, y, _]| (x - y).abs() > 20.0)
}

fn arc() -> impl Strategy<Value = Arc> {
    (0.5..80.0_f64, -PI..PI, prop_oneof![-6.2..-0.05, 0.05..6.2_f64])
        .prop_map(|(radius, start, sweep)| Arc::new(Point::new(120.0, 90.0), radius, start, sweep))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn it_is_that_of_the_worst_direction(steps in steps(), arc in arc(), climb in prop_oneof![Just(0.0), -1.0..1.0_f64]) {
        let piece = Segment::Arc(arc);
        let rise = climb * piece.length();
        let lowest = lowest_speed(&motion(steps), &piece, rise).expect("known");
        let sampled = brute_force(steps, &piece, rise);
        prop_assert!(lowest >= sampled * (1.0 - 1e-12), "{} of {}", lowest, sampled);
        // Beside the worst direction the speed falls by at most the greater ratio of the steps a radian.
        let ratio = (steps[0] / steps[1]).max(steps[1] / steps[0]);
        let missed = ratio * arc.sweep.abs() / f64::from(SAMPLES);
        prop_assert!(lowest <= sampled * (1.0 + missed), "{} of {}", lowest, sampled);
    }

    #[test]
    fn it_does_not_depend_on_the_way_round(steps in steps(), arc in arc(), climb in -1.0..1.0_f64) {
        let piece = Segment::Arc(arc);
        let rise = climb * piece.length();
        let forth = lowest_speed(&motion(steps), &piece, rise).expect("known");
        let back = lowest_speed(&motion(steps), &piece.reversed(), -rise).expect("known");
        prop_assert!((forth / back - 1.0).abs() < 1e-9, "{} and {}", forth, back);
    }
}

/// A short arc in each quadrant, at whose ends the controller can move more slowly than between them.
#[test]
fn the_worst_direction_within_a_short_arc_counts_in_every_quadrant() {
    let m = motion([80.0, 200.0, 400.0]);
    // X and Y step equally often where 80 cos = 200 sin.
    let even = 80.0_f64.atan2(200.0);
    let (_, fastest) = m.speed_range().expect("known");
    for direction in [even, PI - even, PI + even, -even] {
        for turn in [1.0, -1.0] {
            let arc = Arc::new(Point::ORIGIN, 10.0, direction - turn * (FRAC_PI_2 + 0.1), turn * 0.2);
            let lowest = lowest_speed(&m, &arc.into(), 0.0).expect("known");
            assert!((lowest / fastest - 1.0).abs() < 1e-12, "{direction} {turn}: {lowest} of {fastest}");
            // Beyond the worst direction only the end counts.
            let second_half = arc.part(0.6, 1.0);
            let end = lowest_speed(&m, &second_half.into(), 0.0).expect("known");
            assert!(
                end < 0.999 * fastest
                    && (end / brute_force([80.0, 200.0, 400.0], &second_half.into(), 0.0) - 1.0).abs()
                        < 1e-12
            );
        }
    }
    let circle = Arc::new(Point::ORIGIN, 10.0, 0.3, TAU).into();
    assert!((lowest_speed(&m, &circle, 0.0).expect("known") / fastest - 1.0).abs() < 1e-12);
}

#[test]
fn a_line_has_one_direction_and_what_is_unknown_stays_unknown() {
    let line = Line::new(Point::new(3.0, 4.0), Point::new(6.0, 8.0)).into();
    let lowest = lowest_speed(&motion([100.0, 100.0, 400.0]), &line, 0.0).expect("known");
    assert!((lowest - RATE / 80.0).abs() < 1e-12, "{lowest}");
    let steep = lowest_speed(&motion([100.0, 100.0, 400.0]), &line, -5.0).expect("known");
    assert!((steep - RATE * 50.0_f64.sqrt() / 2000.0).abs() < 1e-12, "{steep}");
    let arc = Arc::new(Point::ORIGIN, 10.0, 0.0, 3.0).into();
    for piece in [line, arc] {
        assert_eq!(lowest_speed(&Motion::UNKNOWN, &piece, 0.0), None);
        // A lowest feed in the profile holds for every direction.
        let feed_limited = Motion { step_rate: StepRate::NoLimit, min_feed: Speed(0.25), ..Motion::UNKNOWN };
        assert_eq!(lowest_speed(&feed_limited, &piece, 1.0), Some(0.25));
    }
}

/// The refusal of a seal at 0.1 mm/s by a machine with the lowest feed `feed` in every direction.
fn refused_at(feed: &str) -> Option<Refusal> {
    let slow =
        profile("reprapfirmware").replace("min_feed = \"5 mm/min\"", &format!("min_feed = \"{feed}\""));
    assert_ne!(slow, profile("reprapfirmware"));
    try_built(&spec_text(""), &slow).map(|_| ()).err().map(|refusals| refusals[0].clone())
}

#[test]
fn a_lowest_feed_in_every_direction_is_told_as_one_number() {
    let refusal = refused_at("30 mm/min").expect("too slow");
    assert_eq!(
        (refusal.code, refusal.found.as_str()),
        (RefusalCode::FeedFloor, "RepRapFirmware runs this at 0.50 mm/s instead of 0.1")
    );
    assert!(refusal.remedy.ends_with("or a speed of at least 0.50 mm/s"), "{}", refusal.remedy);
}

#[test]
fn a_machine_that_just_holds_the_speed_is_not_refused() {
    assert_eq!(refused_at("6 mm/min"), None);
    assert_eq!(refused_at("6.001 mm/min").map(|refusal| refusal.code), Some(RefusalCode::FeedFloor));
}

/// The refusal of GRBL's profile with `from` in it replaced by `to`, for a spec with this in it.
fn grbl_says(rest: &str, from: &str, to: &str) -> Option<Refusal> {
    let changed = profile("grbl").replace(from, to);
    assert_ne!(changed, profile("grbl"));
    try_built(&spec_text(rest), &changed).map(|_| ()).err().map(|refusals| refusals[0].clone())
}

/// The steps that are named are enough for the seal and for the ramps, on which Z steps, too.
#[test]
fn steps_that_are_advised_are_enough_for_all_axes() {
    for name in ["fluidnc", "marlin"] {
        let plain_profile = profile(name);
        let refusal = try_built(&spec_text(""), plain_profile).map(|_| ()).expect_err("too slow")[0].clone();
        assert_eq!(refusal.code, RefusalCode::FeedFloor, "{name}");
        let advised: Vec<(&str, &str)> = refusal
            .remedy
            .split(" and `z")
            .zip(["xy", "z"])
            .map(|(part, axes)| (axes, part.rsplit_once("steps_per_mm` of at least ").expect("steps").1))
            .map(|(axes, rest)| (axes, rest.split(' ').next().expect("a number")))
            .collect();
        let lines = plain_profile.lines().map(|line| {
            let is_key_of = |axis: char| line.starts_with(&format!("{axis}_steps_per_mm"));
            let steps = advised.iter().find(|(axes, _)| axes.chars().any(is_key_of)).map(|(_, steps)| *steps);
            steps.map_or(line.to_owned(), |steps| {
                line.split(" = ").next().expect("a key").to_owned() + " = " + steps
            })
        });
        let finer = lines.collect::<Vec<_>>().join("\n");
        assert_ne!(finer, plain_profile);
        let refusals = try_built(&spec_text(""), &finer).map(|_| ()).err();
        assert_eq!(refusals.map(|refusals| refusals[0].code), None, "{name}: {}", refusal.remedy);
    }
}

/// With few steps on Z, the XY motor steps more rarely in a ramp than in any move in the plane.
#[test]
fn the_speed_that_is_advised_is_one_that_ramps_hold_too() {
    let with_few_steps = |rest: &str| grbl_says(rest, "z_steps_per_mm = 400", "z_steps_per_mm = 20");
    let refusal = with_few_steps("").expect("too slow");
    assert_eq!(refusal.code, RefusalCode::FeedFloor);
    let advised =
        refusal.remedy.split("at least ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a number");
    let speed: f64 = advised.parse().expect("a number");
    // 3 mm of ramp for 5.3 mm of height; in the plane 0.54 mm/s would do.
    let slope = 3.0_f64.hypot(5.3) / 3.0;
    assert!(speed > 0.541 && speed < 0.5396 * slope + 0.005, "{}", refusal.remedy);
    let refusal_at = |speed: f64| with_few_steps(&format!("[seal]\nspeed = \"{speed:.3} mm/s\"\n"));
    assert_eq!(refusal_at(speed + 0.005), None);
    assert_eq!(refusal_at(speed - 0.01).map(|refusal| refusal.code), Some(RefusalCode::FeedFloor));
}

/// Strokes grow up to half a band to leave time for their dwells: 1 mm at 2 mm/s^2 takes 1.9 s from rest to rest, which is short enough at
/// 0.1 mm/s and too long at 0.53. At 0.1 mm/s^2 strokes must be so long that the rest after each leaves a scar.
#[test]
fn a_stroke_that_takes_too_long_is_refused_with_the_speed_that_works() {
    let refusal_at = |acceleration: f64, speed: f64| {
        let rest = format!("[seal]\nspeed = \"{speed} mm/s\"\n[machine]\nfeed_floor = \"chop\"\n");
        grbl_says(&rest, "acceleration = \"10 mm/s^2\"", &format!("acceleration = \"{acceleration} mm/s^2\""))
    };
    let scar = refusal_at(0.1, 0.1).expect("too slow");
    assert!(scar.code == RefusalCode::NoChop && scar.found.contains("rest for more than 2.00 s"), "{scar:?}");
    let slow = |speed: f64| refusal_at(2.0, speed);
    assert_eq!(slow(0.1), None);
    let refusal = slow(0.53).expect("too slow");
    assert_eq!((refusal.key, refusal.code), (stargrip_cam::spec::key::seal::SPEED, RefusalCode::NoChop));
    assert!(refusal.found.starts_with("a stroke of 1.000 mm at "), "{}", refusal.found);
    assert!(refusal.found.ends_with("with the shortest dwell, too long for 0.53 mm/s"), "{}", refusal.found);
    let advised = refusal.remedy.trim_start_matches("speed must be below ").trim_end_matches(" mm/s");
    let advised: f64 = advised.parse().expect("a number");
    assert!((0.1..0.53).contains(&advised), "{}", refusal.remedy);
    assert_eq!(slow(advised - 0.002), None);
    assert_eq!(slow(advised + 0.002).map(|refusal| refusal.code), Some(RefusalCode::NoChop));
}

/// Where the strokes are far too fast, no speed of the seal helps, but the profile's key that makes them so.
#[test]
fn strokes_that_are_too_fast_for_any_speed_are_told_with_the_key() {
    for (from, to, cause) in [
        ("_steps_per_mm = 80", "_steps_per_mm = 0.01", "more steps per mm"),
        ("min_feed = \"1 mm/min\"", "min_feed = \"900 mm/s\"", "a lower `min_feed`"),
        ("min_feed = \"1 mm/min\"", "chop_feed = \"900 mm/s\"", "a lower `chop_feed`"),
    ] {
        let refusal = grbl_says("[machine]\nfeed_floor = \"chop\"\n", from, to).expect("too fast");
        assert_eq!(
            (refusal.code, refusal.remedy),
            (RefusalCode::NoChop, format!("strokes must be slower: {cause} in the profile"))
        );
    }
}

/// Along an axis such a machine is slow enough.
#[test]
fn no_controller_runs_below_the_speed() {
    let refusal = grbl_says("", "_steps_per_mm = 80", "_steps_per_mm = 350").expect("too slow");
    assert_eq!(refusal.found, "at 350 steps/mm GRBL runs this at 0.10 to 0.12 mm/s instead of 0.1");
}

#[test]
fn unequal_steps_are_both_told() {
    let refusal = grbl_says("", "y_steps_per_mm = 80", "y_steps_per_mm = 100").expect("too slow");
    assert!(
        refusal.found.starts_with("at 80 (X) and 100 (Y) steps/mm GRBL runs this at 0.31 to 0.49 mm/s"),
        "{}",
        refusal.found
    );
}
