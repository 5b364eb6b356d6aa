//! Open curves that cross: each is split there.

use crate::clean::Piece;
use crate::segments::{PathSegment, Segments};
use geom::{Path, Point, intersections};

/// A place at which two open pieces, or two stretches of one, cross.
pub(super) struct PieceCrossing {
    /// The numbers of the pieces.
    pub pieces: [usize; 2],
    /// Length of each piece before the place, mm.
    pub along: [f64; 2],
    pub place: Point,
}

/// Most crossings that are looked for.
const MOST_CROSSINGS: usize = 10_000;

/// The crossings of open `pieces`. One within `join` of an end is a joint, not a crossing.
pub(super) fn crossings_of_open(pieces: &[Piece], join: f64) -> Vec<PieceCrossing> {
    let segments = Segments::of(pieces.iter().map(|piece| &piece.path));
    let lengths: Vec<f64> = pieces.iter().map(|piece| piece.path.length()).collect();
    let mut crossings: Vec<PieceCrossing> = Vec::new();
    for (i, one) in segments.list.iter().enumerate().filter(|(_, one)| !pieces[one.path].path.closed) {
        segments.index.visit(&one.bounds, |j| {
            let other = &segments.list[j];
            let follows = one.path == other.path && one.at.abs_diff(other.at) < 2;
            if j >= i || follows || pieces[other.path].path.closed || crossings.len() >= MOST_CROSSINGS {
                return;
            }
            for place in intersections(&one.segment, &other.segment) {
                let along = [one, other].map(|PathSegment { before, segment, .. }| {
                    before + segment.nearest_fraction(place) * segment.length()
                });
                let numbers = [one.path, other.path];
                let is_end = numbers.iter().zip(along).any(|(number, s)| s.min(lengths[*number] - s) <= join);
                let is_known =
                    |known: &PieceCrossing| known.pieces == numbers && known.place.distance(place) <= join;
                if !is_end && !crossings.iter().any(is_known) {
                    crossings.push(PieceCrossing { pieces: numbers, along, place });
                }
            }
        });
    }
    crossings
}

/// The pieces, split at `crossings`, without stubs of at most `2 join`.
pub(super) fn split_pieces(pieces: Vec<Piece>, crossings: &[PieceCrossing], join: f64) -> Vec<Piece> {
    let mut cuts: Vec<Vec<f64>> = vec![Vec::new(); pieces.len()];
    for PieceCrossing { pieces, along, .. } in crossings {
        cuts[pieces[0]].push(along[0]);
        cuts[pieces[1]].push(along[1]);
    }
    let mut parts: Vec<Piece> = Vec::with_capacity(pieces.len());
    for (piece, mut cuts) in pieces.into_iter().zip(cuts) {
        if cuts.is_empty() {
            parts.push(piece);
            continue;
        }
        cuts.extend([0.0, piece.path.length()]);
        cuts.sort_by(f64::total_cmp);
        let between = cuts.windows(2).filter(|pair| pair[1] - pair[0] > 2.0 * join);
        let part = |pair: &[f64]| -> Path { piece.path.part(pair[0], pair[1]) };
        parts.extend(between.map(|pair| Piece { path: part(pair), source: piece.source }));
    }
    parts
}
