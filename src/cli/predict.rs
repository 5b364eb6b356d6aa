//! `stargrip-cam predict`

use std::path::PathBuf;

use crate::answer::quantity::{SIZE, evenly, range};
use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::cli::shell::{ShellArgs, Shown};
use crate::cli::verbosity::Verbosity;
use crate::design::{Design, DrawnPiece};
use crate::forecast::drawn;
use crate::forecast::predict::{PredictFault, add_curve, predict};
use crate::forecast::report;
use crate::forecast::shell::Detail;
use crate::forecast::shell::star;
use crate::forecast::shell::star::ShellRefusal;
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
    #[arg(long, value_name = "MODEL")]
    model: Option<Model>,
    /// Also the force on round objects of these radii: "20 mm..40 mm/5".
    #[arg(long, value_name = "FROM..TO/COUNT", allow_hyphen_values = true, value_parser = radii)]
    radii: Option<Radii>,
    #[command(flatten)]
    shell: ShellArgs,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// The models, by their names on the command line.
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
    /// The cheapest accurate model; never the shell.
    Auto,
}

impl Model {
    /// The model as a spec names it.
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

impl Args {
    /// The requested model.
    pub(super) fn model(&self) -> Option<ModelChoice> {
        self.model.map(Model::choice)
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
        spec.accuracy.model = model.choice();
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
    if args.verbosity.json {
        return say(&prediction.to_json());
    }
    args.verbosity.remark(&report::text(&spec, &prediction))
}

/// Predicts with the shell model, and prints the answer.
fn run_shell(args: &Args, loaded: &Loaded, spec: &Spec, design: &Design) -> Result<(), Failure> {
    let radii = args.radii.as_ref().map_or(&[][..], |radii| &radii.0);
    let question = format!("predict {spec:?} {radii:?}");
    args.shell.show(&question, args.verbosity, |watch| {
        let found = star::predict((spec, design), radii, args.shell.detail(), watch);
        let (prediction, shape) = found.map_err(|refusal| match refusal {
            ShellRefusal::Cancelled => Failure::Interrupted,
            ShellRefusal::Fault(fault) => loaded.refused(no_prediction(&fault).into()),
        })?;
        let vtu = args.shell.wants_vtu().then(|| shape.vtu()).transpose();
        let vtu = vtu.map_err(|fault| Failure::Message(fault.to_string()))?;
        Ok(Shown { json: prediction.to_json(), text: report::text(spec, &prediction), vtu })
    })
}

/// Predicts a drawn piece, for which only the shell is a model.
fn run_drawn(args: &Args, loaded: &Loaded, spec: &Spec, piece: &DrawnPiece) -> Result<(), Failure> {
    if args.radii.is_some() {
        let text = "--radii is for stars: no model predicts the force of a drawn shape on an object";
        return Err(Failure::Usage(text.to_owned()));
    }
    let question = format!("predict {spec:?} {:?} {:?} {:?}", piece.air, piece.inner, piece.part.inside);
    args.shell.show(&question, args.verbosity, |watch| {
        let found = drawn::inflate(spec, piece, args.shell.drawn_detail(), watch);
        let found = found.map_err(|refusal| match refusal {
            ShellRefusal::Cancelled => Failure::Interrupted,
            ShellRefusal::Fault(fault) => loaded.refused(no_prediction(&fault).into()),
        })?;
        let vtu = args.shell.wants_vtu().then(|| InflatedShape::joined(&found.shapes).vtu()).transpose();
        let vtu = vtu.map_err(|fault| Failure::Message(fault.to_string()))?;
        let text = drawn::text::text(spec, &found.prediction);
        Ok(Shown { json: found.prediction.to_json(), text, vtu })
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
