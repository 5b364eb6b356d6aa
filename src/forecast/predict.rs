//! From a spec to the answer: chooses the model, asks it about every star, and says how good the answer is.

use crate::forecast::choice::{BVP_BETA, Choice, Question, choose, limits_of_validity, take};
use crate::forecast::cut::{Flaps, cut_area};
use crate::forecast::prediction::{Evidence, Hinges, Nonlinear, Prediction, StarPrediction};
use crate::mechanics::fault::{HingeFault, StarFault};
use crate::mechanics::hinge::bvp::Bvp;
use crate::mechanics::hinge::fit::Fit;
use crate::mechanics::hinge::ring::{Ring, RingTable};
use crate::mechanics::hinge::{HingeModel, HingeState, Level, seal_load};
use crate::mechanics::star::response::{Inflated, Rest};
use crate::mechanics::star::{Star, StarGeometry};
use crate::mechanics::strength::{ElasticSheet, burst_pressure, payload};
use crate::spec::{KeyPath, ModelChoice, Spec, StarSpec, key};
use std::f64::consts::FRAC_2_PI;
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

/// Predicts what `spec`'s stars do, by `accuracy.model`.
///
/// # Errors
/// If a star does not exist, a model refuses one of its hinges, or the model is not available.
pub fn predict(spec: &Spec) -> Result<Prediction, PredictFault> {
    let mut stars: Vec<StarPrediction> = Vec::with_capacity(spec.stars.len());
    for (i, star) in spec.stars.iter().enumerate() {
        // Stars of a stack are often equal; a slow model then answers once.
        let known = spec.stars[..i].iter().position(|other| geometry(other) == geometry(star));
        let answer = match known {
            Some(known) => stars[known].clone(),
            None => predict_star(spec, star).map_err(|fault| located(i + 1, fault))?,
        };
        stars.push(answer);
    }
    let Some(first) = stars.first() else {
        return Err(PredictFault { star: None, key: key::stack::COUNT, what: "there is no star".to_owned() });
    };
    let mut first = first.clone();
    first.payload_kg = stars.iter().map(|star| star.payload_kg).sum();
    Ok(Prediction { first, stars })
}

/// What one star asks of the models.
struct Case<'a> {
    spec: &'a Spec,
    star: Star,
    sheet: ElasticSheet,
    /// Gauge pressure, Pa.
    pressure: Option<f64>,
    /// Radius of the object, m.
    object: Option<f64>,
}

fn predict_star(spec: &Spec, star: &StarSpec) -> Result<StarPrediction, StarFault> {
    let load = spec.load.as_ref();
    let case = Case {
        spec,
        star: Star::new(geometry(star))?,
        sheet: ElasticSheet::new(
            spec.fabric.thickness.0 * 1e-3,
            spec.fabric.young_modulus.0 * 1e3,
            spec.fabric.poisson_ratio,
        )?,
        pressure: load.and_then(|load| load.pressure).map(|p| p.0 * 1e3),
        object: load.and_then(|load| load.object_radius).map(|r| r.0 * 1e-3),
    };
    let width = case.star.geometry().width;
    let question = Question {
        r_stars: [case.star.tip().r_star, case.star.corner().r_star],
        bendability: case.pressure.map(|p| case.sheet.bendability(p, width)),
        stretch: case.pressure.map_or(0.0, |p| case.sheet.stretch(p, width)),
        accepted: spec.accuracy.response.ratio(),
    };
    let table = TABLE.as_ref().map_err(|fault| *fault)?;
    let choice = match spec.accuracy.model {
        ModelChoice::Auto => choose(&question, table),
        ModelChoice::Fit => take(Level::Fit, &question, table),
        ModelChoice::Ring => take(Level::Ring, &question, table),
        ModelChoice::Bvp => take(Level::Bvp, &question, table),
    };
    let bvp = Bvp::new(BVP_BETA, 1e-6);
    let model: &dyn HingeModel = match choice.level {
        Level::Fit => &Fit,
        Level::Ring => &Ring,
        Level::Bvp => &bvp,
    };
    answer(&case, model, &choice, &question)
}

/// The flat dimensions of a spec's star in SI units.
pub fn geometry(star: &StarSpec) -> StarGeometry {
    StarGeometry {
        points: star.points,
        inner_radius: star.inner_radius.0 * 1e-3,
        width: star.tube_width.0 * 1e-3,
        tip_angle: star.tip_angle.rad(),
        tip_radius: star.tip_radius.0 * 1e-3,
        corner_radius: star.corner_radius.0 * 1e-3,
    }
}

fn answer(
    case: &Case<'_>,
    model: &dyn HingeModel,
    choice: &Choice,
    question: &Question,
) -> Result<StarPrediction, StarFault> {
    let (star, spec) = (&case.star, case.spec);
    let rho_0 = star.geometry().inner_radius;
    // Angles and radii do not depend on the pressure: without one, any will do.
    let inflated = Inflated::new(star, model, case.pressure.unwrap_or(1.0))?;
    let rest = inflated.linear_rest();
    let with_pressure = |value: f64| case.pressure.map(|_| value);
    let mut warnings = limits_of_validity(choice.level, question);
    if !choice.good_enough {
        warnings.push(choice.reason.clone());
    }
    if rest.equilibrium <= 0.0 {
        warnings.push("the arms touch before the hinges are at rest: the star is pressed shut".to_owned());
    }
    if star.radius(rest.angle).slope <= 0.0 {
        warnings.push("the arms are so short that closing the tips widens the star".to_owned());
    }
    let object_force = match (case.pressure, case.object) {
        (Some(_), Some(rho)) => object_force(&inflated, &rest, rho, true, &mut warnings),
        _ => None,
    };
    let friction = spec.load.as_ref().and_then(|load| load.friction);
    let nonlinear = nonlinear(case, &inflated, &rest, &mut warnings);
    let seal = Seal::new(case, &mut warnings);
    let [tip, corner] = [inflated.tip(), inflated.corner()];
    let angles = inflated.target_angles();
    let (c_i, c_e) = inflated.hinge_stiffness();
    let onset = |r_star: f64| model.onset(r_star);
    Ok(StarPrediction {
        model: choice.level.name(),
        lambda_t: Hinges { tip: tip.lambda, corner: corner.lambda },
        lambda_c: Hinges { tip: onset(star.tip().r_star)?, corner: onset(star.corner().r_star)? },
        d2v_dlambda2: Hinges { tip: tip.curvature, corner: corner.curvature },
        arm_length_mm: star.arm_length() * 1e3,
        tip_target_angle_deg: angles.0.to_degrees(),
        corner_target_angle_deg: angles.1.to_degrees(),
        tip_equilibrium_angle_deg: rest.equilibrium.to_degrees(),
        final_radius_mm: rest.radius * 1e3,
        contraction: 1.0 - rest.radius / rho_0,
        hinge_stiffness_Nm: case.pressure.map(|_| Hinges { tip: c_i, corner: c_e }),
        radial_stiffness_N_per_m: with_pressure(rest.stiffness),
        preload_N: with_pressure(rest.preload),
        graspable_radius_mm: [rest.radius * 1e3, rho_0 * 1e3],
        object_force_N: object_force,
        bendability: question.bendability,
        operating_pressure_kPa: case.sheet.operating_pressure(star.geometry().width) * 1e-3,
        realised_radius_mm: seal.radius_mm,
        seal_load: seal.load,
        burst_pressure_kPa: seal.burst.map(|p| p * 1e-3),
        mass_g: mass(case).map(|m| m * 1e3),
        payload_kg: friction.zip(object_force).map(|(mu, force)| payload(mu, [force])),
        nonlinear,
        evidence: Evidence {
            choice: choice.reason.clone(),
            coiling_error: choice.error.coiling,
            stiffness_error: with_pressure(choice.error.stiffness),
            residual: tip.effort.residual.max(corner.effort.residual),
            iterations: tip.effort.iterations + corner.effort.iterations,
            numerical_error: tip.effort.error.max(corner.effort.error),
            stretch: with_pressure(question.stretch),
            hinge_width: Hinges { tip: width_of(tip), corner: width_of(corner) },
            final_radius_with_hinge_width_mm: width_of(corner)
                .map(|width| (rest.radius - (width - FRAC_2_PI) * star.geometry().width) * 1e3),
            safe_radius_mm: seal.safe_mm,
            warnings,
        },
    })
}

fn width_of(state: &HingeState) -> Option<f64> {
    state.edges.map(|edges| edges.width)
}

/// Force on an object of radius `rho`; `None` with a warning where the star cannot hold it.
fn object_force(
    inflated: &Inflated<'_>,
    rest: &Rest,
    rho: f64,
    linear: bool,
    warnings: &mut Vec<String>,
) -> Option<f64> {
    let rho_0 = inflated.star().geometry().inner_radius;
    if rho > rho_0 {
        warnings.push(format!(
            "the object is wider than the flat star's {:.2} mm: it does not enter",
            rho_0 * 1e3
        ));
        return None;
    }
    if rho < rest.radius {
        warnings.push(format!(
            "the object is thinner than the final radius, {:.2} mm: the star does not reach it",
            rest.radius * 1e3
        ));
        return Some(0.0);
    }
    let force = if linear { inflated.linear_force(rho, rest) } else { inflated.force(rho, rest) };
    force.map_err(|fault| warnings.push(format!("no force on the object: {fault}"))).ok()
}

/// The star with the model's own V_bar; `None` for the fit, whose hinges are linear, or where the model refuses.
fn nonlinear(
    case: &Case<'_>,
    inflated: &Inflated<'_>,
    linear: &Rest,
    warnings: &mut Vec<String>,
) -> Option<Nonlinear> {
    if inflated.level() == Level::Fit {
        return None;
    }
    let rest = match inflated.rest() {
        Ok(rest) => rest,
        Err(fault) => {
            warnings.push(format!("no equilibrium of the nonlinear hinges: {fault}"));
            return None;
        }
    };
    if inflated.rim_pushes(rest.angle) {
        warnings.push(
            "the nonlinear star coils a hinge so far that its inner rim would have to push: a real rim wrinkles, and \
             the hinge is softer than predicted"
                .to_owned(),
        );
    }
    let rho_0 = case.star.geometry().inner_radius;
    let object_force_n = match (case.pressure, case.object) {
        // Its warnings are those of the linear star.
        (Some(_), Some(rho)) => object_force(inflated, &rest, rho, false, &mut Vec::new()),
        _ => None,
    };
    if (rest.radius - linear.radius).abs() > case.spec.accuracy.response.ratio() * linear.radius {
        warnings.push(format!(
            "with the membrane's own, asymmetric hinges it would close to {:.2} mm instead of {:.2} mm: the corner's \
             hinge is coiled far beyond its target, where it is much softer",
            rest.radius * 1e3,
            linear.radius * 1e3
        ));
    }
    Some(Nonlinear {
        tip_equilibrium_angle_deg: rest.equilibrium.to_degrees(),
        final_radius_mm: rest.radius * 1e3,
        contraction: 1.0 - rest.radius / rho_0,
        radial_stiffness_N_per_m: case.pressure.map(|_| rest.stiffness),
        preload_N: case.pressure.map(|_| rest.preload),
        object_force_N: object_force_n,
    })
}

/// What the seal bears, at the radii that the band makes of the hinges; by the exact ring, whatever the model.
struct Seal {
    radius_mm: Hinges<f64>,
    load: Hinges<Option<f64>>,
    burst: Option<f64>,
    safe_mm: Option<f64>,
}

impl Seal {
    fn new(case: &Case<'_>, warnings: &mut Vec<String>) -> Self {
        let geometry = case.star.geometry();
        let band = case.spec.seal.band.0 * 1e-3;
        let realised = |radius: f64| radius.max(0.5 * band);
        let (tip, corner) = (realised(geometry.tip_radius), realised(geometry.corner_radius));
        let load = |radius: f64| {
            let r_star = radius / geometry.width;
            Ring.target(r_star).ok().and_then(|state| seal_load(r_star, &state))
        };
        let loads = Hinges { tip: load(tip), corner: load(corner) };
        let peel = case.spec.fabric.seal_strength.map(|strength| strength.0 * 1e3);
        let worst = loads.tip.zip(loads.corner).map(|(a, b)| a.max(b));
        let burst = peel.zip(worst).map(|(peel, k)| burst_pressure(peel, geometry.width, k));
        let mut safe_mm = None;
        if let (Some(p), Some(peel), Some(burst)) = (case.pressure, peel, burst)
            && p > burst
        {
            safe_mm = safe_radius(peel / (p * geometry.width)).map(|r_star| r_star * geometry.width * 1e3);
            let remedy = safe_mm.map_or("no radius would make it safe".to_owned(), |radius| {
                format!("inner radii of {radius:.2} mm would make it safe")
            });
            warnings.push(format!(
                "the pressure is above the seal's burst pressure, {:.2} kPa, a conservative membrane estimate; {remedy}",
                burst * 1e-3
            ));
        }
        Self { radius_mm: Hinges { tip: tip * 1e3, corner: corner * 1e3 }, load: loads, burst, safe_mm }
    }
}

/// R* at which the seal load has fallen to `allowed`; `None` if a straight tube's is above it.
fn safe_radius(allowed: f64) -> Option<f64> {
    let load = |r_star: f64| Ring.target(r_star).ok().and_then(|state| seal_load(r_star, &state));
    let (mut low, mut high) = (1e-6, 1e3);
    if load(high)? > allowed {
        return None;
    }
    // The load falls with R*; halving the logarithm 60 times is beyond rounding.
    for _ in 0..60 {
        let middle = f64::sqrt(low * high);
        if load(middle)? > allowed { low = middle } else { high = middle }
    }
    Some(high)
}

/// Mass of the star's two sheets, kg.
fn mass(case: &Case<'_>) -> Option<f64> {
    let spec = case.spec;
    let density = spec.fabric.areal_density?.0;
    let mm = 1e-3;
    let flaps = Flaps {
        outside: (spec.seal.band.0 + spec.seal.allowance.0) * mm,
        hole: (spec.seal.band.0 + spec.seal.hole_allowance.0) * mm,
        inlet: spec.inlet.as_ref().map(|inlet| (inlet.tube_diameter.0 * mm, inlet.length.0 * mm)),
    };
    Some(2.0 * density * cut_area(&case.star, &flaps))
}

/// A fault of star `star` with the key that is best changed.
fn located(star: usize, fault: StarFault) -> PredictFault {
    let key = match &fault {
        StarFault::Dimension { symbol, .. } => match *symbol {
            "n" => key::star::POINTS,
            "rho_0" => key::star::INNER_RADIUS,
            "W" => key::star::TUBE_WIDTH,
            "R_i" => key::star::TIP_RADIUS,
            "R_e" => key::star::CORNER_RADIUS,
            "phi_i0" => key::star::TIP_ANGLE,
            "p" => key::load::PRESSURE,
            "E" => key::fabric::YOUNG_MODULUS,
            "nu" => key::fabric::POISSON_RATIO,
            _ => key::fabric::THICKNESS,
        },
        StarFault::ArmLength { .. } => key::star::POINTS,
        StarFault::Hinge(_) | StarFault::Root(_) => key::star::TIP_RADIUS,
    };
    PredictFault { star: Some(star), key, what: fault.to_string() }
}
