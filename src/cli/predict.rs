//! `stargrip-cam predict`

use std::path::PathBuf;

use serde::Serialize;

use crate::answer::quantity::{SIZE, evenly, quantity, range};
use crate::cli::failure::{Failure, tell_under};
use crate::cli::load::Loaded;
use crate::cli::material::FabricArg;
use crate::cli::shell::{ShellArgs, not_computed};
use crate::cli::verbosity::Verbosity;
use crate::cli::words::words;
use design::{Design, Refusals};
use forecast::accuracy;
use forecast::drawn;
use forecast::drawn::prediction::DrawnPrediction;
use forecast::model_search::AccuracySearch;
use forecast::predict::{add_curve, predict};
use forecast::prediction::Prediction;
use forecast::report;
use forecast::shell::request::no_pressure;
use forecast::shell::sheet::ModelledSheet;
use forecast::shell::star;
use forecast::shell::star::ShellRefusal;
use forecast::shell::{Detail, SHELL};
use forecast::warning::PredictionWarning;
use inflatable::shell::cases::{InflatedShape, Watch};
use spec::units::{Length, Percent};
use spec::{Allowed, ModelChoice, Spec};

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
    /// The cheapest model with an error of at most this, such as "2 %": the table of section, then coarse, medium and fine shells. It needs a
    /// pressure.
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true, value_parser = quantity::<Percent>(Allowed::half_open(0.0, 100.0)), conflicts_with_all = ["model", "fineness", "vtu", "stl", "obj"])]
    accuracy: Option<Percent>,
    /// Also the force on round objects of these radii, at most 7: "20 mm..40 mm/5".
    #[arg(long, value_name = "FROM..TO/COUNT", allow_hyphen_values = true, value_parser = radii)]
    radii: Option<Radii>,
    #[command(flatten)]
    shell: ShellArgs,
    #[command(flatten)]
    fabric: FabricArg,
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

/// The options of a prediction of a gripper, beside its spec.
#[derive(Clone, Debug)]
pub struct StarQuestion {
    /// The requested model; `None` for the spec's own.
    pub model: Option<ModelChoice>,
    /// Radii of round objects, m.
    pub radii: Vec<f64>,
    /// Fineness of the shell's mesh; by default medium, and coarse for drawings, which are larger.
    pub detail: Option<Detail>,
    /// The largest accepted error, which selects model and fineness.
    pub accuracy: Option<Percent>,
}

/// The prediction of a gripper.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum GripperAnswer {
    /// Of stars.
    Star(Box<Prediction>),
    /// Of a drawing.
    Drawn(Box<DrawnPrediction>),
}

impl GripperAnswer {
    /// The printed text; `spec` is the gripper's. The values of the model are in it only if it `is_full`.
    pub fn text(&self, spec: &Spec, is_full: bool) -> String {
        match self {
            Self::Star(star) => report::text(spec, star, is_full),
            Self::Drawn(drawn) => drawn::text::text(spec, drawn, is_full),
        }
    }

    /// Model of the answer, and its stated error; `detail` is that of a shell's meshes.
    fn stated(&self, detail: Option<Detail>) -> (&'static str, Option<f64>) {
        match self {
            Self::Star(star) => (star.first.model, accuracy::of_stars(star, detail)),
            Self::Drawn(drawn) => (drawn.model, accuracy::of_drawing(drawn)),
        }
    }

    /// The answer with the search that led to it, and its warning.
    #[must_use]
    fn searched(mut self, search: &AccuracySearch) -> Self {
        match &mut self {
            Self::Star(star) => {
                for star in star.stars.iter_mut().chain([&mut star.first]) {
                    star.evidence.accuracy = Some(search.clone());
                    star.evidence.warnings.extend(search.warning().map(PredictionWarning::from));
                }
            }
            Self::Drawn(drawn) => {
                drawn.evidence.accuracy = Some(search.clone());
                drawn.evidence.warnings.extend(search.warning().map(PredictionWarning::from));
            }
        }
        self
    }

    fn json(&self) -> String {
        match self {
            Self::Star(star) => star.to_json(),
            Self::Drawn(drawn) => drawn.to_json(),
        }
    }
}

impl Args {
    /// The question that the arguments describe.
    pub(super) fn question(&self) -> StarQuestion {
        let radii = self.radii.as_ref().map_or_else(Vec::new, |Radii(radii)| radii.clone());
        StarQuestion { model: self.model, radii, detail: self.shell.fineness, accuracy: self.accuracy }
    }

    /// Refuses options about stars for a drawing, for which only the shell is a model.
    fn refuse_those_of_stars(&self) -> Result<(), Failure> {
        let text = if self.radii.is_some() {
            "--radii is for stars: no model predicts the force of a drawn shape on an object"
        } else if self.model.is_some_and(|model| !matches!(model, ModelChoice::Shell | ModelChoice::Auto)) {
            "this --model is one of a star's hinges; only the shell models drawn shapes: leave it out"
        } else {
            return Ok(());
        };
        Err(Failure::Usage(text.to_owned()))
    }
}

impl StarQuestion {
    /// The spec with the requested model, its design, and the refusals of what only its making needs: hose, registration holes, sheet, bed
    /// and frame. A star without these is predicted.
    ///
    /// # Errors
    /// If there is no such star or drawing.
    pub fn designed(&self, loaded: &Loaded) -> Result<(Spec, Design, Option<Refusals>), Refusals> {
        let mut spec = loaded.reading.spec.clone();
        spec.accuracy.model = self.model.unwrap_or(spec.accuracy.model);
        match Design::new(&spec, &loaded.machine) {
            Ok(design) => Ok((spec, design, None)),
            Err(refusals) if spec.has_stars() => match Design::new(&without_making(&spec), &loaded.machine) {
                Ok(design) => Ok((spec, design, Some(refusals))),
                Err(_) => Err(refusals),
            },
            Err(refusals) => Err(refusals),
        }
    }

    /// The prediction of `design`, made from `spec`; with the inflated sheet if the shell is the model.
    ///
    /// # Errors
    /// If the model has no answer, or is cancelled.
    pub fn answer(
        &self,
        (spec, design): (&Spec, &Design),
        watch: &Watch<'_>,
    ) -> Result<(GripperAnswer, Option<InflatedShape>), ShellRefusal> {
        match self.accuracy {
            Some(accuracy) => self.within_error(accuracy, (spec, design), watch),
            None => self.by_model((spec, design), watch),
        }
    }

    /// The prediction by the cheapest model that states an error of at most `accuracy`. The models are tried in turn, from the cheapest on; if
    /// none states so small an error, the answer is that with the least. A shell that refuses counts as a trial without an answer.
    fn within_error(
        &self,
        accuracy: Percent,
        (spec, design): (&Spec, &Design),
        watch: &Watch<'_>,
    ) -> Result<(GripperAnswer, Option<InflatedShape>), ShellRefusal> {
        if spec.load.as_ref().is_none_or(|load| load.pressure.is_none()) {
            return Err(no_pressure());
        }
        let mut search = AccuracySearch::new(accuracy);
        let (mut best, mut first_fault) = (None, None);
        let table = design.assembly().map(|_| None);
        for detail in table.into_iter().chain(Detail::ALL.map(|(_, detail)| Some(detail))) {
            let mut spec = spec.clone();
            spec.accuracy.model = detail.map_or(ModelChoice::Auto, |_| ModelChoice::Shell);
            let question = Self { detail, ..self.clone() };
            match question.by_model((&spec, design), watch) {
                Ok((answer, shape)) => {
                    let (model, error) = answer.stated(detail);
                    let is_met = search.record(model, detail, error);
                    let error = error.unwrap_or(f64::INFINITY);
                    if best.as_ref().is_none_or(|(least, _)| error < *least) {
                        best = Some((error, (answer, shape)));
                    }
                    if is_met {
                        break;
                    }
                }
                Err(ShellRefusal::Cancelled) => return Err(ShellRefusal::Cancelled),
                Err(fault) => {
                    let _ = search.record(SHELL, detail, None);
                    first_fault = first_fault.or(Some(fault));
                }
            }
        }
        match best {
            Some((_, (answer, shape))) => Ok((answer.searched(&search), shape)),
            None => Err(first_fault.unwrap_or_else(no_pressure)),
        }
    }

    /// The prediction by the model of `spec`.
    fn by_model(
        &self,
        (spec, design): (&Spec, &Design),
        watch: &Watch<'_>,
    ) -> Result<(GripperAnswer, Option<InflatedShape>), ShellRefusal> {
        if let Some(pieces) = design.drawn_pieces() {
            let inflation = drawn::inflate(spec, pieces, self.detail.unwrap_or(Detail::Coarse), watch)?;
            let shape = InflatedShape::joined(&inflation.shapes);
            return Ok((GripperAnswer::Drawn(Box::new(inflation.prediction)), Some(shape)));
        }
        let (prediction, shape) = if spec.accuracy.model == ModelChoice::Shell {
            let detail = self.detail.unwrap_or(Detail::Medium);
            let (prediction, shape) = star::predict(spec, design, &self.radii, detail, watch)?;
            (prediction, Some(shape))
        } else {
            let mut prediction = predict(spec, design).map_err(ShellRefusal::Fault)?;
            if !self.radii.is_empty() {
                let radii: Vec<Length> = self.radii.iter().copied().map(Length::from_metres).collect();
                add_curve(spec, design, &radii, &mut prediction).map_err(ShellRefusal::Fault)?;
            }
            (prediction, None)
        };
        Ok((GripperAnswer::Star(Box::new(prediction)), shape))
    }
}

/// `spec` without what has no part in a star's mechanics: the hose, registration holes, limits of sheet and bed, and a frame that fits.
fn without_making(spec: &Spec) -> Spec {
    let mut spec = spec.clone();
    (spec.inlet, spec.mask.bed) = (None, None);
    (spec.sheet.hole_diameter, spec.sheet.width, spec.sheet.height) = (Length(0.0), None, None);
    (spec.frame.clearance, spec.frame.kerf, spec.cut.kerf) = (Length(0.0), Length(0.0), Length(0.0));
    spec
}

/// Predicts, and prints the answer.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    // The inputs of a shell are its cache key: the spec and all that else changes the answer. The other models answer
    // at once and are not kept.
    let loaded = Loaded::with_fabric(&args.spec, &args.fabric, args.verbosity)?;
    let question = args.question();
    let (spec, design, unmade) = question.designed(&loaded).map_err(|refusals| loaded.refused(refusals))?;
    if let Some(refusals) = unmade {
        let list: Vec<String> = refusals.iter().map(|refusal| format!("  - {}", refusal.found)).collect();
        tell_under("predicted, but `check` refuses this design", &list.join("\n"));
    }
    let answer = |watch: &Watch<'_>| {
        let (answer, shape) =
            question.answer((&spec, &design), watch).map_err(|refusal| not_computed(&loaded, refusal))?;
        let sheet = shape.map(|shape| ModelledSheet::of_design(&design, shape));
        Ok((answer.json(), answer.text(&spec, args.verbosity.verbose), sheet))
    };
    let inputs = if let Some(pieces) = design.drawn_pieces() {
        args.refuse_those_of_stars()?;
        format!(
            "predict {spec:?} {:?} {:?} {:?} {:?} {}",
            pieces.air(),
            pieces.inner(),
            pieces.holes(),
            question.accuracy,
            args.verbosity.verbose
        )
    } else if question.accuracy.is_some() || spec.accuracy.model == ModelChoice::Shell {
        format!("predict {spec:?} {:?} {:?} {}", question.radii, question.accuracy, args.verbosity.verbose)
    } else {
        args.shell.not_by_others()?;
        let (json, text, _) = answer(&Watch::default())?;
        return args.verbosity.show(&text, &json);
    };
    args.shell.show(&inputs, args.verbosity, answer)
}

/// Radii of round objects, m.
#[derive(Clone, Debug, PartialEq)]
struct Radii(Vec<f64>);

/// Reads "FROM..TO/COUNT", or one radius.
fn radii(text: &str) -> Result<Radii, String> {
    let ends = |ends: &str| range::<Length>(SIZE)(ends).map(|(from, to)| [from.metres(), to.metres()]);
    evenly(text, MOST_RADII, ends).map(Radii)
}
