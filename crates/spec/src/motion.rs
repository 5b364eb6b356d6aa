//! The lowest feed that a controller holds, from its motors' steps and its timer's longest period.
//!
//! A controller makes the steps of the axis that has most of them at an even rate. Below some rate its timer
//! overflows; many then step at their lowest rate, faster than programmed, and do not report it. Along the unit vector u
//! the lowest speed is `f / max(S_x |u_x|, S_y |u_y|, S_z |u_z|)`, with f the lowest step rate and S the steps per mm.

use crate::units::{Acceleration, Duration, Speed};

/// Properties of the motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Steps per mm of X, Y and Z; `None` if unknown.
    pub steps_per_mm: Option<[f64; 3]>,
    /// The lowest even step rate, steps/s.
    pub step_rate: StepRate,
    /// A lowest feed of its own, whatever the steps; 0 for none.
    pub min_feed: Speed,
    /// Acceleration of X and Y; `None` if unknown.
    pub acceleration: Option<Acceleration>,
    /// Feed of chopped moves; `None`: that of [`Motion::chop_speed`].
    pub chop_feed: Option<Speed>,
    /// Delay of a move that meets an empty queue, as after each dwell.
    pub start_delay: Duration,
    /// The tick of a controller that steps as GRBL does; 0: rates are whole steps a second, as Marlin's; `None`: the time of a
    /// move follows from its speed and acceleration.
    pub tick: Option<Duration>,
    /// Whether the timer of long steps wraps around, as FluidNC's does.
    pub wraps: bool,
    /// The rate of a move's first step at least, steps/s, whatever its feed, where rates are whole (Marlin up to 2.0.x);
    /// `None` where there is no such rate.
    pub first_step_rate: Option<f64>,
    /// Fewest steps of a move, on the axis that has most of them: a move of fewer is joined to the next one (Marlin,
    /// `MIN_STEPS_PER_SEGMENT`); 0 where a controller makes every move.
    pub min_move_steps: f64,
    /// The limits of Z where they are lower than those of X and Y.
    pub z: ZLimits,
    /// Whether speeds follow an S where rates are whole (Marlin, `S_CURVE_ACCELERATION`); else they rise evenly.
    pub s_curve: bool,
}

/// The limits of Z, which a screw often drives; `None` for those of X and Y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ZLimits {
    /// Largest speed: GRBL's $112, M203 Z.
    pub speed: Option<Speed>,
    /// Acceleration: GRBL's $122, M201 Z.
    pub acceleration: Option<Acceleration>,
}

/// The lowest even step rate of a controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepRate {
    /// Unknown: nothing can be checked.
    Unknown,
    /// No lowest rate.
    NoLimit,
    /// This many steps a second.
    AtLeast(f64),
}

/// Ratio of a chopped move's feed to the lowest feed: high enough for a timer's rounding, and low enough for the shortest braking
/// distance.
const CHOP_MARGIN: f64 = 1.2;
/// Least ratio of a chopped move's feed to the seal's speed where rates are whole steps a second. Strokes are timed with the
/// rounded rates. The ratio leaves time for dwells, and is low enough for short strokes to reach the feed: the peak of one that
/// does not depends on the rounding of a float (`calculate_trapezoid_for_block`).
const CHOP_RATIO: f64 = 2.5;
/// The part of the first step's rate that chopped moves have in the worst direction. Along an axis they step 1.41 times as
/// often, so rates lie around that of the first step, and it makes little difference whether a version has one.
const FIRST_SHARE: f64 = 0.81;
/// The fraction by which a steady move may be too fast where rates are rounded up to whole steps a second.
const ROUNDED_UP: f64 = 0.002;

impl Motion {
    /// All values unknown.
    pub const UNKNOWN: Self = Self {
        steps_per_mm: None,
        step_rate: StepRate::Unknown,
        min_feed: Speed(0.0),
        acceleration: None,
        chop_feed: None,
        start_delay: Duration(0.0),
        tick: None,
        wraps: false,
        first_step_rate: None,
        min_move_steps: 0.0,
        z: ZLimits { speed: None, acceleration: None },
        s_curve: false,
    };

    /// Whether rates are rounded up to whole steps a second (Marlin: module/planner.cpp, `nominal_rate`).
    pub fn has_whole_rates(&self) -> bool {
        self.tick.is_some_and(|tick| tick.0 == 0.0)
    }

    /// The lowest rate, steps/s, at which a steady move has its speed: the lowest that can be made. Where rates are rounded up to
    /// whole ones, it is at least the rate of which one step a second is 0.2 %. `None` where there is none, or it is unknown.
    pub fn even_rate(&self) -> Option<f64> {
        let StepRate::AtLeast(rate) = self.step_rate else { return None };
        Some(if self.has_whole_rates() { rate.max(1.0 / ROUNDED_UP) } else { rate })
    }

    /// The lowest speed at which a move with these displacements has its speed, mm/s; `None` if unknown.
    pub fn lowest_speed(&self, displacement: [f64; 3]) -> Option<f64> {
        match self.step_rate {
            StepRate::Unknown => None,
            StepRate::NoLimit => Some(self.min_feed.0),
            StepRate::AtLeast(_) => self.speed_at(self.even_rate()?, displacement),
        }
    }

    /// The lowest speed that a stroke with these displacements can have, mm/s, rounded up or not: strokes are timed with the
    /// rates as they become. `None` if unknown.
    pub fn lowest_stroke(&self, displacement: [f64; 3]) -> Option<f64> {
        match self.step_rate {
            StepRate::AtLeast(rate) => self.speed_at(rate, displacement),
            _ => self.lowest_speed(displacement),
        }
    }

    /// The speed, mm/s, of a move with these displacements at a rate in steps/s; `None` if the steps are unknown.
    fn speed_at(&self, rate: f64, displacement: [f64; 3]) -> Option<f64> {
        let steps = self.steps_per_mm?;
        let length = displacement.iter().map(|d| d * d).sum::<f64>().sqrt();
        let largest = steps.iter().zip(displacement).map(|(s, d)| s * d.abs()).fold(0.0, f64::max);
        if largest <= 0.0 {
            return Some(self.min_feed.0);
        }
        Some((rate * length / largest).max(self.min_feed.0))
    }

    /// The lowest speeds over all directions of the XY plane: the least and the greatest, mm/s; `None` if unknown.
    ///
    /// The least is along the axis with more steps, the greatest where X and Y step equally often.
    pub fn speed_range(&self) -> Option<(f64, f64)> {
        let [x, y, _] = self.steps_per_mm.unwrap_or([1.0, 1.0, 1.0]);
        let axis = if x >= y { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        Some((self.lowest_speed(axis)?, self.lowest_speed(self.worst_direction())?))
    }

    /// Steps per mm that let the controller hold `speed` (mm/s): along an axis and at 45 degrees. `None` if the rate is
    /// unknown or has no limit.
    pub fn steps_needed(&self, speed: f64) -> Option<(f64, f64)> {
        self.even_rate().map(|rate| (rate / speed, rate / speed * std::f64::consts::SQRT_2))
    }

    /// The shortest straight move that the controller makes in every direction of the XY plane, mm; 0 where it makes any.
    pub fn least_move(&self) -> f64 {
        let [x, y, _] = self.steps_per_mm.unwrap_or([f64::INFINITY; 3]);
        self.min_move_steps * libm::hypot(1.0 / x, 1.0 / y)
    }

    /// The feed of chopped moves, mm/s, of a seal at `speed`, mm/s: `chop_feed`, or 1.2 times the lowest that the worst
    /// direction can be made to step at, and no less than the lowest on any ramp. Where rates are whole ones it is 2.5 times `speed` at least, and where the first
    /// step has a rate of its own about that rate.
    pub fn chop_speed(&self, speed: f64) -> Option<f64> {
        if let Some(feed) = self.chop_feed {
            return Some(feed.0);
        }
        let StepRate::AtLeast(rate) = self.step_rate else {
            return self.speed_range().map(|(_, most)| CHOP_MARGIN * most);
        };
        // On a ramp Z may step too, and where it has few steps that is slower still.
        let climbing = self.speed_at(rate, self.steps_per_mm?.map(f64::recip))?;
        let lowest = climbing.max(CHOP_MARGIN * self.speed_at(rate, self.worst_direction())?);
        if !self.has_whole_rates() {
            return Some(lowest);
        }
        let first = self.first_step_rate.and_then(|rate| self.speed_at(rate, self.worst_direction()));
        Some(lowest.max(CHOP_RATIO * speed).max(FIRST_SHARE * first.unwrap_or(0.0)))
    }

    /// The direction of the XY plane in which X and Y step equally often: the slowest steps of all.
    fn worst_direction(&self) -> [f64; 3] {
        let [x, y, _] = self.steps_per_mm.unwrap_or([1.0, 1.0, 1.0]);
        [y, x, 0.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(steps: [f64; 3], rate: f64) -> Motion {
        Motion { steps_per_mm: Some(steps), step_rate: StepRate::AtLeast(rate), ..Motion::UNKNOWN }
    }

    #[test]
    fn grbl_at_80_steps_is_four_to_five_times_too_fast() {
        let (slowest, fastest) = motion([80.0, 80.0, 400.0], 30.52).speed_range().expect("known");
        assert!(
            (slowest * 60.0 - 22.89).abs() < 0.01 && (fastest * 60.0 - 32.37).abs() < 0.01,
            "{slowest} {fastest}"
        );
        let (axis, diagonal) = motion([80.0; 3], 30.52).steps_needed(0.1).expect("known");
        assert!((axis - 305.2).abs() < 0.01 && (diagonal - 431.6).abs() < 0.1);
    }

    #[test]
    fn the_range_bounds_every_direction() {
        for steps in [[80.0, 80.0, 400.0], [100.0, 250.0, 400.0], [320.0, 80.0, 1.0]] {
            let m = motion(steps, 30.52);
            let (slowest, fastest) = m.speed_range().expect("known");
            let mut extremes = (f64::INFINITY, 0.0_f64);
            for i in 0..3600 {
                let (s, c) = (f64::from(i) * 0.1_f64.to_radians()).sin_cos();
                let v = m.lowest_speed([c, s, 0.0]).expect("known");
                assert!(v >= slowest * (1.0 - 1e-12) && v <= fastest * (1.0 + 1e-12), "{steps:?} {i}");
                extremes = (extremes.0.min(v), extremes.1.max(v));
            }
            assert!((extremes.0 / slowest - 1.0).abs() < 1e-3 && (extremes.1 / fastest - 1.0).abs() < 1e-2);
        }
    }

    /// Six steps of 1/80 mm at 45 degrees; in no direction are there fewer in such a way.
    #[test]
    fn the_shortest_move_has_its_steps_in_every_direction() {
        for steps in [[80.0, 80.0, 400.0], [100.0, 250.0, 400.0]] {
            let m = Motion { min_move_steps: 6.0, ..motion(steps, 32.0) };
            let shortest = m.least_move();
            let steps_at = |degrees: f64| {
                let (s, c) = degrees.to_radians().sin_cos();
                shortest * (steps[0] * c.abs()).max(steps[1] * s.abs())
            };
            let fewest = (0..3600).map(|i| steps_at(0.1 * f64::from(i))).fold(f64::INFINITY, f64::min);
            assert!(fewest > 6.0 - 1e-9 && fewest < 6.02, "{fewest}");
        }
        assert_eq!(Motion::UNKNOWN.least_move(), 0.0);
    }

    /// With fewer steps of Z than of X and Y, a steep ramp is the slowest way of all.
    #[test]
    fn chopped_moves_are_held_on_every_ramp() {
        for steps in [[463.0, 461.0, 400.0], [800.0, 300.0, 100.0], [80.0, 80.0, 400.0]] {
            let m = motion(steps, 38.15);
            let speed = m.chop_speed(0.1).expect("known");
            for i in 0..900 {
                let (s, c) = (f64::from(i) * 0.1_f64.to_radians()).sin_cos();
                for rise in [0.0, 0.3, 1.0, 1.2, 3.0, 30.0] {
                    let lowest = m.lowest_stroke([c, s, rise]).expect("known");
                    assert!(speed >= lowest * (1.0 - 1e-12), "{steps:?} {i} {rise}: {speed} < {lowest}");
                }
            }
        }
        let usual = motion([80.0, 80.0, 400.0], 30.52);
        let flat = usual.speed_range().expect("known").1;
        assert!((usual.chop_speed(0.1).expect("known") - 1.2 * flat).abs() < 1e-12);
    }

    /// At 80 steps/mm: 97 steps/s at 45 degrees, 137 along an axis.
    #[test]
    fn chopped_moves_step_about_as_fast_as_the_first_step() {
        let marlin = Motion {
            tick: Some(Duration(0.0)),
            first_step_rate: Some(120.0),
            ..motion([80.0, 80.0, 400.0], 32.0)
        };
        let speed = marlin.chop_speed(0.1).expect("known");
        assert!((speed * 80.0 / 2.0_f64.sqrt() - 97.2).abs() < 1e-9, "{speed}");
        let newest = Motion { first_step_rate: None, ..marlin };
        assert!((newest.chop_speed(0.1).expect("known") * 80.0 / 2.0_f64.sqrt() - 38.4).abs() < 1e-9);
    }

    #[test]
    fn what_is_unknown_stays_unknown_and_a_lowest_feed_counts() {
        assert_eq!(Motion::UNKNOWN.speed_range(), None);
        assert_eq!(Motion { step_rate: StepRate::AtLeast(30.0), ..Motion::UNKNOWN }.speed_range(), None);
        let klipper = Motion { step_rate: StepRate::NoLimit, ..Motion::UNKNOWN };
        assert_eq!(klipper.speed_range(), Some((0.0, 0.0)));
        let rrf = Motion { min_feed: Speed(0.5), ..klipper };
        assert_eq!(rrf.speed_range(), Some((0.5, 0.5)));
    }
}
