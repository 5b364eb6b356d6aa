//! Chopping: how long strokes are, how fast, and how long the controller takes for them.

use crate::plan::stepper::Stepper;
use crate::plan::written::Precision;
use spec::{Machine, Motion, Spec, StepRate};

/// Strokes in a band, at least. Half a band then has six rests, or one more or less, so that the speed within it is right
/// to 15 %; of twelve strokes it was 15.5 % on one controller, of ten 16 %. The more there are, the larger a part of a stroke is a step of the motors.
const STROKES: f64 = 13.0;

/// Strokes in a band where a controller joins short moves: now and then a stroke is longer by a part of another one.
const SHORT_STROKES: f64 = 15.0;

/// The wait of a start on Marlin, beside the dwell before it, s: on a board whose display takes hardly any time, and on one whose display
/// keeps the firmware busy for a millisecond at a time (docs/clock.md), with a fifth more for strokes on arcs, which are shorter.
const WAITS: [f64; 2] = [98.7e-3, 101.6e-3];

/// Time of a longest stroke where rates are whole steps a second, s, so that a millisecond of a wait is less than 0.2 % of it.
const ACCURATE_TIME: f64 = 0.7;

/// Least time of such a stroke, s, where the rest after a longer one would leave a scar.
const LEAST_TIME: f64 = 0.25;

/// Moves in the queue that end the wait of the first one, where rates are whole steps a second (Marlin, planner.cpp, `get_current_block`).
const MOVES_WITHOUT_WAIT: u32 = 3;

/// The limits by which a path is chopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chop {
    /// Speed of a stroke, mm/s.
    pub speed: f64,
    /// Longest stroke, mm: a thirteenth of the band, or as much as it takes to have time left for a dwell.
    pub longest: f64,
    /// Shortest stroke that the controller makes in every direction, mm; 0 where it makes any.
    pub least: f64,
    /// The precision of moves in the file.
    pub file: Precision,
    /// Acceleration, mm/s^2.
    pub acceleration: f64,
    /// Dwells are multiples of this, s.
    pub step: f64,
    /// Longest dwell, s: the time of the iron for a tenth of the band. A longer one leaves a scar. Where steps are coarse it is
    /// that of two shortest strokes.
    pub rest: f64,
    /// Wait of a move that meets an empty queue, s.
    pub start_delay: f64,
    /// The steps of the controller, if it is one of GRBL's family and all their data are known.
    pub stepper: Option<Stepper>,
}

/// The steps of the controller, if all their data are known.
pub fn stepper(motion: &Motion) -> Option<Stepper> {
    let StepRate::AtLeast(rate) = motion.step_rate else { return None };
    Some(Stepper {
        steps_per_mm: motion.steps_per_mm?,
        rate,
        tick: motion.tick?.0,
        wraps: motion.wraps,
        first_rate: motion.first_step_rate,
        least_steps: motion.min_move_steps,
        z: motion.z,
        s_curve: motion.s_curve,
    })
}

impl Chop {
    /// The chop of a seal of `spec` on `machine`; `None` where too little is known of the machine.
    pub fn new(spec: &Spec, machine: &Machine) -> Option<Self> {
        let (motion, speed, band) = (&machine.motion, spec.seal.speed.0, spec.seal.band.0);
        let least_move = motion.least_move();
        let strokes = if least_move > 0.0 { SHORT_STROKES } else { STROKES };
        let chop = Self {
            speed: motion.chop_speed(speed)?,
            longest: (band / strokes).max(least_move),
            least: least_move,
            file: Precision { path: spec.accuracy.path, arcs: machine.controller.arcs },
            acceleration: motion.acceleration?.0,
            step: machine.controller.dwell.step.0,
            rest: (band / 10.0).max(2.0 * least_move) / speed,
            start_delay: motion.start_delay.0,
            stepper: stepper(motion),
        };
        let least_time = if motion.has_whole_rates() { chop.least_time(speed) } else { 0.0 };
        Some(Self { longest: chop.longest.max(chop.least_stroke(speed)).max(least_time * speed), ..chop })
    }

    /// The least time of a longest stroke where rates are whole, s, at the mean speed `speed`, mm/s: so short that the longest rest is
    /// enough where a shortest move is joined to the stroke.
    fn least_time(&self, speed: f64) -> f64 {
        let rest = self.start_delay + self.rest - self.least / speed;
        (rest * self.speed / (self.speed - speed)).clamp(LEAST_TIME, ACCURATE_TIME)
    }

    /// The fraction by which the mean speed `speed`, mm/s, may be off because the end of a dwell depends on what else the firmware
    /// does (Marlin); `None` where it does not.
    pub fn dwell_error(&self, speed: f64) -> Option<f64> {
        let error = WAITS.into_iter().map(|wait| (wait - self.start_delay).abs()).fold(0.0, f64::max);
        self.has_whole_rates().then(|| error * speed / self.longest)
    }

    /// Whether rates are whole steps a second (Marlin).
    fn has_whole_rates(&self) -> bool {
        self.stepper.is_some_and(|stepper| stepper.tick == 0.0)
    }

    /// The wait before `moves` moves that meet an empty queue, s.
    fn wait(&self, moves: u32) -> f64 {
        if self.has_whole_rates() && moves >= MOVES_WITHOUT_WAIT { 0.0 } else { self.start_delay }
    }

    /// In how many strokes a way of `length`, mm, is travelled: such as the controller makes, where there is room for them.
    pub(super) fn strokes(&self, length: f64) -> f64 {
        let room = (length / self.least + 1e-9).floor();
        (length / self.longest - 1e-9).ceil().min(room).max(1.0)
    }

    /// Time of a stroke besides its length: one start, one stop, and the shortest dwell, s.
    pub(super) fn cost(&self) -> f64 {
        self.start_delay + self.speed / self.acceleration + self.step
    }

    /// The shortest stroke, mm, that leaves time for a dwell where the mean speed is to be `speed`, mm/s; infinite if none
    /// does.
    pub fn least_stroke(&self, speed: f64) -> f64 {
        let spared = 1.0 / speed - 1.0 / self.speed;
        if spared > 0.0 { self.cost() / spared } else { f64::INFINITY }
    }

    /// Whether the rest after a longest stroke, where the mean speed is to be `speed`, mm/s, is one that leaves no scar.
    pub(super) fn rests(&self, speed: f64) -> bool {
        let moving = self.start_delay + move_time(self.longest, self.speed, Some(self.acceleration));
        self.longest / speed - moving <= self.rest
    }

    /// Steps of the three axes from one position to another; 0 where the stepper is unknown.
    pub(super) fn steps(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        let Some(stepper) = self.stepper else { return [0.0; 3] };
        let (from, to) = (stepper.steps_at(from), stepper.steps_at(to));
        std::array::from_fn(|i| to[i] - from[i])
    }

    /// Whether the controller makes a move of these steps; else it joins it to the next.
    pub(super) fn executes(&self, steps: [f64; 3]) -> bool {
        let largest = steps.into_iter().map(f64::abs).fold(0.0, f64::max);
        self.stepper.is_none_or(|stepper| largest >= stepper.least_steps)
    }

    /// Time from rest to rest, s, of these steps along a way of `length` mm, in `moves` moves.
    pub(super) fn moving(&self, steps: [f64; 3], length: f64, moves: u32) -> f64 {
        let Self { speed, acceleration, .. } = *self;
        let moving = match &self.stepper {
            Some(stepper) => stepper.seconds(steps, speed, acceleration),
            None => move_time(length, speed, Some(acceleration)),
        };
        self.wait(moves) + moving
    }
}

/// Time from rest to rest over `length`, s, at `speed` if it is reached; without an acceleration it always is.
pub fn move_time(length: f64, speed: f64, acceleration: Option<f64>) -> f64 {
    match acceleration {
        Some(a) if speed * speed > a * length => 2.0 * (length / a).sqrt(),
        Some(a) => length / speed + speed / a,
        None => length / speed,
    }
}
