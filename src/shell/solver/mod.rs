//! Equilibria of a sheet under pressure.

mod factor;
mod ladder;
mod lever;
mod newton;
#[cfg(test)]
mod tests;

pub use ladder::{Broken, Ladder, Rung};
pub use lever::Lever;
pub use newton::{Aim, Effort, Rest, Solver, Stop};
