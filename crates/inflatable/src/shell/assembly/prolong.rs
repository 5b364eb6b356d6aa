//! Curvature of a shape's triangles, and its prolongation to the mesh whose every triangle is cut into four: a start for Newton's method there.

use crate::shell::assembly::sheet::{Beyond, Piece, State};
use crate::shell::assembly::{Assembly, part_of_fold};
use crate::shell::element::bending;
use crate::shell::element::vector::{add_scaled, minus, times};
use crate::shell::element::{LAST, NEXT};

impl Assembly {
    /// The shape operator of each triangle of `state`: kappa_11, kappa_22, kappa_12 in the axes of the flat sheet.
    pub fn curvatures(&mut self, state: &State) -> Vec<[f64; 3]> {
        let _ = self.energy(state);
        self.sheet.pieces.iter().map(|piece| self.curvature(piece, state)).collect()
    }

    /// The shape operator of one triangle of the shape whose energy was computed last.
    fn curvature(&self, piece: &Piece, state: &State) -> [f64; 3] {
        let alpha = std::array::from_fn(|i| {
            let edge = piece.edges[i];
            let fold = if piece.beyond[i] == Beyond::Nothing { 0.0 } else { self.turning[edge] };
            part_of_fold(piece.beyond[i]) * fold + piece.lean[i] * state.leans[edge]
        });
        bending::curvature(&piece.flat, alpha)
    }

    /// `state` on the sheet `finer`, whose points are this sheet's and then the middle of each of its edges, in their order.
    ///
    /// Middles lie off the edge by its bending, l^2 kappa/8; directors start at zero.
    pub fn prolong(&mut self, state: &State, finer: &Self) -> State {
        let _ = self.energy(state);
        let mut fine = finer.sheet.flat();
        let first = state.points.len();
        fine.points[..first].copy_from_slice(&state.points);
        let mut sides = vec![0.0; self.sheet.edge_count];
        for piece in &self.sheet.pieces {
            for edge in piece.edges {
                sides[edge] += 1.0;
            }
        }
        for middle in &mut fine.points[first..] {
            *middle = [0.0; 3];
        }
        for (piece, facet) in self.sheet.pieces.iter().zip(&self.facets) {
            let kappa = self.curvature(piece, state);
            for i in 0..3 {
                let (a, b) = (piece.corners[NEXT[i]], piece.corners[LAST[i]]);
                let (flat_a, flat_b) = (self.sheet.points[a], self.sheet.points[b]);
                let run = [flat_b[0] - flat_a[0], flat_b[1] - flat_a[1]];
                let bow = (kappa[0] * run[0] * run[0]
                    + kappa[1] * run[1] * run[1]
                    + 2.0 * kappa[2] * run[0] * run[1])
                    / 8.0;
                let middle = first + piece.edges[i];
                let sagitta =
                    [0, 1].map(|c| finer.sheet.points[middle][c] - f64::midpoint(flat_a[c], flat_b[c]));
                let chord = times(0.5, minus(state.points[b], state.points[a]));
                let mut place = add_scaled(add_scaled(state.points[a], 1.0, chord), -bow, facet.normal);
                place = add_scaled(place, 1.0, [sagitta[0], sagitta[1], 0.0]);
                let part = 1.0 / sides[piece.edges[i]];
                fine.points[middle] = add_scaled(fine.points[middle], part, place);
            }
        }
        finer.hold(&mut fine);
        fine
    }
}
