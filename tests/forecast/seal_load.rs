//! The load on the seal: its two limits, and its closed forms.

use crate::{case, close, design, paper};
use stargrip_cam::forecast::case::{Case, Hinges};
use stargrip_cam::forecast::seal_load::{
    Bursting, HingeSeal, LoadedHinge, SealLoad, burst, burst_range, factor, largest_pull, pull, safe_radius,
    seal_loads, tried_range,
};
use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::spec::Spec;
use stargrip_cam::units::Pressure;
use std::f64::consts::{FRAC_1_PI, PI};

/// Weak enough for the paper's star to be in need of round hinges at `pressure` Pa: 1 N/mm.
fn weak(pressure: f64) -> Case {
    Case { peel: on_both_loops(Some(1e3)), pressure: Some(pressure), ..case(&paper(5)) }
}

/// One strength for both loops, N/m.
fn on_both_loops(strength: Option<f64>) -> Hinges<Option<f64>> {
    Hinges { tip: strength, corner: strength }
}

/// Every strength times `factor`.
fn scaled(strengths: Hinges<Option<f64>>, factor: f64) -> Hinges<Option<f64>> {
    let Hinges { tip, corner } = strengths;
    Hinges { tip: tip.map(|t| t * factor), corner: corner.map(|t| t * factor) }
}

/// The paper's gripper with hinges as round as those of the shells that the pull was taken from.
fn round() -> Spec {
    let mut spec = paper(5);
    for star in &mut spec.stars {
        (star.tip_radius.0, star.corner_radius.0) = (2.0, 2.0);
    }
    spec
}

fn loads(spec: &Spec) -> Vec<SealLoad> {
    let design = design(spec);
    seal_loads(spec, &case(spec), &design.assembly().expect("stars").distinct[0])
}

fn at<'a>(loads: &'a [SealLoad], place: &str) -> &'a SealLoad {
    loads.iter().find(|load| load.place == place).expect("listed")
}

#[test]
fn between_a_sharp_corner_and_a_straight_tube_the_load_falls() {
    let k = |r_star: f64| factor(&Ring, r_star).expect("in range");
    let sizes: Vec<f64> = (-50..=40).map(|i| 10_f64.powf(f64::from(i) / 10.0)).collect();
    assert!(sizes.windows(2).all(|pair| k(pair[0]) > k(pair[1])));
    assert!(sizes.iter().all(|r_star| k(*r_star) > FRAC_1_PI));
    // Round: the straight tube's 1/pi, from which it differs as 1/R*.
    let excess = |r_star: f64| (k(r_star) - FRAC_1_PI) * r_star;
    close(excess(1e4), excess(1e3), 1e-2);
    // Sharp: T lambda / R* with the sharp hinge's own tension.
    let sharp = Ring.target(0.0).expect("solved");
    let limit = sharp.edges.expect("a ring has edges").tension * sharp.lambda;
    close(1e-5 * k(1e-5), limit, 1e-3);
    assert_eq!(factor(&Ring, 0.0), None, "infinite");
}

/// To the hundredth of a mm: the printed radius is safe, a hundredth less is not.
#[test]
fn the_safe_radius_is_the_least() {
    for pressure in [12e3, 20e3, 37e3, 60e3] {
        let case = weak(pressure);
        let width = case.mechanism.width;
        let safe = safe_radius(&case, LoadedHinge::Tip).expect("round enough").0;
        let load = |mm: f64| {
            let k = factor(&Ring, mm * 1e-3 / width).expect("in range");
            let [_, most] = tried_range(case.band / (mm * 1e-3));
            most * pull(&case, HingeSeal { hinge: LoadedHinge::Tip, radius: mm * 1e-3, k }, pressure)
        };
        assert!(load(safe) <= 1e3, "{safe} mm: {}", load(safe));
        // The whole range of the burst pressure lies above the pressure.
        let holds = |mm: f64| {
            let realised = Hinges { tip: 1e-3 * mm, corner: 0.3 };
            burst_range(&Case { realised, ..case }).expect("a seal")[0] >= pressure
        };
        assert!(holds(safe) && !holds(safe - 0.01), "{safe} mm");
        close((safe * 100.0).round(), safe * 100.0, 1e-12);
    }
}

#[test]
fn the_safe_radius_scales_with_the_star_and_depends_on_ratios_only() {
    let (case, factor) = (weak(37e3), 7.0);
    let mut same =
        Case { peel: scaled(case.peel, factor), pressure: case.pressure.map(|p| p * factor), ..case };
    same.sheet.young_modulus *= factor;
    let mut larger = Case { peel: scaled(case.peel, factor), band: factor * case.band, ..case };
    larger.mechanism.width *= factor;
    larger.sheet.thickness *= factor;
    let [own, same, larger] =
        [case, same, larger].map(|case| safe_radius(&case, LoadedHinge::Tip).expect("round enough").0);
    // Rounding may tip a hundredth.
    assert!((own - same).abs() < 0.011, "{own} {same}");
    // Each is rounded up to a hundredth.
    assert!((larger - factor * own).abs() <= factor * 0.01 + 1e-9, "{own} {larger}");
}

#[test]
fn without_pressure_or_strength_nothing_is_said_about_bursting() {
    let case = weak(37e3);
    assert_eq!(safe_radius(&Case { pressure: None, ..case }, LoadedHinge::Tip), None);
    assert_eq!(safe_radius(&Case { peel: on_both_loops(None), ..case }, LoadedHinge::Tip), None);
    assert_eq!(burst(&Case { peel: on_both_loops(None), ..case }, &Ring), None);
    let mut spec = paper(5);
    (spec.fabric.seal_strength, spec.load) = (None, None);
    for load in loads(&spec) {
        assert!(load.factor.is_none() && load.weakness().is_none(), "{load}");
        assert_eq!((load.load, load.burst, load.margin, load.safe_radius), (None, None, None, None));
    }
}

/// Arms and inlet are straight tubes: p W / pi, calculated for W = 30 mm, 37 kPa and 3 N/mm.
#[test]
fn a_straight_tube_pulls_with_its_radius_over_pi() {
    let loads = loads(&paper(5));
    let arms = at(&loads, "arms");
    assert_eq!(arms.radius, None);
    close(arms.factor.expect("a pressure"), FRAC_1_PI, 1e-12);
    close(arms.load.expect("a pressure").0, 0.037 * 30.0 / PI, 1e-12);
    close(arms.burst.expect("a strength").0, 3000.0 * PI / 30.0, 1e-12);
    close(arms.margin.expect("both"), 3000.0 * PI / 30.0 / 37.0, 1e-12);
    assert_eq!(
        arms.to_string(),
        "pull on the seal at the arms: 0.32 p W, 0.35 N/mm, bursts at 314.2 kPa, margin 8.49"
    );
    // A channel of other width bursts at another pressure, as 1/W.
    let part = design(&paper(5)).assembly().expect("stars").distinct[0].clone();
    let width = 2.0 * part.channel.expect("an inlet").half_width;
    close(at(&loads, "inlet").burst.expect("a strength").0, 3000.0 * PI / width, 1e-12);
    let mut shut = paper(5);
    shut.inlet = None;
    assert!(self::loads(&shut).iter().all(|load| load.place != "inlet"));
}

#[test]
fn the_star_bursts_at_its_sharpest_hinge() {
    for radii in [[2.0, 8.0], [8.0, 2.0]] {
        let mut spec = paper(5);
        for star in &mut spec.stars {
            (star.tip_radius.0, star.corner_radius.0) = (radii[0], radii[1]);
        }
        let loads = loads(&spec);
        let of = |place| at(&loads, place).burst.expect("a strength").0;
        assert_eq!(of("tips") < of("corners"), radii[0] < radii[1]);
        let whole = burst(&case(&spec), &Ring).expect("a strength") * 1e-3;
        close(whole, of("tips").min(of("corners")), 1e-12);
        close(at(&loads, "tips").radius.expect("curved").0, radii[0], 1e-12);
    }
}

#[test]
fn what_may_burst_is_warned_of_and_only_a_hinge_can_be_rounded() {
    let mut spec = round();
    let [sure, most] = burst_range(&case(&spec)).expect("known").map(|p| 1e-3 * p);
    let mut with = |kilopascals: f64| {
        spec.load.as_mut().expect("given").pressure = Some(Pressure(kilopascals));
        loads(&spec)
    };
    let below = with(sure * (1.0 - 1e-6));
    assert!(below.iter().all(|load| load.weakness().is_none() && load.safe_radius.is_none()));
    for (pressure, bursting, words) in [
        (sure * (1.0 + 1e-6), Bursting::Perhaps, "the seal may burst at the tips: "),
        (most * (1.0 - 1e-6), Bursting::Perhaps, "the seal may burst at the tips: "),
        (most * (1.0 + 1e-6), Bursting::Yes, "burst margin "),
    ] {
        let loads = with(pressure);
        let tips = at(&loads, "tips");
        let safe = tips.safe_radius.expect("a round hinge holds");
        assert_eq!(tips.bursting, Some(bursting));
        let weakness = tips.weakness().expect("weak");
        assert!(weakness.starts_with(words), "{weakness}");
        assert!(weakness.ends_with(&format!("; a radius of {safe} would hold")), "{weakness}");
        assert_eq!((at(&loads, "arms").weakness(), at(&loads, "arms").safe_radius), (None, None));
    }
    // Beyond the straight tube's own limit, 314 kPa, no radius helps, and none is named.
    let beyond = with(400.0);
    assert_eq!(
        at(&beyond, "arms").weakness(),
        Some("burst margin 0.78 at the arms; less pressure, a narrower tube or a stronger seal".to_owned())
    );
    assert!(beyond.iter().all(|load| load.safe_radius.is_none()));
}

/// Shells had 1/eps of 100 to 5000; at half as much again the range is as wide as it gets, and further out
/// there is none.
#[test]
fn the_range_of_the_pull_widens_with_the_distance() {
    let case = case(&round());
    let at = |bendability: f64| {
        let edge = case.sheet.bendability(1.0, case.mechanism.width);
        let (pull, range, _) =
            largest_pull(&Case { pressure: Some(bendability / edge), ..case }).expect("known");
        range.map(|range| range.map(|end| end / pull))
    };
    let [low, high] = at(5000.0).expect("tried");
    let [least, most] = tried_range(case.band / case.realised.tip.min(case.realised.corner));
    close(low, least, 1e-9);
    close(high, most, 1e-9);
    let all: Vec<[f64; 2]> = (0..=1000).map(|i| at(5000.0 + 2.499 * f64::from(i)).expect("near")).collect();
    let steps = all.windows(2).all(|pair| pair[1][0] <= pair[0][0] && pair[1][1] / pair[0][1] < 1.01);
    assert!(steps && all[1000][1] > 2.0 * high && at(7501.0).is_none(), "{all:?}");
}
