//! Drawn curves as **pieces**: unbroken, finite, without segments of no length, none along another.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use crate::fault::{Repair, ShapeCode, ShapeFault, quoted};
use crate::sketch::DrawnCurve;
use geom::{BoxIndex, Path, Point, Segment, straight};

/// Segments shorter than this, and gaps narrower than this, are rounding, mm.
pub(super) const NOTHING: f64 = 1e-9;
/// Segments shorter than this come from the rounding of a file's numbers, and are too short for the decimals of an output, mm.
const CRUMB: f64 = 1e-5;
/// Coordinates beyond this are an error of a drawing, mm.
const FAR: f64 = 1e6;

/// Largest distance of a chord from its arc of kilometres, mm: half of the default `path`, as readers of files take.
const CHORD: f64 = 5e-4;
/// Chords of one curve at most.
const MOST_CHORDS: usize = 100_000;

/// An unbroken part of a drawn curve.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// The part.
    pub path: Path,
    /// The number of its curve.
    pub source: usize,
}

/// The pieces of `drawn`, in its order.
pub(super) fn pieces(
    drawn: &[DrawnCurve],
    repairs: &mut Vec<Repair>,
    faults: &mut Vec<ShapeFault>,
) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (source, DrawnCurve { name, path }) in drawn.iter().enumerate() {
        let names = vec![name.clone()];
        let ends = path.segments.iter().flat_map(|segment| [segment.start(), segment.end()]);
        let mut ends = ends.chain(path.segments.iter().map(|segment| segment.point(0.5)));
        if !ends.all(|p| p.x.abs() <= FAR && p.y.abs() <= FAR) {
            let what = format!("{} has a coordinate beyond {FAR} mm", quoted(&names));
            let text = (what, "draw it near the origin");
            let code = ShapeCode::NotFinite;
            faults.push(ShapeFault::new(code, &names, Point::ORIGIN, text, [f64::NAN, FAR]));
            continue;
        }
        let solid = path.segments.iter().filter(|segment| segment.length() > NOTHING);
        let solid = Path { segments: solid.copied().collect(), closed: path.closed };
        if let Some(first) = path.segments.iter().find(|segment| segment.length() <= NOTHING) {
            let count = path.segments.len() - solid.segments.len();
            let what = format!("{count} segments of no length in {} dropped", quoted(&names));
            repairs.push(Repair { place: first.start(), what, names });
        }
        pieces.extend(unbroken(without_crumbs(chorded(solid)), source));
    }
    pieces
}

/// The path with chords in place of its arcs of kilometres, whose centres are too far away for exact offsets.
fn chorded(path: Path) -> Path {
    if !path.segments.iter().any(is_of_kilometres) {
        return path;
    }
    let mut segments = Vec::with_capacity(path.segments.len());
    for segment in &path.segments {
        let ends = [segment.start(), segment.end()];
        let has_chords = match segment {
            Segment::Arc(arc) if is_of_kilometres(segment) => {
                straight::push_arc(arc, ends, CHORD, MOST_CHORDS, &mut segments)
            }
            _ => false,
        };
        if !has_chords {
            segments.push(*segment);
        }
    }
    Path { segments, closed: path.closed }
}

/// Whether a segment is an arc that is read as chords.
fn is_of_kilometres(segment: &Segment) -> bool {
    matches!(segment, Segment::Arc(arc) if arc.radius > straight::LARGEST_RADIUS)
}

/// The path without crumbs: the segment after one begins where the one before it ends.
fn without_crumbs(path: Path) -> Path {
    if path.segments.iter().all(|segment| segment.length() > CRUMB) {
        return path;
    }
    let mut kept: Vec<Segment> = Vec::with_capacity(path.segments.len());
    for segment in &path.segments {
        let Some(at) = kept.last().map(Segment::end) else {
            kept.push(*segment);
            continue;
        };
        // From the last end that was kept, so that many crumbs are a way.
        if segment.length() > CRUMB || segment.end().distance(at) > CRUMB {
            let near = segment.start().distance(at) <= CRUMB;
            kept.push(if near { with_start(segment, at) } else { *segment });
        }
    }
    // The first one, and the last one of a closed path, may still be crumbs.
    let first = kept.len() > 1 && kept[0].length() <= CRUMB;
    if first {
        let crumb = kept.remove(0);
        kept[0] = with_start(&kept[0], crumb.start());
    }
    let start = kept.first().map(Segment::start);
    if let (true, Some(start), Some(last)) = (path.closed, start, kept.last_mut())
        && last.end().distance(start) <= CRUMB
    {
        *last = with_end(last, start);
    }
    Path { segments: kept, closed: path.closed }
}

/// The segment with another end; an arc keeps the turn between its ends.
pub(super) fn with_end(segment: &Segment, end: Point) -> Segment {
    if segment.end().distance(end) < 1e-11 {
        return *segment;
    }
    segment.between(segment.start(), end)
}

/// The segment with another start.
pub(super) fn with_start(segment: &Segment, start: Point) -> Segment {
    with_end(&segment.reversed(), start).reversed()
}

/// A path cut where a segment does not begin where the one before ends.
fn unbroken(path: Path, source: usize) -> Vec<Piece> {
    if path.segments.is_empty() {
        return Vec::new();
    }
    if path.largest_gap() <= NOTHING {
        return vec![Piece { path, source }];
    }
    let meets = |a: &Segment, b: &Segment| a.end().distance(b.start()) <= NOTHING;
    let mut runs: Vec<Vec<Segment>> = path.segments.chunk_by(meets).map(<[Segment]>::to_vec).collect();
    let ends = path.segments.last().zip(path.segments.first());
    if path.closed && ends.is_some_and(|(last, first)| meets(last, first)) {
        join_over_start(&mut runs);
    }
    runs.into_iter().map(|segments| Piece { path: Path::open(segments), source }).collect()
}

/// A quarter turn at most, or a line.
struct QuarterPart {
    segment: Segment,
    piece: usize,
    at: usize,
    from: f64,
    to: f64,
}

/// A curve drawn twice: the curve that was kept, the one that was removed, and a place.
type Doubled = ([usize; 2], Point);

/// Pairs of curves that are compared at most: a hundred thousand curves with two hundred others near to each.
const MOST_PAIRS: usize = 20_000_000;

/// Too many curves lie on or near each other for them to be compared; a place among them.
pub(super) struct Crowd(pub Point);

/// The pieces without the stretches within `join` of an earlier piece, or of an earlier part of their own.
///
/// # Errors
/// If more than [`MOST_PAIRS`] would have to be compared.
pub(super) fn without_doubles(pieces: Vec<Piece>, join: f64) -> Result<(Vec<Piece>, Vec<Doubled>), Crowd> {
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
    let mut removed: Vec<(usize, usize, f64, f64)> = Vec::new();
    let mut doubled: Vec<Doubled> = Vec::new();
    let mut remove = |i: usize, j: usize, (a, b): (f64, f64)| {
        let part = &parts[i];
        let scale = part.to - part.from;
        removed.push((part.piece, part.at, part.from + a * scale, part.from + b * scale));
        let sources = [pieces[parts[j].piece].source, pieces[part.piece].source];
        if !doubled.iter().rev().take(64).any(|(known, _)| *known == sources) {
            doubled.push((sources, part.segment.point(f64::midpoint(a, b))));
        }
    };
    for (i, j) in copies {
        remove(i, j, (0.0, 1.0));
    }
    let mut pairs = 0;
    for (number, i) in single.iter().enumerate() {
        let part = &parts[*i];
        let _ = index.any(&part.segment.bounds().grown(join), |other| {
            pairs += 1;
            if other >= number || pairs > MOST_PAIRS {
                return pairs > MOST_PAIRS;
            }
            let j = single[other];
            let along = shared(&part.segment, &parts[j].segment, join);
            if let Some(along) = along {
                remove(*i, j, along);
            }
            along == Some((0.0, 1.0))
        });
        if pairs > MOST_PAIRS {
            return Err(Crowd(part.segment.start()));
        }
    }
    if removed.is_empty() {
        return Ok((pieces, doubled));
    }
    doubled.sort_by_key(|(sources, _)| *sources);
    doubled.dedup_by_key(|(sources, _)| *sources);
    removed.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
    let kept = pieces.into_iter().enumerate().flat_map(|(number, piece)| {
        let from = removed.partition_point(|cut| cut.0 < number);
        let to = removed.partition_point(|cut| cut.0 <= number);
        if from == to { vec![piece] } else { rest(&piece, &removed[from..to], 2.0 * join) }
    });
    Ok((kept.collect(), doubled))
}

/// The numbers of the parts that copy no earlier one, and of each copy with the first one that it copies: thousands of copies are not
/// compared with each other.
fn without_copies(parts: &[QuarterPart]) -> (Vec<usize>, Vec<(usize, usize)>) {
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
            Entry::Occupied(entry) => copies.push((i, *entry.get())),
        }
    }
    (single, copies)
}

/// The parts of a segment that turn by a quarter turn at most, each with the fractions where it begins and ends.
pub(super) fn quarters(segment: &Segment) -> impl Iterator<Item = (Segment, f64, f64)> {
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
pub(super) fn shared(s: &Segment, t: &Segment, join: f64) -> Option<(f64, f64)> {
    let (a, b) = (s.nearest_fraction(t.start()), s.nearest_fraction(t.end()));
    let (a, b) = (a.min(b), a.max(b));
    let length = (b - a) * s.length();
    if length <= NOTHING {
        return None;
    }
    // Neighbours of a fine chain are near to each other, but not along each other.
    let near = join.min(length / 4.0);
    let along = (0..=4).all(|k| t.distance(s.point(a + (b - a) * f64::from(k) / 4.0)) <= near);
    along.then_some((a, b))
}

/// The remainder of a piece without the stretches `cuts` of its segments (sorted), and without crumbs of at most `crumb` mm.
fn rest(piece: &Piece, cuts: &[(usize, usize, f64, f64)], crumb: f64) -> Vec<Piece> {
    let mut runs: Vec<Vec<Segment>> = vec![Vec::new()];
    let mut cut_at_start = false;
    for (at, segment) in piece.path.segments.iter().enumerate() {
        let length = segment.length();
        let mut from = 0.0;
        let own = cuts.partition_point(|cut| cut.1 < at)..cuts.partition_point(|cut| cut.1 <= at);
        for (_, _, a, b) in &cuts[own] {
            if (a - from) * length > NOTHING {
                push(&mut runs, segment.part(from, *a));
            }
            cut_at_start |= at == 0 && *a * length <= NOTHING;
            from = from.max(*b);
            if runs.last().is_some_and(|run| !run.is_empty()) {
                runs.push(Vec::new());
            }
        }
        if (1.0 - from) * length > NOTHING {
            push(&mut runs, if from > 0.0 { segment.part(from, 1.0) } else { *segment });
        }
    }
    // A closed piece goes on over its start.
    if piece.path.closed && !cut_at_start {
        join_over_start(&mut runs);
    }
    runs.into_iter()
        .map(|segments| Piece { path: Path::open(segments), source: piece.source })
        .filter(|piece| piece.path.length() > crumb)
        .collect()
}

/// Puts the first of several runs behind the last.
fn join_over_start(runs: &mut Vec<Vec<Segment>>) {
    if runs.len() > 1 {
        let first = runs.remove(0);
        runs.last_mut().into_iter().for_each(|last| last.extend(first.iter()));
    }
}

fn push(runs: &mut [Vec<Segment>], segment: Segment) {
    if let Some(run) = runs.last_mut() {
        run.push(segment);
    }
}
