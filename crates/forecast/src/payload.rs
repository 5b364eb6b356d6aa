//! The **payload** of a stack: the mass that friction holds on the object's surface, until arms fold.
//!
//! Each star bears at most the mass at which its arms fold ([`bearing`](inflatable::mechanics::star::bearing)). On a ball, stars above the middle
//! bear less than on an upright surface, and those below bear more. What the whole stack gains so is not counted: the payload is at most that on
//! an upright surface, which equal stars reach.

use crate::folding::until_arms_fold;
use crate::interval::{Interval, sum};
use crate::outcome::Outcome;
use crate::prediction::{StackPayload, StarPrediction};
use crate::ranges::shown::rounded;
use inflatable::mechanics::star::bearing::{FOLDING, lift};
use inflatable::mechanics::strength::GRAVITY;
use spec::Load;
use spec::units::Mass;

/// Stars of a stack that press equally hard.
#[derive(Clone, Debug)]
pub(super) struct Bearers {
    /// Angle of the object's surface against the axis at each of them, rad.
    pub(super) slopes: Vec<f64>,
    /// Radial force of each, N, with its range.
    pub(super) force: (Option<f64>, Option<Interval>),
    /// Payload of each on an upright surface, kg, with its range.
    pub(super) payload: (Option<f64>, Option<Interval>),
    /// Mass on each at which its arms wrinkle, kg.
    pub(super) wrinkling: Option<f64>,
}

impl Bearers {
    /// Stars of this `outcome` at places with these `slopes`.
    pub(super) fn of_outcome(outcome: Option<&Outcome>, slopes: Vec<f64>) -> Self {
        Self {
            slopes,
            force: (outcome.and_then(Outcome::object_force), outcome.and_then(|outcome| outcome.force_range)),
            payload: (
                outcome.and_then(|outcome| outcome.payload),
                outcome.and_then(|outcome| outcome.payload_range),
            ),
            wrinkling: outcome.and_then(|outcome| outcome.wrinkling),
        }
    }

    /// One predicted star where the surface has this `slope`.
    pub(super) fn of_star(star: &StarPrediction, slope: f64) -> Self {
        Self {
            slopes: vec![slope],
            force: (star.object_force_N, star.ranges.object_force_N),
            payload: (star.payload_kg, star.ranges.payload_kg),
            wrinkling: star.arm_wrinkling_kg,
        }
    }

    fn count(&self) -> f64 {
        self.slopes.iter().map(|_| 1.0).sum()
    }

    /// The mass that they bear with a radial force of `force` N each at this `friction`, kg. It is below 0 where they push the object down.
    fn borne(&self, friction: f64, force: f64) -> f64 {
        let share = |slope: &f64| until_arms_fold(lift(friction, *slope) * force / GRAVITY, self.wrinkling);
        self.slopes.iter().map(share).sum()
    }
}

/// The payload of a stack of `bearers` with the friction of `load`.
pub(super) fn stack_payload(load: &Load, bearers: &[Bearers]) -> StackPayload {
    let upright = StackPayload {
        kg: bearers.iter().map(|bearer| Some(bearer.count() * bearer.payload.0?)).sum(),
        range_kg: sum(bearers.iter().map(|bearer| Some(bearer.payload.1?.map(|end| bearer.count() * end)))),
    };
    if bearers.iter().flat_map(|bearer| &bearer.slopes).all(|slope| *slope == 0.0) {
        return upright;
    }
    let kg = upright.kg.zip(load.friction).and_then(|(most, friction)| {
        let borne = bearers
            .iter()
            .map(|bearer| Some(bearer.borne(friction, bearer.force.0?)))
            .sum::<Option<f64>>()?;
        Some(borne.clamp(0.0, most))
    });
    let range_kg = upright.range_kg.zip(load.friction_range()).and_then(|([low, high], [least, most])| {
        // Errors of a stack's forces are the same: all are at one end. Between them the mass is concave in the forces, because arms fold:
        // it is least at an end, and each star's most bounds the most.
        let highest_force = |bearer: &Bearers| {
            let [low, high] = bearer.force.1?.map(|force| bearer.borne(most, force));
            Some(low.max(high))
        };
        let highest = bearers.iter().map(highest_force).sum::<Option<f64>>()?;
        let [first, second] = [0, 1].map(|end| {
            bearers.iter().map(|bearer| Some(bearer.borne(least, bearer.force.1?[end]))).sum::<Option<f64>>()
        });
        Some([first?.min(second?).clamp(0.0, low), highest.clamp(0.0, high)])
    });
    StackPayload { kg, range_kg }
}

/// The reason why a stack of `stars` bears less than friction holds on an upright surface, at its `end` of the ranges (0 or 1), in words;
/// `None` if it does not.
pub(super) fn limit_in_words(
    load: &Load,
    stars: &[StarPrediction],
    payload: StackPayload,
    end: usize,
) -> Option<String> {
    let (friction, payload_end) = (load.friction_range()?[end], payload.range_kg?[end]);
    let upright = sum(stars.iter().map(|star| star.ranges.payload_kg))?[end];
    let forces = sum(stars.iter().map(|star| star.ranges.object_force_N))?[end];
    let slides = payload_end < upright * (1.0 - ROUNDING);
    let folds = upright < friction * forces / GRAVITY * (1.0 - ROUNDING);
    match (slides, folds) {
        (false, false) => None,
        (true, false) => Some("stars above the object's middle bear less on its slope".to_owned()),
        (false, true) => Some("the arms fold between plate and object".to_owned()),
        (true, true) => Some(
            "stars above the object's middle bear less on its slope, and the arms fold between plate and object"
                .to_owned(),
        ),
    }
}

/// Rounding of sums of masses.
const ROUNDING: f64 = 1e-9;

/// For each of `stars` under the mass of `load` a warning if its arms wrinkle. The stars share the mass as they share the force.
pub(super) fn wrinkling_warnings(load: &Load, stars: &[StarPrediction]) -> Vec<Option<String>> {
    let force: f64 = stars.iter().filter_map(|star| star.object_force_N).sum();
    let warning = |star: &StarPrediction| {
        let Mass(mass) = load.mass?;
        let (force_here, wrinkling) = (star.object_force_N?, star.arm_wrinkling_kg?);
        let share = mass * force_here / force;
        (share > wrinkling).then(|| {
            let [wrinkling, share, folding] = [wrinkling, share, FOLDING * wrinkling].map(rounded);
            format!(
                "the arms wrinkle and sag between plate and object: this star bears {share} kg, and its arms wrinkle under {wrinkling} kg and \
                 fold under {folding} kg; more stars, more pressure, a wider tube or a smaller `clearance` in [frame] bear more"
            )
        })
    };
    stars.iter().map(warning).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn load(friction: f64) -> Load {
        Load { friction: Some(friction), ..Load::default() }
    }

    /// Stars with these forces, N, of 20 % error, on these slopes; their arms wrinkle under `wrinkling` kg.
    fn bearers(forces: &[f64], slopes: &[f64], friction: f64, wrinkling: Option<f64>) -> Vec<Bearers> {
        let bearers_of = |(force, slope): (&f64, &f64)| {
            let range = [0.8 * force, 1.2 * force];
            let [value, low, high] = [*force, range[0], range[1]]
                .map(|force| until_arms_fold(friction * force / GRAVITY, wrinkling));
            Bearers {
                slopes: vec![*slope],
                force: (Some(*force), Some(range)),
                payload: (Some(value), Some([low, high])),
                wrinkling,
            }
        };
        forces.iter().zip(slopes).map(bearers_of).collect()
    }

    fn kg(forces: &[f64], slopes: &[f64], friction: f64, wrinkling: Option<f64>) -> f64 {
        let payload = stack_payload(&load(friction), &bearers(forces, slopes, friction, wrinkling));
        let ([low, high], kg) = payload.range_kg.zip(payload.kg).expect("known");
        assert!(0.0 <= low && low <= kg && kg <= high, "{payload:?}");
        kg
    }

    #[test]
    fn a_stack_that_presses_above_the_middle_carries_less() {
        let slope = 30_f64.to_radians();
        let strong_above = kg(&[5.0, 10.0], &[-slope, slope], 0.3, None);
        let angle = libm::atan(0.3);
        let expected = (5.0 * libm::tan(angle + slope) + 10.0 * libm::tan(angle - slope)) / GRAVITY;
        assert!((strong_above - expected.max(0.0)).abs() < 1e-12, "{strong_above} {expected}");
        let upright = 0.3 * 15.0 / GRAVITY;
        for slopes in [[slope, -slope], [0.0, 0.0]] {
            assert!((kg(&[5.0, 10.0], &slopes, 0.3, None) - upright).abs() < 1e-12, "{slopes:?}");
        }
        assert!((kg(&[7.5, 7.5], &[-slope, slope], 0.3, None) - upright).abs() < 1e-12);
        // Arms that wrinkle under 50 g fold under 100 g.
        assert_eq!(kg(&[5.0, 10.0], &[0.0, 0.0], 0.3, Some(0.05)), 0.2);
    }

    proptest! {
        #[test]
        fn a_payload_is_continuous_and_rises_with_forces_friction_and_arms(
            forces in [0.0..20.0_f64, 0.0..20.0_f64, 0.0..20.0_f64],
            slope in 0.0..1.5_f64, friction in 0.05..1.5_f64, arms in 0.01..2.0_f64,
        ) {
            let slopes = [-slope, 0.0, slope];
            let payload_of = |forces: [f64; 3], slopes: [f64; 3], friction: f64, arms: f64| kg(&forces, &slopes, friction, Some(arms));
            let payload = payload_of(forces, slopes, friction, arms);
            let step = 1e-7;
            prop_assert!(payload_of(forces, slopes, friction + step, arms) >= payload - 1e-12);
            prop_assert!(payload_of(forces, slopes, friction, arms + step) >= payload - 1e-12);
            prop_assert!(payload_of([forces[0] + step, forces[1] + step, forces[2]], slopes, friction, arms) >= payload - 1e-12);
            let neighbours = [
                payload_of(forces.map(|force| force + step), slopes, friction, arms),
                payload_of(forces, [-slope - step, step, slope + step], friction, arms),
                payload_of(forces, slopes, friction + step, arms + step),
            ];
            for value in neighbours {
                prop_assert!((value - payload).abs() < 1e-2, "{value} {payload}");
            }
            // No more than on an upright surface, and none is lost by three equal stars.
            prop_assert!(payload <= payload_of(forces, [0.0; 3], friction, arms) + 1e-12);
        }
    }
}
