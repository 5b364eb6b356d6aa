//! How the iron travels over one sheet, for people: order, direction, starts, overlaps and ramps.

use svg::Node;
use svg::node::element::Element;

use crate::design::{Design, PlacedStar, Seam};
use crate::emit::number::Decimals;
use crate::emit::svg::{SvgPage, element};
use crate::geom::{Path, Point, Segment};
use crate::plan::{Program, Ramp, SeamReport, Step};

/// Arrow heads along one seam.
const ARROWS: u32 = 8;

/// How the iron travels: order, direction, starts and overlaps are the program's, the lines those of the design.
///
/// A machine that draws no arcs is told thousands of chords, each within the tolerance: to the eye they are the seam.
pub(super) fn travel_group(page: &SvgPage, design: &Design, program: &Program, size: f64) -> Element {
    let mut group = element("g");
    group.assign(
        "id",
        format!("program-{}", program.stars.iter().map(ToString::to_string).collect::<Vec<_>>().join("-")),
    );
    let mut seam: Option<(usize, DrawnSeam<'_>)> = None;
    for step in &program.steps {
        match step {
            Step::Seam(i) => seam = DrawnSeam::new(design, program, *i).map(|seam| (*i, seam)),
            Step::TouchDown(ramp) | Step::Lift(ramp) => {
                let Some((_, seam)) = &seam else { continue };
                group.append(stroke(page, &seam.ramp(ramp), "#7030a0", 0.4, Some("1.2 0.8")));
            }
            Step::Seal(pieces) => {
                let Some((index, seam)) = &seam else { continue };
                let (run, report) = (seam.run(), seam.report);
                group.append(stroke(page, &run, "#404040", 0.15, None));
                if report.overlap > 0.0 {
                    let twice = run.part(report.length - report.overlap, report.length);
                    group.append(stroke(page, &twice, "#d00000", 0.8, None));
                }
                for arrow in arrows(page, &Path::open(pieces.clone()), size) {
                    group.append(arrow);
                }
                if let Some(start) = pieces.first() {
                    group.append(start_mark(page, start, index + 1, size));
                }
            }
            Step::Height(_) | Step::Heat(_) | Step::Travel(_) | Step::Trace(_) => {}
        }
    }
    group
}

/// A seam as the design has it, and what the program says of it.
struct DrawnSeam<'a> {
    seam: &'a Seam,
    star: &'a PlacedStar,
    report: &'a SeamReport,
}

impl<'a> DrawnSeam<'a> {
    fn new(design: &'a Design, program: &'a Program, index: usize) -> Option<Self> {
        let report = program.seams.get(index)?;
        let star = design.stars.iter().find(|star| star.index == report.star)?;
        let seam = design.part(star).seams.iter().find(|seam| seam.side == report.side)?;
        Some(Self { seam, star, report })
    }

    fn run(&self) -> Path {
        self.star.placement.path(&self.seam.run())
    }

    fn ramp(&self, ramp: &Ramp) -> Path {
        let length = ramp.pieces.iter().map(Segment::length).sum();
        let down = ramp.to < ramp.from;
        let path = if down { self.seam.lead_in(length) } else { self.seam.lead_out(length) };
        self.star.placement.path(&path)
    }
}

fn stroke(page: &SvgPage, path: &Path, color: &str, width: f64, dash: Option<&str>) -> Element {
    let mut out = element("path");
    out.assign("d", page.data(path));
    out.assign("fill", "none");
    out.assign("stroke", color);
    out.assign("stroke-width", Decimals::exactly(3).text(width));
    if let Some(dash) = dash {
        out.assign("stroke-dasharray", dash);
    }
    out
}

/// Arrow heads in the direction of travel, evenly along a seam.
fn arrows(page: &SvgPage, travelled: &Path, size: f64) -> Vec<Element> {
    let length = travelled.length();
    (0..ARROWS)
        .filter_map(|i| {
            let at = length * (f64::from(i) + 0.5) / f64::from(ARROWS);
            let (tip, along) = (travelled.point_at(at)?, travelled.tangent_at(at)?);
            let back = tip - along * (0.9 * size);
            let side = along.perp() * (0.35 * size);
            Some(triangle(page, [tip, back + side, back - side], "#404040"))
        })
        .collect()
}

fn triangle(page: &SvgPage, points: [Point; 3], fill: &str) -> Element {
    let mut out = element("polygon");
    out.assign("points", points.map(|p| format!("{},{}", page.x(p), page.y(p))).join(" "));
    out.assign("fill", fill);
    out
}

/// A dot where the seam starts, and its number in the order of sealing.
fn start_mark(page: &SvgPage, first: &Segment, order: usize, size: f64) -> Element {
    let start = first.start();
    let mut group = element("g");
    let mut dot = element("circle");
    dot.assign("cx", page.x(start));
    dot.assign("cy", page.y(start));
    dot.assign("r", Decimals::exactly(2).text(0.45 * size));
    dot.assign("fill", "#008000");
    group.append(dot);
    let beside = start + first.tangent(0.0).perp() * (1.2 * size);
    group.append(page.text(beside, 1.2 * size, "middle", "#006000", &order.to_string()));
    group
}
