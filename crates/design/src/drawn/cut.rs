//! The cut of a drawn piece, and the paper that goes between its sheets.

use std::iter::successors;

use crate::cut::{largest, leaves_holes, tool_around, tool_inside};
use crate::{Circle, Refusal, RefusalCode};
use geom::Path;
use sealed::{AirSide, SealedShape, Separator};
use spec::units::{Most, Readable};
use spec::{Spec, key};

/// The cut lines of a drawn piece, closed and counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCut {
    /// Around the piece.
    pub outside: Path,
    /// Out of the piece.
    pub inside: Vec<Path>,
    /// Holes of valves, out of one sheet.
    pub valves: Vec<Path>,
    /// Width of the cut, mm.
    pub kerf: f64,
}

/// The separator of a drawn piece, in the drawing's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnSeparator {
    /// The paper's own edges.
    pub part: Separator,
    /// The lines that a tool follows to cut it.
    pub tool: Separator,
    /// Width of the cut, mm.
    pub kerf: f64,
}

impl DrawnCut {
    /// The cut along the outline of `shape`, and of `holes` inside it.
    pub(super) fn new(shape: &SealedShape, holes: &[Path]) -> Result<Self, Refusal> {
        let Some(outside) = &shape.cut else {
            let problem = "the drawn shape has no outline";
            let remedy = "draw a closed curve on a layer of `cut`";
            return Err(Refusal::new(key::drawing::LAYERS, RefusalCode::WrongOutlines, problem, remedy));
        };
        let counterclockwise = |path: &Path| if path.area() < 0.0 { path.reversed() } else { path.clone() };
        let inside = holes.iter().map(counterclockwise).collect();
        let valves = shape.valves.iter().map(|valve| valve.hole.clone()).collect();
        Ok(Self { outside: counterclockwise(outside), inside, valves, kerf: 0.0 })
    }

    /// The lines of a tool whose cut is `kerf` wide, for a piece with these registration holes.
    pub(super) fn for_tool(&self, kerf: f64, holes: &[Circle]) -> Result<Self, Refusal> {
        leaves_holes(kerf, holes)?;
        Ok(Self {
            outside: tool_around(&self.outside, kerf, "the outline")?,
            inside: tool_holes(&self.inside, kerf, "a hole")?,
            valves: tool_holes(&self.valves, kerf, "the hole of a valve")?,
            kerf,
        })
    }
}

/// The lines of a tool with this kerf that cuts `paths` out of a part.
fn tool_holes(paths: &[Path], kerf: f64, part: &str) -> Result<Vec<Path>, Refusal> {
    paths.iter().map(|path| tool_inside(path, kerf, part)).collect()
}

impl DrawnSeparator {
    /// The separator of `shape`, whose seams enclose `air`, with the creep and kerf of `spec`.
    pub(super) fn new(spec: &Spec, shape: &SealedShape, air: &AirSide) -> Result<Self, Refusal> {
        let (creep, kerf) = (spec.mask.creep.0, spec.cut.kerf.0);
        let separator_with = |creep: f64| air.separator(shape, creep);
        let part = separator_with(creep)
            .ok_or_else(|| no_separator(creep, |creep| separator_with(creep).is_some()))?;
        let lines = |paths: &[Path], line: fn(&Path, f64, &str) -> Result<Path, Refusal>, what: &str| {
            paths.iter().map(|path| line(path, kerf, what)).collect::<Result<Vec<_>, _>>()
        };
        let tool = Separator {
            pieces: lines(&part.pieces, tool_around, "a separator")?,
            windows: lines(&part.windows, tool_inside, "a window of a separator")?,
        };
        Ok(Self { part, tool, kerf })
    }
}

/// The refusal of a creep that cuts the paper up, with the largest one that does not; `is_made` tests a creep.
fn no_separator(creep: f64, is_made: impl Fn(f64) -> bool) -> Refusal {
    let (key, code) = (key::mask::CREEP, RefusalCode::NoWindow);
    if !is_made(0.0) {
        let problem = "the seams leave no paper in one piece for each chamber";
        let remedy =
            "draw seams in the air farther from each other, or without sharp bends; or delete [mask]";
        return Refusal::new(key, code, problem, remedy);
    }
    let fits = largest(creep, &is_made);
    // What is printed is itself tried: rounded down, a creep may be another that fails.
    let hundredths = successors(Some((fits * 100.0).floor()), |last| Some(last - 1.0));
    let largest_creep = hundredths.map(|last| last / 100.0).find(|most| *most <= 0.0 || is_made(*most));
    let problem = format!("a creep of {} mm closes a port or a passage of the separator", Readable(creep));
    Refusal::new(
        key,
        code,
        problem,
        format!("creep must be at most {} mm", Most(largest_creep.unwrap_or(0.0))),
    )
}
