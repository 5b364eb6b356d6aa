//! What a star does when it is inflated: how far it closes, how hard it grips, when its seal fails.
pub mod bvp;
pub mod fault;
pub mod fit;
pub mod hinge;
pub mod ring;
#[cfg(test)]
mod laws;
