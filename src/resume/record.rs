//! The record: the machine and the seal as stated in the header of a program.

use crate::emit::Facts;
use crate::resume::ResumeFault;
use crate::resume::header::{Header, StatedProcess};
use program::plan::Pace;
use proof::verify::IronRules;
use proof::verify::gcode;
use proof::verify::gcode::Comment;
use spec::units::Length;
use spec::{Comments, Controller, Motion, Process, Seal, TOXIC, ZLimits};
use std::collections::HashMap;

/// The statements of a file's header.
#[derive(Clone, Debug)]
pub(super) struct Record {
    pub(super) controller: Controller,
    pub(super) process: Process,
    pub(super) seal: Seal,
    pub(super) path: Length,
    /// The process of every seam that names no other, and the processes by name.
    default: StatedProcess,
    processes: Vec<StatedProcess>,
    /// The place of its process for the number of a contact.
    sealing: HashMap<u64, usize>,
    /// The motor values on which the timing of its strokes depends.
    motion: Motion,
    /// The acceleration with which a laser brakes at bends, mm/s^2.
    bend_acceleration: Option<f64>,
    /// Whether the file has all values that its strokes' timing depends on; older files do not.
    is_timed: bool,
}

impl Record {
    /// Reads the header.
    pub(super) fn read(text: &str) -> Result<Self, ResumeFault> {
        let comments = if text.starts_with('(') { Comments::Parentheses } else { Comments::Semicolon };
        let header = Header::read(text, comments);
        match header.word("program", "purpose") {
            Some("seal") => {}
            Some("trace") => return Err(ResumeFault::Trace),
            Some("cut") => return Err(ResumeFault::Cut),
            _ => return Err(ResumeFault::NotOurs("program: purpose=seal")),
        }
        let motion = Motion { z: header.z_limits(), ..header.motion()? };
        let pace = header.pace(&motion)?;
        let process = header.process()?;
        let (seal, path) = (header.seal()?, header.length("path", "tolerance_mm")?);
        let positive =
            seal.speed.0 > 0.0 && process.travel_speed.0 > 0.0 && path.0 > 0.0 && process.ramp.0 > 0.0;
        if !positive {
            return Err(ResumeFault::NotOurs("seal"));
        }
        if seal.temperature >= TOXIC {
            return Err(ResumeFault::TooHot(seal.temperature));
        }
        let default = StatedProcess { name: String::new(), seal: seal.clone(), pace };
        let processes = header.processes(&default)?;
        let sealing = header.sealing(&processes)?;
        if let Some(hot) = processes.iter().find(|process| process.seal.temperature >= TOXIC) {
            return Err(ResumeFault::TooHot(hot.seal.temperature));
        }
        // Strokes of several processes have feeds of their own, which follow from the steps.
        let chop_feed = motion.chop_feed.filter(|_| processes.is_empty() || motion.steps_per_mm.is_none());
        let motion = Motion { chop_feed, ..motion };
        let is_timed = header.find("chop").is_err() || header.find("chop-start").is_ok();
        let controller = header.controller(comments, pace)?;
        let bend_acceleration = header.written_number("laser-ramps", "acceleration_mm_s2").ok();
        let bend_acceleration = bend_acceleration.filter(|_| controller.laser.is_some());
        Ok(Self {
            controller,
            process,
            seal,
            path,
            default,
            processes,
            sealing,
            motion,
            bend_acceleration,
            is_timed,
        })
    }

    /// The dialect of the file.
    pub(super) fn dialect(&self) -> gcode::Dialect {
        gcode::Dialect::for_controller(&self.controller)
    }

    /// The processes of its contacts.
    pub(super) fn all_processes(&self) -> impl Iterator<Item = &StatedProcess> {
        let default = self.processes.is_empty().then_some(&self.default);
        self.processes.iter().chain(default)
    }

    /// The process of the contact that the comment `title` announces, or of one without a title.
    pub(super) fn process_of(&self, title: Option<&Comment>) -> &StatedProcess {
        let number = title.and_then(|title| title.number("seam"));
        let place = number.and_then(|number| self.sealing.get(&number.to_bits()));
        place.and_then(|place| self.processes.get(*place)).unwrap_or(&self.default)
    }

    /// The rules that the file states, with its motor values, for the contacts of the program `text`.
    pub(super) fn rules(&self, text: &str) -> IronRules<'_> {
        let Self { process, controller, motion, .. } = self;
        let titles = text.lines().filter_map(|line| {
            let rest = line.strip_prefix([';', '('])?.trim_start();
            rest.starts_with("seam:").then(|| Comment::new(0, rest.trim_end_matches(')').to_owned()))
        });
        let contacts = if self.processes.is_empty() {
            Vec::new()
        } else {
            titles.map(|title| self.process_of(Some(&title)).rule(process)).collect()
        };
        IronRules {
            process,
            motion,
            dwell_step: controller.dwell.step.0,
            chops: self.all_processes().any(|stated| matches!(stated.pace, Pace::Chopped(_))),
            timed: self.is_timed,
            contacts,
            default: self.default.rule(process),
        }
    }

    /// The limits of Z.
    pub(super) fn z_limits(&self) -> ZLimits {
        self.motion.z
    }

    /// The acceleration that the file states, mm/s^2: of its strokes, or of a laser; `None` where it states none.
    pub(super) fn stated_acceleration(&self) -> Option<f64> {
        let of_strokes = self.all_processes().find_map(|stated| match stated.pace {
            Pace::Steady => None,
            Pace::Chopped(chop) => Some(chop.acceleration),
        });
        of_strokes.or(self.bend_acceleration)
    }

    /// The acceleration with which a laser brakes at bends, mm/s^2; `None` of an iron, which is too slow to brake.
    pub(super) fn bend_acceleration(&self) -> Option<f64> {
        self.bend_acceleration
    }

    /// Whether the controller joins short moves to the next one, so that a seam can continue only at a stop.
    pub(super) fn joins_moves(&self) -> bool {
        self.all_processes().any(|stated| matches!(stated.pace, Pace::Chopped(chop) if chop.least > 0.0))
    }

    /// The values for writing further steps of `stated`.
    pub(super) fn facts<'r>(&'r self, stated: &'r StatedProcess) -> Facts<'r> {
        let Self { controller, process, path, .. } = self;
        let seal = &stated.seal;
        Facts { name: "", seal, path: *path, controller, process }
    }

    /// A comment in the file's syntax.
    pub(super) fn comment(&self, text: &str) -> String {
        match self.controller.comments {
            Comments::Semicolon => format!("; {text}"),
            Comments::Parentheses => format!("({text})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use design::Design;
    use program::plan::seal_programs;
    use spec::{Machine, Source};

    /// A value of the seal that programs do not state would be lost when a job is resumed. The design sets every key to another value
    /// than the default.
    #[test]
    fn a_program_states_every_value_of_its_seal() {
        let text = include_str!("../../tests/golden/every-feature.toml");
        let spec = spec::read(&Source::new("spec", text)).expect("valid").spec;
        let machine = Machine::builtin(&spec.machine.profile).expect("built in");
        let design = Design::new(&spec, &machine).expect("a gripper");
        let programs = seal_programs(&spec, &machine, &design);
        let record = Record::read(&crate::emit::gcode(&spec, &machine, &programs[0])).expect("a program");
        // Allowances are cut, not sealed; every contact has its own height, and waits, passes and lines are steps of the program. Every other
        // key is compared.
        let Seal { temperature, speed, band, overlap, allowance: _, hole_allowance: _, .. } = spec.seal;
        let stated = record.seal;
        assert_eq!(
            (stated.temperature, stated.speed, stated.band, stated.overlap),
            (temperature, speed, band, overlap)
        );
    }
}
