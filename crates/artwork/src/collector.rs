//! The drawing as it grows: figures, notes, faults, and the bounds of work.

use geom::{Path, Point, Segment};

use crate::affine::Affine;
use crate::piece::Piece;
use crate::{Drawing, Element, Fault, Figure, Note, Options, Place, Weight};

/// Largest absolute coordinate, mm: a kilometre. Beyond it arcs of a drawing in `f64` would lose the nanometre.
pub(crate) const FARTHEST: f64 = 1e6;
/// The text of the note on a curve without length.
pub const NO_LENGTH: &str = "It has no length; it is read as a point.";
/// Distance up to which two ends are the same point, mm: rounding of sums of coordinates, not a gap of the drawing.
const SAME: f64 = 1e-9;
/// Most notes and faults that are kept; their number is bounded by the file otherwise.
const MOST_NOTES: usize = 20_000;
const MOST_FAULTS: usize = 100;

/// Reading ends here, since a limit is exceeded; the fault is recorded.
#[derive(Debug)]
pub(crate) struct Stop;

/// A chain of pieces in the coordinates of the file.
#[derive(Debug, Default)]
pub(crate) struct Chain {
    /// The pieces, each from the end of the one before.
    pub(crate) pieces: Vec<Piece>,
    /// Whether the file closes it.
    pub(crate) closed: bool,
    /// First point, for a chain without length.
    pub(crate) start: Point,
}

impl Chain {
    /// A single piece.
    pub(crate) fn of(piece: Piece, start: Point) -> Self {
        Self { pieces: vec![piece], closed: false, start }
    }
}

/// Collects the elements and faults of a reader.
pub(crate) struct Collector<'o> {
    pub(crate) options: &'o Options,
    pub(crate) drawing: Drawing,
    faults: Vec<Fault>,
    segments: usize,
    visits: usize,
    text: usize,
    dropped: usize,
}

impl<'o> Collector<'o> {
    pub(crate) fn new(options: &'o Options) -> Self {
        let drawing = Drawing { unit_mm: 1.0, ..Drawing::default() };
        Self { options, drawing, faults: Vec::new(), segments: 0, visits: 0, text: 0, dropped: 0 }
    }

    /// The drawing, or all faults.
    pub(crate) fn finish(mut self) -> Result<Drawing, Vec<Fault>> {
        if !self.faults.is_empty() {
            return Err(self.faults);
        }
        if self.dropped > 0 {
            let text = format!("{} more remarks are left out.", self.dropped);
            self.drawing.notes.push(Note { weight: Weight::Lost, place: Place::default(), text });
        }
        Ok(self.drawing)
    }

    /// Counts a node or an entity.
    pub(crate) fn visit(&mut self) -> Result<(), Stop> {
        self.visits += 1;
        let limit = self.options.limits.visits;
        self.bounded(self.visits, limit, "elements, copies included")
    }

    /// Counts bytes that are read again for each reference, or copied into names.
    pub(crate) fn text(&mut self, bytes: usize) -> Result<(), Stop> {
        self.text = self.text.saturating_add(bytes);
        let limit = self.options.limits.text;
        self.bounded(self.text, limit, "bytes of text, copies included")
    }

    fn bounded(&mut self, count: usize, limit: usize, what: &str) -> Result<(), Stop> {
        if count <= limit {
            return Ok(());
        }
        let text = format!("The drawing has more than {limit} {what}.");
        self.fault(Place::default(), text, "Remove what is not needed, or split the drawing.");
        Err(Stop)
    }

    pub(crate) fn fault(&mut self, place: Place, text: impl Into<String>, remedy: impl Into<String>) {
        if self.faults.len() < MOST_FAULTS {
            self.faults.push(Fault { place, text: text.into(), remedy: remedy.into() });
        }
    }

    pub(crate) fn note(&mut self, weight: Weight, place: Place, text: impl Into<String>) {
        if self.drawing.notes.len() < MOST_NOTES {
            self.drawing.notes.push(Note { weight, place, text: text.into() });
        } else {
            self.dropped += 1;
        }
    }

    /// Adds a point of the file.
    pub(crate) fn point(&mut self, place: Place, map: &Affine, point: Point) {
        let point = map.point(point);
        if point.x.abs().max(point.y.abs()) <= FARTHEST && !(point.x + point.y).is_nan() {
            self.push(place, Figure::Point(point));
        } else {
            self.far(place);
        }
    }

    /// Adds a chain of pieces of the file, mapped to mm.
    pub(crate) fn chain(&mut self, mut place: Place, map: &Affine, chain: &Chain) -> Result<(), Stop> {
        let mut segments = Vec::with_capacity(chain.pieces.len());
        let room = self.options.limits.segments.saturating_sub(self.segments);
        for piece in &chain.pieces {
            let piece = piece.mapped(map);
            // Written so that NaN is refused.
            if piece.extent() > FARTHEST {
                self.far(place);
                return Ok(());
            }
            if !piece.append(self.options.tolerance, room, &mut segments) {
                let limit = self.options.limits.segments;
                return self.bounded(limit + 1, limit, "lines and arcs");
            }
        }
        self.segments += segments.len();
        let (Some(first), Some(last)) = (segments.first(), segments.last()) else {
            place.at = Some(map.point(chain.start));
            self.note(Weight::Information, place.clone(), NO_LENGTH);
            self.point(place, map, chain.start);
            return Ok(());
        };
        let (start, end) = (first.start(), last.end());
        let meets = start.distance(end) <= SAME;
        if chain.closed && !meets {
            segments.push(geom::Line::new(end, start).into());
        }
        let closed = chain.closed || meets && turns(&segments);
        self.push(place, Figure::Path(Path { segments, closed }));
        Ok(())
    }

    fn push(&mut self, place: Place, figure: Figure) {
        let Place { element, layers, own_names, line, .. } = place;
        self.drawing.elements.push(Element {
            id: element.unwrap_or_default(),
            layers,
            own_names,
            figure,
            line,
        });
    }

    fn far(&mut self, place: Place) {
        let text = format!("A coordinate is more than {FARTHEST} mm from the origin, or not a number.");
        self.fault(place, text, "Check the unit and the transforms, and move the drawing to the origin.");
    }
}

/// Whether a chain that ends where it starts encloses something: it has a length beyond rounding.
fn turns(segments: &[Segment]) -> bool {
    segments.iter().map(Segment::length).sum::<f64>() > 2.0 * SAME
}

/// The arc from `start` to `end` with a bulge, tan(sweep / 4), as a piece.
///
/// A bulge below 1e-8 is a line: it errs by at most 5e-9 of the chord, and the end of so large an arc would err by more.
pub(crate) fn bulged(start: Point, end: Point, bulge: f64) -> Piece {
    match geom::Arc::from_bulge(start, end, bulge).filter(|_| bulge.abs() >= 1e-8) {
        Some(arc) => Piece::arc(arc.center, arc.radius, arc.start_angle, arc.sweep),
        None => Piece::Line(start, end),
    }
}
