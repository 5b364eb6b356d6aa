//! The paper's method: the hoop inequality as a penalty `exp(beta u)`, solved by collocation.
//!
//! The potential of this model is the penalised volume, `V_bar - 2 lambda ∫ exp(beta u) ds`. The equations make
//! it stationary, so its derivative is the moment (envelope theorem) and its second
//! derivative takes one linear solution. The bare volume is larger by the penalty, which is of order 1/beta.
//!
//! As beta grows the model tends to the exact ring, by about 1/beta in V_bar where the section is free and
//! ln(beta)/beta where there is hoop tension. The inner rim becomes a layer of width 1/beta in which phi
//! swings from almost pi to the ring's `phi_0`; the edge is therefore read off just outside of that layer.
//! It is solved up to beta = 1e6, far beyond the paper's 1000; further on rounding limits the residual.

mod path;
mod section;
#[cfg(test)]
mod tests;
mod volume;

use self::path::{End, follow};
use self::section::{PHI, PenalisedSection, TENSION, U};
use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::{
    Edges, HingeEffort, HingeModel, HingeState, Level, check_lambda, check_r_star,
};
use crate::numerics::collocation::CollocationFault;

/// Largest R*: beyond, the differences between sections are lost in the size of V_bar.
pub const MOST_R_STAR: f64 = 1e3;
/// Least lambda: below, the hinge is opened beyond its flat angle.
pub const LEAST_LAMBDA: f64 = 0.8;
/// Largest lambda: the tests cover it for every R* in range.
pub const MOST_LAMBDA: f64 = 3.0;
/// Smallest beta: at 10 the penalty turns sharp hinges inside out, and there is no section any more.
pub const LEAST_BETA: f64 = 50.0;
/// Largest beta: it converges here for every R* up to 100. Where beta R* exceeds some 1e8, the rounding of u,
/// relative to R* and multiplied by beta, keeps the residual above 1e-6, and the section is refused as unsolved.
pub const MOST_BETA: f64 = 1e6;

/// The penalised boundary-value problem at one beta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bvp {
    beta: f64,
    tolerance: f64,
}

impl Default for Bvp {
    /// The paper's beta, 1000, solved to a relative residual of 1e-6.
    fn default() -> Self {
        Self { beta: 1000.0, tolerance: 1e-6 }
    }
}

/// `value` brought into a range; NaN becomes the `minimum`.
fn limited(value: f64, minimum: f64, maximum: f64) -> f64 {
    if value > minimum { value.min(maximum) } else { minimum }
}

impl Bvp {
    /// The problem at `beta`, from [`LEAST_BETA`] to [`MOST_BETA`], solved to the relative residual
    /// `tolerance`, from 1e-7 to 1e-2. Values outside are brought to the nearest allowed one.
    pub fn new(beta: f64, tolerance: f64) -> Self {
        Self { beta: limited(beta, LEAST_BETA, MOST_BETA), tolerance: limited(tolerance, 1e-7, 1e-2) }
    }

    /// The penalty's steepness beta.
    pub fn beta(&self) -> f64 {
        self.beta
    }

    /// The volume without the penalty, in units of W^3 (pi - phi_0): the paper's V.
    ///
    /// # Errors
    /// The errors of [`HingeModel::state`].
    pub fn bare_volume(&self, r_star: f64, lambda: f64) -> Result<f64, HingeFault> {
        let end = self.solve(r_star, lambda)?;
        Ok(end.solution.profile.integral(&end.section, |s, y| end.section.plain_density(s, y)))
    }

    fn solve(&self, r_star: f64, lambda: f64) -> Result<End, HingeFault> {
        check_r_star(r_star, MOST_R_STAR)?;
        check_lambda(lambda, LEAST_LAMBDA, MOST_LAMBDA)?;
        follow(r_star, lambda, self.beta, self.tolerance).map_err(|fault| {
            let residual =
                if let CollocationFault::TooFine { residual } = fault { residual } else { f64::MAX };
            HingeFault::Unsolved { r_star, lambda, residual }
        })
    }
}

impl HingeModel for Bvp {
    fn level(&self) -> Level {
        Level::Bvp
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        let end = self.solve(r_star, lambda)?;
        let slopes = volume::slopes(&end.section, &end.solution);
        let volume = end.solution.profile.integral(&end.section, |s, y| end.section.volume_density(s, y));
        Ok(HingeState {
            lambda,
            volume: Some(volume),
            slope: slopes.value,
            curvature: slopes.slope[0],
            edges: Some(edges(&end)),
            effort: HingeEffort {
                residual: end.solution.residual,
                iterations: end.iterations,
                // Measured: the error of V_bar and V_bar' is a hundredth of the residual at most.
                error: 0.01 * self.tolerance,
            },
        })
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        // For every R* and beta the target lies between 1.1 and 1.4, where V_bar' falls.
        let (mut low, mut high) = (1.1, 1.4);
        let mut state = self.state(r_star, 1.3)?;
        for _ in 0..30 {
            *(if state.slope > 0.0 { &mut low } else { &mut high }) = state.lambda;
            let newton = state.lambda - state.slope / state.curvature;
            let is_bracketed = newton > low && newton < high && state.curvature < 0.0;
            let next = if is_bracketed { newton } else { 0.5 * (low + high) };
            // Beyond this the residual, not lambda, limits the accuracy.
            if (next - state.lambda).abs() < 1e-3 * self.tolerance {
                break;
            }
            state = self.state(r_star, next)?;
        }
        Ok(state)
    }
}

/// The edges, the inner one at the end of the rim's layer: where the hoop tension has fallen below 1 % of the pressure.
fn edges(end: &End) -> Edges {
    let PenalisedSection { lambda, beta, .. } = end.section;
    let values = &end.solution.profile.values;
    let free = -libm::log(100.0 * lambda * beta) / beta;
    let first_outside = values.iter().position(|y| y[U] < free).unwrap_or(0);
    let [tension, angle] = [TENSION, PHI].map(|k| values[first_outside][k]);
    Edges {
        tension,
        angle,
        width: (1.0 + values[values.len() - 1][U]) / lambda,
        rim_force: 2.0 * tension * libm::cos(angle),
    }
}
