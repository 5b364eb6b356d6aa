//! The length of a star's arms, before the star is checked.

use std::f64::consts::PI;

use crate::spec::StarSpec;

/// Arm length l of the star that `spec` describes with `n` points, mm; it may come out negative.
///
/// `(rho_0 + W + R_e) sin(pi/n) = l sin(phi_i0/2) + (W + R_i + R_e) cos(phi_i0/2)`: Andrade-Silva and
/// Marthelot, supplement, Eq. for l, which is the case R_i = R_e = 0.
pub fn arm_length(spec: &StarSpec, n: u32) -> f64 {
    let (sin, cos) = libm::sincos(spec.tip_angle.rad() / 2.0);
    let (w, r_i, r_e) = (spec.tube_width.0, spec.tip_radius.0, spec.corner_radius.0);
    ((spec.inner_radius.0 + w + r_e) * libm::sin(PI / f64::from(n)) - (w + r_i + r_e) * cos) / sin
}
