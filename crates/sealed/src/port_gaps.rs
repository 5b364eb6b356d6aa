//! Outlines that are open where a hose goes in: the gap is closed, and the port opens it.

use crate::fault::{Noted, Quoted, Repair, SealingNotes, ShapeCode, ShapeFault, named, quoted};
use crate::mouth::{Mouth, cap};
use crate::network::{Network, NetworkEnd};
use crate::pieces::Piece;
use crate::sketch::{DrawnPort, PortPlace, Rules};
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

/// What closes outlines at ports.
pub(super) struct PortGaps {
    /// The pieces over the gaps.
    pub closings: Vec<Piece>,
    /// The mouths of necks.
    pub mouths: Vec<Mouth>,
}

/// Closes the edge over each port that lies between two free ends.
///
/// A neck as wide as the hose needs is the channel itself: a cap past its ends closes it. Another gap is closed with a straight line,
/// which the port then opens as it does any edge. A gap much wider than the hose is a fault.
pub(super) fn port_gaps(
    network: &Network,
    names: &[String],
    ports: &[DrawnPort],
    rules: &Rules,
) -> Noted<PortGaps> {
    let mut free = free_ends(network);
    let widest = 2.0 * rules.port_width + rules.band;
    let mut notes = SealingNotes::default();
    let (mut closings, mut mouths) = (Vec::new(), Vec::new());
    for (number, port) in ports.iter().enumerate() {
        let place = port.place.middle();
        let Some(pair) = nearest_two(free.iter().map(|end| end.place.distance(place))) else { break };
        let [a, b] = pair.map(|number| free[number]);
        let (ends, gap) = ([a.place, b.place], a.place.distance(b.place));
        if gap <= rules.join || !lies_between(&port.place, ends, network) {
            continue;
        }
        let edge_names = named(&[a.source, b.source], names);
        let chord = (b.place - a.place).normalized();
        let is_neck = a.leading.cross(chord).min(b.leading.cross(chord)) > NECK
            || a.leading.cross(chord).max(b.leading.cross(chord)) < -NECK;
        let path = if is_neck && (rules.port_width - rules.join..=widest).contains(&gap) {
            let (path, mouth) = cap(number, ends, [a.leading, b.leading], rules.overrun + 1.0);
            mouths.push(mouth);
            path
        } else {
            if gap <= widest {
                let edge = Quoted(&edge_names);
                let finding = format!("gap of {gap:.3} mm in {edge} at port {} closed", quoted(&port.name));
                notes.repairs.push(Repair {
                    names: edge_names,
                    place: a.place.midpoint(b.place),
                    what: finding,
                });
            } else {
                notes.faults.push(open_outline(ends, edge_names, port, widest));
            }
            Path::polyline(&ends)
        };
        closings.push(Piece { path, source: a.source });
        let [a, b] = pair;
        let _ = free.remove(a.max(b));
        let _ = free.remove(a.min(b));
    }
    (PortGaps { closings, mouths }, notes)
}

/// The free ends of `edges`.
fn free_ends(edges: &Network) -> Vec<FreeEnd> {
    let end = |free: NetworkEnd| {
        let edge = &edges.edges[free.edge];
        let path = if free.is_last { edge.path.clone() } else { edge.path.reversed() };
        let leading = path.tangent_at(path.length()).unwrap_or(Vec2::new(1.0, 0.0));
        FreeEnd { place: edges.nodes[free.node], leading, source: edge.sources[0] }
    };
    edges.free_ends().into_iter().map(end).collect()
}

/// Whether a port lies in the gap between two free ends, and on no edge: its line crosses the gap, or its middle is nearer to the middle of
/// the gap than the ends are.
fn lies_between(port: &PortPlace, ends: [Point; 2], edges: &Network) -> bool {
    let gap = Path::polyline(&ends);
    let place = port.middle();
    let in_gap = ends[0].midpoint(ends[1]).distance(place) <= gap.length() / 2.0;
    let mut paths = edges.edges.iter().map(|edge| &edge.path);
    match port {
        PortPlace::At(_) => in_gap && paths.all(|path| path.distance(place) > gap.distance(place)),
        PortPlace::Across([a, b]) => {
            let line = Segment::from(Line::new(*a, *b));
            (in_gap || is_crossed(&gap, &line)) && !paths.any(|path| is_crossed(path, &line))
        }
    }
}

/// Whether `line` crosses `path`.
fn is_crossed(path: &Path, line: &Segment) -> bool {
    path.segments.iter().any(|segment| !intersections(segment, line).is_empty())
}

/// The fault of an outline that is open at a port, farther than `widest` mm.
fn open_outline(ends: [Point; 2], names: Vec<String>, port: &DrawnPort, widest: f64) -> ShapeFault {
    let [a, b] = ends;
    let gap = a.distance(b);
    let finding = format!(
        "the outline of {} is open at X {:.3} Y {:.3} and X {:.3} Y {:.3} mm, {gap:.3} mm apart, with port {} between",
        Quoted(&names),
        a.x,
        a.y,
        b.x,
        b.y,
        quoted(&port.name)
    );
    let remedy =
        format!("close it: the port opens the edge by itself; a gap of up to {widest:.3} mm is closed there");
    let fault = ShapeFault::new(ShapeCode::Gap, a.midpoint(b), finding, remedy);
    ShapeFault { names, found: gap, allowed: widest, ..fault }
}

/// The numbers of the two least distances, the least first; `None` of fewer than two.
fn nearest_two(distances: impl Iterator<Item = f64>) -> Option<[usize; 2]> {
    let mut nearest = [(f64::INFINITY, usize::MAX); 2];
    for (number, far) in distances.enumerate() {
        if far < nearest[0].0 {
            nearest = [(far, number), nearest[0]];
        } else if far < nearest[1].0 {
            nearest[1] = (far, number);
        }
    }
    (nearest[1].1 != usize::MAX).then_some(nearest.map(|(_, number)| number))
}
