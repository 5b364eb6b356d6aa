//! A G-code program against the design: what the iron does, where, how hot, how fast.

use crate::design::PlacedStar;
use crate::geom::{Bounds, Point};
use crate::manifest::Manifest;
use crate::verify::judge::expected::Expected;
use crate::verify::judge::facts::Facts;
use crate::verify::judge::rules::IronRules;
use crate::verify::judge::script::Script;
use crate::verify::judge::seams::Seams;
use crate::verify::judge::{clamp, comments, height, iron};
use crate::verify::read::gcode::{Dialect, Program, read_program};
use crate::verify::{Finding, FindingCode, Findings};

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

/// The manifest's seam lengths and times against the design's.
pub(in crate::verify) fn manifest_figures(expected: &Expected<'_>, manifest: &Manifest) -> Vec<Finding> {
    let mut findings = Vec::new();
    let wrong = |found: String, allowed: String| {
        Finding::new(FindingCode::Manifest, None, found, allowed).in_file(crate::manifest::MANIFEST)
    };
    for placed in &expected.design.stars {
        let seam_mm: f64 = expected.design.part(placed).seams.iter().map(|seam| seam.run().length()).sum();
        match manifest.stars.iter().find(|star| star.index == placed.index) {
            Some(star) if (star.seam_mm - seam_mm).abs() <= 0.01 && star.sheet == placed.sheet => {
                let clear = expected.design.part(placed).clear_radius();
                if (star.clear_radius_mm - clear).abs() > 0.001 {
                    let found = format!("star {}: a clear radius of {} mm", star.index, star.clear_radius_mm);
                    findings.push(wrong(found, format!("{clear:.3} mm")));
                }
            }
            Some(star) => findings.push(wrong(
                format!("star {}: {} mm of seam on sheet {}", star.index, star.seam_mm, star.sheet),
                format!("{seam_mm:.3} mm on sheet {}", placed.sheet),
            )),
            None => findings
                .push(wrong(format!("no star {}", placed.index), "every star of the design".to_owned())),
        }
    }
    let frame = &expected.design.frame;
    let posts: usize = manifest.posts.iter().map(|posts| posts.count).sum();
    let lengths = manifest.posts.iter().map(|posts| (posts.length_mm - frame.post_length).abs());
    if posts != frame.posts.len() || lengths.fold(0.0, f64::max) > 0.001 {
        let allowed = format!("{} of {:.3} mm", frame.posts.len(), frame.post_length);
        findings.push(wrong(format!("posts {:?}", manifest.posts), allowed));
    }
    let plates: usize = manifest.plates.iter().map(|plates| plates.plates.len()).sum();
    if plates != expected.design.stars.len() + 1 {
        findings.push(wrong(format!("{plates} plates"), format!("{}", expected.design.stars.len() + 1)));
    }
    findings
}
