//! Chambers of a drawn piece for the shell.

use crate::case::{sheet, weave};
use crate::predict::PredictFault;
use crate::shell::{Detail, fabric};
use design::DrawnPieces;
use inflatable::shell::cases::{Fineness, FlatRegion, chambers};
use inflatable::shell::mesh::FlatChamber;
use spec::{Spec, key};

/// A chamber of a drawn piece.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnChamber {
    /// In mm, in the piece's own frame.
    pub flat: FlatChamber,
    /// In SI units, without a pressure.
    pub region: FlatRegion,
}

impl DrawnChamber {
    /// The meshes that `detail` means: those of a first look, and with two and four times as many edges across.
    pub fn fineness(&self, detail: Detail) -> Fineness {
        let quick = self.region.quick();
        let times = match detail {
            Detail::Coarse => 1.0,
            Detail::Medium => 2.0,
            Detail::Fine => 4.0,
        };
        Fineness { cells: times * quick.cells, ..quick }
    }
}

/// The chambers of `pieces` in the order of their outlines; each wall and weld belongs to the chamber that contains it.
///
/// # Errors
/// If the edges enclose no chamber, or the fabric is invalid.
pub fn drawn_chambers(spec: &Spec, pieces: &DrawnPieces) -> Result<Vec<DrawnChamber>, PredictFault> {
    let elastic_sheet = sheet(&spec.fabric).map_err(|problem| drawing_fault(&problem))?;
    let fabric_weave = weave(&spec.fabric).map_err(|problem| drawing_fault(&problem))?;
    let flats = chambers(&pieces.air(), &pieces.inner(), &pieces.holes())
        .map_err(|problem| drawing_fault(&problem))?;
    if flats.is_empty() {
        return Err(drawing_fault(&"the drawing's edges enclose no air"));
    }
    let chamber = |flat: FlatChamber| DrawnChamber {
        region: FlatRegion {
            chamber: flat.in_units(MM_IN_M),
            fabric: fabric(&elastic_sheet, fabric_weave),
            pressure: 0.0,
            band: spec.seal.band.metres(),
            probes: Vec::new(),
            partial: Vec::new(),
            plates: None,
        },
        flat,
    };
    Ok(flats.into_iter().map(chamber).collect())
}

fn drawing_fault(problem: &impl ToString) -> PredictFault {
    PredictFault::new(key::drawing::FILE, problem.to_string())
}

/// mm in a metre.
const MM_IN_M: f64 = 1e3;
