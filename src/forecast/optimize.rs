//! The best star for a purpose: number of points exhaustively, angle, width and radii within bounds.
//!
//! For each n a **scan** (points of a Halton sequence, which fill the box evenly and are the same on every run) finds
//! the regions, and a **compass search** (steps along each axis, halved when none helps) goes down to the best point
//! of the three most promising ones. Designs are compared by how far they are from meeting the constraints, and
//! among those that meet them by the goal.

use crate::forecast::candidate::{Answer, Candidate};
use crate::forecast::outcome::SHORTEST_ARM;
use crate::mechanics::hinge::ring::RingTable;
use crate::units::{Angle, Length};
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// What is to be largest or smallest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// Most contraction.
    Contraction,
    /// Most radial stiffness.
    Stiffness,
    /// Least fabric.
    Fabric,
}

/// The box that is searched. Equal ends fix a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
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
}

/// What a design must do; absent constraints always hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constraints {
    /// The star must close to the first radius; the second must enter the flat star, and the inflated one must open to it.
    pub grasp: Option<[Length; 2]>,
    /// Payload of the stack, kg, at the load's pressure, object and friction.
    pub payload: Option<f64>,
    /// Smaller side of the sheet's free area: the cut star must fit.
    pub sheet: Option<Length>,
    /// Burst pressure over pressure.
    pub burst_margin: Option<f64>,
}

/// A design with what it does.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluated {
    /// The design.
    pub point: Candidate,
    /// What it does.
    pub answer: Answer,
    /// How far it is from meeting the constraints: 0 if it meets all.
    pub violation: f64,
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The best design for each n that has one, the best first.
    pub best: Vec<Evaluated>,
    /// Designs that meet the constraints and that no other beats in contraction, stiffness and fabric at once,
    /// by falling contraction.
    pub front: Vec<Evaluated>,
    /// Designs that were computed.
    pub computed: usize,
}

/// Scanned designs for each n: 2048 leave no gap larger than a tenth of the box in four dimensions.
const SCANNED: u32 = 2048;
/// Regions that are followed down for each n.
const FOLLOWED: usize = 3;
/// Smallest step of the compass search, of the box's side.
const SMALLEST_STEP: f64 = 1e-4;
/// By how much constraints are tightened for the search, so that they still hold once the values are rounded.
pub const ROUNDING: f64 = 5e-4;

/// Searches around `base`, whose other values are kept.
pub fn search(
    base: &Candidate,
    bounds: &Bounds,
    constraints: &Constraints,
    goal: Goal,
    table: &RingTable,
) -> Found {
    let all: Vec<u32> = bounds.points.clone().collect();
    let found: Vec<Vec<Evaluated>> = all
        .into_par_iter()
        .map(|points| Search { base, bounds, constraints, goal, table }.with_points(points))
        .collect();
    let computed = found.iter().map(Vec::len).sum();
    let better = |a: &&Evaluated, b: &&Evaluated| compare(a, b, goal);
    let mut best: Vec<Evaluated> = found.iter().filter_map(|of| of.iter().min_by(better)).cloned().collect();
    best.sort_by(|a, b| compare(a, b, goal));
    let met = found.into_iter().flatten().filter(|candidate| candidate.violation == 0.0);
    Found { best, front: front(met.collect()), computed }
}

/// What is searched, and for what.
struct Search<'a> {
    base: &'a Candidate,
    bounds: &'a Bounds,
    constraints: &'a Constraints,
    goal: Goal,
    table: &'a RingTable,
}

/// A place in the unit cube that stands for the box: tip angle, width, tip and corner radius.
type Place = [f64; 4];

impl Search<'_> {
    /// The ends of the box along each axis, deg and mm.
    fn sides(&self) -> [[f64; 2]; 4] {
        let Bounds { tip_angle, width, tip_radius, corner_radius, .. } = *self.bounds;
        let [width, tip_radius, corner_radius] = [width, tip_radius, corner_radius].map(|e| e.map(|l| l.0));
        [tip_angle.map(|end| end.0), width, tip_radius, corner_radius]
    }

    /// The design with `points` points at `place`; `None` if there is none, or it cannot be cut out.
    fn at(&self, points: u32, place: Place) -> Option<Evaluated> {
        let sides = self.sides();
        let [tip_angle, width, tip_radius, corner_radius] =
            std::array::from_fn(|k| sides[k][0] + place[k] * (sides[k][1] - sides[k][0]));
        let mut point = self.base.clone();
        point.star.points = points;
        (point.star.tip_angle, point.star.tube_width) = (Angle(tip_angle), Length(width));
        (point.star.tip_radius, point.star.corner_radius) = (Length(tip_radius), Length(corner_radius));
        let answer = point.answer(self.table).ok()?;
        let violation = violation(&point, &answer, self.constraints);
        answer.fabric.is_some().then_some(Evaluated { point, answer, violation })
    }

    /// All designs with `points` points that were computed.
    fn with_points(&self, points: u32) -> Vec<Evaluated> {
        let mut scanned: Vec<(Place, Evaluated)> =
            (1..=SCANNED).map(halton).filter_map(|place| Some((place, self.at(points, place)?))).collect();
        scanned.sort_by(|a, b| compare(&a.1, &b.1, self.goal));
        let starts: Vec<_> = scanned.iter().take(FOLLOWED).cloned().collect();
        let mut all: Vec<Evaluated> = scanned.into_iter().map(|(_, candidate)| candidate).collect();
        for (place, here) in starts {
            self.descend(points, place, here, &mut all);
        }
        all
    }

    /// The compass search from `here` at `place`; all designs on the way go to `all`.
    fn descend(&self, points: u32, mut place: Place, mut here: Evaluated, all: &mut Vec<Evaluated>) {
        let sides = self.sides();
        let mut step = 0.1;
        while step > SMALLEST_STEP {
            let mut moved = false;
            for k in (0..4).filter(|&k| sides[k][1] > sides[k][0]) {
                for sign in [-1.0, 1.0] {
                    let mut trial = place;
                    trial[k] = (trial[k] + sign * step).clamp(0.0, 1.0);
                    let Some(next) = self.at(points, trial) else { continue };
                    all.push(next.clone());
                    if compare(&next, &here, self.goal).is_lt() {
                        (place, here, moved) = (trial, next, true);
                    }
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
    }
}

/// Less is better: first the violation, then the goal, then the smaller fabric so that ties are decided.
fn compare(a: &Evaluated, b: &Evaluated, goal: Goal) -> std::cmp::Ordering {
    let cost = |candidate: &Evaluated| match goal {
        Goal::Contraction => -candidate.answer.outcome.contraction,
        Goal::Stiffness => -candidate.answer.outcome.stiffness.unwrap_or(0.0),
        Goal::Fabric => fabric(candidate),
    };
    a.violation
        .total_cmp(&b.violation)
        .then(cost(a).total_cmp(&cost(b)))
        .then(fabric(a).total_cmp(&fabric(b)))
}

fn fabric(candidate: &Evaluated) -> f64 {
    candidate.answer.fabric.unwrap_or(f64::INFINITY)
}

/// Sum of relative shortfalls.
fn violation(point: &Candidate, answer: &Answer, constraints: &Constraints) -> f64 {
    // Short of `least`: relative to it; a missing value is as bad as nothing.
    let short = |value: Option<f64>, least: Option<f64>| {
        least.map_or(0.0, |least| ((least - value.unwrap_or(0.0)) / least).max(0.0))
    };
    let (star, rest) = (&answer.star, &answer.outcome.rest);
    let mut sum = short(Some(star.l), Some(SHORTEST_ARM * star.w));
    if let Some([close, open]) = constraints.grasp {
        let widest = Length::from_metres(rest.widest.radius).0;
        sum += ((Length::from_metres(rest.radius).0 - close.0) / close.0).max(0.0)
            + short(Some(star.rho_0), Some(open.0))
            + short(Some(widest), Some(open.0 * (1.0 + ROUNDING)));
    }
    sum += short(answer.payload, constraints.payload);
    if let Some(side) = constraints.sheet {
        let reach = star.tip_reach() + point.seal.band.0 + point.seal.allowance.0;
        sum += ((2.0 * reach - side.0) / side.0).max(0.0);
    }
    let margin = answer.burst.zip(point.load.pressure).map(|(burst, pressure)| burst.0 / pressure.0);
    sum + short(margin, constraints.burst_margin)
}

/// The candidates that no other beats in all three goals at once.
fn front(mut candidates: Vec<Evaluated>) -> Vec<Evaluated> {
    let goals = |c: &Evaluated| {
        let outcome = &c.answer.outcome;
        [-outcome.contraction, -outcome.stiffness.unwrap_or(0.0), fabric(c)]
    };
    candidates.sort_by(|a, b| {
        let (a, b) = (goals(a), goals(b));
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    });
    let mut front: Vec<Evaluated> = Vec::new();
    for candidate in candidates {
        let own = goals(&candidate);
        // Sorted by contraction: only candidates already kept can beat or equal this one.
        let beaten = front.iter().map(goals).any(|other| (0..3).all(|k| other[k] <= own[k]));
        if !beaten {
            front.push(candidate);
        }
    }
    front
}

/// Candidate `index` of the Halton sequence in bases 2, 3, 5, 7.
fn halton(index: u32) -> [f64; 4] {
    [2, 3, 5, 7].map(|base| {
        let (mut rest, mut part, mut sum) = (index, 1.0, 0.0);
        while rest > 0 {
            part /= f64::from(base);
            sum += part * f64::from(rest % base);
            rest /= base;
        }
        sum
    })
}

/// Every `of`-th of `candidates`, ends included: a front has hundreds, a table a dozen.
pub fn thinned(candidates: &[Evaluated], most: usize) -> Vec<Evaluated> {
    let count = candidates.len();
    if count <= most || most < 2 {
        return candidates.iter().take(most.max(1)).cloned().collect();
    }
    (0..most).map(|i| candidates[i * (count - 1) / (most - 1)].clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{Source, read, starter};

    fn base() -> Candidate {
        let load = "\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nfriction = 0.5\n";
        let text = starter("x").expect("a name") + load;
        Candidate::of(&read(&Source::new("x", text)).expect("valid").spec).expect("a star")
    }

    fn bounds() -> Bounds {
        Bounds {
            points: 3..=9,
            tip_angle: [Angle(30.0); 2],
            width: [Length(30.0); 2],
            tip_radius: [Length(0.0); 2],
            corner_radius: [Length(0.0); 2],
        }
    }

    fn table() -> RingTable {
        RingTable::new().expect("solved")
    }

    #[test]
    fn the_papers_star_contracts_most_with_four_or_five_points() {
        let found = search(&base(), &bounds(), &Constraints::default(), Goal::Contraction, &table());
        assert!([4, 5].contains(&found.best[0].point.star.points), "{:?}", found.best[0].point.star);
        // n = 8 has arms of 6 mm, too short, and comes after all others; n = 9 has none.
        assert!(found.best.len() == 6 && found.best[5].violation > 0.0);
    }

    #[test]
    fn the_optimum_is_the_best_of_a_dense_grid() {
        let bounds = Bounds {
            tip_angle: [20.0, 57.0].map(Angle),
            width: [15.0, 40.0].map(Length),
            points: 4..=5,
            ..bounds()
        };
        let constraints = Constraints {
            payload: Some(0.5),
            grasp: Some([20.0, 50.0].map(Length)),
            ..Constraints::default()
        };
        let table = table();
        let found = search(&base(), &bounds, &constraints, Goal::Fabric, &table);
        let best = found.best[0].clone();
        assert_eq!(best.violation, 0.0);
        for n in 4..=5 {
            for i in 0..=60 {
                for j in 0..=60 {
                    let mut point = base();
                    point.star.points = n;
                    point.star.tip_angle = Angle(20.0 + 37.0 * f64::from(i) / 60.0);
                    point.star.tube_width = Length(15.0 + 25.0 * f64::from(j) / 60.0);
                    if let Ok(answer) = point.answer(&table)
                        && violation(&point, &answer, &constraints) == 0.0
                        && let Some(area) = answer.fabric
                    {
                        assert!(area > fabric(&best) * 0.999, "{point:?} is smaller");
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_on_the_front_is_beaten() {
        let bounds = Bounds {
            tip_angle: [12.0, 69.0].map(Angle),
            width: [10.0, 40.0].map(Length),
            points: 3..=6,
            ..bounds()
        };
        let found = search(&base(), &bounds, &Constraints::default(), Goal::Contraction, &table());
        assert!(found.front.len() > 10 && found.computed > 1000);
        for (i, a) in found.front.iter().enumerate().step_by(7) {
            for (j, b) in found.front.iter().enumerate() {
                let (x, y) = (a.answer.outcome, b.answer.outcome);
                let beats =
                    y.contraction >= x.contraction && y.stiffness >= x.stiffness && fabric(b) <= fabric(a);
                assert!(i == j || !beats, "{i} {j}");
            }
        }
        let shown = thinned(&found.front, 5);
        assert!(
            shown.len() == 5 && shown[0] == found.front[0] && shown[4] == found.front[found.front.len() - 1]
        );
    }

    /// The digits of the index in each base, mirrored at the point: 6 is 110, 20, 11 and 6.
    #[test]
    fn the_scan_mirrors_digits() {
        assert_eq!(halton(1), [1.0 / 2.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0]);
        let expected = [3.0 / 8.0, 2.0 / 9.0, 6.0 / 25.0, 6.0 / 7.0];
        assert!(halton(6).iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-15));
    }

    #[test]
    fn a_search_is_the_same_in_any_number_of_threads() {
        let bounds = Bounds { tip_angle: [12.0, 69.0].map(Angle), ..bounds() };
        let run = || search(&base(), &bounds, &Constraints::default(), Goal::Stiffness, &table());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        assert_eq!(run(), pool.install(run));
    }
}
