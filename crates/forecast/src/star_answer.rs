//! One model's values of a star, for a prediction.

use crate::case::{Case, measured_stiffnesses};
use crate::interval::scaled;
use crate::outcome::{Outcome, SHORTEST_ARM};
use crate::prediction::{FabricStretch, Hinges, ModelEvidence, Nonlinear, StarPrediction};
use crate::ranges::StarRanges;
use crate::warning::{PredictionWarning, WarningCode};
use design::{FlatPiece, StarDesign};
use inflatable::mechanics::fault::StarFault;
use inflatable::mechanics::hinge::{HingeState, Level};
use inflatable::mechanics::star::bearing::FOLDING;
use inflatable::mechanics::star::response::Inflated;
use spec::Spec;
use spec::units::{Length, Percent, Pressure, Readable};

/// Writes the values of `outcome` by the model of `inflated` into `star`.
pub(super) fn write_outcome(
    star: &mut StarPrediction,
    case: &Case,
    inflated: &Inflated<'_>,
    outcome: &Outcome,
) -> Result<(), StarFault> {
    let model = inflated.model();
    let [tip, corner] = inflated.hinges();
    let [tip_target, corner_target] = inflated.target_angles();
    let [c_i, c_e] = inflated.hinge_stiffness();
    let stiffness = case.pressure.map(|_| Hinges { tip: c_i, corner: c_e });
    star.model = model.level().name();
    star.lambda_t = Hinges { tip: Some(tip.lambda), corner: Some(corner.lambda) };
    star.lambda_c = Hinges {
        tip: model.onset(case.mechanism.tip().r_star)?,
        corner: model.onset(case.mechanism.corner().r_star)?,
    };
    star.d2v_dlambda2 = Hinges { tip: Some(tip.curvature), corner: Some(corner.curvature) };
    star.tip_target_angle_deg = Some(tip_target.to_degrees());
    star.corner_target_angle_deg = Some(corner_target.to_degrees());
    star.hinge_stiffness_Nm = stiffness;
    // The seal's ranges do not depend on the hinge's model.
    fill_ranges(&mut star.ranges, case, outcome, stiffness);
    star.correction = case.mechanism.correction;
    star.hold = outcome.hold;
    if outcome.known {
        star.tip_equilibrium_angle_deg = Some(outcome.rest.equilibrium.to_degrees());
        star.final_radius_mm = Some(mm(outcome.rest.radius));
        star.contraction = Some(outcome.contraction);
        star.radial_stiffness_N_per_m = outcome.stiffness;
        star.preload_N = outcome.preload;
        star.graspable_radius_mm = Some(outcome.graspable.map(mm));
        star.object_force_N = outcome.object_force();
        star.payload_kg = outcome.payload;
        star.flap_edge_radius_mm = Some(mm((outcome.rest.radius - case.flap()).max(0.0)));
        let grasp = inflated.grasp(&outcome.rest);
        let flap = outcome.flap_force(case, inflated, grasp.as_ref());
        star.flap_force_N = flap.and_then(|flap| flap.force);
        star.ranges.flap_force_N = flap.and_then(|flap| flap.range);
        star.arm_wrinkling_kg = outcome.wrinkling;
        star.arm_folding_kg = outcome.wrinkling.map(|wrinkling| FOLDING * wrinkling);
    }
    let evidence = &mut star.evidence;
    evidence.residual = tip.effort.residual.max(corner.effort.residual);
    evidence.iterations = tip.effort.iterations + corner.effort.iterations;
    evidence.numerical_error = Some(tip.effort.error.max(corner.effort.error));
    evidence.hinge_width = Hinges { tip: width_of(tip), corner: width_of(corner) };
    Ok(())
}

/// The star with the model's own V_bar; `None` for the fit, whose hinges are linear, for the section, whose linear hinges are nearer to
/// shells of stars, or where the model refuses.
pub(super) fn nonlinear_variant(
    case: &Case,
    inflated: &Inflated<'_>,
    linear: &Outcome,
    accepted: Percent,
    warnings: &mut Vec<PredictionWarning>,
) -> Option<Nonlinear> {
    if matches!(inflated.level(), Level::Fit | Level::Section) {
        return None;
    }
    // The linear star's warnings about the object are enough.
    let outcome = match Outcome::nonlinear(case, inflated) {
        Ok(outcome) => outcome,
        Err(fault) => {
            warnings.push(format!("no equilibrium of the nonlinear hinges: {fault}").into());
            return None;
        }
    };
    if inflated.rim_pushes(outcome.rest.angle) {
        let text = "the nonlinear star coils a hinge so far that its inner rim would be compressed: a real rim wrinkles, \
                    and the hinge is softer than predicted";
        warnings.push(PredictionWarning::new(WarningCode::Validity, text));
    }
    let (own_radius, linear_radius) = (outcome.rest.radius, linear.rest.radius);
    if (own_radius - linear_radius).abs() > accepted.ratio() * linear_radius {
        let text = format!(
            "with the membrane's own, asymmetric hinges it would close to {:.2} mm instead of {:.2} mm: the corner's hinge \
             is coiled far beyond its target, where it is much softer",
            mm(own_radius),
            mm(linear_radius)
        );
        warnings.push(text.into());
    }
    Some(Nonlinear {
        tip_equilibrium_angle_deg: outcome.rest.equilibrium.to_degrees(),
        final_radius_mm: mm(own_radius),
        contraction: outcome.contraction,
        radial_stiffness_N_per_m: outcome.stiffness,
        preload_N: outcome.preload,
        object_force_N: outcome.object_force(),
    })
}

/// Fills the ranges of `outcome` in the units of a prediction into `ranges`, which has those of the seal; `stiffness` is that of the hinges.
fn fill_ranges(ranges: &mut StarRanges, case: &Case, outcome: &Outcome, stiffness: Option<Hinges<f64>>) {
    let predicted = &outcome.ranges;
    let hinges = predicted.hinge(case).zip(stiffness).map(|(factors, stiffness)| {
        [stiffness.tip, stiffness.corner].map(|stiffness| scaled(factors, stiffness))
    });
    ranges.final_radius_mm = predicted.radius.map(|range| range.map(mm));
    ranges.contraction = outcome.contraction_range(case);
    ranges.tip_equilibrium_angle_deg = predicted.angle.map(|range| range.map(f64::to_degrees));
    ranges.hinge_stiffness_Nm =
        Hinges { tip: hinges.map(|[tip, _]| tip), corner: hinges.map(|[_, corner]| corner) };
    ranges.radial_stiffness_N_per_m = predicted.stiffness;
    ranges.object_force_N = outcome.force_range;
    ranges.payload_kg = outcome.payload_range;
}

/// Use of a shear modulus by hinge models.
const WEAVE_NOT_USED: &str = "not used: this model is for isotropic fabric";

/// All of one star that depends on no model.
pub(super) fn without_model(spec: &Spec, part: &StarDesign, case: &Case) -> StarPrediction {
    StarPrediction {
        arm_length_mm: part.star.l,
        hole_radius_mm: mm(case.hole),
        flap_load_N_per_mm: (case.flap() > 0.0).then(|| 1e-3 * case.sheet.flap_load(case.flap())),
        object_radius_mm: case.object.map(mm),
        object_gap_mm: case.entering.map(|entering| mm(case.hole) - mm(entering)),
        bendability: case.bendability(),
        operating_pressure_kPa: Pressure::from_pascals(case.operating_pressure()).0,
        realised_radius_mm: Hinges { tip: part.realised_tip().radius, corner: part.realised_corner().radius },
        mass_g: FlatPiece::Star(part).mass(&spec.fabric),
        stretch: case.stretch().map(FabricStretch::Ratio),
        ranges_of: "shell",
        evidence: ModelEvidence {
            fabric: measured_stiffnesses(&spec.fabric),
            weave: spec.fabric.shear_modulus.map(|_| WEAVE_NOT_USED),
            stretch: case.stretch(),
            ..ModelEvidence::default()
        },
        correction: case.mechanism.correction,
        ..StarPrediction::default()
    }
}

/// mm, as all lengths of a prediction are.
pub(super) fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}

fn width_of(state: &HingeState) -> Option<f64> {
    state.edges.map(|edges| edges.width)
}

/// Warnings about a star that cannot move as the mechanism assumes.
pub(super) fn geometry_warnings(case: &Case, outcome: &Outcome) -> Vec<String> {
    let star = &case.mechanism;
    let mut warnings = Vec::new();
    if outcome.rest.equilibrium < outcome.rest.angle {
        warnings.push(
            "the arms touch before the hinges reach their rest angle, and press on each other".to_owned(),
        );
    }
    if star.radius(outcome.rest.angle).slope <= 0.0 {
        warnings.push("the arms are so short that closing the tips widens the star".to_owned());
    }
    if star.arm < SHORTEST_ARM * star.width {
        warnings.push(format!(
            "the arms are {} mm long, less than half the tube's width of {} mm: they are not straight tubes, and \
             the hinges at their ends overlap",
            Readable(mm(star.arm)),
            Readable(mm(star.width))
        ));
    }
    warnings
}
