//! The paper's **V-actuator**: one hinge between two arms with sealed ends, a test piece for a single hinge.
//!
//! All models of a hinge answer here through [`HingeModel`]. They have no arms, so the volume of the whole
//! actuator is `None`.

use crate::interval::{Interval, scaled};
use crate::keys::{keyed, kinds};
use crate::model_selection::{ARMS_LET_OUT, hinge_model};
use crate::ranges::{errors, shown};
use inflatable::mechanics::fault::StarFault;
use inflatable::mechanics::hinge::{Hinge, HingeModel, HingeState, Level};
use inflatable::mechanics::strength::ElasticSheet;
use serde::Serialize;

/// One V-actuator under pressure; SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Actuator {
    /// Flat tube width W, m.
    pub width: f64,
    /// Inner radius of curvature R of the hinge, m.
    pub radius: f64,
    /// Straight length l from the hinge's end to the sealed end, m.
    pub arm: f64,
    /// Flat angle phi_0 between the arms, rad, in (0, pi).
    pub angle: f64,
    /// Gauge pressure, Pa, above 0.
    pub pressure: f64,
    /// The fabric.
    pub sheet: ElasticSheet,
}

impl Actuator {
    /// The hinge between the arms.
    fn hinge(&self) -> Hinge {
        Hinge { r_star: self.radius / self.width, width: self.width, rest_angle: self.angle }
    }
}

keyed! {
    /// The predicted values. `None` where the model does not give them.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    #[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
    pub struct ActuatorPrediction {
        /// Model used: fit, ring, bvp, section or shell.
        pub model: &'static str,
        /// Pressure over the fabric's resistance to bending, 1/eps = p W^3 / B.
        pub bendability: f64,
        /// Stretch p W / Y of the fabric.
        pub stretch: f64,
        /// Angle between the arms at rest under pressure, degrees.
        pub angle_deg: f64,
        /// Coiling factor (pi - phi) / (pi - phi_0) at rest.
        pub coiling: f64,
        /// Volume of the whole actuator, mm^3. Models of the hinge alone do not have it.
        pub volume_mm3: Option<f64>,
        /// Stiffness d2U/dphi2 at rest, whole tube, N m per rad.
        pub stiffness_Nm: f64,
        /// Rows of an angle (deg) and the applied moment dU/dphi (N m) that holds it, for the requested angles. A positive one opens.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub moment: Option<Vec<[f64; 2]>>,
        /// For each of these numbers the interval that holds a computed shell's value in at least 95 % of cases. Some may be unknown.
        pub ranges: ActuatorRanges,
        /// Residuals, iterations, error estimates and `warnings`.
        pub evidence: ActuatorEvidence,
    }
}

kinds! { Object: ActuatorRanges, ActuatorEvidence; }

/// Intervals in which a shell's values lie in at least 95 % of cases; `None` where no range is available.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct ActuatorRanges {
    /// Range of the angle.
    pub angle_deg: Option<[f64; 2]>,
    /// Range of the coiling factor.
    pub coiling: Option<[f64; 2]>,
    /// Range of the volume.
    pub volume_mm3: Option<[f64; 2]>,
    /// Range of the stiffness.
    pub stiffness_Nm: Option<[f64; 2]>,
    /// Range of the moments.
    pub moment: Option<[f64; 2]>,
}

/// The evidence for an answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ActuatorEvidence {
    /// Residual of the model's equations at rest.
    pub residual: f64,
    /// Newton steps or factorisations.
    pub iterations: u32,
    /// Estimated relative error against the exact solution of the model's own equations.
    pub numerical_error: f64,
    /// Mesh error of each value; the shell's only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_errors: Option<ActuatorMeshErrors>,
    /// Unknowns of each mesh, coarse to fine; the shell's only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unknowns: Option<Vec<usize>>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Mesh errors of a shell's numbers, in their units: the difference of the last two meshes, or the extrapolation's change if it is larger.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct ActuatorMeshErrors {
    /// Error of the angle.
    pub angle_deg: f64,
    /// Error of the coiling factor.
    pub coiling: f64,
    /// Error of the volume.
    pub volume_mm3: f64,
    /// Error of the stiffness.
    pub stiffness_Nm: f64,
    /// Error of each moment.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub moment_Nm: Vec<f64>,
}

impl ActuatorPrediction {
    /// The answer as one JSON object with a trailing newline.
    ///
    /// # Panics
    /// Never: every field can be written as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data") + "\n"
    }

    /// The answer as a text for people.
    pub fn to_text(&self) -> String {
        // One line a quantity, with its range where the model states one, else with its mesh error, else with the word
        // that the range is unknown.
        let mut lines = vec![
            format!("model                 {}", self.model),
            format!("bendability           {:.0}", self.bendability),
            format!("stretch p W / Y       {:.4}", self.stretch),
        ];
        let mesh = self.evidence.mesh_errors.as_ref();
        let mut line = |what: &str,
                        value: f64,
                        range: Option<Interval>,
                        mesh: Option<f64>,
                        decimals: usize,
                        unit: &str| {
            let text = match (range, mesh) {
                (Some(range), _) => shown::with_range(value, range, unit),
                (None, Some(error)) => shown::meshed(value, error, unit),
                (None, None) => {
                    format!("{value:.decimals$} {unit}").trim_end().to_owned() + ", range unknown"
                }
            };
            lines.push(format!("{what:22}{text}"));
        };
        let error = |of: fn(&ActuatorMeshErrors) -> f64| mesh.map(of);
        let ranges = &self.ranges;
        line("angle at rest", self.angle_deg, ranges.angle_deg, error(|mesh| mesh.angle_deg), 2, "deg");
        line("coiling", self.coiling, ranges.coiling, error(|mesh| mesh.coiling), 4, "");
        if let Some(volume) = self.volume_mm3 {
            line("volume", volume, None, error(|mesh| mesh.volume_mm3), 0, "mm^3");
        }
        let stiffness = self.stiffness_Nm;
        line("stiffness", stiffness, ranges.stiffness_Nm, error(|mesh| mesh.stiffness_Nm), 4, "N m/rad");
        for (k, [angle, moment]) in self.moment.iter().flatten().enumerate() {
            let error = mesh.and_then(|mesh| mesh.moment_Nm.get(k).copied());
            line(&format!("held at {angle:7.2} deg    "), *moment, None, error, 5, "N m");
        }
        if let Some(unknowns) = &self.evidence.unknowns {
            lines.push(format!("unknowns of meshes    {}", shown::listed(unknowns)));
        }
        lines.extend(self.evidence.warnings.iter().map(|warning| format!("warning               {warning}")));
        lines.join("\n") + "\n"
    }
}

/// Predicts `actuator` with the hinge model of `level`, with the moments at `angles` (rad), if there are any.
///
/// # Errors
/// If the model does not cover the fabric at this pressure, the hinge, or one of the angles.
pub fn actuate(actuator: &Actuator, level: Level, angles: &[f64]) -> Result<ActuatorPrediction, StarFault> {
    let Actuator { width, pressure, sheet, .. } = *actuator;
    if !(pressure > 0.0 && pressure.is_finite()) {
        return Err(StarFault::Dimension { symbol: "p", found: pressure, allowed: "above 0" });
    }
    let model = &*hinge_model(level, &sheet, Some(pressure), width)?;
    let hinge = actuator.hinge();
    let rest = hinge.rest(model)?;
    let angle = hinge.angle_of(model, &rest);
    let stated_ranges = ranges(actuator, model, &rest, angle);
    let moments = angles.iter().map(|phi| {
        let state = hinge.state_at(model, *phi)?;
        Ok([phi.to_degrees(), -hinge.moment(pressure, &state)])
    });
    let moments = moments.collect::<Result<Vec<_>, StarFault>>()?;
    Ok(ActuatorPrediction {
        model: model.level().name(),
        bendability: sheet.bendability(pressure, width),
        stretch: sheet.stretch(pressure, width),
        angle_deg: angle.to_degrees(),
        coiling: hinge.coiling(angle),
        volume_mm3: None,
        stiffness_Nm: hinge.stiffness(pressure, &rest),
        moment: (!angles.is_empty()).then_some(moments),
        ranges: stated_ranges.unwrap_or_default(),
        evidence: ActuatorEvidence {
            residual: rest.effort.residual,
            iterations: rest.effort.iterations,
            numerical_error: rest.effort.error,
            mesh_errors: None,
            unknowns: None,
            warnings: warnings(actuator, model, angle, stated_ranges.is_some()),
        },
    })
}

/// The ranges of `actuator` at rest at `angle` (rad); `None` where no V-actuator like it was computed as a shell.
fn ranges(
    actuator: &Actuator,
    model: &dyn HingeModel,
    rest: &HingeState,
    angle: f64,
) -> Option<ActuatorRanges> {
    let Actuator { width, arm, pressure, .. } = *actuator;
    let hinge = actuator.hinge();
    let [[shortest, longest], [least_arc, most_arc]] = [errors::ACTUATOR_ARM, errors::ARC];
    let is_validated = (shortest..=longest).contains(&(arm / width))
        && (least_arc..=most_arc).contains(&hinge.arc().to_degrees())
        && model.level() == Level::Section
        && model.arms(hinge.r_star, hinge.arc()).is_some()
        && actuator.sheet.thickness / width >= errors::SLENDERNESS_REACHED[0];
    let slender = actuator.sheet.thickness / width;
    let angles = errors::actuator(slender).map(|error| angle + error);
    let stiffness = hinge.stiffness(pressure, rest);
    is_validated.then(|| ActuatorRanges {
        angle_deg: Some(angles.map(f64::to_degrees)),
        coiling: Some([angles[1], angles[0]].map(|angle| hinge.coiling(angle))),
        stiffness_Nm: Some(scaled(errors::hinge(slender), stiffness)),
        ..ActuatorRanges::default()
    })
}

/// A warning about arms that are too short to be straight tubes; `None` if they are long enough.
pub(super) fn short_arms(actuator: &Actuator) -> Option<String> {
    let short = "the arms are shorter than the tube is wide: their sealed ends affect the hinge";
    (actuator.arm < actuator.width).then(|| short.to_owned())
}

fn warnings(actuator: &Actuator, model: &dyn HingeModel, angle: f64, has_ranges: bool) -> Vec<String> {
    let limit = model.level() != Level::Section;
    let hinge = actuator.hinge();
    let without_arms = format!("the hinge is computed without arms, with which it would coil {ARMS_LET_OUT}");
    let conditions = [
        (
            limit,
            "the model is the limit of a membrane that neither bends nor stretches: a hinge at this pressure is stiffer",
        ),
        (!limit && model.arms(hinge.r_star, hinge.arc()).is_none(), without_arms.as_str()),
        (
            !limit && actuator.arm < errors::ACTUATOR_ARM[0] * actuator.width,
            "the arms are shorter than four widths: their sealed ends soften the hinge, by a third at three widths",
        ),
        (angle < 0.0, "the arms touch before the hinge reaches its rest angle"),
    ];
    let conditions = conditions.iter().filter(|(holds, _)| *holds).map(|(_, text)| (*text).to_owned());
    let mut warnings: Vec<String> = conditions.chain(short_arms(actuator)).collect();
    if !has_ranges && warnings.is_empty() {
        let ([arm_least, arm_most], [arc_least, arc_most]) = (errors::ACTUATOR_ARM, errors::ARC);
        warnings.push(format!(
            "ranges are unknown: no shell like this was computed; those had arms of {arm_least} to {arm_most} widths, hinges of \
             {arc_least} to {arc_most} deg, and t / W of at least {}",
            errors::SLENDERNESS_REACHED[0]
        ));
    }
    warnings
}
