//! **Spines**: where fabric is as wide as a band, the centre lines along its two sides lie on each other, and the band seals it once.

use crate::clean::{Piece, shared};
use crate::join::network;
use geom::{BoxIndex, Path, Point, Segment};

/// A stretch that two parallels share, which run in opposite directions.
pub(super) struct SharedStretch {
    /// The numbers of the parallels.
    pub lines: [usize; 2],
    /// Where the stretch begins and ends on each, in the direction of the first.
    pub fractions: [[f64; 2]; 2],
    /// Where it begins and ends.
    pub ends: [Point; 2],
}

/// The spines of a closed edge.
#[derive(Default)]
pub(super) struct Spines {
    pub paths: Vec<Path>,
    /// The stretches of parallels that lie along them.
    pub shared: Vec<SharedStretch>,
}

impl Spines {
    /// The spines along the `parallels` of an edge, at `half` a band from it, that run within `join` of each other and `are_free`.
    /// One no longer than half a band is none: the band around its end seals it.
    pub(super) fn of(parallels: &[Segment], half: f64, join: f64, is_free: impl Fn(Point) -> bool) -> Self {
        let stretches = shared_stretches(parallels, join, &is_free);
        if stretches.is_empty() {
            return Self::default();
        }
        let pieces = stretches.iter().enumerate().map(|(source, SharedStretch { lines, fractions, .. })| {
            let [from, to] = fractions[0];
            Piece { path: Path::open(vec![parallels[lines[0]].part(from, to)]), source }
        });
        let edges = network(&pieces.collect::<Vec<_>>(), 2.0 * join).edges;
        let long = edges.into_iter().filter(|edge| edge.path.length() > half && !edge.path.closed);
        let (mut paths, mut is_shared) = (Vec::new(), vec![false; stretches.len()]);
        for edge in long {
            edge.sources.iter().for_each(|source| is_shared[*source] = true);
            paths.push(trimmed(&trimmed(&edge.path, &is_free).reversed(), &is_free).reversed());
        }
        let kept = stretches.into_iter().zip(is_shared).filter(|(_, is_shared)| *is_shared);
        Self { paths, shared: kept.map(|(stretch, _)| stretch).collect() }
    }
}

/// The path up to the last place that `is_free`, halved up to a rounding: parallels go on into the end of a slot.
fn trimmed(path: &Path, is_free: &impl Fn(Point) -> bool) -> Path {
    let length = path.length();
    let is_free_at = |s: f64| path.point_at(s).is_some_and(is_free);
    if is_free_at(length) {
        return path.clone();
    }
    let (mut free, mut covered) = (length / 2.0, length);
    for _ in 0..50 {
        let middle = f64::midpoint(free, covered);
        *(if is_free_at(middle) { &mut free } else { &mut covered }) = middle;
    }
    path.part(0.0, free)
}

/// The stretches that two of the `parallels` share, each once.
fn shared_stretches(
    parallels: &[Segment],
    join: f64,
    is_free: &impl Fn(Point) -> bool,
) -> Vec<SharedStretch> {
    let index = BoxIndex::new(parallels.iter().map(Segment::bounds));
    let mut stretches = Vec::new();
    for (i, line) in parallels.iter().enumerate() {
        index.visit(&line.bounds().grown(join), |j| {
            let other = &parallels[j];
            let Some((from, to)) = (j < i).then(|| shared(line, other, join)).flatten() else { return };
            let middle = line.point(f64::midpoint(from, to));
            let tangents = [line, other].map(|side| side.tangent(side.nearest_fraction(middle)));
            if tangents[0].dot(tangents[1]) < 0.0 && is_free(middle) {
                let ends = [line.point(from), line.point(to)];
                let fractions = [[from, to], ends.map(|end| other.nearest_fraction(end))];
                stretches.push(SharedStretch { lines: [i, j], fractions, ends });
            }
        });
    }
    stretches
}
