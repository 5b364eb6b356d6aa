//! `stargrip-cam calibrate`

use std::fmt::Write;
use std::path::PathBuf;

use crate::cli::failure::{Failure, say, shown};
use crate::cli::read_text;
use crate::coupon::{calibrate, read_rows};
use crate::mechanics::hinge::HingeModel;
use crate::mechanics::hinge::ring::Ring;
use crate::units::{LineForce, Quantity};

/// Arguments of `calibrate`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The filled-in table that `coupon` wrote.
    results: PathBuf,
    /// What the seal has to hold, such as "1.2 N/mm" (`check` tells the load); without it every even seal holds, and the fastest is chosen.
    #[arg(long, value_parser = force, default_value = "0 N/mm")]
    needed: f64,
    /// How many times that the seal should hold, 1 to 100.
    #[arg(long, default_value_t = 1.5, value_parser = margin)]
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

fn margin(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|margin| (1.0..=100.0).contains(margin));
    number.ok_or_else(|| "a number from 1 to 100".to_owned())
}

/// Says what the spec should say.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let text = read_text(&args.results)?;
    let refused = |fault| Failure::Message(format!("{}: {fault}", shown(&args.results)));
    let rows = read_rows(&text).map_err(refused)?;
    let mut out = String::new();
    if let Some((flat, inflated)) = args.flat_angle.zip(args.inflated_angle) {
        if !(flat > 0.0 && flat < 180.0 && inflated > -180.0 && inflated < 180.0) {
            let found = format!("angles of {flat} and {inflated} deg");
            return Err(Failure::Message(format!(
                "{found}; --flat-angle must be above 0 and below 180, --inflated-angle above -180 and below 180"
            )));
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
    // What the V-actuator tells does not hang on the strips.
    say(&out)?;
    let chosen = calibrate(&rows, args.needed, args.margin).map_err(refused)?;
    say(&chosen.toml())
}
