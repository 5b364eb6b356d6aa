//! The pieces of a printed mask, put together: they are its plate again.
//!
//! The edges in the files are moved back to their places in the mask, and compared with the plate, which is one piece: every edge
//! lies on an edge of the plate, or faces one of another piece; no edge of the plate is missing; and the areas add up.

use std::collections::BTreeMap;

use crate::artifact::Output;
use crate::verify::judge::files::solid::{CHORD, foot};
use crate::verify::judge::path::measure::Prepared;
use crate::verify::{Finding, FindingCode, StlFacet};
use design::{Circle, Design, StarDesign};
use geom::{Isometry, Line, Point};

/// Largest gap between two pieces, mm: the play that lets them go together.
const GAP: f64 = 0.15;

/// Largest missing share of the plate's area; the area of the gaps between its pieces, if that is more.
const SHARE: f64 = 1e-3;

/// More edges than this at joints are not measured: a forged file would take the square of its length. The plate's edges and
/// areas then disagree.
const MANY: usize = 5_000;

/// A piece by its number, the name of its file, and its facets.
type PieceRead = (usize, String, Vec<StlFacet>);

/// The masks of which pieces were read: by star and face.
#[derive(Default)]
pub(super) struct Assemblies(BTreeMap<(usize, bool), Vec<PieceRead>>);

/// The edges and the area of one piece, in the star's frame.
struct MeshPart<'a> {
    file: &'a str,
    edges: Vec<Line>,
    area: f64,
}

impl Assemblies {
    /// Remembers the facets of a file that is a piece of a mask.
    pub(super) fn add(&mut self, output: &Output, facets: Vec<StlFacet>) {
        if let Some((star, piece)) = output.part.star().zip(output.tile) {
            self.0.entry((star, output.mirrored)).or_default().push((piece, output.name(), facets));
        }
    }

    /// The findings about the pieces of each mask, put together.
    pub(super) fn disagreements(&self, design: &Design) -> Vec<Finding> {
        let mut findings = Vec::new();
        let Some(design) = design.assembly() else { return findings };
        for ((star, mirrored), pieces) in &self.0 {
            let Some(placed) = design.stars.iter().find(|placed| placed.index == *star) else { continue };
            let part = design.part(placed);
            let parts: Vec<MeshPart<'_>> = pieces
                .iter()
                .filter_map(|(piece, file, facets)| MeshPart::new(part, *piece, *mirrored, file, facets))
                .collect();
            findings.extend(put_together(part, &parts));
        }
        findings
    }
}

impl<'a> MeshPart<'a> {
    fn new(
        star: &StarDesign,
        piece: usize,
        mirrored: bool,
        file: &'a str,
        facets: &[StlFacet],
    ) -> Option<Self> {
        let motion = star.tiles.tiles.get(piece.checked_sub(1)?)?.motion(mirrored);
        // A mirror image that is turned is its own way back.
        let back = if mirrored { motion } else { Isometry::rotation(-motion.rotation) };
        let feet = facets.iter().filter_map(foot).filter(|[a, _]| a[2] == 0.0);
        let ends = feet.map(|foot| foot.map(|corner| back.point(Point::new(corner[0], corner[1]))));
        let edges = ends.map(|[start, end]| Line::new(start, end)).collect();
        let bottom = facets.iter().map(|facet| facet.map(|corner| corner.map(f64::from)));
        let bottom = bottom.filter(|facet| facet.iter().all(|corner| corner[2] == 0.0));
        let area = |[a, b, c]: [[f64; 3]; 3]| {
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        };
        Some(Self { file, edges, area: bottom.map(area).sum() })
    }
}

/// Findings about the printed pieces of the mask of `star`, laid together at their places.
///
/// An edge of a piece lies on the plate's own edges or on a joint. Each edge on a joint must have another piece's edge beside
/// it, and the pieces must have all of the plate's edges and its area.
fn put_together(star: &StarDesign, parts: &[MeshPart<'_>]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mask = &star.mask;
    let plate = Prepared::prepare_all(std::iter::once(&mask.plate).chain(&mask.windows));
    let holes = &star.outline.registration;
    let (mut on_plate, mut joints): (f64, Vec<(usize, Line)>) = (0.0, Vec::new());
    for (i, part) in parts.iter().enumerate() {
        for edge in &part.edges {
            if plate_distance(edge.start.midpoint(edge.end), &plate, holes) <= CHORD {
                on_plate += edge.length();
            } else {
                joints.push((i, *edge));
            }
        }
    }
    if joints.len() > MANY {
        joints.clear();
    }
    // Each joint has an edge on either side.
    let gaps = GAP * joints.iter().map(|(_, edge)| edge.length()).sum::<f64>() / 2.0;
    for (i, part) in parts.iter().enumerate() {
        let own_edges = joints.iter().filter(|(owner, _)| *owner == i);
        let gap = own_edges.map(|(_, edge)| {
            let other_edges = joints.iter().filter(|(owner, _)| *owner != i);
            let middle = edge.start.midpoint(edge.end);
            let distances = other_edges.map(|(_, other)| Prepared::new((*other).into()).distance(middle));
            distances.fold(f64::INFINITY, f64::min)
        });
        let widest = gap.fold(0.0, f64::max);
        if widest > GAP {
            let problem = format!("an edge {widest:.3} mm from the plate's and from every other piece");
            findings
                .push(Finding::new(FindingCode::WrongJoint, problem, format!("{GAP} mm")).in_file(part.file));
        }
    }
    let length: f64 = plate.iter().map(|target| target.length).sum::<f64>()
        + holes.iter().map(|hole| std::f64::consts::PI * hole.diameter).sum::<f64>();
    let (area, right) = (parts.iter().map(|part| part.area).sum::<f64>(), mask.area(&star.outline));
    let file = parts.first().map_or("", |part| part.file);
    if (on_plate - length).abs() > 0.01 * length {
        let problem = format!("{on_plate:.1} mm of the plate's edges on all pieces");
        let allowed = format!("{length:.1} mm");
        findings.push(Finding::new(FindingCode::WrongJoint, problem, allowed).in_file(file));
    }
    let slack = (SHARE * right).max(gaps);
    if (area - right).abs() > slack {
        let problem = format!("{area:.1} mm2 on all pieces");
        let allowed = format!("{right:.1} mm2 within {slack:.1}");
        findings.push(Finding::new(FindingCode::WrongJoint, problem, allowed).in_file(file));
    }
    findings
}

/// Distance of `p` from the nearest edge of the plate and from the rims of its `holes`.
fn plate_distance(p: Point, plate: &[Prepared], holes: &[Circle]) -> f64 {
    let rims = holes.iter().map(|hole| (hole.center.distance(p) - hole.diameter / 2.0).abs());
    let least_distance = |best: f64, target: &Prepared| {
        if target.bounds.distance(p) < best { best.min(target.distance(p)) } else { best }
    };
    plate.iter().fold(rims.fold(f64::INFINITY, f64::min), least_distance)
}
