//! `stargrip-cam actuator`

use crate::answer::quantity::{EXTRA, SIZE, evenly, number, quantity, range};
use crate::cli::failure::Failure;
use crate::cli::predict::MODELS;
use crate::cli::shell::{ShellArgs, refused};
use crate::cli::verbosity::Verbosity;
use crate::cli::words::words;
use forecast::actuator::{Actuator, actuate};
use forecast::model_selection::named_limit;
use forecast::pressures::outside_section;
use forecast::shell::Detail;
use forecast::shell::actuator;
use forecast::shell::sheet::ModelledSheet;
use inflatable::mechanics::hinge::Level;
use inflatable::mechanics::strength::ElasticSheet;
use spec::units::{Angle, Length, Pressure};
use spec::{Allowed, ModelChoice};

/// Angles between arms.
const BETWEEN: Allowed = Allowed::open(0.0, 180.0);
/// Most angles of one curve.
const MOST_ANGLES: u32 = 10_000;

/// Arguments of `actuator`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// Flat width of the tube.
    #[arg(long, allow_hyphen_values = true, value_parser = quantity::<Length>(SIZE))]
    tube_width: Length,
    /// Inner radius of the flat hinge.
    #[arg(long, allow_hyphen_values = true, value_parser = quantity::<Length>(EXTRA))]
    radius: Length,
    /// Straight length from the hinge's end to the sealed end.
    #[arg(long, allow_hyphen_values = true, value_parser = quantity::<Length>(SIZE))]
    arm_length: Length,
    /// Flat angle between the arms.
    #[arg(long, allow_hyphen_values = true, value_parser = quantity::<Angle>(BETWEEN))]
    angle: Angle,
    /// Gauge pressure.
    #[arg(long, allow_hyphen_values = true, value_parser = quantity::<Pressure>(Allowed::half_open(0.0, 1e5)))]
    pressure: Pressure,
    /// Thickness of the fabric.
    #[arg(long, default_value = "0.3 mm", allow_hyphen_values = true, value_parser = quantity::<Length>(SIZE))]
    thickness: Length,
    /// Young's modulus of the fabric.
    #[arg(long, default_value = "128 MPa", allow_hyphen_values = true, value_parser = quantity::<Pressure>(Allowed::closed(1e-3, 1e9)))]
    young_modulus: Pressure,
    /// Poisson ratio of the fabric.
    #[arg(long, default_value_t = 0.39, allow_hyphen_values = true, value_parser = number(Allowed::half_open(-1.0, 0.5)))]
    poisson_ratio: f64,
    /// The model to use; auto is section.
    #[arg(long, value_name = "MODEL", default_value = "auto", value_parser = words(&ModelChoice::ALL, &MODELS))]
    model: ModelChoice,
    /// Also print the moment that holds the hinge at each of these angles: "30 deg..90 deg/7".
    #[arg(long, value_name = "FROM..TO/COUNT", allow_hyphen_values = true, value_parser = angles)]
    angles: Option<Angles>,
    #[command(flatten)]
    shell: ShellArgs,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Evenly spaced angles, rad.
#[derive(Clone, Debug, PartialEq)]
struct Angles(Vec<f64>);

/// A V-actuator and the options of its prediction.
#[derive(Clone, Debug)]
pub struct ActuatorQuestion {
    /// The actuator.
    pub actuator: Actuator,
    /// The angles at which its moment is computed, rad.
    pub angles: Vec<f64>,
    /// The hinge model; `None` for the shell model.
    pub level: Option<Level>,
    /// Fineness of the shell's mesh.
    pub detail: Detail,
}

impl Args {
    /// The question that the arguments describe.
    pub(super) fn question(&self) -> Result<ActuatorQuestion, Failure> {
        let young_modulus = self.young_modulus.pascals();
        let sheet = ElasticSheet::new(self.thickness.metres(), young_modulus, self.poisson_ratio);
        let actuator = Actuator {
            width: self.tube_width.metres(),
            radius: self.radius.metres(),
            arm: self.arm_length.metres(),
            angle: self.angle.rad(),
            pressure: self.pressure.pascals(),
            sheet: sheet.map_err(Failure::message)?,
        };
        Ok(ActuatorQuestion {
            actuator,
            angles: self.angles.as_ref().map_or_else(Vec::new, |angles| angles.0.clone()),
            level: named_limit(self.model).or((self.model != ModelChoice::Shell).then_some(Level::Section)),
            detail: self.shell.fineness.unwrap_or(Detail::Medium),
        })
    }
}

/// Predicts, and prints the answer.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let ActuatorQuestion { actuator, angles, level, detail } = args.question()?;
    let Some(level) = level else {
        let question = format!("actuator {actuator:?} {angles:?}");
        return args.shell.show(&question, args.verbosity, |watch| {
            let answer = actuator::actuate(&actuator, &angles, detail, watch);
            let (prediction, shape) = answer.map_err(|fault| refused(&fault))?;
            Ok((prediction.to_json(), prediction.to_text(), Some(ModelledSheet::of_actuator(shape))))
        });
    };
    args.shell.not_by_others()?;
    let prediction = actuate(&actuator, level, &angles).map_err(|fault| {
        match outside_section(&fault, &actuator.sheet, actuator.width, actuator.pressure) {
            Some((found, remedy)) => Failure::Message(format!("{found}: {remedy}")),
            None => Failure::message(fault),
        }
    })?;
    args.verbosity.show(&prediction.to_text(), &prediction.to_json())
}

/// Reads "FROM..TO/COUNT", or one angle.
fn angles(text: &str) -> Result<Angles, String> {
    let ends = |ends: &str| range::<Angle>(BETWEEN)(ends).map(|(from, to)| [from.rad(), to.rad()]);
    evenly(text, MOST_ANGLES, ends).map(Angles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_evenly_spaced_from_end_to_end() {
        let read = angles("30 deg..90 deg/3").expect("valid").0;
        for (got, want) in read.iter().zip([30.0_f64, 60.0, 90.0]) {
            assert!((got - want.to_radians()).abs() < 1e-15);
        }
        assert_eq!(angles("30 deg").expect("valid").0.len(), 1);
        for bad in ["30 deg..90 deg", "30 deg..90 deg/0", "30 deg..90 deg/x", "90 deg..30 deg/3", "30/3"] {
            assert!(angles(bad).is_err(), "{bad}");
        }
    }
}
