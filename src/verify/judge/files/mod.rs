//! Whole files and whole directories against the design.

mod assembly;
pub(in crate::verify) mod bytes;
pub(in crate::verify) mod drawings;
mod figures;
pub(in crate::verify) mod layers;
mod names;
mod paper;
pub(in crate::verify) mod proof;
mod solid;
