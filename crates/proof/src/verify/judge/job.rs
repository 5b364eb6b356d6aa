//! A G-code program against the design: place, temperature and speed of the iron.

use crate::verify::finding::quote;
use crate::verify::judge::beam::{BeamJudge, NoBeam};
use crate::verify::judge::blade::BladeJudge;
use crate::verify::judge::clamp::ClampJudge;
use crate::verify::judge::comments::CommentJudge;
use crate::verify::judge::height::HeightJudge;
use crate::verify::judge::iron::{Cold, TravelFeed, iron};
use crate::verify::judge::ready::ReadyJudge;
use crate::verify::judge::rules::IronRules;
use crate::verify::judge::script::{Body, ScriptJudge};
use crate::verify::judge::seams::{Sealed, Traced, legs};
use crate::verify::judge::stops::StopJudge;
use crate::verify::judge::task::{ProgramTask, ProgramWork};
use crate::verify::judge::travel_order::TravelOrder;
use crate::verify::judge::{Judge, judged};
use crate::verify::read::gcode::{Dialect, Line, Move};
use crate::verify::{FindingCode, Findings};
use geom::Bounds;

impl ProgramTask<'_> {
    /// The number of pauses: one for each heating by the operator, one wherever a seam asks for it, one for another tool or before a
    /// laser is armed, and one above every mark.
    fn pauses(&self) -> usize {
        let tools = match self.work {
            ProgramWork::Trace => return self.marks.len(),
            ProgramWork::Seal => usize::from(self.arms_laser()),
            ProgramWork::Cut(_) => 1,
        };
        let by_operator = !self.machine.controller.heating.is_by_program();
        let of_stop = |i| {
            let stop = self.job.stop_before(i);
            usize::from(stop.pauses) + usize::from(by_operator && stop.heat.is_some())
        };
        self.marks.len() + tools + (0..self.job.contacts.len()).map(of_stop).sum::<usize>()
    }

    /// Reads the program and reports everything in it that is not as it should be; its largest deviation, mm.
    ///
    /// The program is read once, and every judge sees every line and move: those of any program, those of a hot or a cold tool, and one
    /// that compares the path with the task's.
    pub fn check(&self, text: &str, findings: &mut Findings) -> f64 {
        let Self { spec, machine, work, area, .. } = *self;
        let hot = work != ProgramWork::Trace;
        let (rules, heights) = (IronRules::new(spec, machine, &self.job), &machine.process.heights);
        let tolerance = spec.accuracy.path.0;
        let controller = &machine.controller;
        let heats = if hot && controller.heating.is_by_program() { rules.heats() } else { Vec::new() };
        let allowed = area.outset(tolerance);
        let reach = if hot { spec.seal.band.0 / 2.0 } else { 0.0 };
        let mut judges: Vec<Box<dyn Judge + '_>> = vec![
            Box::new(ScriptJudge::new(machine, self.pauses())),
            Box::new(Body::new(heats, &controller.heating)),
        ];
        judges.extend(ReadyJudge::for_controller(controller));
        judges.push(Box::new(FirstWords));
        judges.push(Box::new(HeightJudge::new(heights, allowed)));
        judges.push(Box::new(Area { reach: area, allowed }));
        judges.push(Box::new(ClampJudge::new(&machine.bench.keep_out, reach)));
        if hot {
            judges.extend(iron(&rules));
        } else {
            judges.push(Box::new(TravelFeed(machine.process.travel_speed)));
            judges.push(Box::new(Cold { rules: &rules, marks: self.marks.len() }));
        }
        judges.extend(controller.laser.map(|laser| -> Box<dyn Judge + '_> {
            if hot { Box::new(BeamJudge::new(laser, &rules)) } else { Box::new(NoBeam) }
        }));
        judges.push(Box::new(CommentJudge::new(self)));
        judges.push(Box::new(StopJudge::new(&self.marks, heights.travel.0, tolerance)));
        judges.push(Box::new(TravelOrder::new(heights, &self.marks, legs(self), work.title(), tolerance)));
        judges.push(match work {
            ProgramWork::Trace => Box::new(Traced::new(self)),
            ProgramWork::Cut(tool) if tool.blade_offset().0 > 0.0 => {
                let starts = self.job.contacts.iter().filter_map(|cut| cut.laid.lead_in.start()).collect();
                Box::new(BladeJudge::new(Sealed::new(self, &rules), &rules, tool.blade_offset().0, starts))
            }
            ProgramWork::Seal | ProgramWork::Cut(_) => Box::new(Sealed::new(self, &rules)),
        });
        judged(text.split_inclusive('\n'), Dialect::for_controller(controller), judges, findings)
    }
}

/// No move leaves the sheet or the machine's reach.
struct Area {
    reach: Bounds,
    /// The work area with room for rounding.
    allowed: Bounds,
}

impl Judge for Area {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        if let Some(Bounds { min, max }) = step.path.map(|path| path.bounds())
            && !(self.allowed.contains(min) && self.allowed.contains(max))
        {
            let fault = format!("a move from ({:.3}, {:.3}) to ({:.3}, {:.3})", min.x, min.y, max.x, max.y);
            let allowed = format!("(0, 0) to ({:.3}, {:.3})", self.reach.max.x, self.reach.max.y);
            findings.add_at(FindingCode::OutsideWorkArea, step.line, fault, allowed);
        }
    }
}

/// Every line says what it does: Klipper and Marlin do not go on moving by the word of the line before. The first that
/// does not is reported.
struct FirstWords;

impl Judge for FirstWords {
    fn line(&mut self, line: &Line<'_>, findings: &mut Findings) {
        let first = line.text.trim_start().bytes().next();
        if matches!(first, Some(b'X' | b'Y' | b'Z' | b'I' | b'J' | b'F')) && findings.is_empty() {
            let fault = quote(line.text.trim());
            findings.add_at(FindingCode::UnusedWord, line.number, fault, "G0, G1, G2 or G3 first");
        }
    }
}
