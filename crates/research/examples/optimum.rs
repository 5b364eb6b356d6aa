//! Searches against grids: problems at random, the winner of each against 10^5 designs of a grid that meet the same constraints.
//!
//! `cargo run --release -p research --example optimum -- 200`; with a second number, that problem alone. `-- 200 shell 20` computes the first 20
//! winners with constraints that a shell can check as shells: closing, opening and force.

#[path = "support/dice.rs"]
mod dice;

use dice::Dice;
use rayon::prelude::*;
use stargrip_cam::forecast::candidate::{Answer, Candidate};
use stargrip_cam::forecast::optimize::{
    Constraints, DesignSearch, Evaluation, Goal, SearchBounds, shortfalls, sure_payload,
};
use stargrip_cam::forecast::shell::star::flat;
use stargrip_cam::mechanics::hinge::ring::RingTable;
use stargrip_cam::mechanics::strength::payload as mass_held;
use stargrip_cam::shell::cases::{Fineness, Objects, Watch, star};
use stargrip_cam::shell::element::Weave;
use stargrip_cam::spec::{Load, Source, read, starter};
use stargrip_cam::units::{Angle, Length, LineForce, Pressure};
use std::env;
use std::error::Error;

/// Places of the grid along two varied values: with ten numbers of points 10^5 designs.
const PLACES: u32 = 100;
const POINTS: std::ops::RangeInclusive<u32> = 3..=12;
/// By how much the winner may be beaten.
const BEATEN: f64 = 0.005;

/// One problem: base design, bounds, constraints and goal.
struct Problem {
    base: Candidate,
    bounds: SearchBounds,
    constraints: Constraints,
    goal: Goal,
}

impl Dice {
    fn even(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.throw()
    }

    fn one_in(&mut self, count: f64) -> bool {
        self.throw() < 1.0 / count
    }
}

impl Problem {
    /// A star of the paper's fabric or one like it, its tip angle searched with its width, its hole or its pressure.
    fn drawn(dice: &mut Dice, paper: &Candidate) -> Self {
        let mut base = paper.clone();
        let width = dice.even(15.0, 45.0);
        let hole = width * dice.even(0.8, 4.0);
        (base.star.tube_width, base.star.inner_radius) = (Length(width), Length(hole));
        base.fabric.thickness = Length(width * dice.even(0.011, 0.025));
        base.fabric.seal_strength = Some(LineForce(dice.even(1.0, 8.0)));
        let round = if dice.one_in(3.0) { 0.0 } else { 0.15 * width };
        (base.star.tip_radius, base.star.corner_radius) = (Length(round), Length(round));
        let pressure = dice.even(8.0, 50.0);
        let object = hole * dice.even(0.4, 0.95);
        base.load = Load {
            pressure: Some(Pressure(pressure)),
            object_radius: Some(Length(object)),
            friction: Some(dice.even(0.2, 0.9)),
            ..base.load
        };
        let mut bounds =
            SearchBounds { points: POINTS, tip_angle: [15.0, 75.0].map(Angle), ..SearchBounds::fixed(&base) };
        match (3.0 * dice.throw()).floor() {
            0.0 => bounds.inner_radius = [0.7, 1.5].map(|part| Length(part * hole)),
            1.0 => bounds.pressure = Some([0.5, 1.5].map(|part| Pressure(part * pressure))),
            _ => bounds.width = [0.6, 1.4].map(|part| Length(part * width)),
        }
        let grasp = [hole * dice.even(0.4, 1.0), hole * dice.even(0.7, 1.0)].map(Length);
        let constraints = Constraints {
            grasp: dice.one_in(2.0).then_some(grasp),
            hole: None,
            payload: dice.one_in(2.0).then(|| dice.even(0.05, 1.5)),
            largest_force: dice.one_in(4.0).then(|| dice.even(5.0, 60.0)),
            sheet: dice.one_in(4.0).then(|| Length(hole * dice.even(4.0, 8.0))),
            burst_margin: dice.one_in(2.0).then_some(1.0),
            apart: false,
        };
        let goals = [Goal::Contraction, Goal::Stiffness, Goal::Fabric, Goal::Payload];
        let goal = goals[usize::from(dice.one_in(2.0)) + 2 * usize::from(dice.one_in(2.0))];
        let apart = matches!(goal, Goal::Stiffness | Goal::Payload);
        let constraints = Constraints { apart, ..constraints };
        Self { base, bounds, constraints, goal }
    }

    /// The value of a design, to be maximised; `None` if unknown.
    fn worth(&self, point: &Candidate, answer: &Answer) -> Option<f64> {
        let own = answer.outcome.as_ref()?;
        match self.goal {
            Goal::Contraction => Some(own.contraction),
            Goal::Stiffness => own.stiffness,
            Goal::Payload => sure_payload(point, answer),
            Goal::Fabric => answer.fabric.map(|area| 1.0 / area),
        }
    }

    /// The optimum of the search; `None` if no design meets the constraints.
    fn winner(&self, table: &RingTable) -> Option<Evaluation> {
        let found = DesignSearch::new(&self.base, &self.bounds, &self.constraints, self.goal, table).run();
        found.best.into_iter().next().filter(|best| best.violation == 0.0)
    }

    /// The best of the grid's designs that meet the constraints, and how many do.
    fn best_of_grid(&self, table: &RingTable) -> (Option<f64>, usize) {
        let all: Vec<f64> = POINTS
            .into_par_iter()
            .flat_map_iter(|points| (0..PLACES * PLACES).map(move |place| (points, place)))
            .filter_map(|(points, place)| self.at(points, [place / PLACES, place % PLACES], table))
            .collect();
        (all.iter().copied().reduce(f64::max), all.len())
    }

    fn at(&self, points: u32, place: [u32; 2], table: &RingTable) -> Option<f64> {
        let SearchBounds { tip_angle, width, inner_radius, pressure, .. } = &self.bounds;
        let [first, second] = place.map(|k| f64::from(k) / f64::from(PLACES - 1));
        let between = |[from, to]: [f64; 2], part: f64| from + part * (to - from);
        let mut point = self.base.clone();
        point.star.points = points;
        point.star.tip_angle = Angle(between(tip_angle.map(|end| end.0), first));
        point.star.tube_width = Length(between(width.map(|end| end.0), second));
        point.star.inner_radius = Length(between(inner_radius.map(|end| end.0), second));
        if let Some(ends) = pressure {
            point.load.pressure = Some(Pressure(between(ends.map(|end| end.0), second)));
        }
        let answer = point.answer(table).ok()?;
        let fits = answer.fabric.is_some() && shortfalls(&point, &answer, &self.constraints).is_empty();
        self.worth(&point, &answer).filter(|_| fits)
    }
}

/// Meshes of some 1,500, 6,000 and 24,000 unknowns.
const FINENESS: Fineness = Fineness { cells: 8.0, cuts: 2 };

/// The shell's check of a winner: each constraint that it can check, and whether it holds.
fn judged(problem: &Problem, winner: &Evaluation) -> Result<Vec<(String, bool)>, Box<dyn Error>> {
    let (point, answer) = (&winner.point, &winner.answer);
    let Constraints { grasp, payload, largest_force, .. } = problem.constraints;
    let flat = flat(&answer.case, Weave::ISOTROPIC).map_err(|refusal| format!("{refusal:?}"))?;
    let presses = payload.is_some() || largest_force.is_some();
    let object = point.load.object_radius.filter(|_| presses).map(Length::metres);
    let mut radii: Vec<f64> = object.into_iter().chain(grasp.map(|[_, open]| open.metres())).collect();
    radii.sort_by(f64::total_cmp);
    let found = star(&flat, Objects::Radii(&radii), FINENESS, &Watch::default())?;
    let mut said = Vec::new();
    if let Some([close, open]) = grasp {
        let rest = Length::from_metres(found.final_radius.value);
        said.push((format!("closes to {:.2} mm, {:.2} asked", rest.0, close.0), rest.0 <= close.0));
        said.push((format!("opens to {:.2} mm", open.0), true));
    }
    let force = object.and_then(|object| found.forces.iter().find(|(radius, _)| *radius == object));
    let open = force.map_or(0.0, |(_, force)| force.error / force.value.max(force.error));
    let opened = force.map_or(0.0, |(radius, _)| (radius - found.final_radius.value) / flat.tube.width);
    let about = format!("opened by {opened:.2} W, force open by {:.0} %", 100.0 * open);
    let force = force.map(|(_, force)| force.value.max(0.0));
    if let (Some(least), Some(force), Some(friction)) = (payload, force, answer.case.friction) {
        let held = mass_held(friction, (0..point.stars).map(|_| force));
        said.push((format!("holds {held:.3} kg, {least:.3} asked ({about})"), held >= least));
    }
    if let (Some(most), Some(force)) = (largest_force, force) {
        said.push((format!("presses with {force:.2} N, {most:.2} allowed ({about})"), force <= most));
    }
    Ok(said)
}

/// Checks the first `wanted` winners of `problems` that a shell can check.
fn judge(problems: &[Problem], wanted: usize, only: Option<u32>, table: &RingTable) {
    let (mut judged_winners, mut kept, mut broken) = (0, 0, 0);
    for (number, problem) in (1_u32..).zip(problems) {
        let Constraints { grasp, payload, largest_force, .. } = problem.constraints;
        if only.is_some_and(|only| only != number) {
            continue;
        }
        if judged_winners == wanted || (grasp.is_none() && payload.is_none() && largest_force.is_none()) {
            continue;
        }
        let Some(winner) = problem.winner(table) else { continue };
        judged_winners += 1;
        match judged(problem, &winner) {
            Err(fault) => {
                broken += 1;
                println!("problem {number}: {fault}");
            }
            Ok(said) => {
                for (what, holds) in said {
                    if holds {
                        kept += 1;
                    } else {
                        broken += 1;
                    }
                    println!("problem {number}: {}{what}", if holds { "" } else { "BROKEN: " });
                }
            }
        }
    }
    println!("{judged_winners} winners as shells: {kept} constraints hold, {broken} do not");
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = env::args().skip(1).collect();
    let shells: Option<usize> = match words.iter().position(|word| word == "shell") {
        Some(place) => Some(words.get(place + 1).map_or(Ok(20), |word| word.parse())?),
        None => None,
    };
    let words = words.split(|word| word == "shell").next().unwrap_or_default();
    let numbers: Vec<u32> = words.iter().map(|word| word.parse()).collect::<Result<_, _>>()?;
    let wanted = numbers.first().copied().unwrap_or(20);
    let paper = Candidate::from_spec(&read(&Source::new("starter", starter("x")?))?.spec).ok_or("no star")?;
    let table = RingTable::new()?;
    let mut dice = Dice(11);
    if let Some(shells) = shells {
        let problems: Vec<Problem> = (0..wanted).map(|_| Problem::drawn(&mut dice, &paper)).collect();
        judge(&problems, shells, numbers.get(1).copied(), &table);
        return Ok(());
    }
    let (mut solved, mut none, mut missed, mut worst) = (0, 0, 0, 0.0_f64);
    for number in 1..=wanted {
        let problem = Problem::drawn(&mut dice, &paper);
        if numbers.get(1).is_some_and(|only| *only != number) {
            continue;
        }
        let own = problem.winner(&table).and_then(|best| problem.worth(&best.point, &best.answer));
        let (grid, meeting) = problem.best_of_grid(&table);
        match (own, grid) {
            (_, None) => none += 1,
            (None, Some(_)) => {
                missed += 1;
                println!(
                    "problem {number} ({:?}): {meeting} designs of the grid, none by the search",
                    problem.goal
                );
            }
            (Some(own), Some(grid)) => {
                solved += 1;
                let beaten = grid / own - 1.0;
                worst = worst.max(beaten);
                if beaten > BEATEN {
                    missed += 1;
                    println!(
                        "problem {number} ({:?}): beaten by {:.2} %, {meeting} designs",
                        problem.goal,
                        100.0 * beaten
                    );
                }
            }
        }
    }
    println!(
        "{wanted} problems, {none} without a design on the grid, {solved} solved; beaten by {:.3} % at most; missed {missed}",
        100.0 * worst
    );
    Ok(())
}
