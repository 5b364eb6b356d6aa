//! Outlines that are open where a hose goes in: the gap is closed, and the port opens it.

use crate::clean::Piece;
use crate::fault::{Repair, ShapeCode, ShapeFault, quoted};
use crate::join::Network;
use crate::mouth::{Mouth, cap};
use crate::notes::{SealingNotes, named};
use crate::sketch::{PortPlace, Rules, Sketch};
use geom::{Line, Path, Point, Segment, Vec2, intersections};

/// Least sine of the angle between the ends of a neck and the line across them: 45 degrees.
const NECK: f64 = 0.7;

/// A free end of an edge: its place, the way that the edge leads there, and a curve of it.
#[derive(Clone, Copy)]
struct FreeEnd {
    place: Point,
    leading: Vec2,
    source: usize,
}

/// Closes the edge over each port that lies between two free ends.
///
/// A neck as wide as the hose needs is the channel itself: a cap past its ends closes it. Another gap is closed with a straight line,
/// which the port then opens as it does any edge. A gap much wider than the hose is a fault.
pub(super) fn closed_at_ports(
    sketch: &Sketch,
    rules: &Rules,
    edges: &Network,
    pieces: &mut Vec<Piece>,
    names: &[String],
    notes: &mut SealingNotes,
) -> Vec<Mouth> {
    let mut free = free_ends(edges);
    let widest = 2.0 * rules.port_width + rules.band;
    let mut mouths = Vec::new();
    for (port, drawn) in sketch.ports.iter().enumerate() {
        let place = drawn.place.middle();
        let Some(pair) = nearest_two(free.iter().map(|end| end.place.distance(place))) else { break };
        let [a, b] = pair.map(|number| free[number]);
        let gap = a.place.distance(b.place);
        if gap <= rules.join || !lies_between(&drawn.place, [a.place, b.place], edges) {
            continue;
        }
        let edge_names = named(&[a.source, b.source], names);
        let across = (b.place - a.place).normalized();
        let is_neck = a.leading.cross(across).min(b.leading.cross(across)) > NECK
            || a.leading.cross(across).max(b.leading.cross(across)) < -NECK;
        let path = if is_neck && (rules.port_width - rules.join..=widest).contains(&gap) {
            let (path, mouth) = cap(port, [a.place, b.place], [a.leading, b.leading], rules.overrun + 1.0);
            mouths.push(mouth);
            path
        } else {
            let port_name = quoted(std::slice::from_ref(&drawn.name));
            if gap <= widest {
                let what =
                    format!("gap of {gap:.3} mm in {} at port {port_name} closed", quoted(&edge_names));
                notes.repairs.push(Repair { names: edge_names, place: a.place.midpoint(b.place), what });
            } else {
                notes.faults.push(open_outline([a.place, b.place], &edge_names, &port_name, widest));
            }
            Path::through(&[a.place, b.place])
        };
        pieces.push(Piece { path, source: a.source });
        let [a, b] = pair;
        let _ = free.remove(a.max(b));
        let _ = free.remove(a.min(b));
    }
    mouths
}

/// The free ends of `edges`.
fn free_ends(edges: &Network) -> Vec<FreeEnd> {
    let end = |(node, edge, which): (usize, usize, usize)| {
        let edge = &edges.edges[edge];
        let path = if which == 0 { edge.path.reversed() } else { edge.path.clone() };
        let leading = path.tangent_at(path.length()).unwrap_or(Vec2::new(1.0, 0.0));
        FreeEnd { place: edges.nodes[node], leading, source: edge.sources[0] }
    };
    edges.free_ends().into_iter().map(end).collect()
}

/// Whether a port lies in the gap between two free ends, and on no edge: its line crosses the gap, or its middle is nearer to the middle of
/// the gap than the ends are.
fn lies_between(port: &PortPlace, ends: [Point; 2], edges: &Network) -> bool {
    let gap = Path::through(&ends);
    let place = port.middle();
    let in_gap = ends[0].midpoint(ends[1]).distance(place) <= gap.length() / 2.0;
    let mut paths = edges.edges.iter().map(|edge| &edge.path);
    match port {
        PortPlace::At(_) => in_gap && paths.all(|path| path.distance(place) > gap.distance(place)),
        PortPlace::Across([a, b]) => {
            let line = Segment::from(Line::new(*a, *b));
            let is_crossed =
                |path: &Path| path.segments.iter().any(|segment| !intersections(segment, &line).is_empty());
            (in_gap || is_crossed(&gap)) && !paths.any(is_crossed)
        }
    }
}

/// The fault of an outline that is open at a port, farther than `widest` mm.
fn open_outline(ends: [Point; 2], names: &[String], port: &str, widest: f64) -> ShapeFault {
    let [a, b] = ends;
    let gap = a.distance(b);
    let what = format!(
        "the outline of {} is open at X {:.3} Y {:.3} and X {:.3} Y {:.3} mm, {gap:.3} mm apart, with port {port} between",
        quoted(names),
        a.x,
        a.y,
        b.x,
        b.y
    );
    let remedy =
        format!("close it: the port opens the edge by itself; a gap of up to {widest:.3} mm is closed there");
    ShapeFault::new(ShapeCode::Gap, names, a.midpoint(b), (what, remedy), [gap, widest])
}

/// The numbers of the two least distances, the least first; `None` of fewer than two.
fn nearest_two(distances: impl Iterator<Item = f64>) -> Option<[usize; 2]> {
    let mut least = [(f64::INFINITY, usize::MAX); 2];
    for (number, far) in distances.enumerate() {
        if far < least[0].0 {
            least = [(far, number), least[0]];
        } else if far < least[1].0 {
            least[1] = (far, number);
        }
    }
    (least[1].1 != usize::MAX).then_some(least.map(|(_, number)| number))
}
