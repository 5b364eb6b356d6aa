//! Seams of several strengths: whether the weak one opens first.

use crate::pipeline::code::PrecautionCode;
use crate::pipeline::{Forecast, Precaution};
use spec::SealProcess;
use spec::units::LineForce;

/// What the words of a process that is to open first begin with.
const WEAK: [&str; 3] = ["weak", "tear", "peel"];

/// The notes on the processes of the seams of `forecast`: which is the weakest, and which should be but is not.
pub(super) fn weak_processes(forecast: &Forecast) -> Vec<Precaution> {
    let spec = &forecast.spec;
    let processes = used_processes(forecast);
    if processes.len() < 2 {
        return Vec::new();
    }
    let mut texts: Vec<String> = Vec::new();
    for weak in processes.iter().filter(|process| is_weak(process)) {
        texts.extend(stronger_than_others(weak, &processes));
    }
    let first = forecast.drawn.as_ref().and_then(|drawn| drawn.prediction.bursts_first.as_ref());
    match (weakest(&processes), first) {
        (Some((weakest, strength)), Some(first)) if first.process != weakest.name => texts.push(format!(
            "process {} is the weakest, {strength}, and the seam {} of process {} opens before its seams: the pull there is larger",
            weakest.name, first.seam, first.process
        )),
        (Some((weakest, strength)), None) => texts.push(format!(
            "process {} is the weakest, {strength}: its seams open first unless others are pulled harder; {}",
            weakest.name,
            if spec.has_stars() { "`check` lists the pull on both loops" } else { forecast::drawn::HOW }
        )),
        _ => {}
    }
    texts.into_iter().map(|text| Precaution { code: PrecautionCode::WeakProcess, text }).collect()
}

/// The processes by which seams of the design are sealed, each once.
fn used_processes(forecast: &Forecast) -> Vec<SealProcess> {
    let mut processes: Vec<SealProcess> = Vec::new();
    for program in &forecast.programs {
        for paced in &program.processes {
            if processes.iter().all(|process| process.name != paced.process.name) {
                processes.push(paced.process.clone());
            }
        }
    }
    processes
}

fn is_weak(process: &SealProcess) -> bool {
    WEAK.iter().any(|word| process.name.starts_with(word))
}

/// The process with the least strength, if all strengths are known and differ.
fn weakest(processes: &[SealProcess]) -> Option<(&SealProcess, LineForce)> {
    let strengths: Vec<(&SealProcess, LineForce)> =
        processes.iter().map(|process| Some((process, process.strength?))).collect::<Option<_>>()?;
    let least = strengths.iter().copied().min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    strengths.iter().any(|(_, strength)| *strength != least.1).then_some(least)
}

/// The warning that a process whose name says that it is weak is as strong as another.
fn stronger_than_others(weak: &SealProcess, processes: &[SealProcess]) -> Option<String> {
    let own = weak.strength?;
    let other = processes.iter().find(|other| {
        other.name != weak.name && other.strength.is_some_and(|strength| strength.0 <= own.0)
    })?;
    let strength = other.strength?;
    Some(format!(
        "process {} has a strength of {own}, and process {} has {strength}: its seams are not the first to open; \
         write a lower `strength` in [process.{}] if a peel test shows one",
        weak.name, other.name, weak.name
    ))
}
