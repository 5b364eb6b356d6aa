//! Loose ends of a drawing, and curves that cross.

use crate::clean::Piece;
use crate::fault::{ShapeCode, quoted};
use crate::join::{Network, network as joined};
use crate::notes::{SealingNotes, named};
use crate::segments::{PathSegment, Segments};
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

/// Faults where an edge of the `network` of `pieces` ends in the open: a gap if another edge is near, else an end with this `remedy`. An
/// end past a curve that it crosses is left to [`crossings`].
pub(super) fn loose_ends(
    (pieces, network): (&[Piece], &Network),
    names: &[String],
    join: f64,
    remedy: &str,
    notes: &mut SealingNotes,
) {
    let mut trials = 0;
    let free = network.free_ends();
    if free.is_empty() {
        return;
    }
    let ends = BoxIndex::new(free.iter().map(|(node, ..)| Bounds::of_points([network.nodes[*node]])));
    let sides = Segments::of(network.edges.iter().map(|edge| &edge.path));
    let mut told = vec![false; free.len()];
    for (i, (node, edge, _)) in free.iter().enumerate() {
        if told[i] {
            continue;
        }
        let place = network.nodes[*node];
        let zone = Bounds::of_points([place]).grown(WIDEST_GAP);
        let far = |j: usize| network.nodes[free[j].0].distance(place);
        let other = ends.overlapping(&zone).into_iter().filter(|j| *j != i && !told[*j]);
        let other = other.min_by(|a, b| far(*a).total_cmp(&far(*b))).filter(|j| far(*j) <= WIDEST_GAP);
        let side = sides.near(zone).filter(|side| side.path != *edge);
        let side = side.map(|side| (side.segment.distance(place), side.path));
        let side = side.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(gap, _)| *gap <= WIDEST_GAP);
        let own = |edge: usize| named(&network.edges[edge].sources, names);
        let (gap, partner) = match (other, side) {
            (Some(j), side) if side.is_none_or(|(gap, _)| far(j) <= gap + join) => {
                told[j] = true;
                (far(j), free[j].1)
            }
            (_, Some((gap, partner))) => (gap, partner),
            _ => {
                let names = own(*edge);
                let what = format!("{} has a free end", quoted(&names));
                notes.fault(ShapeCode::DanglingEnd, &names, place, (what, remedy), [f64::NAN; 2]);
                continue;
            }
        };
        if partner != *edge && network.past(*edge, place, partner).is_some() {
            continue;
        }
        let both = [own(*edge), own(partner)].concat();
        let what = format!("gap of {gap:.4} mm in {}", quoted(&both));
        let would = (gap * 1000.0).ceil() / 1000.0;
        trials += 1;
        let is_closed = || {
            let other = joined(pieces, would);
            let ends = other.free_ends();
            ends.iter().all(|(node, ..)| other.nodes[*node].distance(place) > 2.0 * would)
        };
        let remedy = if would <= WIDEST_JOIN && trials <= MOST_TRIALS && is_closed() {
            format!("close it in the drawing; join = \"{would} mm\" would close it")
        } else {
            "close it in the drawing".to_owned()
        };
        notes.fault(ShapeCode::Gap, &both, place, (what, remedy), [gap, join]);
    }
}

/// Faults where edges cross, except where they are joined.
pub(super) fn crossings(network: &Network, names: &[String], join: f64, notes: &mut SealingNotes) {
    let segments = Segments::of(network.edges.iter().map(|edge| &edge.path));
    let mut told: Vec<([usize; 2], Point)> = Vec::new();
    for (i, PathSegment { path: a, at, segment: s, bounds, .. }) in segments.list.iter().enumerate() {
        if told.len() >= MOST_CROSSINGS {
            break;
        }
        segments.index.visit(bounds, |j| {
            if j >= i {
                return;
            }
            let PathSegment { path: b, at: other, segment: t, .. } = &segments.list[j];
            let count = network.edges[*a].path.segments.len();
            let steps = at.abs_diff(*other);
            let follows = a == b && (steps == 1 || steps + 1 == count);
            for p in intersections(s, t) {
                let at_end = |segment: &Segment, slack: f64| {
                    p.distance(segment.start()) <= slack || p.distance(segment.end()) <= slack
                };
                let is_node = |edge: usize| {
                    let mut nodes = network.edges[edge].nodes.into_iter().flatten();
                    nodes.any(|node| network.nodes[node].distance(p) <= 4.0 * join)
                };
                let joined = (follows && at_end(s, 1e-6) && at_end(t, 1e-6)) || (is_node(*a) && is_node(*b));
                if !joined {
                    told.push(([*b, *a], p));
                }
            }
        });
    }
    told.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.x.total_cmp(&b.1.x)).then(a.1.y.total_cmp(&b.1.y)));
    told.dedup_by(|b, a| a.0 == b.0 && a.1.distance(b.1) <= 1e-6);
    for ([a, b], place) in told {
        let mut own = named(&network.edges[a].sources, names);
        if a != b {
            own.extend(named(&network.edges[b].sources, names));
        }
        let what = format!("{} {}", quoted(&own), if a == b { "crosses itself" } else { "cross or touch" });
        let are_closed = [a, b].iter().all(|edge| network.edges[*edge].nodes.is_none());
        let remedy = trimmed(network, [a, b], place, names).unwrap_or_else(|| {
            let remedy = match (a == b, are_closed) {
                (true, _) => "draw it without the crossing",
                (false, true) => "move them apart, or unite their areas",
                (false, false) => "move them apart",
            };
            remedy.to_owned()
        });
        notes.fault(ShapeCode::Crossing, &own, place, (what, remedy), [f64::NAN; 2]);
    }
}

impl Network {
    /// How far the end of `edge` at the node `end` lies past the curve `other` that it crosses, mm; `None` if it crosses it not, or farther
    /// away.
    fn past(&self, edge: usize, end: Point, other: usize) -> Option<f64> {
        let near = |path: &Path| -> Vec<Segment> {
            let zone = Bounds::of_points([end]).grown(WIDEST_GAP);
            path.segments.iter().filter(|segment| segment.bounds().overlaps(&zone)).copied().collect()
        };
        let across = near(&self.edges[other].path);
        let met = near(&self.edges[edge].path).into_iter().flat_map(|segment| {
            across.iter().flat_map(|other| intersections(&segment, other)).collect::<Vec<_>>()
        });
        met.map(|p| p.distance(end)).filter(|far| *far <= WIDEST_GAP).reduce(f64::min)
    }
}

/// The remedy where one of the edges `ab`, which cross at `place`, ends a little past the other.
fn trimmed(network: &Network, [a, b]: [usize; 2], place: Point, names: &[String]) -> Option<String> {
    let free = network.free_ends();
    let own = |edge: usize| free.iter().filter(move |(_, of, _)| *of == edge);
    let past = |edge: usize| {
        let far = own(edge).map(|(node, ..)| network.nodes[*node].distance(place));
        far.filter(|far| *far <= WIDEST_GAP).reduce(f64::min)
    };
    let (far, edge) =
        [a, b].into_iter().filter_map(|edge| Some((past(edge)?, edge))).min_by(|x, y| x.0.total_cmp(&y.0))?;
    let name = quoted(&named(&network.edges[edge].sources, names));
    let is_short = network.edges[edge].path.length() <= LONGEST_MARK;
    let is_mark = is_short && a != b && own(edge).count() == 2;
    let port = if is_mark { "; if it marks a port, put it on a layer with the role `port`" } else { "" };
    Some(format!("trim the {far:.3} mm of {name} that go past the other curve{port}"))
}
