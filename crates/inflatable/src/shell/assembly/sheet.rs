//! A mesh as the sums over its triangles see it: everything that no solve changes.

use crate::shell::assembly::kinks::Kink;
use crate::shell::element::bending;
use crate::shell::element::membrane::{Flat, Membrane};
use crate::shell::element::vector::Vector;
use crate::shell::element::{Fabric, LAST, NEXT};
use crate::shell::mesh::{Border, Mesh};

/// The far side of an edge of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Beyond {
    /// The neighbour, which of its edges it is, and the neighbour's far corner.
    Neighbour { triangle: usize, edge: usize, corner: usize },
    /// The triangle's own image in this plane.
    Image(usize),
    /// No triangle and no support: the director there is free.
    Nothing,
}

/// A triangle of the sheet.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub(crate) corners: [usize; 3],
    pub(crate) edges: [usize; 3],
    pub(crate) beyond: [Beyond; 3],
    /// With which sign xi of each edge enters alpha; 0 in a mirror plane.
    pub(crate) lean: [f64; 3],
    pub(crate) flat: Flat,
    pub(crate) stiffness: [[f64; 3]; 3],
    /// Pairs of edges across which the same corner lies: around a point with only three triangles.
    pub(crate) twins: [bool; 3],
    /// How it bears compression, if otherwise than the sheet: on the margin, and in chambers without pressure.
    pub(crate) law: Option<Compression>,
    /// The part of the tube's pressure that acts on it: 1, less in a chamber of lower pressure, 0 on the margin.
    pub(crate) load: f64,
    /// Whether it and its neighbours resist being turned against each other.
    pub(crate) bends: bool,
}

impl Piece {
    /// Takes its bending from it.
    fn flatten(&mut self) {
        (self.beyond, self.lean) = ([Beyond::Nothing; 3], [0.0; 3]);
        (self.stiffness, self.twins) = ([[0.0; 3]; 3], [false; 3]);
        self.bends = false;
    }
}

/// A flat sheet of fabric, ready to be inflated.
#[derive(Clone, Debug)]
pub struct Sheet {
    pub(crate) fabric: Fabric,
    pub(crate) pieces: Vec<Piece>,
    /// Flat positions.
    pub(crate) points: Vec<[f64; 2]>,
    /// A third of the flat area of the triangles around each point.
    pub(crate) areas: Vec<f64>,
    pub(crate) edge_count: usize,
    /// Points, then edges, in an order in which little fills in as they are eliminated.
    pub(crate) order: Vec<usize>,
    /// Response to compression within its plane.
    pub(crate) compression: Compression,
    /// The edges whose kinks stand for the bending of a wrinkled sheet.
    pub(crate) kinks: Vec<Kink>,
}

/// Response of a sheet to compression within its plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Compression {
    /// It responds as to tension, until it buckles in wrinkles that the mesh must resolve.
    #[default]
    Elastic,
    /// Almost none: it buckles in wrinkles that are too fine for the mesh, and the shape is their mean. The value is the part of its
    /// stiffness that it keeps.
    Wrinkled(f64),
}

impl Sheet {
    /// Takes a mesh and its fabric.
    pub fn new(mesh: &Mesh, fabric: Fabric) -> Self {
        let pieces: Vec<Piece> = (0..mesh.triangles.len()).map(|t| piece(mesh, fabric, t)).collect();
        Self {
            fabric,
            areas: areas(mesh.points.len(), &pieces),
            pieces,
            points: mesh.points.clone(),
            edge_count: mesh.edges.len(),
            order: mesh.elimination_order(),
            compression: Compression::Elastic,
            kinks: Vec::new(),
        }
    }

    /// The stretched triangle `piece` with its corners at `corners`.
    pub(crate) fn membrane(&self, piece: &Piece, corners: [Vector; 3]) -> Membrane {
        match piece.law.unwrap_or(self.compression) {
            Compression::Elastic => Membrane::new(self.fabric, &piece.flat, corners),
            Compression::Wrinkled(left) => Membrane::wrinkled(self.fabric, &piece.flat, corners, left),
        }
    }

    /// One of its triangles with its corners at `corners`.
    pub(crate) fn stretched(&self, triangle: usize, corners: [Vector; 3]) -> Membrane {
        self.membrane(&self.pieces[triangle], corners)
    }

    /// Lets the triangles on both sides of `edge` turn freely there, as at a rim: the director of each takes the angle that costs least,
    /// which is no unknown.
    pub fn release(&mut self, edge: usize) {
        for piece in self.pieces.iter_mut().filter(|piece| piece.edges.contains(&edge)) {
            for i in (0..3).filter(|i| piece.edges[*i] == edge) {
                let k = piece.stiffness;
                if k[i][i] > 0.0 {
                    piece.stiffness = std::array::from_fn(|a| {
                        std::array::from_fn(|b| k[a][b] - k[a][i] * k[i][b] / k[i][i])
                    });
                }
                for j in 0..3 {
                    (piece.stiffness[i][j], piece.stiffness[j][i]) = (0.0, 0.0);
                }
                (piece.beyond[i], piece.lean[i]) = (Beyond::Nothing, 0.0);
            }
            piece.twins = twins(&piece.beyond);
        }
    }

    /// Lets the sheet give way to compression in fine wrinkles; `remaining_stiffness` is the part of its stiffness against it that remains. Kinks across
    /// edges that are not released stand for its bending, with at least `least_bending` times the square of an edge's length as stiffness.
    pub fn wrinkle(&mut self, remaining_stiffness: f64, least_bending: f64) {
        self.compression = Compression::Wrinkled(remaining_stiffness);
        self.kinks = self.kinks_with(least_bending);
        self.pieces.iter_mut().for_each(Piece::flatten);
    }

    /// The kinks across the edges that two triangles share and that are not released. The bending stiffness is that of the fabric, but at
    /// least `least_bending` times the square of the edge's length.
    fn kinks_with(&self, least_bending: f64) -> Vec<Kink> {
        let mut kinks = Vec::new();
        for (t, piece) in self.pieces.iter().enumerate() {
            for i in 0..3 {
                let Beyond::Neighbour { triangle, edge, .. } = piece.beyond[i] else { continue };
                if triangle < t {
                    continue;
                }
                let other = &self.pieces[triangle];
                let (start, end) = (piece.corners[NEXT[i]], piece.corners[LAST[i]]);
                let side = [0, 1].map(|c| self.points[end][c] - self.points[start][c]);
                let square = side[0] * side[0] + side[1] * side[1];
                // The other triangle runs through the edge the other way round.
                let slopes = [
                    cross_product(piece.flat.slopes[NEXT[i]], side)
                        - cross_product(other.flat.slopes[LAST[edge]], side),
                    cross_product(piece.flat.slopes[LAST[i]], side)
                        - cross_product(other.flat.slopes[NEXT[edge]], side),
                    cross_product(piece.flat.slopes[i], side),
                    -cross_product(other.flat.slopes[edge], side),
                ];
                let corners = [start, end, piece.corners[i], other.corners[edge]];
                let area = piece.flat.area + other.flat.area;
                kinks.push(Kink::new(
                    corners,
                    slopes,
                    self.fabric.bending.max(least_bending * square) / area,
                ));
            }
        }
        kinks
    }

    /// Makes the triangles from number `first` on a margin that stays in the plane of the rims, in which it bears compression as `law` says.
    ///
    /// Both sheets lie in the margin, and one of them belongs to the modelled half of the tube: per area it has the membrane energy of any
    /// other triangle. It is not bent, and the tube's sheet turns freely along the rim.
    pub fn set_margin(&mut self, first: usize, law: Compression) {
        let (tube, margin) = self.pieces.split_at_mut(first);
        for piece in margin {
            piece.flatten();
            piece.law = Some(law);
            piece.load = 0.0;
        }
        for piece in tube {
            for beyond in &mut piece.beyond {
                if matches!(beyond, Beyond::Neighbour { triangle, .. } if *triangle >= first) {
                    *beyond = Beyond::Nothing;
                }
            }
            piece.twins = twins(&piece.beyond);
        }
    }

    /// Puts this part of the pressure on one of its triangles.
    pub(crate) fn set_load(&mut self, triangle: usize, part: f64) {
        self.pieces[triangle].load = part;
    }

    /// Lets one of its triangles bear compression as `law` says.
    pub(crate) fn set_law(&mut self, triangle: usize, law: Compression) {
        self.pieces[triangle].law = Some(law);
    }

    /// Whether it bears no compression.
    pub(crate) fn is_wrinkled(&self) -> bool {
        matches!(self.compression, Compression::Wrinkled(_))
    }

    /// One of its triangles.
    pub fn flat_triangle(&self, triangle: usize) -> &Flat {
        &self.pieces[triangle].flat
    }

    /// The flat sheet at rest.
    pub fn flat(&self) -> State {
        let points = self.points.iter().map(|p| [p[0], p[1], 0.0]).collect();
        State { points, leans: vec![0.0; self.edge_count] }
    }
}

/// The flat area that each point stands for.
pub(crate) fn areas<'a>(points: usize, pieces: impl IntoIterator<Item = &'a Piece>) -> Vec<f64> {
    let mut areas = vec![0.0; points];
    for piece in pieces {
        for corner in piece.corners {
            areas[corner] += piece.flat.area / 3.0;
        }
    }
    areas
}

/// A shape of the sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Position of each point of the mesh.
    pub points: Vec<[f64; 3]>,
    /// xi of each edge, rad.
    pub leans: Vec<f64>,
}

fn piece(mesh: &Mesh, fabric: Fabric, t: usize) -> Piece {
    // Each side is folded against a neighbour, against its own image in a plane of symmetry, or not at all. The lean
    // of an edge counts with opposite signs on its two triangles, and not at all on a plane, where the fold is
    // symmetric.
    let corners = mesh.triangles[t];
    let edges = mesh.triangle_edges[t];
    let flat = Flat::new(corners.map(|corner| mesh.points[corner]));
    let mut sides = [Beyond::Nothing; 3];
    let mut lean = [1.0; 3];
    for i in 0..3 {
        let edge = &mesh.edges[edges[i]];
        debug_assert!(edge.ends.contains(&corners[NEXT[i]]) && edge.ends.contains(&corners[LAST[i]]));
        let is_left = edge.sides[0] == Some(t);
        sides[i] = match (edge.sides[usize::from(is_left)], edge.border) {
            (Some(other), _) => neighbour(mesh, other, edges[i]),
            (None, Some(Border::Mirror(plane))) => Beyond::Image(usize::from(plane)),
            (None, _) => Beyond::Nothing,
        };
        lean[i] = match sides[i] {
            Beyond::Image(_) => 0.0,
            _ if is_left => 1.0,
            _ => -1.0,
        };
    }
    let twin_corners = twins(&sides);
    Piece {
        corners,
        edges,
        beyond: sides,
        lean,
        flat,
        stiffness: bending::stiffness(fabric, &flat),
        twins: twin_corners,
        law: None,
        load: 1.0,
        bends: true,
    }
}

fn twins(sides: &[Beyond; 3]) -> [bool; 3] {
    let corners =
        sides.map(|sides| if let Beyond::Neighbour { corner, .. } = sides { Some(corner) } else { None });
    std::array::from_fn(|i| corners[NEXT[i]].is_some() && corners[NEXT[i]] == corners[LAST[i]])
}

fn neighbour(mesh: &Mesh, triangle: usize, edge: usize) -> Beyond {
    let side = mesh.triangle_edges[triangle].iter().position(|&other| other == edge);
    let edge = side.unwrap_or_default();
    Beyond::Neighbour { triangle, edge, corner: mesh.triangles[triangle][edge] }
}

fn cross_product(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
