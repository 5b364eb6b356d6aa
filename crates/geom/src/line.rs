//! Straight segments.

use crate::{Point, Vec2};

/// A straight segment from `start` to `end`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// First point.
    pub start: Point,
    /// Last point.
    pub end: Point,
}

impl Line {
    /// The segment from `start` to `end`.
    pub const fn new(start: Point, end: Point) -> Self {
        Self { start, end }
    }

    /// Distance between its ends.
    pub fn length(&self) -> f64 {
        self.start.distance(self.end)
    }

    /// Unit vector from start to end; null if they coincide.
    pub fn direction(&self) -> Vec2 {
        (self.end - self.start).normalized()
    }

    /// Fraction along the line, clamped to [0, 1], of the point nearest to `p`.
    pub fn nearest_fraction(&self, p: Point) -> f64 {
        let d = self.end - self.start;
        let square = d.dot(d);
        if square > 0.0 { ((p - self.start).dot(d) / square).clamp(0.0, 1.0) } else { 0.0 }
    }
}
