//! Whole files and whole directories against the design.

mod assembly;
pub(in crate::verify) mod bytes;
mod drawings;
mod figures;
mod layers;
mod names;
pub(in crate::verify) mod package;
pub(in crate::verify) mod proof;
mod solid;
mod welded;
