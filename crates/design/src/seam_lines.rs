//! How every seam of a piece is sealed: by which process, and along which lines.
//!
//! A band that is wider than the tool's tip is sealed along several parallel **lines**, spaced evenly, so that the outer ones end
//! where the band ends.

use cavalier_contours::polyline::{PlineSource, PlineSourceMut};

use crate::{Refusal, RefusalCode};
use geom::Path;
use sealed::{Seam, of_polyline, polyline};
use spec::units::Readable;
use spec::{SealProcess, key};

/// The sealing of one seam of a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct SeamLines {
    /// Name of its process.
    pub process: String,
    /// The lines of its band from the right side to the left: one along the centre line, or several beside it.
    pub lines: Vec<Seam>,
}

impl SeamLines {
    /// The lines of `seam`, sealed by `process`.
    ///
    /// # Errors
    /// If a line beside the centre line falls apart: the seam bends more sharply than the line is far from it.
    pub(super) fn new(seam: &Seam, process: &SealProcess) -> Result<Self, Refusal> {
        let offsets = process.seal.line_offsets();
        let line = |offset: &f64| {
            let center_line =
                parallel(&seam.center_line, *offset).ok_or_else(|| fallen_apart(seam, process, *offset))?;
            let overlap = seam.overlap.min(0.5 * center_line.length());
            Ok(Seam { center_line, overlap, ..seam.clone() })
        };
        let lines = offsets.iter().map(line).collect::<Result<Vec<Seam>, Refusal>>()?;
        Ok(Self { process: process.name.clone(), lines })
    }
}

fn fallen_apart(seam: &Seam, process: &SealProcess, offset: f64) -> Refusal {
    let name = if seam.name.is_empty() { "the seam" } else { &seam.name };
    let count = process.seal.line_count();
    let fault = format!(
        "of {count} lines of {name} one would lie {} mm beside the centre line, where it falls apart",
        Readable(offset.abs())
    );
    let remedy = "a wider `tip`, rounder corners, or a narrower band";
    Refusal::new(key::seal::TIP, RefusalCode::LinesFallApart, fault, remedy)
}

/// The path `distance` mm to the left of `path`, with a start beside that of `path`; `None` if it is none, or more than one.
fn parallel(path: &Path, distance: f64) -> Option<Path> {
    if distance == 0.0 {
        return Some(path.clone());
    }
    let mut line = polyline(path);
    if !path.closed {
        let end = path.end()?;
        line.add(end.x, end.y, 0.0);
        line.set_is_closed(false);
    }
    let mut parallels = line.parallel_offset(distance).into_iter();
    let contour = of_polyline(&parallels.next().filter(|_| parallels.next().is_none())?);
    if !path.closed {
        return Some(Path::open(contour.segments));
    }
    let contour = if (contour.area() > 0.0) == (path.area() > 0.0) { contour } else { return None };
    let start = contour.nearest(path.start()?)?;
    Some(contour.starting_at(start.s))
}
