//! A star inflated from flat around a round object, as a gripper is used. [`star`](super::star()) opens one that is inflated already.
//!
//! Corners fold in several ways around one object, all of them stable, so the two forces differ by more than their mesh errors.

use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::{Family, Watch};
use crate::shell::cases::star::FlatStar;
use crate::shell::cases::star_part::ModelledPart;
use crate::shell::cases::{Fineness, Value};
use crate::shell::contact::Obstacle;
use crate::shell::mesh::{Meshed, Sizes};

/// What a point of the sheet does where it has touched the object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// It slides without friction.
    Slides,
    /// It stays as long as it touches: friction without a limit.
    Sticks,
}

/// A star around an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarAround {
    /// The sum of the radial forces on the object, N.
    pub force: Value,
    /// The sum of the shear forces by which points stick, over that of the radial ones: the friction that they need in the mean.
    pub friction: Value,
}

/// Shear traction of the springs of points that stick, p for each W. Four times as stiff ones change a force by 0.03 %.
const STICKING: f64 = 1e4;

/// Inflates a star from flat around a round object of `radius`, m. Each mesh begins from flat.
///
/// # Errors
/// As of [`star`](super::star()).
pub fn around(
    case: &FlatStar,
    (radius, touch): (f64, Touch),
    fineness: Fineness,
    watch: &Watch,
) -> Result<StarAround, ShellFault> {
    let modelled = ModelledPart {
        part: case.part(),
        sector: case.sector()?,
        margin: case.margin.widths(case.tube.width),
    };
    let mut obstacles = modelled.obstacles();
    let post = obstacles.len() - 1;
    obstacles[post] = Obstacle::Post { radius: radius / case.tube.width };
    let mut meshed = modelled.meshed(&Sizes::across(1.0, fineness.cells))?;
    let mut found = Vec::new();
    for cut in 0..=fineness.cuts {
        if cut > 0 {
            meshed = meshed.refined()?;
        }
        if cut + 3 > fineness.cuts {
            found.push(on_mesh((case, &modelled), &meshed, (&obstacles, touch), watch)?);
        }
    }
    let value = |of: usize| Value::new(std::array::from_fn(|mesh| found[mesh.min(found.len() - 1)][of]));
    let unit = modelled.count() * case.tube.fabric.stretch * case.tube.width;
    Ok(StarAround { force: value(0).scaled(unit), friction: value(1) })
}

/// Force, scaled, and friction of the modelled sheet on one mesh.
fn on_mesh(
    (case, modelled): (&FlatStar, &ModelledPart),
    meshed: &Meshed,
    (obstacles, touch): (&[Obstacle], Touch),
    watch: &Watch,
) -> Result<[f64; 2], ShellFault> {
    let hold = case.hold(modelled);
    let family = Family {
        tube: case.tube,
        coarsest: meshed.clone(),
        cuts: 2,
        hold: &hold,
        obstacles,
        from_above: false,
    };
    let mut solver = family.solver(meshed, watch)?;
    let post = obstacles.len() - 1;
    if let Some(contact) = solver.contact.as_mut().filter(|_| touch == Touch::Sticks) {
        contact.stick(post, STICKING * case.tube.continuation().last);
    }
    let _ = family.pressurise(&mut solver, watch)?;
    let Some(contact) = &solver.contact else { return Ok([0.0; 2]) };
    let force = contact.force(post);
    Ok([force, if force > 0.0 { contact.shear() / force } else { 0.0 }])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::cases::tests::tube;
    use crate::shell::cases::{Objects, star};

    #[test]
    fn a_star_inflated_around_its_object_presses_as_one_that_is_opened() {
        let case = FlatStar::sharp(tube(0.03, 37e3), 5, 0.05, 30.0_f64.to_radians());
        let watch = Watch::default();
        let fineness = |cuts| Fineness { cells: 2.5, cuts };
        let opened = star(&case, Objects::Radii(&[0.04]), fineness(2), &watch).expect("a shell").forces[0].1;
        // On the first of those meshes, and on the second, where points beside the apex touch.
        let on = |cuts, touch| around(&case, (0.04, touch), fineness(cuts), &watch).expect("a shell");
        let (slides, sticks) = (on(0, Touch::Slides), on(1, Touch::Sticks));
        assert!((slides.force.meshes[2] / opened.meshes[0] - 1.0).abs() < 1e-4, "{slides:?} {opened:?}");
        assert_eq!(slides.friction.meshes[2], 0.0);
        assert!(sticks.force.meshes[2] > 1.3 * opened.meshes[1], "{sticks:?} {opened:?}");
        assert!(sticks.friction.meshes[2] > 1.0, "{sticks:?}");
    }
}
