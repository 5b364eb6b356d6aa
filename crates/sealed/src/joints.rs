//! Joints of seams: ends at ports, ends on other bands, and crossings.

use std::collections::BTreeMap;

use crate::segments::Segments;
use crate::{Port, Role, SealedShape};
use geom::{Bounds, BoxIndex, Point, intersections};

/// Slack of the reach of a band, mm.
const SLACK: f64 = 1e-6;

/// Farthest that the bands beside a port run past the middle of its mouth, mm: however thin the hose is.
const LONGEST_OVERRUN: f64 = 2.0;

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
}

impl Joints {
    /// The joints of `shape`.
    pub(super) fn of(shape: &SealedShape) -> Self {
        let reach = shape.band / 2.0 + SLACK;
        let mut joined = vec![[false; 2]; shape.seams.len()];
        let mut ends: Vec<(usize, usize, Point)> = Vec::new();
        for (number, seam) in shape.seams.iter().enumerate().filter(|(_, seam)| !seam.center_line.closed) {
            let both = [seam.center_line.start(), seam.center_line.end()];
            ends.extend(both.into_iter().enumerate().filter_map(|(which, end)| Some((number, which, end?))));
        }
        if ends.len() > 2 || shape.seams.len() > 1 {
            let segments = Segments::of(shape.seams.iter().map(|seam| &seam.center_line));
            for (seam, which, end) in &ends {
                let path = &shape.seams[*seam].center_line;
                joined[*seam][*which] = segments.has_joint((*seam, path), *end, *which == 0, reach);
            }
        }
        let free = ends
            .into_iter()
            .filter(|(seam, which, _)| shape.seams[*seam].role == Role::Boundary && !joined[*seam][*which]);
        let mouths = mouths(shape, &free.collect::<Vec<_>>());
        Self { joined, mouths }
    }

    /// Whether an end of a seam lies on another band or at a port.
    pub(super) fn is_shut(&self, seam: usize, which: usize) -> bool {
        self.joined[seam][which] || self.mouths.iter().any(|mouth| mouth.seams.contains(&(seam, which)))
    }

    /// The width between the bands at a port, mm.
    pub(super) fn width(&self, shape: &SealedShape, port: usize) -> Option<f64> {
        let mouth = self.mouths.iter().find(|mouth| mouth.port == port)?;
        Some(mouth.ends[0].distance(mouth.ends[1]) - shape.band)
    }
}

/// Pairs of free ends with a port between them, in the middle of two as far apart as its bands are.
fn mouths(shape: &SealedShape, free: &[(usize, usize, Point)]) -> Vec<MouthEnds> {
    let index = BoxIndex::new(free.iter().map(|(_, _, end)| Bounds::of_points([*end])));
    let middles = free.windows(2).map(|pair| Bounds::of_points([pair[0].2.midpoint(pair[1].2)]));
    // The two ends of one seam are side by side.
    let own = BoxIndex::new(middles);
    let mut used = vec![false; free.len()];
    let mut mouths = Vec::new();
    for (number, Port { at, width }) in shape.ports.iter().enumerate() {
        let across = width + shape.band;
        let reach = across.max(LONGEST_OVERRUN);
        let zone = Bounds::of_points([*at]).grown(reach);
        let same = own.overlapping(&zone).into_iter().map(|i| (i, i + 1));
        let same: Vec<_> = same.filter(|(i, j)| free[*i].0 == free[*j].0).collect();
        let near = index.overlapping(&zone.grown(reach));
        let pairs = near.iter().flat_map(|i| near.iter().map(move |j| (*i, *j))).filter(|(i, j)| i < j);
        let far = |(i, j): (usize, usize)| free[i].2.midpoint(free[j].2).distance(*at);
        // Where ports are near each other, the seam between two of them has its own middle near to both.
        let off = |(i, j): (usize, usize)| far((i, j)) + (free[i].2.distance(free[j].2) - across).abs();
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

/// The crossings of seams, except where one ends on the other: their places by pairs of seams, the same twice for one with itself.
pub(super) fn meetings(shape: &SealedShape, joints: &Joints) -> BTreeMap<[usize; 2], Vec<Point>> {
    let segments = Segments::of(shape.seams.iter().map(|seam| &seam.center_line));
    let reach = shape.band / 2.0 + SLACK;
    let is_joint = |seam: usize, p: Point| {
        let path = &shape.seams[seam].center_line;
        let ends = [path.start(), path.end()].into_iter().zip(joints.joined[seam]);
        let mut joined = ends.filter(|(_, joined)| *joined).filter_map(|(end, _)| end);
        joined.any(|end| end.distance(p) <= reach)
    };
    let mut found: BTreeMap<[usize; 2], Vec<Point>> = BTreeMap::new();
    for (i, one) in segments.list.iter().enumerate() {
        let path = &shape.seams[one.path].center_line;
        for j in segments.index.overlapping(&one.bounds).into_iter().filter(|j| *j > i) {
            let next = &segments.list[j];
            let pair = [one.path, next.path];
            let is_round = path.closed && one.at == 0 && next.at == path.segments.len() - 1;
            if one.path == next.path && (next.at - one.at < 2 || is_round) {
                continue;
            }
            for p in intersections(&one.segment, &next.segment) {
                if pair.iter().all(|seam| !is_joint(*seam, p)) {
                    found.entry(pair).or_default().push(p);
                }
            }
        }
    }
    found
}
