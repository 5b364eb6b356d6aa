//! Angles of a triangle against its edges, with gradients and Hessians: **folds**.
//!
//! The fold of an edge is the angle by which its two triangles are raised towards each other, theta = beta + beta',
//! each triangle's own part beta growing when its far corner moves along its normal n. With the edge's direction e, its
//! length L, the direction h = n x e towards the far corner, the height H over the edge and the foot of that height at
//! the fraction tau of the edge, `b = dx_far - (1 - tau) dx_start - tau dx_end` and `d = dx_end - dx_start`:
//!
//! d beta = n.b / H and, up to a part that is antisymmetric and cancels between the two triangles (or in a mirror plane),
//! d2 beta = -2 (n.b)(h.b)/H^2 - 2 (n.d)(e.b)/(L H) - (n.d)(h.d)/L^2.
//!
//! Derived by differentiating n |e| / |n|^2 in the triangle's own frame. The gradient is that of Bridson, Marino and
//! Fedkiw, "Simulation of clothing with folds and wrinkles" (2003).

use crate::shell::element::vector::{Vector, add_scaled, cross, dot, minus, times};
use crate::shell::element::{LAST, NEXT, Square};

/// A triangle in space, in the frames of its three edges.
#[derive(Clone, Copy, Debug, Default)]
pub struct Facet {
    /// Unit normal.
    pub normal: Vector,
    /// 1/H for each edge.
    pub lift: [f64; 3],
    /// tau for each edge.
    pub foot: [f64; 3],
    /// 1/L for each edge.
    pub inverse: [f64; 3],
}

impl Facet {
    /// The triangle with these corners. Without area it has no normal, and derived values are not finite.
    pub fn new(corners: [Vector; 3]) -> Self {
        let sides: [Vector; 3] = std::array::from_fn(|i| minus(corners[LAST[i]], corners[NEXT[i]]));
        let twice = cross(sides[2], times(-1.0, sides[1]));
        let area = dot(twice, twice).sqrt();
        let squares = sides.map(|side| dot(side, side));
        let lengths = squares.map(f64::sqrt);
        Self {
            normal: times(1.0 / area, twice),
            lift: lengths.map(|length| length / area),
            foot: std::array::from_fn(|i| -dot(sides[i], sides[LAST[i]]) / squares[i]),
            inverse: lengths.map(f64::recip),
        }
    }

    /// Weights of the three corners in `b` of edge `i`.
    pub fn weights(&self, i: usize) -> [f64; 3] {
        let mut weights = [1.0; 3];
        weights[NEXT[i]] = self.foot[i] - 1.0;
        weights[LAST[i]] = -self.foot[i];
        weights
    }

    /// Adds the Hessian of the sum of `moments[i]` times beta of edge `i`.
    pub fn add_hessian(&self, corners: [Vector; 3], moments: [f64; 3], hessian: &mut Square) {
        // The change of the normal is linear in the corners, by the heights of the triangle. So the second derivative
        // is a sum of products of the normal with a vector for each pair of corners. These vectors are summed over the
        // three edges first, and multiplied out once.
        let n = self.normal;
        let mut sums = [[[0.0; 3]; 3]; 3];
        for i in 0..3 {
            let side = minus(corners[LAST[i]], corners[NEXT[i]]);
            let e = times(self.inverse[i], side);
            let h = cross(n, e);
            let weights = self.weights(i);
            let (lift, inverse) = (self.lift[i], self.inverse[i]);
            let mut ends = [0.0; 3];
            ends[NEXT[i]] = -1.0;
            ends[LAST[i]] = 1.0;
            for k in 0..3 {
                let bowed = -moments[i] * lift * lift * weights[k];
                let turned = -moments[i] * lift * inverse * ends[k];
                let twisted = -moments[i] * inverse * inverse / 2.0 * ends[k];
                for l in 0..3 {
                    let of_h = bowed * weights[l] + twisted * ends[l];
                    sums[k][l] = add_scaled(add_scaled(sums[k][l], of_h, h), turned * weights[l], e);
                }
            }
        }
        for k in 0..3 {
            for l in 0..3 {
                for c in 0..3 {
                    for d in 0..3 {
                        hessian[3 * k + c][3 * l + d] += n[c] * sums[k][l][d] + sums[l][k][c] * n[d];
                    }
                }
            }
        }
    }
}

/// The fold between a triangle with the normal `left` and its neighbour with the normal `right` across the edge with
/// the direction `edge` (any length), as it runs counterclockwise around the first.
pub fn fold(left: Vector, right: Vector, edge: Vector) -> f64 {
    let sine = dot(edge, cross(right, left)) / dot(edge, edge).sqrt();
    libm::atan2(sine, dot(left, right))
}

/// beta of a triangle with the normal `normal` at an edge in an upright mirror plane whose normal `mirror` points out
/// of the sheet: half the fold between the triangle and its image.
pub fn mirror_fold(normal: Vector, edge: Vector, mirror: Vector) -> f64 {
    let inward = cross(normal, edge);
    let length = dot(edge, edge).sqrt();
    libm::atan2(dot(normal, mirror), -dot(inward, mirror) / length)
}
