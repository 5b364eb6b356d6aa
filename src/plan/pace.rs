//! Pace: how fast the iron moves in contact, and what is done where the controller cannot go that slowly.
//!
//! A **chopped** path is cut into **strokes**, each travelled at a feed that the controller holds and followed by a
//! dwell, so that the mean speed is the seal's. A stroke of length L at speed s from rest to rest takes
//! `L/s + s/a` (`2 sqrt(L/a)` if s is not reached), a being the acceleration; the dwell fills up to `L/v`. Controllers
//! round dwells up to a step; what a stroke is early or late is carried to the next one, so the iron is never off its
//! schedule by more than half a step.

use crate::geom::Segment;
use crate::spec::{FeedFloor, Machine, Spec};

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
    /// Longest stroke, mm: a tenth of the band.
    pub longest: f64,
    /// Acceleration, mm/s^2.
    pub acceleration: f64,
    /// Dwells are multiples of this, s.
    pub step: f64,
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
}

impl Pace {
    /// The pace of the sealing programs.
    pub fn new(spec: &Spec, machine: &Machine) -> Self {
        let (motion, speed) = (&machine.motion, spec.seal.speed.0);
        let slow_enough = motion.speed_range().is_some_and(|(_, most)| most <= speed * (1.0 + 1e-9));
        if spec.machine.feed_floor == FeedFloor::Refuse || slow_enough {
            return Self::Steady;
        }
        match (motion.chop_speed(), motion.acceleration) {
            (Some(chop), Some(acceleration)) => Self::Chopped(Chop {
                speed: chop,
                longest: spec.seal.band.0 / 10.0,
                acceleration: acceleration.0,
                step: machine.controller.dwell.step.0,
            }),
            _ => Self::Steady,
        }
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
        Self { pace, speed, early: 0.0 }
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
        let count = (length / chop.longest - 1e-9).ceil().max(1.0);
        let (mut i, each_length) = (0.0, length / count);
        while i < count {
            let part = piece.part(i / count, (i + 1.0) / count);
            let moving = move_time(each_length, chop.speed, Some(chop.acceleration));
            self.early += each_length / self.speed - moving;
            let dwell = ((self.early / chop.step).round() * chop.step).max(0.0);
            self.early -= dwell;
            let is_last = i + 1.0 >= count;
            let height =
                heights.map(|(from, to)| if is_last { to } else { from + rise * ((i + 1.0) / count) });
            each(Stroke { piece: part, height, speed: chop.speed, dwell, seconds: moving + dwell });
            i += 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Arc, Line, Point};

    const GRBL: Chop = Chop { speed: 0.65, longest: 0.2, acceleration: 10.0, step: 0.05 };

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
