//! A tube of constant width that turns and runs straight: the region of every case.

use crate::shell::mesh::sizing::HingePlace;
use crate::shell::mesh::{Border, Piece, Region, plane, rim};
use geom::{Arc, Line, Point, Segment, Vec2};

/// A tube under construction: it begins on the x axis, which is a plane of symmetry, and first runs along +y.
pub(super) struct Strip {
    width: f64,
    /// Start of the strip, on the left and on the right.
    began: [Point; 2],
    /// The current ends of its rims: the left one and the right one.
    left_end: Point,
    right_end: Point,
    /// Direction from the right rim to the left one.
    across: Vec2,
    left: Vec<Segment>,
    right: Vec<Segment>,
    hinges: Vec<HingePlace>,
}

/// To which side a tube turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StripSide {
    Left,
    Right,
}

impl Strip {
    /// The tube whose left rim begins at (`x`, 0).
    pub(super) fn new(x: f64, width: f64) -> Self {
        let [left_end, right_end] = [Point::new(x, 0.0), Point::new(x + width, 0.0)];
        let perpendicular = Vec2::new(-1.0, 0.0);
        Self {
            width,
            began: [left_end, right_end],
            left_end,
            right_end,
            across: perpendicular,
            left: Vec::new(),
            right: Vec::new(),
            hinges: Vec::new(),
        }
    }

    /// Turns by `arc` (rad, positive) around a centre at the distance `radius` from the nearer rim.
    pub(super) fn turn(mut self, side: StripSide, radius: f64, arc: f64) -> Self {
        let (center, direction, sweep) = match side {
            StripSide::Left => (self.left_end + self.across * radius, -self.across, arc),
            StripSide::Right => (self.right_end - self.across * radius, self.across, -arc),
        };
        let outer = radius + self.width;
        let outer_arc = Arc::new(center, outer, direction.angle(), sweep);
        // With a radius of 0 the rim turns on a point.
        let inner_arc = (radius > 0.0).then_some(Arc { radius, ..outer_arc });
        let (left, right) = match side {
            StripSide::Left => (inner_arc, Some(outer_arc)),
            StripSide::Right => (Some(outer_arc), inner_arc),
        };
        [self.left_end, self.right_end] = [left, right].map(|arc| arc.map_or(center, |arc| arc.end()));
        self.left.extend(left.map(Segment::from));
        self.right.extend(right.map(Segment::from));
        let (sin, cos) = libm::sincos(sweep);
        let Vec2 { x, y } = self.across;
        self.across = Vec2::new(cos * x - sin * y, sin * x + cos * y);
        self.hinges.push(HingePlace { center, radii: [radius, outer] });
        self
    }

    /// Runs straight.
    pub(super) fn straight(mut self, length: f64) -> Self {
        let along = -self.across.perp() * length;
        for (end, rim) in [(&mut self.left_end, &mut self.left), (&mut self.right_end, &mut self.right)] {
            let next = *end + along;
            rim.push(Line::new(*end, next).into());
            *end = next;
        }
        self
    }

    /// Ends across, at the border `last`.
    pub(super) fn end(self, last: Border) -> (Region, Vec<HingePlace>) {
        let outer_rim = self.right.iter().copied();
        let mut pieces: Vec<Piece> =
            outer_rim.map(|curve| Piece { curve, border: Border::Rim(rim::OUTER) }).collect();
        let end = Line::new(self.right_end, self.left_end);
        pieces.push(Piece { curve: end.into(), border: last });
        let inner_rim = self.left.iter().rev().map(Segment::reversed);
        pieces.extend(inner_rim.map(|curve| Piece { curve, border: Border::Rim(rim::INNER) }));
        let [left, right] = self.began;
        let first = Line::new(left, right);
        pieces.push(Piece { curve: first.into(), border: Border::Mirror(plane::FIRST) });
        (Region { pieces, holes: Vec::new(), welds: Vec::new() }, self.hinges)
    }
}
