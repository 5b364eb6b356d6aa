//! A G-code program against the design: what the iron does, where, how hot, how fast.

use crate::design::PlacedStar;
use crate::geom::{Bounds, Point};
use crate::verify::finding::quote;
use crate::verify::judge::expected::Expected;
use crate::verify::judge::facts::Facts;
use crate::verify::judge::rules::IronRules;
use crate::verify::judge::script::Script;
use crate::verify::judge::seams::Seams;
use crate::verify::judge::{clamp, comments, height, iron};
use crate::verify::read::gcode::{Dialect, Program, read_program};
use crate::verify::{FindingCode, Findings};

/// What one program should do.
pub(in crate::verify) struct Job<'a> {
    expected: &'a Expected<'a>,
    hot: bool,
    sheet: usize,
    stars: Vec<&'a PlacedStar>,
    /// Where the iron may go.
    area: Bounds,
}

impl<'a> Job<'a> {
    /// The job of the program for `star`, or for all stars of `sheet`; `None` if the design has no such part.
    pub(in crate::verify) fn new(
        expected: &'a Expected<'a>,
        hot: bool,
        sheet: usize,
        star: Option<usize>,
    ) -> Option<Self> {
        let layout = expected.design.sheets.iter().find(|layout| layout.index == sheet)?;
        let stars: Vec<_> = expected
            .design
            .nearest_first(sheet)
            .into_iter()
            .filter(|placed| star.is_none_or(|index| placed.index == index))
            .collect();
        let corner = Point::new(layout.width, layout.height);
        let reach = expected
            .machine
            .bench
            .work_area
            .map_or(corner, |(x, y)| Point::new(corner.x.min(x.0), corner.y.min(y.0)));
        let area = Bounds { min: Point::ORIGIN, max: reach };
        (!stars.is_empty()).then_some(Self { expected, hot, sheet, stars, area })
    }

    /// Reads the program and reports everything in it that is not as it should be; its largest deviation, mm.
    pub(in crate::verify) fn check(&self, text: &str, findings: &mut Findings) -> f64 {
        let Expected { spec, machine, design, .. } = *self.expected;
        let program = read_program(text, Dialect::for_controller(&machine.controller));
        let heat = self.hot.then_some(spec.seal.temperature);
        Script { machine, heat, text, program: &program }.check(findings);
        first_words(text, findings);
        self.area(&program, findings);
        let reach = if self.hot { spec.seal.band.0 / 2.0 } else { 0.0 };
        clamp::check(&machine.bench.keep_out, reach, &program, findings);
        let rules = IronRules::new(spec, machine);
        if self.hot {
            iron::check(&rules, &program, findings);
        } else {
            iron::check_cold(&rules, &program, findings);
        }
        self.comments(&rules, text, &program, findings);
        let seams = Seams { design, stars: &self.stars, rules, tolerance: spec.accuracy.path.0 };
        let deviation =
            if self.hot { seams.sealed(&program, findings) } else { seams.traced(&program, findings) };
        findings.extend(program.findings);
        deviation
    }

    /// Every comment is one that the design asks for.
    fn comments(&self, rules: &IronRules<'_>, text: &str, program: &Program, findings: &mut Findings) {
        let Self { expected, hot, sheet, ref stars, .. } = *self;
        let clock = comments::Clock::new(rules, program);
        let (chopped, seconds) = (!program.dwells.is_empty(), clock.seconds);
        let facts = Facts { expected, hot, sheet, stars, chopped, seconds };
        comments::check(&facts, &clock, text, program, findings);
    }

    /// No move leaves the sheet or the machine's reach.
    fn area(&self, program: &Program, findings: &mut Findings) {
        let allowed = self.area.grown(self.expected.spec.accuracy.path.0);
        height::check(&self.expected.machine.process.heights, &allowed, program, findings);
        for step in &program.moves {
            let bounds = step.path.map_or(Bounds::EMPTY, |path| path.bounds());
            if !(allowed.contains(bounds.min) && allowed.contains(bounds.max)) && step.path.is_some() {
                findings.add(
                    FindingCode::OutsideWorkArea,
                    step.line,
                    format!(
                        "a move from ({:.3}, {:.3}) to ({:.3}, {:.3})",
                        bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y
                    ),
                    format!("(0, 0) to ({:.3}, {:.3})", self.area.max.x, self.area.max.y),
                );
            }
        }
    }
}

/// Every line says what it does: Klipper and Marlin do not go on moving by the word of the line before.
fn first_words(text: &str, findings: &mut Findings) {
    let silent = |(_, text): &(usize, &str)| text.trim_start().starts_with(['X', 'Y', 'Z', 'I', 'J', 'F']);
    if let Some((line, text)) = (1..).zip(text.lines()).find(silent) {
        findings.add(FindingCode::UnusedWord, line, quote(text), "G0, G1, G2 or G3 first");
    }
}
