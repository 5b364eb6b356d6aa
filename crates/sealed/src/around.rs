//! From a sketch to a sealed shape: the drawing is mended, seams run half a band outside the air's edges, the cut outside of the bands.

use crate::AirSide;
use crate::air::{Air, Boundary, Wall, air};
use crate::clean::{NOTHING, Piece, without_doubles};
use crate::fabric::necks;
use crate::fault::{ShapeCode, quoted};
use crate::join::network;
use crate::layout::{Layout, Line, LineUse};
use crate::loose::{crossings, loose_ends};
use crate::mouth::{Mouth, ON_SIDE};
use crate::notes::{SealingNotes, named};
use crate::offset::{CenterLines, center_lines};
use crate::open_ends::closed_at_ports;
use crate::ports::{Opening, open_ports};
use crate::sketch::{Rules, Sketch};
use geom::{Path, Point};

/// The centre lines of the bands around the drawn air. Empty where the drawing has faults.
pub(super) fn around_air(
    sketch: &Sketch,
    rules: &Rules,
    taken: &mut Vec<usize>,
    notes: &mut SealingNotes,
) -> Layout {
    let (mut pieces, mut edges, names) = notes.mended(&sketch.air, rules.join);
    let before = notes.faults.len();
    let piece_count = pieces.len();
    let mut mouths = closed_at_ports(sketch, rules, &edges, &mut pieces, &names, notes);
    if pieces.len() > piece_count {
        edges = network(&pieces, rules.join);
        taken.extend(mouths.iter().map(|mouth| mouth.port));
    }
    let weld = "close it, or put it on a layer of seams if it is a weld that ends in the air";
    loose_ends((&pieces, &edges), &names, rules.join, weld, notes);
    crossings(&edges, &names, rules.join, notes);
    if notes.faults.len() > before {
        return Layout::default();
    }
    let drawn = sketch.air.iter().enumerate();
    let rings: Vec<(usize, &Path)> =
        drawn.filter(|(_, drawn)| drawn.path.closed).map(|(i, drawn)| (i, &drawn.path)).collect();
    let mut air = air(&edges, &rings, &names, rules.join, &mut notes.faults);
    let (half, length) = (rules.band / 2.0, rules.band + rules.allowance);
    let of_air = air.boundaries.iter().map(|boundary| boundary.path.clone()).collect();
    let outer = air.boundaries.iter_mut().filter(|boundary| boundary.outer);
    // Perhaps a drawn seam is nearer to a port.
    let opening = Opening { half: 0.0, length, may_wait: !sketch.seams.is_empty() };
    let outlines = outer.map(|boundary| &mut boundary.path).collect();
    open_ports(sketch, rules, &opening, outlines, &mut mouths, taken, notes);
    necks((&air, &mouths), sketch, rules, &names, notes);
    if notes.faults.iter().any(|fault| fault.code == ShapeCode::Crowded) {
        return Layout::default();
    }
    let (offset, spines) = offsets(&air, rules, &names, notes);
    if notes.faults.len() > before {
        return Layout::default();
    }
    let (boundaries, walls) = one_band_a_wall(offset, &names, rules, notes);
    // Distances outwards add up: the cut may follow the centre lines where edges were united.
    let (followed, by) =
        if walls.is_empty() { (&air.boundaries, length) } else { (&boundaries, length - half) };
    let outer = followed.iter().filter(|boundary| boundary.outer);
    let edges = outer.map(|boundary| (boundary.path.clone(), by)).collect();
    let (mut lines, mut closed) = (Vec::new(), Vec::new());
    for Boundary { path, sources, outer } in boundaries {
        closed.push(path.clone());
        let kind = if outer { LineUse::Outer } else { LineUse::Island };
        let names = named(&sources, &names);
        for path in opened(path, &mouths, rules, half) {
            lines.push(Line { path, names: names.clone(), kind, joined: [false; 2] });
        }
    }
    let drawn: Vec<Wall> = air.walls.into_iter().map(|wall| lengthened(wall, half)).collect();
    let side = AirSide {
        edges: air.boundaries.into_iter().map(|boundary| boundary.path).collect(),
        closed: of_air,
        seams: drawn.iter().map(|wall| wall.path.clone()).collect(),
        ..AirSide::default()
    };
    for Wall { path, sources, .. } in drawn.into_iter().chain(walls) {
        lines.push(Line { path, names: named(&sources, &names), kind: LineUse::Wall, joined: [true; 2] });
    }
    for Wall { path, sources, .. } in spines {
        lines.push(Line { path, names: named(&sources, &names), kind: LineUse::Weld, joined: [false; 2] });
    }
    Layout { lines, closed, edges, mouths, air: side }
}

/// The centre lines of the boundaries' bands, and the spines of slots and islands that are as wide as a band.
fn offsets(
    air: &Air,
    rules: &Rules,
    names: &[String],
    notes: &mut SealingNotes,
) -> (Vec<Boundary>, Vec<Wall>) {
    let (half, both) = (rules.band / 2.0, 2.0 * rules.band);
    let (mut lines, mut walls) = (Vec::new(), Vec::new());
    for Boundary { path, sources, outer } in &air.boundaries {
        let own = named(sources, names);
        let place = path.start().unwrap_or(Point::ORIGIN);
        let CenterLines { loops, spines } = center_lines(path, half, rules.join);
        let is_spine = loops.is_empty() && !spines.is_empty();
        let spine = |path| Wall { path, sources: sources.clone(), on_boundary: [false; 2] };
        walls.extend(spines.into_iter().map(spine));
        let same_turn = loops.iter().filter(|line| (line.area() > 0.0) == *outer).count();
        match loops.as_slice() {
            [one] if same_turn == 1 => {
                lines.push(Boundary { path: one.clone(), sources: sources.clone(), outer: *outer });
            }
            [] if is_spine => {}
            [] => {
                let bounds = path.bounds();
                let size = bounds.width().min(bounds.height());
                let what = format!("island {} of {size:.3} mm has no room for a band around", quoted(&own));
                let remedy = format!("make it at least {both} mm wide, or draw a seam along its middle");
                notes.fault(ShapeCode::NoRoom, &own, bounds.center(), (what, remedy), [size, both]);
            }
            _ => {
                let known = notes.faults.iter().any(|fault| {
                    let is_overlap =
                        matches!(fault.code, ShapeCode::BandsOverlap | ShapeCode::ChannelOverlap);
                    is_overlap && fault.names.iter().any(|name| own.contains(name))
                });
                if !known {
                    let what = format!("the band along {} falls into {} loops", quoted(&own), loops.len());
                    let text = (what, "make the fabric between its edges wider");
                    notes.fault(ShapeCode::BandsOverlap, &own, place, text, [f64::NAN, both]);
                }
            }
        }
    }
    (lines, walls)
}

/// Boundaries and walls where two bands lie on each other: that stretch is one wall.
fn one_band_a_wall(
    offset: Vec<Boundary>,
    names: &[String],
    rules: &Rules,
    notes: &mut SealingNotes,
) -> (Vec<Boundary>, Vec<Wall>) {
    let closed: Vec<(usize, &Path)> = offset.iter().map(|boundary| &boundary.path).enumerate().collect();
    let pieces = closed.iter().map(|(source, path)| Piece { path: (*path).clone(), source: *source });
    let (pieces, doubled) = notes.unless_crowded(without_doubles(pieces.collect(), rules.join));
    if doubled.is_empty() {
        return (offset, Vec::new());
    }
    let network = network(&pieces, 2.0 * rules.join);
    let own: Vec<String> = offset.iter().map(|boundary| named(&boundary.sources, names).join("+")).collect();
    let found = air(&network, &closed, &own, rules.join, &mut notes.faults);
    let back = |sources: Vec<usize>| {
        let mut all: Vec<usize> = sources.iter().flat_map(|source| offset[*source].sources.clone()).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    let Air { boundaries, walls } = found;
    let boundaries = boundaries.into_iter().map(|edge| Boundary { sources: back(edge.sources), ..edge });
    let walls = walls.into_iter().map(|wall| Wall { sources: back(wall.sources), ..wall });
    (boundaries.collect(), walls.collect())
}

/// A wall that ends on an edge goes on to the centre line of the band along that edge.
fn lengthened(wall: Wall, by: f64) -> Wall {
    let mut segments = wall.path.segments.clone();
    let (Some(start), Some(end)) = (wall.path.start(), wall.path.end()) else { return wall };
    let length = wall.path.length();
    let line = |a: Point, b: Point| geom::Line::new(a, b).into();
    if let (true, Some(tangent)) = (wall.on_boundary[0], wall.path.tangent_at(0.0)) {
        segments.insert(0, line(start - tangent * by, start));
    }
    if let (true, Some(tangent)) = (wall.on_boundary[1], wall.path.tangent_at(length)) {
        segments.push(line(end, end + tangent * by));
    }
    let path = crate::merge::merged(&Path { segments, closed: wall.path.closed });
    Wall { path, ..wall }
}

/// The closed centre line `path` without the parts past its mouths, `half` mm outside the air's edges.
pub(super) fn opened(path: Path, mouths: &[Mouth], rules: &Rules, half: f64) -> Vec<Path> {
    let around = path.bounds().grown(ON_SIDE);
    let mut parts = vec![path];
    for mouth in mouths {
        let across = mouth.half + half;
        let sides = [across, -across].map(|side| mouth.point(rules.overrun, side));
        if !sides.iter().all(|side| around.contains(*side)) {
            continue;
        }
        let on = |path: &Path| sides.iter().all(|side| path.distance(*side) < ON_SIDE);
        let Some(at) = parts.iter().position(on) else { continue };
        let part = parts.swap_remove(at);
        if part.closed {
            parts.extend(mouth.open(&part, rules.overrun, across));
            continue;
        }
        let [a, b] = sides.map(|side| part.nearest(side).map_or(0.0, |nearest| nearest.s));
        parts.push(part.part(0.0, a.min(b)));
        parts.push(part.part(a.max(b), part.length()));
    }
    parts.retain(|path| path.length() > NOTHING);
    parts
}
