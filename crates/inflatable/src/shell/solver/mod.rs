//! Equilibria of a sheet under pressure.

mod continuation;
mod displacement_control;
mod factor;
mod newton;
#[cfg(test)]
mod tests;

pub use continuation::{Broken, Continuation, Equilibrium};
pub use displacement_control::DisplacementControl;
pub use newton::{Aim, Effort, Rest, Solver, Stop};
