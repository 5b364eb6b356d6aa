//! Drawn chambers under pressure: the shell on the flat regions themselves.
//!
//! [`chambers`] takes the regions from the piece, [`prediction`] is the answer, [`chamber_prediction`] that about one region, with ranges
//! where mesh errors alone do not bound the shape, and [`text`] formats both. No hinge model covers a drawn shape, so without the shell only
//! flat quantities are predicted.

pub mod chamber_prediction;
pub mod chambers;
pub mod measures;
pub mod plates;
pub mod prediction;
pub mod pressures;
pub mod pull;
pub mod seams;
pub mod shapes;
pub mod text;

use crate::drawn::chamber_prediction::ChamberPrediction;
use crate::drawn::chambers::{DrawnChamber, drawn_chambers};
use crate::drawn::measures::PlacedMeasure;
use crate::drawn::prediction::{DrawnEvidence, DrawnPrediction};
use crate::drawn::pressures::{RegionPressure, port_pressures, region_pressures};
use crate::drawn::pull::{PlacedPull, PullPrediction};
use crate::drawn::seams::SeamStrengths;
use crate::predict::PredictFault;
use crate::shell::request::{ShellRefusal, no_pressure, refused};
use crate::shell::work::ShellWork;
use crate::shell::{Detail, SHELL};
use crate::warning::PredictionWarning;
use design::{DrawnPiece, DrawnPieces};
use inflatable::shell::cases::{FlatRegion, InflatedShape, ShellFault, Wrinkles, pull, region};
use spec::units::{Length, Pressure};
use spec::{Load, ModelChoice, Spec, key};

pub use inflatable::shell::cases::{Surface, Watch};

/// Name of the absent model: only flat quantities are predicted.
pub const NONE: &str = "none";

/// How to have the shell computed, in terms of a spec.
pub const HOW: &str = "set `model = \"shell\"` in [accuracy]";
/// How to have it computed once, or always, in terms of commands.
pub const HOW_BY_COMMANDS: &str =
    "run `predict`, or set `model = \"shell\"` in [accuracy] for `check` and `build`";

/// A drawn piece under pressure.
#[derive(Clone, Debug, PartialEq)]
pub struct InflatedDrawing {
    /// In figures.
    pub prediction: DrawnPrediction,
    /// Both sheets of each chamber on its finest mesh, in m and in the frame of the drawing, in the order of the chambers; empty without the
    /// shell.
    pub surfaces: Vec<Surface>,
    /// The upper sheets of the chambers, with stretch and tension.
    pub shapes: Vec<InflatedShape>,
}

/// The prediction of `pieces`, made from `spec`, for `check` and `build`: the shell's on coarse meshes if the spec selects the shell by
/// name, else the flat quantities only. `watch` receives the shell's progress.
///
/// # Errors
/// If the spec selects a model of stars, or the shell refuses or is cancelled.
pub fn of_spec(
    spec: &Spec,
    pieces: &DrawnPieces,
    watch: &Watch<'_>,
) -> Result<InflatedDrawing, PredictFault> {
    let is_requested = spec.accuracy.model == ModelChoice::Shell;
    if is_requested && spec.load.as_ref().is_some_and(|load| load.pressure.is_some()) {
        return inflate(spec, pieces, Detail::Coarse, watch).map_err(|refusal| match refusal {
            ShellRefusal::Fault(fault) => fault,
            ShellRefusal::Cancelled => {
                PredictFault::new(key::accuracy::MODEL, "the computation of the shell was stopped".to_owned())
            }
        });
    }
    let case = DrawnCase::new(spec, pieces)?;
    Ok(InflatedDrawing { prediction: flat(spec, pieces, &case), surfaces: Vec::new(), shapes: Vec::new() })
}

/// `pieces`, made from `spec`, by the shell at the spec's pressure.
///
/// # Errors
/// If no pressure is given, the spec selects a model of stars, or the shell refuses a chamber or is cancelled.
pub fn inflate(
    spec: &Spec,
    pieces: &DrawnPieces,
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<InflatedDrawing, ShellRefusal> {
    let drawn_case = DrawnCase::new(spec, pieces)?;
    let DrawnCase { chambers, pressures, measures: placed, pull: placed_pull } = &drawn_case;
    let mut prediction = flat(spec, pieces, &drawn_case);
    let (_, pressure) = loaded(spec).ok_or_else(no_pressure)?;
    refuse_large(&drawn_case, detail, watch)?;
    let (mut surfaces, mut shapes) = (Vec::new(), Vec::new());
    let (mut is_weave_left_out, mut is_measured_on_folds) = (false, false);
    let strengths = SeamStrengths::new(spec, pieces);
    let count = chambers.len();
    let part_of_chambers = if placed_pull.is_some() { PULL_BEGINS } else { 1.0 };
    for (number, (chamber, answer)) in chambers.iter().zip(&mut prediction.chambers).enumerate() {
        let probes = measures::probes(placed, number);
        let RegionPressure { highest, .. } = &pressures[number];
        let case = case_of(spec, chamber, &pressures[number], probes);
        #[expect(clippy::cast_precision_loss, reason = "few chambers")]
        let ends = [number, number + 1].map(|chambers| part_of_chambers * chambers as f64 / count as f64);
        let inflated = watch
            .run_part(ends, |watch| region(&case, chamber.fineness(detail), watch))
            .map_err(|why| not_inflated(&why, spec, answer, count))?;
        is_weave_left_out |= !case.fabric.weave.is_isotropic() && inflated.wrinkles != Wrinkles::Resolved;
        is_measured_on_folds |= !case.probes.is_empty() && inflated.may_fold(&case);
        answer.fill(&inflated, pieces, *highest, &strengths);
        answer.scale_burst(pressure.0 / highest.0);
        measures::fill(placed, &mut prediction.measures, number, &inflated);
        surfaces.push(inflated.surface);
        shapes.push(inflated.shape);
    }
    prediction.pull = pulled(spec, &drawn_case, detail, watch)
        .map_err(|(number, why)| not_inflated(&why, spec, &prediction.chambers[number], count))?;
    prediction.model = SHELL;
    "only the shell models drawn shapes".clone_into(&mut prediction.evidence.choice);
    prediction.of_all(pressure);
    let folds = [is_measured_on_folds, is_weave_left_out];
    prediction.evidence.warnings.extend(warnings(&prediction, pieces, folds));
    Ok(InflatedDrawing { prediction, surfaces, shapes })
}

/// What the shell leaves out of `prediction`: whether measures depend on folds, and whether the weave does not count, say `folds` and the pieces.
fn warnings(
    prediction: &DrawnPrediction,
    pieces: &DrawnPieces,
    [is_measured_on_folds, is_weave_left_out]: [bool; 2],
) -> Vec<PredictionWarning> {
    let count = prediction.chambers.len();
    let parted: usize = pieces.pieces.iter().map(|piece| piece.shape.topology().chambers.len()).sum();
    let warnings = [
        is_measured_on_folds.then(|| {
            "measures depend on where folds lie: their ranges contain the computed shapes, and other folds may differ by more"
                .to_owned()
        }),
        is_weave_left_out.then(|| {
            "shear_modulus is left out of the mean of wrinkles that are not resolved: there the sheet is isotropic".to_owned()
        }),
        (parted > count).then(|| {
            let pressures = match &prediction.pressures_kPa {
                None => "all are at the same pressure",
                Some(_) => "each is at its own pressure, and bursting means all pressures in proportion",
            };
            format!("walls divide the air into {parted} chambers, which are computed as {count}: {pressures}")
        }),
        pieces.pieces.iter().any(DrawnPiece::shares_a_band).then(|| {
            "chambers share a band, or their bands lie within a band's width of each other: each chamber is computed \
             alone, without the pull of the other on this band"
                .to_owned()
        }),
    ];
    warnings.into_iter().flatten().map(PredictionWarning::from).collect()
}

/// The pull at the bars of `case`, if it has some.
///
/// # Errors
/// The shell's fault, with the index of the chamber.
fn pulled(
    spec: &Spec,
    case: &DrawnCase,
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<Option<PullPrediction>, (usize, ShellFault)> {
    let Some(placed_pull) = &case.pull else { return Ok(None) };
    let number = placed_pull.chamber;
    let chamber = &case.chambers[number];
    let flat_region = case_of(spec, chamber, &case.pressures[number], Vec::new());
    let (request, fineness) = (placed_pull.request(), chamber.fineness(detail));
    let pulled = watch.run_part([PULL_BEGINS, 1.0], |watch| pull(&flat_region, &request, fineness, watch));
    pulled.map(|pulled| Some(placed_pull.prediction(&pulled))).map_err(|fault| (number, fault))
}

/// `chamber` at its pressures, between the plates of `spec`, with the places whose positions are wanted.
fn case_of(
    spec: &Spec,
    chamber: &DrawnChamber,
    pressure: &RegionPressure,
    probes: Vec<[f64; 2]>,
) -> FlatRegion {
    FlatRegion {
        pressure: pressure.highest.pascals(),
        probes,
        partial: pressure.partial.clone(),
        plates: spec.load.as_ref().and_then(|load| load.plates).map(Length::metres),
        ..chamber.region.clone()
    }
}

/// The part of the work after which the pull at bars begins: its strokes take about as long as a chamber from flat and from above.
const PULL_BEGINS: f64 = 0.5;

/// The longest time of a drawing that a command computes unasked, s: six times as many unknowns as a usual drawing has on coarse meshes.
const MOST_SECONDS: f64 = 120.0;

/// Time for three meshes of which the finest has this many unknowns, s, on one processor of 2024. Measured on the shipped drawings on coarse
/// meshes, from flat and from above; meshes without an equilibrium, which are tried again with other edges, take several times as long.
fn seconds(unknowns: f64) -> f64 {
    330.0 * libm::pow(unknowns / 140_000.0, 1.8)
}

/// Tells `watch` the size of the computation before it begins, or refuses a large one.
fn refuse_large(case: &DrawnCase, detail: Detail, watch: &Watch<'_>) -> Result<(), PredictFault> {
    // Each chamber has meshes of its own, and that between bars is computed twice.
    let pulled = case.pull.iter().map(|pull| &case.chambers[pull.chamber]);
    let sizes =
        case.chambers.iter().chain(pulled).map(|chamber| chamber.region.unknowns(chamber.fineness(detail)));
    let work = sizes.fold(ShellWork::default(), |work, unknowns| ShellWork {
        unknowns: work.unknowns + unknowns,
        seconds: work.seconds + seconds(unknowns),
    });
    let words = [
        "the shell of this drawing is large",
        "draw fewer islands or pieces; `model = \"auto\"` leaves the shell out",
    ];
    work.begin(MOST_SECONDS, watch, words)
}

/// The load of `spec` and its pressure; `None` without a pressure.
fn loaded(spec: &Spec) -> Option<(&Load, Pressure)> {
    let load = spec.load.as_ref()?;
    Some((load, load.pressure?))
}

/// A drawn piece ready for the shell: what no shell could take is refused here, for `check` as well.
struct DrawnCase {
    chambers: Vec<DrawnChamber>,
    /// The pressure of each chamber; empty without a pressure.
    pressures: Vec<RegionPressure>,
    measures: Vec<PlacedMeasure>,
    pull: Option<PlacedPull>,
}

impl DrawnCase {
    fn new(spec: &Spec, pieces: &DrawnPieces) -> Result<Self, PredictFault> {
        let chambers = drawn_chambers(spec, pieces)?;
        let model = spec.accuracy.model;
        if !matches!(model, ModelChoice::Shell | ModelChoice::Auto) {
            let word =
                ModelChoice::ALL.iter().find(|(_, own)| *own == model).map_or("this", |(word, _)| word);
            let problem = format!("{word} is a model of a star's hinges; only the shell models drawn shapes");
            return Err(PredictFault {
                remedy: Some(HOW.to_owned()),
                ..PredictFault::new(key::accuracy::MODEL, problem)
            });
        }
        let pressures = match loaded(spec) {
            Some((load, pressure)) => region_pressures(load, pressure, pieces, &chambers)?,
            None => Vec::new(),
        };
        let measures = measures::placed(spec, &pieces.measures, &chambers)?;
        let pull = pull::placed(spec, &pieces.bars, &chambers)?;
        Ok(Self { chambers, pressures, measures, pull })
    }
}

/// The prediction of `case` without a model: flat sizes only.
fn flat(spec: &Spec, pieces: &DrawnPieces, case: &DrawnCase) -> DrawnPrediction {
    let load = loaded(spec);
    let choice = match load {
        None => "the inflated shape depends on the pressure: set `pressure` in [load]".to_owned(),
        Some(_) => format!("not computed here (takes seconds to minutes); {HOW_BY_COMMANDS}"),
    };
    let chambers = case.chambers.iter().enumerate().map(|(number, chamber)| {
        let highest = case.pressures.get(number).map(|pressure| pressure.highest);
        ChamberPrediction::flat(number + 1, chamber, highest)
    });
    DrawnPrediction {
        model: NONE,
        pressure_kPa: load.map(|(_, pressure)| pressure.0),
        pressures_kPa: load.and_then(|(load, _)| port_pressures(load)),
        mass_g: pieces.mass(&spec.fabric),
        chambers: chambers.collect(),
        measures: case.measures.iter().map(PlacedMeasure::flat).collect(),
        evidence: DrawnEvidence { choice, ..DrawnEvidence::default() },
        ..DrawnPrediction::default()
    }
}

/// The reason why the shell refuses a chamber, one of `count`, with the spec key to change.
fn not_inflated(fault: &ShellFault, spec: &Spec, chamber: &ChamberPrediction, count: usize) -> ShellRefusal {
    let [x, y] = chamber.at_mm;
    let subject = if count == 1 {
        String::new()
    } else {
        format!("chamber {}, around X {x:.1} Y {y:.1} mm: ", chamber.chamber)
    };
    refused(fault, &subject, &spec.fabric, |_| key::drawing::FILE)
}
