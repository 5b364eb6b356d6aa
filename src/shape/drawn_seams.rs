//! Seams that are drawn as centre lines.

use crate::shape::air::depth;
use crate::shape::around::{Layout, Line, LineUse, nearest_path, opened};
use crate::shape::edge_gaps::close_edge_gaps;
use crate::shape::fault::ShapeCode;
use crate::shape::loose::crossings;
use crate::shape::mouth::{NoChannel, ambiguous, channel};
use crate::shape::notes::{SealingNotes, named};
use crate::shape::offset::offset_right;
use crate::shape::ports::{no_channel, reason};
use crate::shape::sketch::{Rules, Sketch};
use inflatable::geom::{Bounds, BoxIndex, Enclosures, Path, Point, Segment};

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
    let names: Vec<String> = sketch.seams.iter().map(|drawn| drawn.name.clone()).collect();
    let (_, network) = notes.mended(&sketch.seams, rules.join);
    crossings(&network, &names, rules.join, notes);
    let mut closed: Vec<(Path, Vec<String>)> = Vec::new();
    let mut welds: Vec<(Path, Vec<String>)> = Vec::new();
    for edge in &network.edges {
        let own = named(&edge.sources, &names);
        if edge.nodes.is_none() {
            closed.push((edge.path.clone(), own));
        } else {
            welds.push((edge.path.clone(), own));
        }
    }
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
    let mut edges: Vec<Rim> = Vec::new();
    for ((path, names), outer) in closed.into_iter().zip(outer) {
        let path = if (path.area() > 0.0) == outer { path } else { path.reversed() };
        // The air is on the left, and begins where the band ends.
        lines.air.closed.extend(offset_right(&path, -half));
        edges.push((path, names, outer));
    }
    open_rims(sketch, rules, taken, &mut edges, lines, notes);
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

/// A drawn closed seam, its names, and whether it is an outer edge.
type Rim = (Path, Vec<String>, bool);

/// Channels through the outer edges for the ports that are not taken.
fn open_rims(
    sketch: &Sketch,
    rules: &Rules,
    taken: &mut Vec<usize>,
    edges: &mut [Rim],
    lines: &mut Layout,
    notes: &mut SealingNotes,
) {
    let (half, length) = (rules.band / 2.0, rules.band / 2.0 + rules.allowance);
    let outer = edges.iter().enumerate().filter(|(_, (_, _, outer))| *outer);
    let (outer, drawn): (Vec<usize>, Vec<Path>) = outer.map(|(at, (path, ..))| (at, path.clone())).unzip();
    let around: Vec<Bounds> = drawn.iter().map(Path::bounds).collect();
    let mut mouths = Vec::new();
    for (number, port) in sketch.ports.iter().enumerate() {
        let place = port.place.middle();
        if taken.contains(&number) {
            continue;
        }
        let Some(nearest) = nearest_path(drawn.iter().zip(around.iter().copied()), place) else { continue };
        if let Some(why) = ambiguous(&port.place, &drawn) {
            no_channel(&why, &port.name, place, rules, notes);
            continue;
        }
        let path = &mut edges[outer[nearest]].0;
        let width = rules.port_width + rules.band;
        match channel((path, &drawn[nearest]), number, &port.place, width, |_, _| length, rules.overrun + 1.0)
        {
            Ok((opened, mut mouth)) => {
                *path = opened;
                mouth.half -= half;
                taken.push(number);
                mouths.push(mouth);
            }
            Err(why) => {
                no_channel(&reason(why, place, &mouths, rules), &port.name, place, rules, notes);
            }
        }
    }
    lines.mouths.extend(mouths);
}

/// Notes which ends of welds lie on another band, within half a band of its centre line: those with two are walls.
pub(super) fn join_ends(lines: &mut [Line], band: f64) {
    let segments: Vec<(usize, usize, Segment)> = lines
        .iter()
        .enumerate()
        .flat_map(|(line, Line { path, .. })| {
            path.segments.iter().enumerate().map(move |(at, s)| (line, at, *s))
        })
        .collect();
    let index = BoxIndex::new(segments.iter().map(|(_, _, segment)| segment.bounds()));
    let reach = band / 2.0 + 1e-6;
    let counts: Vec<usize> = lines.iter().map(|line| line.path.segments.len()).collect();
    for (number, line) in lines.iter_mut().enumerate().filter(|(_, line)| line.kind == LineUse::Weld) {
        let ends = [line.path.start(), line.path.end()].map(|end| end.unwrap_or(Point::ORIGIN));
        let on = |end: Point, own: usize| {
            let near = index.overlapping(&Bounds::of_points([end]).grown(reach));
            near.into_iter().any(|i| {
                let (other, at, segment) = &segments[i];
                (*other != number || at.abs_diff(own) > 2) && segment.distance(end) <= reach
            })
        };
        line.joined = [on(ends[0], 0), on(ends[1], counts[number].saturating_sub(1))];
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
