//! The paper's stars of woven fabric: `cargo run --release --example weave -- POINTS CELLS CUTS [SHEAR WARP [NU [RADIUS ...]]] [--margin LAW INNER OUTER]`.
//!
//! W = 30 mm, rho_0 = 50 mm, tips of 30 deg, sharp hinges, 37 kPa, t = 0.3 mm, E = 128 MPa. Half a sector is computed, cut as the first
//! corner's is. LAW is that of the sealed margin, "plane" or "slack", INNER and
//! OUTER its widths, mm. SHEAR is G by E / [2 (1 + nu)], WARP the angle to the first corner's ray, deg, RADIUS that of an object, mm.
//! Prints each number with its mesh error and its last three meshes.

use inflatable::shell::cases::{FlatStar, Margin, MarginLaw, Objects, Tube, Value, Watch, star_by_sizes};
use inflatable::shell::element::{Fabric, Weave};
use inflatable::shell::mesh::Sizes;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let margin = words.iter().position(|word| word == "--margin").map(|at| words.split_off(at));
    let margin = margin.map_or(Ok(Margin::NONE), |words| margin_of(&words[1..]))?;
    let numbers: Vec<f64> = words.iter().map(|word| word.parse()).collect::<Result<_, _>>()?;
    let number = |place: usize, usual: f64| numbers.get(place).copied().unwrap_or(usual);
    let points = (3..17).find(|points| f64::from(*points) >= number(0, 5.0)).ok_or("POINTS is 3 to 16")?;
    let (cells, cuts) = (number(1, 3.0), (0..9).take_while(|k| f64::from(*k) < number(2, 2.0)).count());
    let weave = Weave { shear: number(3, 1.0), warp: number(4, 0.0).to_radians() };
    let (t, e, nu) = (0.3e-3_f64, 128e6, number(5, 0.39));
    let fabric = Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu).woven(weave);
    let tube = Tube { width: 0.03, fabric, pressure: 37e3 };
    let case = FlatStar { band: 0.002, margin, ..FlatStar::sharp(tube, points, 0.05, 30.0_f64.to_radians()) };
    let radii: Vec<f64> = numbers.iter().skip(6).map(|mm| 1e-3 * mm).collect();
    let sizes = (&Sizes::for_tube(1.0, cells), cuts);
    let found = star_by_sizes(&case, Objects::Radii(&radii), sizes, &Watch::default())?;
    let print = |name: &str, value: Value| {
        let Value { value, error, meshes: [a, b, c] } = value;
        println!("{name:24} {value:10.4} +- {error:.4}   meshes {a:.4} {b:.4} {c:.4}");
    };
    print("final radius, mm", found.final_radius.scaled(1e3));
    print("cut edge, mm", found.edge_radius.scaled(1e3));
    print("tip angle, deg", found.tip_angle.scaled(1.0_f64.to_degrees()));
    print("preload, N", found.preload);
    print("volume, cm^3", found.volume.scaled(1e6));
    print("stiffness, N/m", found.radial_stiffness);
    for (radius, force) in found.forces {
        print(&format!("force at {:.1} mm, N", 1e3 * radius), force);
    }
    println!("unknowns {:?}, iterations {:?}", found.evidence.unknowns, found.evidence.efforts);
    Ok(())
}

/// A margin of its law and its widths in mm.
fn margin_of(words: &[String]) -> Result<Margin, Box<dyn Error>> {
    let [law, inner, outer] = words else { return Err("--margin takes a law and two widths".into()) };
    let law = match law.as_str() {
        "plane" => MarginLaw::Plane,
        "slack" => MarginLaw::Slack,
        _ => return Err("the margin's law is plane or slack".into()),
    };
    Ok(Margin { inner: 1e-3 * inner.parse::<f64>()?, outer: 1e-3 * outer.parse::<f64>()?, law })
}
