//! Joints: the cuts between a mask and its tips, and the knobs that position a tip.
//!
//! In the frame of the tip's ray, along +X, the joint is the line x = `at` from one edge of the plate to the other. A
//! **knob** of the middle is a circle whose centre lies half its radius beyond that line: its neck is 0.87 of its diameter, so it
//! locks. The socket around it is wider by the [`PLAY`]; the straight parts have none.

use std::f64::consts::PI;

use crate::{MaskPlate, Outline, Star};
use geom::{Arc, Bounds, Isometry, Line, Path, Point, Segment, Vec2, intersections};

/// Least plate between a joint and a window, mm: the same as between windows.
const BRIDGE: f64 = 4.0;

/// Least plate around knobs, holes and texts, mm.
pub(super) const WALL: f64 = 2.5;

/// From the end of a joint to the notch between two tips, mm: at the notch a corner would be left.
const NOTCH: f64 = 1.5;

/// Gap between a knob and its socket, mm: enough for parts from a 0.4 mm nozzle to go together without tools.
const PLAY: f64 = 0.1;

/// Radii of knobs that are tried, mm: smaller ones break.
pub(super) const RADII: [f64; 5] = [6.0, 5.0, 4.0, 3.0, 2.5];

/// From one place that is tried to the next, mm.
const STEP: f64 = 0.5;

/// Places that are tried at most, so that the search of a large star ends as soon as that of a small one.
const PLACES: f64 = 250.0;

/// The cut of one tip.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct JointCut {
    /// The tip.
    pub(super) tip: u32,
    /// Direction of its ray.
    ray: f64,
    /// Distance of the joint from the axis.
    at: f64,
    /// Radius of the knobs.
    radius: f64,
    /// Their places along the joint.
    knobs: Vec<f64>,
}

/// Segments of an edge that many lines cross. Their bounds and lengths are computed once: a mask of 64 tips is crossed at 80,000 places.
struct MeasuredEdge {
    path: Path,
    /// Bounds of each segment.
    bounds: Vec<Bounds>,
    /// Length of each segment, mm.
    lengths: Vec<f64>,
    /// Greatest distance from the X axis, and a millimetre, mm.
    reach: f64,
}

/// The surroundings of a joint, in the frame of the tip's ray.
struct Around {
    plate: Path,
    /// The part of the plate's edge in the tip's sector, where a joint ends.
    sector: MeasuredEdge,
    /// Largest radius of a knob.
    most: f64,
    /// Centres and radii.
    holes: Vec<(Point, f64)>,
}

/// The two points in which a line x = const meets the plate's edge, on either side of the ray.
struct Chord {
    /// Ends, with where they are along the edge.
    low: (f64, f64),
    high: (f64, f64),
}

impl JointCut {
    /// The cut of tip `tip` that is nearest to the axis, with knobs of radius `largest` or less; `None` if there is no room for one.
    pub(super) fn new(
        star: &Star,
        outline: &Outline,
        mask: &MaskPlate,
        tip: u32,
        largest: f64,
    ) -> Option<Self> {
        let ray = star.tip_ray(tip);
        let motion = Isometry::rotation(-ray);
        let windows = mask.windows.iter().map(|window| motion.path(window).bounds());
        let window_end = windows.fold(Bounds::EMPTY, Bounds::union).max.x + BRIDGE;
        let holes = outline.registration.iter();
        let plate = motion.path(&mask.plate);
        let surroundings = Around {
            sector: MeasuredEdge::new(part_in_sector(&plate, star.half_sector())),
            plate,
            most: largest,
            holes: holes.map(|hole| (motion.point(hole.center), hole.diameter / 2.0)).collect(),
        };
        let mut x = window_end.max(0.0);
        let step = STEP.max((star.tip_reach() - x) / PLACES);
        while x < star.tip_reach() {
            if let Some((radius, knobs)) = surroundings.room(x, star.half_sector()) {
                return Some(Self { tip, ray, at: x, radius, knobs });
            }
            x += step;
        }
        None
    }

    /// The tip's edge and that of the remainder of `edge`; `None` if they do not meet as they should.
    pub(super) fn split(&self, edge: &Path) -> Option<(Path, Path)> {
        let turned = MeasuredEdge::new(Isometry::rotation(-self.ray).path(edge));
        let chord = turned.enclosed_chord(self.at)?;
        let (turned, total) = (&turned.path, turned.lengths.iter().sum::<f64>());
        let ((_, from), (_, to)) = (chord.low, chord.high);
        let far_end = if to > from { to } else { to + total };
        let tip = turned.part(from, far_end).chain(self.line(&chord, PLAY).reversed());
        let rest = turned.part(far_end, from + total).chain(self.line(&chord, 0.0));
        let back = Isometry::rotation(self.ray);
        Some((back.path(&Path { closed: true, ..tip }), back.path(&Path { closed: true, ..rest })))
    }

    /// The joint across `edge`, as the middle has it.
    pub(super) fn joint(&self, edge: &Path) -> Option<Path> {
        let turned = MeasuredEdge::new(Isometry::rotation(-self.ray).path(edge));
        let chord = turned.enclosed_chord(self.at)?;
        Some(Isometry::rotation(self.ray).path(&self.line(&chord, 0.0)))
    }

    /// From the low end to the high one, around the knobs at a distance of `play`.
    fn line(&self, chord: &Chord, play: f64) -> Path {
        let radius = self.radius + play;
        let neck = (radius.powi(2) - (self.radius / 2.0).powi(2)).sqrt();
        let half = PI - libm::acos(self.radius / 2.0 / radius);
        let mut segments: Vec<Segment> = Vec::new();
        let mut pen = Point::new(self.at, chord.low.0);
        for y in &self.knobs {
            let foot = Point::new(self.at, y - neck);
            segments.push(Line::new(pen, foot).into());
            segments.push(Arc::new(self.center(*y), radius, -half, 2.0 * half).into());
            pen = Point::new(self.at, y + neck);
        }
        segments.push(Line::new(pen, Point::new(self.at, chord.high.0)).into());
        Path::open(segments)
    }

    fn center(&self, y: f64) -> Point {
        Point::new(self.at + self.radius / 2.0, y)
    }
}

impl Around {
    /// Radius and places of the knobs for which a joint at `x` has room; `None` if it has none.
    fn room(&self, x: f64, half_sector: f64) -> Option<(f64, Vec<f64>)> {
        let Chord { low: (low, _), high: (high, _) } = self.sector.chord(x)?;
        let mut ends = [low, high].into_iter().map(|y| Point::new(x, y));
        let is_in_sector =
            ends.all(|end| end.angle().abs() + NOTCH / end.distance(Point::ORIGIN) < half_sector);
        let hits = |(hole, radius): &(Point, f64)| {
            (low..high).contains(&hole.y) && (hole.x - x).abs() < radius + WALL
        };
        // The dearest test is the last one.
        if !is_in_sector || self.holes.iter().any(hits) || !encloses_axis_at(&self.plate, x) {
            return None;
        }
        let (middle, quarter) = (f64::midpoint(low, high), (high - low) / 4.0);
        let radii = RADII.into_iter().filter(|radius| *radius <= self.most);
        let two = radii.clone().filter(|radius| quarter >= radius + WALL);
        let two = two.map(|radius| (radius, vec![middle - quarter, middle + quarter]));
        let single = radii.map(|radius| (radius, vec![middle]));
        two.chain(single).find(|(radius, places)| {
            places.iter().all(|y| self.is_free(*radius, Point::new(x + radius / 2.0, *y)))
        })
    }

    /// Whether a knob of `radius` around `center` leaves a wall to the plate's edge and to all holes.
    fn is_free(&self, radius: f64, center: Point) -> bool {
        let clear = |(hole, r): &(Point, f64)| hole.distance(center) >= radius + r + WALL;
        self.plate.distance(center) >= radius + WALL && self.holes.iter().all(clear)
    }
}

/// The height of a crossing, and how far along the path it lies.
type Crossing = (f64, f64);

/// Rounding of bounds, mm.
const ROUNDING: f64 = 1e-6;

/// The segments of `edge` near the sector of this half angle around the X axis, which is less than a right angle, with a millimetre more.
fn part_in_sector(edge: &Path, half_sector: f64) -> Path {
    let slope = libm::tan(half_sector);
    let is_near = |segment: &&Segment| {
        let Bounds { min, max } = segment.bounds();
        let y = min.y.max(-max.y).max(0.0);
        max.x > 0.0 && y < slope * max.x + 1.0
    };
    Path::open(edge.segments.iter().filter(is_near).copied().collect::<Vec<_>>())
}

/// Whether the point of the X axis at `x` lies within the closed `path`.
fn encloses_axis_at(path: &Path, x: f64) -> bool {
    path.encloses(Point::ORIGIN + Vec2::new(x, 0.0))
}

impl MeasuredEdge {
    fn new(path: Path) -> Self {
        let bounds: Vec<Bounds> = path.segments.iter().map(Segment::bounds).collect();
        let lengths = path.segments.iter().map(Segment::length).collect();
        let reach =
            bounds.iter().fold(0.0, |reach: f64, b| reach.max(b.max.y.abs()).max(b.min.y.abs())) + 1.0;
        Self { path, bounds, lengths, reach }
    }

    /// The part of the line x = `x` around the X axis that lies within the edge.
    fn enclosed_chord(&self, x: f64) -> Option<Chord> {
        self.chord(x).filter(|_| encloses_axis_at(&self.path, x))
    }

    /// The nearest crossings of the line x = `x` and the edge on both sides of the X axis.
    fn chord(&self, x: f64) -> Option<Chord> {
        let line = Line::new(Point::new(x, -self.reach), Point::new(x, self.reach)).into();
        let (mut low, mut high) = (None::<Crossing>, None::<Crossing>);
        let mut start = 0.0;
        for ((segment, bounds), length) in self.path.segments.iter().zip(&self.bounds).zip(&self.lengths) {
            let is_crossed = (bounds.min.x - ROUNDING..=bounds.max.x + ROUNDING).contains(&x);
            for crossing in is_crossed.then(|| intersections(segment, &line)).into_iter().flatten() {
                let end = (crossing.y, start + segment.nearest_fraction(crossing) * length);
                if crossing.y < 0.0 && low.is_none_or(|nearest| nearest.0 < crossing.y) {
                    low = Some(end);
                }
                if crossing.y > 0.0 && high.is_none_or(|nearest| nearest.0 > crossing.y) {
                    high = Some(end);
                }
            }
            start += length;
        }
        low.zip(high).map(|(low, high)| Chord { low, high })
    }
}
