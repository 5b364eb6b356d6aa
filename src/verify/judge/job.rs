//! A G-code program against the design: what the iron does, where, how hot, how fast.

use crate::design::{PlacedStar, Side};
use crate::geom::{Bounds, Path, Point, Segment};
use crate::manifest::Manifest;
use crate::verify::judge::expected::Expected;
use crate::verify::judge::{clamp, pace, travel};
use crate::verify::read::gcode::{Dialect, Move, MoveKind, Program, read_program};
use crate::verify::{Finding, FindingCode, Findings, follow};

/// Slack on heights, mm; they are written to at least two decimals and read as written.
const HEIGHT: f64 = 1e-6;

/// What one program should do.
pub(in crate::verify) struct Job<'a> {
    expected: &'a Expected<'a>,
    hot: bool,
    stars: Vec<&'a PlacedStar>,
    /// Where the iron may go.
    area: Bounds,
}

/// One seam as it should be travelled, in the sheet's frame.
struct ExpectedSeam {
    name: String,
    lead_in: Path,
    run: Path,
    lead_out: Path,
    /// Length of the loop without its overlap; of an open seam all of it.
    once: f64,
}

/// What the iron is doing, told from its heights.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Phase {
    /// Away from the fabric.
    Clear,
    /// On the way down or up.
    Ramp,
    /// In contact.
    Contact,
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
        (!stars.is_empty()).then_some(Self { expected, hot, stars, area })
    }

    /// Reads the program and reports everything in it that is not as it should be; its largest deviation, mm.
    pub(in crate::verify) fn check(&self, text: &str, findings: &mut Findings) -> f64 {
        let dialect = Dialect::for_controller(&self.expected.machine.controller);
        let program = read_program(text, dialect);
        self.area(&program, findings);
        travel::check(self.expected.machine.process.travel_speed.0, &program, findings);
        let reach = if self.hot { self.expected.spec.seal.band.0 / 2.0 } else { 0.0 };
        clamp::check(&self.expected.machine.bench.keep_out, reach, &program, findings);
        let deviation = if self.hot {
            self.heat_and_speed(&program, findings);
            pace::check(self.expected, &program, |step| self.phase(step) != Phase::Clear, findings);
            self.rest(&program, findings);
            self.seams(&program, findings)
        } else {
            self.traces(&program, findings)
        };
        findings.extend(program.findings);
        deviation
    }

    fn tolerance(&self) -> f64 {
        self.expected.spec.accuracy.path.0
    }

    fn expected(&self) -> Vec<ExpectedSeam> {
        let ramp = self.expected.machine.process.ramp.0;
        let seams = self.stars.iter().flat_map(|placed| {
            self.expected.design.part(placed).seams.iter().map(move |seam| {
                let place = |path: Path| placed.placement.path(&path);
                let side = if seam.side == Side::Hole { "inner" } else { "outer" };
                ExpectedSeam {
                    name: format!("{side} loop of star {}", placed.index),
                    lead_in: place(seam.lead_in(ramp)),
                    run: place(seam.run()),
                    lead_out: place(seam.lead_out(ramp)),
                    once: seam.center_line.length(),
                }
            })
        });
        seams.collect()
    }

    /// No move leaves the sheet or the machine's reach.
    fn area(&self, program: &Program, findings: &mut Findings) {
        let allowed = self.area.grown(self.tolerance());
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

    fn phase(&self, step: &Move) -> Phase {
        let heights = &self.expected.machine.process.heights;
        let (low, high) = (step.from.z.min(step.to.z), step.from.z.max(step.to.z));
        if low >= heights.travel.0 - HEIGHT {
            Phase::Clear
        } else if high <= heights.contact.0 + HEIGHT {
            Phase::Contact
        } else {
            Phase::Ramp
        }
    }

    /// Below travel height the iron is hot, feeds at seal speed, and moves along the fabric.
    fn heat_and_speed(&self, program: &Program, findings: &mut Findings) {
        let (seal, contact) = (&self.expected.spec.seal, self.expected.machine.process.heights.contact.0);
        for step in program.moves.iter().filter(|step| self.phase(step) != Phase::Clear) {
            match step.heated {
                Some(t) if (t - seal.temperature.0).abs() <= 0.5 => {}
                found => findings.add(
                    FindingCode::ColdSeal,
                    step.line,
                    found.map_or("an iron that nobody heated".to_owned(), |t| format!("{t} C")),
                    seal.temperature.to_string(),
                ),
            }
            if step.kind == MoveKind::Rapid {
                findings.add(
                    FindingCode::RapidInContact,
                    step.line,
                    "G0 below travel height",
                    "G1, G2 or G3 at seal speed",
                );
            }
            if step.path.is_none() {
                findings.add(
                    FindingCode::Plunge,
                    step.line,
                    "a vertical move below travel height",
                    "a ramp along the path",
                );
            }
            if step.from.z.min(step.to.z) < contact - HEIGHT {
                findings.add(
                    FindingCode::TooDeep,
                    step.line,
                    format!("Z{}", step.to.z),
                    format!("Z{contact} or above"),
                );
            }
        }
    }

    /// An iron at rest for longer than it takes to pass a tenth of the band leaves a scar.
    fn rest(&self, program: &Program, findings: &mut Findings) {
        let seal = &self.expected.spec.seal;
        let longest = seal.band.0 / 10.0 / seal.speed.0;
        let low = |z: f64| z < self.expected.machine.process.heights.travel.0 - HEIGHT;
        for dwell in program.dwells.iter().filter(|dwell| dwell.at.is_some_and(|at| low(at.z))) {
            if dwell.seconds > longest {
                findings.add(
                    FindingCode::IronAtRest,
                    dwell.line,
                    format!("{} s", dwell.seconds),
                    format!("at most {longest:.2} s"),
                );
            }
        }
        for pause in program.pauses.iter().filter(|pause| pause.at.is_some_and(|at| low(at.z))) {
            findings.add(
                FindingCode::IronAtRest,
                pause.line,
                "a pause on the fabric",
                "pauses above travel height only",
            );
        }
    }

    /// Every seam is there, in order, from its start to its end, overlap and ramps included.
    fn seams(&self, program: &Program, findings: &mut Findings) -> f64 {
        let expected = self.expected();
        let contacts = contacts(program, |step| self.phase(step));
        let mut deviation = 0.0_f64;
        for (contact, seam) in contacts.iter().zip(&expected) {
            deviation = deviation.max(self.follow(&contact.run, &seam.run, &seam.name, seam.once, findings));
            for (ramp, path, what) in
                [(&contact.down, &seam.lead_in, "way down to"), (&contact.up, &seam.lead_out, "way up from")]
            {
                let name = format!("{what} the {}", seam.name);
                deviation = deviation.max(self.follow(ramp, path, &name, path.length(), findings));
            }
        }
        for seam in expected.iter().skip(contacts.len()) {
            findings.add(
                FindingCode::MissingSeam,
                None,
                format!("no {}", seam.name),
                "every seam of the design",
            );
        }
        for contact in contacts.iter().skip(expected.len()) {
            let line = contact.run.first().map(|step| step.line);
            findings.add(
                FindingCode::ExtraSeam,
                line,
                "a contact that the design does not have",
                "only its seams",
            );
        }
        deviation
    }

    /// One chain of moves against the path it should follow.
    fn follow(&self, steps: &[&Move], path: &Path, name: &str, once: f64, findings: &mut Findings) -> f64 {
        let segments: Vec<Segment> = steps.iter().filter_map(|step| step.path).collect();
        let line = |step: usize| steps.get(step).map(|step| step.line);
        let walked = follow(&segments, path);
        let tolerance = self.tolerance();
        let deviation = walked.largest();
        if deviation.is_nan() || deviation > tolerance {
            findings.add(
                FindingCode::Deviation,
                line(walked.step),
                format!("{deviation:.6} mm off the {name}"),
                format!("{tolerance} mm"),
            );
        }
        // Along the path, rounding at both ends may add up.
        let slack = 2.0 * tolerance;
        if walked.start > slack {
            findings.add(
                FindingCode::LateStart,
                line(0),
                format!("the {name} begins {:.3} mm late", walked.start),
                "its start",
            );
        }
        if walked.end < once - slack {
            let found = format!("the {name} ends {:.3} mm before it is closed", once - walked.end);
            findings.add(
                FindingCode::OpenLoop,
                line(steps.len().saturating_sub(1)),
                found,
                format!("{once:.3} mm"),
            );
        } else if walked.end < path.length() - slack {
            let found = format!("{:.3} mm of overlap on the {name}", walked.end - once);
            findings.add(
                FindingCode::MissingOverlap,
                line(steps.len().saturating_sub(1)),
                found,
                format!("{:.3} mm", path.length() - once),
            );
        }
        if let Some((back, step)) = walked.backwards.filter(|(back, _)| *back > slack) {
            findings.add(
                FindingCode::Backwards,
                line(step),
                format!("{back:.3} mm back along the {name}"),
                "forwards only",
            );
        }
        if let Some((gap, step)) = walked.jump.filter(|(gap, _)| *gap > tolerance) {
            findings.add(
                FindingCode::Jump,
                line(step),
                format!("a gap of {gap:.3} mm in the {name}"),
                "an unbroken path",
            );
        }
        deviation
    }

    /// A trace stays at travel height, cold, and shows the frame and every seam.
    fn traces(&self, program: &Program, findings: &mut Findings) -> f64 {
        for step in program.moves.iter().filter(|step| self.phase(step) != Phase::Clear) {
            findings.add(
                FindingCode::LowTrace,
                step.line,
                format!("Z{}", step.to.z),
                "travel height or above",
            );
        }
        if let Some(pause) = program.pauses.first() {
            findings.add(
                FindingCode::HotTrace,
                pause.line,
                "a pause as for heating",
                "a trace runs unheated and through",
            );
        }
        let feeds: Vec<Vec<&Move>> = program
            .moves
            .chunk_by(|a, b| a.kind == b.kind)
            .filter(|chunk| chunk[0].kind == MoveKind::Feed)
            .map(|chunk| chunk.iter().collect())
            .collect();
        // The first is the frame, which is checked by the work area alone.
        let runs = feeds.get(1..).unwrap_or_default();
        let expected = self.expected();
        let mut deviation = 0.0_f64;
        for (run, seam) in runs.iter().zip(&expected) {
            deviation = deviation.max(self.follow(run, &seam.run, &seam.name, seam.once, findings));
        }
        if runs.len() != expected.len() {
            findings.add(
                FindingCode::MissingSeam,
                None,
                format!("{} paths", runs.len()),
                format!("{} paths", expected.len()),
            );
        }
        deviation
    }
}

/// One contact with the fabric: the way down, the run, the way up.
#[derive(Default)]
struct Contact<'a> {
    down: Vec<&'a Move>,
    run: Vec<&'a Move>,
    up: Vec<&'a Move>,
}

/// Splits a program into its contacts.
fn contacts(program: &Program, phase: impl Fn(&Move) -> Phase) -> Vec<Contact<'_>> {
    let mut out: Vec<Contact<'_>> = Vec::new();
    let mut clear = true;
    for step in &program.moves {
        let now = phase(step);
        if now == Phase::Clear {
            clear = true;
            continue;
        }
        if clear {
            out.push(Contact::default());
            clear = false;
        }
        let Some(contact) = out.last_mut() else { continue };
        match now {
            Phase::Contact => contact.run.push(step),
            _ if contact.run.is_empty() => contact.down.push(step),
            _ => contact.up.push(step),
        }
    }
    out
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
