//! Drawn curves as **pieces**: unbroken, finite, without segments of no length, none along another.

use crate::fault::{Noted, Repair, SealingNotes, ShapeCode, ShapeFault, quoted};
use crate::segments::{PathSegment, Segments};
use crate::sketch::DrawnCurve;
use geom::{Path, Point, Segment, intersections, straight};

/// Segments shorter than this, and gaps narrower than this, are rounding, mm.
pub(crate) const NOTHING: f64 = 1e-9;
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
pub(crate) struct Piece {
    /// The part.
    pub path: Path,
    /// The number of its curve.
    pub source: usize,
}

/// The pieces of `curves`, in their order. A curve that lies too far away is left out, with a fault.
pub(super) fn pieces(curves: &[DrawnCurve]) -> Noted<Vec<Piece>> {
    let mut notes = SealingNotes::default();
    let mut pieces = Vec::new();
    for (source, DrawnCurve { name, path }) in curves.iter().enumerate() {
        let names = vec![name.clone()];
        let ends = path.segments.iter().flat_map(|segment| [segment.start(), segment.end()]);
        let mut places = ends.chain(path.segments.iter().map(|segment| segment.point(0.5)));
        if !places.all(|p| p.x.abs() <= FAR && p.y.abs() <= FAR) {
            let finding = format!("{} has a coordinate beyond {FAR} mm", quoted(name));
            let fault =
                ShapeFault::new(ShapeCode::NotFinite, Point::ORIGIN, finding, "draw it near the origin");
            notes.faults.push(ShapeFault { names, allowed: FAR, ..fault });
            continue;
        }
        let solid = path.segments.iter().filter(|segment| segment.length() > NOTHING);
        let solid = Path { segments: solid.copied().collect(), closed: path.closed };
        if let Some(first) = path.segments.iter().find(|segment| segment.length() <= NOTHING) {
            let count = path.segments.len() - solid.segments.len();
            let finding = format!("{count} segments of no length in {} dropped", quoted(name));
            notes.repairs.push(Repair { names, place: first.start(), what: finding });
        }
        pieces.extend(unbroken(without_crumbs(chorded(solid)), source));
    }
    (pieces, notes)
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
///
/// A crumb is left out where it ends within a crumb's length of the last end that stays, so that many crumbs in a row are a way. Crumbs at
/// the start, and at the end of a closed path, are left out last.
fn without_crumbs(path: Path) -> Path {
    if path.segments.iter().all(|segment| segment.length() > CRUMB) {
        return path;
    }
    let mut segments: Vec<Segment> = Vec::with_capacity(path.segments.len());
    for segment in &path.segments {
        let Some(last_end) = segments.last().map(Segment::end) else {
            segments.push(*segment);
            continue;
        };
        if segment.length() > CRUMB || segment.end().distance(last_end) > CRUMB {
            let is_joined = segment.start().distance(last_end) <= CRUMB;
            segments.push(if is_joined { with_start(segment, last_end) } else { *segment });
        }
    }
    if segments.len() > 1 && segments[0].length() <= CRUMB {
        let crumb = segments.remove(0);
        segments[0] = with_start(&segments[0], crumb.start());
    }
    let start = segments.first().map(Segment::start);
    if let (true, Some(start), Some(last)) = (path.closed, start, segments.last_mut())
        && last.end().distance(start) <= CRUMB
    {
        *last = with_end(last, start);
    }
    Path { segments, closed: path.closed }
}

/// The segment with another end; an arc keeps the turn between its ends.
pub(crate) fn with_end(segment: &Segment, end: Point) -> Segment {
    if segment.end().distance(end) < 1e-11 {
        return *segment;
    }
    segment.with_ends(segment.start(), end)
}

/// The segment with another start.
pub(crate) fn with_start(segment: &Segment, start: Point) -> Segment {
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
    let mut runs: Vec<Vec<Segment>> = path.segments.chunk_by(do_meet).map(<[Segment]>::to_vec).collect();
    let ends = path.segments.last().zip(path.segments.first());
    if path.closed && ends.is_some_and(|(last, first)| do_meet(last, first)) {
        join_over_start(&mut runs);
    }
    runs.into_iter().map(|segments| Piece { path: Path::open(segments), source }).collect()
}

/// Whether segment `b` begins where `a` ends.
fn do_meet(a: &Segment, b: &Segment) -> bool {
    a.end().distance(b.start()) <= NOTHING
}

/// Puts the first of several runs behind the last.
pub(super) fn join_over_start(runs: &mut Vec<Vec<Segment>>) {
    if runs.len() > 1 {
        let first = runs.remove(0);
        runs.last_mut().into_iter().for_each(|last| last.extend(first.iter()));
    }
}

/// A place at which two open pieces, or two stretches of one, cross.
pub(super) struct PieceCrossing {
    /// The numbers of the pieces.
    pub pieces: [usize; 2],
    /// Length of each piece before the place, mm.
    stations: [f64; 2],
    pub place: Point,
}

/// Most crossings that are looked for.
const MOST_CROSSINGS: usize = 10_000;

/// The crossings of open `pieces`. One within `join` of an end is a joint, not a crossing.
pub(super) fn crossings_of_open(pieces: &[Piece], join: f64) -> Vec<PieceCrossing> {
    let segments = Segments::new(pieces.iter().map(|piece| &piece.path));
    let lengths: Vec<f64> = pieces.iter().map(|piece| piece.path.length()).collect();
    let mut crossings: Vec<PieceCrossing> = Vec::new();
    for (i, part) in segments.list.iter().enumerate().filter(|(_, part)| !pieces[part.path].path.closed) {
        segments.index.visit(&part.bounds, |j| {
            let other = &segments.list[j];
            let follows = part.path == other.path && part.at.abs_diff(other.at) < 2;
            if j >= i || follows || pieces[other.path].path.closed || crossings.len() >= MOST_CROSSINGS {
                return;
            }
            for place in intersections(&part.segment, &other.segment) {
                let stations = [part, other].map(|PathSegment { before, segment, .. }| {
                    before + segment.nearest_fraction(place) * segment.length()
                });
                let numbers = [part.path, other.path];
                let is_end =
                    numbers.iter().zip(stations).any(|(number, s)| s.min(lengths[*number] - s) <= join);
                let is_double = crossings.iter().any(|crossing: &PieceCrossing| {
                    crossing.pieces == numbers && crossing.place.distance(place) <= join
                });
                if !is_end && !is_double {
                    crossings.push(PieceCrossing { pieces: numbers, stations, place });
                }
            }
        });
    }
    crossings
}

/// The pieces, split at `crossings`, without stubs of at most `2 join`.
pub(super) fn split_pieces(pieces: Vec<Piece>, crossings: &[PieceCrossing], join: f64) -> Vec<Piece> {
    let mut cuts: Vec<Vec<f64>> = vec![Vec::new(); pieces.len()];
    for PieceCrossing { pieces, stations, .. } in crossings {
        cuts[pieces[0]].push(stations[0]);
        cuts[pieces[1]].push(stations[1]);
    }
    let mut parts: Vec<Piece> = Vec::with_capacity(pieces.len());
    for (piece, mut cuts) in pieces.into_iter().zip(cuts) {
        if cuts.is_empty() {
            parts.push(piece);
            continue;
        }
        cuts.extend([0.0, piece.path.length()]);
        cuts.sort_by(f64::total_cmp);
        let stretches = cuts.windows(2).filter(|pair| pair[1] - pair[0] > 2.0 * join);
        let part = |pair: &[f64]| Piece { path: piece.path.part(pair[0], pair[1]), source: piece.source };
        parts.extend(stretches.map(part));
    }
    parts
}
