//! The shape in which the potential is least, by Newton's method with the exact Hessian.
//!
//! A hinge at rest is a minimum in shape *and* coiling, so lambda is one more unknown, and no search for the vanishing
//! moment is needed. The Hessian is banded but for lambda's row, which costs one more solution:
//!
//! ```text
//! [ H     g_l  ] [ dx      ]     [ g    ]       H v = -g_l,    S = Pi_ll + g_l v
//! [ g_l^T Pi_ll] [ dlambda ] = - [ Pi_l ]       dlambda = -(Pi_l + g_l u) / S,    H u = -g,    dx = u + v dlambda
//! ```
//!
//! The Schur complement S is the second derivative of Pi along the branch of equilibria, which is the hinge's stiffness,
//! and v the branch's tangent dx/dlambda. Where H is not positive definite the indefinite terms are left out, and then the
//! diagonal shifted; steps are halved until Pi falls enough (Armijo). A solution is accepted only where the exact,
//! unshifted H is positive definite. The buffers are made once.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::section::density::Scales;
use crate::mechanics::hinge::section::mesh::MeridianMesh;
use crate::mechanics::hinge::section::potential::{Potential, WIDTH, value};
use crate::mechanics::hinge::section::table::MOST_TABLED_R_STAR;
use crate::numerics::{SymmetricBand, dot};

/// Half the opening angles (rad) of the arcs from which a hinge is searched, one after the other, and their coiling. The
/// first is so shallow that its strains are small, and nearly always does; from steeper arcs of soft sheets it takes twice
/// the steps, from the flat sheet the first is unbounded. Rims sharper than a thousandth of the width may need another.
const STARTS: [f64; 5] = [0.2, 0.6, 1.0, 0.05, 1.4];
const START_LAMBDA: f64 = 1.02;
/// Elements of the mesh on which a hinge is searched first, in one: most of Newton's steps are taken there.
const COARSER: usize = 4;
/// Decrement at which the coarser mesh is solved well enough: the remaining error is less than the change to the finer mesh.
const ENOUGH_TO_REFINE: f64 = 1e-6;
/// Newton's decrement, relative to Pi, at which the last step is taken: that step squares it.
const CONVERGED: f64 = 1e-10;
/// Decrement at which a step that does not lower Pi any more is laid to rounding.
const ROUNDING: f64 = 1e-9;
/// Most steps; the random cases of the tests take 40 at most.
const MOST_STEPS: u32 = 200;
/// Armijo's share of the fall that the slope promises.
const ARMIJO: f64 = 1e-4;
/// Largest change of lambda in one step: the membrane's law is linear in lambda, the pressure's not.
const MOST_TURN: f64 = 0.1;
/// Shift beyond which there is no use in going on.
const MOST_SHIFT: f64 = 1e12;

/// The search for shapes of one section, with the shape found last.
#[derive(Clone, Debug)]
pub(super) struct ShapeSearch {
    pub(super) scales: Scales,
    pub(super) mesh: MeridianMesh,
    /// Coiling factor.
    pub(super) lambda: f64,
    /// Q, Q', z, z' at each node.
    pub(super) shape: Vec<f64>,
    /// Derivatives at the shape.
    pub(super) potential: Potential,
    /// S.
    pub(super) stiffness: f64,
    /// Newton's decrement, relative to Pi, before the last step.
    pub(super) decrement: f64,
    /// Decrement at which the last step is taken.
    enough: f64,
    /// Factorisations so far.
    pub(super) factorisations: u32,
    factors: SymmetricBand<WIDTH>,
    lumped: Vec<f64>,
    /// v.
    tangent: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
}

impl ShapeSearch {
    /// Begins with a shallow arc.
    pub(super) fn new(scales: Scales, mesh: MeridianMesh) -> Self {
        let zero = vec![0.0; mesh.unknowns()];
        let lambda = START_LAMBDA;
        let shape = arc(&mesh, lambda, STARTS[0]);
        Self {
            scales,
            lambda,
            shape,
            potential: Potential::new(zero.len()),
            stiffness: 0.0,
            decrement: f64::MAX,
            enough: CONVERGED,
            factorisations: 0,
            factors: SymmetricBand::zero(zero.len()),
            lumped: lumped(&mesh),
            tangent: zero.clone(),
            step: zero.clone(),
            trial: zero,
            mesh,
        }
    }

    /// Goes from the beginning to the hinge at rest, by way of a coarser mesh.
    pub(super) fn rest(&mut self) -> Result<(), HingeFault> {
        let mut coarse = Self::new(self.scales, self.mesh.coarser(COARSER));
        coarse.enough = ENOUGH_TO_REFINE;
        let outcome = coarse.search_from_arcs(None);
        self.factorisations += coarse.factorisations;
        if outcome.is_ok() {
            self.lambda = coarse.lambda;
            self.shape = self.mesh.refined(&coarse.mesh, &coarse.shape);
            if self.minimise(true).is_ok() {
                return Ok(());
            }
        }
        self.search_from_arcs(None)
    }

    /// Goes from the beginning to the hinge at rest, or to the shape at the coiling factor `fixed_lambda`.
    pub(super) fn search_from_arcs(&mut self, fixed_lambda: Option<f64>) -> Result<(), HingeFault> {
        for angle in STARTS {
            self.lambda = fixed_lambda.unwrap_or(START_LAMBDA);
            self.shape = arc(&self.mesh, self.lambda, angle);
            if self.minimise(fixed_lambda.is_none()).is_ok() {
                return Ok(());
            }
        }
        Err(self.fault())
    }

    /// Follows the branch of equilibria from the last one to `lambda`.
    pub(super) fn hold(&mut self, lambda: f64) -> Result<(), HingeFault> {
        let mut max_turn = MOST_TURN;
        let mut solved = (self.lambda, self.shape.clone());
        while self.lambda != lambda {
            let turn = (lambda - self.lambda).clamp(-max_turn, max_turn);
            for (x, v) in self.shape.iter_mut().zip(&self.tangent) {
                *x += turn * v;
            }
            self.lambda = if turn.abs() < max_turn { lambda } else { self.lambda + turn };
            match self.minimise(false) {
                Ok(()) => solved = (self.lambda, self.shape.clone()),
                Err(lost) if max_turn < 0.02 * MOST_TURN => return Err(lost),
                Err(_) => {
                    (self.lambda, self.shape) = solved.clone();
                    max_turn *= 0.5;
                    // The tangent anew.
                    self.settle()?;
                }
            }
        }
        Ok(())
    }

    /// No shape was found beyond the one that was reached.
    fn fault(&self) -> HingeFault {
        HingeFault::Unsolved { r_star: self.mesh.r_star, lambda: self.lambda, residual: self.decrement }
    }

    fn value(&self, lambda: f64, shape: &[f64]) -> Option<f64> {
        value(&self.scales, &self.mesh, lambda, shape)
    }

    /// The least Pi from here, at a fixed lambda or a `free` one.
    fn minimise(&mut self, free: bool) -> Result<(), HingeFault> {
        let mut shift = 0.0;
        let mut value = self.value(self.lambda, &self.shape).ok_or_else(|| self.fault())?;
        for _ in 0..MOST_STEPS {
            let exact = self.factor(&mut shift).ok_or_else(|| self.fault())?;
            let turn = self.direction(free);
            let fall = -(dot(&self.potential.gradient, &self.step) + turn * self.potential.slope);
            self.decrement = fall.abs() / value.abs();
            let stable = exact && (!free || self.stiffness > 0.0);
            if stable && self.decrement < self.enough {
                self.advance(1.0, turn);
                return if self.enough > CONVERGED { Ok(()) } else { self.settle() };
            }
            match self.descend(value, fall, turn) {
                Some((next, part)) => {
                    value = next;
                    // A full step means that the shift was not needed; 1e-3 is negligible against the pressure's stiffness.
                    shift = if part < 1.0 {
                        shift
                    } else if shift < 1e-3 {
                        0.0
                    } else {
                        shift / 6.0
                    };
                }
                None if stable && self.decrement < ROUNDING => return self.settle(),
                None => shift = 10.0 * f64::max(shift, 0.1),
            }
            if shift > MOST_SHIFT {
                break;
            }
        }
        Err(self.fault())
    }

    /// Derivatives at the shape found, with S and its tangent; an error if it is not stable against other shapes.
    fn settle(&mut self) -> Result<(), HingeFault> {
        let exact = self.factor(&mut 0.0).ok_or_else(|| self.fault())?;
        let _ = self.direction(false);
        if self.mesh.r_star > MOST_TABLED_R_STAR {
            // S is a small difference of large numbers in a slender bend. This form errs by the square of the tangent's error.
            let curvature_terms = self.potential.hessian.times(&self.tangent);
            self.stiffness +=
                dot(&self.potential.mixed, &self.tangent) + dot(&self.tangent, &curvature_terms);
        }
        if exact { Ok(()) } else { Err(self.fault()) }
    }

    /// Factors H, whether exact and unshifted; `None` if no shift makes it positive definite.
    fn factor(&mut self, shift: &mut f64) -> Option<bool> {
        for exact in [true, false] {
            self.potential.assemble(&self.scales, &self.mesh, self.lambda, &self.shape, exact);
            self.factorisations += 1;
            if self.factors.factor(&self.potential.hessian, *shift, &self.lumped) {
                return Some(exact && *shift == 0.0);
            }
        }
        while *shift < MOST_SHIFT {
            *shift = f64::max(4.0 * *shift, 1.0);
            self.factorisations += 1;
            if self.factors.factor(&self.potential.hessian, *shift, &self.lumped) {
                return Some(false);
            }
        }
        None
    }

    /// Newton's step and tangent, and S; gives the change of lambda, 0 unless it is `free`.
    fn direction(&mut self, free: bool) -> f64 {
        set_negative(&mut self.step, &self.potential.gradient);
        set_negative(&mut self.tangent, &self.potential.mixed);
        self.factors.solve(&mut self.step);
        self.factors.solve(&mut self.tangent);
        self.stiffness = self.potential.curvature + dot(&self.potential.mixed, &self.tangent);
        if !free {
            return 0.0;
        }
        // Uphill the sign of S would lead to a maximum.
        let stiffness = if self.stiffness > 0.0 { self.stiffness } else { 0.1 - self.stiffness };
        let moment = self.potential.slope + dot(&self.potential.mixed, &self.step);
        let turn = (-moment / stiffness).clamp(-MOST_TURN, MOST_TURN);
        self.step.iter_mut().zip(&self.tangent).for_each(|(u, v)| *u += turn * v);
        turn
    }

    /// Goes the largest part of the step, halved as often as needed, that lowers Pi enough; gives Pi and the part.
    fn descend(&mut self, value: f64, fall: f64, turn: f64) -> Option<(f64, f64)> {
        let mut part = 1.0;
        while part > 1e-9 {
            for ((trial, x), step) in self.trial.iter_mut().zip(&self.shape).zip(&self.step) {
                *trial = x + part * step;
            }
            let next = self.value(self.lambda + part * turn, &self.trial);
            if let Some(next) = next
                && next <= value - ARMIJO * part * fall + 1e-15 * value.abs()
            {
                self.advance(part, turn);
                return Some((next, part));
            }
            part *= 0.5;
        }
        None
    }

    fn advance(&mut self, part: f64, turn: f64) {
        self.shape.iter_mut().zip(&self.step).for_each(|(x, step)| *x += part * step);
        self.lambda += part * turn;
    }
}

/// Lumped weights of the unknowns, which the shift multiplies. The radius is raised a little, or the nodes at a point on
/// the axis had none.
fn lumped(mesh: &MeridianMesh) -> Vec<f64> {
    let mut lumped = vec![0.0; mesh.unknowns()];
    for (number, ends) in mesh.nodes.windows(2).enumerate() {
        let h = ends[1] - ends[0];
        let weight = 0.5 * h * (mesh.r_star + 0.5 * (ends[0] + ends[1]) + 0.05);
        for (k, entry) in lumped[4 * number..4 * number + WIDTH].iter_mut().enumerate() {
            // Hermite's mass of a slope is some h^2 / 50 of that of a value.
            *entry += if k % 2 == 0 { weight } else { 0.02 * h * h * weight };
        }
    }
    lumped
}

/// An arc of length 1 that opens by `angle` (rad) to both sides; at a point on the axis it begins flat.
fn arc(mesh: &MeridianMesh, lambda: f64, angle: f64) -> Vec<f64> {
    let mut shape = Vec::with_capacity(mesh.unknowns());
    let (mut q, mut z, mut previous) = (mesh.r_star / lambda, 0.0, 0.0);
    for &s in &mesh.nodes {
        let (sin, cos) = libm::sincos(slope_angle(mesh.r_star, angle, 0.5 * (s + previous)));
        q += (s - previous) * cos;
        z += (s - previous) * sin;
        previous = s;
        let (slope, rise) = libm::sincos(slope_angle(mesh.r_star, angle, s));
        shape.extend([q, rise, z, slope]);
    }
    // Back to z = 0 at the outer rim.
    for (node, s) in shape.chunks_exact_mut(4).zip(&mesh.nodes) {
        node[2] -= z * s;
        node[3] -= z;
    }
    mesh.pinned().for_each(|pinned| shape[pinned] = 0.0);
    shape
}

/// The slope angle at `s` of an arc of length 1 that opens by `angle`.
fn slope_angle(r_star: f64, angle: f64, s: f64) -> f64 {
    let flat = if r_star == 0.0 { s / (s + 0.02) } else { 1.0 };
    angle * (1.0 - 2.0 * s) * flat
}

fn set_negative(target: &mut [f64], values: &[f64]) {
    target.iter_mut().zip(values).for_each(|(target, value)| *target = -value);
}
