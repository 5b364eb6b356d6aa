//! The time that the seams of each process take.

use crate::plan::Program;
use geom::order::sort_by;
use spec::SealProcess;

/// A process with the time of its contacts.
#[derive(Clone, Debug)]
pub struct ProcessTime<'a> {
    /// The process.
    pub process: &'a SealProcess,
    /// Time of the iron in contact, in all programs, s.
    pub seconds: f64,
}

/// The processes of `programs` in the order of sealing; empty where every seam is sealed once by the process of `[seal]`.
pub fn process_times(programs: &[Program]) -> Vec<ProcessTime<'_>> {
    let mut times: Vec<ProcessTime<'_>> = Vec::new();
    if programs.iter().all(Program::is_plain) {
        return times;
    }
    for program in programs {
        for (index, paced) in program.processes.iter().enumerate() {
            let contacts = program.seams.iter().filter(|contact| contact.process == index);
            let seconds = contacts.map(|contact| contact.time).sum::<f64>();
            match times.iter_mut().find(|time| time.process.name == paced.process.name) {
                Some(time) => time.seconds += seconds,
                None => times.push(ProcessTime { process: &paced.process, seconds }),
            }
        }
    }
    sort_by(&mut times, |a, b| a.process.seal.temperature.0.total_cmp(&b.process.seal.temperature.0));
    times
}
