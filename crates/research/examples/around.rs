//! Forces on objects that open an inflated star, and on those around which it inflates, with corners that slide and that stick: the table of
//! docs/models.md. Minutes.
//!
//! `cargo run --release -p research --example around`

use inflatable::shell::cases::{Fineness, FlatStar, Objects, ShellFault, Value, Watch, star};
use research::around::{ArmTouch, inflate_around};
use research::stars::draw::Set;

/// Meshes of some 1,500, 3,300 and 11,000 unknowns.
const FINENESS: Fineness = Fineness { cells: 8.0, cuts: 2 };
/// Radii of objects by rho_0.
const OBJECTS: [f64; 2] = [0.8, 0.92];

fn main() {
    println!(
        "| n | object | opened by it | inflated around it | the same, sticking | friction to stick |\n|---|---|---|---|---|---|"
    );
    for drawn in [13, 14, 15, 16, 18].map(|number| Set::Paper.star(number)) {
        for part in OBJECTS {
            if let Err(fault) = row(&drawn.flat(), part * drawn.inner_radius) {
                println!("| {} | {} mm | {fault} |", drawn.points, part * drawn.inner_radius);
            }
        }
    }
}

/// The forces on an object of `radius`, mm, of the finest mesh, and how much more or less those of the mesh before are.
fn row(case: &FlatStar, radius: f64) -> Result<(), ShellFault> {
    let (watch, object) = (Watch::default(), 1e-3 * radius);
    let opened = star(case, Objects::Radii(&[object]), FINENESS, &watch)?;
    if opened.final_radius.value >= object {
        return Ok(());
    }
    let slides = inflate_around(case, object, ArmTouch::Slides, FINENESS, &watch)?;
    let sticks = inflate_around(case, object, ArmTouch::Sticks, FINENESS, &watch)?;
    let cell = |force: Value| format!("{:.1} N ({:+.1})", force.meshes[2], force.meshes[1] - force.meshes[2]);
    let [opened, slides, stuck] = [opened.forces[0].1, slides.force, sticks.force].map(cell);
    println!(
        "| {} | {radius} mm | {opened} | {slides} | {stuck} | {:.2} |",
        case.points, sticks.friction.meshes[2]
    );
    Ok(())
}
