//! The **separator**: paper between the sheets of a heat press, where they must not weld.
//!
//! It covers the air, and runs as a tongue through each port to the edge of the cut. It spares islands and the bands of seams that lie in
//! the air. Everything that it does not cover is welded.

use crate::mouth::Mouth;
use crate::offset_graph::merged;
use crate::{SealedShape, Seam, of_polyline, offset_right, polyline};
use cavalier_contours::polyline::{BooleanOp, BooleanResultInfo, PlineSource, Polyline};
use geom::order::sort_by_key;
use geom::{Line, Path, Point, Segment, SegmentIndex, Vec2, intersections};

/// The air of a sketch: its edges and the seams inside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AirSide {
    /// Closed edges, the air on their left.
    pub(super) edges: Vec<Path>,
    /// Closed edges without the channels of ports, the air on their left.
    pub(super) closed: Vec<Path>,
    /// Centre lines of open seams inside.
    pub(super) seams: Vec<Path>,
    pub(super) mouths: Vec<Mouth>,
}

/// The region that must not weld. All paths are closed and counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Separator {
    /// Around each piece of paper: one a chamber.
    pub pieces: Vec<Path>,
    /// Out of the pieces: islands, and the bands of seams that meet no edge.
    pub windows: Vec<Path>,
}

impl Separator {
    /// Area of the paper, mm^2.
    pub fn area(&self) -> f64 {
        let [pieces, windows] =
            [&self.pieces, &self.windows].map(|paths| paths.iter().map(Path::area).sum::<f64>());
        pieces - windows
    }

    /// Whether all edges are closed around some paper: operations on slivers of air leave others.
    fn is_closed(&self) -> bool {
        self.pieces
            .iter()
            .chain(&self.windows)
            .all(|path| path.area() > 0.0 && path.largest_gap() < CLOSENESS)
    }

    /// Whether its edges keep `clearance` mm from the centre lines of `seams`, measured at nine points of each segment.
    fn spares(&self, seams: &[Seam], clearance: f64) -> bool {
        let lines =
            SegmentIndex::new(seams.iter().flat_map(|seam| seam.center_line.segments.clone()).collect());
        let clearance = clearance - 0.5 * CLOSENESS;
        let edges = self.pieces.iter().chain(&self.windows).flat_map(|path| &path.segments);
        let mut points = edges.flat_map(|edge| (0..=8).map(|i| edge.point(f64::from(i) / 8.0)));
        points.all(|p| !lines.has_within(p, clearance))
    }
}

/// The part of a separator that leaves the piece through a port, by which the paper is pulled out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tongue {
    /// Number of the port, from 0.
    pub port: usize,
    /// The middle of its end, on the cut.
    pub end: Point,
    /// Outwards, of length 1.
    pub outwards: Vec2,
    /// Width of the port, mm; the paper is narrower by twice the creep.
    pub width: f64,
    /// Length of the channel, mm.
    pub length: f64,
}

impl AirSide {
    /// The air within closed `edges`, which lies on their left, with straight channels that end at `tongues`, on the edges. `closed` are
    /// the edges without the channels.
    pub fn of_edges(edges: Vec<Path>, closed: Vec<Path>, tongues: &[Tongue]) -> Self {
        let mouth = |tongue: &Tongue| {
            let Tongue { port, end, outwards, width, length } = *tongue;
            // A point behind the mouth, inside the channel, from where the way out is sought.
            Mouth { port, at: end, outwards, half: width / 2.0, length, beyond: 0.0, depth: length.min(1.0) }
        };
        Self { edges, closed, seams: Vec::new(), mouths: tongues.iter().map(mouth).collect() }
    }

    /// The tongues of a separator, which end on the cut.
    pub fn tongues(&self, cut: &Path) -> Vec<Tongue> {
        let tongue = |mouth: &Mouth| Tongue {
            port: mouth.port,
            end: mouth.point(way_out(mouth, cut, 0.0), 0.0),
            outwards: mouth.outwards,
            width: 2.0 * mouth.half,
            length: mouth.length,
        };
        let mut tongues: Vec<Tongue> = self.mouths.iter().map(tongue).collect();
        sort_by_key(&mut tongues, |tongue| tongue.port);
        tongues
    }

    /// Closed edges of the air, which lies on their left. The channel of a port runs past its mouth.
    pub fn edges(&self) -> &[Path] {
        &self.edges
    }

    /// Closed edges without the channels of ports: the region that inflates, on their left.
    pub fn closed(&self) -> &[Path] {
        &self.closed
    }

    /// The edges, where the channel of a port ends at its mouth, on the cut; `band` is the width of the bands, mm.
    pub fn edges_to_mouths(&self, band: f64) -> Vec<Path> {
        let back = |mouth: &Mouth, p: Point| (mouth.at - p).dot(mouth.outwards);
        self.edges.iter().map(|edge| self.with_ends(edge, band / 2.0, back)).collect()
    }

    /// Whether `p` lies within `margin` mm of the way of a hose into a port.
    pub fn is_on_hose(&self, p: Point, margin: f64) -> bool {
        self.mouths.iter().any(|mouth| {
            let (along, across) = mouth.local(p);
            along > -mouth.depth && across.abs() < mouth.half + margin
        })
    }

    /// The separator of `shape`, whose seams enclose this air, with every edge but those on the cut `creep` mm inside the air; `None` where
    /// the paper has another number of pieces than there are chambers, a port has no tongue, or a tongue runs over another band.
    pub fn separator(&self, shape: &SealedShape, creep: f64) -> Option<Separator> {
        let (band, chambers) = (shape.band, shape.topology().chambers.len());
        let outline = shape.cut.as_ref()?.counterclockwise();
        let cut = polyline(&outline);
        let mut pieces: Vec<Polyline<f64>> = Vec::new();
        for edge in self.edges.iter().filter(|edge| edge.area() > 0.0) {
            // Channels as long as they must be to leave the piece that is cut along the outline.
            let longer = self.with_ends(edge, band / 2.0, |mouth, _| past(mouth, &outline));
            for part in offset_right(&longer, -creep) {
                pieces.extend(combined(&polyline(&part), &cut, BooleanOp::And)?.outlines);
            }
        }
        let mut windows = Vec::new();
        for spared in self.spared(band / 2.0 + creep, creep)? {
            let mut cut_up = Vec::new();
            for piece in pieces {
                let difference = combined(&piece, &spared, BooleanOp::Not)?;
                cut_up.extend(difference.outlines);
                windows.extend(difference.holes);
            }
            pieces = cut_up;
        }
        let separator =
            Separator { pieces: counterclockwise_paths(&pieces), windows: counterclockwise_paths(&windows) };
        let has_tongue = |mouth: &Mouth| {
            let end = mouth.point(way_out(mouth, &outline, 0.0), 0.0);
            separator.pieces.iter().any(|piece| piece.distance(end) < CLOSENESS)
        };
        let is_complete = separator.pieces.len() == chambers && self.mouths.iter().all(has_tongue);
        (is_complete && separator.is_closed() && separator.spares(&shape.seams, band / 2.0 + creep))
            .then_some(separator)
    }

    /// The islands, and strips `half` mm to both sides of seams, of which overlapping ones are united.
    fn spared(&self, half: f64, creep: f64) -> Option<Vec<Polyline<f64>>> {
        let mut regions: Vec<Polyline<f64>> = Vec::new();
        for island in self.edges.iter().filter(|edge| edge.area() < 0.0) {
            let [edge] = <[Path; 1]>::try_from(offset_right(island, -creep)).ok()?;
            regions.push(polyline(&edge.reversed()));
        }
        let mut width = half;
        for seam in &self.seams {
            regions.push(strip(seam, width)?);
            // Strips that meet end to end must not have sides on one line: neither could then be found to be inside the other.
            width += 2e-5;
        }
        let mut united: Vec<Polyline<f64>> = Vec::new();
        for mut region in regions {
            let mut disjoint = Vec::new();
            for other in united {
                // Few of many islands are near each other.
                if !region.extents().zip(other.extents()).is_some_and(|(a, b)| a.overlaps_aabb(&b)) {
                    disjoint.push(other);
                    continue;
                }
                let union = region.boolean(&other, BooleanOp::Or);
                match (union.result_info, union.pos_plines.len(), union.neg_plines.is_empty()) {
                    (BooleanResultInfo::Disjoint, ..) => disjoint.push(other),
                    (BooleanResultInfo::InvalidInput, ..) => return None,
                    (_, 1, true) => region = union.pos_plines.into_iter().next()?.pline,
                    _ => return None,
                }
            }
            disjoint.push(region);
            united = disjoint;
        }
        Some(united)
    }

    /// The closed `edge` with each end of a channel `longer` mm farther out. The channel of an edge that was drawn as a centre line ends
    /// `half` mm earlier.
    fn with_ends(&self, edge: &Path, half: f64, longer: impl Fn(&Mouth, Point) -> f64) -> Path {
        let moved = |p: Point| {
            let mouth = self.mouths.iter().find(|mouth| is_channel_end(mouth, p, half));
            mouth.map_or(p, |mouth| p + mouth.outwards * longer(mouth, p))
        };
        let segments = edge.segments.iter().map(|segment| match segment {
            Segment::Line(line) => {
                let [start, end] = [line.start, line.end].map(moved);
                Line::new(start, end).into()
            }
            Segment::Arc(_) => *segment,
        });
        Path::closed(segments.collect())
    }
}

/// Lengths that differ by less are alike, mm.
const ALIKE: f64 = 1e-6;

/// A tongue ends nearer than this to the edge of the cut, mm: the operations on closed lines join points within 1e-5.
const CLOSENESS: f64 = 1e-4;

/// Whether `p` is a corner at the end of the channel of `mouth`, or `half` mm before it.
fn is_channel_end(mouth: &Mouth, p: Point, half: f64) -> bool {
    let stations = [mouth.beyond, mouth.beyond - half].into_iter();
    let mut corners =
        stations.flat_map(|station| [-mouth.half, mouth.half].map(|offset| mouth.point(station, offset)));
    corners.any(|corner| corner.distance(p) < ALIKE)
}

/// Distance past the mouth at which the way out first meets the cut, `offset` mm to its left.
fn way_out(mouth: &Mouth, cut: &Path, offset: f64) -> f64 {
    let bounds = cut.bounds();
    let length = bounds.width() + bounds.height();
    let way = Line::new(mouth.point(-mouth.depth, offset), mouth.point(length, offset)).into();
    let places = cut.segments.iter().flat_map(|segment| intersections(segment, &way));
    places.map(|p| mouth.local(p).0).reduce(f64::min).unwrap_or(0.0)
}

/// Distance that a tongue must go beyond its channel to leave the piece, mm.
fn past(mouth: &Mouth, cut: &Path) -> f64 {
    let ways = [-mouth.half, 0.0, mouth.half].map(|offset| way_out(mouth, cut, offset));
    let longest = ways.into_iter().fold(0.0, f64::max);
    (longest + mouth.depth).max(0.0)
}

/// The result of an operation on two closed lines: lines around its parts, and lines cut out of them.
struct Combination {
    outlines: Vec<Polyline<f64>>,
    holes: Vec<Polyline<f64>>,
}

fn combined(a: &Polyline<f64>, b: &Polyline<f64>, operation: BooleanOp) -> Option<Combination> {
    let result = a.boolean(b, operation);
    let is_valid = !matches!(result.result_info, BooleanResultInfo::InvalidInput);
    is_valid.then(|| {
        let [outlines, holes] = [result.pos_plines, result.neg_plines]
            .map(|list| list.into_iter().map(|result| result.pline).collect());
        Combination { outlines, holes }
    })
}

fn counterclockwise_paths(lines: &[Polyline<f64>]) -> Vec<Path> {
    lines.iter().map(|line| merged(&of_polyline(line).counterclockwise())).collect()
}

/// The region within `half` mm of an open path; `None` where the path comes so near to itself that the region has a hole.
fn strip(path: &Path, half: f64) -> Option<Polyline<f64>> {
    let there_and_back = Path::closed(path.clone().chain(path.reversed()).segments);
    let [edge] = <[Path; 1]>::try_from(offset_right(&there_and_back, half)).ok()?;
    Some(polyline(&edge))
}
