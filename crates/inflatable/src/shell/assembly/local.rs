//! The Hessian of one triangle's energy by the 21 unknowns that it couples.

use crate::shell::assembly::numbering::LOCAL;
use crate::shell::assembly::sheet::{Beyond, Piece, Sheet};
use crate::shell::assembly::supports::Supports;
use crate::shell::element::fold::Facet;
use crate::shell::element::vector::{Vector, dot, times};
use crate::shell::element::{LAST, NEXT, Square, volume};

/// Second derivatives by a triangle's unknowns; its lower triangle is filled.
pub(crate) type Local = [[f64; LOCAL]; LOCAL];

/// First derivatives of a triangle's three alpha.
struct Slopes {
    /// By its own corners.
    own: [[f64; 9]; 3],
    /// By the far corner beyond the edge.
    far: [Vector; 3],
}

impl Slopes {
    fn new(piece: &Piece, facet: &Facet, facets: &[Facet]) -> Self {
        let mut slopes = Self { own: [[0.0; 9]; 3], far: [[0.0; 3]; 3] };
        for i in 0..3 {
            let part = match piece.beyond[i] {
                Beyond::Nothing => continue,
                Beyond::Image(_) => 1.0,
                Beyond::Neighbour { .. } => 0.5,
            };
            let weights = facet.weights(i);
            for (k, weight) in weights.into_iter().enumerate() {
                let slope = times(part * facet.lift[i] * weight, facet.normal);
                slopes.own[i][3 * k..3 * k + 3].copy_from_slice(&slope);
            }
            if let Beyond::Neighbour { triangle, edge, .. } = piece.beyond[i] {
                let other = &facets[triangle];
                slopes.far[i] = times(0.5 * other.lift[edge], other.normal);
                // The neighbour runs through the edge the other way round.
                for (k, weight) in [(LAST[i], other.foot[edge] - 1.0), (NEXT[i], -other.foot[edge])] {
                    for c in 0..3 {
                        slopes.own[i][3 * k + c] += weight * slopes.far[i][c];
                    }
                }
            }
        }
        slopes
    }

    /// Turns the derivatives into the axes in which the points move.
    fn turn(&mut self, piece: &Piece, supports: &Supports) {
        for i in 0..3 {
            for k in 0..3 {
                let slope = [0, 1, 2].map(|c| self.own[i][3 * k + c]);
                let turned = supports.holds[piece.corners[k]].axes.map(|axis| dot(axis, slope));
                self.own[i][3 * k..3 * k + 3].copy_from_slice(&turned);
            }
            if let Beyond::Neighbour { corner, .. } = piece.beyond[i] {
                self.far[i] = supports.holds[corner].axes.map(|axis| dot(axis, self.far[i]));
            }
        }
    }
}

/// Energy of a triangle by its own corners alone: membrane, pressure, and the moments `turning` on its folds.
fn of_corners(sheet: &Sheet, piece: &Piece, x: [Vector; 3], facet: &Facet, loads: Loads) -> Square {
    let mut hessian = [[0.0; 9]; 9];
    let membrane = sheet.membrane(piece, x);
    let (strain, stress) = membrane.rows(sheet.fabric, &piece.flat);
    for a in 0..9 {
        for b in 0..9 {
            hessian[a][b] =
                strain[0][a] * stress[0][b] + strain[1][a] * stress[1][b] + strain[2][a] * stress[2][b];
        }
    }
    let resisting = match loads.tangent {
        Tangent::Exact => membrane,
        Tangent::Tensile => membrane.tensile(),
    };
    resisting.add_geometric(&piece.flat, &mut hessian);
    volume::add_hessian(x, -loads.pressure, &mut hessian);
    if piece.bends {
        facet.add_hessian(x, loads.turning, &mut hessian);
    }
    hessian
}

/// A Hessian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tangent {
    /// The energy's.
    Exact,
    /// The derivatives as if compressive stresses did not make the sheet buckle.
    Tensile,
}

/// Loads on a triangle.
#[derive(Clone, Copy)]
pub(crate) struct Loads {
    pub(crate) pressure: f64,
    /// Moments on the folds of its edges, this triangle's and its neighbours'.
    pub(crate) turning: [f64; 3],
    /// Whether one of its unknowns is along an axis other than those of space.
    pub(crate) turned: bool,
    pub(crate) tangent: Tangent,
}

/// Fills the lower triangle of `local`.
pub(crate) fn fill(
    (sheet, supports): (&Sheet, &Supports),
    piece: &Piece,
    points: &[Vector],
    (facet, facets): (&Facet, &[Facet]),
    loads: Loads,
    local: &mut Local,
) {
    // The first nine unknowns are the triangle's own corners, the next nine the corners beyond its sides, and the last
    // three the leans of its sides. A fold couples all of them through the bending stiffness k, so each block is a
    // product of slopes with k. Where two sides share the corner beyond, its pair is counted for both orders.
    let mut corners = of_corners(sheet, piece, piece.corners.map(|corner| points[corner]), facet, loads);
    let mut slopes = Slopes::new(piece, facet, facets);
    if loads.turned {
        turn(&mut corners, piece, supports);
        slopes.turn(piece, supports);
    }
    let Slopes { own: rows, far: by_neighbours } = &slopes;
    let k = &piece.stiffness;
    let mut answers = [[0.0; 9]; 3];
    for i in 0..3 {
        for a in 0..9 {
            answers[i][a] = k[i][0] * rows[0][a] + k[i][1] * rows[1][a] + k[i][2] * rows[2][a];
        }
    }
    for a in 0..9 {
        for b in 0..9 {
            local[a][b] = corners[a][b]
                + rows[0][a] * answers[0][b]
                + rows[1][a] * answers[1][b]
                + rows[2][a] * answers[2][b];
        }
    }
    for i in 0..3 {
        let lean = piece.lean[i];
        for b in 0..9 {
            for c in 0..3 {
                local[9 + 3 * i + c][b] = by_neighbours[i][c] * answers[i][b];
            }
            local[18 + i][b] = lean * answers[i][b];
        }
        for j in 0..3 {
            for d in 0..3 {
                let answer = k[i][j] * by_neighbours[j][d];
                for c in 0..3 {
                    local[9 + 3 * i + c][9 + 3 * j + d] = by_neighbours[i][c] * answer;
                }
                local[18 + i][9 + 3 * j + d] = lean * answer;
            }
            local[18 + i][18 + j] = lean * k[i][j] * piece.lean[j];
        }
    }
    for i in (0..3).filter(|&i| piece.twins[i]) {
        let (a, b) = (NEXT[i].max(LAST[i]), NEXT[i].min(LAST[i]));
        for c in 0..3 {
            local[9 + 3 * a + c][9 + 3 * b + c] *= 2.0; // one unknown twice: the pair counts for both orders
        }
    }
}

/// `hessian` in the axes in which the points move.
fn turn(hessian: &mut Square, piece: &Piece, supports: &Supports) {
    let axes = piece.corners.map(|corner| supports.holds[corner].axes);
    for row in hessian.iter_mut() {
        for k in 0..3 {
            let part = [row[3 * k], row[3 * k + 1], row[3 * k + 2]];
            for c in 0..3 {
                row[3 * k + c] = dot(axes[k][c], part);
            }
        }
    }
    for (rows, axes) in hessian.chunks_exact_mut(3).zip(axes) {
        for b in 0..9 {
            let part = [rows[0][b], rows[1][b], rows[2][b]];
            rows.iter_mut().zip(axes).for_each(|(row, axis)| row[b] = dot(axis, part));
        }
    }
}
