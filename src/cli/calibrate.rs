//! `stargrip-cam calibrate`

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use crate::cli::failure::Failure;
use crate::cli::failure::say;
use crate::coupon::calibrate;
use crate::coupon::read_rows;
use crate::mechanics::hinge::HingeModel;
use crate::mechanics::ring::Ring;
use crate::units::LineForce;
use crate::units::Quantity;

/// Arguments of `calibrate`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The filled-in table that `coupon` wrote.
    results: PathBuf,
    /// What the seal has to hold, such as "1.2 N/mm" (`check` tells the load); without it the strongest is needed least.
    #[arg(long, value_parser = force, default_value = "0 N/mm")]
    needed: f64,
    /// How many times that the seal should hold.
    #[arg(long, default_value_t = 1.5)]
    margin: f64,
    /// The V-actuator's angle between its arms, flat, deg.
    #[arg(long, requires = "inflated_angle")]
    flat_angle: Option<f64>,
    /// The same, inflated and free, deg.
    #[arg(long, requires = "flat_angle", allow_hyphen_values = true)]
    inflated_angle: Option<f64>,
    /// The V-actuator's R / W as the band makes it.
    #[arg(long, default_value_t = 1.0 / 30.0)]
    radius_ratio: f64,
}

fn force(text: &str) -> Result<f64, String> {
    let parsed = LineForce::parse(text).ok().filter(|force| force.0 >= 0.0);
    parsed.map(|force| force.0).ok_or_else(|| format!("a force per length: {}", LineForce::unit_list()))
}

/// Says what the spec should say.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let text =
        fs::read_to_string(&args.results).map_err(|error| Failure::file("read", &args.results, &error))?;
    let refused = |fault| Failure::Message(format!("{}: {fault}", args.results.display()));
    let rows = read_rows(&text).map_err(refused)?;
    let mut out = String::new();
    if let Some((flat, inflated)) = args.flat_angle.zip(args.inflated_angle) {
        if !(flat > 0.0 && flat < 180.0 && inflated > -180.0 && inflated < 180.0) {
            let found = format!("angles of {flat} and {inflated} deg");
            return Err(Failure::Message(format!("{found}; they must be between 0 (-180) and 180 deg")));
        }
        let measured = (180.0 - inflated) / (180.0 - flat);
        let _ = writeln!(out, "# lambda measured: {measured:.3}");
        match Ring.target(args.radius_ratio) {
            Ok(state) => {
                let off = 100.0 * (measured / state.lambda - 1.0);
                let _ =
                    writeln!(out, "# lambda predicted (ring): {:.3}; measured is {off:+.1} %", state.lambda);
            }
            Err(fault) => return Err(Failure::Message(format!("--radius-ratio: {fault}"))),
        }
    }
    let chosen = calibrate(&rows, args.needed, args.margin).map_err(refused)?;
    out.push_str(&chosen.toml());
    say(&out)
}
