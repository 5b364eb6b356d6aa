//! The geometry of an entity: a point or a chain of pieces, with its heights.

use geom::Point;

use crate::collector::CurveChain;

/// The geometry of an entity.
#[derive(Debug)]
pub(super) struct Geometry {
    pub(super) shape: EntityShape,
    /// Smallest and largest z.
    pub(super) heights: [f64; 2],
    /// Whether x is mirrored, by an extrusion along -z.
    pub(super) mirrored: bool,
    /// The detail that was resolved, for a note.
    pub(super) remark: Option<&'static str>,
}

/// A point or a chain.
#[derive(Debug)]
pub(super) enum EntityShape {
    Point(Point),
    Chain(CurveChain),
}

/// Geometry in the drawing's plane.
pub(super) fn flat(shape: EntityShape, heights: &[f64]) -> Geometry {
    let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let heights = if low <= high { [low, high] } else { [0.0, 0.0] };
    Geometry { shape, heights, mirrored: false, remark: None }
}
