//! Pace: how fast the iron moves in contact, and what is done where the controller cannot go that slowly.
//!
//! A **chopped** path is cut into **strokes**, each travelled at a feed that the controller holds and followed by a
//! dwell, so that the mean speed is the seal's. A stroke of length L at speed s from rest to rest takes
//! `L/s + s/a` (`2 sqrt(L/a)` if s is not reached), a being the acceleration, or what a [`Stepper`] says; the dwell fills
//! up to `L/v`. Controllers round dwells up to a step; what a stroke is early or late is carried to the next one, so the
//! iron is never off its schedule by more than half a step. Strokes are so long that each has a dwell; where the path is
//! in shorter pieces, and one has none, the controller runs on into the next, and both are timed as one stroke.

use crate::geom::Segment;
use crate::plan::Stepper;
use crate::spec::{FeedFloor, Machine, Motion, Spec, StepRate};

/// Strokes in a band, at least. Half a band then has six rests, or one more or less, so that the speed within it is right
/// to 15 %; of twelve strokes it was 15.5 % on one controller, of ten 16 %. The more there are, the larger a part of a stroke is a step of the motors.
const STROKES: f64 = 13.0;

/// How the seal's speed is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// The controller goes as slowly as it is told.
    Steady,
    /// Strokes and dwells.
    Chopped(Chop),
}

/// How a path is chopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chop {
    /// Speed of a stroke, mm/s.
    pub speed: f64,
    /// Longest stroke, mm: a thirteenth of the band, or as much as it takes to have time left for a dwell.
    pub longest: f64,
    /// Acceleration, mm/s^2.
    pub acceleration: f64,
    /// Dwells are multiples of this, s.
    pub step: f64,
    /// Longest dwell, s: what the iron takes to pass a tenth of the band. Longer, it leaves a scar.
    pub rest: f64,
    /// Wait of a move that meets an empty queue, s.
    pub start_delay: f64,
    /// How the controller steps, if it is one of GRBL's family and all is known that it takes.
    pub stepper: Option<Stepper>,
}

/// One move in contact, and the wait after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The path seen from above.
    pub piece: Segment,
    /// Height at its end, mm, where it changes.
    pub height: Option<f64>,
    /// Speed in force, mm/s.
    pub speed: f64,
    /// Wait at its end, s; 0 for none.
    pub dwell: f64,
    /// Time for all of it, s.
    pub seconds: f64,
}

/// Cuts pieces into strokes, and keeps the schedule.
#[derive(Clone, Copy, Debug)]
pub struct Pacer {
    pace: Pace,
    speed: f64,
    /// Time by which the iron is early, s.
    early: f64,
    run: Run,
}

/// What was travelled since the iron stood still.
#[derive(Clone, Copy, Debug, Default)]
struct Run {
    steps: [f64; 3],
    length: f64,
    /// Time counted for it, s.
    seconds: f64,
}

impl Pace {
    /// The pace of a program on a controller that holds `lowest`, mm/s, all along its way, if that is known.
    pub(super) fn new(spec: &Spec, machine: &Machine, lowest: Option<f64>) -> Self {
        let (motion, speed) = (&machine.motion, spec.seal.speed.0);
        let slow_enough = lowest.is_some_and(|lowest| lowest <= speed * (1.0 + 1e-9));
        if spec.machine.feed_floor == FeedFloor::Refuse || slow_enough {
            return Self::Steady;
        }
        let (Some(chop), Some(acceleration)) = (motion.chop_speed(speed), motion.acceleration) else {
            return Self::Steady;
        };
        let chop = Chop {
            speed: chop,
            longest: spec.seal.band.0 / STROKES,
            acceleration: acceleration.0,
            step: machine.controller.dwell.step.0,
            rest: spec.seal.band.0 / 10.0 / speed,
            start_delay: motion.start_delay.0,
            stepper: stepper(motion),
        };
        Self::Chopped(Chop { longest: chop.longest.max(chop.least_stroke(speed)), ..chop })
    }
}

/// How the controller steps, if all is known that it takes.
fn stepper(motion: &Motion) -> Option<Stepper> {
    let StepRate::AtLeast(rate) = motion.step_rate else { return None };
    Some(Stepper { steps_per_mm: motion.steps_per_mm?, rate, tick: motion.tick?.0, wraps: motion.wraps })
}

impl Chop {
    /// What a stroke costs beside its length: one start, one stop, and the shortest dwell, s.
    pub(super) fn cost(&self) -> f64 {
        self.start_delay + self.speed / self.acceleration + self.step
    }

    /// The shortest stroke, mm, that leaves time for a dwell where the mean speed is to be `speed`, mm/s; infinite if none
    /// does.
    pub fn least_stroke(&self, speed: f64) -> f64 {
        let spared = 1.0 / speed - 1.0 / self.speed;
        if spared > 0.0 { self.cost() / spared } else { f64::INFINITY }
    }

    /// Time of one stroke from rest to rest, s, from one position to another along a path of this length, mm.
    pub fn seconds(&self, from: [f64; 3], to: [f64; 3], length: f64) -> f64 {
        self.moving(&Run { steps: self.steps(from, to), length, seconds: 0.0 })
    }

    /// Steps of the three axes between two positions; none where the stepper is not known.
    fn steps(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        let Some(stepper) = self.stepper else { return [0.0; 3] };
        let (from, to) = (stepper.at(from), stepper.at(to));
        std::array::from_fn(|i| (to[i] - from[i]).abs())
    }

    /// Time of a run from rest to rest, s.
    fn moving(&self, run: &Run) -> f64 {
        let Self { speed, acceleration, .. } = *self;
        let moving = match &self.stepper {
            Some(stepper) => stepper.seconds(run.steps, speed, acceleration),
            None => move_time(run.length, speed, Some(acceleration)),
        };
        self.start_delay + moving
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

impl Pacer {
    /// A pacer at the start of a contact; `speed` is the seal's, mm/s.
    pub fn new(pace: Pace, speed: f64) -> Self {
        Self { pace, speed, early: 0.0, run: Run::default() }
    }

    /// Hands the strokes of `piece` to `each`, in order; `heights` are those of its two ends where they differ.
    pub fn strokes(&mut self, piece: &Segment, heights: Option<(f64, f64)>, mut each: impl FnMut(Stroke)) {
        let rise = heights.map_or(0.0, |(from, to)| to - from);
        let length = piece.length().hypot(rise);
        let Pace::Chopped(chop) = self.pace else {
            let seconds = length / self.speed;
            let height = heights.map(|(_, to)| to);
            each(Stroke { piece: *piece, height, speed: self.speed, dwell: 0.0, seconds });
            return;
        };
        let base = heights.map_or(0.0, |(from, _)| from);
        let count = (length / chop.longest - 1e-9).ceil().max(1.0);
        let (mut i, each_length) = (0.0, length / count);
        while i < count {
            let part = piece.part(i / count, (i + 1.0) / count);
            let (low, high) = (base + rise * (i / count), base + rise * ((i + 1.0) / count));
            let (from, to) = (part.start(), part.end());
            let steps = chop.steps([from.x, from.y, low], [to.x, to.y, high]);
            let (moving, dwell) = self.stroke(&chop, steps, each_length);
            let is_last = i + 1.0 >= count;
            let height = heights.map(|(_, to)| if is_last { to } else { high });
            each(Stroke { piece: part, height, speed: chop.speed, dwell, seconds: moving + dwell });
            i += 1.0;
        }
    }

    /// Adds a stroke to the run; the time that it adds, and the dwell after it, s.
    fn stroke(&mut self, chop: &Chop, steps: [f64; 3], length: f64) -> (f64, f64) {
        let before = self.run;
        let sum = std::array::from_fn(|i| before.steps[i] + steps[i]);
        let mut run = Run { steps: sum, length: before.length + length, seconds: 0.0 };
        run.seconds = chop.moving(&run);
        let moving = run.seconds - before.seconds;
        self.early += length / self.speed - moving;
        let steps = (self.early / chop.step).round().min((chop.rest / chop.step + 1e-9).floor());
        let dwell = (steps * chop.step).max(0.0);
        self.early -= dwell;
        self.run = if dwell > 0.0 { Run::default() } else { run };
        (moving, dwell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Arc, Line, Point};

    const GRBL: Chop = Chop {
        speed: 0.65,
        longest: 0.2,
        acceleration: 10.0,
        step: 0.05,
        rest: 2.0,
        start_delay: 0.0,
        stepper: Some(Stepper { steps_per_mm: [80.0, 80.0, 400.0], rate: 30.52, tick: 0.01, wraps: false }),
    };

    fn strokes(piece: Segment, heights: Option<(f64, f64)>) -> Vec<Stroke> {
        let mut out = Vec::new();
        Pacer::new(Pace::Chopped(GRBL), 0.1).strokes(&piece, heights, |stroke| out.push(stroke));
        out
    }

    #[test]
    fn the_mean_speed_is_right_and_no_stroke_is_long() {
        let line: Segment = Line::new(Point::ORIGIN, Point::new(8.0, 6.0)).into();
        let arc: Segment = Arc::new(Point::ORIGIN, 33.0, 0.3, -2.0).into();
        for (piece, heights) in [(line, None), (arc, None), (line, Some((5.0, -0.3)))] {
            let found = strokes(piece, heights);
            let length = piece.length().hypot(heights.map_or(0.0, |(a, b)| b - a));
            let seconds: f64 = found.iter().map(|stroke| stroke.seconds).sum();
            assert!((seconds - length / 0.1).abs() <= 0.025 + 1e-9, "{seconds} for {length} mm");
            assert!(found.iter().all(|s| s.piece.length() <= 0.2 + 1e-9 && s.dwell < 2.0));
            let steps = |s: &Stroke| s.dwell / 0.05;
            assert!(found.iter().all(|s| (steps(s) - steps(s).round()).abs() < 1e-6));
            assert_eq!(found.last().and_then(|s| s.height), heights.map(|(_, to)| to));
        }
    }

    /// Without a dwell between them the controller runs strokes together, and they have one start and one stop.
    #[test]
    fn strokes_without_a_dwell_between_them_are_one_run() {
        let line: Segment = Line::new(Point::ORIGIN, Point::new(10.0, 0.0)).into();
        for stepper in [GRBL.stepper, None] {
            let chop = Chop { stepper, longest: 0.1, ..GRBL };
            let mut strokes = Vec::new();
            let mut pacer = Pacer::new(Pace::Chopped(chop), 0.5);
            pacer.strokes(&line, None, |stroke| strokes.push(stroke));
            assert!(strokes.iter().any(|stroke| stroke.dwell == 0.0), "strokes too short for dwells");
            // What the controller makes of it.
            let (mut begun, mut seconds) = (0.0, 0.0);
            for stroke in &strokes {
                let end = stroke.piece.end().x;
                if stroke.dwell > 0.0 || end > 10.0 - 1e-9 {
                    seconds += chop.seconds([begun, 0.0, 0.0], [end, 0.0, 0.0], end - begun) + stroke.dwell;
                    begun = end;
                }
            }
            assert!((seconds - 20.0).abs() < 0.002 * 20.0, "{seconds}");
        }
    }

    #[test]
    fn a_stroke_is_long_enough_for_a_dwell() {
        for speed in [0.1, 0.3, 0.5, 0.55] {
            let longest = GRBL.longest.max(GRBL.least_stroke(speed));
            let line: Segment = Line::new(Point::ORIGIN, Point::new(0.0, 30.0 * longest)).into();
            let chop = Chop { longest, stepper: None, ..GRBL };
            Pacer::new(Pace::Chopped(chop), speed).strokes(&line, None, |stroke| assert!(stroke.dwell > 0.0));
        }
        assert_eq!(GRBL.least_stroke(0.65), f64::INFINITY);
    }

    #[test]
    fn the_wait_of_a_start_is_part_of_the_stroke() {
        let slow = Chop { start_delay: 0.1, ..GRBL };
        let [a, b] = [GRBL, slow].map(|chop| chop.seconds([0.0; 3], [0.2, 0.0, 0.0], 0.2));
        assert!((b - a - 0.1).abs() < 1e-12);
    }

    #[test]
    fn acceleration_counts() {
        // Forgetting it would make each stroke 65 ms late, 3 % of its two seconds.
        assert!((move_time(0.2, 0.65, Some(10.0)) - 0.2 / 0.65 - 0.065).abs() < 1e-12);
        assert!((move_time(0.01, 0.65, Some(10.0)) - 2.0 * 0.001_f64.sqrt()).abs() < 1e-12);
        assert_eq!(move_time(10.0, 20.0, None), 0.5);
    }

    #[test]
    fn strokes_meet_end_to_end_and_climb_evenly() {
        let line: Segment = Line::new(Point::new(1.0, 2.0), Point::new(4.0, 6.0)).into();
        let (from, to) = (5.0, -0.3);
        let found = strokes(line, Some((from, to)));
        // The way is 7.29 mm in space: 37 strokes, none longer than 0.2 mm.
        assert_eq!(found.len(), 37);
        let (mut here, mut way) = (line.start(), 0.0);
        for stroke in &found {
            assert!(stroke.piece.start().distance(here) < 1e-12);
            here = stroke.piece.end();
            way += stroke.piece.length() / line.length();
            let height = stroke.height.expect("a height");
            assert!((height - (from + way * (to - from))).abs() < 1e-12, "{height} at {way}");
        }
        assert!(here.distance(line.end()) < 1e-12);
        let level = strokes(line, None);
        assert!(level.len() == 25 && level.iter().all(|stroke| stroke.height.is_none()));
    }

    #[test]
    fn the_speed_is_reached_if_half_the_way_is_enough() {
        // At 10 mm/s^2, 0.65 mm/s is reached and left again within 0.0423 mm.
        for (length, seconds) in
            [(0.05, 0.05 / 0.65 + 0.065), (0.035, 2.0 * 0.0035_f64.sqrt()), (2.0, 2.0 / 0.65 + 0.065)]
        {
            assert!((move_time(length, 0.65, Some(10.0)) - seconds).abs() < 1e-12, "{length}");
        }
        assert!((move_time(0.3, 2.0, Some(10.0)) - 2.0 * 0.03_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_steady_piece_is_one_stroke() {
        let line: Segment = Line::new(Point::ORIGIN, Point::new(3.0, 4.0)).into();
        let mut found = Vec::new();
        Pacer::new(Pace::Steady, 0.1).strokes(&line, None, |stroke| found.push(stroke));
        assert_eq!((found.len(), found[0].seconds, found[0].dwell), (1, 50.0, 0.0));
    }
}
