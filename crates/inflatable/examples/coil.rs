//! Coiling of V-actuators of woven fabric: `cargo run --release --example coil -- SHEAR WARP [WIDTH 1/EPS ...] [--margin LAW MM]`.
//!
//! R = 0.1 W, 60 deg, arms of 4 W, t = 0.3 mm, E = 128 MPa, nu = 0.39. SHEAR is G by E / [2 (1 + nu)], WARP the angle to the hinge's plane of
//! symmetry, deg: 0 or 45. WIDTH in mm. LAW is that of a sealed margin of so many mm beyond both long rims, "plane" or
//! "slack". Prints a row for each width and 1/eps.

use inflatable::shell::cases::{Fineness, Margin, MarginLaw, Tube, VActuator, Watch, actuator};
use inflatable::shell::element::{Fabric, Weave};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let margin =
        match words.iter().position(|word| word == "--margin").map(|at| words.split_off(at)).as_deref() {
            None => Margin::NONE,
            Some([_, law, mm]) => {
                let law = if law == "slack" { MarginLaw::Slack } else { MarginLaw::Plane };
                let width = 1e-3 * mm.parse::<f64>()?;
                Margin { inner: width, outer: width, law }
            }
            Some(_) => return Err("--margin takes a law and a width".into()),
        };
    let numbers: Vec<f64> = words.iter().map(|word| word.parse()).collect::<Result<_, _>>()?;
    let [shear, warp, cases @ ..] = numbers.as_slice() else {
        return Err("SHEAR and WARP are needed".into());
    };
    let (t, e, nu) = (0.3e-3_f64, 128e6, 0.39);
    let weave = Weave { shear: *shear, warp: warp.to_radians() };
    let fabric = Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu).woven(weave);
    for case in cases.chunks_exact(2) {
        let width = 1e-3 * case[0];
        let tube = Tube { width, fabric, pressure: case[1] * fabric.bending / width.powi(3) };
        let (radius, arm_length, angle) = (0.1 * width, 4.0 * width, 60.0_f64.to_radians());
        let case = VActuator { tube, radius, arm_length, angle, margin };
        match actuator(&case, &[], Fineness { cells: 6.0, cuts: 2 }, &Watch::default()) {
            Ok(found) => println!(
                "W {:.0} mm, 1/eps {:.0}, {:.1} kPa: lambda {:.3} +- {:.3}, C {:.4} +- {:.4} N m",
                1e3 * width,
                tube.bendability(),
                1e-3 * tube.pressure,
                found.coiling.value,
                found.coiling.error,
                found.stiffness.value,
                found.stiffness.error
            ),
            Err(fault) => println!("W {:.0} mm, 1/eps {:.0}: {fault}", 1e3 * width, tube.bendability()),
        }
    }
    Ok(())
}
