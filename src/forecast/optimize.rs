//! The best star for a purpose: number of points exhaustively, angle, width and radii within bounds.
//!
//! For each n a **scan** (points of a Halton sequence, which fill the box evenly and are the same on every run) finds
//! the regions, and a **compass search** (steps along each axis, halved when none helps) goes down to the best point
//! of the three most promising ones. Designs are compared by how far they are from meeting the constraints, and
//! among those that meet them by the goal.

use crate::forecast::candidate::{Candidate, Outcome};
use crate::mechanics::hinge::ring::RingTable;
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

/// The box that is searched; lengths in m, angles in rad. Equal ends fix a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// Number of points.
    pub points: RangeInclusive<u32>,
    /// Tip angle.
    pub tip_angle: [f64; 2],
    /// Tube width.
    pub width: [f64; 2],
    /// Tip radius.
    pub tip_radius: [f64; 2],
    /// Corner radius.
    pub corner_radius: [f64; 2],
}

/// What a design must do; absent constraints always hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constraints {
    /// The star must close to the first radius and open to the second, m.
    pub grasp: Option<[f64; 2]>,
    /// Payload of the stack, kg, at the load's pressure, object and friction.
    pub payload: Option<f64>,
    /// Smaller side of the sheet's free area, m: the cut star must fit.
    pub sheet: Option<f64>,
    /// Burst pressure over pressure.
    pub burst_margin: Option<f64>,
}

/// A design with what it does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated {
    /// The design.
    pub point: Candidate,
    /// What it does.
    pub outcome: Outcome,
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
/// Shortest arm over tube width: shorter ones are no straight tube any more, and the model's hinges would overlap.
pub const SHORTEST_ARM: f64 = 0.5;

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
        .map(|points| for_points(points, base, bounds, constraints, goal, table))
        .collect();
    let computed = found.iter().map(Vec::len).sum();
    let better = |a: &&Evaluated, b: &&Evaluated| compare(a, b, goal);
    let mut best: Vec<Evaluated> = found.iter().filter_map(|of| of.iter().min_by(better)).copied().collect();
    best.sort_by(|a, b| compare(a, b, goal));
    let met = found.into_iter().flatten().filter(|candidate| candidate.violation == 0.0);
    Found { best, front: front(met.collect()), computed }
}

fn for_points(
    points: u32,
    base: &Candidate,
    bounds: &Bounds,
    constraints: &Constraints,
    goal: Goal,
    table: &RingTable,
) -> Vec<Evaluated> {
    let sides = [bounds.tip_angle, bounds.width, bounds.tip_radius, bounds.corner_radius];
    let candidate = |place: [f64; 4]| {
        let [tip_angle, width, tip_radius, corner_radius] =
            std::array::from_fn(|k| sides[k][0] + place[k] * (sides[k][1] - sides[k][0]));
        let mut point = *base;
        point.geometry.points = points;
        (point.geometry.tip_angle, point.geometry.width) = (tip_angle, width);
        (point.geometry.tip_radius, point.geometry.corner_radius) = (tip_radius, corner_radius);
        let outcome = point.outcome(table).ok()?;
        let violation = violation(&point, &outcome, constraints);
        Some(Evaluated { point, outcome, violation })
    };
    let mut scanned: Vec<([f64; 4], Evaluated)> =
        (1..=SCANNED).map(halton).filter_map(|place| Some((place, candidate(place)?))).collect();
    scanned.sort_by(|a, b| compare(&a.1, &b.1, goal));
    let starts: Vec<_> = scanned.iter().take(FOLLOWED).copied().collect();
    let mut all: Vec<Evaluated> = scanned.into_iter().map(|(_, candidate)| candidate).collect();
    for (mut place, mut here) in starts {
        let mut step = 0.1;
        while step > SMALLEST_STEP {
            let mut moved = false;
            for k in (0..4).filter(|&k| sides[k][1] > sides[k][0]) {
                for sign in [-1.0, 1.0] {
                    let mut trial = place;
                    trial[k] = (trial[k] + sign * step).clamp(0.0, 1.0);
                    let Some(next) = candidate(trial) else { continue };
                    all.push(next);
                    if compare(&next, &here, goal).is_lt() {
                        (place, here, moved) = (trial, next, true);
                    }
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
    }
    all
}

/// Less is better: first the violation, then the goal, then the smaller fabric so that ties are decided.
fn compare(a: &Evaluated, b: &Evaluated, goal: Goal) -> std::cmp::Ordering {
    let cost = |candidate: &Evaluated| match goal {
        Goal::Contraction => -candidate.outcome.contraction,
        Goal::Stiffness => -candidate.outcome.stiffness.unwrap_or(0.0),
        Goal::Fabric => candidate.outcome.area,
    };
    a.violation
        .total_cmp(&b.violation)
        .then(cost(a).total_cmp(&cost(b)))
        .then(a.outcome.area.total_cmp(&b.outcome.area))
}

/// Sum of relative shortfalls.
fn violation(point: &Candidate, outcome: &Outcome, constraints: &Constraints) -> f64 {
    let geometry = &point.geometry;
    // Short of `least`: relative to it; a missing value is as bad as nothing.
    let short = |value: Option<f64>, least: Option<f64>| {
        least.map_or(0.0, |least| ((least - value.unwrap_or(0.0)) / least).max(0.0))
    };
    let mut sum = short(Some(outcome.arm), Some(SHORTEST_ARM * geometry.width));
    if let Some([close, open]) = constraints.grasp {
        sum += ((outcome.final_radius - close) / close).max(0.0)
            + short(Some(geometry.inner_radius), Some(open));
    }
    sum += short(outcome.payload, constraints.payload);
    if let Some(side) = constraints.sheet {
        sum += ((2.0 * outcome.reach - side) / side).max(0.0);
    }
    let margin = outcome.burst.zip(point.pressure).map(|(burst, p)| burst / p);
    sum + short(margin, constraints.burst_margin)
}

/// The candidates that no other beats in all three goals at once.
fn front(mut candidates: Vec<Evaluated>) -> Vec<Evaluated> {
    let goals = |c: &Evaluated| [-c.outcome.contraction, -c.outcome.stiffness.unwrap_or(0.0), c.outcome.area];
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
        return candidates.iter().take(most.max(1)).copied().collect();
    }
    (0..most).map(|i| candidates[i * (count - 1) / (most - 1)]).collect()
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
            tip_angle: [30_f64.to_radians(); 2],
            width: [0.03; 2],
            tip_radius: [0.0; 2],
            corner_radius: [0.0; 2],
        }
    }

    fn table() -> RingTable {
        RingTable::new().expect("solved")
    }

    #[test]
    fn the_papers_star_contracts_most_with_four_or_five_points() {
        let found = search(&base(), &bounds(), &Constraints::default(), Goal::Contraction, &table());
        assert!([4, 5].contains(&found.best[0].point.geometry.points), "{:?}", found.best[0].point.geometry);
        // n = 8 has arms of 6 mm, too short, and comes after all others; n = 9 has none.
        assert!(found.best.len() == 6 && found.best[5].violation > 0.0);
    }

    #[test]
    fn the_optimum_is_the_best_of_a_dense_grid() {
        let bounds = Bounds { tip_angle: [0.3, 1.0], width: [0.015, 0.04], points: 4..=5, ..bounds() };
        let constraints =
            Constraints { payload: Some(0.5), grasp: Some([0.02, 0.05]), ..Constraints::default() };
        let table = table();
        let found = search(&base(), &bounds, &constraints, Goal::Fabric, &table);
        let best = found.best[0];
        assert_eq!(best.violation, 0.0);
        for n in 4..=5 {
            for i in 0..=60 {
                for j in 0..=60 {
                    let mut point = base();
                    point.geometry.points = n;
                    point.geometry.tip_angle = 0.3 + 0.7 * f64::from(i) / 60.0;
                    point.geometry.width = 0.015 + 0.025 * f64::from(j) / 60.0;
                    if let Ok(outcome) = point.outcome(&table)
                        && violation(&point, &outcome, &constraints) == 0.0
                    {
                        assert!(outcome.area > best.outcome.area * 0.999, "{point:?} is smaller");
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_on_the_front_is_beaten() {
        let bounds = Bounds { tip_angle: [0.2, 1.2], width: [0.01, 0.04], points: 3..=6, ..bounds() };
        let found = search(&base(), &bounds, &Constraints::default(), Goal::Contraction, &table());
        assert!(found.front.len() > 10 && found.computed > 1000);
        for (i, a) in found.front.iter().enumerate().step_by(7) {
            for (j, b) in found.front.iter().enumerate() {
                let (x, y) = (a.outcome, b.outcome);
                let beats = y.contraction >= x.contraction && y.stiffness >= x.stiffness && y.area <= x.area;
                assert!(i == j || !beats, "{i} {j}");
            }
        }
        let shown = thinned(&found.front, 5);
        assert!(
            shown.len() == 5 && shown[0] == found.front[0] && shown[4] == found.front[found.front.len() - 1]
        );
    }

    #[test]
    fn a_search_is_the_same_in_any_number_of_threads() {
        let bounds = Bounds { tip_angle: [0.2, 1.2], ..bounds() };
        let run = || search(&base(), &bounds, &Constraints::default(), Goal::Stiffness, &table());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        assert_eq!(run(), pool.install(run));
    }
}
