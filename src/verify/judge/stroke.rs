//! How long the controller takes for a stroke from rest to rest: the verifier's own reckoning.
//!
//! Without a tick in the profile a stroke speeds up evenly, goes on at its feed, and brakes. With one it is made as GRBL
//! makes it (repository gnea/grbl, stepper.c): whole steps, evenly within a stretch of whole ticks in which at least a
//! step and a quarter is travelled, none waited for longer than the lowest step rate says, and an eighth of the last
//! one's time before it counts as done.

use crate::spec::{Motion, StepRate};

/// What was travelled since the iron last stood still.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Run {
    /// Whole steps of each axis; lengths in mm where the steps are not known.
    moved: [f64; 3],
    length: f64,
}

impl Run {
    /// The run with one more move from `from` to `to`, of this length, mm.
    pub(super) fn and(self, motion: &Motion, from: [f64; 3], to: [f64; 3], length: f64) -> Self {
        let scale = motion.steps_per_mm.unwrap_or([1.0; 3]);
        let whole = |mm: f64, axis: usize| (mm * scale[axis]).round();
        let moved = std::array::from_fn(|i| self.moved[i] + (whole(to[i], i) - whole(from[i], i)).abs());
        Self { moved, length: self.length + length }
    }

    /// Time from rest to rest, s, at `speed` mm/s.
    pub(super) fn seconds(&self, motion: &Motion, speed: f64) -> f64 {
        let wait = motion.start_delay.0;
        let Some(a) = motion.acceleration.map(|a| a.0) else { return wait + self.length / speed };
        let ramps = |length: f64, a: f64| Ramps::new(length, speed, a);
        match (motion.tick, motion.step_rate, motion.steps_per_mm) {
            (Some(tick), StepRate::AtLeast(rate), Some(scale)) => {
                let mm: [f64; 3] = std::array::from_fn(|i| self.moved[i] / scale[i]);
                let length = mm[0].hypot(mm[1]).hypot(mm[2]);
                let steps = self.moved.into_iter().fold(0.0, f64::max);
                if steps < 1.0 {
                    return wait;
                }
                // X and Y have this acceleration each: along a diagonal they have more.
                let share = mm[0].max(mm[1]) / length;
                let way = ramps(length, if share > 0.0 { a / share } else { a });
                wait + if way.time < 20.0 { way.ticked(steps, tick.0, 1.0 / rate) } else { way.time }
            }
            _ => wait + ramps(self.length, a).time,
        }
    }
}

/// Time that the controller takes for one straight stroke from rest to rest, s, at `speed` mm/s; positions in mm.
pub fn stroke_seconds(motion: &Motion, from: [f64; 3], to: [f64; 3], speed: f64) -> f64 {
    let length = (0..3).map(|i| to[i] - from[i]).fold(0.0, f64::hypot);
    Run::default().and(motion, from, to, length).seconds(motion, speed)
}

/// Speeding up, going on, braking.
struct Ramps {
    length: f64,
    acceleration: f64,
    /// The speed that is reached.
    reached: f64,
    time: f64,
}

impl Ramps {
    fn new(length: f64, speed: f64, acceleration: f64) -> Self {
        // Half the way is for speeding up, if the speed is not reached before.
        let reached = speed.min((acceleration * length).sqrt());
        let even = length - reached * reached / acceleration;
        Self { length, acceleration, reached, time: 2.0 * reached / acceleration + even / reached }
    }

    /// The part of the way that is done at `t`, 0 to 1.
    fn done(&self, t: f64) -> f64 {
        // From the nearer end both halves look the same.
        let (near, turned) = if 2.0 * t > self.time { (self.time - t, true) } else { (t, false) };
        let whole = self.reached / self.acceleration;
        let ramp = near.clamp(0.0, whole);
        let way = 0.5 * self.acceleration * ramp * ramp + self.reached * (near - ramp).max(0.0);
        if turned { 1.0 - way / self.length } else { way / self.length }
    }

    /// Time for `steps` whole steps along it, s, no step longer than `longest`.
    fn ticked(&self, steps: f64, tick: f64, longest: f64) -> f64 {
        let (mut spent, mut made) = (0.0_f64, 0.0_f64);
        // Where the last stretch ended: time, steps and parts of a step, and time that is kept for the step begun there.
        let (mut cut, mut reached, mut kept) = (0.0_f64, 0.0_f64, 0.0_f64);
        let (mut each, mut ticks) = (0.0_f64, 0.0_f64);
        while made < steps {
            ticks += 1.0;
            let now = (ticks * tick).min(self.time);
            let over = now >= self.time;
            let here = if over { steps } else { steps * self.done(now) };
            if !over && here < (reached + 1.25).min(steps) {
                continue;
            }
            let interval = (now - cut + kept) / (here - made);
            let whole = if over { steps } else { (here + 1e-9).floor() };
            each = interval.min(longest);
            spent += (whole - made) * each;
            kept = (here - whole) * interval;
            (cut, reached, made) = (now, here, whole);
        }
        spent + each / 8.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{Acceleration, Duration};

    /// Figures reckoned with the firmware's rules in 32-bit floats.
    #[test]
    fn a_stroke_takes_as_long_as_on_grbl() {
        for (acceleration, to, seconds) in [
            (10.0, [0.2, 0.0, 0.0], 0.35301),
            (10.0, [0.1375, 0.1375, 0.0], 0.32142),
            (25.0, [0.2, 0.0, 0.0], 0.33884),
            (50.0, [0.0, -0.2, 0.0], 0.32508),
            (200.0, [0.15, -0.15, 0.0], 0.3335),
            (500.0, [0.2, 0.0, 0.0], 0.3127),
        ] {
            let motion = Motion {
                steps_per_mm: Some([80.0, 80.0, 400.0]),
                step_rate: StepRate::AtLeast(30.52),
                acceleration: Some(Acceleration(acceleration)),
                tick: Some(Duration(0.01)),
                ..Motion::UNKNOWN
            };
            let run = Run::default().and(&motion, [0.0; 3], to, 0.2);
            let found = run.seconds(&motion, 0.64741);
            assert!((found - seconds).abs() < 5e-5, "{acceleration} {to:?}: {found}");
        }
    }
}
