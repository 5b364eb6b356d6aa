//! Loose ends of a drawing, and curves that cross.

use crate::fault::{Quoted, ShapeCode, ShapeFault, named};
use crate::network::{Network, network};
use crate::pieces::Piece;
use crate::segments::{PathSegment, Segments};
use geom::order::sort_by;
use geom::{Bounds, BoxIndex, Path, Point, Segment, intersections};

/// Ends farther apart than this are two ends, not a gap, mm.
const WIDEST_GAP: f64 = 5.0;

/// Most crossings that are searched for: the report of a thousand lines across a thousand others would take a gigabyte.
const MOST_CROSSINGS: usize = 10_000;

/// A longer line is no mark of a port, mm.
const LONGEST_MARK: f64 = 20.0;

/// Largest `join` of a spec, mm.
const WIDEST_JOIN: f64 = 10.0;

/// Most gaps for which a wider `join` is tried: each trial joins the whole drawing.
const MOST_TRIALS: usize = 8;

/// The free end of an edge, and the edge across the gap in front of it.
struct Gap {
    place: Point,
    edge: usize,
    partner: usize,
    width: f64,
}

/// Faults where an edge of the `network` of `pieces` ends in the open: a gap if another edge is near, else an end with this `remedy`. An end past a
/// curve that it crosses is left to [`crossings`].
///
/// Each free end is compared with the free ends after it and with the sides of other edges. Of two ends with one gap the first has the
/// fault.
pub(super) fn loose_ends(
    pieces: &[Piece],
    network: &Network,
    names: &[String],
    join: f64,
    remedy: &str,
) -> Vec<ShapeFault> {
    let mut faults = Vec::new();
    let mut trials = 0;
    let free = network.free_ends();
    if free.is_empty() {
        return faults;
    }
    let places: Vec<Point> = free.iter().map(|end| network.nodes[end.node]).collect();
    let ends = BoxIndex::new(places.iter().map(|place| Bounds::of_points([*place])));
    let sides = Segments::new(network.edges.iter().map(|edge| &edge.path));
    let mut is_paired = vec![false; free.len()];
    for (i, end) in free.iter().enumerate() {
        if is_paired[i] {
            continue;
        }
        let place = places[i];
        let zone = Bounds::of_points([place]).outset(WIDEST_GAP);
        let candidates = ends.overlapping(&zone).into_iter().filter(|j| *j != i && !is_paired[*j]);
        let candidates = candidates.map(|j| (places[j].distance(place), j));
        let other_end = candidates.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(gap, _)| *gap <= WIDEST_GAP);
        let other_sides = sides.overlapping(zone).filter(|side| side.path != end.edge);
        let other_sides = other_sides.map(|side| (side.segment.distance(place), side.path));
        let side = other_sides.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(gap, _)| *gap <= WIDEST_GAP);
        let (width, partner) = match (other_end, side) {
            (Some((gap, j)), side) if side.is_none_or(|(nearer, _)| gap <= nearer + join) => {
                is_paired[j] = true;
                (gap, free[j].edge)
            }
            (_, Some(nearest)) => nearest,
            _ => {
                let names = named(&network.edges[end.edge].sources, names);
                let finding = format!("{} has a free end", Quoted(&names));
                let fault = ShapeFault::new(ShapeCode::DanglingEnd, place, finding, remedy);
                faults.push(ShapeFault { names, ..fault });
                continue;
            }
        };
        if partner != end.edge && network.past(end.edge, place, partner).is_some() {
            continue;
        }
        trials += 1;
        let trial_pieces = if trials <= MOST_TRIALS { pieces } else { &[] };
        let gap = Gap { place, edge: end.edge, partner, width };
        faults.push(gap_fault(&gap, trial_pieces, network, names, join));
    }
    faults
}

/// The fault of a gap wider than `join`. The remedy names a `join` that closes it, where `pieces`, if there are any, say that it does.
fn gap_fault(gap: &Gap, pieces: &[Piece], network: &Network, names: &[String], join: f64) -> ShapeFault {
    let Gap { place, width, .. } = *gap;
    let sides = [gap.edge, gap.partner];
    let names = sides.map(|edge| named(&network.edges[edge].sources, names)).concat();
    let finding = format!("gap of {width:.4} mm in {}", Quoted(&names));
    let wider = (width * 1000.0).ceil() / 1000.0;
    let remedy = if wider <= WIDEST_JOIN && !pieces.is_empty() && is_closed_by(wider, pieces, place) {
        format!("close it in the drawing; join = \"{wider} mm\" would close it")
    } else {
        "close it in the drawing".to_owned()
    };
    let fault = ShapeFault::new(ShapeCode::Gap, place, finding, remedy);
    ShapeFault { names, found: width, allowed: join, ..fault }
}

/// Whether the gap at `place` is closed where `pieces` are joined within `join` mm.
fn is_closed_by(join: f64, pieces: &[Piece], place: Point) -> bool {
    let wider = network(pieces, join);
    wider.free_ends().iter().all(|end| wider.nodes[end.node].distance(place) > 2.0 * join)
}

/// A crossing of two edges of a network, or of one with itself.
struct EdgeCrossing {
    edges: [usize; 2],
    place: Point,
}

/// Faults where edges of a network cross, except where they are joined.
pub(super) fn crossings(network: &Network, names: &[String], join: f64) -> Vec<ShapeFault> {
    let segments = Segments::new(network.edges.iter().map(|edge| &edge.path));
    let mut list: Vec<EdgeCrossing> = Vec::new();
    for (i, part) in segments.list.iter().enumerate() {
        if list.len() >= MOST_CROSSINGS {
            break;
        }
        segments.index.visit(&part.bounds, |j| {
            if j < i {
                let other = &segments.list[j];
                let places = intersections(&part.segment, &other.segment).into_iter();
                let crossing_places = places.filter(|p| !network.is_joint([part, other], *p, join));
                list.extend(
                    crossing_places.map(|place| EdgeCrossing { edges: [other.path, part.path], place }),
                );
            }
        });
    }
    sort_by(&mut list, |a, b| {
        let (p, q) = (a.place, b.place);
        a.edges.cmp(&b.edges).then(p.x.total_cmp(&q.x)).then(p.y.total_cmp(&q.y))
    });
    list.dedup_by(|b, a| a.edges == b.edges && a.place.distance(b.place) <= 1e-6);
    list.iter().map(|crossing| crossing_fault(crossing, network, names)).collect()
}

/// The fault of edges that cross.
fn crossing_fault(crossing: &EdgeCrossing, network: &Network, names: &[String]) -> ShapeFault {
    let EdgeCrossing { edges: [a, b], place } = *crossing;
    let mut crossing_names = named(&network.edges[a].sources, names);
    if a != b {
        crossing_names.extend(named(&network.edges[b].sources, names));
    }
    let verb = if a == b { "crosses itself" } else { "cross or touch" };
    let finding = format!("{} {verb}", Quoted(&crossing_names));
    let are_closed = [a, b].iter().all(|edge| network.edges[*edge].nodes.is_none());
    let remedy = network.trimming(crossing, names).unwrap_or_else(|| {
        let remedy = match (a == b, are_closed) {
            (true, _) => "draw it without the crossing",
            (false, true) => "move them apart, or unite their areas",
            (false, false) => "move them apart",
        };
        remedy.to_owned()
    });
    let fault = ShapeFault::new(ShapeCode::Crossing, place, finding, remedy);
    ShapeFault { names: crossing_names, ..fault }
}

impl Network {
    /// Whether the edges of two segments are joined where these meet at `p`: at a node of both, or at the ends of neighbours.
    fn is_joint(&self, parts: [&PathSegment; 2], p: Point, join: f64) -> bool {
        let [a, b] = parts;
        let count = self.edges[a.path].path.segments.len();
        let steps = a.at.abs_diff(b.at);
        let follows = a.path == b.path && (steps == 1 || steps + 1 == count);
        let is_at_end = |part: &&PathSegment| {
            p.distance(part.segment.start()) <= 1e-6 || p.distance(part.segment.end()) <= 1e-6
        };
        let is_at_node = |part: &PathSegment| {
            let mut nodes = self.edges[part.path].nodes.into_iter().flatten();
            nodes.any(|node| self.nodes[node].distance(p) <= 4.0 * join)
        };
        (follows && parts.iter().all(is_at_end)) || parts.into_iter().all(is_at_node)
    }

    /// How far the end of `edge` at the node `end` lies past the curve `other` that it crosses, mm; `None` if it crosses it not, or farther
    /// away.
    fn past(&self, edge: usize, end: Point, other: usize) -> Option<f64> {
        let crossed = self.segments_near(other, end);
        let places = self.segments_near(edge, end).into_iter().flat_map(|segment| {
            crossed.iter().flat_map(|other| intersections(&segment, other)).collect::<Vec<_>>()
        });
        places.map(|p| p.distance(end)).filter(|distance| *distance <= WIDEST_GAP).reduce(f64::min)
    }

    /// The segments of `edge` within a gap's width of `place`.
    fn segments_near(&self, edge: usize, place: Point) -> Vec<Segment> {
        let zone = Bounds::of_points([place]).outset(WIDEST_GAP);
        let Path { segments, .. } = &self.edges[edge].path;
        segments.iter().filter(|segment| segment.bounds().overlaps(&zone)).copied().collect()
    }

    /// The remedy where one of two edges that cross ends a little past the other.
    fn trimming(&self, crossing: &EdgeCrossing, names: &[String]) -> Option<String> {
        let EdgeCrossing { edges: [a, b], place } = *crossing;
        let free = self.free_ends();
        let overshoots = [a, b].into_iter().filter_map(|edge| {
            let ends = free.iter().filter(|end| end.edge == edge);
            let lengths = ends.map(|end| self.nodes[end.node].distance(place));
            Some((lengths.filter(|length| *length <= WIDEST_GAP).reduce(f64::min)?, edge))
        });
        let (length, edge) = overshoots.min_by(|x, y| x.0.total_cmp(&y.0))?;
        let names = named(&self.edges[edge].sources, names);
        let is_short = self.edges[edge].path.length() <= LONGEST_MARK;
        let is_mark = is_short && a != b && free.iter().filter(|end| end.edge == edge).count() == 2;
        let port = if is_mark { "; if it marks a port, put it on a layer with the role `port`" } else { "" };
        Some(format!("trim the {length:.3} mm of {} that go past the other curve{port}", Quoted(&names)))
    }
}
