//! A piece as a file states it: its ends as they are rounded, and a straight move where an arc is as good.
//!
//! A controller steps to the positions of the file, so a count of its steps must begin with these.

use geom::{Grid, Segment};
use spec::units::Length;

/// The part of the tolerance within which a piece is written as a straight move; rounding takes a tenth at most.
pub(super) const STRAIGHT: f64 = 0.25;

/// Whether a file of the tolerance `path` states `piece` as a straight move.
pub fn is_straight(piece: &Segment, path: Length) -> bool {
    let Segment::Arc(arc) = piece else { return true };
    let tolerance = STRAIGHT * path.0;
    // `1 - cos x <= x^2 / 2` decides most cases without a cosine.
    let at_most = arc.radius * arc.sweep * arc.sweep / 8.0;
    at_most <= tolerance || arc.radius * (1.0 - libm::cos(arc.sweep / 2.0)) <= tolerance
}

/// The precision of moves in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// Tolerance of the file, mm, by which positions are rounded.
    pub path: Length,
    /// Whether it has arcs; if not, every move is straight.
    pub arcs: bool,
}

/// A move as a file states it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Written {
    /// Start of the move, mm.
    pub(super) from: [f64; 3],
    /// End of the move, mm.
    pub(super) to: [f64; 3],
    /// Length of the move, mm.
    pub(super) length: f64,
}

impl Written {
    /// `piece`, between two heights, in a file.
    pub(super) fn new(piece: &Segment, [low, high]: [f64; 2], file: Precision) -> Self {
        let Precision { path, arcs } = file;
        let grid = Grid::for_tolerance(path.0);
        let (from, to) = (grid.round_point(piece.start()), grid.round_point(piece.end()));
        let (low, high) = (grid.round(low), grid.round(high));
        let chord = from.distance(to);
        let flat = match piece {
            // The radius is exact, and a piece turns by half a circle at most.
            Segment::Arc(arc) if arcs && !is_straight(piece, path) => {
                2.0 * arc.radius * libm::asin((0.5 * chord / arc.radius).min(1.0))
            }
            _ => chord,
        };
        Self { from: [from.x, from.y, low], to: [to.x, to.y, high], length: libm::hypot(flat, high - low) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::{Arc, Line, Point};

    fn file(path: f64) -> Precision {
        Precision { path: Length(path), arcs: true }
    }

    #[test]
    fn ends_are_rounded_and_flat_arcs_are_straight() {
        let line: Segment = Line::new(Point::new(1.000_4, 0.0), Point::new(2.000_6, 0.0)).into();
        let rounded = Written::new(&line, [0.0, 0.0], file(0.01));
        assert_eq!((rounded.from, rounded.to), ([1.0, 0.0, 0.0], [2.001, 0.0, 0.0]));
        assert!((rounded.length - 1.001).abs() < 1e-12);
        // 0.2 mm along a circle of 1 mm have a sagitta of 0.005 mm.
        let arc: Segment = Arc::new(Point::ORIGIN, 1.0, 0.0, 0.2).into();
        for (path, length) in [(0.01, 0.2), (0.1, 2.0 * 0.1_f64.sin())] {
            assert_eq!(is_straight(&arc, Length(path)), path > 0.05);
            let rounded = Written::new(&arc, [0.0, 0.0], file(path));
            assert!((rounded.length - length).abs() < 1e-3, "{path}: {}", rounded.length);
        }
        assert!(Written::new(&arc, [3.0, -1.0], file(0.001)).length > 4.0);
    }
}
