//! A flat sheet cut into triangles.

/// What a border edge of the sheet is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Border {
    /// Sealed: it stays in the plane z = 0, slides there, and its rotation is free. The number says which rim it is.
    Rim(u8),
    /// On a plane of symmetry, upright on the flat sheet: points and normals stay in it. The number says which plane.
    Mirror(u8),
    /// Nothing holds it.
    Free,
}

/// An edge of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its points; the smaller index first.
    pub ends: [usize; 2],
    /// The triangle to its left as it runs from its first to its second end, and the one to its right.
    pub sides: [Option<usize>; 2],
    /// What it is if it has only one side.
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
