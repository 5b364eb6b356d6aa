//! Joints of seams: ends at ports, ends on other bands, and crossings.

use std::collections::BTreeMap;

use crate::segments::Segments;
use crate::{Port, Role, SealedShape, Seam};
use geom::{Bounds, BoxIndex, Path, Point, intersections};

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

/// An end of a seam.
struct SeamEnd {
    seam: usize,
    /// Which end, 0 or 1.
    side: usize,
    place: Point,
}

impl Joints {
    /// The joints of `shape`.
    pub(super) fn new(shape: &SealedShape) -> Self {
        let reach = shape.band / 2.0 + SLACK;
        let mut joined = vec![[false; 2]; shape.seams.len()];
        let mut ends: Vec<SeamEnd> = Vec::new();
        for (seam, Seam { center_line, .. }) in shape.seams.iter().enumerate() {
            let places =
                if center_line.closed { [None; 2] } else { [center_line.start(), center_line.end()] };
            let places = places.into_iter().enumerate();
            ends.extend(places.filter_map(|(side, place)| Some(SeamEnd { seam, side, place: place? })));
        }
        if ends.len() > 2 || shape.seams.len() > 1 {
            let segments = Segments::new(shape.seams.iter().map(|seam| &seam.center_line));
            for SeamEnd { seam, side, .. } in &ends {
                let path = &shape.seams[*seam].center_line;
                joined[*seam][*side] = segments.has_joint(*seam, path, *side == 0, reach);
            }
        }
        ends.retain(|end| shape.seams[end.seam].role == Role::Boundary && !joined[end.seam][end.side]);
        Self { joined, mouths: mouths(shape, &ends) }
    }

    /// Whether an end of the seam number `seam` along `path` that lies on another band is within `reach` mm of `p`.
    fn are_at(&self, p: Point, seam: usize, path: &Path, reach: f64) -> bool {
        let ends = [path.start(), path.end()].into_iter().zip(self.joined[seam]);
        let mut joined_ends = ends.filter(|(_, joined)| *joined).filter_map(|(end, _)| end);
        joined_ends.any(|end| end.distance(p) <= reach)
    }

    /// Whether an end of a seam lies on another band or at a port.
    pub(super) fn is_shut(&self, seam: usize, side: usize) -> bool {
        self.joined[seam][side] || self.mouths.iter().any(|mouth| mouth.seams.contains(&(seam, side)))
    }

    /// The width between the bands at a port, mm.
    pub(super) fn width(&self, shape: &SealedShape, port: usize) -> Option<f64> {
        let mouth = self.mouths.iter().find(|mouth| mouth.port == port)?;
        Some(mouth.ends[0].distance(mouth.ends[1]) - shape.band)
    }
}

/// A pair of free ends beside a port.
struct EndPair {
    ends: [usize; 2],
    /// How far the middle between the ends lies from the port, mm.
    distance: f64,
    /// How far the pair is from one as far apart as the bands at the port are, mm.
    misfit: f64,
}

/// Pairs of free ends with a port between them, in the middle of two as far apart as its bands are.
///
/// The two ends of one seam are side by side in `free`, and are found by their middle; ends of two seams by their places. Where ports are
/// near each other, the seam between two of them has its middle near to both: the width of the pair tells.
fn mouths(shape: &SealedShape, free: &[SeamEnd]) -> Vec<MouthEnds> {
    let index = BoxIndex::new(free.iter().map(|end| Bounds::of_points([end.place])));
    let middles = free.windows(2).map(|pair| Bounds::of_points([pair[0].place.midpoint(pair[1].place)]));
    let middle_index = BoxIndex::new(middles);
    let mut is_taken = vec![false; free.len()];
    let mut mouths = Vec::new();
    for (number, Port { at: port, width }) in shape.ports.iter().enumerate() {
        let distance_apart = width + shape.band;
        let reach = distance_apart.max(LONGEST_OVERRUN);
        let zone = Bounds::of_points([*port]).outset(reach);
        let neighbours = middle_index.overlapping(&zone).into_iter().map(|i| [i, i + 1]);
        let of_one_seam = neighbours.filter(|[i, j]| free[*i].seam == free[*j].seam);
        let near_ends = index.overlapping(&zone.outset(reach));
        let of_two_seams = near_ends.iter().flat_map(|i| near_ends.iter().map(move |j| [*i, *j]));
        let pair = |ends: [usize; 2]| {
            let [a, b] = ends.map(|end| free[end].place);
            let distance = a.midpoint(b).distance(*port);
            EndPair { ends, distance, misfit: distance + (a.distance(b) - distance_apart).abs() }
        };
        let best = of_one_seam
            .chain(of_two_seams.filter(|[i, j]| i < j))
            .filter(|[i, j]| !is_taken[*i] && !is_taken[*j])
            .map(pair)
            .filter(|pair| pair.distance <= reach)
            .min_by(|a, b| a.misfit.total_cmp(&b.misfit));
        if let Some(EndPair { ends: [i, j], .. }) = best {
            (is_taken[i], is_taken[j]) = (true, true);
            let ends = [&free[i], &free[j]];
            mouths.push(MouthEnds {
                port: number,
                seams: ends.map(|end| (end.seam, end.side)),
                ends: ends.map(|end| end.place),
            });
        }
    }
    mouths
}

/// Whether the band of a seam other than number `seam` covers `p`. Ends of one seam that only touch each other are sealed nowhere twice,
/// unless such a band goes over them.
pub(super) fn is_under_another(shape: &SealedShape, seam: usize, p: Point) -> bool {
    let reach = shape.band / 2.0 + SLACK;
    let mut seams = shape.seams.iter().enumerate();
    seams.any(|(number, other)| number != seam && other.center_line.distance(p) <= reach)
}

/// The crossings of seams, except where one ends on the other: their places by pairs of seams, the same twice for one with itself.
pub(super) fn meetings(shape: &SealedShape, joints: &Joints) -> BTreeMap<[usize; 2], Vec<Point>> {
    let segments = Segments::new(shape.seams.iter().map(|seam| &seam.center_line));
    let reach = shape.band / 2.0 + SLACK;
    let mut meetings: BTreeMap<[usize; 2], Vec<Point>> = BTreeMap::new();
    for (i, part) in segments.list.iter().enumerate() {
        let path = &shape.seams[part.path].center_line;
        for j in segments.index.overlapping(&part.bounds).into_iter().filter(|j| *j > i) {
            let next = &segments.list[j];
            let pair = [part.path, next.path];
            let is_round = path.closed && part.at == 0 && next.at == path.segments.len() - 1;
            if part.path == next.path && (next.at - part.at < 2 || is_round) {
                continue;
            }
            for p in intersections(&part.segment, &next.segment) {
                if pair.iter().all(|seam| !joints.are_at(p, *seam, &shape.seams[*seam].center_line, reach)) {
                    meetings.entry(pair).or_default().push(p);
                }
            }
        }
    }
    meetings
}
