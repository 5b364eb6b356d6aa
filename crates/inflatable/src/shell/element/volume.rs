//! The volume between a triangle and the plane z = 0, signed: mean height times projected area.

use crate::shell::element::vector::Vector;
use crate::shell::element::{LAST, NEXT, Square};

/// Twice the projected area.
fn projected(x: [Vector; 3]) -> f64 {
    (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1])
}

/// The area of the triangle with these corners in plan view, signed.
pub fn projected_area(corners: [Vector; 3]) -> f64 {
    projected(corners) / 2.0
}

/// The volume below the triangle with these corners.
pub fn volume(corners: [Vector; 3]) -> f64 {
    (corners[0][2] + corners[1][2] + corners[2][2]) * projected(corners) / 6.0
}

/// Adds `factor` times its gradient.
pub fn add_gradient(corners: [Vector; 3], factor: f64, gradient: &mut [f64; 9]) {
    let height = factor * (corners[0][2] + corners[1][2] + corners[2][2]) / 6.0;
    let area = factor * projected(corners) / 6.0;
    for k in 0..3 {
        let (next, last) = (corners[NEXT[k]], corners[LAST[k]]);
        gradient[3 * k] += height * (next[1] - last[1]);
        gradient[3 * k + 1] += height * (last[0] - next[0]);
        gradient[3 * k + 2] += area;
    }
}

/// Adds `factor` times its Hessian.
pub fn add_hessian(corners: [Vector; 3], factor: f64, hessian: &mut Square) {
    let sixth = factor / 6.0;
    let height = sixth * (corners[0][2] + corners[1][2] + corners[2][2]);
    for k in 0..3 {
        let (next, last) = (corners[NEXT[k]], corners[LAST[k]]);
        let slope = [sixth * (next[1] - last[1]), sixth * (last[0] - next[0])];
        for l in 0..3 {
            for c in 0..2 {
                hessian[3 * k + c][3 * l + 2] += slope[c];
                hessian[3 * l + 2][3 * k + c] += slope[c];
            }
        }
        for (l, sign) in [(NEXT[k], 1.0), (LAST[k], -1.0)] {
            hessian[3 * k][3 * l + 1] += sign * height;
            hessian[3 * l + 1][3 * k] += sign * height;
        }
    }
}
