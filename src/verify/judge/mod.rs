//! Judges: what was read against what the design says; whatever differs becomes a finding.

mod clamp;
pub(in crate::verify) mod expected;
pub(in crate::verify) mod files;
mod job;
mod pace;
pub(in crate::verify) mod path;
pub(in crate::verify) mod stroke;
mod travel;
