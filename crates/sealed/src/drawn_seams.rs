//! Seams that are drawn as centre lines: closed ones are edges of the air, open ones walls and welds.

use crate::bands::{Band, BandKind, Bands, FollowedEdge, opened_bands};
use crate::center_lines::{NARROWEST_LOOP, is_point, loop_width};
use crate::fault::{Noted, Quoted, SealingNotes, ShapeCode, ShapeFault, named};
use crate::mended::{MendedCurves, NamedPath};
use crate::network::NetworkEdge;
use crate::offset::offset_right;
use crate::pieces::with_end;
use crate::ports::{OpenedEdges, Opening, open_ports};
use crate::regions::depth;
use crate::segments::Segments;
use crate::sketch::{DrawnPort, Rules};
use geom::{Bounds, Enclosures, Line, Path, SegmentIndex};

/// A weld goes on to a centre line that is nearer to its end than this many bands: that around a corner of 29 degrees is.
const FARTHEST: f64 = 2.0;

/// An end of a weld lies on a band that it misses by this much, mm.
const JOINED: f64 = 1e-6;

/// A closed drawn seam.
struct ClosedSeam {
    path: Path,
    names: Vec<String>,
    /// Whether the air is inside.
    is_outer: bool,
}

/// The `bands` with drawn seams: closed ones are edges of the air, open ones welds.
///
/// The ends of welds are led to the edges that they miss by a gap. A closed seam lies on the air's side by the number of closed seams and
/// outer edges around it. Ports that are not taken open the outer ones.
pub(crate) fn with_seams(
    mut bands: Bands,
    seams: MendedCurves,
    ports: &[DrawnPort],
    rules: &Rules,
) -> Noted<Bands> {
    let mut notes = SealingNotes::default();
    if seams.names.is_empty() {
        return (bands, notes);
    }
    let MendedCurves { network, names, .. } = seams;
    let (closed, open): (Vec<NetworkEdge>, _) =
        network.edges.into_iter().partition(|edge| edge.nodes.is_none());
    let with_names = |edge: NetworkEdge| NamedPath { names: named(&edge.sources, &names), path: edge.path };
    let (welds, pass_notes) = without_edge_gaps(open.into_iter().map(with_names).collect(), &bands, rules);
    notes += pass_notes;
    for NamedPath { path, names } in welds {
        bands.air.seams.push(path.clone());
        bands.list.push(Band { path, names, kind: BandKind::Weld, joined: [false; 2] });
    }
    let seams = closed_seams(closed.into_iter().map(with_names).collect(), &bands.cut_edges);
    notes.faults.extend(seams.iter().filter(|seam| is_point(&seam.path)).map(point_seam));
    let half_band = rules.band / 2.0;
    for seam in &seams {
        // The air is on the left, and begins where the band ends.
        bands.air.closed.extend(offset_right(&seam.path, -half_band));
    }
    let length = half_band + rules.allowance;
    let outlines = OpenedEdges {
        edges: seams.iter().filter(|seam| seam.is_outer).map(|seam| seam.path.clone()).collect(),
        mouths: Vec::new(),
        taken_ports: std::mem::take(&mut bands.taken_ports),
    };
    let opening = Opening { half_band, length, may_wait: false };
    let (OpenedEdges { edges, mouths, taken_ports }, pass_notes) =
        open_ports(outlines, ports, &opening, rules);
    notes += pass_notes;
    bands.taken_ports = taken_ports;
    bands.mouths.extend(mouths);
    let mut opened_edges = edges.into_iter();
    for ClosedSeam { path, names, is_outer } in seams {
        let opened_edge = if is_outer { opened_edges.next() } else { None };
        let path = opened_edge.unwrap_or(path);
        let kind = if is_outer { BandKind::Outer } else { BandKind::Island };
        bands.closed.push(path.clone());
        bands.air.edges.extend(offset_right(&path, -half_band));
        bands.list.extend(opened_bands(path.clone(), &names, kind, &bands.mouths, rules));
        if is_outer {
            bands.cut_edges.push(FollowedEdge { path, distance: length });
        }
    }
    (bands, notes)
}

/// The fault of a closed seam that is hardly larger than a point.
fn point_seam(seam: &ClosedSeam) -> ShapeFault {
    let width = loop_width(&seam.path);
    let finding = format!("the closed seam {} is only {width:.4} mm wide on average", Quoted(&seam.names));
    let remedy = format!("make it at least {NARROWEST_LOOP} mm wide, or draw an open weld in its place");
    let fault = ShapeFault::new(ShapeCode::NoRoom, seam.path.bounds().center(), finding, remedy);
    ShapeFault { names: seam.names.clone(), found: width, allowed: NARROWEST_LOOP, ..fault }
}

/// The closed seams with the air on their left: `edges` and seams around one tell on which side that is.
fn closed_seams(seams: Vec<NamedPath>, edges: &[FollowedEdge]) -> Vec<ClosedSeam> {
    let seam_paths = seams.iter().map(|seam| &seam.path);
    let enclosures = Enclosures::new(seam_paths.chain(edges.iter().map(|edge| &edge.path)));
    let oriented = |NamedPath { path, names }| {
        let is_outer = depth(&enclosures, &path).is_multiple_of(2);
        let path = if (path.area() > 0.0) == is_outer { path } else { path.reversed() };
        ClosedSeam { path, names, is_outer }
    };
    seams.into_iter().map(oriented).collect()
}

/// The `welds`, of which each end that lies off every band, but within `join` of an edge of the air, is moved to that edge, where the band
/// begins: a gap there is closed as one between two ends is.
///
/// Around a corner of the fabric the centre line keeps farther off than half a band; a weld that ends there goes on to it.
fn without_edge_gaps(mut welds: Vec<NamedPath>, bands: &Bands, rules: &Rules) -> Noted<Vec<NamedPath>> {
    let mut notes = SealingNotes::default();
    let edges = Segments::new(&bands.air.closed);
    let center_lines =
        SegmentIndex::new(bands.list.iter().flat_map(|band| band.path.segments.clone()).collect());
    let reach = rules.band / 2.0 + JOINED;
    let farthest = FARTHEST * rules.band;
    for NamedPath { path, names } in &mut welds {
        for is_start in [true, false] {
            let mut way = if is_start { path.reversed() } else { path.clone() };
            let Some(last) = way.segments.last_mut() else { continue };
            let end = last.end();
            let candidates = edges.overlapping(Bounds::of_points([end]).outset(rules.join));
            let feet = candidates.map(|edge| edge.segment.point(edge.segment.nearest_fraction(end)));
            let feet = feet.map(|foot| (foot.distance(end), foot)).filter(|(gap, _)| *gap <= rules.join);
            let Some((gap, foot)) = feet.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            if center_lines.has_within(end, reach - JOINED / 2.0) {
                continue;
            }
            let places = bands.list.iter().filter_map(|band| Some((band, band.path.nearest(foot)?)));
            let Some((band, nearest)) = places.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance)) else {
                continue;
            };
            *last = with_end(last, foot);
            if gap > 2.0 * JOINED {
                notes.gap_closed([names.clone(), band.names.clone()].concat(), foot, gap);
            }
            let is_at_mouth = bands.mouths.iter().any(|mouth| mouth.is_beside(foot, rules.band));
            if !is_at_mouth && (reach..farthest).contains(&nearest.distance) {
                way.segments.push(Line::new(foot, nearest.point).into());
            }
            *path = if is_start { way.reversed() } else { way };
        }
    }
    (welds, notes)
}

/// The bands, with the ends of welds that lie on another band, within half a band of its centre line: a weld with two is a wall.
pub(crate) fn join_ends(mut bands: Vec<Band>, width: f64) -> Vec<Band> {
    let segments = Segments::new(bands.iter().map(|band| &band.path));
    let reach = width / 2.0 + JOINED;
    for (number, band) in bands.iter_mut().enumerate().filter(|(_, band)| band.kind == BandKind::Weld) {
        band.joined = [true, false].map(|is_start| segments.has_joint(number, &band.path, is_start, reach));
        if band.joined == [true; 2] {
            band.kind = BandKind::Wall;
        }
    }
    bands
}
