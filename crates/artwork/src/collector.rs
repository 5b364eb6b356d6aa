//! The drawing as it grows: figures, notes, faults, and the bounds of work.

use geom::{Path, Point, Segment};

use crate::affine::Affine;
use crate::piece::Piece;
use crate::{Artwork, AssumedUnit, Element, Fault, Figure, Note, Options, Place, Unit, Weight};

/// Largest absolute coordinate, mm: a kilometre. Beyond it arcs of a drawing in `f64` would lose the nanometre.
pub(crate) const FARTHEST: f64 = 1e6;
/// The text of the note on a curve without length.
pub const NO_LENGTH: &str = "It has no length; it is read as a point.";
/// The text of the note on figures without paint.
const UNSEEN: &str = "It has no visible stroke and no visible fill, and is left out.";
/// Distance up to which two ends are the same point, mm: rounding of sums of coordinates, not a gap of the drawing.
const SAME: f64 = 1e-9;
/// Most notes that are kept; their number is bounded by the file otherwise.
const MOST_NOTES: usize = 20_000;
/// Most faults of elements; beyond them the file is refused.
const MOST_FAULTS: usize = 2_000;
/// Most of them that are listed for a file that is refused.
const MOST_LISTED: usize = 100;

/// Reading ends here, since a limit is exceeded; the fault is recorded.
#[derive(Debug)]
pub(crate) struct ReadingStop;

/// A chain of pieces in the coordinates of the file.
#[derive(Debug, Default)]
pub(crate) struct CurveChain {
    /// The pieces, each from the end of the one before.
    pub(crate) pieces: Vec<Piece>,
    /// Whether the file closes it.
    pub(crate) closed: bool,
    /// First point, for a chain without length.
    pub(crate) start: Point,
}

impl CurveChain {
    /// A single piece.
    pub(crate) fn single(piece: Piece, start: Point) -> Self {
        Self { pieces: vec![piece], closed: false, start }
    }
}

/// Collects the elements and faults of a reader.
pub(crate) struct Collector<'o> {
    pub(crate) options: &'o Options,
    pub(crate) drawing: Artwork,
    /// The faults of the file as a whole.
    refusals: Vec<Fault>,
    /// Numbers and places of the elements without a visible stroke and fill.
    unseen: Vec<(usize, Place)>,
    segments: usize,
    visits: usize,
    text: usize,
    dropped: usize,
}

impl<'o> Collector<'o> {
    pub(crate) fn new(options: &'o Options) -> Self {
        let drawing = Artwork { unit_mm: 1.0, ..Artwork::default() };
        Self {
            options,
            drawing,
            refusals: Vec::new(),
            unseen: Vec::new(),
            segments: 0,
            visits: 0,
            text: 0,
            dropped: 0,
        }
    }

    /// The drawing, or all faults.
    pub(crate) fn finish(mut self) -> Result<Artwork, Vec<Fault>> {
        if !self.refusals.is_empty() {
            let mut faults = self.drawing.faults;
            faults.truncate(MOST_LISTED);
            faults.append(&mut self.refusals);
            return Err(faults);
        }
        self.leave_out_unseen();
        if self.dropped > 0 {
            let text = format!("{} more remarks are left out.", self.dropped);
            self.drawing.notes.push(Note {
                weight: Weight::Lost,
                place: Place::default(),
                others: Vec::new(),
                text,
            });
        }
        Ok(self.drawing)
    }

    /// Counts a node or an entity.
    pub(crate) fn visit(&mut self) -> Result<(), ReadingStop> {
        self.visits += 1;
        let limit = self.options.limits.visits;
        self.bounded(self.visits, limit, "elements, copies included")
    }

    /// Counts bytes that are read again for each reference, or copied into names.
    pub(crate) fn text(&mut self, bytes: usize) -> Result<(), ReadingStop> {
        self.text = self.text.saturating_add(bytes);
        let limit = self.options.limits.text;
        self.bounded(self.text, limit, "bytes of text, copies included")
    }

    fn bounded(&mut self, count: usize, limit: usize, items: &str) -> Result<(), ReadingStop> {
        if count <= limit {
            return Ok(());
        }
        let text = format!("The drawing has more than {limit} {items}.");
        self.refuse(Place::default(), text, "Remove what is not needed, or split the drawing.");
        Err(ReadingStop)
    }

    /// Records a fault for which the file is not read.
    pub(crate) fn refuse(&mut self, place: Place, text: impl Into<String>, remedy: impl Into<String>) {
        self.refusals.push(Fault { place, text: text.into(), remedy: remedy.into() });
    }

    /// Records a fault of an element, which is left out.
    pub(crate) fn fault(&mut self, place: Place, text: impl Into<String>, remedy: impl Into<String>) {
        if self.drawing.faults.len() < MOST_FAULTS {
            self.drawing.faults.push(Fault { place, text: text.into(), remedy: remedy.into() });
        } else if self.refusals.is_empty() {
            let text = format!("The drawing has more than {MOST_FAULTS} faulty elements.");
            self.refuse(Place::default(), text, "Export it again.");
        }
    }

    /// Takes a unit that the file does not state, for a reason.
    pub(crate) fn assume(&mut self, unit: Unit, reason: impl Into<String>) {
        self.drawing.assumed = Some(AssumedUnit { unit, reason: reason.into() });
    }

    /// Notes that a thing is left out, together with others of the same weight and text.
    pub(crate) fn note_alike(&mut self, weight: Weight, place: Place, text: &str) {
        let equal_note =
            self.drawing.notes.iter_mut().find(|note| note.weight == weight && note.text == text);
        match equal_note {
            Some(note) => note.others.push(place),
            None => self.note(weight, place, text),
        }
    }

    /// Records that the last element has no visible stroke and fill.
    pub(crate) fn mark_unseen(&mut self, place: Place) {
        self.unseen.push((self.drawing.elements.len() - 1, place));
    }

    /// The elements from number `first` on that can be seen.
    pub(crate) fn seen_elements(&self, first: usize) -> impl Iterator<Item = &Element> {
        let start = self.unseen.partition_point(|(number, _)| *number < first);
        let unseen = self.unseen[start..].iter().map(|(number, _)| *number);
        let mut unseen = unseen.peekable();
        let numbered = self.drawing.elements.iter().enumerate().skip(first);
        numbered.filter(move |(number, _)| unseen.next_if_eq(number).is_none()).map(|(_, element)| element)
    }

    /// Leaves out the elements that cannot be seen, unless no other one can.
    fn leave_out_unseen(&mut self) {
        let unseen = std::mem::take(&mut self.unseen);
        if unseen.len() == self.drawing.elements.len() && !unseen.is_empty() {
            let text = "No figure has a visible stroke or fill; all are read.";
            return self.note(Weight::Information, Place::default(), text);
        }
        let mut numbers = unseen.iter().map(|(number, _)| *number).peekable();
        let mut number = 0;
        self.drawing.elements.retain(|_| {
            number += 1;
            numbers.next_if_eq(&(number - 1)).is_none()
        });
        for (_, place) in unseen {
            self.note_alike(Weight::Hidden, place, UNSEEN);
        }
    }

    pub(crate) fn note(&mut self, weight: Weight, place: Place, text: impl Into<String>) {
        if self.drawing.notes.len() < MOST_NOTES {
            self.drawing.notes.push(Note { weight, place, others: Vec::new(), text: text.into() });
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
            self.refuse_coordinate(place);
        }
    }

    /// Adds a chain of pieces of the file, mapped to mm.
    pub(crate) fn chain(
        &mut self,
        mut place: Place,
        map: &Affine,
        chain: &CurveChain,
    ) -> Result<(), ReadingStop> {
        let mut segments = Vec::with_capacity(chain.pieces.len());
        let room = self.options.limits.segments.saturating_sub(self.segments);
        for piece in &chain.pieces {
            let piece = piece.mapped(map);
            // Written so that NaN is refused.
            if piece.extent() > FARTHEST {
                self.refuse_coordinate(place);
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
        let is_closed = start.distance(end) <= SAME;
        if chain.closed && !is_closed {
            segments.push(geom::Line::new(end, start).into());
        }
        let closed = chain.closed || self.options.closes && is_closed && turns(&segments);
        self.push(place, Figure::Path(Path { segments, closed }));
        Ok(())
    }

    fn push(&mut self, place: Place, figure: Figure) {
        let Place { element, layers, own_names, colour, line, .. } = place;
        self.drawing.elements.push(Element {
            id: element.unwrap_or_default(),
            layers,
            own_names,
            colour,
            figure,
            line,
        });
    }

    fn refuse_coordinate(&mut self, place: Place) {
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
/// A bulge below 1e-12 is a line: it errs by at most 5e-13 of the chord.
pub(crate) fn bulged(start: Point, end: Point, bulge: f64) -> Piece {
    match geom::Arc::from_bulge(start, end, bulge).filter(|_| bulge.abs() >= 1e-12) {
        Some(arc) => Piece::arc(arc.center, arc.radius, arc.start_angle, arc.sweep).with_ends([start, end]),
        None => Piece::Line(start, end),
    }
}
