//! A V-actuator as a shell: `cargo run --release --example shell [cells] [cuts] [angle in deg ...]`.
//!
//! W = 20 mm, R = 2 mm, arms of 80 mm, 60 deg, 14 kPa, t = 0.3 mm, E = 128 MPa, nu = 0.39. Prints each number with its mesh
//! error and its last three meshes; further angles are held, and the moments that hold them printed.

use inflatable::shell::cases::{Fineness, Margin, Tube, VActuator, Value, Watch, actuator};
use inflatable::shell::element::Fabric;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<f64> = std::env::args().skip(1).map(|word| word.parse()).collect::<Result<_, _>>()?;
    let standard = Fineness::default();
    let cells = arguments.first().copied().unwrap_or(standard.cells);
    let cuts =
        arguments.get(1).map_or(standard.cuts, |cuts| (0..9).take_while(|k| f64::from(*k) < *cuts).count());
    let angles: Vec<f64> = arguments.iter().skip(2).map(|angle| angle.to_radians()).collect();
    let (t, e, nu) = (0.3e-3_f64, 128e6, 0.39);
    let fabric = Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu);
    let tube = Tube { width: 0.02, fabric, pressure: 14e3 };
    let case = VActuator {
        tube,
        radius: 0.002,
        arm_length: 0.08,
        angle: 60.0_f64.to_radians(),
        margin: Margin::NONE,
    };
    let found = actuator(&case, &angles, Fineness { cells, cuts }, &Watch::default())?;
    let print = |name: &str, value: Value| {
        let Value { value, error, meshes: [a, b, c] } = value;
        println!("{name:24} {value:12.5} +- {error:.5}   meshes {a:.5} {b:.5} {c:.5}");
    };
    print("angle, deg", found.angle.scaled(1.0_f64.to_degrees()));
    print("coiling", found.coiling);
    print("volume, mm^3", found.volume.scaled(1e9));
    print("stiffness, N m", found.stiffness);
    for (angle, moment) in found.moments {
        print(&format!("moment at {:.2} deg, N m", angle.to_degrees()), moment);
    }
    println!("unknowns {:?}", found.evidence.unknowns);
    Ok(())
}
