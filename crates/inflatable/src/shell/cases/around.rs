//! A star inflated from flat around a round object, as a gripper is used. [`star`](super::star()) opens one that is inflated already.
//!
//! Corners can fold in several ways around one object, all of them stable, so the two forces can differ.

use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::{Family, Watch, values};
use crate::shell::cases::star::FlatStar;
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
    let modelled = case.modelled()?;
    let mut obstacles = modelled.obstacles();
    let post = obstacles.len() - 1;
    obstacles[post] = Obstacle::Post { radius: radius / case.tube.width };
    let coarsest = modelled.meshed(&Sizes::across(1.0, fineness.cells))?;
    let mut meshed = coarsest.clone();
    let (cuts, hold) = (fineness.cuts, case.hold(&modelled));
    let family = Family { tube: case.tube, coarsest, cuts, hold: &hold, obstacles: &obstacles };
    let on_mesh = |meshed: &Meshed| {
        let mut solver = family.solver(meshed, watch)?;
        if let Some(contact) = solver.contact.as_mut().filter(|_| touch == Touch::Sticks) {
            contact.stick(post, case.tube.continuation().last);
        }
        let _ = family.pressurise(&mut solver, watch)?;
        let [force, shear] =
            solver.contact.as_ref().map_or([0.0; 2], |contact| [contact.force(post), contact.shear()]);
        Ok::<_, ShellFault>([force, if force > 0.0 { shear / force } else { 0.0 }])
    };
    let mut found = Vec::new();
    for cut in 0..=cuts {
        if cut > 0 {
            meshed = meshed.refined()?;
        }
        if cut + 3 > cuts {
            found.push(on_mesh(&meshed)?);
        }
    }
    let [force, friction] = values(&found);
    let unit = modelled.count() * case.tube.fabric.stretch * case.tube.width;
    Ok(StarAround { force: force.scaled(unit), friction })
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
        let fineness = |cuts| Fineness { cells: 2.0, cuts };
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
