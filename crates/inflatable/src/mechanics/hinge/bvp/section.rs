//! The penalised section as a boundary-value problem in regular variables.
//!
//! `2 lambda ∫ [Q z cos(phi) - exp(beta (u - d))] ds` is to be largest, with `u = lambda r - s` and
//! `Q = (R* + s + u) / lambda`. In the meridional tension T its equations divide by no quantity that vanishes:
//!
//! ```text
//! T' = h cos(phi)     phi' = -(Q + h sin(phi)) / T     u' = lambda cos(phi) - 1     z' = sin(phi)
//! h = lambda beta exp(beta (u - d))
//! u(0) = z(0) = z(1) = 0     phi(1) = -pi/2
//! ```
//!
//! The **offset** d is 0 in the paper's problem. A large one moves the penalty's wall away, so
//! that the free section solves the problem; the continuation starts there.

use crate::numerics::Dual;
use crate::numerics::collocation::Problem;
use std::f64::consts::FRAC_PI_2;

/// The problem at given parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct PenalisedSection {
    pub(super) r_star: f64,
    pub(super) lambda: f64,
    pub(super) beta: f64,
    pub(super) offset: f64,
}

/// Places of the components.
pub(super) const TENSION: usize = 0;
pub(super) const PHI: usize = 1;
pub(super) const U: usize = 2;

/// Steeper than this the penalty cannot be part of a solution: a wild Newton step is refused before it overflows.
const MOST_EXPONENT: f64 = 60.0;

impl PenalisedSection {
    /// Distance Q to the axis.
    fn axis(&self, s: f64, u: f64) -> f64 {
        (self.r_star + s + u) / self.lambda
    }

    /// Hoop tension h; infinite where it makes no sense.
    fn hoop(&self, u: f64) -> f64 {
        let exponent = self.beta * (u - self.offset);
        if exponent > MOST_EXPONENT { f64::INFINITY } else { self.lambda * self.beta * libm::exp(exponent) }
    }

    /// The right-hand side's derivative with respect to lambda.
    pub(super) fn by_lambda(&self, s: f64, y: &[f64; 4]) -> [f64; 4] {
        let [tension, phi, u, _] = *y;
        let (sin, cos) = libm::sincos(phi);
        let (hoop, axis) = (self.hoop(u), self.axis(s, u));
        [hoop / self.lambda * cos, (axis - hoop * sin) / (self.lambda * tension), cos, 0.0]
    }

    /// Integrand of the penalised volume.
    pub(super) fn volume_density(&self, s: f64, y: &[f64; 4]) -> f64 {
        self.plain_density(s, y) - 2.0 * self.hoop(y[U]) / self.beta
    }

    /// Integrand of the volume itself.
    pub(super) fn plain_density(&self, s: f64, y: &[f64; 4]) -> f64 {
        let [_, phi, u, z] = *y;
        2.0 * (self.r_star + s + u) * z * libm::cos(phi)
    }

    /// Integrand of the penalised volume's derivative by lambda (envelope theorem), with its own
    /// derivative along `change`, the change of y with lambda.
    pub(super) fn slope_density(&self, s: f64, y: &[f64; 4], change: &[f64; 4]) -> Dual<1> {
        let lambda = Dual { value: self.lambda, slope: [1.0] };
        let [phi, u, z] = [1, 2, 3].map(|k| Dual { value: y[k], slope: [change[k]] });
        let (_, cos) = phi.sin_cos();
        let reach = (u + s) / lambda;
        let penalty = libm::exp(self.beta * (y[2] - self.offset));
        let penalty = u.chain(penalty, self.beta * penalty);
        (reach * z * cos - penalty - lambda * penalty * reach * self.beta) * 2.0
    }
}

impl Problem<4> for PenalisedSection {
    fn slope(&self, s: f64, y: &[f64; 4]) -> [f64; 4] {
        let [tension, phi, u, _] = *y;
        let (sin, cos) = libm::sincos(phi);
        let hoop = self.hoop(u);
        // Without tension there is no section: a Newton step that leads there is refused.
        let tension = if tension > 0.0 { tension } else { f64::NAN };
        [hoop * cos, -(self.axis(s, u) + hoop * sin) / tension, self.lambda * cos - 1.0, sin]
    }

    fn jacobian(&self, s: f64, y: &[f64; 4]) -> [[f64; 4]; 4] {
        let [tension, phi, u, _] = *y;
        let (sin, cos) = libm::sincos(phi);
        let hoop = self.hoop(u);
        let turn = (self.axis(s, u) + hoop * sin) / tension;
        let steep = self.beta * hoop;
        [
            [0.0, -hoop * sin, steep * cos, 0.0],
            [turn / tension, -hoop * cos / tension, -(1.0 / self.lambda + steep * sin) / tension, 0.0],
            [0.0, -self.lambda * sin, 0.0, 0.0],
            [0.0, cos, 0.0, 0.0],
        ]
    }

    fn values_at_left(&self) -> &[(usize, f64)] {
        &[(2, 0.0), (3, 0.0)]
    }

    fn right(&self) -> &[(usize, f64)] {
        &[(1, -FRAC_PI_2), (3, 0.0)]
    }
}
