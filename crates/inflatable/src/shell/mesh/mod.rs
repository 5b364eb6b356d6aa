//! A flat sheet cut into triangles.
//!
//! A **region** is the area inside a closed border of exact lines and arcs; it is **meshed** with triangles of the sizes of a
//! **sizing** at each place, and **refined** by cutting every triangle into four, with new border points on the exact curves.
//! All lengths of one mesh have the same unit, whatever it is; border numbers are those of [`rim`] and [`plane`].

mod cases;
mod chamber;
mod connect;
mod delaunay;
mod fault;
#[cfg(test)]
mod grid;
mod margin;
mod order;
mod region;
mod separator;
mod sizing;
mod strip;
#[cfg(test)]
mod tests;
mod unfold;
mod vtu;
mod width;

#[cfg(test)]
pub(crate) use cases::HingeSector;
pub use cases::{HalfActuator, HalfSector};
pub use chamber::FlatChamber;
pub(in crate::shell) use chamber::scaled_line;
pub use fault::MeshFault;
#[cfg(test)]
pub(crate) use grid::{Diagonal, rectangle};
pub use margin::MarginWidths;
pub use region::{Meshed, Piece, Region};
pub use sizing::Sizes;
pub use vtu::{FieldFault, VtuField, vtu};

/// Numbers of the rims, for [`Border::Rim`].
pub mod rim {
    /// The rim on the left as one goes along the tube away from plane 0: of a star the one around the hole, of an
    /// actuator the one that its hinge closes on.
    pub const INNER: u8 = 0;
    /// The rim on the right.
    pub const OUTER: u8 = 1;
    /// The sealed end of an arm.
    pub const END: u8 = 2;
    /// A weld within the sheet.
    pub const WELD: u8 = 3;
}

/// Numbers of the planes of symmetry, for [`Border::Mirror`].
pub mod plane {
    /// The plane through the first hinge; it holds the x axis.
    pub const FIRST: u8 = 0;
    /// The plane at the other end.
    pub const SECOND: u8 = 1;
}

/// The kind of a border edge of the sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Border {
    /// Sealed: it stays in the plane z = 0, slides there, and its rotation is free. The number is that of the rim.
    Rim(u8),
    /// On a plane of symmetry, upright on the flat sheet: points and normals stay in it. The number is that of the plane.
    Mirror(u8),
    /// Without support.
    Free,
}

/// An edge of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// End points of the edge; the smaller index first.
    pub ends: [usize; 2],
    /// The triangle to its left as it runs from its first to its second end, and the one to its right.
    pub sides: [Option<usize>; 2],
    /// Border of the edge if it has only one side, or is the rim between tube and margin.
    pub border: Option<Border>,
}

/// A triangulated flat sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Flat positions, any unit of length.
    pub points: Vec<[f64; 2]>,
    /// Points of each triangle, counterclockwise.
    pub triangles: Vec<[usize; 3]>,
    /// Edges of each triangle: edge `i` lies opposite to its point `i`.
    pub triangle_edges: Vec<[usize; 3]>,
    /// All edges, in an order that the triangles alone decide.
    pub edges: Vec<Edge>,
}

impl Mesh {
    /// Flat area of a triangle, positive.
    pub fn area(&self, triangle: usize) -> f64 {
        signed_area(self.triangles[triangle].map(|point| self.points[point]))
    }

    /// The middle of a triangle of the flat sheet.
    pub(crate) fn middle(&self, triangle: usize) -> [f64; 2] {
        let [a, b, c] = self.triangles[triangle].map(|corner| self.points[corner]);
        [0, 1].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0)
    }

    /// Flat area of the sheet.
    #[cfg(test)]
    pub fn total_area(&self) -> f64 {
        (0..self.triangles.len()).map(|triangle| self.area(triangle)).sum()
    }

    /// Flat length of an edge.
    pub fn length(&self, edge: usize) -> f64 {
        let [a, b] = self.edges[edge].ends.map(|point| self.points[point]);
        distance(a, b)
    }

    /// The edges of one border, in the order of all edges.
    pub fn border_edges(&self, border: Border) -> impl Iterator<Item = usize> {
        (0..self.edges.len()).filter(move |edge| self.edges[*edge].border == Some(border))
    }

    /// The point of a border that lies farthest in the direction of negative x; `None` if there is no such border.
    pub fn innermost(&self, border: Border) -> Option<usize> {
        let points = self.border_edges(border).flat_map(|edge| self.edges[edge].ends);
        points.min_by(|a, b| self.points[*a][0].total_cmp(&self.points[*b][0]))
    }

    /// Smallest angle of all triangles, rad; pi for a mesh without any.
    #[cfg(test)]
    pub fn smallest_angle(&self) -> f64 {
        let corner_points = self.triangles.iter().map(|corners| corners.map(|point| self.points[point]));
        corner_points.flat_map(angles).fold(std::f64::consts::PI, f64::min)
    }
}

/// Area of a triangle, positive if its corners run counterclockwise.
fn signed_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
}

/// Angles of a triangle at its corners, rad.
fn angles(corners: [[f64; 2]; 3]) -> [f64; 3] {
    let twice = 2.0 * signed_area(corners).abs();
    [0, 1, 2].map(|i| {
        let [a, b, c] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
        libm::atan2(twice, (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]))
    })
}

pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}
