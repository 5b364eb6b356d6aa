//! Reasons for triangles that do not form a mesh.

use std::fmt;

/// Fault of points and triangles that should form a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeshFault {
    /// There is no triangle.
    Empty,
    /// A coordinate is infinite or no number.
    NotFinite {
        /// The point.
        point: usize,
    },
    /// A triangle names a point that does not exist.
    NoSuchPoint {
        /// The triangle.
        triangle: usize,
        /// The point that it names.
        found: usize,
        /// The number of points.
        points: usize,
    },
    /// No triangle uses a point, so it would be free.
    Unused {
        /// The point.
        point: usize,
    },
    /// A triangle runs clockwise, or is flat.
    NotCounterclockwise {
        /// The triangle.
        triangle: usize,
        /// Signed area of the triangle.
        area: f64,
    },
    /// Two triangles lie on the same side of one edge, so they overlap.
    Overlap {
        /// The edge's points.
        ends: [usize; 2],
        /// The triangles.
        triangles: [usize; 2],
    },
    /// An edge has one triangle only, and no border of the region is there: a hanging point or a hole.
    Unnamed {
        /// The edge's points.
        ends: [usize; 2],
        /// Index of the triangle.
        triangle: usize,
    },
    /// The border meets itself at a point: the sheet hangs together by that point only.
    Pinched {
        /// The point.
        point: usize,
        /// The number of border edges that end there.
        borders: usize,
    },
    /// A length that must be positive and finite is not, or one that may be 0 is negative.
    Dimension {
        /// Which.
        name: &'static str,
        /// The given value.
        found: f64,
        /// The allowed values, as text.
        allowed: &'static str,
    },
    /// The region would need more points than allowed at the requested sizes.
    TooMany {
        /// The allowed number.
        most: usize,
    },
    /// A weld or an island leaves the outline.
    Outside {
        /// The place, in the mesh's unit.
        at: [f64; 2],
    },
    /// An edge of the border is missing among the triangles: the border meets or crosses itself.
    BorderLost {
        /// The border points between which it should lie.
        ends: [usize; 2],
    },
}

impl fmt::Display for MeshFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Each fault names the triangle, point or edge by its number, and the remedy where the caller has one. Numbers count from 0, as
        // in the mesh.
        match *self {
            Self::Empty => write!(f, "a mesh needs at least one triangle"),
            Self::NotFinite { point } => write!(f, "point {point} has a coordinate that is not finite"),
            Self::NoSuchPoint { triangle, found, points } => {
                write!(
                    f,
                    "triangle {triangle} refers to point {found}, but there are only {points} points, \
                     counted from 0"
                )
            }
            Self::Unused { point } => write!(f, "no triangle uses point {point}: leave it out"),
            Self::NotCounterclockwise { triangle, area } => {
                write!(
                    f,
                    "triangle {triangle} has the signed area {area:e}, and must have a positive one: exchange two of its points"
                )
            }
            Self::Overlap { ends: [a, b], triangles: [s, t] } => {
                write!(f, "triangles {s} and {t} lie on the same side of the edge between points {a} and {b}")
            }
            Self::Unnamed { ends: [a, b], triangle } => write!(
                f,
                "triangle {triangle} has no neighbour at the edge between points {a} and {b}, which is not a \
                 border: join a hanging point, or declare the border"
            ),
            Self::Pinched { point, borders } => {
                write!(f, "{borders} border edges end at point {point}, but must be 2: split the sheet there")
            }
            Self::Dimension { name, found, allowed } => write!(f, "{name} is {found}, allowed is {allowed}"),
            Self::TooMany { most } => {
                write!(f, "the mesh would have more than {most} points: request larger triangles")
            }
            Self::Outside { at: [x, y] } => write!(
                f,
                "a weld lies outside the outline near ({x:.4}, {y:.4}) by the widest width: end it within or on the outline"
            ),
            Self::BorderLost { ends: [a, b] } => {
                write!(f, "the border between its points {a} and {b} is crossed: the region overlaps itself")
            }
        }
    }
}

impl std::error::Error for MeshFault {}
