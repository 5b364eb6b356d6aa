//! From a spec to the prediction: selects the model, evaluates every star, and adds the evidence.

use crate::case::{Case, weave};
use crate::interval::{mm, relative_error};
use crate::model_selection::{bvp, corrected, hinge_model, limits_of_validity, named_limit, tabled};
use crate::outcome::{Grip, Outcome};
use crate::payload::{Bearers, stack_payload, wrinkling_warnings};
use crate::prediction::StackPayload;
use crate::prediction::{ForceAt, ModelEvidence, Prediction, StarPrediction};
use crate::pressures::{LEAST, MOST, modelled, rows};
use crate::ranges::{Domain, Ranges, errors, outside_domain};
use crate::remembered::Remembered;
use crate::seal_forecast::{SealForecast, per_mm};
use crate::seal_load::Bursting;
use crate::shell::by_shell;
use crate::star_answer::{geometry_warnings, nonlinear_variant, without_model, write_outcome};
pub use crate::star_refusal::PredictFault;
use crate::star_refusal::located;
use crate::verdict::{refusals, verdict};
use crate::warning::{PredictionWarning, WarningCode};
use design::{Design, Meeting, StarAssembly, StarDesign};
use inflatable::mechanics::fault::{HingeFault, StarFault};
use inflatable::mechanics::hinge::bvp::Bvp;
use inflatable::mechanics::hinge::{HingeModel, Level};
use inflatable::mechanics::star::response::Inflated;
use spec::units::{Length, Pressure};
use spec::{Fabric, ModelChoice, ObjectShape, Spec, key};
use std::iter::repeat;

/// Predicts the stars of `design`, made from `spec`, by `accuracy.model`.
///
/// # Errors
/// If a model refuses one of the hinges, is not available, or covers no such product.
pub fn predict(spec: &Spec, design: &Design) -> Result<Prediction, PredictFault> {
    let design = stars_of(design)?;
    let models = StarModels::new();
    let mut stars = predict_stars(spec, design, &models)?;
    let safe = safe_pressure(spec, design, &models, &stars);
    for star in &mut stars {
        star.evidence.safe_pressure_kPa = safe;
    }
    let mut prediction = assembled_prediction(spec, design, stars)?;
    prediction.verdict = verdict(spec, &prediction);
    Ok(prediction)
}

/// The payload of `stars`, the predicted ones of `design`, on the object of `spec`.
fn payload_of(spec: &Spec, design: &StarAssembly, stars: &[StarPrediction]) -> StackPayload {
    let meetings = design.meetings(spec).unwrap_or_default();
    let slopes = meetings.iter().map(|meeting| meeting.slope).chain(repeat(0.0));
    let bearers: Vec<Bearers> =
        stars.iter().zip(slopes).map(|(star, slope)| Bearers::of_star(star, slope)).collect();
    spec.load.as_ref().map_or_else(StackPayload::default, |load| stack_payload(load, &bearers))
}

/// The prediction of the gripper of `spec` with these stars of `design`, bottom first, without a verdict.
pub(super) fn assembled_prediction(
    spec: &Spec,
    design: &StarAssembly,
    mut stars: Vec<StarPrediction>,
) -> Result<Prediction, PredictFault> {
    let payload = payload_of(spec, design, &stars);
    let warnings = spec.load.as_ref().map_or_else(Vec::new, |load| wrinkling_warnings(load, &stars));
    for (star, warning) in stars.iter_mut().zip(warnings) {
        star.evidence.warnings.extend(warning.map(PredictionWarning::from));
    }
    let Some(mut first) = stars.first().cloned() else {
        return Err(PredictFault::new(key::stack::COUNT, "there is no star".to_owned()));
    };
    (first.payload_kg, first.ranges.payload_kg) = (payload.kg, payload.range_kg);
    let stack_mass_g = stars.iter().map(|star| star.mass_g).sum();
    Ok(Prediction { first, verdict: None, stack_mass_g, stars })
}

/// The largest pressure, kPa, at which none of the seals that burst may do so; `None` if none bursts, or the gripper does not meet its load
/// there either.
fn safe_pressure(
    spec: &Spec,
    design: &StarAssembly,
    models: &StarModels,
    stars: &[StarPrediction],
) -> Option<f64> {
    let bursting = stars.iter().filter(|star| star.evidence.bursting == Some(Bursting::Yes));
    let safe = bursting.filter_map(|star| star.evidence.safe_pressure_kPa).reduce(f64::min)?;
    let mut safer = spec.clone();
    safer.load.get_or_insert_default().pressure = Some(Pressure(safe));
    let prediction =
        assembled_prediction(&safer, design, predict_stars(&safer, design, models).ok()?).ok()?;
    refusals(&safer, &prediction).is_empty().then_some(safe)
}

/// All stars of `design`, bottom first.
fn predict_stars(
    spec: &Spec,
    design: &StarAssembly,
    models: &StarModels,
) -> Result<Vec<StarPrediction>, PredictFault> {
    // One of each star, or none without an object.
    let meetings = design.meetings(spec).unwrap_or_default();
    let mut stars: Vec<StarPrediction> = Vec::with_capacity(design.stars.len());
    for (i, placed) in design.stars.iter().enumerate() {
        // Stars of a stack are often equal; a slow model then answers once.
        let mut earlier = design.stars.iter().take(i).enumerate();
        let opening = design.frame.opening_below(placed.index);
        let twin = earlier.find(|(j, other)| {
            let meets_alike = meetings.is_empty() || meetings[*j].is_like(&meetings[i]);
            other.distinct == placed.distinct
                && meets_alike
                && design.frame.opening_below(other.index) == opening
        });
        let part = design.part(placed);
        stars.push(match twin {
            Some((twin, _)) => stars[twin].clone(),
            None => predict_star(spec, part, meetings.get(i).copied(), opening, models)
                .map_err(|fault| located(placed.index, spec, part, &fault))?,
        });
    }
    Ok(stars)
}

/// The stars of `design`: no model covers another product.
pub(super) fn stars_of(design: &Design) -> Result<&StarAssembly, PredictFault> {
    let problem = "a drawn shape is not a star; only the shell models it".to_owned();
    let remedy = Some("use `predict`".to_owned());
    design.assembly().ok_or_else(|| PredictFault { remedy, ..PredictFault::new(key::drawing::FILE, problem) })
}

/// Adds to `prediction`, which is that of `spec` and `design`, the forces on round objects of `radii`.
///
/// # Errors
/// The errors of [`predict`].
pub fn add_curve(
    spec: &Spec,
    design: &Design,
    radii: &[Length],
    prediction: &mut Prediction,
) -> Result<(), PredictFault> {
    let mut spec_around = spec.clone();
    let mut curves = vec![Vec::new(); prediction.stars.len()];
    for radius in radii {
        let load = spec_around.load.get_or_insert_default();
        load.object_radius = Some(*radius);
        // Each star around a cylinder that no star ends above or below.
        (load.object_height, load.object_shape) = (Some(ENDLESS), Some(ObjectShape::Cylinder));
        let stars = predict(&spec_around, design)?.stars;
        for (curve, star) in curves.iter_mut().zip(&stars) {
            let [low, high] = star.ranges.object_force_N.map_or([None; 2], |range| range.map(Some));
            curve.push(ForceAt { radius: radius.0, force: star.object_force_N, low, high });
        }
    }
    for (star, curve) in prediction.stars.iter_mut().zip(curves) {
        star.force_curve = Some(curve);
    }
    prediction.first.force_curve = prediction.stars.first().and_then(|star| star.force_curve.clone());
    Ok(())
}

/// Height of a cylinder that no stack is as high as: the largest length of a spec.
const ENDLESS: Length = Length(1e5);

/// Models that the stars of a gripper share, because they depend on the hinge alone.
struct StarModels {
    /// The slow one: a hinge of it takes milliseconds.
    bvp: Remembered<Bvp>,
}

impl StarModels {
    fn new() -> Self {
        Self { bvp: Remembered::new(bvp()) }
    }
}

/// One star with its case and inputs.
struct PlacedCase<'a> {
    spec: &'a Spec,
    part: &'a StarDesign,
    case: Case,
    seal: SealForecast,
}

/// The star of `part` that meets the object as `meeting` specifies, above a plate with an opening of this radius, mm.
fn predict_star(
    spec: &Spec,
    part: &StarDesign,
    meeting: Option<Meeting>,
    opening: Option<f64>,
    models: &StarModels,
) -> Result<StarPrediction, StarFault> {
    let case = Case::of_part(spec, part)?.meeting(meeting).above_plate(opening);
    let placed = PlacedCase { spec, part, case, seal: SealForecast::new(spec, &case, &part.star) };
    let width = case.mechanism.width;
    let Some(level) = named_limit(spec.accuracy.model) else { return placed.by_table() };
    let choice = format!("{} was requested", level.name());
    if level == Level::Bvp {
        return placed.by_model(&models.bvp, choice);
    }
    let model = hinge_model(level, &case.sheet, case.pressure, width)?;
    placed.by_model(model.as_ref(), choice)
}

impl PlacedCase<'_> {
    /// The prediction by the table of `section`, the cheapest model that covers a star at its pressure. Where that does not cover it, or no
    /// pressure is given, `section` by name is refused, and `auto` gives the values that need no model.
    fn by_table(&self) -> Result<StarPrediction, StarFault> {
        let is_requested = self.spec.accuracy.model == ModelChoice::Section;
        let Some(pressure) = self.case.pressure else {
            if is_requested {
                return Err(StarFault::NoPressure);
            }
            let reason = "the prediction depends on the pressure, and none is given";
            let pressure_rows = rows(&self.case, self.seal.burst, self.seal.safe_pressure());
            let mut star = self.unknown(reason.to_owned());
            if pressure_rows.is_empty() {
                let text = format!(
                    "no pressure from {LEAST} to {MOST} kPa has a prediction for this star: {}",
                    errors::UNKNOWN_MESSAGE
                );
                star.evidence.warnings.push(text.into());
            }
            return Ok(StarPrediction { pressures: Some(pressure_rows), ..star });
        };
        match tabled(&self.case, pressure) {
            Ok(model) => {
                let choice = if is_requested {
                    "section was requested"
                } else {
                    "section covers this star at its pressure, from its table"
                };
                self.by_model(&model, choice.to_owned())
            }
            Err(fault @ StarFault::Hinge(HingeFault::Scale { .. } | HingeFault::RStar { .. }))
                if !is_requested =>
            {
                let reason = format!("section does not cover this star: {fault}");
                let mut unknown = self.unknown(reason.clone());
                let warnings = &mut unknown.evidence.warnings;
                warnings.insert(0, PredictionWarning::new(WarningCode::NoModel, reason));
                warnings.extend(self.by_shell().map(PredictionWarning::from));
                unknown.modelled_kPa = modelled(&self.case);
                Ok(unknown)
            }
            Err(fault) => Err(fault),
        }
    }

    /// The prediction by `model`.
    fn by_model(&self, model: &dyn HingeModel, choice: String) -> Result<StarPrediction, StarFault> {
        let case = &corrected(&self.case, model)?;
        // Angles and radii of a limit do not depend on the pressure: without one, any will do.
        let inflated = Inflated::new(&case.mechanism, model, case.pressure.unwrap_or(1.0))?;
        let outcome = Outcome::linear(case, &inflated);
        // Needed for a remedy only.
        let presses = outcome.force_range.is_some_and(|[low, _]| low > 0.0);
        let object =
            if presses || outcome.hold.is_none() { None } else { outcome.surely_held(case, &inflated) };
        let mut star = self.unknown(if outcome.known { choice } else { untried_message(case) });
        let warnings = &mut star.evidence.warnings;
        warnings.extend(limits_of_validity(model, case).into_iter().map(PredictionWarning::from));
        warnings.extend(self.range_warning(&outcome));
        if outcome.known {
            warnings.extend(geometry_warnings(case, &outcome).into_iter().map(PredictionWarning::from));
            let object_warning = outcome.object_warning(case);
            warnings.extend(object_warning.map(|text| PredictionWarning::new(WarningCode::Object, text)));
            star.evidence.surely_held_mm = object.map(mm);
        }
        star.nonlinear = nonlinear_variant(case, &inflated, &outcome, self.spec.accuracy.response, warnings);
        write_outcome(&mut star, case, &inflated, &outcome)?;
        if !outcome.known {
            star.evidence.warnings.extend(self.by_shell().map(PredictionWarning::from));
            star.modelled_kPa = modelled(&self.case);
        }
        Ok(star)
    }

    /// The values that need no model, with the reason why no model applies.
    fn unknown(&self, choice: String) -> StarPrediction {
        // The values of the flat star come first. The seal adds its loads and warnings, and the spec the warnings about
        // what no hinge model uses.
        let Self { case, part, spec, seal } = self;
        let bursting = seal.warning().map(|text| PredictionWarning::new(WarningCode::Bursting, text));
        let mut warnings: Vec<PredictionWarning> = bursting.into_iter().collect();
        if spec.accuracy.model == ModelChoice::Shell {
            let text = "section is used here instead of shell: files must be the same on every machine, but a \
                        shell's last digits are not; use `predict` with the model \"shell\"";
            warnings.push(PredictionWarning::new(WarningCode::Validity, text));
        }
        warnings.extend(weave_left_out(&spec.fabric).map(PredictionWarning::from));
        let star = without_model(spec, part, case);
        StarPrediction {
            model: Level::Section.name(),
            seal_load: seal.load,
            seal_pull_N_per_mm: seal.pull.map(|(pull, ..)| per_mm(pull)),
            seal_pull_at: seal.pull.map(|(.., place)| place),
            burst_pressure_kPa: seal.burst.map(|p| Pressure::from_pascals(p).0),
            burst_margin: seal.burst.zip(case.pressure).map(|(burst, p)| burst / p),
            ranges: seal.ranges(),
            evidence: ModelEvidence {
                choice,
                numerical_error: Some(0.0),
                safe_radius_mm: seal.safe.map(|radius| radius.0),
                safe_pressure_kPa: seal.safe_pressure().map(|p| Pressure::from_pascals(p).0),
                warnings,
                bursting: seal.bursting,
                ..star.evidence.clone()
            },
            hold: case.pressure.and(case.object).map(|_| Grip::Untried),
            ..star
        }
    }

    /// The way to a prediction by the shell, if that covers the star.
    fn by_shell(&self) -> Option<String> {
        by_shell(&self.case, weave(&self.spec.fabric).ok()?)
    }

    /// A warning about ranges that are wide, or based on no computed star.
    fn range_warning(&self, outcome: &Outcome) -> Option<PredictionWarning> {
        let Ranges { domain, radius, .. } = outcome.ranges;
        let (accepted, rest_radius) = (self.spec.accuracy.response, outcome.rest.radius);
        match domain {
            // What is printed as 1.0 is no reason to warn.
            Domain::Extrapolated if outcome.ranges.wider >= 1.05 => {
                let outside_text = outside_domain(&self.case);
                let text = format!(
                    "{}, {outside_text}: ranges are {:.1} times as wide",
                    errors::EXTRAPOLATED_MESSAGE,
                    outcome.ranges.wider
                );
                Some(text.into())
            }
            _ if !outcome.known => {
                Some(PredictionWarning::new(WarningCode::NoModel, untried_message(&self.case)))
            }
            _ => {
                // The requested quantity: the force where there is an object, else the closed width.
                let force = outcome.object_force().filter(|force| *force > 0.0).zip(outcome.force_range);
                let parts = [
                    ("the closed width", radius.map(|range| relative_error(rest_radius, range))),
                    ("the force on the object", force.map(|(force, range)| relative_error(force, range))),
                ];
                let wide = parts.into_iter().filter_map(|(what, part)| Some((what, part?)));
                let wide: Vec<String> = wide
                    .filter(|(_, part)| *part > accepted.ratio())
                    .map(|(what, part)| format!("{what} may be off by {:.0} %", (100.0 * part).ceil()))
                    .collect();
                (!wide.is_empty()).then(|| {
                    let text = format!(
                        "{}, more than the accepted {accepted}: another `model` in [accuracy] may be off by less",
                        wide.join(", ")
                    );
                    text.into()
                })
            }
        }
    }
}

/// A message that the star of `case` is outside the validated domain, with the reason.
fn untried_message(case: &Case) -> String {
    format!("{}: {}", errors::UNKNOWN_MESSAGE, outside_domain(case))
}

/// A message that no hinge model uses the weave of `fabric`, if there is one.
fn weave_left_out(fabric: &Fabric) -> Option<String> {
    let fabric_weave = weave(fabric).ok()?;
    let part = fabric_weave.shear;
    (!fabric_weave.is_isotropic()).then(|| {
        format!(
            "shear_modulus is not used: numbers and ranges are for isotropic fabric; the given fabric has {part:.2} of \
             its shear modulus; `predict` with the model \"shell\" uses it for 4 points with `warp` at a multiple of 45 deg"
        )
    })
}
