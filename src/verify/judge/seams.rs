//! The seams of a program against those of the design: all there, in order, each from its start to its end.

use crate::design::{Design, PlacedStar, Side};
use crate::geom::{Bounds, Line, Path, Point, Segment};
use crate::verify::judge::rules::{IronRules, Phase};
use crate::verify::read::gcode::{Move, MoveKind, Program};
use crate::verify::{FindingCode, Findings, follow};

/// One seam as it should be travelled, in the sheet's frame.
struct ExpectedSeam {
    name: String,
    lead_in: Path,
    run: Path,
    lead_out: Path,
    /// Length of the loop without its overlap; of an open seam all of it.
    once: f64,
}

/// The seams that one program should have.
pub(in crate::verify) struct Seams<'a> {
    pub(in crate::verify) design: &'a Design,
    /// The stars, in the order of sealing.
    pub(in crate::verify) stars: &'a [&'a PlacedStar],
    pub(in crate::verify) rules: IronRules<'a>,
    /// Largest deviation, mm.
    pub(in crate::verify) tolerance: f64,
}

impl Seams<'_> {
    fn expected(&self) -> Vec<ExpectedSeam> {
        let ramp = self.rules.process.ramp.0;
        let seams = self.stars.iter().flat_map(|placed| {
            self.design.part(placed).seams.iter().map(move |seam| {
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

    /// The rectangle around the cut, and around everything that the iron does to the fabric.
    fn frame(&self) -> Path {
        let parts = self.stars.iter().map(|placed| (placed, self.design.part(placed)));
        let bounds = parts.fold(Bounds::EMPTY, |bounds, (placed, part)| {
            bounds.union(placed.placement.path(&part.outline.outside).bounds())
        });
        let band = self.stars.first().map_or(0.0, |placed| self.design.part(placed).band);
        let seams = self.expected().into_iter().flat_map(|seam| [seam.lead_in, seam.run, seam.lead_out]);
        let touched = seams.map(|path| path.bounds().grown(band / 2.0));
        let Bounds { min, max } = touched.fold(bounds, Bounds::union);
        let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y), min];
        Path::closed(corners.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect())
    }

    /// Every seam is there, in order, from its start to its end, overlap and ramps included; the largest
    /// deviation, mm.
    pub(in crate::verify) fn sealed(&self, program: &Program, findings: &mut Findings) -> f64 {
        let expected = self.expected();
        let contacts = contacts(program, |step| self.rules.phase(step));
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
        let tolerance = self.tolerance;
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

    /// A trace shows the frame, and then every seam; the largest deviation, mm.
    pub(in crate::verify) fn traced(&self, program: &Program, findings: &mut Findings) -> f64 {
        let feeds: Vec<Vec<&Move>> = program
            .moves
            .chunk_by(|a, b| a.kind == b.kind)
            .filter(|chunk| chunk[0].kind == MoveKind::Feed)
            .map(|chunk| chunk.iter().collect())
            .collect();
        let (frame, runs) =
            feeds.split_first().map_or((&[][..], &[][..]), |(frame, runs)| (frame.as_slice(), runs));
        let right = self.frame();
        let mut deviation = self.follow(frame, &right, "frame", right.length(), findings);
        let expected = self.expected();
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
