//! The laser of a program: on along its seams at the height of its focus, with the planned power, and off everywhere else.
//!
//! In laser mode GRBL (doc/markdown/laser_mode.md) turns the beam off in G0, and with M4 at rest. A program must not rely on that: where
//! it travels, waits or ends, it has switched the beam off itself, so that a controller without laser mode does not burn either.

use crate::verify::judge::rules::{ContactCount, ContactRule, IronRules, Phase};
use crate::verify::judge::{HEIGHT, Judge};
use crate::verify::read::gcode::{Beam, BeamMode, Event, Line, Move, MoveKind};
use crate::verify::{FindingCode, Findings};
use spec::LaserDrive;

/// Largest difference of S words that are the same: a program writes thousandths.
const SAME: f64 = 2e-3;

/// Reports every place of a sealing program where the beam is on and must not be, or has another power than planned.
pub(super) struct BeamJudge<'a> {
    laser: LaserDrive,
    rules: &'a IronRules<'a>,
    count: ContactCount,
    /// The laser as the program has set it.
    beam: Beam,
    /// The line that set it last.
    line_of_beam: usize,
    /// Whether M3 was reported.
    has_constant: bool,
}

impl<'a> BeamJudge<'a> {
    /// The judge of a program for `laser` that is led by `rules`.
    pub(super) fn new(laser: LaserDrive, rules: &'a IronRules<'a>) -> Self {
        Self {
            laser,
            rules,
            count: ContactCount::default(),
            beam: Beam::default(),
            line_of_beam: 1,
            has_constant: false,
        }
    }

    /// Follows a command to the laser; `moves`: its line moves along a path, too.
    fn set(&mut self, beam: Beam, moves: bool, line: usize, findings: &mut Findings) {
        (self.beam, self.line_of_beam) = (beam, line);
        let full = self.laser.full_power;
        if beam.word > full + SAME {
            let fault = format!("S{}, above full power", beam.word);
            findings.add_at(FindingCode::WrongPower, line, fault, format!("at most S{full}"));
        }
        if beam.mode == BeamMode::Constant && !std::mem::replace(&mut self.has_constant, true) {
            let fault = "M3, which keeps the power where the head brakes and rests";
            findings.add_at(
                FindingCode::BeamConstant,
                line,
                fault,
                "M4, with a power that follows the speed",
            );
        }
        if beam.shines() > 0.0 && !moves {
            let fault = format!("S{} without a motion", beam.shines());
            findings.add_at(
                FindingCode::BeamAtRest,
                line,
                fault,
                "a power on a line that moves along a seam",
            );
        }
    }

    /// Reports the beam, if it is on, in a line where `place` says what the head does.
    fn must_be_off(&self, code: FindingCode, line: usize, place: &str, findings: &mut Findings) {
        let word = self.beam.shines();
        if word > 0.0 {
            findings.add_at(code, line, format!("the laser is on, S{word}, {place}"), "S0 or M5 before it");
        }
    }

    /// A move from a known position.
    fn go(&mut self, step: &Move, findings: &mut Findings) {
        let (phase, ContactRule { seal, height, .. }) = self.rules.follow(&mut self.count, step);
        if step.kind == MoveKind::Rapid {
            return self.must_be_off(FindingCode::BeamInTravel, step.line, "in a G0", findings);
        }
        match phase {
            Phase::Clear => {
                self.must_be_off(FindingCode::BeamInTravel, step.line, "at travel height", findings);
            }
            Phase::Down | Phase::Up => {
                let place = format!("at Z{:.3} to Z{:.3}", step.from.z, step.to.z);
                self.must_be_off(FindingCode::BeamOffFocus, step.line, &place, findings);
            }
            Phase::Contact => {
                let (word, planned) =
                    (self.beam.shines(), self.laser.word(seal.power.map_or(0.0, |power| power.0)));
                if (word - planned).abs() > SAME {
                    let fault = if word > 0.0 { format!("S{word}") } else { "no power".to_owned() };
                    findings.add_at(FindingCode::WrongPower, step.line, fault, format!("S{planned}"));
                }
                if step.from.z.min(step.to.z) < height - HEIGHT {
                    self.must_be_off(FindingCode::BeamOffFocus, step.line, "below its focus", findings);
                }
            }
        }
    }
}

impl Judge for BeamJudge<'_> {
    fn line(&mut self, line: &Line<'_>, findings: &mut Findings) {
        for event in line.events {
            match event {
                Event::Beam(beam) => self.set(*beam, line.is_motion(), line.number, findings),
                Event::Move(step) => self.go(step, findings),
                Event::Blind(step) => {
                    self.must_be_off(
                        FindingCode::BeamInTravel,
                        step.line,
                        "before its place is known",
                        findings,
                    );
                }
                Event::Dwell(dwell) => {
                    self.must_be_off(FindingCode::BeamAtRest, dwell.line, "in a wait", findings);
                }
                Event::Pause(pause) if self.beam.mode != BeamMode::Off => {
                    let fault = "a pause while the laser is armed";
                    findings.add_at(FindingCode::BeamAtRest, pause.line, fault, "M5 before it");
                }
                Event::End(end) if self.beam.mode != BeamMode::Off => {
                    let fault =
                        format!("the program ends, and line {} left the laser armed", self.line_of_beam);
                    findings.add_at(FindingCode::BeamAtEnd, *end, fault, "M5 before the end");
                }
                _ => {}
            }
        }
    }
}

/// Reports a trace or a feed check that arms a laser: it shows the way without a beam.
pub(super) struct NoBeam;

impl Judge for NoBeam {
    fn line(&mut self, line: &Line<'_>, findings: &mut Findings) {
        if line.events.iter().any(|event| matches!(event, Event::Beam(beam) if beam.mode != BeamMode::Off)) {
            let fault = "a trace that arms the laser";
            findings.add_at(
                FindingCode::HotTrace,
                line.number,
                fault,
                "M5 alone, before the first motion and after the last",
            );
        }
    }
}
