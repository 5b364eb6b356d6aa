//! A triangle's bending by directors at the middles of its edges (a triangle of Morley's kind).
//!
//! The shape operator is kappa = sum (l_i/A) alpha_i nu_i (x) nu_i over its edges, with the flat length l_i, the flat
//! area A and the unit normal nu_i of the edge in the flat plane: the divergence theorem for the sheet's normal, which
//! turns by alpha_i from the triangle to the director on edge `i`. alpha_i = theta_i/2 +- xi_i: half the fold, and one
//! unknown an edge that lets the director lean to either side. Grinspun, Gingold, Reisman and Zorin, "Computing discrete
//! shape operators on general meshes" (2006).

use crate::shell::element::membrane::Flat;
use crate::shell::element::{Fabric, weave};

/// K of a triangle: its bending energy is alpha^T K alpha / 2 = A (B/2) [(1 - nu) tr kappa^2 + nu (tr kappa)^2], plus the contribution of a
/// weave.
pub fn stiffness(fabric: Fabric, flat: &Flat) -> [[f64; 3]; 3] {
    // The slope of corner i's linear function is -nu_i l_i / (2 A).
    let slopes = flat.slopes;
    let nu = fabric.poisson;
    let mut stiffness = slopes.map(|first| {
        slopes.map(|second| {
            let product = first[0] * second[0] + first[1] * second[1];
            let lengths = libm::hypot(first[0], first[1]) * libm::hypot(second[0], second[1]);
            let cosine = product / lengths;
            fabric.bending * flat.area * 4.0 * lengths * ((1.0 - nu) * cosine * cosine + nu)
        })
    });
    if let Some(added) = weave::bending(fabric) {
        // kappa_11, kappa_22, 2 kappa_12 by alpha of each edge.
        let by_edge: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let mut alpha = [0.0; 3];
            alpha[i] = 1.0;
            let [k11, k22, k12] = curvature(flat, alpha);
            [k11, k22, 2.0 * k12]
        });
        for (row, a) in stiffness.iter_mut().zip(&by_edge) {
            for (entry, b) in row.iter_mut().zip(&by_edge) {
                for i in 0..3 {
                    *entry += flat.area * a[i] * (0..3).map(|j| added[i][j] * b[j]).sum::<f64>();
                }
            }
        }
    }
    stiffness
}

/// The shape operator's components kappa_11, kappa_22, kappa_12 in the axes of the flat sheet.
pub fn curvature(flat: &Flat, alpha: [f64; 3]) -> [f64; 3] {
    let mut kappa = [0.0; 3];
    for (slope, alpha) in flat.slopes.iter().zip(alpha) {
        let factor = 2.0 * alpha / libm::hypot(slope[0], slope[1]);
        kappa[0] += factor * slope[0] * slope[0];
        kappa[1] += factor * slope[1] * slope[1];
        kappa[2] += factor * slope[0] * slope[1];
    }
    kappa
}
