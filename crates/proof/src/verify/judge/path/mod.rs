//! Distances between paths: in any order (drawings), or in the order of travel (programs).

pub mod compare;
pub(in crate::verify) mod follow;
pub(in crate::verify) mod measure;
mod track;
