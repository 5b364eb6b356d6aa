//! A single hinge between two arms as a shell, in the words of predictions.

use crate::actuator::{
    Actuator, ActuatorEvidence, ActuatorMeshErrors, ActuatorPrediction, ActuatorRanges, short_arms,
};
use crate::shell::{Detail, SHELL, fabric, fineness};
use inflatable::shell::cases::{InflatedShape, Margin, ShellFault, Tube, VActuator, Value, Watch, actuator};
use inflatable::shell::element::Weave;

/// The prediction of `flat_actuator` as a shell, with the moments at `angles` (rad) if there are any, and its sheet at rest.
///
/// # Errors
/// The errors of [`actuator`].
pub fn actuate(
    flat_actuator: &Actuator,
    angles: &[f64],
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<(ActuatorPrediction, InflatedShape), ShellFault> {
    let Actuator { width, radius, arm, angle, pressure, sheet } = *flat_actuator;
    let case = VActuator {
        tube: Tube { width, fabric: fabric(&sheet, Weave::ISOTROPIC), pressure },
        radius,
        arm_length: arm,
        angle,
        margin: Margin::NONE,
    };
    let inflated = actuator(&case, angles, fineness(detail), watch)?;
    let degrees = 1.0_f64.to_degrees();
    let (at_rest, volume) = (inflated.angle.scaled(degrees), inflated.volume.scaled(1e9));
    let touches = inflated.angle.value < 0.0 || angles.iter().any(|angle| *angle < 0.0);
    let warnings = [
        short_arms(flat_actuator),
        touches.then(|| "the arms would touch, and this shell has no contact between them".to_owned()),
    ];
    let prediction = ActuatorPrediction {
        model: SHELL,
        bendability: case.tube.bendability(),
        stretch: case.tube.stretch(),
        angle_deg: at_rest.value,
        coiling: inflated.coiling.value,
        volume_mm3: Some(volume.value),
        stiffness_Nm: inflated.stiffness.value,
        moment: (!angles.is_empty()).then(|| {
            inflated.moments.iter().map(|(angle, moment)| [angle.to_degrees(), moment.value]).collect()
        }),
        ranges: ActuatorRanges::default(),
        evidence: ActuatorEvidence {
            residual: inflated.evidence.residual,
            iterations: inflated.evidence.efforts.iter().map(|effort| effort.iterations).sum(),
            numerical_error: largest([inflated.coiling, inflated.volume, inflated.stiffness]),
            mesh_errors: Some(ActuatorMeshErrors {
                angle_deg: at_rest.error,
                coiling: inflated.coiling.error,
                volume_mm3: volume.error,
                stiffness_Nm: inflated.stiffness.error,
                moment_Nm: inflated.moments.iter().map(|(_, moment)| moment.error).collect(),
            }),
            unknowns: Some(inflated.evidence.unknowns),
            warnings: warnings.into_iter().flatten().collect(),
        },
    };
    Ok((prediction, inflated.shape))
}

/// The largest relative mesh error.
fn largest(values: [Value; 3]) -> f64 {
    values.iter().map(|value| (value.error / value.value).abs()).fold(0.0, f64::max)
}
