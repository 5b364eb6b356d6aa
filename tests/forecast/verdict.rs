//! Whether an object is held: the verdict and the reasons.

use crate::{gripper, predict};
use stargrip_cam::forecast::verdict::{Holds, Verdict, refusals, verdict};
use stargrip_cam::spec::{Code, Spec};
use stargrip_cam::units::{Force, Length, LineForce, Mass, Pressure};

fn judged(change: impl Fn(&mut Spec)) -> Verdict {
    let mut spec = gripper(5);
    // Strong enough for all that follows.
    spec.fabric.seal_strength = Some(LineForce(60.0));
    change(&mut spec);
    let prediction = predict(&spec);
    let found = verdict(&spec, &prediction).expect("an object and a pressure");
    assert_eq!(prediction.verdict.as_ref(), Some(&found));
    found
}

fn with_mass(kilograms: f64) -> Verdict {
    judged(|spec| spec.load.as_mut().expect("given").mass = Some(Mass(kilograms)))
}

#[test]
fn without_an_object_there_is_no_verdict() {
    let mut spec = gripper(5);
    spec.load.as_mut().expect("given").object_radius = None;
    assert_eq!(predict(&spec).verdict, None);
    spec.load = None;
    assert_eq!(predict(&spec).verdict, None);
}

#[test]
fn what_cannot_be_is_refuted_with_its_reason() {
    type Change = fn(&mut Spec);
    let cases: [(Change, &str); 4] = [
        (|spec| spec.load.as_mut().expect("given").object_radius = Some(Length(5.0)), "do not reach it"),
        (|spec| spec.load.as_mut().expect("given").object_radius = Some(Length(51.0)), "does not enter"),
        (|spec| spec.fabric.seal_strength.as_mut().expect("given").0 = 0.1, "to burst at"),
        (|spec| spec.load.as_mut().expect("given").mass = Some(Mass(1e3)), "friction needs"),
    ];
    for (change, why) in cases {
        let found = judged(change);
        assert_eq!(found.holds, Holds::No, "{why}: {found:?}");
        assert!(found.reasons.iter().any(|reason| reason.contains(why)), "{why}: {found:?}");
    }
}

#[test]
fn a_light_object_is_held_and_one_that_breaks_is_not() {
    let light = with_mass(0.01);
    assert_eq!(light.holds, Holds::Yes, "{light:?}");
    let (needed, [least, _]) =
        (light.needed_N.expect("a mass and friction"), light.force_range_N.expect("a range"));
    assert!(needed < 0.2 && needed < least, "{light:?}");
    let fragile = judged(|spec| spec.load.as_mut().expect("given").largest_force = Some(Force(0.01)));
    assert!(
        fragile.holds != Holds::Yes && fragile.reasons.iter().any(|why| why.contains("bears")),
        "{fragile:?}"
    );
}

#[test]
fn where_nothing_is_known_it_may_hold() {
    let found = judged(|spec| spec.load.as_mut().expect("given").pressure = Some(Pressure(200.0)));
    assert_eq!((found.holds, found.force_N), (Holds::Unknown, None));
    assert!(found.line().starts_with("may hold"), "{}", found.line());
    assert_eq!(found.code, Some("outside-models"));
}

/// More mass never makes a gripper hold that did not hold less, and `holds` comes before `may hold` before `does not hold`.
#[test]
fn verdicts_are_monotone_in_mass() {
    let rank = |kilograms: f64| match with_mass(kilograms) {
        Verdict { holds: Holds::Yes, code: None, .. } => 0,
        Verdict { holds: Holds::Unknown, code: Some("may-not-hold"), .. } => 1,
        Verdict { holds: Holds::No, code: Some("too-heavy"), .. } => 2,
        other => panic!("{kilograms} kg: {other:?}"),
    };
    let ranks: Vec<i32> = (0..60).map(|k| rank(0.05 * 1.12_f64.powi(k))).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] <= pair[1]), "{ranks:?}");
    assert!([0, 1, 2].iter().all(|rank| ranks.contains(rank)), "{ranks:?}");
}

/// The payload's range is that of the force at the two ends of the friction's, and the verdict follows it.
#[test]
fn an_uncertain_friction_widens_the_payload_and_the_verdict() {
    let with = |least: Option<f64>, most: Option<f64>, kilograms: f64| {
        let mut spec = gripper(5);
        spec.fabric.seal_strength = Some(LineForce(60.0));
        let load = spec.load.as_mut().expect("given");
        (load.friction, load.friction_least, load.friction_most) = (Some(0.3), least, most);
        load.mass = Some(Mass(kilograms));
        predict(&spec)
    };
    let exact = with(None, None, 1.0).first.ranges.payload_kg.expect("known");
    let wide = with(Some(0.2), Some(0.42), 1.0).first;
    let found = wide.ranges.payload_kg.expect("known");
    assert!((found[0] / exact[0] - 0.2 / 0.3).abs() < 1e-12 && (found[1] / exact[1] - 1.4).abs() < 1e-12);
    let holds = |least, most, kilograms| with(least, most, kilograms).verdict.expect("an object").holds;
    for (kilograms, sure, unsure) in [
        (0.99 * found[0], Holds::Yes, Holds::Yes),
        (1.01 * found[0], Holds::Yes, Holds::Unknown),
        (1.01 * exact[1], Holds::No, Holds::Unknown),
        (1.01 * found[1], Holds::No, Holds::No),
    ] {
        assert_eq!(holds(None, None, kilograms), sure, "{kilograms}");
        assert_eq!(holds(Some(0.2), Some(0.42), kilograms), unsure, "{kilograms}");
        // Ends on the wrong side of the friction itself say nothing.
        assert_eq!(holds(Some(0.4), Some(0.2), kilograms), sure, "{kilograms}");
    }
}

#[test]
fn what_is_proposed_for_too_much_mass_holds() {
    let mut spec = gripper(5);
    spec.fabric.seal_strength = Some(LineForce(60.0));
    let mut refused = |kilograms: f64, friction: f64| {
        let load = spec.load.as_mut().expect("given");
        (load.mass, load.friction) = (Some(Mass(kilograms)), Some(friction));
        let prediction = predict(&spec);
        (refusals(&spec, &prediction), verdict(&spec, &prediction).expect("an object").holds)
    };
    let number = |text: &str, after: &str| -> f64 {
        let rest = text.split_once(after).unwrap_or_else(|| panic!("{text}")).1;
        let number = rest.trim_start().split([' ', ':', ';']).next().unwrap_or_default();
        number.parse().unwrap_or_else(|_| panic!("{text}"))
    };
    // Twice the certain payload, with little friction: coated corners are a remedy.
    let (found, _) = refused(12.0, 0.3);
    let [only] = &found[..] else { panic!("{found:?}") };
    assert_eq!((only.code.as_str(), only.key.to_string()), ("too-heavy", "load.mass".to_owned()));
    let mass = number(&only.remedy, "a mass of at most");
    assert_eq!(refused(mass, 0.3), (vec![], Holds::Yes), "{}", only.remedy);
    let (found, _) = refused(3.0 * mass, 0.2);
    let remedy = &found.first().expect("too heavy").remedy;
    let friction = number(remedy, "a friction of at least");
    assert!(remedy.contains("silicone") && friction < 1.1, "{remedy}");
    assert_eq!(refused(3.0 * mass, friction), (vec![], Holds::Yes), "{remedy}");
    // No coating helps against a hundred kilograms.
    let (found, _) = refused(1e3, 0.3);
    assert!(!found.first().expect("too heavy").remedy.contains("friction"), "{found:?}");
}

#[test]
fn a_star_that_breaks_its_object_is_refused_by_each_star_s_force() {
    let with = |newtons: f64| {
        let mut spec = gripper(5);
        spec.fabric.seal_strength = Some(LineForce(60.0));
        spec.load.as_mut().expect("given").largest_force = Some(Force(newtons));
        let prediction = predict(&spec);
        let verdict = verdict(&spec, &prediction).expect("an object");
        (refusals(&spec, &prediction), verdict)
    };
    let (_, free) = with(1e3);
    let [low, high] = free.star_force_range_N.expect("known");
    assert!(free.force_N > free.star_force_N && free.one_star().is_some_and(|text| text.contains("1000 N")));
    let (found, verdict) = with(0.9 * low);
    assert_eq!((found.len(), verdict.code, verdict.holds), (1, Some("too-hard"), Holds::No));
    // A flap that stays straight presses harder than the tube.
    let straight = free.star_flap_force_N.expect("known");
    assert!(straight > high, "{straight} {high}");
    for (newtons, why) in [(0.5 * (low + high), "it may press with"), (0.5 * (high + straight), "flap")] {
        let (found, verdict) = with(newtons);
        assert_eq!((found.len(), verdict.code, verdict.holds), (0, Some("may-not-hold"), Holds::Unknown));
        assert!(verdict.reasons[0].contains(why), "{verdict:?}");
    }
    assert_eq!(with(1.01 * straight).1.holds, Holds::Yes);
}

#[test]
fn a_pressure_outside_of_every_model_is_refused_with_those_inside() {
    let with = |kilopascals: f64| {
        let mut spec = gripper(5);
        spec.fabric.seal_strength = None;
        spec.load.as_mut().expect("given").pressure = Some(Pressure(kilopascals));
        let prediction = predict(&spec);
        // At its lowest pressures a star does not close so far.
        let all = refusals(&spec, &prediction).into_iter();
        all.filter(|one| one.code.as_str() != "object-too-thin").collect::<Vec<_>>()
    };
    assert!(with(37.0).is_empty());
    for (slip, meant) in [(3700.0, true), (0.037, true), (37e3, true), (250.0, false)] {
        let found = with(slip);
        let [only] = &found[..] else { panic!("{slip}: {found:?}") };
        assert_eq!(
            (only.code.as_str(), only.key.to_string()),
            ("outside-models", "load.pressure".to_owned())
        );
        assert_eq!(only.remedy.contains("did you mean 37 kPa?"), meant, "{}", only.remedy);
        let ends: Vec<f64> = only.remedy.split(' ').filter_map(|word| word.parse().ok()).collect();
        let [.., low, high] = ends[..] else { panic!("{}", only.remedy) };
        assert!(
            with(low).is_empty() && with(high).is_empty() && low < 20.0 && high > 50.0,
            "{}",
            only.remedy
        );
        assert!(!with(0.98 * low).is_empty() && !with(1.02 * high).is_empty(), "{}", only.remedy);
    }
}

#[test]
fn stars_that_pass_above_and_below_the_object_do_not_hold_it() {
    let mut spec = gripper(5);
    spec.fabric.seal_strength = Some(LineForce(60.0));
    spec.stars.truncate(2);
    let load = spec.load.as_mut().expect("given");
    (load.object_radius, load.object_height, load.object_shape) = (Some(Length(19.0)), None, None);
    let prediction = predict(&spec);
    let found = refusals(&spec, &prediction);
    assert!(
        found.iter().all(|one| one.code.as_str() == "object-too-short") && !found.is_empty(),
        "{found:?}"
    );
    let verdict = verdict(&spec, &prediction).expect("an object");
    assert_eq!((verdict.holds, verdict.code), (Holds::No, Some("object-too-short")));
    assert!(verdict.assumed.is_some_and(|text| text.contains("ball 38 mm tall")));
}

/// A mass says nothing about the grip without a friction.
#[test]
fn a_mass_without_friction_has_no_verdict() {
    let found = judged(|spec| {
        let load = spec.load.as_mut().expect("given");
        (load.mass, load.friction) = (Some(Mass(0.01)), None);
    });
    assert_eq!((found.holds, found.code), (Holds::Unknown, Some("may-not-hold")));
    assert!(found.reasons.iter().any(|reason| reason.contains("no friction")), "{found:?}");
}

/// A star that certainly does not touch the object has no force, and none in its range.
#[test]
fn a_star_beside_the_object_adds_no_force_to_the_range() {
    let mut spec = gripper(5);
    spec.load.as_mut().expect("given").object_radius = Some(Length(2.0));
    let star = predict(&spec).first;
    assert_eq!((star.object_force_N, star.ranges.object_force_N), (Some(0.0), Some([0.0, 0.0])));
    // Just thinner than predicted: it may be reached.
    let [closest, _] = star.ranges.final_radius_mm.expect("known");
    let between = f64::midpoint(closest, star.final_radius_mm.expect("known"));
    spec.load.as_mut().expect("given").object_radius = Some(Length(between));
    let star = predict(&spec).first;
    let [low, high] = star.ranges.object_force_N.expect("known");
    assert!(star.object_force_N == Some(0.0) && low == 0.0 && high > 0.0, "{low} {high}");
}

/// The printed force is on the same side of the printed need as the force is.
#[test]
fn a_force_is_printed_on_its_side_of_the_need() {
    let light = with_mass(0.01);
    let friction = light.needed_N.expect("a mass").recip() * 0.01 * 9.806_65;
    for end in light.force_range_N.expect("a range") {
        for part in [0.95, 0.9999, 1.0001, 1.05] {
            let found = with_mass(part * end * friction / 9.806_65);
            let line = found.line();
            let words: Vec<f64> = line.split([' ', '(', ',']).filter_map(|word| word.parse().ok()).collect();
            let [_, low, high, needed] = words[..] else { panic!("{line}") };
            let holds = if needed <= low { Holds::Yes } else { Holds::Unknown };
            assert_eq!(found.holds, if needed > high { Holds::No } else { holds }, "{line}");
        }
    }
}
