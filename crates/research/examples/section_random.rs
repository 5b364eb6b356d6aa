//! The section at random over its whole range: does any hinge fail, and how many factorisations does it take?
//!
//! `cargo run --release -p research --example section_random -- 10000`

#[path = "support/dice.rs"]
mod dice;

use dice::Dice;
use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::section::Section;
use std::env;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: u32 = env::args().nth(1).unwrap_or("1000".to_owned()).parse()?;
    let mut dice = Dice(7);
    let mut draw = || dice.throw();
    let (mut drawn, mut failed, mut all, mut most) = (0, 0, 0, 0);
    while drawn < wanted {
        let (bendability, thickness) = (10.0 * 1e3_f64.powf(draw()), 0.003 * 10_f64.powf(draw()));
        let (poisson, place) = (0.49 * draw(), draw());
        // A tenth are points, two fifths sharp rims, the rest even.
        let r_star = match place {
            ..0.1 => 0.0,
            ..0.5 => 1e-6 * 3e6_f64.powf(draw()),
            _ => 3.0 * draw(),
        };
        // Where p W / Y is out of range there is no section.
        let Ok(section) = Section::new(bendability, thickness, poisson) else { continue };
        drawn += 1;
        match section.target(r_star) {
            Ok(rest) => {
                all += rest.effort.iterations;
                most = most.max(rest.effort.iterations);
            }
            Err(fault) => {
                failed += 1;
                println!("1/eps {bendability}, t/W {thickness}, nu {poisson}: {fault}");
            }
        }
    }
    let mean = f64::from(all) / f64::from(drawn);
    println!("{drawn} hinges, {failed} not found; factorisations {mean:.1} in the mean, {most} at most");
    Ok(())
}
