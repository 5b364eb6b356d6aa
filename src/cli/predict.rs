//! `stargrip-cam predict`

use std::path::PathBuf;

use crate::answer::quantity::{SIZE, evenly, range};
use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::shell::{ShellArgs, not_computed};
use crate::cli::verbosity::Verbosity;
use crate::cli::words::words;
use crate::design::{Design, DrawnPiece};
use crate::forecast::drawn;
use crate::forecast::predict::{PredictFault, add_curve, predict};
use crate::forecast::report;
use crate::forecast::shell::Detail;
use crate::forecast::shell::star;
use crate::pipeline::no_prediction;
use crate::spec::{ModelChoice, Spec};
use crate::units::Length;
use inflatable::shell::cases::InflatedShape;

/// Largest number of radii of one curve: each is reached in steps.
const MOST_RADII: u32 = 7;

/// Arguments of `predict`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec whose gripper is predicted.
    spec: PathBuf,
    /// The model to use instead of the spec's.
    #[arg(long, value_name = "MODEL", value_parser = words(&ModelChoice::ALL, &MODELS))]
    model: Option<ModelChoice>,
    /// Also the force on round objects of these radii, at most 7: "20 mm..40 mm/5".
    #[arg(long, value_name = "FROM..TO/COUNT", allow_hyphen_values = true, value_parser = radii)]
    radii: Option<Radii>,
    #[command(flatten)]
    shell: ShellArgs,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// The help of the models, in the order of [`ModelChoice::ALL`].
pub(super) const MODELS: [&str; 6] = [
    "Published constants",
    "Exact membrane limit",
    "Penalised boundary-value problem",
    "Bending, stretch and hoop compression at the pressure",
    "The whole sheet in triangles, with arms and contact: seconds to minutes",
    "The cheapest accurate model; never the shell",
];

impl Args {
    /// The requested model.
    pub(super) fn model(&self) -> Option<ModelChoice> {
        self.model
    }

    /// The radii of round objects, m.
    pub(super) fn radii(&self) -> &[f64] {
        self.radii.as_ref().map_or(&[], |radii| &radii.0)
    }

    /// Fineness of the shell's mesh.
    pub(super) fn detail(&self) -> Detail {
        self.shell.detail()
    }
}

/// Predicts, and prints the answer.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::spoken(&args.spec, args.verbosity)?;
    let mut spec = loaded.reading.spec.clone();
    if let Some(model) = args.model {
        spec.accuracy.model = model;
    }
    let design = Design::new(&spec, &loaded.machine).map_err(|refusals| loaded.refused(refusals))?;
    if let Some(piece) = design.drawn() {
        return run_drawn(args, &loaded, &spec, piece);
    }
    if spec.accuracy.model == ModelChoice::Shell {
        return run_shell(args, &loaded, &spec, &design);
    }
    args.shell.not_by_others()?;
    let refused = |fault: PredictFault| loaded.refused(no_prediction(&fault).into());
    let mut prediction = predict(&spec, &design).map_err(refused)?;
    if let Some(Radii(radii)) = &args.radii {
        let radii: Vec<Length> = radii.iter().copied().map(Length::from_metres).collect();
        add_curve((&spec, &design), &radii, &mut prediction).map_err(refused)?;
    }
    args.verbosity.show(&report::text(&spec, &prediction), &prediction.to_json())
}

/// Predicts with the shell model, and prints the answer.
fn run_shell(args: &Args, loaded: &Loaded, spec: &Spec, design: &Design) -> Result<(), Failure> {
    let radii = args.radii();
    let question = format!("predict {spec:?} {radii:?}");
    args.shell.show(&question, args.verbosity, |watch| {
        let found = star::predict((spec, design), radii, args.shell.detail(), watch);
        let (prediction, shape) = found.map_err(|refusal| not_computed(loaded, refusal))?;
        Ok((prediction.to_json(), report::text(spec, &prediction), shape))
    })
}

/// Predicts a drawn piece, for which only the shell is a model.
fn run_drawn(args: &Args, loaded: &Loaded, spec: &Spec, piece: &DrawnPiece) -> Result<(), Failure> {
    if args.radii.is_some() {
        let text = "--radii is for stars: no model predicts the force of a drawn shape on an object";
        return Err(Failure::Usage(text.to_owned()));
    }
    if args.model.is_some_and(|model| !matches!(model, ModelChoice::Shell | ModelChoice::Auto)) {
        let text = "this --model is one of a star's hinges; only the shell models drawn shapes: leave it out";
        return Err(Failure::Usage(text.to_owned()));
    }
    let question = format!("predict {spec:?} {:?} {:?} {:?}", piece.air, piece.inner, piece.part.inside);
    args.shell.show(&question, args.verbosity, |watch| {
        let found = drawn::inflate(spec, piece, args.shell.drawn_detail(), watch);
        let found = found.map_err(|refusal| not_computed(loaded, refusal))?;
        let text = drawn::text::text(spec, &found.prediction);
        Ok((found.prediction.to_json(), text, InflatedShape::joined(&found.shapes)))
    })
}

/// Radii of round objects, m.
#[derive(Clone, Debug, PartialEq)]
struct Radii(Vec<f64>);

/// Reads "FROM..TO/COUNT", or one radius.
fn radii(text: &str) -> Result<Radii, String> {
    evenly(text, MOST_RADII, |ends| {
        range::<Length>(SIZE)(ends).map(|(from, to)| [from.metres(), to.metres()])
    })
    .map(Radii)
}
