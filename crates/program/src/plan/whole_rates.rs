//! The time that Marlin takes for a stroke from rest to rest.
//!
//! A rate is a whole number of steps a second, rounded up. A ramp begins at the rate that is reached on
//! average within its first step, and changes at every step by the time that the ramp has taken (repository
//! MarlinFirmware/Marlin, module/planner.cpp, `_populate_block` and `calculate_trapezoid_for_block`; module/stepper.cpp,
//! `block_phase_isr`), evenly or in an S (`S_CURVE_ACCELERATION`). Up to 2.0.x a ramp begins and ends at 120 steps/s at least
//! (`MINIMAL_STEP_RATE`), so that the first step of a slower stroke comes early; where there is a ramp its first rate holds for two steps.

use spec::{Motion, StepRate};

/// The fraction by which a steady contact at `speed` mm/s may be too fast in the worst direction, because step rates are rounded
/// up to whole ones, and to the lowest there is; `None` where they are not, or the steps are unknown.
///
/// The lowest rate r is that along the diagonal on which X and Y step equally often: it becomes the next whole rate n, and a
/// rate a little above n becomes n + 1.
pub(super) fn rounded_up(motion: &Motion, speed: f64) -> Option<f64> {
    let ([x, y, _], true) = (motion.steps_per_mm?, motion.has_whole_rates()) else { return None };
    let StepRate::AtLeast(floor) = motion.step_rate else { return None };
    let rate = speed * x * y / libm::hypot(x, y);
    let raised = rate.ceil().max(floor);
    Some((raised / rate - 1.0).max(1.0 / raised))
}

/// The rules of a controller for the rates of a stroke.
pub(super) struct RateRules {
    /// The lowest rate, steps/s.
    pub(super) floor: f64,
    /// The rate of a stroke's first step at least, steps/s, if there is one.
    pub(super) first: Option<f64>,
    /// Whether ramps follow an S.
    pub(super) s_curve: bool,
}

/// Rates of a stroke, steps/s.
pub(super) struct WholeRates {
    /// The rate at which a ramp begins and ends.
    slow: f64,
    even: f64,
    /// Steps/s^2.
    acceleration: f64,
    /// Whether the first step has a rate of its own.
    has_first: bool,
    /// Whether ramps follow an S.
    s_curve: bool,
}

/// More steps than this take their nominal time: their two ramps do not count.
const MANY: f64 = 1e4;
/// Speed of a ramp's ends where the first step has a rate of its own, mm/s (Configuration_adv.h, `MINIMUM_PLANNER_SPEED`).
const END_SPEED: f64 = 0.05;

/// A ramp: the rate of each step follows from the time before it.
struct StepRamp {
    from: f64,
    to: f64,
    acceleration: f64,
    s_curve: bool,
    /// Time since its beginning, s.
    elapsed: f64,
}

impl StepRamp {
    /// The rate of the next step.
    fn next_rate(&mut self) -> f64 {
        let gain = self.acceleration * self.elapsed;
        let change = self.to - self.from;
        let part = gain / change.abs();
        let rate = match (self.s_curve, part < 1.0) {
            // stepper.cpp, _eval_bezier_curve.
            (true, true) => {
                (self.from + change * part.powi(3) * (10.0 - 15.0 * part + 6.0 * part * part)).floor()
            }
            (true, false) => self.to,
            (false, _) if change < 0.0 => (self.from - gain.floor()).max(self.to),
            (false, _) => (self.from + gain.floor()).min(self.to),
        };
        self.elapsed += 1.0 / rate;
        rate
    }
}

impl WholeRates {
    /// The rates by `rules` at `per_mm` steps/mm along the way, at `speed` mm/s and `acceleration` mm/s^2.
    pub(super) fn new(rules: &RateRules, per_mm: f64, speed: f64, acceleration: f64) -> Self {
        let RateRules { floor, first, s_curve } = *rules;
        let slow = match first {
            Some(first) => (END_SPEED * per_mm).ceil().max(first),
            None => ((0.5 * acceleration / per_mm).sqrt().min(speed) * per_mm).round(),
        };
        Self {
            slow: slow.max(floor),
            even: (speed * per_mm - 1e-6).ceil().max(floor),
            acceleration: (acceleration * per_mm).ceil(),
            has_first: first.is_some(),
            s_curve,
        }
    }

    /// Steps from the slow rate to the even one, with a part of a step; 0 where that is no faster.
    fn ramp(&self) -> f64 {
        let Self { slow, even, acceleration, .. } = *self;
        ((even * even - slow * slow) / (2.0 * acceleration)).max(0.0)
    }

    /// Time for these steps, s.
    pub(super) fn seconds(&self, steps: f64) -> f64 {
        let Self { slow, even, acceleration, has_first, s_curve } = *self;
        if steps > MANY {
            return steps / even;
        }
        let (mut up, mut down) = (self.ramp().ceil(), self.ramp().ceil());
        if has_first {
            down = self.ramp().floor();
        }
        let mut top = even;
        if up + down > steps {
            // The even rate is not reached: half of the steps speed up.
            up = if has_first { (steps / 2.0).ceil() } else { (steps / 2.0).round() };
            down = steps - up;
            top = (slow * slow + 2.0 * acceleration * up).sqrt().min(even);
        }
        // Where the first step has a rate of its own, a ramp begins after it; else in its middle, and ends after half an even step.
        let is_even = up + down < steps;
        let (first_step, middle) = if has_first { (1.0, 0.0) } else { (0.0, 0.5 / slow) };
        let braking = if is_even && !has_first { 0.5 / even } else { 0.0 };
        let limit = if s_curve { top } else { even };
        let mut rise = StepRamp { from: slow, to: limit, acceleration, s_curve, elapsed: middle };
        let mut fall = StepRamp { from: top, to: slow, acceleration, s_curve, elapsed: braking };
        let (mut elapsed, mut count) = (1.0 / slow, 1.0);
        while count < steps {
            let rate = if up > 0.0 && count < up + first_step {
                let rate = rise.next_rate();
                fall.from = if s_curve { top } else { rate };
                rate
            } else if count >= steps - down + first_step {
                fall.next_rate()
            } else {
                fall.from = if s_curve || has_first { fall.from } else { even };
                even
            };
            elapsed += 1.0 / rate;
            count += 1.0;
        }
        elapsed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 800 steps/mm at 0.1 mm/s: 56.6 steps/s at 45 deg run as 57, and 57.1 in another direction as 58.
    #[test]
    fn the_worst_rounding_is_that_of_the_next_whole_rate() {
        let worst = |steps: f64, speed: f64| rounded_up(&motion_of(steps), speed).expect("known");
        assert!((worst(800.0, 0.1) - 1.0 / 57.0).abs() < 1e-12);
        // 6.93 steps/s run as 7: 1 %; 7 and a little as 8: 14 %.
        assert!((worst(98.0, 0.1) - 1.0 / 7.0).abs() < 1e-12);
        assert_eq!(rounded_up(&Motion::UNKNOWN, 0.1), None);
        // No direction is worse, and one comes near.
        let errors =
            (0..9000).map(|i| (f64::from(i) * 1e-2).to_radians().cos()).filter(|c| *c > 0.5_f64.sqrt());
        let worst_found = errors.map(|c| (80.0 * c).ceil() / (80.0 * c) - 1.0).fold(0.0, f64::max);
        assert!(worst_found <= worst(800.0, 0.1) && worst_found > 0.99 * worst(800.0, 0.1), "{worst_found}");
    }

    fn motion_of(steps: f64) -> Motion {
        Motion {
            steps_per_mm: Some([steps; 3]),
            step_rate: StepRate::AtLeast(1.0),
            tick: Some(spec::units::Duration(0.0)),
            ..Motion::UNKNOWN
        }
    }

    fn rates(per_mm: f64, speed: f64, acceleration: f64, first: Option<f64>) -> WholeRates {
        WholeRates::new(&RateRules { floor: 32.0, first, s_curve: false }, per_mm, speed, acceleration)
    }

    /// 12 steps along Y at 0.68 mm/s, 55 steps/s: the first after 1/120 s, the others after 1/55 s. Measured on 2.0.9.7 are
    /// 10 ms less than 12/55 s.
    #[test]
    fn the_first_step_comes_early_up_to_2_0_x() {
        let first = rates(80.0, 0.68, 3000.0, Some(120.0)).seconds(12.0);
        assert!((first - (1.0 / 120.0 + 11.0 / 55.0)).abs() < 1e-12, "{first}");
        // Later versions round 54.4 steps/s to the nearest for the ends of ramps, and up for the rest.
        let rounded_ramp = rates(80.0, 0.68, 3000.0, None).seconds(12.0);
        assert!((rounded_ramp - (2.0 / 54.0 + 10.0 / 55.0)).abs() < 1e-12, "{rounded_ramp}");
        // Faster than the first step there is a ramp of a step, and none down.
        let fast = rates(80.0, 1.7, 3000.0, Some(120.0)).seconds(12.0);
        assert!((fast - (2.0 / 120.0 + 10.0 / 136.0)).abs() < 1e-12, "{fast}");
        // At 1,600 steps/s^2 it takes 27.5 steps from 120 to 320 steps/s.
        let slow = rates(80.0, 4.0, 20.0, Some(120.0));
        assert!((slow.ramp() - 27.5).abs() < 1e-12);
        assert!(slow.seconds(100.0) > 100.0 / 320.0 && slow.seconds(20.0) > 20.0 / 320.0);
    }

    /// 80 steps/mm at 45 deg: 0.68 mm/s are 38.5 steps/s, which run as 39.
    #[test]
    fn a_rate_is_rounded_up() {
        let stroke = rates(80.0 / 2.0_f64.sqrt(), 0.68, 3000.0, None);
        // The first step and the last have 38.
        assert!((stroke.seconds(39.0) - 1.0).abs() < 2e-3);
        assert!((stroke.seconds(39e4) - 1e4).abs() < 1e-6);
    }

    /// Slow ramps begin at a rate that is not 0: sqrt(a / 2) of a step, and here at the lowest one.
    #[test]
    fn ramps_go_from_step_to_step() {
        let slow = rates(80.0, 0.68, 10.0, None);
        // Up: 32, then 32 + 800 / 64; so 2 steps up, 12 even, 2 down from 55 after half a step of it.
        let down = [55.0 - (800.0_f64 * 0.5 / 55.0).floor(), 0.0];
        let second = (55.0 - (800.0_f64 * (0.5 / 55.0 + 1.0 / down[0])).floor()).max(32.0);
        let expected = 1.0 / 32.0 + 1.0 / 44.0 + 12.0 / 55.0 + 1.0 / down[0] + 1.0 / second;
        assert!((slow.seconds(16.0) - expected).abs() < 1e-12, "{}", slow.seconds(16.0));
        // One step has no ramps at all.
        assert!((slow.seconds(1.0) - 1.0 / 32.0).abs() < 1e-12);
    }
}
