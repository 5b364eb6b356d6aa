//! A chamber in units of its width, as every mesh of it is prepared.

use crate::shell::assembly::{Sheet, Supports};
use crate::shell::cases::region::answer::Wrinkles;
use crate::shell::cases::region::chambers::FlatRegion;
use crate::shell::cases::region::pressures::PartialPressure;
use crate::shell::cases::region::supports::{self, SealedNodes};
use crate::shell::cases::tube::Tube;
use crate::shell::mesh::{FlatChamber, Meshed};

/// The chamber of a case; lengths by the width of its tube.
pub(super) struct ScaledChamber {
    pub(super) tube: Tube,
    pub(super) chamber: FlatChamber,
    partial: Vec<PartialPressure>,
    wrinkles: Wrinkles,
}

impl ScaledChamber {
    /// The chamber of `case` as `tube` with this treatment of `wrinkles`.
    pub(super) fn new(case: &FlatRegion, tube: Tube, wrinkles: Wrinkles) -> Self {
        let partial = case.partial.iter().map(|part| part.in_units(tube.width)).collect();
        Self { tube, chamber: case.chamber.in_units(tube.width), partial, wrinkles }
    }

    /// The nodes of a mesh at which both sheets are joined.
    pub(super) fn sealed(&self, meshed: &Meshed) -> SealedNodes {
        SealedNodes::new(&self.chamber, &self.partial, meshed)
    }

    /// Prepares the upper sheet of a mesh; its supports, with z = 0 as the plane of symmetry.
    pub(super) fn prepare(&self, meshed: &Meshed, sheet: &mut Sheet) -> Supports {
        let sealed = self.sealed(meshed);
        let supports = supports::symmetric(meshed, &sealed, sheet);
        self.wrinkles.prepare(sheet, &self.tube);
        load_parts(&sealed, sheet, &self.tube);
        supports
    }
}

/// Puts its part of the pressure on each triangle. A sheet without pressure buckles at any compression.
pub(super) fn load_parts(sealed: &SealedNodes, sheet: &mut Sheet, tube: &Tube) {
    for (triangle, part) in sealed.parts.iter().enumerate().filter(|(_, part)| **part != 1.0) {
        sheet.set_load(triangle, *part);
        if *part == 0.0 {
            sheet.set_law(triangle, Wrinkles::law(tube));
        }
    }
}
