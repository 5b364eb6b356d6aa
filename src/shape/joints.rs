//! Joints of seams: ends at ports, ends on other bands, and crossings.

use crate::shape::leak::Leak;
use crate::shape::{Port, Role, SealedShape};
use inflatable::geom::{Bounds, BoxIndex, Point, Segment, intersections};

/// Slack of the reach of a band, mm.
const SLACK: f64 = 1e-6;

/// The two ends of seams at a port.
pub(super) struct MouthEnds {
    pub port: usize,
    /// The seams and which of their ends, 0 or 1.
    pub seams: [(usize, usize); 2],
    pub ends: [Point; 2],
}

/// The contacts of open seams' ends.
pub(super) struct Joints {
    /// Whether the start and the end of each seam lie on another band, within half a band of its centre line.
    pub joined: Vec<[bool; 2]>,
    /// In the order of their ports.
    pub mouths: Vec<MouthEnds>,
    /// The port at the start and at the end of each seam.
    ports: Vec<[Option<usize>; 2]>,
}

/// Every segment of a shape: its seam, its number there, and the path before it, mm.
fn segments(shape: &SealedShape) -> Vec<(usize, usize, f64, Segment)> {
    let mut all = Vec::new();
    for (number, seam) in shape.seams.iter().enumerate() {
        let mut before = 0.0;
        for (at, segment) in seam.center_line.segments.iter().enumerate() {
            all.push((number, at, before, *segment));
            before += segment.length();
        }
    }
    all
}

impl Joints {
    /// The joints of `shape`.
    pub(super) fn of(shape: &SealedShape) -> Self {
        let reach = shape.band / 2.0 + SLACK;
        let open = |seam: &crate::shape::Seam| !seam.center_line.closed;
        let mut joined = vec![[false; 2]; shape.seams.len()];
        let mut ends: Vec<(usize, usize, Point)> = Vec::new();
        for (number, seam) in shape.seams.iter().enumerate().filter(|(_, seam)| open(seam)) {
            let both = [seam.center_line.start(), seam.center_line.end()];
            ends.extend(both.into_iter().enumerate().filter_map(|(which, end)| Some((number, which, end?))));
        }
        if ends.len() > 2 || shape.seams.len() > 1 {
            let segments = segments(shape);
            let index = BoxIndex::new(segments.iter().map(|(_, _, _, segment)| segment.bounds()));
            for (seam, which, end) in &ends {
                let length = shape.seams[*seam].center_line.length();
                let near = index.overlapping(&Bounds::of_points([*end]).grown(reach));
                joined[*seam][*which] = near.into_iter().any(|i| {
                    let (other, _, before, segment) = &segments[i];
                    let t = segment.nearest_fraction(*end);
                    let s = before + t * segment.length();
                    let along = if *which == 0 { s } else { length - s };
                    // Beside its own end a seam is near to itself.
                    (other != seam || along > 4.0 * reach) && segment.point(t).distance(*end) <= reach
                });
            }
        }
        let free = ends
            .into_iter()
            .filter(|(seam, which, _)| shape.seams[*seam].role == Role::Boundary && !joined[*seam][*which]);
        let mouths = mouths(shape, &free.collect::<Vec<_>>());
        let mut ports = vec![[None; 2]; shape.seams.len()];
        for mouth in &mouths {
            for (seam, which) in mouth.seams {
                ports[seam][which] = Some(mouth.port);
            }
        }
        Self { joined, mouths, ports }
    }

    /// The port at an end of a seam.
    pub(super) fn mouth_at(&self, seam: usize, which: usize) -> Option<usize> {
        self.ports[seam][which]
    }

    /// Whether a seam ends on other bands only.
    pub(super) fn is_wall(&self, seam: usize) -> bool {
        self.joined[seam] == [true; 2]
    }

    /// The width between the bands at a port, mm.
    pub(super) fn width(&self, shape: &SealedShape, port: usize) -> Option<f64> {
        let mouth = &self.mouths[self.mouths.binary_search_by_key(&port, |mouth| mouth.port).ok()?];
        Some(mouth.ends[0].distance(mouth.ends[1]) - shape.band)
    }
}

/// Pairs of free ends with a port between them, in the middle of two as far apart as its bands are.
fn mouths(shape: &SealedShape, free: &[(usize, usize, Point)]) -> Vec<MouthEnds> {
    let index = BoxIndex::new(free.iter().map(|(_, _, end)| Bounds::of_points([*end])));
    let middles = free.windows(2).map(|pair| Bounds::of_points([pair[0].2.midpoint(pair[1].2)]));
    // The two ends of one seam are side by side.
    let own = BoxIndex::new(middles.collect::<Vec<_>>().into_iter());
    let mut used = vec![false; free.len()];
    let mut mouths = Vec::new();
    for (number, Port { at, width }) in shape.ports.iter().enumerate() {
        let reach = width + shape.band;
        let zone = Bounds::of_points([*at]).grown(reach);
        let same = own.overlapping(&zone).into_iter().map(|i| (i, i + 1));
        let same: Vec<_> = same.filter(|(i, j)| free[*i].0 == free[*j].0).collect();
        let near = index.overlapping(&zone.grown(reach));
        let pairs = near.iter().flat_map(|i| near.iter().map(move |j| (*i, *j))).filter(|(i, j)| i < j);
        let far = |(i, j): (usize, usize)| free[i].2.midpoint(free[j].2).distance(*at);
        // Where ports are near each other, the seam between two of them has its own middle near to both.
        let off = |(i, j): (usize, usize)| far((i, j)) + (free[i].2.distance(free[j].2) - reach).abs();
        let best = same
            .into_iter()
            .chain(pairs)
            .filter(|(i, j)| !used[*i] && !used[*j] && far((*i, *j)) <= reach)
            .min_by(|a, b| off(*a).total_cmp(&off(*b)));
        if let Some((i, j)) = best {
            (used[i], used[j]) = (true, true);
            let ends = [free[i], free[j]];
            mouths.push(MouthEnds {
                port: number,
                seams: ends.map(|(seam, which, _)| (seam, which)),
                ends: ends.map(|(_, _, end)| end),
            });
        }
    }
    mouths
}

/// The crossings of seams, except where one ends on the other.
pub(super) struct Meetings(Vec<([usize; 2], Point)>);

impl Meetings {
    /// The meetings of the seams of `shape`.
    pub(super) fn of(shape: &SealedShape, joints: &Joints) -> Self {
        let segments = segments(shape);
        let boxes: Vec<Bounds> = segments.iter().map(|(_, _, _, segment)| segment.bounds()).collect();
        let index = BoxIndex::new(boxes.iter().copied());
        let reach = shape.band / 2.0 + SLACK;
        let is_joint = |seam: usize, p: Point| {
            let path = &shape.seams[seam].center_line;
            let ends = [path.start(), path.end()].into_iter().zip(joints.joined[seam]);
            let mut joined = ends.filter(|(_, joined)| *joined).filter_map(|(end, _)| end);
            joined.any(|end| end.distance(p) <= reach)
        };
        let mut found = Vec::new();
        for (i, (a, at, _, segment)) in segments.iter().enumerate() {
            let path = &shape.seams[*a].center_line;
            for j in index.overlapping(&boxes[i]).into_iter().filter(|j| *j > i) {
                let (b, other, _, next) = &segments[j];
                let last = path.segments.len() - 1;
                if a == b && (other - at < 2 || (path.closed && *at == 0 && *other == last)) {
                    continue;
                }
                let places = intersections(segment, next).into_iter();
                found
                    .extend(places.filter(|p| !is_joint(*a, *p) && !is_joint(*b, *p)).map(|p| ([*a, *b], p)));
            }
        }
        found.sort_by_key(|(seams, _)| *seams);
        Self(found)
    }

    /// The leaks of `seam` with itself and with later ones.
    pub(super) fn leaks(&self, seam: usize) -> Vec<Leak> {
        let from = self.0.partition_point(|(seams, _)| seams[0] < seam);
        let own = self.0[from..].iter().take_while(|(seams, _)| seams[0] == seam);
        let own: Vec<&([usize; 2], Point)> = own.collect();
        let leak = |run: &[&([usize; 2], Point)]| {
            let places = run.iter().map(|(_, place)| *place).collect();
            let [a, b] = run[0].0;
            if a == b { Leak::CrossesItself(a, places) } else { Leak::Cross([a, b], places) }
        };
        own.chunk_by(|a, b| a.0 == b.0).map(leak).collect()
    }
}
