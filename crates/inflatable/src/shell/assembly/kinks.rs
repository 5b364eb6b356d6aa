//! The resistance of a wrinkled sheet to kinks between its triangles, in place of its bending.
//!
//! Triangles that give way to compression lose their height, and angles against their edges then have no limit. So the bending of such a
//! sheet is quadratic in the positions of its points: each edge has the energy |k|^2 S/2, where the kink k is the change across the edge of
//! the shape's slope at right angles to the edge, by the flat sheet. With S = l^2/(A + A') B, an edge of length l between triangles of the
//! areas A and A', the energy of equilateral triangles on a cylinder is that of a plate. (Bergou, Wardetzky, Harmon, Zorin and Grinspun,
//! "A quadratic bending model for inextensible surfaces", 2006.)

use crate::shell::assembly::Assembly;
use crate::shell::assembly::State;
use crate::shell::assembly::numbering::{KINK, NONE, Numbering, Pattern};
use crate::shell::assembly::sheet::{Beyond, Piece};
use crate::shell::element::vector::{Vector, along, dot};
use crate::shell::element::{LAST, NEXT};

/// An edge between two triangles.
#[derive(Clone, Debug)]
pub(crate) struct Kink {
    /// The ends of the edge, and the far corners on both sides.
    pub(crate) corners: [usize; 4],
    /// The root of S times k by each of them.
    weights: [f64; 4],
}

impl Kink {
    /// The kinks across the edges that `pieces` share. The bending stiffness is that of the fabric, but at least `least` times the square of
    /// the edge's length.
    pub(crate) fn all(pieces: &[Piece], points: &[[f64; 2]], bending: f64, least: f64) -> Vec<Self> {
        let mut kinks = Vec::new();
        for (t, piece) in pieces.iter().enumerate() {
            for i in 0..3 {
                let Beyond::Neighbour { triangle, edge, .. } = piece.beyond[i] else { continue };
                if triangle < t {
                    continue;
                }
                let other = &pieces[triangle];
                let (start, end) = (piece.corners[NEXT[i]], piece.corners[LAST[i]]);
                let side = [points[end][0] - points[start][0], points[end][1] - points[start][1]];
                let square = side[0] * side[0] + side[1] * side[1];
                // The slope of a hat function at right angles to the edge, times the edge's length.
                let across = |slope: [f64; 2]| slope[0] * side[1] - slope[1] * side[0];
                let stiffness = bending.max(least * square) / (piece.flat.area + other.flat.area);
                let root = stiffness.sqrt();
                // The other triangle runs through the edge the other way round.
                let weights = [
                    across(piece.flat.slopes[NEXT[i]]) - across(other.flat.slopes[LAST[edge]]),
                    across(piece.flat.slopes[LAST[i]]) - across(other.flat.slopes[NEXT[edge]]),
                    across(piece.flat.slopes[i]),
                    -across(other.flat.slopes[edge]),
                ];
                kinks.push(Self {
                    corners: [start, end, piece.corners[i], other.corners[edge]],
                    weights: weights.map(|weight| root * weight),
                });
            }
        }
        kinks
    }

    /// The root of S times k.
    fn of(&self, state: &State) -> Vector {
        let points = self.corners.iter().zip(self.weights);
        points.fold([0.0; 3], |sum, (corner, weight)| along(sum, weight, state.points[*corner]))
    }

    pub(crate) fn energy(&self, state: &State) -> f64 {
        let kink = self.of(state);
        dot(kink, kink) / 2.0
    }

    pub(crate) fn add_forces(&self, state: &State, forces: &mut [Vector]) {
        let kink = self.of(state);
        for (corner, weight) in self.corners.iter().zip(self.weights) {
            forces[*corner] = along(forces[*corner], weight, kink);
        }
    }

    /// Its unknowns: three of each corner.
    pub(crate) fn unknowns(&self, numbering: &Numbering) -> [u32; KINK] {
        let mut local = [NONE; KINK];
        for (numbers, corner) in local.chunks_exact_mut(3).zip(self.corners) {
            numbers.copy_from_slice(&numbering.points[corner]);
        }
        local
    }
}

impl Assembly {
    /// Adds the kinks' part to the Hessian.
    pub(super) fn add_kinks(&mut self) {
        let Pattern { kinks: places, .. } = &self.pattern;
        for (kink, places) in self.sheet.kinks.iter().zip(places) {
            let axes = kink.corners.map(|corner| self.supports.holds[corner].axes);
            let mut places = places.iter();
            for a in 0..KINK {
                for b in 0..=a {
                    let product = kink.weights[a / 3] * kink.weights[b / 3];
                    if let Some(place) = places.next() {
                        self.values[*place as usize] += product * dot(axes[a / 3][a % 3], axes[b / 3][b % 3]);
                    }
                }
            }
        }
    }
}
