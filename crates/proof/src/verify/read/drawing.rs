//! The content of a drawing file, whatever its format.

use std::collections::BTreeMap;

use crate::verify::Finding;
use geom::{Line, Path, Point, Segment};

/// Gaps up to this are rounding, not an opening: the files carry at least three decimals of a millimetre.
pub(in crate::verify) const JOIN: f64 = 1e-6;

/// The lines and arcs of a drawing file, in mm, X right and Y up, by layer (DXF) or group (SVG).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Width and height of the page, mm; DXF has none.
    pub page: Option<(f64, f64)>,
    /// The page's corner in the file's own coordinates, whose Y may run down; only SVG states it.
    pub corner: Option<(f64, f64)>,
    /// The layers in the order in which the file first draws on them, or opens a group for them.
    pub order: Vec<String>,
    /// The paths of each layer, in the order of the file; layers that hold no path are present and empty.
    pub layers: BTreeMap<String, Vec<Path>>,
    /// Layer and text of each label.
    pub texts: Vec<(String, String)>,
    /// Faults of the file itself.
    pub findings: Vec<Finding>,
}

impl Drawing {
    /// The paths on `layer`; none if it does not exist.
    pub fn layer(&self, layer: &str) -> &[Path] {
        self.layers.get(layer).map_or(&[], Vec::as_slice)
    }

    /// The paths on `layer`, to draw another one there.
    pub(in crate::verify) fn layer_mut(&mut self, layer: &str) -> &mut Vec<Path> {
        if self.order.iter().all(|known| known != layer) {
            self.order.push(layer.to_owned());
        }
        self.layers.entry(layer.to_owned()).or_default()
    }
}

/// Draws paths, segment after segment.
#[derive(Default)]
pub(super) struct PathPen {
    /// The paths that have ended.
    pub(super) paths: Vec<Path>,
    segments: Vec<Segment>,
    /// The beginning of the path; `None` if none has begun.
    pub(super) start: Option<Point>,
    pub(super) here: Point,
}

impl PathPen {
    /// Begins a path.
    pub(super) fn begin(&mut self, p: Point) {
        self.lift(false);
        (self.start, self.here) = (Some(p), p);
    }

    /// Adds a segment.
    pub(super) fn push(&mut self, segment: impl Into<Segment>, end: Point) {
        self.segments.push(segment.into());
        self.here = end;
    }

    /// Closes the path, with a line if its ends are farther apart than `join`, mm.
    pub(super) fn close(&mut self, join: f64) {
        let Some(start) = self.start else { return };
        if self.here.distance(start) > join {
            self.push(Line::new(self.here, start), start);
        }
        self.lift(true);
        self.here = start;
    }

    /// Ends the path.
    pub(super) fn lift(&mut self, closed: bool) {
        let segments = std::mem::take(&mut self.segments);
        if !segments.is_empty() {
            self.paths.push(Path { segments, closed });
        }
    }
}
