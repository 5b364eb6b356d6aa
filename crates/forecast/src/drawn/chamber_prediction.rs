//! The answer about one chamber of a drawn piece: flat sizes, and the shell's values in words and numbers.

use crate::drawn::chambers::DrawnChamber;
use crate::drawn::plates::PlatesPrediction;
use crate::drawn::seams::{SeamPrediction, SeamStrengths, seam_predictions};
use crate::drawn::shapes::{ShapeRanges, averaged_pull, with_errors};
use crate::interval::{Interval, hull};
use crate::keys::{keyed, kinds};
use crate::meshed::{MeshedPlace, MeshedValue, six};
use design::DrawnPieces;
use inflatable::shell::cases::{InflatedRegion, PlaneState, Value, Wrinkles};
use serde::Serialize;
use spec::units::{Length, Pressure};

keyed! {
    /// One chamber.
    #[derive(Clone, Debug, Default, PartialEq, Serialize)]
    #[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
    pub struct ChamberPrediction {
        /// Number of the chamber, from 1.
        pub chamber: usize,
        /// The middle of its box.
        pub at_mm: [f64; 2],
        /// Diameter W of the largest circle in the flat chamber.
        pub width_mm: f64,
        /// Flat area of one sheet.
        pub flat_area_mm2: f64,
        /// Extents of the flat chamber along x and y.
        pub flat_extents_mm: [f64; 2],
        /// Bendability p W^3 / B.
        pub bendability: Option<f64>,
        /// Stretch p W / Y of the fabric.
        pub stretch: Option<f64>,
        /// Whether wrinkles are on the mesh (resolved), partly on a stiffer sheet's (blended), or the shape is their mean (averaged).
        pub wrinkles: Option<&'static str>,
        /// Ranges where they are blended or averaged, or there is a second shape.
        pub ranges: Option<ShapeRanges>,
        /// The other stable shape at this pressure, if one was found.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub second_shape: Option<SecondShape>,
        /// Contact with each plate, between `plates` of `[load]`: `force_N` and `contact_area_mm2`.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub plates: Option<PlatesPrediction>,
        /// Largest distance between the sheets.
        pub height_mm: Option<MeshedPlace>,
        /// Extents of the inflated chamber where it lies best on the flat one.
        pub extents_mm: Option<[MeshedValue; 2]>,
        /// Volume.
        pub volume_mm3: Option<MeshedValue>,
        /// Largest pull of one sheet on a seam.
        pub seal_pull_N_per_mm: Option<MeshedPlace>,
        /// Pressure at which the seal peels.
        pub burst_pressure_kPa: Option<f64>,
        /// Range of the burst pressure.
        pub burst_range_kPa: Option<Interval>,
        /// The seam that opens first, where seams are sealed by several processes.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bursts_first: Option<FirstOpening>,
        /// Largest principal stretch.
        pub largest_stretch: Option<MeshedPlace>,
        /// Largest principal tension, N/mm.
        pub largest_tension_N_per_mm: Option<MeshedPlace>,
        /// Lowest eigenvalue by p / W for leaving the plane of the drawing.
        pub plane_eigenvalue: Option<MeshedValue>,
        /// Whether it stays in that plane.
        pub plane: Option<PlaneAnswer>,
        /// Whether it may leave that plane: it leaves it, or the mesh error is too large to tell.
        pub leaves_plane: Option<bool>,
        /// Seams of the chamber.
        pub seams: Option<Vec<SeamPrediction>>,
        /// Unknowns of each mesh, coarse to fine.
        pub unknowns: Option<Vec<usize>>,
        /// Newton steps of all meshes.
        pub iterations: Option<u32>,
    }
}

kinds! {
    Text: PlaneAnswer;
    Number: usize, u32;
    Object: ShapeRanges, SecondShape, PlatesPrediction, FirstOpening;
    List: Vec<SeamPrediction>, [MeshedValue; 2];
    Variant: Vec<usize>;
}

/// The seam that opens first.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct FirstOpening {
    /// Name of the seam.
    pub seam: String,
    /// Name of the piece, "piece-2", where several have a seam of this name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub piece: Option<String>,
    /// Name of its process.
    pub process: String,
    /// Pressure at which it peels.
    pub pressure_kPa: f64,
    /// Range of that pressure.
    pub range: Interval,
}

impl FirstOpening {
    /// The seam in words, with its piece where others have a seam of this name: "tear of piece-2".
    pub fn place(&self) -> String {
        self.piece.as_ref().map_or_else(|| self.seam.clone(), |piece| format!("{} of {piece}", self.seam))
    }
}

/// A stable shape of more energy than that of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct SecondShape {
    /// Largest distance between the sheets.
    pub height_mm: MeshedPlace,
    /// Extents along x and y.
    pub extents_mm: [MeshedValue; 2],
    /// Volume.
    pub volume_mm3: MeshedValue,
    /// Largest pull of one sheet on a seam.
    pub seal_pull_N_per_mm: MeshedPlace,
    /// By how much its energy, the work of the pressure included, is larger.
    pub more_energy_mJ: MeshedValue,
}

impl SecondShape {
    fn new(region: &InflatedRegion, pull: MeshedPlace) -> Option<Self> {
        let second = region.second.as_deref()?;
        let difference = [0, 1, 2].map(|mesh| second.energy.meshes[mesh] - region.energy.meshes[mesh]);
        Some(Self {
            height_mm: MeshedPlace::rounded(second.height.scaled(1e3), second.height_at),
            extents_mm: second.extents.map(|extent| MeshedValue::rounded(extent.scaled(1e3))),
            volume_mm3: MeshedValue::rounded(second.volume.scaled(1e9)),
            seal_pull_N_per_mm: pull,
            more_energy_mJ: MeshedValue::rounded(Value::new(difference).scaled(1e3)),
        })
    }
}

/// The largest pull on a seam.
fn largest_pull(seams: &[SeamPrediction]) -> Option<MeshedPlace> {
    seams.iter().map(|seam| seam.pull_N_per_mm).max_by(|a, b| a.value.total_cmp(&b.value))
}

/// Whether a chamber stays in the plane of the drawing, by the lowest eigenvalue and two of its mesh errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlaneAnswer {
    /// It stays in the plane.
    Stays,
    /// It leaves the plane.
    Leaves,
    /// The mesh error is too large to tell.
    Unsure,
}

impl PlaneAnswer {
    /// The answer to "stays in its plane".
    pub fn answer(self) -> &'static str {
        match self {
            Self::Stays => "yes",
            Self::Leaves => "no",
            Self::Unsure => "not sure",
        }
    }
}

/// The words for [`Wrinkles`] that are not resolved.
pub(super) const BLENDED: &str = "blended";
pub(super) const AVERAGED: &str = "averaged";

impl ChamberPrediction {
    /// The prediction of a chamber without a model: flat sizes only.
    pub(super) fn flat(number: usize, chamber: &DrawnChamber, pressure: Option<Pressure>) -> Self {
        let (flat, fabric) = (&chamber.flat, &chamber.region.fabric);
        let bounds = flat.outline.bounds();
        let width = chamber.region.chamber.widest();
        let pascals = pressure.map(Pressure::pascals);
        Self {
            chamber: number,
            at_mm: [bounds.center().x, bounds.center().y].map(six),
            width_mm: six(Length::from_metres(width).0),
            flat_area_mm2: six(
                flat.area() - flat.islands.iter().map(|island| island.area().abs()).sum::<f64>()
            ),
            flat_extents_mm: [bounds.width(), bounds.height()].map(six),
            bendability: pascals.map(|p| six(p * width.powi(3) / fabric.bending)),
            stretch: pascals.map(|p| six(p * width / fabric.stretch)),
            ..Self::default()
        }
    }

    /// Adds the shell's values.
    pub(super) fn fill(
        &mut self,
        region: &InflatedRegion,
        pieces: &DrawnPieces,
        pressure: Pressure,
        strengths: &SeamStrengths,
    ) {
        let seams = seam_predictions(region, pieces);
        let largest = largest_pull(&seams);
        let second_seams = region.second.as_deref().map(|second| seam_predictions(second, pieces));
        let second_pull = second_seams.as_deref().and_then(largest_pull);
        // Folds may pull harder than their mean.
        let is_averaged = region.wrinkles == Wrinkles::Averaged;
        let mut opening = if is_averaged { None } else { strengths.first_opening(&seams, pieces, pressure) };
        let second_opening =
            second_seams.as_deref().and_then(|seams| strengths.first_opening(seams, pieces, pressure));
        if let Some((first, second)) = opening.as_mut().zip(second_opening) {
            first.range = hull(first.range, second.range);
        }
        self.burst_pressure_kPa = opening.as_ref().map(|first| rounded_kpa(first.burst));
        self.burst_range_kPa = opening.as_ref().map(|first| first.range.map(rounded_kpa));
        self.bursts_first = opening.filter(|_| strengths.differ()).map(|first| FirstOpening {
            seam: first.seam,
            piece: first.piece,
            process: first.process,
            pressure_kPa: rounded_kpa(first.burst),
            range: first.range.map(rounded_kpa),
        });
        self.wrinkles = Some(match region.wrinkles {
            Wrinkles::Resolved => "resolved",
            Wrinkles::Blended => BLENDED,
            Wrinkles::Averaged => AVERAGED,
        });
        let height = MeshedPlace::rounded(region.height.scaled(1e3), region.height_at);
        let extents = region.extents.map(|extent| MeshedValue::rounded(extent.scaled(1e3)));
        let volume = MeshedValue::rounded(region.volume.scaled(1e9));
        self.ranges =
            largest.and_then(|pull| ShapeRanges::of_region(region, [pull, second_pull.unwrap_or(pull)]));
        self.plates = PlatesPrediction::new(region);
        self.second_shape = second_pull.and_then(|pull| SecondShape::new(region, pull));
        (self.height_mm, self.extents_mm, self.volume_mm3) = (Some(height), Some(extents), Some(volume));
        self.seal_pull_N_per_mm = largest;
        self.largest_stretch = Some(MeshedPlace::rounded(region.stretch, region.stretch_at));
        self.largest_tension_N_per_mm =
            Some(MeshedPlace::rounded(region.tension.scaled(1e-3), region.tension_at));
        self.plane_eigenvalue = Some(MeshedValue::rounded(region.antisymmetric_eigenvalue));
        self.plane = Some(match region.plane() {
            PlaneState::Stays => PlaneAnswer::Stays,
            PlaneState::Leaves => PlaneAnswer::Leaves,
            PlaneState::Unsure => PlaneAnswer::Unsure,
        });
        self.leaves_plane = self.plane.map(|plane| plane != PlaneAnswer::Stays);
        self.seams = Some(seams);
        self.unknowns = Some(region.evidence.unknowns.clone());
        self.iterations = Some(region.evidence.efforts.iter().map(|effort| effort.iterations).sum());
    }

    /// Gives the burst pressure in terms of a load that is `ratio` times this chamber's pressure: all pressures grow in proportion.
    pub(super) fn scale_burst(&mut self, ratio: f64) {
        self.burst_pressure_kPa = self.burst_pressure_kPa.map(|burst| six(ratio * burst));
        self.burst_range_kPa = self.burst_range_kPa.map(|range| range.map(|end| six(ratio * end)));
        if let Some(first) = &mut self.bursts_first {
            first.pressure_kPa = six(ratio * first.pressure_kPa);
            first.range = first.range.map(|end| six(ratio * end));
        }
    }

    /// The range of the pull on a seam; `None` where its mesh error says all.
    pub(super) fn pull_range(&self, pull: MeshedPlace) -> Option<Interval> {
        let ranges = self.ranges?;
        if self.wrinkles == Some(AVERAGED) {
            return Some(averaged_pull(pull));
        }
        // The second shape may pull elsewhere: the largest pull has its range, others that of their own values.
        let is_largest = self.seal_pull_N_per_mm == Some(pull);
        Some(if is_largest { ranges.seal_pull_N_per_mm } else { with_errors(pull) })
    }

    /// The largest value that a pull may have, by its range.
    pub(super) fn largest_pull(&self, pull: MeshedPlace) -> f64 {
        self.pull_range(pull).map_or(pull.value, |[_, high]| high)
    }

    /// Name of the chamber among `count` chambers, as text.
    pub(super) fn name(&self, count: usize) -> String {
        let [x, y] = self.at_mm;
        if count == 1 {
            "the chamber".to_owned()
        } else {
            format!("chamber {} around X {x:.1} Y {y:.1} mm", self.chamber)
        }
    }
}

fn rounded_kpa(pascals: f64) -> f64 {
    six(Pressure::from_pascals(pascals).0)
}
