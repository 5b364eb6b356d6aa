//! The path of the iron over one sheet: order, direction, starts, overlaps and ramps.

use crate::emit::picture::Group;
use crate::emit::preview::place::Places;
use crate::emit::preview::style::{IRON, RAMP, START, Style, TWICE, arrow_head, circle};
use design::{Design, PlacedPart};
use geom::{Path, Point, Segment, Vec2};
use program::plan::{Program, Ramp, SeamReport, Step};
use sealed::Seam;

/// Arrow heads along one seam.
const ARROWS: u32 = 8;

/// The start of a seam.
pub(super) struct Start {
    /// Number in the order of sealing.
    pub(super) order: usize,
    /// Place on the sheet.
    pub(super) at: Point,
    /// The direction of the iron from there.
    pub(super) along: Vec2,
    /// Width of the tube beside it.
    pub(super) tube: f64,
}

/// The path of the iron: order, direction, starts and overlaps are the program's, the lines those of the design.
///
/// A program without arcs has thousands of chords, each within the tolerance: to the eye they are the seam.
pub(super) fn travel_group(
    design: &Design,
    program: &Program,
    style: Style,
    places: &mut Places,
) -> (Group, Vec<Start>) {
    let numbers: Vec<String> = program.numbers().iter().map(ToString::to_string).collect();
    let mut group = Group::new(format!("program-{}", numbers.join("-")));
    let mut starts = Vec::new();
    let mut seam: Option<(usize, DrawnSeam<'_>)> = None;
    for step in &program.steps {
        match step {
            Step::Seam(i) => seam = DrawnSeam::new(design, program, *i).map(|seam| (*i, seam)),
            Step::TouchDown(ramp) | Step::Lift(ramp) => {
                let Some((_, seam)) = &seam else { continue };
                group.line(seam.ramp(ramp), style.pen(RAMP, 2.0));
            }
            Step::Seal(pieces) => {
                // Of several lines and passes of a seam the first is shown, along the middle of the band.
                let Some((index, seam)) = seam.as_ref().filter(|(_, seam)| seam.report.is_first()) else {
                    continue;
                };
                let (run, report) = (seam.run(), seam.report);
                if report.overlap > 0.0 {
                    group
                        .line(run.part(report.length - report.overlap, report.length), style.pen(TWICE, 2.5));
                }
                let tube = design.part(seam.placed).tube_width();
                let travelled = Path::open(pieces.clone());
                for arrow in arrows(&travelled, (0.8 * style.unit).min(0.25 * tube)) {
                    places.keep_off_box(arrow.bounds());
                    group.area(vec![arrow], IRON);
                }
                if let (Some(point), Some(tangent)) = (run.start(), run.tangent_at(0.0)) {
                    let dot = circle(point, (0.4 * style.unit).min(0.12 * tube));
                    places.keep_off_box(dot.bounds());
                    group.area(vec![dot], START);
                    starts.push(Start { order: index + 1, at: point, along: tangent, tube });
                }
            }
            Step::Height(_)
            | Step::Heat(_)
            | Step::Pause(_)
            | Step::Cool(_)
            | Step::Travel(_)
            | Step::Trace(_) => {}
        }
    }
    (group, starts)
}

/// A seam of the design, with its data in the program.
struct DrawnSeam<'a> {
    seam: &'a Seam,
    placed: &'a PlacedPart,
    report: &'a SeamReport,
}

impl<'a> DrawnSeam<'a> {
    fn new(design: &'a Design, program: &'a Program, index: usize) -> Option<Self> {
        let report = program.seams.get(index)?;
        let placed = design.placed().iter().find(|placed| placed.name() == report.name.piece)?;
        let seam = design.part(placed).shape().seam(&report.name.seam)?;
        Some(Self { seam, placed, report })
    }

    fn run(&self) -> Path {
        self.placed.placement.path(&self.seam.run())
    }

    fn ramp(&self, ramp: &Ramp) -> Path {
        let length = ramp.pieces.iter().map(Segment::length).sum();
        let down = ramp.to < ramp.from;
        let path = if down { self.seam.lead_in(length) } else { self.seam.lead_out(length) };
        self.placed.placement.path(&path)
    }
}

/// Arrow heads in the direction of travel, evenly along a seam.
fn arrows(travelled: &Path, size: f64) -> Vec<Path> {
    let length = travelled.length();
    (0..ARROWS)
        .filter_map(|i| {
            let distance = length * (f64::from(i) + 0.5) / f64::from(ARROWS);
            Some(arrow_head(travelled.point_at(distance)?, travelled.tangent_at(distance)?, size))
        })
        .collect()
}
