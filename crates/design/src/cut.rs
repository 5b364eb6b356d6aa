//! Cut lines: where the middle of a tool travels that takes away a **kerf**, so that parts come out as they are drawn.
//!
//! A cut takes half of its width from either side. Cut-outs (holes, windows) would come out larger, and cut edges (outlines,
//! plates) smaller; so the tool travels half a kerf inside the former and outside the latter.

use crate::offset::offset;
use crate::{Circle, MaskPlate, Outline, Refusal, RefusalCode, Star};
use geom::{Isometry, Path};
use spec::units::{Most, Readable, hundredths_down};
use spec::{SMALLEST_HOLE, key};

/// The cut lines of one star and its mask, in the star's frame. All are closed and counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct CutLines {
    /// Width of the cut, mm.
    pub kerf: f64,
    /// Around the star.
    pub outside: Path,
    /// Around the star's hole.
    pub hole: Path,
    /// Around the mask's plate.
    pub plate: Path,
    /// In the mask's windows, in their order.
    pub windows: Vec<Path>,
}

impl CutLines {
    /// The lines of a cut `kerf` wide for a star with this outline and this mask.
    ///
    /// # Errors
    /// If the cut is wider than something that it is to cut out.
    pub fn new(kerf: f64, star: &Star, outline: &Outline, mask: &MaskPlate) -> Result<Self, Refusal> {
        leaves_holes(kerf, &outline.registration)?;
        // All windows are the first one, turned; without a kerf they stay as they are, to the bit.
        let windows = match mask.windows.first() {
            Some(first) if kerf > 0.0 => {
                let first = tool_inside(first, kerf, "a coating window")?;
                let turns = (1..=star.n).map(|k| star.corner_ray(k) - star.corner_ray(1));
                turns.map(|turn| Isometry::rotation(turn).path(&first)).collect()
            }
            _ => mask.windows.clone(),
        };
        Ok(Self {
            kerf,
            outside: tool_around(&outline.outside, kerf, "the outline")?,
            hole: tool_inside(&outline.hole, kerf, "the star's hole")?,
            plate: tool_around(&mask.plate, kerf, "the mask's plate")?,
            windows,
        })
    }
}

/// Rounding of a difference of two lengths of a spec, mm.
const ROUNDING: f64 = 1e-9;

/// Whether a cut `kerf` wide leaves less than the smallest hole of one of `diameter`.
pub(super) fn leaves_no_hole(kerf: f64, diameter: f64) -> bool {
    kerf > 0.0 && diameter - kerf < SMALLEST_HOLE - ROUNDING
}

/// Refuses a cut `kerf` wide that leaves nothing of one of these registration holes.
pub(super) fn leaves_holes(kerf: f64, holes: &[Circle]) -> Result<(), Refusal> {
    let Some(hole) = holes.iter().find(|hole| leaves_no_hole(kerf, hole.diameter)) else { return Ok(()) };
    let (width, diameter) = (Readable(kerf), Readable(hole.diameter));
    Err(refusal(
        format!("a cut of {width} mm leaves nothing of a registration hole of {diameter} mm"),
        format!("kerf must be at most {} mm", Most((hole.diameter - SMALLEST_HOLE).max(0.0))),
    ))
}

/// The line of a tool with this kerf that cuts `path` out of a part.
///
/// # Errors
/// If the cut is wider than that.
pub(super) fn tool_inside(path: &Path, kerf: f64, subject: &str) -> Result<Path, Refusal> {
    offset(path, -0.5 * kerf).ok_or_else(|| too_wide(kerf, path, -0.5, subject))
}

/// The line of a tool with this kerf that cuts around `path`.
///
/// # Errors
/// If the cut is too wide for it.
pub(super) fn tool_around(path: &Path, kerf: f64, subject: &str) -> Result<Path, Refusal> {
    offset(path, 0.5 * kerf).ok_or_else(|| too_wide(kerf, path, 0.5, subject))
}

/// The refusal of a kerf that leaves nothing of `path`, which `share` of it moves outwards, with the widest that does.
fn too_wide(kerf: f64, path: &Path, share: f64, subject: &str) -> Refusal {
    let widest = Readable(hundredths_down(largest(kerf, |kerf| offset(path, share * kerf).is_some())));
    refusal(
        format!("a cut of {} mm leaves nothing of {subject}", Readable(kerf)),
        format!("kerf must be at most {widest} mm"),
    )
}

/// The largest length that fits where 0 does and `fails` does not, to a thousandth of a millimetre; rounding down keeps it.
pub(super) fn largest(mut fails: f64, is_fit: impl Fn(f64) -> bool) -> f64 {
    let mut fits = 0.0;
    while fails - fits > 1e-3 {
        let middle = f64::midpoint(fits, fails);
        if is_fit(middle) { fits = middle } else { fails = middle }
    }
    fits
}

fn refusal(fault: String, remedy: String) -> Refusal {
    Refusal::new(key::cut::KERF, RefusalCode::WideKerf, fault, remedy)
}

/// The lines of a drawing of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutEdge {
    /// The part's own edges: for printed parts.
    Part,
    /// The middle of the tool that cuts them, half a kerf beside.
    Tool,
}
