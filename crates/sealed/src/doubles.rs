//! Curves that are **drawn twice**: a stretch along another curve is left out, and each stretch counts once.

use geom::order::{sort_by, sort_by_key};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use crate::fault::Crowd;
use crate::pieces::{NOTHING, Piece, join_over_start};
use geom::{BoxIndex, Path, Point, Segment};

/// Pairs of curves that are compared at most: a hundred thousand curves with two hundred others near to each.
const MOST_PAIRS: usize = 20_000_000;

/// Last doubled curves among which a pair of curves is looked for, before it is noted again.
const RECENT: usize = 64;

/// A quarter turn at most, or a line.
struct QuarterPart {
    segment: Segment,
    piece: usize,
    /// The number of its segment in the piece.
    at: usize,
    from: f64,
    to: f64,
}

/// A curve drawn twice.
pub(super) struct Doubled {
    /// The curve that stays, and the one that is left out.
    pub sources: [usize; 2],
    pub place: Point,
}

/// A stretch of a piece that is left out, by fractions of a segment.
struct RemovedStretch {
    piece: usize,
    /// The number of the segment in the piece.
    segment: usize,
    from: f64,
    to: f64,
}

/// What is left out of pieces.
#[derive(Default)]
struct Removal {
    stretches: Vec<RemovedStretch>,
    doubled: Vec<Doubled>,
}

impl Removal {
    /// Removes the part `fractions` of `part`, which lies along `other`.
    fn add(&mut self, part: &QuarterPart, other: &QuarterPart, fractions: [f64; 2], pieces: &[Piece]) {
        let scale = part.to - part.from;
        let [from, to] = fractions.map(|fraction| part.from + fraction * scale);
        self.stretches.push(RemovedStretch { piece: part.piece, segment: part.at, from, to });
        let sources = [other.piece, part.piece].map(|piece| pieces[piece].source);
        if !self.doubled.iter().rev().take(RECENT).any(|doubled| doubled.sources == sources) {
            let place = part.segment.point(f64::midpoint(fractions[0], fractions[1]));
            self.doubled.push(Doubled { sources, place });
        }
    }
}

/// The pieces without the stretches within `join` of an earlier piece, or of an earlier part of the same piece, and the curves that they
/// belong to.
///
/// Segments are compared in parts of a quarter turn at most: a part that lies along another from end to end is left out, else the
/// stretch along it. Equal copies are found by their bits first, since a drawing may have thousands.
///
/// # Errors
/// If more than [`MOST_PAIRS`] would have to be compared.
pub(crate) fn without_doubles(pieces: Vec<Piece>, join: f64) -> Result<(Vec<Piece>, Vec<Doubled>), Crowd> {
    let parts: Vec<QuarterPart> = pieces
        .iter()
        .enumerate()
        .flat_map(|(piece, Piece { path, .. })| {
            path.segments.iter().enumerate().flat_map(move |(at, segment)| {
                quarters(segment).map(move |(segment, from, to)| QuarterPart { segment, piece, at, from, to })
            })
        })
        .collect();
    let (single, copies) = without_copies(&parts);
    let index = BoxIndex::new(single.iter().map(|i| parts[*i].segment.bounds()));
    let mut removal = Removal::default();
    for [copy, first] in copies {
        removal.add(&parts[copy], &parts[first], [0.0, 1.0], &pieces);
    }
    let mut pairs = 0;
    for (number, i) in single.iter().enumerate() {
        let part = &parts[*i];
        let _ = index.any_overlapping(&part.segment.bounds().outset(join), |other| {
            pairs += 1;
            if other >= number || pairs > MOST_PAIRS {
                return pairs > MOST_PAIRS;
            }
            let other = &parts[single[other]];
            let fractions = shared(&part.segment, &other.segment, join);
            if let Some((from, to)) = fractions {
                removal.add(part, other, [from, to], &pieces);
            }
            fractions == Some((0.0, 1.0))
        });
        if pairs > MOST_PAIRS {
            return Err(Crowd(part.segment.start()));
        }
    }
    let Removal { mut stretches, mut doubled } = removal;
    if stretches.is_empty() {
        return Ok((pieces, doubled));
    }
    sort_by_key(&mut doubled, |doubled| doubled.sources);
    doubled.dedup_by_key(|doubled| doubled.sources);
    sort_by(&mut stretches, |a, b| {
        (a.piece, a.segment).cmp(&(b.piece, b.segment)).then(a.from.total_cmp(&b.from))
    });
    let remainder = pieces.into_iter().enumerate().flat_map(|(number, piece)| {
        let first = stretches.partition_point(|stretch| stretch.piece < number);
        let end = stretches.partition_point(|stretch| stretch.piece <= number);
        if first == end { vec![piece] } else { rest(&piece, &stretches[first..end], 2.0 * join) }
    });
    Ok((remainder.collect(), doubled))
}

/// The numbers of the parts that copy no earlier one, and of each copy with the first one that it copies: thousands of copies are not
/// compared with each other.
fn without_copies(parts: &[QuarterPart]) -> (Vec<usize>, Vec<[usize; 2]>) {
    let mut first = BTreeMap::new();
    let (mut single, mut copies) = (Vec::new(), Vec::new());
    for (i, QuarterPart { segment, .. }) in parts.iter().enumerate() {
        let places = [segment.start(), segment.point(0.5), segment.end()];
        let bits = places.map(|p| [p.x.to_bits(), p.y.to_bits()]);
        match first.entry(bits) {
            Entry::Vacant(entry) => {
                let _ = entry.insert(i);
                single.push(i);
            }
            Entry::Occupied(entry) => copies.push([i, *entry.get()]),
        }
    }
    (single, copies)
}

/// The parts of a segment that turn by a quarter turn at most, each with the fractions where it begins and ends.
pub(crate) fn quarters(segment: &Segment) -> impl Iterator<Item = (Segment, f64, f64)> {
    let count = match segment {
        Segment::Line(_) => 1,
        Segment::Arc(arc) => (1..8).find(|n| arc.sweep.abs() <= f64::from(*n) * 1.6).unwrap_or(8),
    };
    (0..count).map(move |i| {
        let (from, to) = (f64::from(i) / f64::from(count), f64::from(i + 1) / f64::from(count));
        (segment.part(from, to), from, to)
    })
}

/// The fractions of `s` between which it runs within `join` of `t`.
pub(crate) fn shared(s: &Segment, t: &Segment, join: f64) -> Option<(f64, f64)> {
    let (a, b) = (s.nearest_fraction(t.start()), s.nearest_fraction(t.end()));
    let (a, b) = (a.min(b), a.max(b));
    let length = (b - a) * s.length();
    if length <= NOTHING {
        return None;
    }
    // Neighbours of a fine chain are near to each other, but not along each other.
    let slack = join.min(length / 4.0);
    let is_along = (0..=4).all(|k| t.distance(s.point(a + (b - a) * f64::from(k) / 4.0)) <= slack);
    is_along.then_some((a, b))
}

/// The remainder of a piece without the stretches `removed` of its segments (sorted), and without crumbs of at most `crumb` mm.
///
/// The segments are walked in order, and each stretch begins a new run. A closed piece goes on over its start, unless it is cut there.
fn rest(piece: &Piece, removed: &[RemovedStretch], crumb: f64) -> Vec<Piece> {
    let mut runs: Vec<Vec<Segment>> = vec![Vec::new()];
    let mut is_cut_at_start = false;
    for (at, segment) in piece.path.segments.iter().enumerate() {
        let length = segment.length();
        let mut fraction = 0.0;
        let first = removed.partition_point(|stretch| stretch.segment < at);
        let end = removed.partition_point(|stretch| stretch.segment <= at);
        for stretch in &removed[first..end] {
            if (stretch.from - fraction) * length > NOTHING {
                push(&mut runs, segment.part(fraction, stretch.from));
            }
            is_cut_at_start |= at == 0 && stretch.from * length <= NOTHING;
            fraction = fraction.max(stretch.to);
            if runs.last().is_some_and(|run| !run.is_empty()) {
                runs.push(Vec::new());
            }
        }
        if (1.0 - fraction) * length > NOTHING {
            push(&mut runs, if fraction > 0.0 { segment.part(fraction, 1.0) } else { *segment });
        }
    }
    if piece.path.closed && !is_cut_at_start {
        join_over_start(&mut runs);
    }
    runs.into_iter()
        .map(|segments| Piece { path: Path::open(segments), source: piece.source })
        .filter(|piece| piece.path.length() > crumb)
        .collect()
}

/// Adds a segment to the last run.
fn push(runs: &mut [Vec<Segment>], segment: Segment) {
    if let Some(run) = runs.last_mut() {
        run.push(segment);
    }
}
