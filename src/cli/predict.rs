//! `stargrip-cam predict`

use std::path::PathBuf;

use crate::cli::failure::Failure;
use crate::cli::failure::say;
use crate::cli::load::Loaded;
use crate::design::Refusal;
use crate::mechanics::predict::PredictFault;
use crate::mechanics::predict::predict;
use crate::mechanics::report;
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
enum Model {
    /// Published constants.
    Fit,
    /// Exact membrane limit.
    Ring,
    /// Penalised boundary-value problem.
    Bvp,
    /// Geometrically nonlinear shell.
    Shell,
    /// The cheapest that is accurate enough.
    Auto,
}

/// Predicts, and prints the answer.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::new(&args.spec)?;
    let mut spec = loaded.reading.spec.clone();
    if let Some(model) = args.model {
        spec.accuracy.model = match model {
            Model::Fit => ModelChoice::Fit,
            Model::Ring => ModelChoice::Ring,
            Model::Bvp => ModelChoice::Bvp,
            Model::Shell => ModelChoice::Shell,
            Model::Auto => ModelChoice::Auto,
        };
    }
    let prediction = predict(&spec).map_err(|fault| loaded.refused(vec![refusal(&fault)]))?;
    if args.json {
        let text = serde_json::to_string_pretty(&prediction)
            .map_err(|error| Failure::Message(format!("cannot write JSON: {error}")))?;
        return say(&format!("{text}\n"));
    }
    say(&report::text(&spec, &prediction))
}

/// A fault of the prediction as a refusal at its key.
pub(super) fn refusal(fault: &PredictFault) -> Refusal {
    let star =
        fault.star.and_then(|star| u32::try_from(star).ok()).filter(|_| fault.key.starts_with("star."));
    let remedy = "needed for a prediction".to_owned();
    Refusal { star, ..Refusal::new(fault.key, "no-prediction", fault.what.clone(), remedy) }
}
