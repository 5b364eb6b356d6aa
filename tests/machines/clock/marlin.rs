//! Marlin: whole steps a second, ramps from a lowest rate, the wait of a block that meets an empty queue, and moves of a few steps that are
//! joined to the next (MarlinFirmware/Marlin, module/planner.cpp: `_populate_block`, `calculate_trapezoid_for_block`, `get_current_block`;
//! module/stepper.cpp: `block_phase_isr`, `calc_timer_interval`), as in 2.0.9.7 and in the newest sources.

use super::legs::{Leg, Task};
use super::track::Track;

/// planner.cpp, BLOCK_DELAY_FOR_1ST_MOVE: number of polls of an idle stepper, a millisecond each.
const FIRST_MOVE: f64 = 0.1;
/// gcode.cpp, `dwell`: `time += millis(); while (PENDING(millis(), time)) idle();`. A dwell of P ms begins within a millisecond of the clock and
/// ends with one, and the polls of the wait begin with the last step: together they take so much less on average, s.
const EARLY: f64 = 1.25e-3;
/// As often the time of `idle()` is added: at both ends of the dwell, and before the next line is read. The firmware's own code took this
/// time for 0.03 to 1 ms (docs/testing.md).
const IDLE_CALLS: f64 = 2.5;
/// The time of a call of `idle()` that the profile `marlin` counts with, s.
pub(crate) const IDLE: f64 = 0.5e-3;
/// The times that it takes on an Ender-3, s: hardly any; as long as the profile counts with; with a slow display.
pub(crate) const IDLE_TIMES: [f64; 3] = [0.0, 0.3e-3, 1e-3];
/// Number of blocks that end the wait early.
const NO_WAIT: usize = 3;
/// Configuration.h, JUNCTION_DEVIATION_MM.
const JUNCTION_DEVIATION: f64 = 0.013;

/// planner.cpp, `MINIMAL_STEP_RATE` of 2.0.x, steps/s.
const FIRST_RATE: f64 = 120.0;
/// Configuration_adv.h, `MINIMUM_PLANNER_SPEED` of 2.0.x, mm/s.
const LEAST_SPEED: f64 = 0.05;
/// Configuration_adv.h, `MIN_STEPS_PER_SEGMENT`: a block of fewer steps is dropped, and the next one begins where it would have.
const FEWEST: f64 = 6.0;

/// The version of a board's firmware.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Version {
    /// 2.0.x, and 1.1 before it.
    Two,
    /// The newest.
    Newest,
}

/// Settings of a board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Marlin {
    pub(crate) steps_per_mm: [f64; 3],
    /// Acceleration along the path, mm/s^2.
    pub(crate) acceleration: f64,
    /// Acceleration of Z, mm/s^2; X and Y have that of the path.
    pub(crate) z_acceleration: f64,
    /// Largest speed of each axis, mm/s.
    pub(crate) speed: [f64; 3],
    /// The lowest step rate, steps/s: 1 with 32 bits, 32 on an AVR.
    pub(crate) lowest_rate: f64,
    pub(crate) version: Version,
    /// Time of a call of `idle()`, s.
    pub(crate) idle: f64,
    /// S_CURVE_ACCELERATION.
    pub(crate) s_curve: bool,
}

/// block_t.
struct Block {
    leg: Leg,
    steps: f64,
    steps_per_mm: f64,
    length: f64,
    unit: [f64; 3],
    nominal_rate: f64,
    nominal: f64,
    /// mm/s^2
    acceleration: f64,
    /// Squares of speeds.
    least: f64,
    entry: f64,
}

impl Marlin {
    pub(crate) fn run(self, tasks: &[Task], track: &mut Track) {
        let mut queue: Vec<Block> = Vec::new();
        let (mut position, mut dropped) = (None, None);
        for task in tasks {
            match task {
                Task::Leg(leg) => {
                    let from = position.unwrap_or_else(|| self.steps(leg.from));
                    let to = self.steps(leg.to);
                    let leg = Leg { from: dropped.unwrap_or(leg.from), ..*leg };
                    if let Some(block) = self.block(&leg, from, to, queue.last()) {
                        queue.push(block);
                        (position, dropped) = (Some(to), None);
                    } else {
                        (position, dropped) = (Some(from), Some(leg.from));
                    }
                }
                Task::Dwell(time) => {
                    self.flush(&mut queue, track);
                    track.rest((time * 1e-3 - EARLY + IDLE_CALLS * self.idle).max(0.0));
                }
                Task::Halt => {
                    self.flush(&mut queue, track);
                    track.halt();
                }
            }
        }
        self.flush(&mut queue, track);
        track.halt();
    }

    fn steps(&self, position: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| (position[i] * self.steps_per_mm[i]).round())
    }

    /// _populate_block.
    fn block(&self, leg: &Leg, from: [f64; 3], to: [f64; 3], previous: Option<&Block>) -> Option<Block> {
        let delta: [f64; 3] = std::array::from_fn(|i| to[i] - from[i]);
        let steps = delta.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        let mm: [f64; 3] = std::array::from_fn(|i| delta[i] / self.steps_per_mm[i]);
        let length = super::legs::length(mm);
        if steps < FEWEST {
            return None;
        }
        let unit = mm.map(|d| d / length);
        let requested = leg.feed.unwrap_or(0.0) / 60.0;
        let factor = (0..3).map(|i| self.speed[i] / (requested * unit[i].abs())).fold(1.0, f64::min);
        let steps_per_mm = steps / length;
        let mut nominal_rate = (steps * requested / length).ceil();
        if factor < 1.0 {
            nominal_rate = (nominal_rate * factor).floor();
        }
        let nominal = requested * factor;
        // M204 is along the path; LIMIT_ACCEL, which no axis exceeds, is no less for X and Y, whose M201 has the same value.
        let limit = self.z_acceleration / unit[2].abs();
        let acceleration = (self.acceleration.min(limit) * steps_per_mm).ceil() / steps_per_mm;
        let slowest = match self.version {
            Version::Two => LEAST_SPEED * LEAST_SPEED,
            Version::Newest => (0.5 * acceleration / steps_per_mm).min(nominal * nominal),
        };
        let entry = previous.map_or(slowest, |previous| {
            let bend = Self::bend(previous.unit, unit, acceleration);
            bend.min(nominal.min(previous.nominal).powi(2)).max(slowest)
        });
        Some(Block {
            leg: *leg,
            steps,
            steps_per_mm,
            length,
            unit,
            nominal_rate,
            nominal,
            acceleration,
            least: slowest,
            entry,
        })
    }

    /// The square of the highest speed at a bend (HAS_JUNCTION_DEVIATION).
    fn bend(previous: [f64; 3], unit: [f64; 3], acceleration: f64) -> f64 {
        let cos = -(0..3).map(|i| previous[i] * unit[i]).sum::<f64>();
        if cos > 0.999_999 {
            return 0.0;
        }
        let sin_half = (0.5 * (1.0 - cos.max(-0.999_999))).sqrt();
        acceleration * JUNCTION_DEVIATION * sin_half / (1.0 - sin_half)
    }

    fn flush(&self, queue: &mut Vec<Block>, track: &mut Track) {
        let mut exit = queue.last().map_or(0.0, |last| last.least);
        for block in queue.iter_mut().rev() {
            block.entry = block.entry.min(exit + 2.0 * block.acceleration * block.length).max(block.least);
            exit = block.entry;
        }
        if !queue.is_empty() && queue.len() < NO_WAIT {
            if !queue[0].leg.cut {
                track.halt();
            }
            track.rest(FIRST_MOVE);
        }
        let mut limit = queue.first().map_or(0.0, |first| first.least);
        for block in queue.iter_mut() {
            block.entry = block.entry.min(limit).max(block.least);
            limit = block.entry + 2.0 * block.acceleration * block.length;
        }
        let last = queue.last().map_or(0.0, |last| last.least);
        let exits: Vec<f64> = queue.iter().skip(1).map(|block| block.entry).chain([last]).collect();
        for (block, exit) in queue.drain(..).zip(exits) {
            track.begin(&block.leg);
            match self.version {
                Version::Two => self.step_of_two(&block, exit.sqrt(), track),
                Version::Newest => self.step(&block, exit.sqrt(), track),
            }
        }
    }

    /// calculate_trapezoid_for_block and block_phase_isr, a step after the other.
    fn step(&self, block: &Block, exit: f64, track: &mut Track) {
        let rate = |speed: f64| (speed * block.steps_per_mm).round().max(self.lowest_rate);
        let (initial, last) = (rate(block.entry.sqrt()), rate(exit));
        let nominal = block.nominal_rate.max(self.lowest_rate);
        let a = block.acceleration * block.steps_per_mm;
        let steps_to = |from: f64| 0.5 * (nominal * nominal - from * from) / a;
        let (mut up, mut down) = (steps_to(initial).ceil().max(0.0), steps_to(last).ceil().max(0.0));
        if up + down > block.steps {
            up = (0.5 * (block.steps + steps_to(initial) - steps_to(last))).round().clamp(0.0, block.steps);
            down = block.steps - up;
        }
        let cruise = nominal.min((initial * initial + 2.0 * a * up).sqrt());
        // "Initialize ac/deceleration time as if half the time passed."
        let (mut count, mut peak) = (1.0, initial);
        let (mut speeding, mut braking) = (0.5 / initial, 0.0);
        track.moved(1.0 / block.steps, 1.0 / initial);
        while count < block.steps {
            let rate = if count < up {
                peak = if self.s_curve {
                    bezier(initial, cruise, a, speeding)
                } else {
                    (initial + (a * speeding).floor()).min(nominal)
                };
                speeding += 1.0 / peak;
                peak
            } else if count >= block.steps - down {
                let rate = if self.s_curve {
                    bezier(cruise, last, a, braking)
                } else {
                    (peak - (a * braking).floor()).max(last)
                };
                braking += 1.0 / rate;
                rate
            } else {
                (peak, braking) = (nominal, 0.5 / nominal);
                nominal
            };
            // calc_timer_interval, without the rounding of its table.
            let seconds = 1.0 / rate.max(self.lowest_rate);
            count += 1.0;
            track.moved(count / block.steps, seconds);
        }
    }

    /// The steps of a block by 2.0.x: blocks begin and end at 120 steps/s, and the rate after a step is that of the time before it.
    fn step_of_two(&self, block: &Block, exit: f64, track: &mut Track) {
        let nominal = block.nominal_rate.max(self.lowest_rate);
        let rate = |speed: f64| (nominal * speed / block.nominal).ceil().max(FIRST_RATE);
        let (initial, last) = (rate(block.entry.sqrt()), rate(exit));
        let a = block.acceleration * block.steps_per_mm;
        let ramp = |from: f64| (nominal * nominal - from * from) * 0.5 / a;
        // uint32_t of a negative number: 0 on an ARM, a huge number on other boards, with the same effect.
        let (mut up, down) = (ramp(initial).ceil().max(0.0), ramp(last).floor().max(0.0));
        let mut decelerate_after = block.steps - down;
        if up + down > block.steps {
            up = (0.5 * (block.steps + ramp(initial) - ramp(last))).ceil().clamp(0.0, block.steps);
            decelerate_after = up;
        }
        let cruise = nominal.min((initial * initial + 2.0 * a * up).sqrt()).max(initial);
        let (mut speeding, mut braking, mut peak) = (0.0_f64, 0.0_f64, initial);
        let mut interval = 1.0 / initial;
        let mut count = 0.0;
        while count < block.steps {
            count += 1.0;
            track.moved(count / block.steps, interval);
            let step_rate = if count <= up {
                peak = if self.s_curve {
                    bezier(initial, cruise, a, speeding)
                } else {
                    (initial + (a * speeding).floor()).min(nominal)
                };
                peak
            } else if count > decelerate_after {
                if self.s_curve {
                    bezier(cruise, last, a, braking)
                } else {
                    (peak - (a * braking).floor()).max(last)
                }
            } else {
                nominal
            };
            interval = 1.0 / step_rate.max(self.lowest_rate);
            if count <= up {
                speeding += interval;
            } else if count > decelerate_after {
                braking += interval;
            }
        }
    }
}

/// _calc_bezier_curve_coeffs and _eval_bezier_curve: the rate `time` after a ramp between two rates began, which takes as long as an even one.
fn bezier(from: f64, to: f64, acceleration: f64, time: f64) -> f64 {
    let t = (time * acceleration / (to - from).abs()).min(1.0);
    if t < 1.0 {
        (from + (to - from) * (6.0 * t.powi(5) - 15.0 * t.powi(4) + 10.0 * t.powi(3))).floor()
    } else {
        to
    }
}
