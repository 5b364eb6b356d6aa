//! Judges: what was read against what the design says; whatever differs becomes a finding.

mod clamp;
mod comments;
pub(in crate::verify) mod expected;
mod facts;
pub(in crate::verify) mod files;
mod height;
pub(in crate::verify) mod iron;
mod job;
mod pace;
pub(in crate::verify) mod path;
pub(in crate::verify) mod rules;
mod script;
mod seams;
pub(in crate::verify) mod stroke;
mod travel;

/// Slack on heights, mm; they are written to at least two decimals and read as written.
const HEIGHT: f64 = 1e-6;
