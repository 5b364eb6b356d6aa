//! Pace: the speed of the iron in contact, and the way to reach it where the controller cannot go that slowly.
//!
//! A **chopped** path is cut into **strokes**, each travelled at a feed that the controller holds and followed by a
//! dwell, so that the mean speed is the seal's. A stroke of length L at speed s from rest to rest takes
//! `L/s + s/a` (`2 sqrt(L/a)` if s is not reached), a being the acceleration, or the time of a [`crate::plan::Stepper`]. The
//! dwell fills up to `L/v`. Controllers round dwells up to a step; the time error of a stroke is carried to the next one, so the
//! iron is never off its schedule by more than half a step. Lengths and steps are those of the file, whose positions are rounded.
//! Strokes are so long that each has a dwell; where the path is in shorter pieces, and one has none, the controller runs on into
//! the next, and both are timed as one stroke. A controller may join a move of a few steps to the next one (Marlin): no dwell
//! follows such a move, for it would come before the move is made.

use crate::plan::chop::Chop;
use crate::plan::written::Written;
use geom::Segment;
use spec::{FeedFloor, Machine, Spec};

/// Largest time by which the iron may be early after a stop, beside half of a dwell's step, s: rounding.
const OVERDUE: f64 = 0.01;

/// The way in which the seal's speed is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// The controller can move at the programmed speed.
    Steady,
    /// Strokes and dwells.
    Chopped(Chop),
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
    /// The most by which it was early after the longest wait, s.
    overdue: f64,
    run: PacedRun,
}

/// The run since the iron last rested.
#[derive(Clone, Copy, Debug, Default)]
struct PacedRun {
    steps: [f64; 3],
    length: f64,
    /// Moves that the controller has made.
    moves: u32,
    /// Time counted for it, s.
    seconds: f64,
    /// Steps that the controller has not made yet, for they are too few.
    waiting: [f64; 3],
}

impl Pace {
    /// The pace of a program on a controller that holds `lowest`, mm/s, all along its way; `None` if unknown.
    pub(super) fn new(spec: &Spec, machine: &Machine, lowest: Option<f64>) -> Self {
        let speed = spec.seal.speed.0;
        let slow_enough = lowest.is_some_and(|lowest| lowest <= speed * (1.0 + 1e-9));
        if spec.machine.feed_floor == FeedFloor::Refuse || slow_enough {
            return Self::Steady;
        }
        Chop::new(spec, machine).map_or(Self::Steady, Self::Chopped)
    }
}

impl Pacer {
    /// A pacer at the start of a contact; `speed` is the seal's, mm/s.
    pub fn new(pace: Pace, speed: f64) -> Self {
        Self { pace, speed, early: 0.0, overdue: 0.0, run: PacedRun::default() }
    }

    /// The seal's speed, mm/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Hands the strokes of `piece` to `emit`, in order; `heights` are those of its two ends where they differ.
    pub fn strokes(&mut self, piece: &Segment, heights: Option<(f64, f64)>, mut emit: impl FnMut(Stroke)) {
        let rise = heights.map_or(0.0, |(from, to)| to - from);
        let length = libm::hypot(piece.length(), rise);
        let Pace::Chopped(chop) = self.pace else {
            let seconds = length / self.speed;
            let height = heights.map(|(_, to)| to);
            emit(Stroke { piece: *piece, height, speed: self.speed, dwell: 0.0, seconds });
            return;
        };
        let base = heights.map_or(0.0, |(from, _)| from);
        let count = chop.strokes(length);
        let mut i = 0.0;
        while i < count {
            let part = piece.part(i / count, (i + 1.0) / count);
            let (low, high) = (base + rise * (i / count), base + rise * ((i + 1.0) / count));
            let is_last = i + 1.0 >= count;
            let height = heights.map(|(_, to)| if is_last { to } else { high });
            let move_written = Written::new(&part, [low, height.unwrap_or(low)], chop.file);
            let (moving, dwell) = self.stroke(&chop, &move_written);
            emit(Stroke { piece: part, height, speed: chop.speed, dwell, seconds: moving + dwell });
            i += 1.0;
        }
    }

    /// The most by which the iron was early at a rest of the longest allowed time, s; 0 if that is within a dwell's step.
    ///
    /// Around a sharp corner beside a short piece, a controller that joins short moves may have made hardly any steps when the
    /// longest rest in one place is already over.
    pub(super) fn overdue(&self) -> f64 {
        let Pace::Chopped(chop) = self.pace else { return 0.0 };
        Some(self.overdue).filter(|early| *early > 0.5 * chop.step + OVERDUE).unwrap_or(0.0)
    }

    /// Adds a stroke to the run; the time that it adds, and the dwell after it, s.
    fn stroke(&mut self, chop: &Chop, move_written: &Written) -> (f64, f64) {
        let Written { from, to, length } = *move_written;
        let (run_before, steps) = (self.run, chop.steps(from, to));
        let waiting = std::array::from_fn(|i| run_before.waiting[i] + steps[i]);
        let mut run = PacedRun { length: run_before.length + length, waiting, ..run_before };
        let is_made = chop.executes(waiting);
        if is_made {
            run.steps = std::array::from_fn(|i| run_before.steps[i] + waiting[i].abs());
            run.waiting = [0.0; 3];
            run.moves += 1;
            run.seconds = chop.moving(run.steps, run.length, run.moves);
        }
        let moving = run.seconds - run_before.seconds;
        self.early += length / self.speed - moving;
        let longest_dwell = if is_made { (chop.rest / chop.step + 1e-9).floor() } else { 0.0 };
        let dwell = ((self.early / chop.step).round().min(longest_dwell) * chop.step).max(0.0);
        self.early -= dwell;
        if is_made {
            self.overdue = self.overdue.max(self.early);
        }
        self.run = if dwell > 0.0 { PacedRun::default() } else { run };
        (moving, dwell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::chop::move_time;
    use crate::plan::{Precision, Stepper};
    use geom::{Arc, Line, Point};
    use spec::units::Length;

    const GRBL: Chop = Chop {
        speed: 0.65,
        longest: 0.2,
        least: 0.0,
        file: Precision { path: Length(0.001), arcs: true },
        acceleration: 10.0,
        step: 0.05,
        rest: 2.0,
        start_delay: 0.0,
        stepper: Some(Stepper::GRBL),
    };

    /// Marlin of most boards: six steps at 45 degrees are 0.106 mm.
    fn marlin() -> Chop {
        let shortest = 6.0 * 2.0_f64.sqrt() / 80.0;
        let stepper = GRBL.stepper.map(|stepper| Stepper {
            rate: 32.0,
            tick: 0.0,
            first_rate: Some(120.0),
            least_steps: 6.0,
            ..stepper
        });
        Chop {
            speed: 1.7,
            longest: 2.0 / 13.0,
            least: shortest,
            acceleration: 3000.0,
            step: 1e-3,
            stepper,
            ..GRBL
        }
    }

    /// Time of one stroke from rest to rest, s.
    fn seconds_from_rest(chop: &Chop, from: [f64; 3], to: [f64; 3], length: f64) -> f64 {
        let steps = chop.steps(from, to).map(f64::abs);
        chop.moving(steps, length, 1)
    }

    fn strokes(piece: Segment, heights: Option<(f64, f64)>) -> Vec<Stroke> {
        let mut strokes = Vec::new();
        Pacer::new(Pace::Chopped(GRBL), 0.1).strokes(&piece, heights, |stroke| strokes.push(stroke));
        strokes
    }

    #[test]
    fn the_mean_speed_is_right_and_no_stroke_is_long() {
        let line: Segment = Line::new(Point::ORIGIN, Point::new(8.0, 6.0)).into();
        let arc: Segment = Arc::new(Point::ORIGIN, 33.0, 0.3, -2.0).into();
        for (piece, heights) in [(line, None), (arc, None), (line, Some((5.0, -0.3)))] {
            let strokes_made = strokes(piece, heights);
            let length = piece.length().hypot(heights.map_or(0.0, |(a, b)| b - a));
            let seconds: f64 = strokes_made.iter().map(|stroke| stroke.seconds).sum();
            // Half a dwell's step; the file's positions, which are rounded, make the way a little longer or shorter.
            assert!((seconds - length / 0.1).abs() <= 0.025 + 2e-3, "{seconds} for {length} mm");
            assert!(strokes_made.iter().all(|s| s.piece.length() <= 0.2 + 1e-9 && s.dwell < 2.0));
            assert!(strokes_made.iter().all(|s| (pauses(s) - pauses(s).round()).abs() < 1e-6));
            assert_eq!(strokes_made.last().and_then(|s| s.height), heights.map(|(_, to)| to));
        }
    }

    fn pauses(s: &Stroke) -> f64 {
        s.dwell / 0.05
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
            // The timing on the controller.
            let (mut start, mut seconds) = (0.0, 0.0);
            for stroke in &strokes {
                let end = stroke.piece.end().x;
                if stroke.dwell > 0.0 || end > 10.0 - 1e-9 {
                    seconds += seconds_from_rest(&chop, [start, 0.0, 0.0], [end, 0.0, 0.0], end - start)
                        + stroke.dwell;
                    start = end;
                }
            }
            assert!((seconds - 20.0).abs() < 0.002 * 20.0, "{seconds}");
        }
    }

    /// A controller that drops a move of few steps waits at once: no dwell follows until the steps are made.
    #[test]
    fn no_dwell_follows_a_move_that_is_joined_to_the_next() {
        let chop = marlin();
        let stepper = chop.stepper.expect("known");
        let mut pacer = Pacer::new(Pace::Chopped(chop), 0.1);
        let (mut position, mut due, mut spent, mut short) = (stepper.steps_at([1.0, 0.0, 0.0]), 0.0, 0.0, 0);
        for i in 0..40_u32 {
            let arc: Segment = Arc::new(Point::ORIGIN, 1.0, 0.0446 * f64::from(i), 0.0446).into();
            pacer.strokes(&arc, None, |stroke| {
                due += stroke.piece.length() / 0.1;
                spent += stroke.seconds;
                short += usize::from(stroke.dwell == 0.0);
                if stroke.dwell > 0.0 {
                    let end = stroke.piece.end();
                    let next = stepper.steps_at([end.x, end.y, 0.0]);
                    let largest = (next[0] - position[0]).abs().max((next[1] - position[1]).abs());
                    assert!((6.0..=12.0).contains(&largest), "{largest} steps");
                    position = next;
                }
            });
        }
        assert!(short >= 20, "{short} of 40 moves have too few steps");
        assert!((spent - due).abs() < 1.3, "{spent} of {due} s: off by what is not made yet");
    }

    #[test]
    fn strokes_have_the_least_steps_where_there_is_room() {
        let chop = marlin();
        for length in [0.12, 0.16, 0.2, 0.25, 0.31, 5.0] {
            let end = Point::polar(length, 45_f64.to_radians());
            let line: Segment = Line::new(Point::ORIGIN, end).into();
            let mut lengths = Vec::new();
            Pacer::new(Pace::Chopped(chop), 0.1)
                .strokes(&line, None, |stroke| lengths.push(stroke.piece.length()));
            assert!(lengths.iter().all(|l| *l >= chop.least - 1e-9 && *l < 2.0 * chop.least), "{lengths:?}");
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
        let [a, b] = [GRBL, slow].map(|chop| seconds_from_rest(&chop, [0.0; 3], [0.2, 0.0, 0.0], 0.2));
        assert!((b - a - 0.1).abs() < 1e-12);
    }

    /// Marlin's planner begins at once as soon as three moves are queued; fewer wait.
    #[test]
    fn a_run_of_three_moves_does_not_wait() {
        let chop = Chop { start_delay: 0.1, ..marlin() };
        let seconds = [1, 2, 3, 7].map(|moves| chop.moving([24.0, 0.0, 0.0], 0.3, moves));
        assert_eq!((seconds[0], seconds[2]), (seconds[1], seconds[3]));
        assert!((seconds[1] - seconds[2] - 0.1).abs() < 1e-12, "{seconds:?}");
        let grbl = Chop { start_delay: 0.1, ..GRBL };
        assert_eq!(grbl.moving([24.0, 0.0, 0.0], 0.3, 3), grbl.moving([24.0, 0.0, 0.0], 0.3, 1));
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
        let strokes_made = strokes(line, Some((from, to)));
        // The way is 7.29 mm in space: 37 strokes, none longer than 0.2 mm.
        assert_eq!(strokes_made.len(), 37);
        let (mut position, mut way) = (line.start(), 0.0);
        for stroke in &strokes_made {
            assert!(stroke.piece.start().distance(position) < 1e-12);
            position = stroke.piece.end();
            way += stroke.piece.length() / line.length();
            let height = stroke.height.expect("a height");
            assert!((height - (from + way * (to - from))).abs() < 1e-12, "{height} at {way}");
        }
        assert!(position.distance(line.end()) < 1e-12);
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
        let mut strokes_made = Vec::new();
        Pacer::new(Pace::Steady, 0.1).strokes(&line, None, |stroke| strokes_made.push(stroke));
        assert_eq!((strokes_made.len(), strokes_made[0].seconds, strokes_made[0].dwell), (1, 50.0, 0.0));
    }
}
