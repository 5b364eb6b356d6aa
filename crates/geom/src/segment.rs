//! A segment: a line or a circular arc, travelled from its start to its end.

use crate::{Arc, Bounds, Line, Point, Vec2};

/// A line or an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// A straight segment.
    Line(Line),
    /// A circular arc.
    Arc(Arc),
}

impl Segment {
    /// First point.
    pub fn start(&self) -> Point {
        match self {
            Self::Line(line) => line.start,
            Self::Arc(arc) => arc.start(),
        }
    }

    /// Last point.
    pub fn end(&self) -> Point {
        match self {
            Self::Line(line) => line.end,
            Self::Arc(arc) => arc.end(),
        }
    }

    /// Length along the segment.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(line) => line.length(),
            Self::Arc(arc) => arc.length(),
        }
    }

    /// The point at fraction `t` of its length; `t` outside [0, 1] extrapolates.
    pub fn point(&self, t: f64) -> Point {
        match self {
            Self::Line(line) => line.start.lerp(line.end, t),
            Self::Arc(arc) => arc.at_angle(arc.start_angle + t * arc.sweep),
        }
    }

    /// Unit tangent in the direction of travel at fraction `t`.
    pub fn tangent(&self, t: f64) -> Vec2 {
        match self {
            Self::Line(line) => line.direction(),
            Self::Arc(arc) => arc.tangent(t),
        }
    }

    /// The part between the fractions `t0 <= t1`.
    pub fn part(&self, t0: f64, t1: f64) -> Self {
        match self {
            Self::Line(line) => {
                let [start, end] =
                    [t0, t1].map(|t| if t == 1.0 { line.end } else { line.start.lerp(line.end, t) });
                Self::Line(Line::new(start, end))
            }
            Self::Arc(arc) => Self::Arc(arc.part(t0, t1)),
        }
    }

    /// This segment travelled the other way.
    pub fn reversed(&self) -> Self {
        match self {
            Self::Line(line) => Self::Line(Line::new(line.end, line.start)),
            Self::Arc(arc) => Self::Arc(Arc { start_angle: arc.end_angle(), sweep: -arc.sweep, ..*arc }),
        }
    }

    /// The segment with other ends; an arc keeps the turn between them, or stays as it is where no arc has such ends.
    pub fn with_ends(&self, start: Point, end: Point) -> Self {
        match self {
            Self::Line(_) => Line::new(start, end).into(),
            Self::Arc(arc) => Arc::from_bulge(start, end, arc.bulge()).map_or(*self, Self::Arc),
        }
    }

    /// Fraction in [0, 1] of the point nearest to `p`.
    pub fn nearest_fraction(&self, p: Point) -> f64 {
        match self {
            Self::Line(line) => line.nearest_fraction(p),
            Self::Arc(arc) => arc.nearest_fraction(p),
        }
    }

    /// Distance from `p` to the nearest point of the segment.
    pub fn distance(&self, p: Point) -> f64 {
        self.point(self.nearest_fraction(p)).distance(p)
    }

    /// Smallest axis-parallel box that holds the segment.
    pub fn bounds(&self) -> Bounds {
        self.bounds_of([self.start(), self.end()])
    }

    /// The bounds, with the ends given by the caller: on an arc they cost more than all the rest.
    pub fn bounds_of(&self, ends: [Point; 2]) -> Bounds {
        let ends = Bounds::of_points(ends);
        match self {
            Self::Line(_) => ends,
            Self::Arc(arc) => arc.extreme_points().fold(ends, Bounds::including),
        }
    }
}

impl From<Line> for Segment {
    fn from(line: Line) -> Self {
        Self::Line(line)
    }
}

impl From<Arc> for Segment {
    fn from(arc: Arc) -> Self {
        Self::Arc(arc)
    }
}
