//! Sizes and masses that a verdict names: those that are held, arms that fold, balls that slide out.

use crate::{gripper, predict};
use stargrip_cam::forecast::verdict::{Holds, Verdict, refusals, verdict};
use stargrip_cam::spec::Spec;
use stargrip_cam::units::{Angle, Length, LineForce, Mass, Pressure};

/// A star of the paper's spec alone, on a cylinder of this radius (mm).
fn alone(radius: f64, change: impl Fn(&mut Spec)) -> Spec {
    let mut spec = gripper(5);
    spec.stars.truncate(1);
    let load = spec.load.as_mut().expect("given");
    (load.mass, load.object_radius) = (None, Some(Length(radius)));
    (load.object_height, load.by_radius) = (None, false);
    spec.fabric.seal_strength = Some(LineForce(6e3));
    change(&mut spec);
    spec
}

/// The sizes, mm across, that refusals and reasons about `spec` name as surely held; whether one says that there are none.
fn remedies(spec: &Spec) -> (Verdict, Vec<f64>, bool) {
    let prediction = predict(spec);
    let found = verdict(spec, &prediction).expect("an object");
    let texts = refusals(spec, &prediction).into_iter().map(|one| one.remedy).chain(found.reasons.clone());
    let (mut sizes, mut none) = (Vec::new(), false);
    for text in texts {
        none |= text.contains("too wide to promise any size")
            || ["an inner_radius of at least ", "a larger inner_radius"]
                .iter()
                .any(|begin| text.starts_with(begin));
        for begin in ["from ", "an object of at most ", "an object of at least ", "at least "] {
            let Some((_, rest)) = text.split_once(begin).filter(|(_, rest)| rest.contains("mm across"))
            else {
                continue;
            };
            sizes.extend(rest.split([' ', ',']).map_while(|word| match word {
                "to" => Some(None),
                word => word.parse::<f64>().ok().map(Some),
            }));
            break;
        }
    }
    (found, sizes.into_iter().flatten().collect(), none)
}

/// From an object that is too thin to one that is too wide: a star that holds it presses on it, and a size that is named is surely held.
#[test]
fn an_object_is_held_with_a_force_and_the_size_that_is_named_is_held() {
    type Change = fn(&mut Spec);
    let specs: [(Change, bool); 4] = [
        (|_| (), true),
        // Sharp hinges of a thick fabric: the force begins at 0 where the star surely closes.
        (|spec| spec.fabric.thickness = Length(0.6), true),
        // It opens less than the hole, and just as far as it surely closes.
        (
            |spec| {
                let star = &mut spec.stars[0];
                (star.points, star.inner_radius) = (9, Length(74.0861));
                star.tip_angle = Angle(75.2807);
                spec.load.as_mut().expect("given").pressure = Some(Pressure(23.2941));
            },
            false,
        ),
        // It opens less than the hole.
        (
            |spec| {
                let star = &mut spec.stars[0];
                (star.points, star.inner_radius, star.tube_width) = (8, Length(49.495), Length(22.458));
                star.tip_angle = Angle(47.62);
                (star.tip_radius, star.corner_radius) = (Length(2.0), Length(2.0));
                spec.load.as_mut().expect("given").pressure = Some(Pressure(51.76));
            },
            true,
        ),
    ];
    for (i, (change, is_held)) in specs.into_iter().enumerate() {
        let mut named = 0;
        for k in 1..40 {
            let radius = 0.03 * f64::from(k) * alone(30.0, change).stars[0].inner_radius.0;
            let (found, sizes, none) = remedies(&alone(radius, change));
            let [low, _] = found.force_range_N.unwrap_or([0.0; 2]);
            assert_eq!(
                found.holds == Holds::Yes,
                low > 0.0 && found.reasons.is_empty(),
                "{i}, {radius}: {found:?}"
            );
            let needs =
                found.holds == Holds::No || found.reasons.iter().any(|why| why.contains("without force"));
            assert_eq!(needs && !none, !sizes.is_empty(), "{i}, {radius}: {found:?}");
            assert!(!(none && is_held), "{i}, {radius}: {found:?}");
            named += sizes.len();
            for size in sizes {
                let (there, ..) = remedies(&alone(0.5 * size, change));
                assert_eq!(there.holds, Holds::Yes, "{i}, {radius}, {size}: {there:?}");
            }
        }
        assert_eq!(named > 0, is_held, "{i}");
    }
}

/// A star alone whose corners are coated, on arms far from the plates: what it carries is limited by the arms.
#[test]
fn arms_that_fold_cap_the_payload_and_are_warned_of_from_wrinkling_on() {
    let mut spec = alone(30.0, |spec| spec.load.as_mut().expect("given").friction = Some(8.0));
    let first = predict(&spec).first;
    let (wrinkling, folding) =
        first.arm_wrinkling_kg.zip(first.arm_folding_kg).expect("a plate and an object");
    assert!((folding / wrinkling - 2.0).abs() < 1e-12);
    assert_eq!(first.ranges.payload_kg.map(|[_, high]| high), Some(folding), "{first:?}");
    let mut with = |kilograms: f64| {
        spec.load.as_mut().expect("given").mass = Some(Mass(kilograms));
        let prediction = predict(&spec);
        let warned = prediction
            .first
            .evidence
            .warnings
            .iter()
            .any(|warning| warning.text.contains("the arms wrinkle"));
        (warned, prediction.verdict.expect("an object"))
    };
    let ((light, held), (heavy, _), (_, folded)) =
        (with(0.99 * wrinkling), with(1.01 * wrinkling), with(1.01 * folding));
    assert!(!light && heavy && held.holds == Holds::Yes, "{held:?}");
    assert_eq!((folded.holds, folded.code), (Holds::No, Some("too-heavy")));
    assert!(folded.reasons[0].contains("arms fold"), "{folded:?}");
}

/// A ball in a stack whose stars press harder above its middle.
#[test]
fn a_ball_slides_out_of_stars_that_press_hardest_above_its_middle() {
    let judge = |narrow: usize| {
        let mut spec = gripper(5);
        spec.fabric.seal_strength = Some(LineForce(60.0));
        spec.stars.truncate(2);
        // The narrower star presses harder.
        spec.stars[narrow].inner_radius = Length(44.0);
        let load = spec.load.as_mut().expect("given");
        (load.object_radius, load.object_height, load.object_shape) =
            (Some(Length(35.0)), Some(Length(100.0)), None);
        load.friction = Some(0.3);
        let prediction = predict(&spec);
        let upright: f64 = prediction.stars.iter().filter_map(|star| star.payload_kg).sum();
        let payload = prediction.payload().kg.expect("known");
        let load = spec.load.as_mut().expect("given");
        load.mass = Some(Mass(prediction.payload().range_kg.expect("known")[1] * 1.01));
        (payload / upright, predict(&spec).verdict.expect("an object"))
    };
    let (below, _) = judge(0);
    let (above, verdict) = judge(1);
    assert!((below - 1.0).abs() < 1e-12 && above < 0.9, "{below} {above}");
    assert_eq!(verdict.holds, Holds::No);
    assert!(verdict.reasons.iter().any(|reason| reason.contains("slope")), "{verdict:?}");
}
