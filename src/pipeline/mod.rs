//! The spine: the states that a gripper goes through on its way from a spec to files that may be published.
//!
//! ```text
//! Spec, Machine -> Designed -> Planned -> Forecast -> Built -> Proven
//!                     |           |           |         |         |
//!                 geometry    programs   prediction   files    read back
//! ```
//!
//! Each step refuses what it finds wrong, and there is no way around it: `check` and `build` go as far as [`Proven`], which is all
//! that can be published, and `build` publishes it; `verify` takes the same steps from the files of a directory.

mod code;
mod coupons;
mod directory;
mod feed_check;
mod files;
mod links;
mod load_check;
mod precautions;
mod proven;

use crate::airtight;
use crate::artifact::{Artifact, Asked};
use crate::design::{Design, Refusal, RefusalCode, Refusals};
use crate::forecast::drawn::{InflatedDrawing, Watch, of_spec};
use crate::forecast::predict::{PredictFault, predict};
use crate::forecast::prediction::Prediction;
use crate::manifest::Manifest;
use crate::plan;
use crate::plan::Program;
use crate::spec::{Machine, Spec};

pub use code::{CommandCode, PrecautionCode};
pub use coupons::{MadeCoupons, OVERVIEW, ProvenCoupons, TABLE};
pub use feed_check::{FeedCheckFault, ProvenFeedCheck, feed_check, prove_feed_check};
pub use precautions::Precaution;
pub use proven::{Proven, PublishedBuild, prove_files, read_back};

/// A gripper whose geometry exists, without a way for air but the inlet.
#[derive(Clone, Debug)]
pub struct Designed {
    /// What was asked for.
    pub spec: Spec,
    /// What it is made on.
    pub machine: Machine,
    /// The exact geometry.
    pub design: Design,
}

/// A gripper that the machine can seal.
#[derive(Clone, Debug)]
pub struct Planned {
    /// What was asked for.
    pub spec: Spec,
    /// What it is made on.
    pub machine: Machine,
    /// The exact geometry.
    pub design: Design,
    /// The sealing programs.
    pub programs: Vec<Program>,
    /// The trace programs.
    pub traces: Vec<Program>,
}

/// A gripper of which is known what it will do.
#[derive(Clone, Debug)]
pub struct Forecast {
    /// What was asked for.
    pub spec: Spec,
    /// What it is made on.
    pub machine: Machine,
    /// The exact geometry.
    pub design: Design,
    /// The sealing programs.
    pub programs: Vec<Program>,
    /// The trace programs.
    pub traces: Vec<Program>,
    /// What its stars will do; `None` if the spec has no load.
    pub prediction: Option<Prediction>,
    /// What a drawn piece will do; `None` if the spec has no load.
    pub drawn: Option<InflatedDrawing>,
}

/// A gripper with its files, in memory. Nobody has read them back yet.
#[derive(Clone, Debug)]
pub struct Built {
    /// The gripper, its programs and what it will do.
    pub forecast: Forecast,
    /// The files, without the manifest.
    pub artifacts: Vec<Artifact>,
    /// The manifest of the files.
    pub manifest: Manifest,
}

/// The texts that a build is made from; they are published with it, so that it can be proven from its directory alone.
#[derive(Clone, Copy, Debug)]
pub struct Sources<'a> {
    /// The spec as read.
    pub spec: &'a str,
    /// The machine profile as resolved.
    pub machine: &'a str,
}

impl Designed {
    /// The geometry of `spec` for `machine`.
    ///
    /// # Errors
    /// Every reason for which it cannot be made, or would leak.
    pub fn new(spec: Spec, machine: Machine) -> Result<Self, Refusals> {
        let design = Design::new(&spec, &machine)?;
        airtight::leaks(&spec, &machine, &design).or(())?;
        Ok(Self { spec, machine, design })
    }

    /// The programs that make it.
    ///
    /// # Errors
    /// Every reason for which the machine cannot run them.
    pub fn plan(self) -> Result<Planned, Refusals> {
        let Self { spec, machine, design } = self;
        // Before they are made: they may be more than there is memory for.
        let too_many: Refusals = plan::too_many_moves(&spec, &machine, &design).into_iter().collect();
        too_many.or(())?;
        let programs = plan::seal_programs(&spec, &machine, &design);
        let traces = plan::trace_programs(&spec, &machine, &design);
        plan::refusals(&spec, &machine, &programs, &traces).or(())?;
        Ok(Planned { spec, machine, design, programs, traces })
    }
}

impl Planned {
    /// What it will do, where the spec has a load.
    ///
    /// # Errors
    /// If the model that the spec asks for has no answer.
    pub fn forecast(self) -> Result<Forecast, Refusals> {
        self.watched_forecast(&Watch::default())
    }

    /// The same; `watch` hears how far the shell of a drawn piece is.
    ///
    /// # Errors
    /// If the model that the spec asks for has no answer, or the shell was told to stop.
    pub fn watched_forecast(self, watch: &Watch<'_>) -> Result<Forecast, Refusals> {
        let asked = self.design.assembly().filter(|_| self.spec.load.is_some());
        let prediction = asked.map(|_| predict(&self.spec, &self.design)).transpose();
        let prediction = prediction.map_err(|fault| no_prediction(&fault))?;
        let drawn = self.design.drawn().filter(|_| self.spec.load.is_some());
        let drawn = drawn.map(|piece| of_spec(&self.spec, piece, watch)).transpose();
        let drawn = drawn.map_err(|fault| no_prediction(&fault))?;
        let Self { spec, machine, design, programs, traces } = self;
        Ok(Forecast { spec, machine, design, programs, traces, prediction, drawn })
    }
}

impl Forecast {
    /// All steps up to here: everything that a spec can be refused for.
    ///
    /// # Errors
    /// What the first step that refuses has to say.
    pub fn of(spec: Spec, machine: Machine) -> Result<Self, Refusals> {
        Designed::new(spec, machine)?.plan()?.forecast()
    }
}

/// All steps up to [`Built`].
///
/// # Errors
/// What the first step that refuses has to say.
pub fn build(spec: &Spec, machine: &Machine, sources: Sources<'_>, asked: &Asked) -> Result<Built, Refusals> {
    Ok(Forecast::of(spec.clone(), machine.clone())?.build(sources, asked))
}

/// A prediction that cannot be made, as a refusal at the key that stands in its way.
pub fn no_prediction(fault: &PredictFault) -> Refusal {
    let key = fault.star.map_or(fault.key, |star| fault.key.of_star(star));
    Refusal::new(key, RefusalCode::NoPrediction, fault.what.clone(), "needed for a prediction".to_owned())
}
