//! The best star for a purpose: number of points exhaustively, all else within bounds.
//!
//! For each n a scan finds the regions, and a pattern search (`poll`) starts from the most promising places: a step that helps is
//! doubled, one that does not is halved. Designs are compared by their violation of the constraints, and feasible ones
//! by the goal. Constraints hold at the bad end of the ranges, and a design without a prediction never wins.

mod constraints;
mod front;
mod poll;

pub use self::constraints::{
    Constraint, Constraints, ROUNDING, SEARCHED, Shortfall, is_at_pressure, shortfalls, sure_payload,
};
pub use self::front::thinned;

use self::front::front;
use self::poll::{AXES, UnitPoint, polled, scanned};
use crate::candidate::{Answer, Candidate};
use design::{least_pitch, pitch_for};
use geom::order::sort_by;
use inflatable::mechanics::hinge::ring::RingTable;
use inflatable::numerics::mapped;
use spec::units::{Angle, Length, Pressure};
use std::cmp::Ordering;
use std::ops::RangeInclusive;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

/// The objective of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// Most contraction.
    Contraction,
    /// Most radial stiffness.
    Stiffness,
    /// Least fabric, of all stars.
    Fabric,
    /// Largest design payload.
    Payload,
}

/// The box that is searched, the lower end of each range first. Equal ends fix a value.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchBounds {
    /// Number of points.
    pub points: RangeInclusive<u32>,
    /// Tip angle.
    pub tip_angle: [Angle; 2],
    /// Tube width.
    pub width: [Length; 2],
    /// Tip radius.
    pub tip_radius: [Length; 2],
    /// Corner radius.
    pub corner_radius: [Length; 2],
    /// Inner radius.
    pub inner_radius: [Length; 2],
    /// Pressure; `None`: the load's, or none.
    pub pressure: Option<[Pressure; 2]>,
    /// Number of equal stars; as few as hold the payload are taken.
    pub stars: RangeInclusive<u32>,
}

impl SearchBounds {
    /// The box that holds `base` alone.
    pub fn fixed(base: &Candidate) -> Self {
        let star = &base.star;
        Self {
            points: star.points..=star.points,
            tip_angle: [star.tip_angle; 2],
            width: [star.tube_width; 2],
            tip_radius: [star.tip_radius; 2],
            corner_radius: [star.corner_radius; 2],
            inner_radius: [star.inner_radius; 2],
            pressure: None,
            stars: base.stars..=base.stars,
        }
    }
}

/// A design with its predicted values.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// The design.
    pub point: Candidate,
    /// Predicted values of the candidate.
    pub answer: Answer,
    /// Sum of its violations of the constraints: 0 if it meets all.
    pub violation: f64,
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchResult {
    /// The best design for each n that has one, the best first.
    pub best: Vec<Evaluation>,
    /// Designs that meet the constraints and that no other beats in contraction, stiffness and fabric at once,
    /// by falling contraction.
    pub front: Vec<Evaluation>,
    /// Designs that were computed.
    pub computed: usize,
}

/// Number of evaluations for each n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SearchEffort {
    /// Places of the scan: 1024 leave no gap larger than an eighth of the box in four dimensions.
    pub scanned: u32,
    /// Places that are followed down.
    pub followed: usize,
    /// Polls of one place, most.
    pub polls: u32,
    /// Polls, each in other directions, that must fail before a step is halved: where two constraints meet at a sharp angle only some
    /// directions help.
    pub failures: u32,
}

impl SearchEffort {
    /// For several searches of which none may take long: of the problems of `crates/research/examples/optimum.rs` a grid beats one in a hundred, by 1 %.
    pub const QUICK: Self = Self { scanned: 1024, followed: 4, polls: 80, failures: 1 };
}

impl Default for SearchEffort {
    fn default() -> Self {
        Self { scanned: 1024, followed: 6, polls: 600, failures: 12 }
    }
}

/// Smallest step of a search, of the box's side.
const SMALLEST_STEP: f64 = 1e-4;

/// A search: base design, bounds, constraints and goal.
#[derive(Clone, Copy, Debug)]
pub struct DesignSearch<'a> {
    /// The design that gives all values that are not searched.
    pub base: &'a Candidate,
    /// The box.
    pub bounds: &'a SearchBounds,
    /// The constraints.
    pub constraints: &'a Constraints,
    /// The objective.
    pub goal: Goal,
    /// The ring's table.
    pub table: &'a RingTable,
    /// Number of evaluations.
    pub effort: SearchEffort,
    /// Set by another thread to stop at the next design; the result is then not the best.
    pub cancel: Option<&'a AtomicBool>,
}

impl<'a> DesignSearch<'a> {
    /// A thorough search around `base` without a stop; values that are not searched stay as in `base`.
    pub fn new(
        base: &'a Candidate,
        bounds: &'a SearchBounds,
        constraints: &'a Constraints,
        goal: Goal,
        table: &'a RingTable,
    ) -> Self {
        Self { base, bounds, constraints, goal, table, effort: SearchEffort::default(), cancel: None }
    }

    /// Searches.
    pub fn run(&self) -> SearchResult {
        let point_counts: Vec<u32> = self.bounds.points.clone().collect();
        let evaluations: Vec<Vec<Evaluation>> = mapped(point_counts, |points| self.with_points(points));
        let computed = evaluations.iter().map(Vec::len).sum();
        let better = |a: &&Evaluation, b: &&Evaluation| compare(a, b, self.goal);
        let mut best: Vec<Evaluation> =
            evaluations.iter().filter_map(|of| of.iter().min_by(better)).cloned().collect();
        sort_by(&mut best, |a, b| compare(a, b, self.goal));
        let feasible = evaluations.into_iter().flatten().filter(|candidate| candidate.violation == 0.0);
        SearchResult { best, front: front(feasible.collect()), computed }
    }

    /// The ends of the box along each axis, deg, mm and kPa.
    fn sides(&self) -> [[f64; 2]; AXES] {
        let SearchBounds { tip_angle, width, tip_radius, corner_radius, inner_radius, pressure, .. } =
            self.bounds;
        let spec_pressure = self.base.load.pressure.unwrap_or_default();
        let lengths =
            [width, tip_radius, corner_radius, inner_radius].map(|ends| ends.map(|length| length.0));
        let [width, tip_radius, corner_radius, inner_radius] = lengths;
        let pressure = pressure.unwrap_or([spec_pressure; 2]).map(|pressure| pressure.0);
        [tip_angle.map(|end| end.0), width, tip_radius, corner_radius, inner_radius, pressure]
    }

    /// The design with `points` points at `place`; `None` if it does not exist, cannot be cut out, or the search is cancelled.
    fn evaluated(&self, points: u32, place: &UnitPoint) -> Option<Evaluation> {
        if self.cancel.is_some_and(|cancel| cancel.load(Relaxed)) {
            return None;
        }
        let sides = self.sides();
        // The design that is written is the one that is judged; the ends of the box are exact.
        let [tip_angle, width, tip_radius, corner_radius, inner_radius, pressure] =
            std::array::from_fn(|k| {
                let [minimum, maximum] = sides[k];
                thousandths(minimum + place[k] * (maximum - minimum)).clamp(minimum, maximum)
            });
        let mut point = self.base.clone();
        let star = &mut point.star;
        star.points = points;
        (star.tip_angle, star.tube_width) = (Angle(tip_angle), Length(width));
        (star.tip_radius, star.corner_radius) = (Length(tip_radius), Length(corner_radius));
        star.inner_radius = Length(inner_radius);
        if pressure > 0.0 {
            point.load.pressure = Some(Pressure(pressure));
        }
        point.stars = *self.bounds.stars.start();
        let pitch = point.star.pitch;
        let answer = self.stacked(&mut point)?;
        if point.stars == 1 && pitch.0 > 0.0 {
            point.star.pitch = pitch;
        }
        answer.fabric.is_some().then(|| self.judged(point, &answer))
    }

    /// `point` with the fewest stars that hold the payload, within the bounds and the object's height, at the pitch that
    /// they need; returns its predicted values.
    fn stacked(&self, point: &mut Candidate) -> Option<Answer> {
        let (from, to) = (*self.bounds.stars.start(), *self.bounds.stars.end());
        point.stars = from;
        let (width, plate) = (point.star.tube_width, point.plate);
        point.star.pitch = match point.star.pitch {
            Length(0.0) => pitch_for(width, plate),
            own => Length(own.0.max(least_pitch(width, plate).0)),
        };
        if to == from {
            return point.answer(self.table).ok();
        }
        let to = to.min(point.most_stars()).max(from);
        let Some(payload) = self.constraints.payload else {
            point.stars = if self.goal == Goal::Payload { to } else { from };
            return point.answer(self.table).ok();
        };
        let answer = point.answer(self.table).ok()?;
        let Some(safe) = sure_payload(point, &answer) else { return Some(answer) };
        if safe >= payload || to == from {
            return Some(answer);
        }
        // No star presses harder than one at the object's middle: fewer than these do not hold it.
        let of_one_star = sure_payload(point, &answer.of_stars(1)).unwrap_or(0.0);
        let fewest = (from + 1..=to).find(|count| f64::from(*count) * of_one_star >= payload).unwrap_or(to);
        for count in fewest..=to {
            point.stars = count;
            let answer = point.answer(self.table).ok()?;
            if count == to || sure_payload(point, &answer).is_none_or(|safe| safe >= payload) {
                return Some(answer);
            }
        }
        None
    }

    /// `point`, whose values are `answer`, with its violation of the constraints.
    fn judged(&self, point: Candidate, answer: &Answer) -> Evaluation {
        let missed = shortfalls(&point, answer, self.constraints);
        let violation = missed.iter().map(|shortfall| shortfall.part).sum();
        Evaluation { point, answer: *answer, violation }
    }

    /// All designs with `points` points that were computed.
    fn with_points(&self, points: u32) -> Vec<Evaluation> {
        let sides = self.sides();
        let varied: Vec<usize> = (0..AXES).filter(|&k| sides[k][1] > sides[k][0]).collect();
        let scanned = (1..=if varied.is_empty() { 1 } else { self.effort.scanned })
            .map(|index| scanned(index, &varied))
            .filter_map(|place| Some((place, self.evaluated(points, &place)?)));
        let mut scanned: Vec<(UnitPoint, Evaluation)> = scanned.collect();
        sort_by(&mut scanned, |a, b| compare(&a.1, &b.1, self.goal));
        let starts: Vec<_> = scanned.iter().take(self.effort.followed).cloned().collect();
        let mut evaluations: Vec<Evaluation> =
            scanned.iter().map(|(_, candidate)| candidate.clone()).collect();
        if varied.is_empty() {
            return evaluations;
        }
        for (place, start) in starts {
            evaluations.extend(self.descent(points, place, start, &varied));
        }
        // A design with fewer stars is a step away that no descent takes: each lower number is searched by itself, from its least
        // violation.
        let best =
            evaluations.iter().min_by(|a, b| compare(a, b, self.goal)).map_or(0, |best| best.point.stars);
        let fewest = *self.bounds.stars.start();
        for count in (fewest..best).filter(|_| self.constraints.payload.is_some()) {
            let bounds = SearchBounds { stars: count..=count, ..self.bounds.clone() };
            let fewer = DesignSearch { bounds: &bounds, ..*self };
            // All stars are assumed to meet the object's middle; this only selects starting points.
            let missed = |(place, one): &(UnitPoint, Evaluation)| {
                let point = Candidate { stars: count, ..one.point.clone() };
                (*place, fewer.judged(point, &one.answer.of_stars(count)))
            };
            let places = scanned.iter().map(missed);
            let Some((place, _)) = places.min_by(|a, b| compare(&a.1, &b.1, self.goal)) else { continue };
            let Some(start) = fewer.evaluated(points, &place) else { continue };
            evaluations.extend(fewer.descent(points, place, start, &varied));
        }
        evaluations
    }

    /// All designs on the way downwards from `start`, the design at `place`.
    fn descent(&self, points: u32, place: UnitPoint, start: Evaluation, varied: &[usize]) -> Vec<Evaluation> {
        let (mut place, mut best, mut evaluations) = (place, start, Vec::new());
        let (mut step, mut failed) = (0.1, 0);
        for round in 0..self.effort.polls {
            let mut moved = false;
            for trial in polled(place, step, varied, round) {
                let Some(next) = self.evaluated(points, &trial) else { continue };
                evaluations.push(next.clone());
                if compare(&next, &best, self.goal).is_lt() {
                    (place, best, moved) = (trial, next, true);
                    break;
                }
            }
            failed = if moved { 0 } else { failed + 1 };
            if moved {
                step = (2.0 * step).min(0.2);
            } else if failed % self.effort.failures == 0 {
                step *= 0.5;
            }
            if step < SMALLEST_STEP {
                break;
            }
        }
        evaluations
    }
}

/// A length, angle or pressure as a search writes it into a spec: a micrometre, a thousandth of a degree, a Pascal.
pub fn thousandths(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// Less is better: first the violation, then the goal, then the smaller fabric so that ties are decided.
fn compare(a: &Evaluation, b: &Evaluation, goal: Goal) -> Ordering {
    a.violation
        .total_cmp(&b.violation)
        .then(a.cost(goal).total_cmp(&b.cost(goal)))
        .then(a.fabric().total_cmp(&b.fabric()))
}

impl Evaluation {
    /// The value that `goal` minimises.
    fn cost(&self, goal: Goal) -> f64 {
        let outcome = self.answer.outcome.as_ref();
        match goal {
            Goal::Contraction => -outcome.map_or(0.0, |outcome| outcome.contraction),
            Goal::Stiffness => -outcome.and_then(|outcome| outcome.stiffness).unwrap_or(0.0),
            Goal::Payload => -sure_payload(&self.point, &self.answer).unwrap_or(0.0),
            Goal::Fabric => self.fabric(),
        }
    }

    /// Fabric of all stars, mm^2.
    pub fn fabric(&self) -> f64 {
        self.answer.fabric.map_or(f64::INFINITY, |area| f64::from(self.point.stars) * area)
    }
}

#[cfg(test)]
mod tests;
