//! The resistance of a wrinkled sheet to kinks between its triangles, in place of its bending.
//!
//! Triangles that give way to compression lose their height, and angles against their edges then have no limit. So the bending of such a
//! sheet is quadratic in the positions of its points: each edge has the energy |k|^2 S/2, where the kink k is the change across the edge of
//! the shape's slope at right angles to the edge, by the flat sheet. With S = l^2/(A + A') B, an edge of length l between triangles of the
//! areas A and A', the energy of equilateral triangles on a cylinder is that of a plate. (Bergou, Wardetzky, Harmon, Zorin and Grinspun,
//! "A quadratic bending model for inextensible surfaces", 2006.)

use crate::shell::element::vector::{Vector, add_scaled, dot};

/// An edge between two triangles.
#[derive(Clone, Debug)]
pub(crate) struct Kink {
    /// The ends of the edge, and the far corners on both sides.
    pub(crate) corners: [usize; 4],
    /// The root of S times k by each of them.
    weights: [f64; 4],
}

impl Kink {
    /// The kink across an edge with these corners. `slopes` are the change of each corner's hat function across the edge, at right angles to
    /// it, times its length; `stiffness` is S over the square of that length.
    pub(crate) fn new(corners: [usize; 4], slopes: [f64; 4], stiffness: f64) -> Self {
        let root = stiffness.sqrt();
        Self { corners, weights: slopes.map(|slope| root * slope) }
    }

    /// Second derivative of its energy by the same coordinate of two of its corners.
    pub(crate) fn stiffness(&self, first: usize, second: usize) -> f64 {
        self.weights[first] * self.weights[second]
    }

    /// The root of S times k.
    fn root(&self, shape: &[Vector]) -> Vector {
        let points = self.corners.iter().zip(self.weights);
        points.fold([0.0; 3], |sum, (corner, weight)| add_scaled(sum, weight, shape[*corner]))
    }

    pub(crate) fn energy(&self, shape: &[Vector]) -> f64 {
        let kink = self.root(shape);
        dot(kink, kink) / 2.0
    }

    pub(crate) fn add_forces(&self, shape: &[Vector], forces: &mut [Vector]) {
        let kink = self.root(shape);
        for (corner, weight) in self.corners.iter().zip(self.weights) {
            forces[*corner] = add_scaled(forces[*corner], weight, kink);
        }
    }
}
