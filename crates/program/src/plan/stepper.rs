//! The time that a controller which steps as GRBL or as Marlin takes for a stroke from rest to rest.
//!
//! One of GRBL's family makes whole steps of the axis that has most of them, in **segments**: as many whole ticks (10 ms) as it
//! takes to get a step and a quarter farther. Within a segment the steps are even; they are those that the ideal ramp has made by
//! its end, and the fraction of a step is left to the next one. Where the timer cannot wait as long as a step should take, the
//! step comes earlier, so the slow ends of a ramp are faster than programmed. The end of speeding up is counted from the
//! beginning of its segment, which is too long where the segment has more ticks than one: it was written for segments of one
//! (repository gnea/grbl, stepper.c, `st_prep_buffer`, `RAMP_ACCEL`; planner.c).

use crate::plan::whole_rates::{RateRules, WholeRates};
use spec::ZLimits;

/// The properties of a controller's stepping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stepper {
    /// Steps per mm of X, Y and Z.
    pub steps_per_mm: [f64; 3],
    /// The lowest step rate, steps/s.
    pub rate: f64,
    /// A tick: segments last whole multiples of it, s; 0 where every step has a rate of its own, in whole steps a second.
    pub tick: f64,
    /// Whether long steps may come too early, as FluidNC's do (`wrapped`).
    pub wraps: bool,
    /// The rate of a stroke's first step at least, steps/s, if there is one ([`spec::Motion::first_step_rate`]).
    pub first_rate: Option<f64>,
    /// Fewest steps of a move that is not joined to the next one.
    pub least_steps: f64,
    /// The limits of Z on a ramp.
    pub z: ZLimits,
    /// Whether speeds follow an S where rates are whole.
    pub s_curve: bool,
}

/// Least steps of a segment, except the last.
const LEAST: f64 = 1.25;
/// A stroke that takes longer than this, s, takes its nominal time: its two ramps do not count.
const LONG: f64 = 10.0;
/// Rounding of a step.
const ROUNDING: f64 = 1e-9;

/// Way from rest to rest: speeding up, perhaps even, braking.
struct Trapezoid {
    length: f64,
    acceleration: f64,
    top: f64,
    /// Time of each ramp, s.
    ramp: f64,
    /// Time of the whole stroke, s.
    total: f64,
}

impl Trapezoid {
    fn new(length: f64, speed: f64, acceleration: f64) -> Self {
        let top = speed.min((acceleration * length).sqrt());
        let ramp = top / acceleration;
        Self { length, acceleration, top, ramp, total: length / top + ramp }
    }

    /// The way travelled at the time `t`, mm.
    fn way(&self, t: f64) -> f64 {
        let time_left = self.total - t;
        if time_left <= 0.0 {
            self.length
        } else if t < self.ramp {
            self.acceleration * t * t / 2.0
        } else if time_left < self.ramp {
            self.length - self.acceleration * time_left * time_left / 2.0
        } else {
            self.top * (t - self.ramp / 2.0)
        }
    }
}

impl Stepper {
    /// Whole steps of the three axes at a position, mm.
    pub fn steps_at(&self, position: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| (position[i] * self.steps_per_mm[i]).round())
    }

    /// Time for these steps of the three axes, s, from rest to rest, at `speed` mm/s with an acceleration of `acceleration`
    /// mm/s^2: of each axis, or along the way where every step has a rate of its own (Marlin, M204).
    pub fn seconds(&self, steps: [f64; 3], speed: f64, acceleration: f64) -> f64 {
        let way: [f64; 3] = std::array::from_fn(|i| (steps[i] / self.steps_per_mm[i]).abs());
        let length = way.iter().map(|d| d * d).sum::<f64>().sqrt();
        let most_steps = steps.iter().fold(0.0_f64, |most_steps, n| most_steps.max(n.abs()));
        if most_steps < 0.5 {
            return 0.0;
        }
        // A limit of Z holds for its part of a way; without Z the way has none.
        let speed = self.z.speed.map_or(speed, |limit| speed.min(limit.0 * length / way[2]));
        let z_limit = self.z.acceleration.map_or(acceleration, |limit| limit.0) * length / way[2];
        if self.tick == 0.0 {
            let path_acceleration = acceleration.min(z_limit);
            let rules = RateRules { floor: self.rate, first: self.first_rate, s_curve: self.s_curve };
            return WholeRates::new(&rules, most_steps / length, speed, path_acceleration)
                .seconds(most_steps);
        }
        // Every axis speeds up at most so fast: together, at an angle, they are faster.
        let path_acceleration = z_limit.min(acceleration * length / way[0].max(way[1]));
        let ideal = Trapezoid::new(length, speed, path_acceleration);
        if ideal.total > LONG {
            return ideal.total;
        }
        self.stepped(&ideal, most_steps)
    }

    /// The time of a stroke of `most_steps` steps of the axis that has most of them along the way `ideal`.
    fn stepped(&self, ideal: &Trapezoid, most_steps: f64) -> f64 {
        let per_mm = most_steps / ideal.length;
        let (mut elapsed, mut owed_time, mut t, mut steps_left) = (0.0, 0.0, 0.0, most_steps);
        while steps_left > 0.0 {
            let (segment_time, end) = self.segment(ideal, t, LEAST / per_mm);
            t = end;
            let ahead = if t < ideal.total { per_mm * (ideal.length - ideal.way(t)) } else { 0.0 };
            let steps_after = (ahead - ROUNDING).ceil().max(0.0);
            let step_time = (segment_time + owed_time) / (steps_left - ahead);
            let step = if self.wraps { wrapped(step_time) } else { step_time };
            elapsed += (steps_left - steps_after) * step.min(1.0 / self.rate);
            owed_time = (steps_after - ahead) * step_time;
            steps_left = steps_after;
        }
        elapsed
    }

    /// The segment that begins at the time `start_time` of the way `ideal` and is at least so long: its time as the controller
    /// counts it, and the time of the way at which it ends.
    fn segment(&self, ideal: &Trapezoid, start_time: f64, least_way: f64) -> (f64, f64) {
        let start = ideal.way(start_time);
        let end_way = (start + least_way).min(ideal.length);
        let (mut counted_time, mut ticks, mut t) = (0.0, self.tick, start_time);
        loop {
            let rest = ticks - counted_time;
            if t < ideal.ramp && t + rest > ideal.ramp {
                counted_time += 2.0 * (ideal.way(ideal.ramp) - start) / (ideal.acceleration * t + ideal.top);
                t = ideal.ramp;
            } else {
                let end = (t + rest).min(ideal.total);
                counted_time += end - t;
                t = end;
            }
            if t >= ideal.total || (counted_time >= ticks - ROUNDING && ideal.way(t) >= end_way - ROUNDING) {
                return (counted_time, t);
            }
            // A time that is counted too long may exceed a tick.
            while counted_time >= ticks - ROUNDING {
                ticks += self.tick;
            }
        }
    }
}

/// The time that FluidNC gives a step which should take `step_time`, s. It computes the divisor of a step (8 at most) with a product
/// of 32 bits, which wraps around at every multiple of 26.8 ms: a step that takes one of them to half a per cent is divided too
/// little, and cut off at 16 bits of 20 MHz (repository bdring/FluidNC, Stepper.cpp, `timerTicks * amassFactor`).
fn wrapped(step_time: f64) -> f64 {
    const HZ: f64 = 20e6;
    const WRAP: f64 = 4_294_967_296.0;
    let (mut ticks, mut divided) = ((HZ * step_time).ceil(), 1.0);
    while divided < 8.0 && (ticks * 8_000.0) % WRAP >= HZ {
        (ticks, divided) = ((0.5 * ticks).floor(), 2.0 * divided);
    }
    ticks.min(65_535.0) * divided / HZ
}

#[cfg(test)]
impl Stepper {
    /// GRBL on an AVR at 80 steps/mm.
    pub(super) const GRBL: Self = Self {
        steps_per_mm: [80.0, 80.0, 400.0],
        rate: 30.52,
        tick: 0.01,
        wraps: false,
        first_rate: None,
        least_steps: 0.0,
        z: ZLimits { speed: None, acceleration: None },
        s_curve: false,
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::units::{Acceleration, Speed};

    #[test]
    fn a_step_of_fluidnc_wraps_at_multiples_of_27_ms() {
        let wrap = 4_294_967_296.0 / 8_000.0 / 20e6;
        for (told, takes) in
            [(0.01, 0.01), (0.03, 0.026_214), (1.001 * wrap, 0.003_277), (1.01 * wrap, 0.026_214)]
        {
            assert!((wrapped(told) - takes).abs() < 1e-6, "{told}: {}", wrapped(told));
        }
    }

    /// 1.2 times its lowest speed, mm/s.
    const SPEED: f64 = 0.64741;

    /// Calculated with the firmware's rules in 32-bit floats, as it does itself, by `tests/machines/clock`.
    #[test]
    fn strokes_take_as_long_as_on_the_controller() {
        for (acceleration, steps, seconds) in [
            (10.0, [16.0, 0.0, 0.0], 0.34893),
            (10.0, [11.0, 11.0, 0.0], 0.32237),
            (10.0, [12.0, -12.0, 0.0], 0.35096),
            (25.0, [16.0, 0.0, 0.0], 0.34224),
            (50.0, [0.0, 16.0, 0.0], 0.32623),
            (50.0, [11.0, 11.0, 0.0], 0.30952),
            (200.0, [16.0, 0.0, 0.0], 0.31216),
            (500.0, [12.0, 12.0, 0.0], 0.32858),
        ] {
            let computed = Stepper::GRBL.seconds(steps, SPEED, acceleration);
            assert!((computed - seconds).abs() < 5e-5, "{acceleration} {steps:?}: {computed}");
        }
    }

    #[test]
    fn fast_ramps_and_fine_steps_are_as_told() {
        let fine = Stepper { steps_per_mm: [800.0; 3], ..Stepper::GRBL };
        let ideal = 0.2 / SPEED + SPEED / 500.0;
        assert!((fine.seconds([160.0, 0.0, 0.0], SPEED, 500.0) - ideal).abs() < 1e-3);
        assert_eq!(fine.seconds([0.0; 3], SPEED, 500.0), 0.0);
        // Slow enough for ramps not to matter, and quick to calculate.
        assert!((fine.seconds([8e6, 0.0, 0.0], 1e-3, 10.0) - 1e7).abs() < 1.0);
    }

    /// Times of one stroke on the firmware's own code, built for Linux with the Ender-3's configuration (docs/testing.md), s.
    #[test]
    fn strokes_take_as_long_as_on_the_firmware() {
        let z = ZLimits { speed: Some(Speed(5.0)), acceleration: Some(Acceleration(100.0)) };
        let ender = Stepper { rate: 1.0, tick: 0.0, s_curve: true, z, ..Stepper::GRBL };
        for (first, steps, feed, seconds) in [
            (Some(120.0), [11.0, 0.0, 0.0], 1.7183, 0.081_891),
            (Some(120.0), [6.0, 9.0, 0.0], 1.7183, 0.077_898),
            (Some(120.0), [5.0, 0.0, 46.0], 1.7183, 0.090_061),
            (Some(120.0), [6.0, 0.0, 46.0], 1.7183, 0.093_330),
            (None, [10.0, 0.0, 0.0], 1.7183, 0.072_569),
            (None, [5.0, 0.0, 46.0], 1.7183, 0.090_991),
            (None, [6.0, 0.0, 46.0], 1.25, 0.117_034),
            (None, [0.0, 57.0, 0.0], 5.0, 0.150_020),
        ] {
            let computed = Stepper { first_rate: first, ..ender }.seconds(steps, feed, 500.0);
            assert!((computed - seconds).abs() < 5e-5, "{first:?} {steps:?}: {computed}");
        }
    }
}
