//! The area inside a closed border of lines and arcs, and a mesh of it that can be refined.

use std::collections::BTreeMap;

use crate::shell::mesh::{Border, Edge, Mesh, MeshFault, rim};
use geom::{Point, Segment};

/// A piece of a region's border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Exact curve of the piece.
    pub curve: Segment,
    /// Kind of the border.
    pub border: Border,
}

/// The area inside a closed border.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The outer border, counterclockwise, each piece beginning where the one before ends.
    pub pieces: Vec<Piece>,
    /// Holes in it, clockwise.
    pub holes: Vec<Vec<Piece>>,
    /// Pieces of welds within it, which the mesh follows. They meet each other and the border at their ends only.
    pub welds: Vec<Piece>,
}

impl Region {
    /// All its pieces, as edges of its meshes count them.
    pub(super) fn all_pieces(&self) -> impl Iterator<Item = &Piece> {
        self.pieces.iter().chain(self.holes.iter().flatten()).chain(&self.welds)
    }

    /// The exact area within the outer border.
    #[cfg(test)]
    pub fn area(&self) -> f64 {
        geom::Path::closed(self.pieces.iter().map(|piece| piece.curve).collect()).area()
    }
}

/// A mesh whose edges on borders and welds refer to their exact curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Meshed {
    /// The triangles.
    pub mesh: Mesh,
    /// The pieces of the border, of holes, and of welds.
    pub pieces: Vec<Piece>,
    /// The piece that each edge of the mesh lies on; none elsewhere within the sheet.
    pub piece_of: Vec<Option<usize>>,
    /// How many triangles are of the tube: the others, of the margin beyond its rims, come after them.
    pub tube: usize,
}

impl Meshed {
    /// The mesh of `triangles` whose edges, by their ends with the smaller index first, lie on the pieces given by `piece_at`: all of the
    /// border, and those on welds.
    ///
    /// # Errors
    /// As [`Mesh::from_triangles`].
    pub(super) fn new(
        points: Vec<[f64; 2]>,
        triangles: Vec<[usize; 3]>,
        pieces: Vec<Piece>,
        piece_at: &BTreeMap<[usize; 2], usize>,
    ) -> Result<Self, MeshFault> {
        let mut mesh =
            Mesh::from_triangles(points, triangles, |ends| Some(pieces[*piece_at.get(&ends)?].border))?;
        let piece = |edge: &Edge| piece_at.get(&edge.ends).copied();
        let piece_of: Vec<Option<usize>> = mesh.edges.iter().map(piece).collect();
        for (edge, piece) in mesh.edges.iter_mut().zip(&piece_of) {
            let border = piece.map(|piece| pieces[piece].border);
            // A weld's edge is none of the border, a rim is one though the margin lies beyond it.
            edge.border = edge.border.or(border.filter(|border| *border != Border::Rim(rim::WELD)));
        }
        let tube = mesh.triangles.len();
        Ok(Self { mesh, pieces, piece_of, tube })
    }

    /// Every triangle cut into four. New points of borders and welds lie on the exact curves, old points keep their numbers, and the point
    /// in the middle of edge `e` becomes number `points + e`.
    ///
    /// # Errors
    /// If an arc is so coarsely cut that a new point turns a triangle around.
    pub fn refined(&self) -> Result<Self, MeshFault> {
        let old = &self.mesh;
        let first = old.points.len();
        let mut points = old.points.clone();
        points.extend((0..old.edges.len()).map(|edge| self.middle(edge)));
        let mut triangles = Vec::with_capacity(4 * old.triangles.len());
        for (&[a, b, c], edges) in old.triangles.iter().zip(&old.triangle_edges) {
            let [at_a, at_b, at_c] = edges.map(|edge| first + edge);
            triangles.extend([[a, at_c, at_b], [at_c, b, at_a], [at_b, at_a, c], [at_a, at_b, at_c]]);
        }
        let mut piece_at = BTreeMap::new();
        for (edge, piece) in self.piece_of.iter().enumerate() {
            if let Some(piece) = *piece {
                // A new point has a larger number than any old one.
                piece_at.extend(old.edges[edge].ends.map(|end| ([end, first + edge], piece)));
            }
        }
        let finer = Self::new(points, triangles, self.pieces.clone(), &piece_at)?;
        Ok(Self { tube: 4 * self.tube, ..finer })
    }

    fn middle(&self, edge: usize) -> [f64; 2] {
        let [a, b] = self.mesh.edges[edge].ends.map(|end| self.mesh.points[end]);
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let Some(piece) = self.piece_of[edge] else { return middle };
        let curve = &self.pieces[piece].curve;
        let foot = curve.point(curve.nearest_fraction(Point::new(middle[0], middle[1])));
        [foot.x, foot.y]
    }
}
