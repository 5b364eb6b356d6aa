//! The limit that a refusal names is where the refusal ends: a little beyond it is accepted, a little before it is not.

use std::f64::consts::PI;

use proptest::prelude::*;
use stargrip_cam::design::{Design, Refusal, RefusalCode, Star, shut_reach};
use stargrip_cam::spec::{KeyPath, Spec, key};
use stargrip_cam::units::{Angle, Length};

use crate::support;

/// One wrong value, and its refusal.
struct Limit {
    code: RefusalCode,
    key: KeyPath,
    /// The spec with this value.
    spec: fn(f64) -> String,
    wrong: f64,
}

fn paper(rest: &str) -> String {
    format!("{}{rest}", support::PAPER)
}

fn star(points: u32, radius: f64, width: f64, angle: f64) -> String {
    format!(
        "schema = 1\nname = \"x\"\n[star]\npoints = {points}\ninner_radius = \"{radius} mm\"\n\
         tube_width = \"{width} mm\"\ntip_angle = \"{angle} deg\"\n"
    )
}

const LIMITS: [Limit; 12] = [
    Limit {
        code: RefusalCode::StraightCorner,
        key: key::star::TIP_ANGLE,
        spec: |deg| star(5, 50.0, 30.0, deg),
        wrong: 120.0,
    },
    Limit {
        code: RefusalCode::HoleClosed,
        key: key::seal::HOLE_ALLOWANCE,
        spec: |mm| star(3, mm, 10.0, 30.0) + "[seal]\nhole_allowance = \"30 mm\"\n",
        wrong: 20.0,
    },
    Limit {
        code: RefusalCode::BandEatsArm,
        key: key::seal::BAND,
        spec: |mm| paper(&format!("[seal]\nband = \"{mm} mm\"\n")),
        wrong: 45.0,
    },
    Limit {
        code: RefusalCode::LongOverlap,
        key: key::seal::OVERLAP,
        spec: |mm| paper(&format!("[seal]\noverlap = \"{mm} mm\"\n")),
        wrong: 900.0,
    },
    Limit {
        code: RefusalCode::ShortInlet,
        key: key::inlet::LENGTH,
        spec: |mm| paper(&format!("[inlet]\nlength = \"{mm} mm\"\n")),
        wrong: 2.0,
    },
    Limit {
        code: RefusalCode::NoWindow,
        key: key::mask::CREEP,
        spec: |mm| paper(&format!("[mask]\nextent = \"15 mm\"\ncreep = \"{mm} mm\"\n")),
        wrong: 40.0,
    },
    Limit {
        code: RefusalCode::NoWindow,
        key: key::mask::CREEP,
        spec: |mm| paper(&format!("[mask]\nextent = \"60 mm\"\ncreep = \"{mm} mm\"\n")),
        wrong: 40.0,
    },
    Limit {
        code: RefusalCode::LongExtent,
        key: key::mask::EXTENT,
        spec: |mm| paper(&format!("[mask]\nextent = \"{mm} mm\"\n")),
        wrong: 150.0,
    },
    Limit {
        code: RefusalCode::ThinRim,
        key: key::mask::BORDER,
        spec: |mm| paper(&format!("[seal]\nallowance = \"0 mm\"\n[mask]\nborder = \"{mm} mm\"\n")),
        wrong: 0.0,
    },
    Limit {
        code: RefusalCode::SheetTooSmall,
        key: key::sheet::WIDTH,
        spec: |mm| paper(&format!("[sheet]\nturn = false\nwidth = \"{mm} mm\"\nheight = \"400 mm\"\n")),
        wrong: 100.0,
    },
    Limit {
        code: RefusalCode::SheetTooSmall,
        key: key::sheet::HEIGHT,
        spec: |mm| paper(&format!("[sheet]\nturn = false\nwidth = \"400 mm\"\nheight = \"{mm} mm\"\n")),
        wrong: 100.0,
    },
    Limit {
        code: RefusalCode::TubeBetweenPlates,
        key: key::stack::PITCH,
        spec: |mm| paper(&format!("[stack]\ncount = 2\npitch = \"{mm} mm\"\n")),
        wrong: 5.0,
    },
];

/// The refusals of `code` of the design of `text`.
fn refused(text: &str, code: RefusalCode) -> Vec<Refusal> {
    match Design::new(&support::read(text), &support::machine()) {
        Ok(_) => Vec::new(),
        Err(refusals) => refusals.iter().filter(|refusal| refusal.code == code).cloned().collect(),
    }
}

/// The last number with a unit of the first change.
fn number(remedy: &str) -> f64 {
    let remedy = remedy.split("; or alone").next().expect("a change");
    let words: Vec<&str> = remedy.split([' ', ',', ';', ':']).collect();
    let with_unit = words.windows(2).rev().find(|pair| ["mm", "deg"].contains(&pair[1]));
    with_unit.and_then(|pair| pair[0].parse().ok()).expect("a number with a unit")
}

#[test]
fn the_limit_that_is_named_is_where_it_ends() {
    for Limit { code, key, spec, wrong } in LIMITS {
        let refusals = refused(&spec(wrong), code);
        assert!(refusals.iter().any(|refusal| refusal.key.key() == key.key()), "{code:?}: {refusals:?}");
        // Where two parts of a star limit one value, the stricter limit counts.
        let limits = refusals.iter().map(|refusal| number(&refusal.remedy));
        let smallest = limits.clone().fold(f64::INFINITY, f64::min);
        let limit = if wrong > smallest { smallest } else { limits.fold(0.0, f64::max) };
        // Six digits are printed, and some limits are whole hundredths.
        let little = (1e-5 * limit).max(0.0101) * (wrong - limit).signum();
        assert_eq!(refused(&spec(limit - little), code), [], "{code:?}: {limit}");
        assert!(!refused(&spec(limit + little), code).is_empty(), "{code:?}: {limit} is no limit");
    }
}

/// A spec of one star, whose arms may have no length, or less than the band needs.
fn any_star() -> impl Strategy<Value = String> {
    let radius = || prop_oneof![Just(0.0), 0.1..30.0_f64];
    (3_u32..=20, 5.0..100.0_f64, 5.0..100.0_f64, 3.0..100.0_f64, radius(), radius(), 0.2..30.0_f64).prop_map(
        |(points, rho, width, angle, tip, corner, band)| {
            format!(
                "{}tip_radius = \"{tip} mm\"\ncorner_radius = \"{corner} mm\"\n[seal]\nband = \"{band} mm\"\n",
                star(points, rho, width, angle.min(179.0 - 360.0 / f64::from(points)))
            )
        },
    )
}

/// `spec` with one change of a remedy: "tube_width below 27.4 mm".
fn with_change(spec: &Spec, change: &str) -> Spec {
    let mut spec = spec.clone();
    let name = change.split(' ').next().expect("a key");
    let value = change.split(' ').find_map(|word| word.parse::<f64>().ok()).expect("a number");
    let star = &mut spec.stars[0];
    match name {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "3 to 64")]
        "points" => star.points = value as u32,
        "inner_radius" => star.inner_radius = Length(value),
        "tube_width" => star.tube_width = Length(value),
        "tip_angle" => star.tip_angle = Angle(value),
        "tip_radius" => star.tip_radius = Length(value),
        "corner_radius" => star.corner_radius = Length(value),
        "band" => spec.seal.band = Length(value),
        _ => panic!("{change}"),
    }
    spec
}

proptest! {
    /// Each change that is named for a star without arms, or whose band needs more than there is, mends both faults.
    #[test]
    fn every_change_that_is_named_gives_arms_to_the_band(text in any_star()) {
        let spec = support::read(&text);
        let armless = |spec: &Spec| -> Vec<Refusal> {
            let Err(refusals) = Design::new(spec, &support::machine()) else { return Vec::new() };
            let is_armless = |code| matches!(code, RefusalCode::NoArm | RefusalCode::BandEatsArm);
            refusals.iter().filter(|refusal| is_armless(refusal.code)).cloned().collect()
        };
        for refusal in armless(&spec) {
            let changes = refusal.remedy.strip_prefix("must be: ").expect("single changes");
            let changes: Vec<&str> = changes.split("; or alone: ").flat_map(|some| some.split(", or ")).collect();
            prop_assert!(changes.iter().any(|change| change.starts_with("inner_radius above ")), "{}", refusal);
            for change in changes {
                prop_assert_eq!(armless(&with_change(&spec, change)), vec![], "{} of {}", change, refusal);
            }
        }
    }
}

/// Adding the reported missing room makes the machine large enough, to the tenth that is printed.
#[test]
fn what_a_machine_lacks_is_said() {
    let refused = |side: f64| {
        let mut machine = support::machine();
        machine.bench.work_area = Some((Length(side), Length(side)));
        match Design::new(&support::read(support::PAPER), &machine) {
            Ok(_) => None,
            Err(refusals) => refusals.iter().find(|refusal| refusal.code == RefusalCode::OutOfReach).cloned(),
        }
    };
    let refusal = refused(200.0).expect("too small");
    assert_eq!(refusal.key.key(), key::machine::PROFILE.key());
    let missing: f64 = refusal.remedy.split(' ').next().and_then(|word| word.parse().ok()).expect("a number");
    assert_eq!(refused(200.0 + missing), None);
    assert!(refused(200.0 + missing - 0.1001).is_some(), "{refusal}");
    // Less than two margins: no size is stated that the missing millimetres do not belong to.
    let tiny = refused(5.0).expect("too small");
    assert!(tiny.found.contains("the margins leave nothing of what"), "{tiny}");
    let missing: f64 = tiny.remedy.split(' ').next().and_then(|word| word.parse().ok()).expect("a number");
    assert_eq!(refused(5.0 + missing), None);
}

/// The figures of a refusal, calculated separately for the paper's star (50 mm, 30 mm, 30 deg, sharp).
#[test]
fn what_was_found_is_worked_out_by_hand() {
    let finding = |text: &str, code| refused(text, code).remove(0).found;
    // 45 / 2 mm of band take 22.5 / tan(15 deg) of an arm of 69.72 mm.
    assert_eq!(
        finding(&paper("[seal]\nband = \"45 mm\"\n"), RefusalCode::BandEatsArm),
        "at the tips a band of 45 mm takes 83.9711 mm of arms that are 69.7207 mm long"
    );
    // A hose of 40 mm is pi 40 / 2 wide when flat, with band and allowance, 10 mm, on either side, and the cut is 40 mm
    // round at the tip; without fillets a thinner hose is stopped where the arms begin, 2 x 40 sin(75 deg) apart.
    assert_eq!(
        finding(&paper("[inlet]\ntube_diameter = \"40 mm\"\n"), RefusalCode::InletMeetsArm),
        "the channel with the strips along it would be 82.8319 mm wide and meet an arm, where tip 1 leaves 80 mm"
    );
    assert_eq!(
        finding(
            &paper("[inlet]\ntube_diameter = \"37.5 mm\"\nfillet = \"0 mm\"\n"),
            RefusalCode::InletMeetsArm
        ),
        "the channel with the strips along it would be 78.9049 mm wide and meet an arm, where tip 1 leaves 77.2741 mm"
    );
    // The limit is the mouth's length plus the missing length.
    let short = refused(&paper("[inlet]\nlength = \"2 mm\"\n"), RefusalCode::ShortInlet);
    for refusal in short {
        let lengths: Vec<f64> = refusal.found.split(' ').filter_map(|word| word.parse().ok()).collect();
        assert!((2.0 + lengths[0] - number(&refusal.remedy)).abs() < 1e-4, "{refusal}");
    }
}

/// With h half the angle of the corner's arc, c the length of arm in the window, H and q the radii of its two sides: sectors,
/// strips, and where q < 0 without the part beyond the vertex.
#[test]
fn a_window_has_the_area_of_its_parts() {
    for (radius, band, creep) in [(12.0, 2.0, 0.0), (12.0, 2.0, 0.5), (0.0, 2.0, 0.0), (1.0, 4.0, 0.25)] {
        let text = paper(&format!(
            "corner_radius = \"{radius} mm\"\n[seal]\nband = \"{band} mm\"\nhole_allowance = \"3 mm\"\n\
             [mask]\nextent = \"45 mm\"\ncreep = \"{creep} mm\"\n"
        ));
        let design = Design::new(&support::read(&text), &support::machine()).expect("makeable");
        let part = &design.assembly().expect("stars").distinct[0];
        let half = (PI - part.star.phi_e) / 2.0;
        let (hole, q) = (radius + 30.0 + band + 3.0 - creep, radius - band + creep);
        let arm = 45.0 - (radius + 30.0) * half - creep;
        assert!(arm > 0.0);
        let slope = if q > 0.0 { half } else { half.tan() };
        let exact = half * hole * hole - slope * q * q + 2.0 * arm * (hole - q);
        let area = part.mask.window_area();
        assert!((area / exact - 1.0).abs() < 1e-12, "{radius} {band} {creep}: {area} {exact}");
    }
}

/// Shut, a star is one whose tubes are 2 W / pi wide and whose tips have no angle, with the same arms.
#[test]
fn a_shut_star_reaches_as_far_as_a_thin_one_without_an_angle() {
    for (points, tip, corner) in [(5, 0.0, 0.0), (4, 2.0, 0.0), (6, 1.0, 3.0)] {
        let mut spec = support::read(support::PAPER).stars.remove(0);
        (spec.points, spec.tip_radius, spec.corner_radius) = (points, Length(tip), Length(corner));
        let star = Star::new(&spec).expect("makeable");
        let width = 2.0 * 30.0 / PI;
        (spec.tube_width, spec.tip_angle) = (Length(width), Angle(0.01));
        let half = (spec.tip_angle.0 / 2.0).to_radians();
        let width_at_tip = star.l * half.sin() + (width + tip + corner) * half.cos();
        spec.inner_radius = Length(width_at_tip / (PI / f64::from(points)).sin() - width - corner);
        let thin = Star::new(&spec).expect("makeable");
        assert!((thin.l - star.l).abs() < 1e-6 * star.l);
        let (shut, reach) = (shut_reach(&star), thin.tip_reach());
        assert!((shut / reach - 1.0).abs() < 1e-4, "{points}: {shut} {reach}");
    }
}
