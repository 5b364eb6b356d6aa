//! The weld that the paper in a file leaves in a heat press, against the sealed shapes.
//!
//! All fabric under the plates welds but where paper lies. So no paper lies in a band; along every band paper lies on its side of
//! the air; and paper leaves a piece through its ports only. The paper is the one that was read; bands, cuts and ports are the
//! design's. How the paper was made plays no part.

use crate::verify::judge::expected::Expected;
use crate::verify::{Drawing, FindingCode, Findings};
use design::{Layer, PlacedSeparator};
use geom::{Enclosures, Path, Point, SegmentIndex, Vec2};
use sealed::{Port, SealedShape, Seam};
use spec::units::Readable;

/// Distance of probes along seams and cuts, mm.
const STEP: f64 = 1.0;
/// Distance of a probe from the line that it tests, mm: more than files round, less than anybody sees.
const OFF: f64 = 0.01;

/// Paper as a file has it, with the distance of its edges from those of the bands.
struct PaperArea {
    edges: Enclosures,
    /// Air between band and paper, as drawn: the creep less half of the tool's cut, mm.
    gap: f64,
}

/// Judges the separators in `drawing` of sheet of paper number `paper`.
pub(super) fn check(expected: &Expected<'_>, drawing: &Drawing, paper: usize, findings: &mut Findings) {
    let Some(sheet) = expected.design.papers.iter().find(|sheet| sheet.index == paper) else { return };
    let layers = [Layer::SeparatorEdge, Layer::SeparatorWindow];
    let paths = layers.iter().flat_map(|layer| drawing.layer(layer.name()));
    let Some(creep) = expected.spec.paper_creep() else { return };
    let area = PaperArea { edges: Enclosures::new(paths), gap: creep - expected.spec.cut.kerf.0 / 2.0 };
    for separator in &sheet.separators {
        judge_piece(expected, separator, &area, findings);
    }
}

/// Judges the paper of one piece; of each kind of fault the first is reported.
fn judge_piece(
    expected: &Expected<'_>,
    separator: &PlacedSeparator,
    area: &PaperArea,
    findings: &mut Findings,
) {
    // Seams, cut and ports of the piece are moved to where the paper lies. Then paper is looked for where none may be,
    // and missed where the air is.
    let design = expected.design;
    let Some(placed) = design.placed().iter().find(|placed| placed.index == separator.piece) else { return };
    let motion = &separator.placement;
    let flat = design.part(placed).shape();
    let shape = SealedShape {
        seams: flat
            .seams
            .iter()
            .map(|seam| Seam { center_line: motion.path(&seam.center_line), ..seam.clone() })
            .collect(),
        cut: flat.cut.as_ref().map(|cut| motion.path(cut)),
        ports: flat.ports.iter().map(|port| Port { at: motion.point(port.at), ..*port }).collect(),
        ..flat.clone()
    };
    let wide = format!("bands of {} mm without paper", shape.band);
    for (code, place, paper, allowed) in [
        (FindingCode::NarrowBand, paper_in_band(&shape, area), "paper in a band", wide.as_str()),
        (
            FindingCode::WeldedAir,
            welded_air(&shape, area),
            "no paper beside a band",
            "paper along the band, on its side of the air",
        ),
        (
            FindingCode::StrayPaper,
            stray_paper(&shape, area),
            "paper across the cut",
            "paper that leaves the piece through its ports only",
        ),
    ] {
        if let Some(p) = place {
            let [x, y] = [p.x, p.y].map(|mm| Readable(mm.round()));
            findings.add(code, format!("{paper} of {} at {x} {y} mm", placed.name()), allowed);
        }
    }
}

impl PaperArea {
    fn covers(&self, p: Point) -> bool {
        self.edges.enclosing(p).len() % 2 == 1
    }
}

/// Points along `path`, each with the direction of its left side.
fn probes(path: &Path) -> impl Iterator<Item = (Point, Vec2)> + '_ {
    path.segments.iter().flat_map(|segment| {
        let count = (segment.length() / STEP).ceil().clamp(1.0, 1e5);
        let steps =
            std::iter::successors(Some(0.5), |half| Some(half + 1.0)).take_while(move |half| *half < count);
        steps.map(move |half| (segment.point(half / count), segment.tangent(half / count).perp()))
    })
}

/// Whether `p` lies within `cut`, the outline of the piece; a piece without one is everywhere.
fn is_in_piece(p: Point, cut: Option<&Enclosures>) -> bool {
    cut.is_none_or(|cut| cut.enclosing(p).len() == 1)
}

/// A place in a band where paper lies.
fn paper_in_band(shape: &SealedShape, area: &PaperArea) -> Option<Point> {
    let cut = shape.cut.as_ref().map(|cut| Enclosures::new([cut]));
    let reach = shape.band / 2.0 + area.gap - OFF;
    let mut points =
        shape.seams.iter().flat_map(|seam| probes(&seam.center_line)).flat_map(|(p, left)| {
            [0.0, reach / 2.0, -reach / 2.0, reach, -reach].map(|aside| p + left * aside)
        });
    points.find(|p| is_in_piece(*p, cut.as_ref()) && area.covers(*p))
}

/// A place beside a band where the sheets weld on both sides.
///
/// A probe that is nearer to another part of a band than to its own says nothing, nor one beyond the cut.
fn welded_air(shape: &SealedShape, area: &PaperArea) -> Option<Point> {
    let cut = shape.cut.as_ref().map(|cut| Enclosures::new([cut]));
    let lines = shape.seams.iter().flat_map(|seam| seam.center_line.segments.clone());
    let lines = SegmentIndex::new(lines.collect());
    let reach = shape.band / 2.0 + area.gap + OFF;
    let seam_probes = shape.seams.iter().flat_map(|seam| probes(&seam.center_line));
    seam_probes
        .filter(|(p, _)| is_in_piece(*p, cut.as_ref()))
        .find(|(p, left)| {
            let sides = [*p + *left * reach, *p - *left * reach];
            let are_telling = sides
                .iter()
                .all(|side| !lines.has_within(*side, reach - 1e-6) && is_in_piece(*side, cut.as_ref()));
            are_telling && !sides.iter().any(|side| area.covers(*side))
        })
        .map(|(p, _)| p)
}

/// A place of the cut, farther from every port than half of its width, where paper lies.
fn stray_paper(shape: &SealedShape, area: &PaperArea) -> Option<Point> {
    let cut = shape.cut.as_ref()?;
    // Just inside: tongues end on the cut.
    let inner_point = |(p, left): (Point, Vec2)| p + left * (if cut.area() > 0.0 { OFF } else { -OFF });
    probes(cut).map(inner_point).find(|p| {
        let mut ports = shape.ports.iter();
        area.covers(*p) && !ports.any(|port| port.at.distance(*p) < port.width / 2.0 + shape.band)
    })
}
