//! The inflated chamber in SI units.

use crate::shell::assembly::{Compression, Sheet};
use crate::shell::cases::refinement::Evidence;
use crate::shell::cases::region::chambers::FlatRegion;
use crate::shell::cases::region::measure::{Measured, NUMBERS};
use crate::shell::cases::region::seams::Station;
use crate::shell::cases::region::surface::Surface;
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;

/// Treatment of wrinkles in a computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrinkles {
    /// The sheet bears compression until it buckles; the mesh shows the wrinkles.
    Resolved,
    /// They are too fine for a mesh: the numbers lie between those of a sheet that is stiff enough and those of one that bears no compression.
    Blended,
    /// The sheet bears no compression, and the shape is the mean of its wrinkles.
    Averaged,
}

/// The part of its stiffness against compression that an averaged sheet keeps, by p W/Y: where it is shortened by a quarter, as at the rim of
/// a disc, it bears 0.25 % of p W.
const LEFT: f64 = 1e-2;
/// Least bending stiffness of an averaged sheet by p W l^2, where l is the length of an edge: as much as a mesh can show. It becomes smaller
/// with each finer mesh, and so is part of the mesh error. Without it triangles zigzag, and Newton's method takes up to ten times as many steps.
const LEAST_BENDING: f64 = 2e-2;

impl Wrinkles {
    /// The response of a sheet of `tube` without stiffness against compression.
    pub(super) fn law(tube: &Tube) -> Compression {
        Compression::Wrinkled(LEFT * tube.stretch())
    }

    /// Prepares a sheet of `tube`, whose welds are released.
    pub(super) fn prepare(self, sheet: &mut Sheet, tube: &Tube) {
        if self == Self::Averaged {
            sheet.wrinkle(LEFT * tube.stretch(), LEAST_BENDING * tube.stretch());
        }
    }
}

/// A seam of a chamber.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegionSeam {
    /// Outline of the chamber.
    Outline,
    /// The rim of one of its holes.
    Hole(usize),
    /// One of its islands.
    Island(usize),
    /// One of its welds: the pull is that of the sheets on both sides together.
    Weld(usize),
}

/// The pull on a seam at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeamPull {
    /// Which seam.
    pub seam: RegionSeam,
    /// Position on the flat sheet, m.
    pub at: [f64; 2],
    /// Force that parts the sheets by length of flat seam, N/m, the mean over a band's width around it.
    pub pull: Value,
}

/// Contact with each of two plates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlateContact {
    /// Force on one plate, N.
    pub force: Value,
    /// Area of the sheet that touches it, as it is stretched, m^2.
    pub area: Value,
}

/// A chamber under pressure; both sheets.
#[derive(Clone, Debug, PartialEq)]
pub struct InflatedRegion {
    /// Diameter of the largest circle in the flat chamber, m: the W of 1/eps, t/W and p W/Y.
    pub width: f64,
    /// 1/eps = p W^3 / B.
    pub bendability: f64,
    /// Treatment of wrinkles.
    pub wrinkles: Wrinkles,
    /// Largest distance between the sheets, m.
    pub height: Value,
    /// Position on the flat sheet, m.
    pub height_at: [f64; 2],
    /// Extents of the flat chamber along x and y, m.
    pub flat_extents: [f64; 2],
    /// Extents of the inflated one where it lies best on the flat one, m.
    pub extents: [Value; 2],
    /// Volume, m^3.
    pub volume: Value,
    /// Largest pull on a seam, N/m.
    pub seal_pull: Value,
    /// Position on the finest mesh.
    pub pull_at: [f64; 2],
    /// The pull along each seam.
    pub seams: Vec<SeamPull>,
    /// Whether chambers between its walls have different pressures.
    pub is_parted: bool,
    /// Largest principal stretch. At a sharp corner that points into the chamber it has no limit, and its mesh
    /// error is then large.
    pub stretch: Value,
    /// Position on the flat sheet, m.
    pub stretch_at: [f64; 2],
    /// Largest principal tension, N/m: the stress times the thickness. At sharp corners as the stretch.
    pub tension: Value,
    /// Position on the flat sheet, m.
    pub tension_at: [f64; 2],
    /// Lowest eigenvalue of the energy's Hessian by p/W where both sheets stay images of each other; positive.
    pub symmetric_eigenvalue: Value,
    /// Lowest eigenvalue where both sheets move to the same side. Below 0 the shape leaves its plane.
    pub antisymmetric_eigenvalue: Value,
    /// The upper sheet on its finest mesh.
    pub shape: InflatedShape,
    /// Both sheets.
    pub surface: Surface,
    /// The positions of the probes on the upper sheet, m, where the inflated chamber lies best on the flat one; of each mesh, coarse to fine.
    pub probed: Vec<Vec<[f64; 3]>>,
    /// The positions of the probes on the other computed shape, whether it counts as a second one or differs by its folds only; empty if one shape was computed.
    pub other_probed: Vec<Vec<[f64; 3]>>,
    /// Contact with plates, if it lies between some.
    pub plates: Option<PlateContact>,
    /// Two places of the flat rims, m, that cross each other in the inflated shape.
    pub overlap: Option<[[f64; 2]; 2]>,
    /// Energy of both sheets less the work of the pressure, J.
    pub energy: Value,
    /// The other stable shape at this pressure, of more energy, if another one was found.
    pub second: Option<Box<Self>>,
    /// The evidence for these values.
    pub evidence: Evidence,
}

impl InflatedRegion {
    /// Whether it stays in its plane, by the lowest eigenvalue and its mesh error.
    pub fn plane(&self) -> PlaneState {
        let Value { value, error, meshes } = self.antisymmetric_eigenvalue;
        // NaN proves nothing.
        if value > SURE * error && meshes[2] > 0.0 {
            PlaneState::Stays
        } else if value < -SURE * error && meshes[2] < 0.0 {
            PlaneState::Leaves
        } else {
            PlaneState::Unsure
        }
    }
}

/// Mesh errors by which an eigenvalue must differ from 0. A coarse annulus (R* = 3, 14 kPa) has -6.1 with an error of 3.1, and +0.144 with 0.004 on
/// finer meshes: one error is not enough.
const SURE: f64 = 2.0;

/// Whether a shape stays in the plane of its drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaneState {
    /// Each small motion out of it takes energy.
    Stays,
    /// Some motion out of it releases energy.
    Leaves,
    /// The mesh error is too large to tell.
    Unsure,
}

/// The results of a family of meshes: numbers in units of the chamber's width and the fabric's stretching stiffness, positions in m.
pub(super) struct FamilyResults {
    pub(super) values: [Value; NUMBERS],
    pub(super) evidence: Evidence,
    /// The stations along the seams of each of the last three meshes.
    pub(super) pulls: Vec<Vec<Station>>,
    /// The positions of the probes on each of them.
    pub(super) probed: Vec<Vec<[f64; 3]>>,
    /// The places of numbers on the finest mesh.
    pub(super) measured: Measured,
    pub(super) overlap: Option<[[f64; 2]; 2]>,
    pub(super) shape: InflatedShape,
    pub(super) surface: Surface,
}

impl FamilyResults {
    /// The inflated chamber `case`, computed as `tube` with this treatment of `wrinkles`; each number gets its unit back.
    pub(super) fn answer(self, case: &FlatRegion, tube: &Tube, wrinkles: Wrinkles) -> InflatedRegion {
        // The meshes were computed in units of the chamber's width and the fabric's stretching stiffness. Here each number
        // gets its unit back.
        let (w, y) = (tube.width, tube.fabric.stretch);
        let seams = seam_pulls(case, &self.pulls, [w, y]);
        let largest = seams.iter().max_by(|a, b| a.pull.meshes[2].total_cmp(&b.pull.meshes[2]));
        let place = |at: [f64; 2]| at.map(|x| x * w);
        let flat = case.chamber.outline.bounds();
        let [
            volume,
            height,
            x,
            y_extent,
            stretch,
            tension,
            symmetric,
            antisymmetric,
            force,
            contact_area,
            energy,
            pull,
        ] = self.values;
        InflatedRegion {
            width: w,
            bendability: tube.bendability(),
            wrinkles,
            height: height.scaled(w),
            height_at: place(self.measured.height_at),
            flat_extents: [flat.width(), flat.height()],
            extents: [x.scaled(w), y_extent.scaled(w)],
            volume: volume.scaled(w.powi(3)),
            seal_pull: pull.scaled(y),
            pull_at: largest.map_or([0.0; 2], |largest| largest.at),
            seams,
            is_parted: !case.partial.is_empty(),
            stretch,
            stretch_at: place(self.measured.stretch_at),
            tension: tension.scaled(y),
            tension_at: place(self.measured.tension_at),
            symmetric_eigenvalue: symmetric,
            antisymmetric_eigenvalue: antisymmetric,
            shape: self.shape,
            surface: self.surface,
            probed: self.probed,
            other_probed: Vec::new(),
            plates: case
                .plates
                .map(|_| PlateContact { force: force.scaled(y * w), area: contact_area.scaled(w * w) }),
            overlap: self.overlap.map(|places| places.map(place)),
            energy: energy.scaled(2.0 * tube.energy()),
            second: None,
            evidence: self.evidence,
        }
    }
}

/// The pull at each station from the last three meshes.
fn seam_pulls(case: &FlatRegion, pulls: &[Vec<Station>], [w, y]: [f64; 2]) -> Vec<SeamPull> {
    let holes = case.chamber.holes.len();
    let islands = holes + case.chamber.islands.len();
    let Some(last) = pulls.last() else { return Vec::new() };
    let meshes = [0, 1, 2].map(|mesh| &pulls[mesh.min(pulls.len() - 1)]);
    (last.iter().enumerate())
        .map(|(k, station)| SeamPull {
            seam: match station.curve {
                0 => RegionSeam::Outline,
                hole if hole <= holes => RegionSeam::Hole(hole - 1),
                island if island <= islands => RegionSeam::Island(island - holes - 1),
                weld => RegionSeam::Weld(weld - islands - 1),
            },
            at: station.at.map(|x| x * w),
            pull: Value::new(meshes.map(|stations| stations[k].pull)).scaled(y),
        })
        .collect()
}
