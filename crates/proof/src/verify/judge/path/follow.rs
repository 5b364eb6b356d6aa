//! The ordered comparer: walks a run of segments along the path it should follow, in lock-step.
//!
//! Both are walked from their starts. A **step** is one segment of the run. Its end is projected into a
//! **window** of the exact path, which reaches one step ahead and one back from where the last step ended;
//! so a path that covers a stretch twice (the overlap), or passes close to itself, is never mixed up. Each
//! step is then measured against the part of the exact path that it covered, both ways.

use crate::verify::judge::path::measure::{Farthest, Prepared, furthest};
use crate::verify::judge::path::track::{Passing, TIE, Track};
use geom::{Path, Point, Segment};

/// Reach of a window beyond one step, mm. Larger than any rounding in a file, far smaller than a band.
const MARGIN: f64 = 0.05;

/// The deviations of a run from its exact path. Positions are arc lengths along the exact path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Following {
    /// Largest distance from a point of the run to the exact path; infinite if one of them is empty.
    pub file_to_exact: f64,
    /// Largest distance from a point of the covered part of the exact path to the run.
    pub exact_to_file: f64,
    /// The place of the larger of the two.
    pub at: Point,
    /// The step (index into the run) to which the larger of the two belongs.
    pub step: usize,
    /// The start of the run.
    pub start: f64,
    /// The end of the run.
    pub end: f64,
    /// Length of the run itself.
    pub length: f64,
    /// Length of the exact path.
    pub exact_length: f64,
    /// Farthest way by which a step went backwards, and its index.
    pub backwards: Option<(f64, usize)>,
    /// Widest gap between the end of a step and the start of the next, with the index of the latter.
    pub jump: Option<(f64, usize)>,
}

impl Following {
    /// The larger of the distances both ways.
    pub fn largest(&self) -> f64 {
        self.file_to_exact.max(self.exact_to_file)
    }
}

/// Follows `run`, the segments of one contact in order, along the open path `exact`.
///
/// The run's first point is searched for at the path's start, then on the whole path; from there on
/// only the window counts. Cost: linear in the number of segments of both.
pub fn follow(run: &[Segment], exact: &Path) -> Following {
    let mut follower = Follower::new(exact);
    run.iter().zip(0..).for_each(|(step, i)| follower.step(step, i));
    follower.finish()
}

/// Follows a run step by step, and keeps three steps.
#[derive(Default)]
pub(in crate::verify) struct Follower {
    track: Track,
    /// The step before the one that is measured, and the one that is: it waits for the one after it.
    before: Option<Prepared>,
    here: Option<Prepared>,
    /// The number of that step.
    number: usize,
    /// The passage of the exact path by the end of the last step that was measured.
    at: Passing,
    there: Farthest,
    back: Farthest,
    result: Following,
    scratch: Vec<f64>,
}

impl Follower {
    /// At the start of `exact`.
    pub(in crate::verify) fn new(exact: &Path) -> Self {
        let track = Track::new(exact);
        let result = Following { exact_length: track.length, ..Following::default() };
        Self { track, result, ..Self::default() }
    }

    /// Takes the next step; `number` identifies it in the result.
    pub(in crate::verify) fn step(&mut self, step: &Segment, number: usize) {
        let next = Prepared::new(*step);
        self.result.length += next.length;
        if self.track.targets.is_empty() {
            // There is no exact path to compare with.
        } else if self.here.is_some() {
            self.measure(Some(&next));
            self.before = self.here;
        } else {
            self.at = self.start(next.start);
            self.result.start = self.at.s;
        }
        (self.here, self.number) = (Some(next), number);
    }

    /// The result, after all steps of the run.
    pub(in crate::verify) fn finish(mut self) -> Following {
        match (self.here.is_some(), self.track.targets.is_empty()) {
            (true, false) => self.measure(None),
            (false, true) => {}
            _ => {
                return Following {
                    file_to_exact: f64::INFINITY,
                    exact_to_file: f64::INFINITY,
                    ..self.result
                };
            }
        }
        Following {
            file_to_exact: self.there.distance,
            exact_to_file: self.back.distance,
            at: self.there.max(self.back).at,
            end: self.at.s,
            ..self.result
        }
    }

    /// The start, on the exact path, of a run that starts at `p`.
    fn start(&self, p: Point) -> Passing {
        let track = &self.track;
        // With an overlap each place near the start comes twice, and a rounded start may lie nearer to the second pass
        // (next to a corner): the first pass within the margin is meant, and then its nearest point.
        let roughly = track.project(p, (0.0, track.length), 0.0, MARGIN).s;
        let range = track.clamped(roughly - 4.0 * MARGIN, roughly + 4.0 * MARGIN);
        track.project(p, range, roughly, TIE)
    }

    /// Measures the step that waits, of which `after` is the next.
    fn measure(&mut self, after: Option<&Prepared>) {
        let Some(step) = self.here else { return };
        let before = self.at.place;
        let ((low, high), gap) = self.advance(&step);
        // Most steps cannot be farther off than one was before.
        let smallest = self.there.distance.min(self.back.distance);
        let ends = [before, self.at.place];
        if gap <= TIE && self.track.bound(&step, (low, high), ends).is_some_and(|bound| bound <= smallest) {
            return;
        }
        let (near_low, near_high) = self.track.clamped(low - MARGIN, high + MARGIN);
        let covered = self.track.indices(near_low, near_high);
        let forth = furthest(&step, &self.track.targets[covered], &mut self.scratch);
        let home = self.way_back((low, high), after, forth.distance.max(TIE));
        if forth.distance.max(home.distance) > self.there.distance.max(self.back.distance) {
            self.result.step = self.number;
        }
        (self.there, self.back) = (self.there.max(forth), self.back.max(home));
    }

    /// Goes on to the end of `step`; the part of the exact path that was covered on the way, and the gap before it.
    fn advance(&mut self, step: &Prepared) -> ((f64, f64), f64) {
        let (track, start) = (&self.track, self.at.s);
        let gap = self.before.map_or(0.0, |before| before.end.distance(step.start));
        note_larger(&mut self.result.jump, gap, self.number);
        let mut place = start;
        if gap > TIE {
            place = track
                .project(step.start, track.clamped(place - gap - MARGIN, place + gap + MARGIN), place, TIE)
                .s;
        }
        let reach = step.length + MARGIN;
        self.at =
            track.project(step.end, track.clamped(place - reach, place + reach), place + step.length, TIE);
        let next = self.at.s;
        note_larger(&mut self.result.backwards, place - next, self.number);
        ((start.min(place).min(next), start.max(place).max(next)), gap)
    }

    /// The largest distance from the part of the exact path between `low` and `high` to the step that waits and its two
    /// neighbours; a distance below `limit` need not be exact.
    fn way_back(&mut self, (low, high): (f64, f64), after: Option<&Prepared>, limit: f64) -> Farthest {
        let mut home = Farthest::default();
        let Some(step) = &self.here else { return home };
        for k in self.track.indices(low, high) {
            let (target, begin) = (&self.track.targets[k], self.track.begins[k]);
            let (a, b) = ((low - begin).max(0.0), (high - begin).min(target.length));
            if b > a {
                let part = Prepared::new(target.segment.part(a / target.length, b / target.length));
                // Measured against one step only, the distance is an upper bound; mostly that is enough.
                let by_step = furthest(&part, std::slice::from_ref(step), &mut self.scratch);
                home = home.max(if by_step.distance <= limit {
                    by_step
                } else {
                    let by_neighbours: Vec<&Prepared> =
                        [self.before.as_ref(), Some(step), after].into_iter().flatten().collect();
                    furthest(&part, &by_neighbours, &mut self.scratch)
                });
            }
        }
        home
    }
}

fn note_larger(largest: &mut Option<(f64, usize)>, value: f64, number: usize) {
    if value > largest.map_or(0.0, |(v, _)| v) {
        *largest = Some((value, number));
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use geom::{Arc, Isometry, Line, Vec2};

    fn loop_of(r: f64, l: f64) -> Path {
        let p = Point::new;
        Path::closed(vec![
            Line::new(p(0.0, -r), p(l, -r)).into(),
            Arc::new(p(l, 0.0), r, -PI / 2.0, PI).into(),
            Line::new(p(l, r), p(0.0, r)).into(),
            Arc::new(p(0.0, 0.0), r, PI / 2.0, PI).into(),
        ])
    }

    /// The path as a controller gets it: moves of at most `step`, end points rounded to 0.001.
    fn moves(path: &Path, step: f64) -> Vec<Segment> {
        let mut run = Vec::new();
        for segment in &path.segments {
            let n = (segment.length() / step).ceil().max(1.0);
            let mut i = 0.0;
            while i < n {
                let part = segment.part(i / n, (i + 1.0) / n);
                let (a, b) = (rounded_point(part.start()), rounded_point(part.end()));
                run.push(match part {
                    Segment::Line(_) => Line::new(a, b).into(),
                    Segment::Arc(arc) => Arc::from_bulge(a, b, arc.bulge()).unwrap().into(),
                });
                i += 1.0;
            }
        }
        run
    }

    fn rounded_point(p: Point) -> Point {
        Point::new((p.x * 1e3).round() / 1e3, (p.y * 1e3).round() / 1e3)
    }

    #[test]
    fn follows_a_loop_with_its_overlap() {
        for (r, l) in [(0.5, 1.0), (20.0, 60.0), (500.0, 2000.0)] {
            let base = loop_of(r, l);
            let overlap = (0.1 * r).max(0.3);
            for exact in [
                base.part(0.3 * l, 0.3 * l + base.length() + overlap),
                base.reversed().part(0.0, base.length() + overlap),
            ] {
                let walk = follow(&moves(&exact, 5.0), &exact);
                assert!(walk.largest() < 0.0011, "{walk:?}");
                assert!(walk.start.abs() < 0.001 && (walk.end - exact.length()).abs() < 0.001, "{walk:?}");
                assert!(walk.backwards.is_none() && walk.jump.is_none_or(|(gap, _)| gap < 1e-9), "{walk:?}");
            }
        }
    }

    #[test]
    fn measures_a_shift_and_where_it_is() {
        let exact = loop_of(20.0, 60.0).part(30.0, 400.0);
        let mut run = moves(&exact, 5.0);
        for segment in &mut run[10..13] {
            *segment = Isometry::translation(Vec2::new(0.01, 0.0)).segment(segment);
        }
        let walk = follow(&run, &exact);
        assert!((walk.largest() - 0.01).abs() < 0.001, "{walk:?}");
        assert!((10..13).contains(&walk.step));
        assert!(walk.jump.is_some_and(|(gap, _)| (gap - 0.01).abs() < 1e-6));
    }

    #[test]
    fn notices_a_reversed_run() {
        let exact = loop_of(20.0, 60.0).part(30.0, 60.0);
        let run = moves(&exact.reversed(), 5.0);
        let walk = follow(&run, &exact);
        assert!(walk.backwards.is_some_and(|(by, _)| by > 4.0), "{walk:?}");
        assert!((walk.start - 30.0).abs() < 0.001 && walk.end.abs() < 0.001);
    }

    #[test]
    fn notices_a_cut_run() {
        let base = loop_of(20.0, 60.0);
        let exact = base.part(30.0, 30.0 + base.length() + 5.0);
        let run = moves(&base.part(30.0, 30.0 + base.length() + 1.0), 5.0);
        let walk = follow(&run, &exact);
        assert!(walk.largest() < 0.001);
        assert!((walk.exact_length - walk.end - 4.0).abs() < 0.001, "{walk:?}");
        // Moves missing in the middle: a jump, and the exact path between is far from the run.
        let mut run = moves(&exact, 5.0);
        drop(run.drain(20..24));
        let walk = super::follow(&run, &exact);
        assert!(walk.jump.is_some_and(|(gap, i)| gap > 15.0 && i == 20), "{walk:?}");
        assert!(walk.exact_to_file > 5.0, "{walk:?}");
    }

    #[test]
    fn notices_a_doubled_run_and_a_step_back() {
        let exact = loop_of(20.0, 60.0).part(10.0, 200.0);
        let single = moves(&exact, 5.0);
        let twice: Vec<_> = single.iter().chain(&single).copied().collect();
        let walk = follow(&twice, &exact);
        assert!(walk.length > 1.9 * walk.exact_length && walk.file_to_exact > 1.0, "{walk:?}");

        let mut run = single.clone();
        run.insert(11, single[10].reversed());
        run.insert(12, single[10]);
        let walk = super::follow(&run, &exact);
        assert!(walk.backwards.is_some_and(|(by, i)| i == 11 && (by - single[10].length()).abs() < 0.01));
        assert!(walk.largest() < 0.001);
    }

    #[test]
    fn notices_a_circle_turned_inside_out() {
        // The same end points, the other way round: G2 for G3.
        let exact = Path::open(vec![Arc::new(Point::ORIGIN, 10.0, 0.0, 1.0).into()]);
        let wrong = Arc::from_bulge(exact.start().unwrap(), exact.end().unwrap(), -0.25_f64.tan()).unwrap();
        let walk = follow(&[wrong.into()], &exact);
        let sagitta = 10.0 * (1.0 - 0.5_f64.cos());
        assert!((walk.file_to_exact - 2.0 * sagitta).abs() < 0.05, "{walk:?}");
    }

    #[test]
    fn a_full_circle_in_one_step_advances() {
        let circle = Path::closed(vec![Arc::new(Point::ORIGIN, 10.0, 0.3, 2.0 * PI).into()]);
        let walk = follow(&circle.segments, &circle.part(0.0, circle.length()));
        assert!(walk.largest() < 1e-9 && (walk.end - circle.length()).abs() < 1e-9, "{walk:?}");
    }

    #[test]
    fn empty_sides() {
        let exact = loop_of(1.0, 1.0);
        assert_eq!(follow(&[], &exact).largest(), f64::INFINITY);
        assert_eq!(follow(&exact.segments, &Path::default()).largest(), f64::INFINITY);
        assert_eq!(follow(&[], &Path::default()).largest(), 0.0);
    }

    /// Rounding moved the first point of a seam nearer to the second pass of its overlap than to its own start.
    #[test]
    fn a_start_that_is_rounded_towards_the_second_pass_is_still_the_start() {
        let exact = loop_of(10.0, 30.0);
        let twice = exact.part(0.0, exact.length() + 5.0);
        let mut run = twice.segments.clone();
        // The first line begins 0.1 um too early and beside the path, on the side of the second pass.
        let Segment::Line(line) = &mut run[0] else { panic!("a line") };
        line.start = Point::new(line.start.x - 1e-4, line.start.y + 1e-4);
        let walked = follow(&run, &twice);
        assert!(walked.start < 1e-3, "{walked:?}");
        assert!((walked.end - twice.length()).abs() < 1e-3, "{walked:?}");
    }
}
