//! The judge: what the programs do against what the old one's comments say, by the verifier's own rules.

use crate::geom::Bounds;
use crate::resume::ResumeFault;
use crate::resume::record::Record;
use crate::spec::Heating;
use crate::verify::gcode::{Program, read_program};
use crate::verify::{Finding, judge_iron};

/// Whether the old program does what its comments say.
///
/// # Errors
/// The first thing that it does otherwise.
pub(super) fn agrees(record: &Record, text: &str) -> Result<(), ResumeFault> {
    let program = read_program(text, record.dialect());
    match faults(record, text, &program, &reach(&program)).into_iter().next() {
        Some(finding) => Err(ResumeFault::Disagrees(finding)),
        None => Ok(()),
    }
}

/// Whether the new program is without fault, keeps the old one's rules, and stays where that one goes.
///
/// # Errors
/// The first thing that is wrong.
pub(super) fn proves(record: &Record, old: &str, new: &str) -> Result<(), ResumeFault> {
    let area = reach(&read_program(old, record.dialect())).grown(record.path.0);
    let program = read_program(new, record.dialect());
    let own = program.findings.first().cloned();
    match own.or_else(|| faults(record, new, &program, &area).into_iter().next()) {
        Some(finding) => Err(ResumeFault::Unproven(finding)),
        None => Ok(()),
    }
}

fn faults(record: &Record, text: &str, program: &Program, area: &Bounds) -> Vec<Finding> {
    let motion = record.motion();
    let hotend = record.controller.heating == Heating::Hotend;
    judge_iron(&record.rules(&motion), area, hotend, text, program)
}

/// Where a program goes.
fn reach(program: &Program) -> Bounds {
    let paths = program.moves.iter().filter_map(|step| step.path);
    paths.map(|path| path.bounds()).fold(Bounds::EMPTY, Bounds::union)
}
