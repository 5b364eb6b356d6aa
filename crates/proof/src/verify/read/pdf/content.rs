//! The content of a PDF page: operators to lines and arcs.

use crate::verify::finding::quote;
use crate::verify::read::drawing::PathPen;
use crate::verify::read::pdf::object::{PdfObject, PdfScan};
use crate::verify::{Drawing, FindingCode, Findings};
use geom::{Arc, Bounds, Line, Path, Point, Segment};

/// Largest distance of a curve from the circle through its ends and its middle, mm, to be read as an arc.
const ROUND: f64 = 0.002;

/// The state that `q` saves.
#[derive(Clone, Copy)]
struct GraphicsState {
    /// Millimetres in a user unit: nothing but scaling and shifting is allowed.
    scale: f64,
    shift: (f64, f64),
    clip: Option<Bounds>,
    /// Width of strokes; `None` until it is set.
    width: Option<f64>,
    /// Grey level of strokes; `None` until it is set.
    gray: Option<f64>,
}

struct PdfPen<'a> {
    state: GraphicsState,
    saved: Vec<GraphicsState>,
    layers: Vec<String>,
    pen: PathPen,
    clipping: bool,
    page: PdfPage,
    findings: &'a mut Findings,
}

/// Reads a content stream whose user unit is `unit` mm.
pub(super) fn read(stream: &[u8], size: (f64, f64), unit: f64, findings: &mut Findings) -> PdfPage {
    let drawing = Drawing { page: Some(size), ..Drawing::default() };
    let mut pen = PdfPen {
        state: GraphicsState { scale: unit, shift: (0.0, 0.0), clip: None, width: None, gray: None },
        saved: Vec::new(),
        layers: Vec::new(),
        pen: PathPen::default(),
        clipping: false,
        page: PdfPage { size, drawing, ..PdfPage::default() },
        findings,
    };
    let mut scan = PdfScan::new(stream);
    let mut operands: Vec<f64> = Vec::new();
    let mut name = None;
    while let Some(object) = scan.object() {
        match object {
            PdfObject::Number(x) => operands.push(x),
            PdfObject::Name(text) => name = Some(text),
            PdfObject::Word(word) => {
                pen.operator(word, &operands, name.take());
                operands.clear();
            }
            _ => pen.refuse(FindingCode::UnknownWord, "an operand that is not a number", "numbers and names"),
        }
    }
    if !stream.get(scan.position()..).unwrap_or_default().iter().all(u8::is_ascii_whitespace) {
        let found = format!("junk at byte {} of a page", scan.position());
        pen.findings.add(FindingCode::BadPdf, found, "operators");
    }
    if !pen.saved.is_empty() || !pen.layers.is_empty() {
        pen.refuse(FindingCode::Truncated, "a page that ends within q or BMC", "Q and EMC");
    }
    pen.page
}

impl PdfPen<'_> {
    fn refuse(&mut self, code: FindingCode, found: &str, allowed: &str) {
        self.findings.add(code, found, allowed);
    }

    fn operator(&mut self, word: &str, operands: &[f64], name: Option<&str>) {
        if !matches!(word, "m" | "l" | "c" | "h") {
            self.page.operators.push(word.to_owned());
        }
        match (word, operands) {
            ("q", []) => self.saved.push(self.state),
            ("Q", []) => match self.saved.pop() {
                Some(state) => self.state = state,
                None => self.refuse(FindingCode::BadPdf, "Q without q", "pairs"),
            },
            ("cm", [a, b, c, d, e, f]) if *b == 0.0 && *c == 0.0 && a == d && *a > 0.0 => {
                let GraphicsState { scale, shift: (x, y), .. } = self.state;
                self.state.shift = (x + scale * e, y + scale * f);
                self.state.scale = scale * a;
            }
            ("cm", _) => {
                let found = format!("cm {operands:?}");
                self.refuse(FindingCode::Transform, &found, "scaling and shifting only");
            }
            ("BMC", []) => self.layers.push(name.unwrap_or_default().to_owned()),
            ("EMC", []) => drop(self.layers.pop()),
            ("w", [width]) => self.state.width = Some(*width),
            ("G", [gray]) => self.state.gray = Some(*gray),
            ("m", [x, y]) => self.pen.begin(self.point(*x, *y)),
            ("l", [x, y]) => self.line(self.point(*x, *y)),
            ("c", [ax, ay, bx, by, x, y]) => {
                self.curve(self.point(*ax, *ay), self.point(*bx, *by), self.point(*x, *y));
            }
            // Rounding to the file's quantum is not a side of its own.
            ("h", []) => self.pen.close(1e-3),
            ("re", [x, y, w, h]) => {
                for (word, x, y) in [("m", *x, *y), ("l", x + w, *y), ("l", x + w, y + h), ("l", *x, y + h)] {
                    self.operator(word, &[x, y], None);
                }
                self.operator("h", &[], None);
            }
            ("W", []) => self.clipping = true,
            ("n", []) => self.end(false),
            ("S", []) => self.end(true),
            _ => {
                let found = quote(&format!("{operands:?} {word}"));
                self.refuse(FindingCode::UnknownWord, &found, "q Q cm BMC EMC w G m l c h re W n S");
            }
        }
    }

    fn point(&self, x: f64, y: f64) -> Point {
        let GraphicsState { scale, shift, .. } = self.state;
        Point::new(shift.0 + scale * x, shift.1 + scale * y)
    }

    fn push(&mut self, segment: impl Into<Segment>, end: Point) {
        if self.pen.start.is_none() {
            self.refuse(FindingCode::BadPath, "a path that does not begin with m", "m first");
        }
        self.pen.push(segment, end);
    }

    fn line(&mut self, end: Point) {
        if self.pen.here.distance(end) > 0.0 {
            self.push(Line::new(self.pen.here, end), end);
        }
    }

    fn curve(&mut self, a: Point, b: Point, end: Point) {
        let from = self.pen.here;
        let at = |t: f64| {
            let s = 1.0 - t;
            let term = |p: f64, a: f64, b: f64, q: f64| {
                s * s * s * p + 3.0 * s * s * t * a + 3.0 * s * t * t * b + t * t * t * q
            };
            Point::new(term(from.x, a.x, b.x, end.x), term(from.y, a.y, b.y, end.y))
        };
        let middle = at(0.5);
        let chord = end - from;
        let sagitta = chord.normalized().cross(middle - from);
        let segment: Option<Segment> = if sagitta.abs() < 1e-6 {
            Some(Line::new(from, end).into())
        } else {
            // tan(sweep / 4) is the sagitta over half the chord; to the right of the chord is counterclockwise.
            Arc::from_bulge(from, end, -2.0 * sagitta / chord.length()).map(Segment::from)
        };
        let is_on = |segment: &Segment| [0.25, 0.5, 0.75].iter().all(|t| segment.distance(at(*t)) <= ROUND);
        match segment.filter(is_on) {
            Some(segment) => self.push(segment, end),
            None => {
                self.refuse(FindingCode::BadArc, "a curve that is not an arc of a circle", "lines and arcs");
            }
        }
    }

    /// Ends the path: it is stroked or not, and becomes the clip if `W` came before.
    fn end(&mut self, stroked: bool) {
        self.pen.lift(false);
        let paths = std::mem::take(&mut self.pen.paths);
        self.pen.start = None;
        if std::mem::take(&mut self.clipping) {
            let bounds = paths.iter().map(Path::bounds).fold(Bounds::EMPTY, Bounds::union);
            self.state.clip = Some(bounds);
        }
        if stroked {
            let layer = self.layers.last().cloned().unwrap_or_default();
            if let Some(clip) = self.state.clip
                && !self.page.clips.iter().any(|(name, known)| *name == layer && *known == clip)
            {
                self.page.clips.push((layer.clone(), clip));
            }
            self.page.strokes.push((layer.clone(), self.state.width, self.state.gray));
            self.page.drawing.layer_mut(&layer).extend(paths);
        } else if paths.len() != 1 {
            self.refuse(FindingCode::UnknownWord, "a path that is not drawn", "a clip, or a stroke");
        }
    }
}

/// One page of a PDF, in mm from its lower left corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PdfPage {
    /// Width and height.
    pub size: (f64, f64),
    /// The lines and curves, by marked content; those outside any are under "".
    pub drawing: Drawing,
    /// Layer, width in user units and grey of every stroke.
    pub strokes: Vec<(String, Option<f64>, Option<f64>)>,
    /// The operators that do not build paths, in order.
    pub operators: Vec<String>,
    /// The visible regions of every clipped layer.
    pub clips: Vec<(String, Bounds)>,
}
