//! The answer about a drawn piece: lengths in mm, in the frame of the drawing.

use crate::drawn::chamber_prediction::{AVERAGED, BLENDED, ChamberPrediction, FirstOpening};
use crate::drawn::measures::MeasurePrediction;
use crate::drawn::pressures::PortPressure;
use crate::drawn::pull::PullPrediction;
use crate::drawn::shapes::{averaged_warning, blended_warning, second_warning};
use crate::interval::Interval;
use crate::keys::{keyed, kinds};
use crate::meshed::{MeshedValue, six};
use crate::model_search::AccuracySearch;
use crate::seal_load::{Bursting, bursts_at};
use crate::warning::{PredictionWarning, WarningCode};
use design::{Refusal, RefusalCode};
use serde::Serialize;
use spec::key;
use spec::units::{LineForce, Most, Pressure};

keyed! {
    /// The prediction of each copy of a drawn piece. `None` where a required input is missing: a pressure, or the shell.
    #[derive(Clone, Debug, Default, PartialEq, Serialize)]
    #[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
    pub struct DrawnPrediction {
        /// Model used: shell, or none: flat sizes only.
        pub model: &'static str,
        /// Gauge pressure, kPa.
        pub pressure_kPa: Option<f64>,
        /// Pressures of chambers that differ from it, by port.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub pressures_kPa: Option<Vec<PortPressure>>,
        /// Mass of the fabric of one piece, both sheets, g. Needs `areal_density`.
        pub mass_g: Option<f64>,
        /// Volume of all chambers of a piece, mm^3: `value` and `mesh_error`. By the shell only.
        pub volume_mm3: Option<MeshedValue>,
        /// Least pressure at which a chamber's seal peels, kPa. Needs the strength of every seam, and the shell with wrinkles
        /// that are not averaged.
        pub burst_pressure_kPa: Option<f64>,
        /// Range of the burst pressure: mesh errors, and how the pull may grow with the pressure.
        pub burst_range_kPa: Option<Interval>,
        /// The seam that opens first: `seam`, with `piece` where several have a seam of this name, `process`, `pressure_kPa` and `range`. Where seams are sealed by several processes; needs the
        /// strength of each.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bursts_first: Option<FirstOpening>,
        /// Burst pressure over the pressure. Needs both.
        pub burst_margin: Option<f64>,
        /// Whether a chamber may leave the plane of the drawing. By the shell only.
        pub leaves_plane: Option<bool>,
        /// Chambers, each with flat size and area, `bendability` and `stretch`; by the shell `extents_mm`, `height_mm`, `volume_mm3`,
        /// `seal_pull_N_per_mm`, `largest_stretch`, `largest_tension_N_per_mm` and `plane_eigenvalue`, each with its mesh error; where
        /// `wrinkles` are blended or averaged, or there is a `second_shape`, `ranges` of height, extents, volume and pull;
        /// `seams`: the largest pull on each, with rows of x, y, pull and mesh error along it.
        pub chambers: Vec<ChamberPrediction>,
        /// Measures of the drawing's role `measure`: distances, directions, angles, radii, positions and heights, flat and by the shell.
        pub measures: Vec<MeasurePrediction>,
        /// The pull at two bars, of the drawing's role `pull`: `blocked_force_N`, `free_stroke_mm`, `lifted_mm`, and `curve` with rows of stroke,
        /// force and its mesh error. By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub pull: Option<PullPrediction>,
        /// Why this model was used, and `warnings`.
        pub evidence: DrawnEvidence,
    }
}

kinds! {
    Object: MeshedValue, DrawnEvidence, PullPrediction;
    List: Vec<ChamberPrediction>, Vec<MeasurePrediction>, Vec<PortPressure>;
}

/// Model, choice and warnings behind a prediction.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DrawnEvidence {
    /// Reason for the choice of this model.
    pub choice: String,
    /// The search for meshes with the accuracy that was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<AccuracySearch>,
    /// Warnings for the user.
    pub warnings: Vec<PredictionWarning>,
}

impl DrawnPrediction {
    /// Adds the values that depend on all chambers at `pressure`.
    pub(super) fn of_all(&mut self, pressure: Pressure) {
        let chambers = &self.chambers;
        let volumes: Vec<MeshedValue> = chambers.iter().filter_map(|chamber| chamber.volume_mm3).collect();
        self.volume_mm3 = Some(MeshedValue {
            value: six(volumes.iter().map(|volume| volume.value).sum()),
            mesh_error: six(volumes.iter().map(|volume| volume.mesh_error).sum()),
        });
        let bursting =
            chambers.iter().filter_map(|one| Some((one.burst_pressure_kPa?, one.burst_range_kPa?)));
        // A chamber without a burst pressure may be the weakest.
        let is_known = chambers.iter().all(|one| one.burst_pressure_kPa.is_some());
        let weakest = bursting.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|_| is_known);
        self.burst_pressure_kPa = weakest.map(|(burst, _)| burst);
        self.burst_range_kPa = weakest.map(|(_, range)| range);
        let openings = chambers.iter().filter_map(|chamber| chamber.bursts_first.clone());
        let first = openings.min_by(|a, b| a.pressure_kPa.total_cmp(&b.pressure_kPa));
        self.bursts_first = first.filter(|_| is_known);
        self.burst_margin = weakest.map(|(burst, _)| six(burst / pressure.0));
        self.leaves_plane = Some(chambers.iter().any(|chamber| chamber.leaves_plane == Some(true)));
        self.evidence.warnings = self.warnings();
    }

    /// The largest pull on each seam of every chamber, with its place; `None` without the shell. Where it has a range, it is
    /// the upper end.
    pub fn seam_loads(&self) -> Vec<(Option<LineForce>, String)> {
        let count = self.chambers.len();
        let of_chamber = |one: &ChamberPrediction| {
            let place = if count == 1 { String::new() } else { format!(" of {}", one.name(count)) };
            let seams = one.seams.iter().flatten();
            let pulls = seams.map(|seam| {
                (Some(LineForce(one.largest_pull(seam.pull_N_per_mm))), format!("{}{place}", seam.seam))
            });
            let mut loads: Vec<_> = pulls.collect();
            if loads.is_empty() {
                loads.push((None, format!("seams{place}")));
            }
            loads
        };
        self.chambers.iter().flat_map(of_chamber).collect()
    }

    /// Whether the seal bursts at the pressure; `None` if unknown.
    pub fn bursting(&self) -> Option<Bursting> {
        Some(Bursting::at_pressure(self.pressure_kPa?, self.burst_pressure_kPa?, self.burst_range_kPa))
    }

    /// The refusal of a seal that certainly bursts.
    pub fn bursts(&self) -> Option<Refusal> {
        let _ = self.bursting().filter(|one| *one == Bursting::Yes)?;
        let [safe, _] = self.burst_range_kPa?;
        let finding = bursts_at(Pressure(self.pressure_kPa?), self.burst_pressure_kPa?, self.burst_range_kPa);
        let remedy = format!("at most {} kPa, or a stronger seal or narrower chambers", Most(safe));
        Some(Refusal::new(key::load::PRESSURE, RefusalCode::Bursts, finding, remedy))
    }

    /// Which chambers leave their plane, in words; `None` if none does.
    pub fn leaving(&self) -> Option<String> {
        let names = self.names(|chamber| chamber.leaves_plane == Some(true));
        (!names.is_empty()).then(|| {
            format!(
                "{names} may bend or twist out of the plane of the drawing at this pressure; size, \
                 height and pull are computed for the shape that stays in it"
            )
        })
    }

    /// The names of the chambers that `is_named` takes, in one text.
    fn names(&self, is_named: impl Fn(&ChamberPrediction) -> bool) -> String {
        let count = self.chambers.len();
        let chambers = self.chambers.iter().filter(|chamber| is_named(chamber));
        chambers.map(|chamber| chamber.name(count)).collect::<Vec<String>>().join(", ")
    }

    fn warnings(&self) -> Vec<PredictionWarning> {
        // What makes an answer doubtful, the gravest first: a shape that leaves its plane, wrinkles that are
        // not resolved, a second shape, coarse meshes, a seal that may burst.
        let count = self.chambers.len();
        let leaving = self.leaving().map(|text| PredictionWarning::new(WarningCode::LeavesPlane, text));
        let mut list: Vec<PredictionWarning> = leaving.into_iter().collect();
        let of_shapes = [
            (self.names(|one| one.wrinkles == Some(AVERAGED)), averaged_warning as fn(&str) -> String),
            (self.names(|one| one.wrinkles == Some(BLENDED)), blended_warning),
            (self.names(|one| one.second_shape.is_some()), second_warning),
        ];
        let texts = of_shapes.iter().filter(|(names, _)| !names.is_empty()).map(|(names, text)| text(names));
        list.extend(texts.map(PredictionWarning::from));
        for one in &self.chambers {
            let coarse = [
                one.volume_mm3.map(|v| (v.value, v.mesh_error)),
                one.height_mm.map(|h| (h.value, h.mesh_error)),
            ];
            if coarse.into_iter().flatten().any(|(value, error)| error > 0.05 * value) {
                let text = format!(
                    "the mesh error of the height or volume of {} is above 5 %: use finer meshes",
                    one.name(count)
                );
                list.push(text.into());
            }
        }
        let bursting = match self.bursting() {
            Some(Bursting::Yes) => Some("the pressure is above the seal's burst pressure"),
            Some(Bursting::Perhaps) => {
                Some("the seal may burst: the pressure is within the range of its burst pressure")
            }
            _ => None,
        };
        list.extend(bursting.map(|text| PredictionWarning::new(WarningCode::Bursting, text)));
        list
    }

    /// The answer as one JSON object with a trailing newline.
    ///
    /// # Panics
    /// Never: every field can be written as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data") + "\n"
    }
}
