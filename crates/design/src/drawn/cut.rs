//! The cut of a drawn piece.

use crate::cut::{leaves_holes, tool_around, tool_inside};
use crate::{Circle, Refusal, RefusalCode};
use geom::Path;
use sealed::SealedShape;
use spec::key;

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

impl DrawnCut {
    /// The cut along the outline of `shape`, and of `holes` inside it.
    pub(super) fn new(shape: &SealedShape, holes: &[Path]) -> Result<Self, Refusal> {
        let Some(outside) = &shape.cut else {
            let problem = "the drawn shape has no outline";
            let remedy = "draw a closed curve on a layer of `cut`";
            return Err(Refusal::new(key::drawing::LAYERS, RefusalCode::WrongOutlines, problem, remedy));
        };
        let inside = holes.iter().map(Path::counterclockwise).collect();
        let valves = shape.valves.iter().map(|valve| valve.hole.clone()).collect();
        Ok(Self { outside: outside.counterclockwise(), inside, valves, kerf: 0.0 })
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
