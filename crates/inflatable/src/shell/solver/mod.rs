//! Equilibria of a sheet under pressure.

mod continuation;
mod direction;
mod displacement_control;
mod eigenvalue;
mod experience;
mod factor;
mod newton;
mod rounds;
mod slip;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod woven;

pub use continuation::{Broken, Continuation, Equilibrium};
pub use displacement_control::DisplacementControl;
pub(crate) use eigenvalue::rigid_motions;
pub use newton::{Aim, Effort, NewtonResult, Solver, Stop};
