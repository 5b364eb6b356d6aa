//! GRBL and its family: the planner, the preparation of segments, and the timer, in 32-bit floats and in minutes, like the firmware
//! (gnea/grbl: planner.c, stepper.c, motion_control.c, nuts_bolts.c; grblHAL/core: the same names; bdring/FluidNC: Planner.cpp,
//! Stepper.cpp, NutsBolts.cpp).
//!
//! The buffer is kept full, as by a host that counts characters, or for a file on a card.

use std::collections::VecDeque;

use super::legs::{Leg, Task};
use super::timer::{Running, Timer};
use super::track::Track;

/// Blocks that the planner looks ahead (planner.h, BLOCK_BUFFER_SIZE less the one that is always empty).
const AHEAD: usize = 15;
/// $11, mm.
const JUNCTION_DEVIATION: f32 = 0.01;
/// config.h, MINIMUM_FEED_RATE, mm/min.
const LOWEST_FEED: f32 = 1.0;
/// A straight junction has no limit of its own.
const NO_LIMIT: f32 = 1e38;
/// stepper.c, DT_SEGMENT, min.
const TICK: f32 = 1.0 / (100.0 * 60.0);
/// stepper.c, REQ_MM_INCREMENT_SCALAR.
const STEPS_AT_LEAST: f32 = 1.25;

/// The settings.
pub(crate) struct Grbl {
    pub(crate) steps_per_mm: [f32; 3],
    /// mm/min^2.
    pub(crate) acceleration: [f32; 3],
    /// mm/min.
    pub(crate) max_rate: [f32; 3],
    pub(crate) timer: Timer,
}

/// plan_block_t: a path in whole steps.
struct Block {
    leg: Leg,
    steps: f32,
    length: f32,
    acceleration: f32,
    nominal: f32,
    entry_sqr: f32,
    max_entry_sqr: f32,
}

/// planner_t and the queue.
struct Planner<'a> {
    grbl: &'a Grbl,
    queue: VecDeque<Block>,
    position: [i64; 3],
    unit: [f32; 3],
    nominal: f32,
}

impl Grbl {
    pub(crate) fn run(&self, tasks: &[Task], track: &mut Track) {
        let mut timer = self.timer.started();
        let position = tasks.iter().find_map(|task| match task {
            Task::Leg(leg) => Some(self.steps(leg.from)),
            _ => None,
        });
        let (queue, position) = (VecDeque::new(), position.unwrap_or_default());
        let mut plan = Planner { grbl: self, queue, position, unit: [0.0; 3], nominal: 0.0 };
        for task in tasks {
            match task {
                Task::Leg(leg) => {
                    if plan.queue.len() == AHEAD {
                        plan.execute(&mut timer, track);
                    }
                    plan.add(leg);
                }
                Task::Dwell(_) | Task::Halt => {
                    while !plan.queue.is_empty() {
                        plan.execute(&mut timer, track);
                    }
                    timer.idle();
                    if let Task::Dwell(time) = task {
                        track.rest(timer.dwell(*time));
                    } else {
                        track.halt();
                    }
                }
            }
        }
        while !plan.queue.is_empty() {
            plan.execute(&mut timer, track);
        }
        track.halt();
    }

    fn steps(&self, position: [f64; 3]) -> [i64; 3] {
        std::array::from_fn(|i| (position[i] as f32 * self.steps_per_mm[i]).round() as i64)
    }
}

/// nuts_bolts.c, limit_value_by_axis_maximum.
fn limit_by_axis(limits: [f32; 3], unit: [f32; 3]) -> f32 {
    (0..3).filter(|i| unit[*i] != 0.0).map(|i| (limits[i] / unit[i]).abs()).fold(NO_LIMIT, f32::min)
}

/// nuts_bolts.c, convert_delta_vector_to_unit_vector.
fn unit(way: [f32; 3]) -> ([f32; 3], f32) {
    let length = way.iter().map(|d| d * d).sum::<f32>().sqrt();
    let inverse = 1.0 / length;
    (way.map(|d| d * inverse), length)
}

impl Planner<'_> {
    /// plan_buffer_line.
    fn add(&mut self, leg: &Leg) {
        let target = self.grbl.steps(leg.to);
        let delta: [i64; 3] = std::array::from_fn(|i| target[i] - self.position[i]);
        let steps = delta.iter().map(|d| d.abs()).max().unwrap_or(0);
        if steps == 0 {
            return;
        }
        let (direction, length) = unit(std::array::from_fn(|i| delta[i] as f32 / self.grbl.steps_per_mm[i]));
        let rapid = limit_by_axis(self.grbl.max_rate, direction);
        let nominal = leg.feed.map_or(rapid, |feed| (feed as f32).min(rapid)).max(LOWEST_FEED);
        let junction = if self.queue.is_empty() { 0.0 } else { self.junction(direction) };
        let max_entry_sqr = (nominal.min(self.nominal)).powi(2).min(junction);
        let acceleration = limit_by_axis(self.grbl.acceleration, direction);
        let leg = *leg;
        self.queue.push_back(Block {
            leg,
            steps: steps as f32,
            length,
            acceleration,
            nominal,
            entry_sqr: 0.0,
            max_entry_sqr,
        });
        (self.position, self.unit, self.nominal) = (target, direction, nominal);
        self.recalculate();
    }

    /// The highest speed at a bend, squared.
    fn junction(&self, direction: [f32; 3]) -> f32 {
        let previous = self.unit;
        let cos = -(0..3).map(|i| previous[i] * direction[i]).sum::<f32>();
        if cos > 0.999_999 {
            return 0.0;
        }
        if cos < -0.999_999 {
            return NO_LIMIT;
        }
        let (bend, _) = unit(std::array::from_fn(|i| direction[i] - previous[i]));
        let sin_half = (0.5 * (1.0 - cos)).sqrt();
        limit_by_axis(self.grbl.acceleration, bend) * JUNCTION_DEVIATION * sin_half / (1.0 - sin_half)
    }

    /// planner_recalculate: the last block stops; no block enters faster than it can brake from or be accelerated to.
    fn recalculate(&mut self) {
        let mut exit = 0.0;
        // The first one is running, or begins at rest.
        for block in self.queue.iter_mut().skip(1).rev() {
            block.entry_sqr = block.max_entry_sqr.min(exit + 2.0 * block.acceleration * block.length);
            exit = block.entry_sqr;
        }
        let mut limit = NO_LIMIT;
        for block in &mut self.queue {
            block.entry_sqr = block.entry_sqr.min(limit);
            limit = block.entry_sqr + 2.0 * block.acceleration * block.length;
        }
    }

    /// The first block, from its entry to the next one's.
    fn execute(&mut self, timer: &mut Running, track: &mut Track) {
        let Some(block) = self.queue.pop_front() else { return };
        track.begin(&block.leg);
        let exit_sqr = self.queue.front().map_or(0.0, |next| next.entry_sqr);
        Profile::new(&block, exit_sqr).segments(&block, |done, cycles, steps| {
            track.moved(f64::from(done), timer.run(cycles, steps));
        });
        if self.queue.is_empty() {
            timer.idle();
        }
    }
}

#[derive(PartialEq)]
enum Ramp {
    Accelerate,
    Cruise,
    Decelerate,
}

/// st_prep_t: the velocity profile; distances are from the end of the block.
struct Profile {
    ramp: Ramp,
    speed: f32,
    maximum: f32,
    exit: f32,
    accelerate_until: f32,
    decelerate_after: f32,
    acceleration: f32,
    remaining: f32,
}

impl Profile {
    /// st_prep_buffer, "Compute the velocity profile of a new planner block".
    fn new(block: &Block, exit_sqr: f32) -> Self {
        let (length, acceleration, entry_sqr) = (block.length, block.acceleration, block.entry_sqr);
        let half = 0.5 / acceleration;
        let nominal_sqr = block.nominal * block.nominal;
        let meet = 0.5 * (length + half * (entry_sqr - exit_sqr));
        let mut profile = Self {
            ramp: Ramp::Accelerate,
            speed: entry_sqr.sqrt(),
            maximum: block.nominal,
            exit: exit_sqr.sqrt(),
            accelerate_until: length,
            decelerate_after: 0.0,
            acceleration,
            remaining: length,
        };
        if meet <= 0.0 {
            (profile.accelerate_until, profile.maximum) = (0.0, profile.exit);
        } else if meet >= length {
            profile.ramp = Ramp::Decelerate;
        } else {
            profile.decelerate_after = half * (nominal_sqr - exit_sqr);
            if profile.decelerate_after < meet {
                if entry_sqr == nominal_sqr {
                    profile.ramp = Ramp::Cruise;
                } else {
                    profile.accelerate_until -= half * (nominal_sqr - entry_sqr);
                }
            } else {
                (profile.accelerate_until, profile.decelerate_after) = (meet, meet);
                profile.maximum = (2.0 * acceleration * meet + exit_sqr).sqrt();
            }
        }
        profile
    }

    /// Calls back with the completed part of each segment, the minutes a step, and its steps.
    fn segments(mut self, block: &Block, mut emit: impl FnMut(f32, f32, f32)) {
        let steps_per_mm = block.steps / block.length;
        let at_least = STEPS_AT_LEAST / steps_per_mm;
        let (mut steps, mut carry) = (block.steps, 0.0);
        while self.remaining > 0.0 {
            let time = self.segment((self.remaining - at_least).max(0.0)) + carry;
            let steps_left = steps_per_mm * self.remaining;
            let whole_left = steps_left.ceil();
            let inverse_rate = time / (steps - steps_left);
            emit(1.0 - whole_left / block.steps, inverse_rate, steps - whole_left);
            carry = (whole_left - steps_left) * inverse_rate;
            steps = whole_left;
        }
    }

    /// Advances by a tick, or by as many as it takes to get to `end` from the end; returns the time, min.
    fn segment(&mut self, end: f32) -> f32 {
        let (mut limit, mut time, mut part) = (TICK, 0.0_f32, TICK);
        let start = self.remaining;
        let mut remaining = start;
        loop {
            (remaining, part) = self.part(start, remaining, part);
            time += part;
            if time < limit {
                part = limit - time;
            } else if remaining > end {
                limit += TICK;
                part = limit - time;
            } else {
                break;
            }
            if remaining <= 0.0 {
                break;
            }
        }
        self.remaining = remaining;
        time
    }

    /// One ramp of a segment: returns the remaining path, and the elapsed time. `start` is the start of the segment.
    fn part(&mut self, start: f32, remaining: f32, time: f32) -> (f32, f32) {
        let change = self.acceleration * time;
        match self.ramp {
            Ramp::Accelerate => {
                let next = remaining - time * (self.speed + 0.5 * change);
                if next >= self.accelerate_until {
                    self.speed += change;
                    return (next, time);
                }
                let time = 2.0 * (start - self.accelerate_until) / (self.speed + self.maximum);
                let peak = self.accelerate_until == self.decelerate_after;
                self.ramp = if peak { Ramp::Decelerate } else { Ramp::Cruise };
                self.speed = self.maximum;
                (self.accelerate_until, time)
            }
            Ramp::Cruise => {
                let next = remaining - self.maximum * time;
                if next >= self.decelerate_after {
                    return (next, time);
                }
                self.ramp = Ramp::Decelerate;
                (self.decelerate_after, (remaining - self.decelerate_after) / self.maximum)
            }
            Ramp::Decelerate => {
                let next = remaining - time * (self.speed - 0.5 * change);
                if self.speed > change && next > 0.0 {
                    self.speed -= change;
                    return (next, time);
                }
                let time = 2.0 * remaining / (self.speed + self.exit);
                self.speed = self.exit;
                (0.0, time)
            }
        }
    }
}
