//! `stargrip-cam cone`

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::answer::quantity::{SIZE, number, quantity};
use crate::cli::failure::{Failure, say, tell};
use crate::cli::load::{Loaded, once};
use crate::cli::text_file::{TABLE, read_text};
use crate::cli::verbosity::{Verbosity, pretty};
use crate::cli::words::words;
use crate::coupon::cone::{Balance, Cone, Overlay, Predicted, ReducedPoint, csv, read_cone_test, reduce};
use design::Star;
use forecast::case::Case;
use forecast::model_selection::of_spec;
use forecast::outcome::Outcome;
use forecast::ranges::errors;
use inflatable::mechanics::fault::StarFault;
use spec::units::{Angle, Length};
use spec::{Allowed, Source};

/// Arguments of `cone`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The test's CSV, with a header: travel_mm (or displacement_mm, extension_mm) and the vertical load_N.
    data: PathBuf,
    /// Half the cone's angle.
    #[arg(long, default_value = "30 deg", allow_hyphen_values = true, value_parser = quantity::<Angle>(Allowed::between(0.0, 90.0)))]
    half_angle: Angle,
    /// Kinetic friction with cone and plate.
    #[arg(long, default_value_t = 0.1, allow_hyphen_values = true, value_parser = number(Allowed::closed(0.0, 10.0)))]
    friction: f64,
    /// Balance of forces: derived, or published (with the plate's friction as the paper prints it).
    #[arg(long, default_value = "derived", value_parser = words(&Balance::ALL, &[]))]
    balance: Balance,
    /// Radius at first contact, where the travel is 0; default: the predicted final radius of --spec.
    #[arg(long, allow_hyphen_values = true, value_parser = quantity::<Length>(SIZE))]
    contact_radius: Option<Length>,
    /// Add the prediction for this spec to the data; its `[load]` must give the pressure.
    #[arg(long)]
    spec: Option<PathBuf>,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Reduces the data, and prints CSV.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let no_radius = || Failure::Usage("give --contact-radius, or a --spec that predicts it".to_owned());
    once([&args.data].into_iter().chain(&args.spec))?;
    if args.contact_radius.is_none() && args.spec.is_none() {
        return Err(no_radius());
    }
    let source = Source::new(args.data.display().to_string(), read_text(&args.data, TABLE)?);
    let cone = Cone::new(args.half_angle.rad(), args.friction, args.balance).map_err(Failure::message)?;
    let contact = args.contact_radius.map(Length::metres);
    let reduced = |first: f64, overlay: Option<Overlay<'_>>| {
        let test = read_cone_test(&source, &cone, first)?;
        show(args, cone.ratio(), first, &reduce(&test, &cone, first, overlay))
    };
    let Some(path) = &args.spec else {
        return reduced(contact.ok_or_else(no_radius)?, None);
    };
    let spec = Loaded::spoken(path, args.verbosity)?.with_stars("cone")?.reading.spec;
    let pressure = spec.load.as_ref().and_then(|load| load.pressure);
    let pressure = pressure.ok_or_else(|| Failure::message("the spec's [load] has no pressure"))?;
    let star = spec.stars.first().ok_or_else(|| Failure::message("the spec has no star"))?;
    let star = Star::new(star).map_err(Failure::message)?;
    let fault = |fault: StarFault| Failure::message(fault);
    let case = Case { object: None, ..Case::of(&spec, &star).map_err(fault)? };
    let model = of_spec(spec.accuracy.model, &case, pressure.pascals()).map_err(fault)?;
    let (_, own) = Outcome::of(&case, model.as_ref()).map_err(fault)?;
    let first = contact.or(own.known.then_some(own.rest.radius)).ok_or_else(|| {
        Failure::Message(format!(
            "{}: give --contact-radius, or another accuracy.model",
            errors::UNKNOWN_MESSAGE
        ))
    })?;
    let overlay = |rho: f64| {
        let opened = Outcome::of(&Case { object: Some(rho), ..case }, model.as_ref()).ok();
        opened.map_or(Predicted::default(), |(_, own)| Predicted {
            force: own.object_force(),
            range: own.force_range,
        })
    };
    reduced(first, Some(&overlay))
}

/// Prints the points, and with --verbose the parameters of their reduction.
fn show(args: &Args, ratio: f64, first: f64, points: &[ReducedPoint]) -> Result<(), Failure> {
    let first = Length::from_metres(first);
    if args.verbosity.json {
        return say(&pretty(&json!({
            "force_per_load": ratio,
            "contact_radius_mm": first.0,
            "points": points.iter().map(point).collect::<Vec<_>>(),
        })));
    }
    if args.verbosity.verbose {
        tell(&format!("radial force over load {ratio:.4}; radius at first contact {:.3} mm", first.0));
    }
    say(&csv(points))
}

fn point(point: &ReducedPoint) -> Value {
    let Predicted { force, range } = point.predicted.unwrap_or_default();
    json!({
        "travel_mm": point.press.travel,
        "load_N": point.press.load,
        "radius_mm": point.radius,
        "force_N": point.force,
        "predicted_N": force,
        "predicted_range_N": range,
    })
}
