//! A hinge without arms: the sector of an annulus between two mirror planes that turn against each other.
//!
//! At the turning angle a = lambda arc the sheet's energy is Pi(a), and by the envelope dPi/da is its change with every
//! point held but those of the turned plane. At rest it vanishes; C alpha_0 = 2 arc d2Pi/da2 for both sheets, whatever arc is.

use crate::shell::assembly::{Plane, Sheet, State, Supports};
use crate::shell::cases::actuator::Fineness;
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::{Family, Watch};
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;
use crate::shell::mesh::{self, Border, Mesh, Meshed, Sizes, plane};
use crate::shell::solver::{Aim, Solver, Stop};

/// A hinge without arms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// The tube of the hinge.
    pub(super) tube: Tube,
    /// Inner radius R, m.
    pub(super) radius: f64,
    /// Flat angle between its planes, rad. Results do not depend on it as long as no wrinkle is as long.
    pub(super) arc: f64,
}

/// A hinge without arms under pressure.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct InflatedCell {
    /// Turning angle at rest by the flat one.
    pub(super) lambda: Value,
    /// C alpha_0, N m: stiffness times the flat turning angle of a hinge.
    pub(super) stiffness: Value,
}

/// Change of lambda in one solve.
const STEP: f64 = 0.03;
/// lambda that no hinge reaches.
const FURTHEST: f64 = 2.0;
/// Half the difference of lambda by which the stiffness is taken.
const DIFFERENCE: f64 = 0.005;
/// Sideways noise by W, so that wrinkles may form.
const NOISE: f64 = 1e-4;

/// Inflates the cell flat, at lambda = 1, then turns it until it needs no moment.
///
/// # Errors
/// If it is out of range or has no stable equilibrium: where it stopped, and why.
pub(super) fn cell(case: &Cell, fineness: Fineness, watch: &Watch) -> Result<InflatedCell, ShellFault> {
    case.tube.check()?;
    let region = mesh::HingeSector { r: case.radius / case.tube.width, w: 1.0, arc: case.arc };
    let coarsest = region.mesh(&Sizes::for_tube(1.0, fineness.cells))?;
    let hold = |meshed: &Meshed, _: &mut Sheet| {
        Supports::new(&meshed.mesh, vec![Plane::first(), Plane::second(case.arc)])
    };
    let family = Family::new(case.tube, coarsest, fineness.cuts, &hold);
    let ([lambda, stiffness], _) = family.run(watch, |solver, meshed, equilibrium, _| {
        let turning = Turning {
            arc: case.arc,
            aim: case.tube.continuation().aim(equilibrium.pressure),
            mesh: &meshed.mesh,
        };
        turning.rest(solver, &equilibrium.state).map_err(|why| case.tube.stopped(why, solver.triangles()))
    })?;
    Ok(InflatedCell { lambda, stiffness: stiffness.scaled(case.tube.energy()) })
}

/// A cell that is being turned.
struct Turning<'a> {
    arc: f64,
    aim: Aim,
    mesh: &'a Mesh,
}

impl Turning<'_> {
    /// lambda at rest, and C alpha_0 in units of energy.
    fn rest(&self, solver: &mut Solver, flat: &State) -> Result<[f64; 2], Stop> {
        let mut state = flat.clone();
        let mut phase = 0.0_f64;
        for x in &mut state.points {
            phase += 12.9898; // no two neighbours alike
            let noise = NOISE * x[2] * libm::sin(phase);
            *x = [x[0] - noise * x[1], x[1] + noise * x[0], x[2]];
        }
        solver.assembly.hold(&mut state);
        let mut turned_by = 1.0;
        let mut moment = self.turn(solver, &mut state, [1.0, 1.0])?;
        // In pressure's favour the energy falls as the cell closes.
        let (mut last_moment, mut lambda) = (moment, turned_by);
        while moment < 0.0 {
            if turned_by > FURTHEST {
                return Err(Stop::Iterations);
            }
            (last_moment, lambda) = (moment, turned_by);
            moment = self.turn(solver, &mut state, [turned_by, turned_by + STEP])?;
            turned_by += STEP;
        }
        for _ in 0..6 {
            // The secant through the last two.
            let next = turned_by - moment * (turned_by - lambda) / (moment - last_moment);
            (last_moment, lambda) = (moment, turned_by);
            moment = self.turn(solver, &mut state, [turned_by, next])?;
            turned_by = next;
            if (turned_by - lambda).abs() < 1e-7 {
                break;
            }
        }
        let mut trial = state.clone();
        let moment_above = self.turn(solver, &mut trial, [turned_by, turned_by + DIFFERENCE])?;
        let moment_below = self.turn(solver, &mut state, [turned_by, turned_by - DIFFERENCE])?;
        Ok([turned_by, 2.0 * (moment_above - moment_below) / (2.0 * DIFFERENCE)])
    }

    /// Turns an equilibrium from one lambda to another; dPi/da there.
    fn turn(&self, solver: &mut Solver, state: &mut State, [from, to]: [f64; 2]) -> Result<f64, Stop> {
        for x in &mut state.points {
            let further = libm::atan2(x[1], x[0]) * (to / from - 1.0);
            *x = turned(*x, further);
        }
        solver.assembly.supports.turn_plane(1, Plane::second(to * self.arc));
        let _ = solver.rest(state, self.aim)?;
        Ok(self.moment(solver, state, to * self.arc))
    }

    /// dPi/da by differences of fourth order, every point held but those of the second plane.
    fn moment(&self, solver: &mut Solver, state: &State, angle: f64) -> f64 {
        let mut is_turned = vec![false; self.mesh.points.len()];
        for edge in self.mesh.border_edges(Border::Mirror(plane::SECOND)) {
            self.mesh.edges[edge].ends.iter().for_each(|end| is_turned[*end] = true);
        }
        let step = 1e-3;
        let turns = [step, -step, 2.0 * step, -2.0 * step];
        let [forward, back, far_forward, far_back] = turns.map(|by| {
            let mut turned_state = state.clone();
            for (x, _) in turned_state.points.iter_mut().zip(&is_turned).filter(|(_, is_turned)| **is_turned)
            {
                *x = turned(*x, by);
            }
            solver.assembly.supports.turn_plane(1, Plane::second(angle + by));
            solver.assembly.energy(&turned_state).total(self.aim.pressure)
        });
        let slope = (8.0 * (forward - back) - (far_forward - far_back)) / (12.0 * step);
        solver.assembly.supports.turn_plane(1, Plane::second(angle));
        slope
    }
}

fn turned(x: [f64; 3], angle: f64) -> [f64; 3] {
    let (sine, cosine) = libm::sincos(angle);
    [cosine * x[0] - sine * x[1], sine * x[0] + cosine * x[1], x[2]]
}
