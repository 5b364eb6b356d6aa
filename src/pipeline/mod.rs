//! The pipeline: the states of a gripper from its spec to files that may be published.
//!
//! ```text
//! Spec, Machine -> Planned -> Forecast -> Built -> Proven
//!                     |           |         |         |
//!                 geometry,  prediction   files    read back
//!                 programs
//! ```
//!
//! Each step refuses invalid input, and no step can be skipped: `check` and `build` go as far as [`Proven`], the only state that can be
//! published, and `build` publishes it. `verify` takes the same steps from the files of a directory.

mod aligned;
mod code;
mod coupons;
mod directory;
mod feed_check;
mod files;
mod interface;
mod links;
mod load_check;
mod planned;
mod precautions;
mod proven;
mod refused;
mod sheet_alignment;
mod weak_process;

use crate::manifest::Manifest;
use design::{Design, Refusals};
use forecast::drawn::{InflatedDrawing, Watch, of_spec};
use forecast::predict::predict;
use forecast::prediction::Prediction;
use program::plan::Program;
use proof::artifact::{Artifact, KindRequest};
use spec::{Machine, Spec};

pub use aligned::align;
pub use code::{CommandCode, PrecautionCode};
pub use coupons::{MadeCoupons, OVERVIEW, ProvenCoupons, TABLE};
pub use feed_check::{FeedCheckFault, PACKAGE_ENDING, ProvenFeedCheck, feed_check, prove_feed_check};
pub use interface::Interface;
pub use planned::{Planned, no_prediction, no_programs, no_requested_programs};
pub use precautions::Precaution;
pub use proven::{Proven, PublishedBuild, prove_files, read_back};
pub use refused::unfit_besides;
pub use sheet_alignment::{AlignedFault, read_mark};
pub use weak_process::FirstLoop;

/// A gripper with the prediction of its behaviour.
#[derive(Clone, Debug)]
pub struct Forecast {
    /// The parsed spec.
    pub spec: Spec,
    /// The machine profile.
    pub machine: Machine,
    /// The exact geometry.
    pub design: Design,
    /// The sealing programs.
    pub programs: Vec<Program>,
    /// The trace programs.
    pub traces: Vec<Program>,
    /// The programs that cut the sheets after the seal.
    pub cuts: Vec<Program>,
    /// The prediction of its stars; `None` if the spec has no load.
    pub prediction: Option<Prediction>,
    /// The prediction of a drawn piece; `None` if the spec has no load.
    pub drawn: Option<InflatedDrawing>,
}

/// A gripper with its files, in memory. They have not been read back yet.
#[derive(Clone, Debug)]
pub struct Built {
    /// The gripper, its programs and its prediction.
    pub forecast: Forecast,
    /// The files, without the manifest.
    pub artifacts: Vec<Artifact>,
    /// The manifest of the files.
    pub manifest: Manifest,
}

/// The source texts of a build; they are published with it, so that it can be proven from its directory alone.
#[derive(Clone, Copy, Debug)]
pub struct Sources<'a> {
    /// The spec, unchanged.
    pub spec: &'a str,
    /// The resolved machine profile.
    pub machine: &'a str,
}

impl Planned {
    /// The geometry of `spec`, in which the inlet is the only opening for air, and its programs for `machine`.
    ///
    /// # Errors
    /// All reasons why it cannot be made or would leak, or why the machine cannot run the programs.
    pub fn new(spec: Spec, machine: Machine) -> Result<Self, Refusals> {
        match Design::new(&spec, &machine) {
            Ok(design) => planned::planned(spec, machine, design),
            Err(refusals) => Err(refused::refused(&spec, &machine, refusals)),
        }
    }

    /// Predicts the behaviour, if the spec has a load; `watch` receives the progress of the shell computation of drawn pieces.
    ///
    /// # Errors
    /// If the model that the spec requests has no answer, or if the shell computation was cancelled.
    pub fn forecast(self, watch: &Watch<'_>) -> Result<Forecast, Refusals> {
        let Self { spec, machine, design, programs, traces, cuts } = self;
        let loaded_stars = design.assembly().filter(|_| spec.load.is_some());
        let prediction = loaded_stars.map(|_| predict(&spec, &design)).transpose();
        let prediction = prediction.map_err(|fault| no_prediction(&fault))?;
        let loaded_pieces = design.drawn_pieces().filter(|_| spec.load.is_some());
        let drawn_forecast = loaded_pieces.map(|pieces| of_spec(&spec, pieces, watch)).transpose();
        let drawn_forecast = drawn_forecast.map_err(|fault| no_prediction(&fault))?;
        Ok(Forecast { spec, machine, design, programs, traces, cuts, prediction, drawn: drawn_forecast })
    }
}

impl Forecast {
    /// All steps up to here: a spec that passes them is not refused later.
    ///
    /// # Errors
    /// The refusals of the first step that fails.
    pub fn new(spec: Spec, machine: Machine) -> Result<Self, Refusals> {
        Planned::new(spec, machine)?.forecast(&Watch::default())
    }
}

/// All steps up to [`Built`].
///
/// # Errors
/// The refusals of the first step that fails.
pub fn build(
    spec: &Spec,
    machine: &Machine,
    sources: Sources<'_>,
    request: &KindRequest,
) -> Result<Built, Refusals> {
    Ok(Forecast::new(spec.clone(), machine.clone())?.build(sources, request))
}
