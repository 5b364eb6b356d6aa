//! One hinge at its pressure: its state at rest, the loads in its sheet, and its limit.
//!
//! `cargo run --release --example section`

use inflatable::mechanics::hinge::ring::Ring;
use inflatable::mechanics::hinge::section::Section;
use inflatable::mechanics::hinge::{HingeModel, seal_load};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "t/W = 0.015, nu = 0.39, R* = 0.1: 1/eps, lambda, C alpha_0 / (p W^3), k, width, largest stretch, hoop tension"
    );
    for bendability in [10.0, 30.0, 100.0, 330.0, 1e3, 3e3] {
        let section = Section::new(bendability, 0.015, 0.39)?;
        let rest = section.target(0.1)?;
        let meridian = section.meridian(0.1)?;
        println!(
            "  {bendability:5}  {:.5}  {:8.4}  {:.3}  {:.4}  {:.4}  {:.2} to {:.2}",
            rest.lambda,
            -rest.curvature,
            seal_load(0.1, &rest).unwrap_or(f64::NAN),
            rest.edges.map_or(f64::NAN, |edges| edges.width),
            meridian.largest(|point| point.stretch),
            -meridian.largest(|point| -point.hoop_tension),
            meridian.largest(|point| point.hoop_tension)
        );
    }
    println!(
        "the ring, R* = 0.1: lambda {:.5}, C {:.4}",
        Ring.target(0.1)?.lambda,
        -Ring.target(0.1)?.curvature
    );
    println!("hoop compression left out, t/W = 0.003, nu = 0: 1/eps, lambda, C");
    for bendability in [1e2, 1e3, 1e4] {
        let field = Section::new(bendability, 0.003, 0.0)?.slack().target(0.1)?;
        println!("  {bendability:5}  {:.5}  {:.4}", field.lambda, -field.curvature);
    }
    println!("1/eps = 330, t/W = 0.015, nu = 0.39: R*, lambda, C");
    for r_star in [0.0, 1e-6, 1e-3, 0.01, 0.1, 1.0, 3.0] {
        let rest = Section::new(330.0, 0.015, 0.39)?.target(r_star)?;
        println!("  {r_star:8}  {:.5}  {:.4}", rest.lambda, -rest.curvature);
    }
    Ok(())
}
