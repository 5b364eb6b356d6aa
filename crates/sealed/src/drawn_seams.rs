//! Seams that are drawn as centre lines.

use crate::air::depth;
use crate::around::opened;
use crate::edge_gaps::close_edge_gaps;
use crate::fault::ShapeCode;
use crate::join::NetworkEdge;
use crate::layout::{Layout, Line, LineUse};
use crate::loose::crossings;
use crate::mouth::NoChannel;
use crate::notes::{SealingNotes, named};
use crate::offset::offset_right;
use crate::ports::{Opening, no_channel, open_ports};
use crate::segments::Segments;
use crate::sketch::{Rules, Sketch};
use geom::{Enclosures, Path, Point};

/// The drawn seams beside `lines`: closed ones are edges of the air, open ones walls if both ends lie on bands, else welds.
pub(super) fn drawn_seams(
    sketch: &Sketch,
    rules: &Rules,
    taken: &mut Vec<usize>,
    lines: &mut Layout,
    notes: &mut SealingNotes,
) {
    if sketch.seams.is_empty() {
        return;
    }
    let (pieces, names) = notes.mended_pieces(&sketch.seams, rules.join);
    let pieces = notes.split_at_crossings(pieces, &names, rules.join);
    let network = notes.joined(&pieces, &names, rules.join);
    crossings(&network, &names, rules.join, notes);
    let (closed, welds): (Vec<NetworkEdge>, _) =
        network.edges.into_iter().partition(|edge| edge.nodes.is_none());
    let with_names = |edge: NetworkEdge| (edge.path, named(&edge.sources, &names));
    let closed: Vec<(Path, Vec<String>)> = closed.into_iter().map(with_names).collect();
    let mut welds: Vec<(Path, Vec<String>)> = welds.into_iter().map(with_names).collect();
    close_edge_gaps(&mut welds, lines, rules, notes);
    for (path, names) in welds {
        lines.air.seams.push(path.clone());
        lines.lines.push(Line { path, names, kind: LineUse::Weld, joined: [false; 2] });
    }
    let all: Vec<&Path> =
        closed.iter().map(|(path, _)| path).chain(lines.edges.iter().map(|(path, _)| path)).collect();
    let around = Enclosures::new(all.iter().copied());
    let outer: Vec<bool> = closed.iter().map(|(path, _)| depth(&around, path).is_multiple_of(2)).collect();
    let (half, length) = (rules.band / 2.0, rules.band / 2.0 + rules.allowance);
    // Each with its names, and whether it is an outer edge.
    let mut edges: Vec<(Path, Vec<String>, bool)> = Vec::new();
    for ((path, names), outer) in closed.into_iter().zip(outer) {
        let path = if (path.area() > 0.0) == outer { path } else { path.reversed() };
        // The air is on the left, and begins where the band ends.
        lines.air.closed.extend(offset_right(&path, -half));
        edges.push((path, names, outer));
    }
    let outlines = edges.iter_mut().filter(|(.., outer)| *outer).map(|(path, ..)| path).collect();
    let opening = Opening { half, length, may_wait: false };
    let mut mouths = Vec::new();
    open_ports(sketch, rules, &opening, outlines, &mut mouths, taken, notes);
    lines.mouths.extend(mouths);
    for (path, names, outer) in edges {
        let kind = if outer { LineUse::Outer } else { LineUse::Island };
        lines.closed.push(path.clone());
        lines.air.edges.extend(offset_right(&path, -half));
        for path in opened(path.clone(), &lines.mouths, rules, half) {
            lines.lines.push(Line { path, names: names.clone(), kind, joined: [false; 2] });
        }
        if outer {
            lines.edges.push((path, length));
        }
    }
}

/// Notes which ends of welds lie on another band, within half a band of its centre line: those with two are walls.
pub(super) fn join_ends(lines: &mut [Line], band: f64) {
    let segments = Segments::of(lines.iter().map(|line| &line.path));
    let reach = band / 2.0 + 1e-6;
    for (number, line) in lines.iter_mut().enumerate().filter(|(_, line)| line.kind == LineUse::Weld) {
        let ends = [line.path.start(), line.path.end()].map(|end| end.unwrap_or(Point::ORIGIN));
        line.joined =
            [0, 1].map(|which| segments.has_joint((number, &line.path), ends[which], which == 0, reach));
        if line.joined == [true; 2] {
            line.kind = LineUse::Wall;
        }
    }
}

/// Faults of ports that no edge took.
pub(super) fn lost_ports(sketch: &Sketch, rules: &Rules, taken: &[usize], notes: &mut SealingNotes) {
    for (number, port) in sketch.ports.iter().enumerate() {
        let known = notes.faults.iter().any(|fault| {
            [ShapeCode::LostPort, ShapeCode::PortTooWide].contains(&fault.code)
                && fault.names == [port.name.as_str()]
        });
        if !taken.contains(&number) && !known {
            no_channel(&NoChannel::Far(f64::INFINITY), &port.name, port.place.middle(), rules, notes);
        }
    }
}
