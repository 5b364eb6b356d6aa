//! A star inflated from flat around a round object, as a gripper is used. [`star`] opens one that is inflated already.
//!
//! Corners can fold in several ways around one object, all of them stable, so the two forces can differ.

use std::sync::Arc;

use inflatable::shell::assembly::{Sheet, Supports};
use inflatable::shell::cases::{Fineness, FlatStar, ShellFault, Tube, Value, Watch};
use inflatable::shell::contact::{Contact, Obstacle};
use inflatable::shell::mesh::{Mesh, Sizes};
use inflatable::shell::solver::Solver;

#[cfg(doc)]
use inflatable::shell::cases::star;

/// What a point of the sheet does where it has touched the object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArmTouch {
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
/// As of [`star`].
pub fn inflate_around(
    case: &FlatStar,
    radius: f64,
    touch: ArmTouch,
    fineness: Fineness,
    watch: &Watch<'_>,
) -> Result<StarAround, ShellFault> {
    let modelled = case.modelled()?;
    let mut meshed = modelled.meshed(&Sizes::for_tube(1.0, fineness.cells))?;
    let mut loads = Vec::new();
    for cut in 0..=fineness.cuts {
        if cut > 0 {
            meshed = meshed.refined()?;
        }
        if cut + 3 > fineness.cuts {
            loads.push(inflated_mesh(case, &meshed.mesh, radius, touch, watch)?);
        }
    }
    // Of fewer than three meshes the finest counts for those that are missing.
    let meshes = [0, 1, 2].map(|mesh: usize| loads[mesh.min(loads.len() - 1)]);
    let [force, friction] = [0, 1].map(|number: usize| Value::new(meshes.map(|load| load[number])));
    let unit = modelled.count() * case.tube.fabric.stretch * case.tube.width;
    Ok(StarAround { force: force.scaled(unit), friction })
}

/// The force on the object, by the scales of the shell, and the friction, of one mesh.
fn inflated_mesh(
    case: &FlatStar,
    mesh: &Mesh,
    radius: f64,
    touch: ArmTouch,
    watch: &Watch<'_>,
) -> Result<[f64; 2], ShellFault> {
    let (modelled, continuation) = (case.modelled()?, case.tube.continuation());
    let mut obstacles = modelled.obstacles();
    let post = obstacles.len() - 1;
    obstacles[post] = Obstacle::Post { radius: radius / case.tube.width };
    let mut solver = scaled_solver(&case.tube, mesh, modelled.supports(mesh), watch)?;
    let mut contact = Contact::new(&solver.assembly, obstacles);
    if touch == ArmTouch::Sticks {
        contact.stick(post, continuation.last);
    }
    solver.contact = Some(contact);
    let equilibrium = continuation.run(&mut solver, |_| {});
    let _ = equilibrium.map_err(|broken| case.tube.stopped(broken.why, mesh.triangles.len()))?;
    let contact = solver.contact.as_ref();
    let [force, shear] = contact.map_or([0.0; 2], |contact| [contact.force(post), contact.shear()]);
    Ok([force, if force > 0.0 { shear / force } else { 0.0 }])
}

/// The solver of one sheet of `tube` on `mesh`, in the scales of the shell; it stops when `watch` is cancelled.
pub(crate) fn scaled_solver(
    tube: &Tube,
    mesh: &Mesh,
    supports: Supports,
    watch: &Watch<'_>,
) -> Result<Solver, ShellFault> {
    let sheet = Sheet::new(mesh, tube.scaled());
    let solver = Solver::new(sheet, supports);
    let mut solver = solver.ok_or(ShellFault::TooLarge { triangles: mesh.triangles.len() })?;
    solver.cancel = Arc::clone(&watch.cancel);
    Ok(solver)
}
