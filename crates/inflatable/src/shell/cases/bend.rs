//! A V-actuator held at angles other than its angle at rest, and the moment that holds it.
//!
//! The condition that the arm's line, of direction d, makes the angle psi = pi - phi/2 with the x axis is linear in the points:
//! n.d = 0 with n = (-sin psi, cos psi). With its multiplier mu, dU/dphi = mu |d|/2 of the modelled quarter
//! of the whole. Force control would snap near |M| = 0.08 p W^3; at a held angle, the sheet is stable beyond.

use crate::shell::assembly::State;
use crate::shell::cases::arm_line::ArmLine;
use crate::shell::solver::{Aim, DisplacementControl, Solver, Stop};
use std::f64::consts::PI;

/// Largest change of the angle in one solve, rad: 3 deg.
const STEP: f64 = 0.052;
/// Halvings of it.
const MOST_HALVINGS: i32 = 6;
/// The brace's stiffness by p W: enough that no arm snaps, little enough to lose no digits.
const BRACE: f64 = 1000.0;

/// phi: the arm leaves the plane of symmetry, which holds the x axis, on the side of negative x.
pub(crate) fn angle_of(line: &ArmLine, state: &State) -> f64 {
    let [x, y] = line.direction(state);
    // Arms that cross have a negative angle.
    2.0 * libm::atan2(y, -x)
}

/// An arm that is held.
pub(crate) struct Bend<'a> {
    pub(crate) line: &'a ArmLine,
    pub(crate) aim: Aim,
}

impl Bend<'_> {
    /// The moments of the whole actuator, in units of energy, that hold it at `angles`, each reached from the shape at rest
    /// or from the angle before, whichever is nearer.
    pub(crate) fn moments(
        &self,
        solver: &mut Solver,
        rest: &State,
        angles: &[f64],
    ) -> Result<Vec<f64>, Stop> {
        let mut order: Vec<usize> = (0..angles.len()).collect();
        let free = angle_of(self.line, rest);
        order.sort_by(|a, b| (angles[*a] - free).abs().total_cmp(&(angles[*b] - free).abs()));
        let mut moments = vec![0.0; angles.len()];
        let mut ends = [(free, rest.clone()), (free, rest.clone())];
        for k in order {
            let (angle, state) = &mut ends[usize::from(angles[k] > free)];
            moments[k] = self.turn(solver, state, [*angle, angles[k]])?;
            *angle = angles[k];
        }
        solver.lever = None;
        Ok(moments)
    }

    /// Turns `state` from one angle to another in steps; the moment that holds it there.
    fn turn(&self, solver: &mut Solver, state: &mut State, [from, to]: [f64; 2]) -> Result<f64, Stop> {
        let (mut angle, mut step) = (from, STEP);
        loop {
            let next = if (to - angle).abs() <= step { to } else { angle + step * (to - angle).signum() };
            let mut trial = state.clone();
            match self.hold(solver, &mut trial, next) {
                Ok(moment) if next == to => {
                    *state = trial;
                    return Ok(moment);
                }
                Ok(_) => (*state, angle) = (trial, next),
                Err(why) if why == Stop::Cancelled || step < STEP * 0.5_f64.powi(MOST_HALVINGS) => {
                    return Err(why);
                }
                Err(_) => step /= 2.0,
            }
        }
    }

    /// Holds `state`, an equilibrium at an angle near by, at the angle `phi`; the moment of the whole.
    pub(crate) fn hold(&self, solver: &mut Solver, state: &mut State, phi: f64) -> Result<f64, Stop> {
        let (sine, cosine) = libm::sincos(PI - phi / 2.0);
        let normal = [-sine, cosine];
        let [x, y] = self.line.direction(state);
        solver.lever = Some(DisplacementControl {
            row: solver.assembly.project(&self.line.times(normal)),
            point: self.line.last(),
            direction: [normal[0], normal[1], 0.0],
            brace: BRACE * self.aim.pressure,
        });
        if !solver.pull(state, self.aim, -(normal[0] * x + normal[1] * y)) {
            return Err(Stop::Unstable);
        }
        let _ = solver.rest(state, self.aim)?;
        let [x, y] = self.line.direction(state);
        Ok(2.0 * solver.multiplier * libm::hypot(x, y))
    }
}
