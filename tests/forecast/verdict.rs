//! Whether an object is held: the word, and the reasons.

use crate::{gripper, predict};
use stargrip_cam::forecast::verdict::{Holds, Verdict, verdict};
use stargrip_cam::spec::Spec;
use stargrip_cam::units::{Force, Length, LineForce, Mass, Pressure};

fn judged(change: impl Fn(&mut Spec)) -> Verdict {
    let mut spec = gripper(5);
    // Strong enough for all that follows.
    spec.fabric.seal_strength = Some(LineForce(60.0));
    change(&mut spec);
    let prediction = predict(&spec);
    let found = verdict(&spec, &prediction.stars).expect("an object and a pressure");
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
        (|spec| spec.load.as_mut().expect("given").object_radius = Some(Length(5.0)), "does not reach"),
        (|spec| spec.load.as_mut().expect("given").object_radius = Some(Length(51.0)), "does not go in"),
        (|spec| spec.fabric.seal_strength.as_mut().expect("given").0 = 0.1, "bursts at"),
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
    assert!(light.needed_N.expect("a mass and friction") < 0.2 && light.margin() > Some(1.0));
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
}
