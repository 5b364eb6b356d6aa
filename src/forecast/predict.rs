//! From a spec to the answer: chooses the model, asks it about every star, and says how good the answer is.

use crate::design::{Design, StarDesign};
use crate::forecast::case::Case;
use crate::forecast::choice::{Choice, Question, choose, hinge_model, limits_of_validity, take};
use crate::forecast::outcome::{Outcome, SHORTEST_ARM};
use crate::forecast::prediction::{Evidence, Hinges, Nonlinear, Prediction, StarPrediction};
use crate::forecast::seal_load::{burst, factor, remedy, safe_radius};
use crate::mechanics::fault::{HingeFault, StarFault};
use crate::mechanics::hinge::ring::{Ring, RingTable};
use crate::mechanics::hinge::{HingeModel, HingeState, Level};
use crate::mechanics::star::response::Inflated;
use crate::spec::{KeyPath, ModelChoice, Spec, key};
use crate::units::{Length, Pressure, Readable};
use std::fmt;
use std::sync::LazyLock;

/// Why there is no prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictFault {
    /// Number of the star, 1 = bottom; `None` if it is not about one star.
    pub star: Option<usize>,
    /// The key of the spec that is best changed.
    pub key: KeyPath,
    /// What was found and what is allowed.
    pub what: String,
}

impl fmt::Display for PredictFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(star) = self.star {
            write!(f, "star {star}: ")?;
        }
        write!(f, "{}: {}", self.key, self.what)
    }
}

impl std::error::Error for PredictFault {}

static TABLE: LazyLock<Result<RingTable, HingeFault>> = LazyLock::new(RingTable::new);

/// Predicts what the stars of `design`, made from `spec`, do, by `accuracy.model`.
///
/// # Errors
/// If a model refuses one of the hinges, or is not available.
pub fn predict(spec: &Spec, design: &Design) -> Result<Prediction, PredictFault> {
    // Stars of a stack are often equal; a slow model then answers once.
    let distinct = design
        .firsts()
        .map(|placed| predict_star(spec, design.part(placed)).map_err(|fault| located(placed.index, &fault)));
    let distinct = distinct.collect::<Result<Vec<_>, _>>()?;
    let stars: Vec<StarPrediction> =
        design.stars.iter().filter_map(|placed| distinct.get(placed.distinct)).cloned().collect();
    let Some(first) = stars.first() else {
        return Err(PredictFault { star: None, key: key::stack::COUNT, what: "there is no star".to_owned() });
    };
    let mut first = first.clone();
    first.payload_kg = stars.iter().map(|star| star.payload_kg).sum();
    let stack_mass_g = stars.iter().map(|star| star.mass_g).sum();
    Ok(Prediction { first, stack_mass_g, stars })
}

/// One star, and what is asked about it.
struct Asked<'a> {
    spec: &'a Spec,
    part: &'a StarDesign,
    case: Case,
    question: Question,
}

fn predict_star(spec: &Spec, part: &StarDesign) -> Result<StarPrediction, StarFault> {
    let case = Case::of(spec, &part.star)?;
    let width = case.mechanism.width;
    let question = Question {
        r_stars: [case.mechanism.tip().r_star, case.mechanism.corner().r_star],
        bendability: case.pressure.map(|p| case.sheet.bendability(p, width)),
        stretch: case.pressure.map_or(0.0, |p| case.sheet.stretch(p, width)),
        accepted: spec.accuracy.response.ratio(),
    };
    let table = TABLE.as_ref().map_err(|fault| *fault)?;
    let choice = match spec.accuracy.model {
        // A build's files are the same on every machine, and shells are not.
        ModelChoice::Auto | ModelChoice::Shell => choose(&question, table),
        ModelChoice::Fit => take(Level::Fit, &question, table),
        ModelChoice::Ring => take(Level::Ring, &question, table),
        ModelChoice::Bvp => take(Level::Bvp, &question, table),
        ModelChoice::Section => take(Level::Section, &question, table),
    };
    let model = hinge_model(choice.level, &case.sheet, case.pressure, width)?;
    answer(&Asked { spec, part, case, question }, model.as_ref(), &choice)
}

fn answer(asked: &Asked<'_>, model: &dyn HingeModel, choice: &Choice) -> Result<StarPrediction, StarFault> {
    let Asked { case, part, spec, question } = asked;
    // Angles and radii do not depend on the pressure: without one, any will do.
    let inflated = Inflated::new(&case.mechanism, model, case.pressure.unwrap_or(1.0))?;
    let outcome = Outcome::linear(case, &inflated);
    let mut warnings = limits_of_validity(choice.level, question);
    if spec.accuracy.model == ModelChoice::Shell {
        warnings.push(format!(
            "shells are left to `predict --model shell`: files are the same on every machine, and a shell's last digits are not; \
             {} answers here",
            choice.level.name()
        ));
    }
    if !choice.good_enough {
        warnings.push(choice.reason.clone());
    }
    warnings.extend(of_the_shape(case, &outcome));
    warnings.extend(outcome.object_warning(case));
    let nonlinear = nonlinear(asked, &inflated, &outcome, &mut warnings);
    let seal = Seal::new(case);
    warnings.extend(seal.warning(case));
    let [tip, corner] = [inflated.tip(), inflated.corner()];
    let angles = inflated.target_angles();
    let (c_i, c_e) = inflated.hinge_stiffness();
    let [onset_i, onset_e] = question.r_stars.map(|r_star| model.onset(r_star));
    Ok(StarPrediction {
        model: choice.level.name(),
        lambda_t: Hinges { tip: tip.lambda, corner: corner.lambda },
        lambda_c: Hinges { tip: onset_i?, corner: onset_e? },
        d2v_dlambda2: Hinges { tip: tip.curvature, corner: corner.curvature },
        arm_length_mm: part.star.l,
        tip_target_angle_deg: angles.0.to_degrees(),
        corner_target_angle_deg: angles.1.to_degrees(),
        tip_equilibrium_angle_deg: outcome.rest.equilibrium.to_degrees(),
        final_radius_mm: mm(outcome.rest.radius),
        contraction: outcome.contraction,
        hinge_stiffness_Nm: case.pressure.map(|_| Hinges { tip: c_i, corner: c_e }),
        radial_stiffness_N_per_m: outcome.stiffness,
        preload_N: outcome.preload,
        graspable_radius_mm: outcome.graspable.map(mm),
        object_force_N: outcome.object_force(),
        bendability: question.bendability,
        operating_pressure_kPa: Pressure::from_pascals(case.operating_pressure()).0,
        realised_radius_mm: Hinges { tip: part.realised_tip().radius, corner: part.realised_corner().radius },
        seal_load: seal.load,
        burst_pressure_kPa: seal.burst.map(|p| Pressure::from_pascals(p).0),
        mass_g: part.mass(&spec.fabric),
        payload_kg: outcome.payload,
        nonlinear,
        evidence: Evidence {
            choice: choice.reason.clone(),
            coiling_error: choice.error.coiling,
            stiffness_error: case.pressure.map(|_| choice.error.stiffness),
            residual: tip.effort.residual.max(corner.effort.residual),
            iterations: tip.effort.iterations + corner.effort.iterations,
            numerical_error: tip.effort.error.max(corner.effort.error),
            stretch: case.pressure.map(|_| question.stretch),
            hinge_width: Hinges { tip: width_of(tip), corner: width_of(corner) },
            safe_radius_mm: seal.safe.map(|radius| radius.0),
            warnings,
        },
    })
}

/// mm, as all lengths of a prediction are.
fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}

fn width_of(state: &HingeState) -> Option<f64> {
    state.edges.map(|edges| edges.width)
}

/// What is to be said about a star that cannot move as the mechanism thinks.
fn of_the_shape(case: &Case, outcome: &Outcome) -> Vec<String> {
    let star = &case.mechanism;
    let mut warnings = Vec::new();
    if outcome.rest.equilibrium <= 0.0 {
        warnings.push("the arms touch before the hinges are at rest: the star is pressed shut".to_owned());
    }
    if star.radius(outcome.rest.angle).slope <= 0.0 {
        warnings.push("the arms are so short that closing the tips widens the star".to_owned());
    }
    if star.arm < SHORTEST_ARM * star.width {
        warnings.push(format!(
            "the arms are {} mm long, less than half the tube's width of {} mm: they are no straight tubes, and the \
             hinges at their ends overlap",
            Readable(mm(star.arm)),
            Readable(mm(star.width))
        ));
    }
    warnings
}

/// The star with the model's own V_bar; `None` for the fit, whose hinges are linear, or where the model refuses.
fn nonlinear(
    asked: &Asked<'_>,
    inflated: &Inflated<'_>,
    linear: &Outcome,
    warnings: &mut Vec<String>,
) -> Option<Nonlinear> {
    if inflated.level() == Level::Fit {
        return None;
    }
    // Of its warnings about the object those of the linear star are enough.
    let own = match Outcome::nonlinear(&asked.case, inflated) {
        Ok(own) => own,
        Err(fault) => {
            warnings.push(format!("no equilibrium of the nonlinear hinges: {fault}"));
            return None;
        }
    };
    if inflated.rim_pushes(own.rest.angle) {
        warnings.push(
            "the nonlinear star coils a hinge so far that its inner rim would have to push: a real rim wrinkles, and \
             the hinge is softer than predicted"
                .to_owned(),
        );
    }
    let (own_radius, linear_radius) = (own.rest.radius, linear.rest.radius);
    if (own_radius - linear_radius).abs() > asked.question.accepted * linear_radius {
        warnings.push(format!(
            "with {} it would close to {:.2} mm instead of {:.2} mm: {}",
            whose(inflated.level()).0,
            mm(own_radius),
            mm(linear_radius),
            whose(inflated.level()).1
        ));
    }
    Some(Nonlinear {
        tip_equilibrium_angle_deg: own.rest.equilibrium.to_degrees(),
        final_radius_mm: mm(own_radius),
        contraction: own.contraction,
        radial_stiffness_N_per_m: own.stiffness,
        preload_N: own.preload,
        object_force_N: own.object_force(),
    })
}

/// What a model's hinges are called, and why they are not linear.
fn whose(level: Level) -> (&'static str, &'static str) {
    match level {
        Level::Section => (
            "the section's own moments in place of linear ones",
            "tip and corner hold each other away from their rests, where a hinge is stiffer or softer",
        ),
        Level::Fit | Level::Ring | Level::Bvp => (
            "the membrane's own, asymmetric hinges",
            "the corner's hinge is coiled far beyond its target, where it is much softer",
        ),
    }
}

/// What the seal bears at the radii that the band makes of the hinges; by the exact ring, whatever the model.
struct Seal {
    load: Hinges<Option<f64>>,
    burst: Option<f64>,
    safe: Option<Length>,
}

impl Seal {
    fn new(case: &Case) -> Self {
        let load = |radius: f64| factor(&Ring, radius / case.mechanism.width);
        let burst = burst(case, &Ring);
        let bursts = burst.zip(case.pressure).is_some_and(|(burst, p)| burst < p);
        Self {
            load: Hinges { tip: load(case.realised.tip), corner: load(case.realised.corner) },
            burst,
            safe: if bursts { safe_radius(case) } else { None },
        }
    }

    fn warning(&self, case: &Case) -> Option<String> {
        let burst = self.burst.filter(|burst| case.pressure.is_some_and(|p| *burst < p))?;
        Some(format!(
            "the pressure is above the seal's burst pressure, {:.2} kPa, a conservative membrane estimate; {}",
            Pressure::from_pascals(burst).0,
            remedy(self.safe)
        ))
    }
}

/// A fault of star `star` with the key that is best changed. The star itself exists: a design was made of it.
fn located(star: usize, fault: &StarFault) -> PredictFault {
    let key = match fault {
        StarFault::Dimension { symbol, .. } => match *symbol {
            "p" => key::load::PRESSURE,
            "E" => key::fabric::YOUNG_MODULUS,
            "nu" => key::fabric::POISSON_RATIO,
            _ => key::fabric::THICKNESS,
        },
        StarFault::NoPressure => key::load::PRESSURE,
        StarFault::Radius { .. } => key::load::OBJECT_RADIUS,
        StarFault::Hinge(_) | StarFault::Root(_) => key::star::TIP_RADIUS,
    };
    PredictFault { star: Some(star), key, what: fault.to_string() }
}
