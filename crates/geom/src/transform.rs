//! Rigid motions of the plane, with or without a mirror image.

use crate::{Arc, Line, Path, Point, Segment, Vec2};

/// Mirror in the X axis (if `mirrored`), then turn by `rotation` about the origin, then move by `shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isometry {
    /// Whether Y is negated first.
    pub mirrored: bool,
    /// Rotation about the origin, rad, counterclockwise.
    pub rotation: f64,
    /// Translation applied last.
    pub shift: Vec2,
}

impl Isometry {
    /// The identity motion.
    pub const IDENTITY: Self = Self { mirrored: false, rotation: 0.0, shift: Vec2::new(0.0, 0.0) };

    /// A pure translation.
    pub const fn translation(shift: Vec2) -> Self {
        Self { shift, ..Self::IDENTITY }
    }

    /// A pure rotation about the origin, rad.
    pub const fn rotation(angle: f64) -> Self {
        Self { rotation: angle, ..Self::IDENTITY }
    }

    /// The mirror image in the X axis.
    pub const fn mirror() -> Self {
        Self { mirrored: true, ..Self::IDENTITY }
    }

    /// The image of a point.
    pub fn point(&self, p: Point) -> Point {
        let y = if self.mirrored { -p.y } else { p.y };
        if self.rotation == 0.0 {
            return Point::new(p.x, y) + self.shift;
        }
        let (s, c) = libm::sincos(self.rotation);
        Point::new(c * p.x - s * y, s * p.x + c * y) + self.shift
    }

    /// The image of a segment; lines stay lines and arcs arcs.
    pub fn segment(&self, segment: &Segment) -> Segment {
        match segment {
            Segment::Line(line) => Line::new(self.point(line.start), self.point(line.end)).into(),
            Segment::Arc(arc) => {
                let sign = if self.mirrored { -1.0 } else { 1.0 };
                Arc {
                    center: self.point(arc.center),
                    radius: arc.radius,
                    start_angle: sign * arc.start_angle + self.rotation,
                    sweep: sign * arc.sweep,
                }
                .into()
            }
        }
    }

    /// The image of a path, in the same order of travel (a mirror image turns the other way).
    pub fn path(&self, path: &Path) -> Path {
        Path { segments: path.segments.iter().map(|s| self.segment(s)).collect(), closed: path.closed }
    }
}
