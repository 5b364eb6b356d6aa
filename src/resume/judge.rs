//! The judge: compares the moves of programs with the comments of the old one, by the verifier's own rules.

use crate::resume::ResumeFault;
use crate::resume::record::Record;
use crate::spec::Heating;
use crate::verify::{Finding, judge_iron};
use inflatable::geom::Bounds;

/// Checks that the old program, which stays within `reach`, moves as its comments state.
///
/// # Errors
/// The first disagreement.
pub(super) fn agrees(record: &Record, text: &str, reach: &Bounds) -> Result<(), ResumeFault> {
    first_fault(record, text, reach).map_or(Ok(()), |finding| Err(ResumeFault::Disagrees(finding)))
}

/// Checks that the new program has no finding, keeps the old one's rules, and stays within its `reach`.
///
/// # Errors
/// The first finding.
pub(super) fn proves(record: &Record, new: &str, reach: &Bounds) -> Result<(), ResumeFault> {
    let reach = reach.grown(record.path.0);
    first_fault(record, new, &reach).map_or(Ok(()), |finding| Err(ResumeFault::Unproven(finding)))
}

fn first_fault(record: &Record, text: &str, reach: &Bounds) -> Option<Finding> {
    let motion = record.motion();
    let hotend = record.controller.heating == Heating::Hotend;
    let lines = text.split_inclusive('\n');
    judge_iron(&record.rules(&motion), reach, hotend, lines, record.dialect()).into_iter().next()
}
