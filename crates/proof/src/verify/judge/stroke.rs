//! The controller's time for a stroke from rest to rest: the verifier's own calculation.
//!
//! Without a tick in the profile a stroke speeds up evenly, goes on at its feed, and brakes. With one it is made as GRBL
//! makes it (repository gnea/grbl, stepper.c): whole steps, evenly within a stretch of whole ticks in which at least a
//! step and a quarter is travelled, with no step longer than that of the lowest step rate. The tick in which the speed is
//! reached counts as if all of its stretch had been travelled in it.

use spec::{Motion, Seal, StepRate};

/// The run since the iron last rested.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StrokeRun {
    /// Whole steps of each axis; lengths in mm where the steps are unknown.
    moved: [f64; 3],
    length: f64,
    /// Moves that the controller makes.
    moves: usize,
    /// Steps of moves that have too few of them, and whether there are such moves: the controller joins them to the next one.
    joined: [f64; 3],
    is_short: bool,
}

impl StrokeRun {
    /// The run with one more move from `from` to `to`, of this length, mm.
    pub(super) fn and(self, motion: &Motion, from: [f64; 3], to: [f64; 3], length: f64) -> Self {
        let scale = motion.steps_per_mm.unwrap_or([1.0; 3]);
        let joined: [f64; 3] = std::array::from_fn(|i| {
            self.joined[i] + (to[i] * scale[i]).round() - (from[i] * scale[i]).round()
        });
        let largest = joined.into_iter().map(f64::abs).fold(0.0, f64::max);
        let is_short = motion.steps_per_mm.is_some() && largest < motion.min_move_steps;
        let run = Self { joined, is_short, length: self.length + length, ..self };
        if is_short {
            return run;
        }
        let moved = std::array::from_fn(|i| self.moved[i] + joined[i].abs());
        Self { moved, joined: [0.0; 3], moves: self.moves + 1, ..run }
    }

    /// Whether the last moves have so few steps that the controller has not made them yet.
    pub(super) fn is_short(&self) -> bool {
        self.is_short
    }

    /// Time from rest to rest, s, at `speed` mm/s.
    pub(super) fn seconds(&self, motion: &Motion, speed: f64) -> f64 {
        // Marlin's queue begins at once when it has three moves (planner.cpp, get_current_block).
        let is_queued = motion.has_whole_rates() && self.moves > 2;
        let wait = if is_queued { 0.0 } else { motion.start_delay.0 };
        let Some(a) = motion.acceleration.map(|a| a.0) else { return wait + self.length / speed };
        match (motion.tick, motion.step_rate, motion.steps_per_mm) {
            (Some(tick), StepRate::AtLeast(rate), Some(scale)) => {
                let mm: [f64; 3] = std::array::from_fn(|i| self.moved[i] / scale[i]);
                let length = libm::hypot(libm::hypot(mm[0], mm[1]), mm[2]);
                let steps = self.moved.into_iter().fold(0.0, f64::max);
                if steps < 1.0 {
                    return wait;
                }
                // The parts of the way that are X or Y, and Z.
                let (flat, upright) = (mm[0].max(mm[1]) / length, mm[2] / length);
                let z_speed = motion.z.speed.map_or(f64::INFINITY, |limit| limit.0);
                let z_a = motion.z.acceleration.map_or(a, |limit| limit.0);
                let speed = if upright * speed > z_speed { z_speed / upright } else { speed };
                if tick.0 == 0.0 {
                    let a = if upright * a > z_a { z_a / upright } else { a };
                    return wait + whole_rates(motion, steps, length, MarlinStroke { speed, a, floor: rate });
                }
                // Every axis has its own acceleration: along a diagonal they have more.
                let way = Ramps::new(length, speed, (a / flat).min(z_a / upright));
                let interval = |told: f64| if motion.wraps { early(told) } else { told }.min(1.0 / rate);
                wait + if way.time < 20.0 { way.ticked(steps, tick.0, interval) } else { way.time }
            }
            _ => wait + Ramps::new(self.length, speed, a).time,
        }
    }
}

/// Time that the controller takes for one straight stroke from rest to rest, s, at `speed` mm/s; positions in mm.
pub fn stroke_seconds(motion: &Motion, from: [f64; 3], to: [f64; 3], speed: f64) -> f64 {
    let length = (0..3).map(|i| to[i] - from[i]).fold(0.0, libm::hypot);
    StrokeRun::default().and(motion, from, to, length).seconds(motion, speed)
}

/// The longest time of one step of every axis from rest to rest, s; 0 where the steps are unknown.
pub(super) fn step_seconds(motion: &Motion, speed: f64) -> f64 {
    let run = StrokeRun { moved: [1.0; 3], ..StrokeRun::default() };
    motion.steps_per_mm.map_or(0.0, |_| run.seconds(motion, speed) - motion.start_delay.0)
}

/// The shortest way in the plane that has the steps of a move in every direction, mm.
pub(super) fn shortest_move(motion: &Motion) -> f64 {
    motion.steps_per_mm.map_or(0.0, |[x, y, _]| {
        motion.min_move_steps * libm::hypot(millimetres_per_step(x), millimetres_per_step(y))
    })
}

/// The least time of a longest stroke of `seal`, s, at the feed `feed`, mm/s: where the end of a dwell is uncertain by a millisecond (Marlin),
/// 0.7 s, or as long as the wait of a start and the longest rest allow beside a joined move, but a quarter of a second.
pub(super) fn least_time(motion: &Motion, seal: &Seal, feed: f64) -> f64 {
    if !motion.has_whole_rates() {
        return 0.0;
    }
    let (shortest, speed) = (shortest_move(motion), seal.speed.0);
    let rest = ((0.1 * seal.band.0).max(2.0 * shortest) - shortest) / speed;
    ((motion.start_delay.0 + rest) * feed / (feed - speed)).clamp(0.25, 0.7)
}

fn millimetres_per_step(scale: f64) -> f64 {
    1.0 / scale
}

/// A stroke on Marlin: its speed, mm/s, and acceleration, mm/s^2, along the way, and the lowest step rate, steps/s.
#[derive(Clone, Copy)]
struct MarlinStroke {
    speed: f64,
    a: f64,
    floor: f64,
}

/// Time on Marlin (repository MarlinFirmware/Marlin, planner.cpp and stepper.cpp): every step has a rate of its own, in whole
/// steps a second, which is rounded up and is never below the floor; versions up to 2.0.x begin and end with the rate of the first step.
fn whole_rates(motion: &Motion, steps: f64, length: f64, stroke: MarlinStroke) -> f64 {
    let MarlinStroke { speed, a, floor } = stroke;
    let scale = steps / length;
    let even = (speed * scale - 1e-6).ceil().max(floor);
    let gain = (a * scale).ceil();
    if steps > 1e4 {
        return steps / even;
    }
    if let Some(first) = motion.first_step_rate {
        let first = first.max((0.05 * scale).ceil()).max(floor);
        return with_first(steps, RateRamp { even, gain, s_curve: motion.s_curve }, first);
    }
    let slow = (speed.min((a / scale / 2.0).sqrt()) * scale).round().max(floor);
    let ramp = ((even.powi(2) - slow.powi(2)) / gain / 2.0).ceil().max(0.0);
    let has_no_cruise = ramp + ramp > steps;
    let end_of_ramp = if has_no_cruise { (0.5 * steps).round() } else { ramp };
    let brake = if has_no_cruise { end_of_ramp } else { steps - ramp };
    let cruise =
        if has_no_cruise { even.min((slow.powi(2) + 2.0 * gain * end_of_ramp).sqrt()) } else { even };
    let curve = RateRamp { even: cruise, gain, s_curve: motion.s_curve };
    let (mut count, mut total, mut top) = (1.0, slow.recip(), slow);
    let (mut rising, mut falling) = (0.5 / slow, 0.0);
    while count < steps {
        let interval = if count < end_of_ramp {
            top = curve.rising_rate(slow, rising).min(even);
            rising += top.recip();
            top.recip()
        } else if count < brake {
            (top, falling) = (even, 0.5 / even);
            even.recip()
        } else {
            let interval = curve.braking_rate(top, slow, falling).recip();
            falling += interval;
            interval
        };
        total += interval;
        count += 1.0;
    }
    total
}

/// The rates between the slowest and the even one, steps/s, as they change with the gain, steps/s^2.
#[derive(Clone, Copy)]
struct RateRamp {
    even: f64,
    gain: f64,
    s_curve: bool,
}

impl RateRamp {
    /// The rate `time` after a beginning at `slow`.
    fn rising_rate(self, slow: f64, time: f64) -> f64 {
        if self.s_curve { self.curved(slow, self.even, time) } else { slow + (self.gain * time).floor() }
    }

    /// The rate `time` after braking began, evenly at `top`, down to `slow`.
    fn braking_rate(self, top: f64, slow: f64, time: f64) -> f64 {
        if self.s_curve {
            self.curved(self.even, slow, time)
        } else {
            slow.max(top - (self.gain * time).floor())
        }
    }

    /// Marlin's curve of the fifth degree from one rate to another.
    fn curved(self, from: f64, to: f64, time: f64) -> f64 {
        let duration = (to - from).abs() / self.gain;
        if time >= duration {
            return to;
        }
        let x = time / duration;
        let weight = 6.0 * x.powi(5) - 15.0 * x.powi(4) + 10.0 * x.powi(3);
        ((1.0 - weight) * from + weight * to).floor()
    }
}

/// Time of a stroke that begins and ends at the rate `first`: the rate after a step is that of the time before it.
fn with_first(steps: f64, ramp: RateRamp, first: f64) -> f64 {
    let RateRamp { even, gain, .. } = ramp;
    let part = 0.5 * (even - first).max(0.0) * (even + first) / gain;
    let meet = (0.5 * steps).ceil();
    let has_no_cruise = part.ceil() + part.floor() > steps;
    let (gained, braking) = if has_no_cruise { (meet, steps - meet) } else { (part.ceil(), part.floor()) };
    let cruise = if has_no_cruise { even.min((first.powi(2) + 2.0 * gain * meet).sqrt()) } else { even };
    let curve = RateRamp { even: cruise, ..ramp };
    let (mut total, mut rising, mut falling, mut top) = (first.recip(), 0.0, 0.0, first);
    let mut step = 1.0;
    while step < steps {
        let rate = if step <= gained {
            top = curve.rising_rate(first, rising).min(even);
            rising += top.recip();
            top
        } else if step + braking > steps {
            let rate = curve.braking_rate(top, first, falling);
            falling += rate.recip();
            rate
        } else {
            even
        };
        total += rate.recip();
        step += 1.0;
    }
    total
}

/// The time of a step on FluidNC that should take `interval`, s (repository bdring/FluidNC, Stepper.cpp): cycles of 20 MHz are
/// halved, up to three times, until 8,000 of them, in 32 bits, are below 20 million; 16 bits of them are counted.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a step takes a day at most")]
fn early(interval: f64) -> f64 {
    let mut cycles = (interval * 2e7).ceil() as u64;
    let mut halvings = 0;
    while halvings < 3 && (cycles * 8000) & 0xffff_ffff >= 20_000_000 {
        cycles /= 2;
        halvings += 1;
    }
    f64::from(1 << halvings) * f64::from(cycles.min(0xffff) as u32) / 2e7
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
        let top_speed = speed.min((acceleration * length).sqrt());
        let even = length - top_speed * top_speed / acceleration;
        Self {
            length,
            acceleration,
            reached: top_speed,
            time: 2.0 * top_speed / acceleration + even / top_speed,
        }
    }

    /// The part of the way that is done at `t`, 0 to 1.
    fn part_done(&self, t: f64) -> f64 {
        // From the nearer end both halves look the same.
        let (from_end, turned) = if 2.0 * t > self.time { (self.time - t, true) } else { (t, false) };
        let ramp_time = self.reached / self.acceleration;
        let ramp = from_end.clamp(0.0, ramp_time);
        let way = 0.5 * self.acceleration * ramp * ramp + self.reached * (from_end - ramp).max(0.0);
        if turned { 1.0 - way / self.length } else { way / self.length }
    }

    /// Time for `steps` whole steps along it, s; `interval` returns the real time of a step from its nominal one.
    fn ticked(&self, steps: f64, tick: f64, interval: impl Fn(f64) -> f64) -> f64 {
        let (mut spent, mut count) = (0.0_f64, 0.0_f64);
        // The end of the last stretch: time, steps and parts of a step, and time that is kept for the step begun there.
        let (mut cut, mut part, mut carry) = (0.0_f64, 0.0_f64, 0.0_f64);
        while count < steps {
            let (time, interval_time) = self.stretch(cut, tick, (part + 1.25).min(steps) / steps);
            // The last of the way takes long, and is nothing: a stretch that ends in it has done all.
            let is_over = time >= self.time || self.part_done(time) > 1.0 - 1e-9;
            let steps_due = if is_over { steps } else { steps * self.part_done(time) };
            let interval_of_step = (interval_time + carry) / (steps_due - count);
            let whole_steps = if is_over { steps } else { (steps_due + 1e-9).floor() };
            spent += (whole_steps - count) * interval(interval_of_step);
            carry = (steps_due - whole_steps) * interval_of_step;
            (cut, part, count) = (time, steps_due, whole_steps);
        }
        spent
    }

    /// The end of the stretch from `cut`, which goes on to the part `goal` of the way at least, and its counted time, s.
    fn stretch(&self, cut: f64, tick: f64, goal: f64) -> (f64, f64) {
        let at_speed = self.reached / self.acceleration;
        let (mut time, mut counted_time, mut allowed) = (cut, 0.0_f64, 0.0_f64);
        while time < self.time && (counted_time + 1e-9 < allowed || self.part_done(time) < goal - 1e-9) {
            while counted_time + 1e-9 >= allowed {
                allowed += tick;
            }
            let next = (time + allowed - counted_time).min(self.time);
            if time < at_speed && at_speed < next {
                let way = self.length * (self.part_done(at_speed) - self.part_done(cut));
                counted_time += way / (0.5 * (self.acceleration * time + self.reached));
                time = at_speed;
            } else {
                counted_time += next - time;
                time = next;
            }
        }
        (time, counted_time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::units::{Acceleration, Duration};

    /// A stretch may end where the remainder is within rounding: there is no further one.
    #[test]
    fn every_stroke_ends() {
        for i in 1..20_000_u32 {
            let length = f64::from(i) * 1e-3;
            for (speed, a) in [(0.5, 10.0), (20.0, 10.0), (5.0, 500.0)] {
                let steps = (length * 400.0).round().max(1.0);
                let seconds = Ramps::new(length, speed, a).ticked(steps, 0.01, |told| told.min(1.0));
                assert!(seconds.is_finite() && seconds > 0.0, "{length} {speed} {a}: {seconds}");
            }
        }
    }

    /// Figures calculated with the firmware's rules in 32-bit floats, by `tests/machines/clock`.
    #[test]
    fn a_stroke_takes_as_long_as_on_grbl() {
        for (acceleration, to, seconds) in [
            (10.0, [0.2, 0.0, 0.0], 0.34893),
            (10.0, [0.1375, 0.1375, 0.0], 0.32237),
            (25.0, [0.2, 0.0, 0.0], 0.34224),
            (50.0, [0.0, -0.2, 0.0], 0.32623),
            (200.0, [0.15, -0.15, 0.0], 0.32996),
            (500.0, [0.2, 0.0, 0.0], 0.31022),
        ] {
            let motion = Motion {
                steps_per_mm: Some([80.0, 80.0, 400.0]),
                step_rate: StepRate::AtLeast(30.52),
                acceleration: Some(Acceleration(acceleration)),
                tick: Some(Duration(0.01)),
                ..Motion::UNKNOWN
            };
            let run = StrokeRun::default().and(&motion, [0.0; 3], to, 0.2);
            let measured = run.seconds(&motion, 0.64741);
            assert!((measured - seconds).abs() < 5e-5, "{acceleration} {to:?}: {measured}");
        }
    }
}
