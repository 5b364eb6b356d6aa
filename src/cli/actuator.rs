//! `stargrip-cam actuator`

use crate::cli::failure::{Failure, say};
use crate::cli::predict::Model;
use crate::cli::quantity::{EXTRA, SIZE, evenly, number, quantity, range};
use crate::cli::shell::{ShellArgs, Shown, refused};
use crate::cli::voice::Voice;
use crate::forecast::actuator::{Actuator, actuate};
use crate::forecast::by_shell;
use crate::mechanics::hinge::Level;
use crate::mechanics::strength::ElasticSheet;
use crate::spec::Allowed;
use crate::units::{Angle, Length, Pressure};

/// Angles between arms.
const BETWEEN: Allowed = Allowed::between(0.0, 180.0);
/// Most angles of one curve.
const MOST_ANGLES: u32 = 10_000;

/// Arguments of `actuator`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// Flat width of the tube.
    #[arg(long, value_parser = quantity::<Length>(SIZE))]
    tube_width: Length,
    /// Inner radius of the flat hinge.
    #[arg(long, value_parser = quantity::<Length>(EXTRA))]
    radius: Length,
    /// Straight length from the hinge's end to the sealed end.
    #[arg(long, value_parser = quantity::<Length>(SIZE))]
    arm_length: Length,
    /// Flat angle between the arms.
    #[arg(long, value_parser = quantity::<Angle>(BETWEEN))]
    angle: Angle,
    /// Gauge pressure.
    #[arg(long, value_parser = quantity::<Pressure>(Allowed::above(0.0, 1e5)))]
    pressure: Pressure,
    /// Thickness of the fabric.
    #[arg(long, default_value = "0.3 mm", value_parser = quantity::<Length>(SIZE))]
    thickness: Length,
    /// Young's modulus of the fabric.
    #[arg(long, default_value = "128 MPa", value_parser = quantity::<Pressure>(Allowed::closed(1e-3, 1e9)))]
    young_modulus: Pressure,
    /// Poisson ratio of the fabric.
    #[arg(long, default_value_t = 0.39, value_parser = number(Allowed::above(-1.0, 0.5)))]
    poisson_ratio: f64,
    /// The model to use; auto is section.
    #[arg(long, value_name = "MODEL", default_value = "auto")]
    model: Model,
    /// Also the moment that holds it at each of these angles: "30 deg..90 deg/7".
    #[arg(long, value_name = "FROM..TO/COUNT", value_parser = angles)]
    angles: Option<Angles>,
    #[command(flatten)]
    shell: ShellArgs,
    #[command(flatten)]
    voice: Voice,
}

/// Evenly spaced angles, rad.
#[derive(Clone, Debug, PartialEq)]
struct Angles(Vec<f64>);

/// Predicts, and prints the answer.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let message = |fault: crate::mechanics::fault::StarFault| Failure::Message(fault.to_string());
    let young_modulus = args.young_modulus.pascals();
    let sheet = ElasticSheet::new(args.thickness.metres(), young_modulus, args.poisson_ratio);
    let actuator = Actuator {
        width: args.tube_width.metres(),
        radius: args.radius.metres(),
        arm: args.arm_length.metres(),
        angle: args.angle.rad(),
        pressure: args.pressure.pascals(),
        sheet: sheet.map_err(message)?,
    };
    let angles = args.angles.as_ref().map_or(&[][..], |angles| &angles.0);
    let level = match args.model {
        Model::Fit => Level::Fit,
        Model::Ring => Level::Ring,
        Model::Bvp => Level::Bvp,
        Model::Section | Model::Auto => Level::Section,
        Model::Shell => return run_shell(args, &actuator, angles),
    };
    args.shell.not_by_others()?;
    let prediction = actuate(&actuator, level, angles).map_err(message)?;
    if args.voice.json { say(&prediction.to_json()) } else { args.voice.remark(&prediction.to_text()) }
}

/// The same by the shell.
fn run_shell(args: &Args, actuator: &Actuator, angles: &[f64]) -> Result<(), Failure> {
    let question = format!("actuator {actuator:?} {angles:?}");
    args.shell.show(&question, args.voice, |watch| {
        let (prediction, shape) = by_shell::actuate(actuator, angles, args.shell.detail(), watch)
            .map_err(|fault| refused(&fault))?;
        let vtu = args.shell.wants_vtu().then(|| shape.vtu()).transpose();
        let vtu = vtu.map_err(|fault| Failure::Message(fault.to_string()))?;
        Ok(Shown { json: prediction.to_json(), text: prediction.to_text(), vtu })
    })
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
