//! `stargrip-cam predict`

use std::path::PathBuf;

use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::design::Design;
use crate::forecast::predict::predict;
use crate::forecast::report;
use crate::pipeline::no_prediction;
use crate::spec::ModelChoice;

/// Arguments of `predict`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec whose gripper is predicted.
    spec: PathBuf,
    /// The model to use instead of the spec's.
    #[arg(long, value_name = "MODEL")]
    model: Option<Model>,
    /// Print one JSON object and nothing else.
    #[arg(long)]
    json: bool,
}

/// The models, as words of the command line.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum Model {
    /// Published constants.
    Fit,
    /// Exact membrane limit.
    Ring,
    /// Penalised boundary-value problem.
    Bvp,
    /// Bending, stretch and hoop compression at the pressure.
    Section,
    /// The whole sheet in triangles, with arms and contact: seconds to minutes.
    Shell,
    /// The cheapest that is accurate enough; never the shell.
    Auto,
}

impl Model {
    /// The same in the words of a spec.
    pub(super) fn choice(self) -> ModelChoice {
        match self {
            Self::Fit => ModelChoice::Fit,
            Self::Ring => ModelChoice::Ring,
            Self::Bvp => ModelChoice::Bvp,
            Self::Section => ModelChoice::Section,
            Self::Shell => ModelChoice::Shell,
            Self::Auto => ModelChoice::Auto,
        }
    }
}

/// Predicts, and prints the answer.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::new(&args.spec)?;
    let mut spec = loaded.reading.spec.clone();
    if let Some(model) = args.model {
        spec.accuracy.model = model.choice();
    }
    let design = Design::new(&spec, &loaded.machine).map_err(|refusals| loaded.refused(refusals))?;
    let prediction = predict(&spec, &design).map_err(|fault| loaded.refused(no_prediction(&fault).into()))?;
    if args.json {
        return say(&prediction.to_json());
    }
    say(&report::text(&spec, &prediction))
}
