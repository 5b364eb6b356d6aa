//! Paths: chains of segments.

use crate::{Bounds, Line, Point, Segment, Vec2};

/// A chain of segments, each beginning where the one before ends; `closed` if the last ends where the first begins.
///
/// The ends meet to rounding (about 1e-13 of the coordinates), not to the bit: an arc's ends are computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// The segments in order of travel.
    pub segments: Vec<Segment>,
    /// Whether the path returns to its start.
    pub closed: bool,
}

impl Path {
    /// An open path.
    pub fn open(segments: Vec<Segment>) -> Self {
        Self { segments, closed: false }
    }

    /// A closed path.
    pub fn closed(segments: Vec<Segment>) -> Self {
        Self { segments, closed: true }
    }

    /// An open path of straight lines from each of `points` to the next.
    pub fn polyline(points: &[Point]) -> Self {
        Self::open(points.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect())
    }

    /// The closed path through `corners`.
    pub fn polygon(corners: &[Point]) -> Self {
        let next = corners.iter().cycle().skip(1);
        Self::closed(corners.iter().zip(next).map(|(from, to)| Line::new(*from, *to).into()).collect())
    }

    /// The edge of a box, counterclockwise.
    pub fn rectangle(bounds: &Bounds) -> Self {
        let Bounds { min, max } = *bounds;
        Self::polygon(&[min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)])
    }

    /// First point; `None` for the empty path.
    pub fn start(&self) -> Option<Point> {
        self.segments.first().map(Segment::start)
    }

    /// Last point; `None` for the empty path.
    pub fn end(&self) -> Option<Point> {
        self.segments.last().map(Segment::end)
    }

    /// Length along the path.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(Segment::length).sum()
    }

    /// Smallest axis-parallel box around the path.
    pub fn bounds(&self) -> Bounds {
        self.segments.iter().map(Segment::bounds).fold(Bounds::EMPTY, Bounds::union)
    }

    /// This path travelled the other way, from the last to the first.
    pub fn reversed(&self) -> Self {
        Self { segments: self.segments.iter().rev().map(Segment::reversed).collect(), closed: self.closed }
    }

    /// This closed path, travelled so that its inside lies on the left.
    pub fn counterclockwise(&self) -> Self {
        if self.area() < 0.0 { self.reversed() } else { self.clone() }
    }

    /// Largest gap between the end of a segment and the start of the next (for a closed path also at the seam).
    pub fn largest_gap(&self) -> f64 {
        let next = self.segments.iter().skip(1).chain(self.segments.first().filter(|_| self.closed));
        self.segments.iter().zip(next).map(|(a, b)| a.end().distance(b.start())).fold(0.0, f64::max)
    }

    /// Index of the segment and fraction on it at arc length `s`, clamped to the path; `None` if it is empty.
    fn locate(&self, s: f64) -> Option<(usize, f64)> {
        let mut rest = s.max(0.0);
        for (i, segment) in self.segments.iter().enumerate() {
            let length = segment.length();
            if rest < length {
                return Some((i, rest / length));
            }
            rest -= length;
        }
        self.segments.len().checked_sub(1).map(|last| (last, 1.0))
    }

    /// The point at arc length `s`, clamped to the path.
    pub fn point_at(&self, s: f64) -> Option<Point> {
        self.locate(s).map(|(i, t)| self.segments[i].point(t))
    }

    /// Unit tangent in the direction of travel at arc length `s`, clamped to the path.
    pub fn tangent_at(&self, s: f64) -> Option<Vec2> {
        self.locate(s).map(|(i, t)| self.segments[i].tangent(t))
    }

    /// The open path from arc length `from` to `to` (`from <= to`).
    ///
    /// On a closed path both may lie outside [0, length]: the part then runs on across the seam, as
    /// often as needed. On an open path they are clamped.
    pub fn part(&self, from: f64, to: f64) -> Self {
        let total = self.length();
        if total <= 0.0 || to <= from {
            return Self::default();
        }
        let (mut from, mut to) =
            if self.closed { (from, to) } else { (from.clamp(0.0, total), to.clamp(0.0, total)) };
        let turns = (from / total).floor();
        from -= turns * total;
        to -= turns * total;
        // Pieces shorter than this are rounding, not geometry; a path's own pieces are far longer.
        let dust = 1e-12 * total;
        let mut segments = Vec::new();
        let mut s = 0.0;
        for segment in self.segments.iter().cycle() {
            let length = segment.length();
            let (a, b) = ((from - s).max(0.0), (to - s).min(length));
            if b - a > dust {
                segments.push(segment.part(a / length, b / length));
            }
            s += length;
            if s >= to || (!self.closed && s >= total) {
                break;
            }
        }
        Self::open(segments)
    }

    /// A closed path that starts at arc length `s` instead.
    pub fn starting_at(&self, s: f64) -> Self {
        let total = self.length();
        Self { closed: true, ..self.part(s, s + total) }
    }

    /// The path followed by `other`.
    pub fn chain(mut self, other: Self) -> Self {
        self.segments.extend(other.segments);
        self
    }
}
