//! The state of a printer before its first contact: axes with a zero, parts that are warm, and the factor of its feeds.

use crate::verify::judge::{HEIGHT, Judge};
use crate::verify::read::gcode::{BlindMove, Event, Line, Move};
use crate::verify::{FindingCode, Findings};
use spec::{Controller, Service, WARMEST, WarmPart, Warming};

/// Reports moves of axes that are not homed in a program that homes, parts that are too warm, still warming or left warm, feeds that are
/// multiplied, and heights that the controller clamps.
pub(super) struct ReadyJudge {
    /// Height of the release layer in the controller's coordinates, mm, where the controller clamps Z to 0 unless a line frees it.
    clamped_from: Option<f64>,
    homed: [bool; 3],
    /// Whether the program homes any axis.
    homes: bool,
    /// Whether each axis has moved without a zero.
    strayed: [bool; 3],
    has_moved: bool,
    is_free: bool,
    warm: [Option<WarmedPart>; 2],
}

/// A part that is warm, or on its way.
#[derive(Clone, Copy)]
struct WarmedPart {
    line: usize,
    warming: Warming,
}

impl ReadyJudge {
    /// The judge of programs for `controller`; `None` if it reads no service line, since all that is judged begins with one.
    pub(super) fn for_controller(controller: &Controller) -> Option<Box<dyn Judge>> {
        let dialect = controller.dialect;
        let judge = Self::new(controller.place.surface.0, Service::can_free_endstops(dialect));
        Service::is_read_by(dialect).then(|| -> Box<dyn Judge> { Box::new(judge) })
    }

    /// The judge of a program with the release layer at the height `surface`, mm, of a controller that clamps Z to 0 if `clamps`.
    fn new(surface: f64, clamps: bool) -> Self {
        Self {
            clamped_from: clamps.then_some(surface),
            homed: [false; 3],
            homes: false,
            strayed: [false; 3],
            has_moved: false,
            is_free: false,
            warm: [None; 2],
        }
    }

    /// Follows a service line.
    fn serve(&mut self, service: Service, line: usize, findings: &mut Findings) {
        match service {
            Service::Home(axes) => {
                self.homes = true;
                self.homed = std::array::from_fn(|i| self.homed[i] || axes[i]);
                self.is_free = false;
                if self.has_moved {
                    let fault = "an axis goes to its switch after the first motion";
                    findings.add_at(FindingCode::UnhomedAxis, line, fault, "homing before the first motion");
                }
            }
            Service::Level if self.homed != [true; 3] => {
                let fault = "levelling before X, Y and Z are homed";
                findings.add_at(FindingCode::UnhomedAxis, line, fault, "G28 before it");
            }
            Service::Warm(warming) => self.warm(warming, line, findings),
            Service::FeedOverride(percent) if percent != 100.0 => {
                let fault = format!("every feed is multiplied by {percent} %");
                findings.add_at(FindingCode::FeedOverride, line, fault, "M220 S100");
            }
            Service::EndstopsOff => self.is_free = true,
            Service::Level | Service::FeedOverride(_) | Service::FanOff | Service::MotorsOn => {}
        }
    }

    /// Follows a temperature of the bed or the chamber.
    fn warm(&mut self, warming: Warming, line: usize, findings: &mut Findings) {
        if warming.celsius > WARMEST.0 {
            let fault = format!("the {} at {} C", warming.part.name(), warming.celsius);
            findings.add_at(FindingCode::HotBed, line, fault, format!("at most {} C", WARMEST.0));
        }
        let place = match warming.part {
            WarmPart::Bed => 0,
            WarmPart::Chamber => 1,
        };
        self.warm[place] = (warming.celsius > 0.0).then_some(WarmedPart { line, warming });
    }

    /// Follows a motion of some axes in `line`, down to the height `z`.
    fn go(&mut self, axes: [bool; 3], z: Option<f64>, line: usize, findings: &mut Findings) {
        if !std::mem::replace(&mut self.has_moved, true) {
            for part in self.warm.into_iter().flatten().filter(|part| !part.warming.waits) {
                let fault = format!("the first motion while the {} warms up", part.warming.part.name());
                findings.add_at(FindingCode::HotBed, line, fault, "M190 or M191, which wait, before it");
            }
        }
        for (i, axis) in ["X", "Y", "Z"].into_iter().enumerate() {
            if self.homes && axes[i] && !self.homed[i] && !std::mem::replace(&mut self.strayed[i], true) {
                let fault = format!("a move of {axis}, which is not homed");
                findings.add_at(FindingCode::UnhomedAxis, line, fault, "G28 for all axes that move");
            }
        }
        let lowest = self.clamped_from.filter(|_| self.homes && !self.is_free).zip(z).map(|(s, z)| s + z);
        if let Some(z) = lowest.filter(|z| *z < -HEIGHT) {
            self.clamped_from = None;
            let fault = format!("Z{z:.3}, which the controller clamps to 0");
            findings.add_at(FindingCode::TooDeep, line, fault, "M211 S0 or M564 S0 before it");
        }
    }
}

impl Judge for ReadyJudge {
    fn line(&mut self, line: &Line<'_>, findings: &mut Findings) {
        for event in line.events {
            if let Event::Service(call) = event {
                self.serve(call.service, call.line, findings);
            }
        }
    }

    fn step(&mut self, step: &Move, findings: &mut Findings) {
        let moves = [step.from.x != step.to.x, step.from.y != step.to.y, step.from.z != step.to.z];
        self.go(moves, Some(step.to.z), step.line, findings);
    }

    fn blind(&mut self, step: &BlindMove, findings: &mut Findings) {
        self.go(step.named, step.to[2], step.line, findings);
    }

    fn end(&mut self, findings: &mut Findings) {
        for part in self.warm.into_iter().flatten() {
            let (name, celsius) = (part.warming.part.name(), part.warming.celsius);
            let fault = format!("the {name} stays at {celsius} C after the end");
            findings.add_at(FindingCode::StrayHeat, part.line, fault, "M140 S0 or M141 S0 at the end");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::judge::judged;
    use crate::verify::read::gcode::Dialect;

    /// Code and line, from 1, of each finding of the judge in the lines of `text` for Marlin.
    fn findings_of(text: &str, surface: f64) -> Vec<(&'static str, usize)> {
        let mut findings = Findings::default();
        let judge = Box::new(ReadyJudge::new(surface, true));
        let dialect = Dialect::new(spec::Dialect::Marlin);
        let _ = judged(text.split_inclusive('\n'), dialect, vec![judge], &mut findings);
        let codes = ["unhomed-axis", "hot-bed", "feed-override", "stray-heat", "too-deep"];
        let of_judge = findings.into_vec().into_iter().filter(|finding| codes.contains(&finding.code));
        of_judge.map(|finding| (finding.code, finding.line.expect("a line"))).collect()
    }

    #[test]
    fn a_machine_is_ready_before_it_moves() {
        let way = "G90\nG0 Z30 F600\nG0 X0 Y0 F600\nG1 X9 Y0 Z-0.3 F600\nM84\n";
        for (head, surface, expected) in [
            ("", 0.0, vec![]),
            ("G28\nM211 S0\n", 0.0, vec![]),
            ("G28\n", 0.3, vec![]),
            ("G28\n", 0.2, vec![("too-deep", 5)]),
            ("M211 S0\nG28\n", 0.0, vec![("too-deep", 6)]),
            ("G28 X Y\nM211 S0\n", 0.0, vec![("unhomed-axis", 4)]),
            ("G28 Z\nM211 S0\n", 0.0, vec![("unhomed-axis", 5), ("unhomed-axis", 5)]),
            ("G29\n", 0.0, vec![("unhomed-axis", 1)]),
            ("M190 S61\nM140 S0\n", 0.0, vec![("hot-bed", 1)]),
            ("M140 S50\n", 0.0, vec![("hot-bed", 3), ("stray-heat", 1)]),
            ("M190 S50\n", 0.0, vec![("stray-heat", 1)]),
            ("M220 S50\n", 0.0, vec![("feed-override", 1)]),
            ("M220 S100\n", 0.0, vec![]),
        ] {
            assert_eq!(findings_of(&format!("{head}{way}"), surface), expected, "{head}");
        }
        let homed_late = "G90\nG0 Z30 F600\nG28\nG0 X0 Y0 F600\nM84\n";
        assert_eq!(findings_of(homed_late, 1.0), [("unhomed-axis", 3)]);
    }
}
