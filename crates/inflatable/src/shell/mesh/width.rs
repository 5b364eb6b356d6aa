//! Width of a chamber: at its widest place, and along each of its walls.

use geom::{Bounds, Line, Point, Segment, Vec2, intersections};

/// The walls of a chamber: its outline, islands and welds.
pub(super) struct ChamberWalls {
    segments: Vec<(Segment, Bounds)>,
}

/// Squares along the longer side of the chamber's box with which the search for the widest circle begins.
const SQUARES: u32 = 12;
/// Relative accuracy of the widest circle.
const ACCURACY: f64 = 1e-3;
/// Squares that may be looked at: labyrinths have many places that are almost equally wide.
const MOST_SQUARES: usize = 20_000;

impl ChamberWalls {
    pub(super) fn new(segments: impl Iterator<Item = Segment>) -> Self {
        Self { segments: segments.map(|segment| (segment, segment.bounds())).collect() }
    }

    /// The distance from `origin` along `direction` to the first wall, at most `reach`.
    pub(super) fn width(&self, origin: Point, direction: Vec2, reach: f64) -> f64 {
        // The wall on which `origin` lies is left out.
        let start = origin + direction * (1e-6 * reach);
        let ray = Line::new(start, origin + direction * reach);
        let bounds = Segment::Line(ray).bounds();
        let crossed = self.segments.iter().filter(|(_, box_of)| box_of.overlaps(&bounds));
        crossed
            .flat_map(|(segment, _)| intersections(&Segment::Line(ray), segment))
            .map(|hit| hit.distance(origin))
            .fold(reach, f64::min)
    }

    fn distance(&self, p: Point) -> f64 {
        self.segments.iter().fold(f64::INFINITY, |least, (segment, bounds)| {
            if bounds.distance(p) < least { least.min(segment.distance(p)) } else { least }
        })
    }

    /// Diameter of the largest circle between the walls whose centre is in the chamber, by `contains`, within [`ACCURACY`]. Squares are
    /// quartered as long as they may hold a better centre, the most promising first.
    pub(super) fn widest(&self, bounds: Bounds, contains: impl Fn(Point) -> bool) -> f64 {
        let half = bounds.width().max(bounds.height()) / f64::from(2 * SQUARES);
        if !(half > 0.0 && half.is_finite()) {
            return 0.0;
        }
        let mut best = 0.0_f64;
        let mut open: Vec<(f64, Point, f64)> = Vec::new();
        let mut looked_at = 0;
        let mut next: Vec<(Point, f64)> = Vec::new();
        for (i, j) in (0..SQUARES).flat_map(|i| (0..SQUARES).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|k: u32| half * f64::from(2 * k + 1));
            next.push((Point::new(bounds.min.x + x, bounds.min.y + y), half));
        }
        loop {
            for (center, half) in next.drain(..) {
                looked_at += 1;
                let distance = self.distance(center);
                let radius = if contains(center) { distance } else { -distance };
                best = best.max(radius);
                open.push((radius + half * std::f64::consts::SQRT_2, center, half));
            }
            open.retain(|(bound, ..)| *bound > best * (1.0 + ACCURACY));
            let first = (0..open.len()).max_by(|a, b| open[*a].0.total_cmp(&open[*b].0));
            let Some(first) = first.filter(|_| looked_at < MOST_SQUARES) else { return 2.0 * best };
            let (_, center, half) = open.swap_remove(first);
            let quarter = half / 2.0;
            next.extend(
                [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]]
                    .map(|[x, y]| (center + Vec2::new(x * quarter, y * quarter), quarter)),
            );
        }
    }
}
