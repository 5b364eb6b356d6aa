//! Equilibria of a sheet under pressure.

mod factor;
mod ladder;
mod newton;

pub use ladder::{Broken, Ladder, Rung};
pub use newton::{Aim, Effort, Rest, Solver, Stop};
