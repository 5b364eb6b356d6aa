//! Sheets of paper for a heat press: the separator of every piece, where it is cut out.
//!
//! Each separator has the registration holes of its piece around it. The sheet is laid on the pins that hold the fabric, and what is
//! left of it is lifted off: the separators stay in their places.

use crate::placement::{Placement, place, size_in_words};
use crate::{Design, PaperSeparator, PlacedPart, Refusal, RefusalCode, Refusals, SheetLayout};
use geom::{Bounds, Isometry};
use spec::units::{Length, tenths_up};
use spec::{Machine, MaskKind, PaperSize, Sheet, Spec, key};

/// One sheet of paper with its separators.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperSheet {
    /// Number of the sheet of paper, from 1.
    pub index: usize,
    /// Extent along X.
    pub width: f64,
    /// Extent along Y.
    pub height: f64,
    /// The separators on it, in the order of their pieces.
    pub separators: Vec<PlacedSeparator>,
}

/// One separator where it is cut out of paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSeparator {
    /// Number of its piece, from 1.
    pub piece: usize,
    /// From the piece's frame to that of the paper.
    pub placement: Isometry,
}

/// Free strip along the border of paper without a name, mm: rollers and clamps of plotters hold it there.
const MARGIN: f64 = 5.0;
/// Distance between separators with their holes, mm.
const GAP: f64 = 3.0;
/// Strip of paper around a registration hole, mm: less tears out on the pin.
const AROUND_HOLE: f64 = 3.0;

/// The sheets of paper for `design`; none where no paper goes between its sheets, or where each drawn piece has a file of its own.
///
/// # Errors
/// A separator that does not fit on the paper of `spec`, with the size that it needs.
pub(super) fn paper_sheets(
    spec: &Spec,
    machine: &Machine,
    design: &Design,
) -> Result<Vec<PaperSheet>, Refusals> {
    if spec.press.is_none() && !(spec.has_stars() && spec.mask.kind == MaskKind::Separator) {
        return Ok(Vec::new());
    }
    let placed = design.placed();
    let (places, sheets) = match spec.press.as_ref().and_then(|press| press.paper) {
        Some(paper) => nested(machine, design, paper)?,
        // Paper as large as the fabric lies as the pieces do.
        None => (placed.iter().map(|piece| (piece.sheet, piece.placement)).collect(), design.sheets.clone()),
    };
    let papers = sheets.iter().map(|layout| PaperSheet {
        index: layout.index,
        width: layout.width,
        height: layout.height,
        separators: placed
            .iter()
            .zip(&places)
            .filter(|(_, (sheet, _))| *sheet == layout.index)
            .map(|(piece, (_, placement))| PlacedSeparator { piece: piece.index, placement: *placement })
            .collect(),
    });
    Ok(papers.collect())
}

/// The separators of all pieces placed on as many sheets of `paper` as they need, and these sheets.
fn nested(
    machine: &Machine,
    design: &Design,
    paper: PaperSize,
) -> Result<(Vec<Placement>, Vec<SheetLayout>), Refusals> {
    let (sheet, bare_machine) =
        (sheet_of(paper), Machine { bench: spec::Bench::default(), ..machine.clone() });
    let boxes: Vec<Bounds> = design.placed().iter().map(|piece| extent(design, piece)).collect();
    let too_large =
        design.firsts().filter_map(|first| too_large(first, &boxes[first.index - 1], paper, &sheet));
    too_large.collect::<Refusals>().or_value(())?;
    Ok(place(&boxes, &sheet, &bare_machine)?)
}

/// The room for separators on `paper`. Of paper with a name it is what a printer prints of it, so that each sheet is one page.
fn sheet_of(paper: PaperSize) -> Sheet {
    let ([width, height], margin) = match paper {
        PaperSize::A4 => (crate::Paper::A4.window(), 0.0),
        PaperSize::Letter => (crate::Paper::Letter.window(), 0.0),
        PaperSize::A3 | PaperSize::Custom(..) => (paper.sides(), MARGIN),
    };
    Sheet {
        width: Some(Length(width)),
        height: Some(Length(height)),
        copies: 1,
        margin: Length(margin),
        gap: Length(GAP),
        turn: true,
        hole_diameter: Length(0.0),
    }
}

/// The box that the separator of a piece and its registration holes take on paper, in the piece's frame.
fn extent(design: &Design, piece: &PlacedPart) -> Bounds {
    let part = design.part(piece);
    let edges = part.separator().into_iter().flat_map(|paper: &PaperSeparator| &paper.tool.pieces);
    let holes = part
        .cut(crate::CutEdge::Part)
        .holes
        .iter()
        .map(|hole| Bounds::of_points([hole.center]).outset(hole.diameter / 2.0 + AROUND_HOLE));
    edges.map(geom::Path::bounds).chain(holes).fold(Bounds::EMPTY, Bounds::union)
}

/// The refusal of a separator that does not fit on the paper, turned or not.
fn too_large(piece: &PlacedPart, bounds: &Bounds, paper: PaperSize, sheet: &Sheet) -> Option<Refusal> {
    let [width, height] = [sheet.width, sheet.height]
        .map(|side| side.map_or(0.0, |side: Length| side.0 - 2.0 * sheet.margin.0));
    let (low, high) = (bounds.width().min(bounds.height()), bounds.width().max(bounds.height()));
    if low <= width.min(height) && high <= width.max(height) {
        return None;
    }
    let (needed_sides, margins) = ([bounds.width(), bounds.height()].map(tenths_up), 2.0 * MARGIN);
    let [w, h] = paper.sides();
    let fault = format!(
        "the separator of {} with its registration holes needs {}; paper of {} has room for {}",
        piece.name(),
        size_in_words(needed_sides[0], needed_sides[1]),
        size_in_words(w, h),
        size_in_words(width.max(0.0), height.max(0.0)),
    );
    let remedy = format!(
        "write paper = \"{}\" or larger, or delete `paper` to print on pages that are taped together",
        size_in_words(needed_sides[0] + margins, needed_sides[1] + margins)
    );
    Some(Refusal::new(key::press::PAPER, RefusalCode::SheetTooSmall, fault, remedy))
}
