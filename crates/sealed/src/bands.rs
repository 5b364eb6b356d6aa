//! The fourth pass, from opened regions to **bands**: seams run half a band outside the edges of the air, and the cut outside of the bands.
//!
//! Drawn seams are centre lines already, and join the bands around the air.

use crate::AirSide;
use crate::center_lines::{CenterLines, center_lines};
use crate::doubles::without_doubles;
use crate::fabric::{FabricSketch, narrow_fabric};
use crate::fault::{Noted, Quoted, SealingNotes, ShapeCode, ShapeFault, named};
use crate::mouth::{Mouth, ON_SIDE};
use crate::network::network;
use crate::offset_graph::merged;
use crate::pieces::{NOTHING, Piece};
use crate::ports::OpenedRegions;
use crate::regions::{Boundary, Regions, Wall, regions};
use crate::sketch::Rules;
use geom::{Line, Path, Point};

/// A band before it is a seam.
#[derive(Clone, Debug)]
pub(crate) struct Band {
    /// The centre line.
    pub path: Path,
    /// The names of the drawn curves that it comes from.
    pub names: Vec<String>,
    pub kind: BandKind,
    /// Whether its start and end lie on another band.
    pub joined: [bool; 2],
}

impl Band {
    /// Whether an end that lies on another band is within `reach` mm of `p`.
    pub(crate) fn is_joined_at(&self, p: Point, reach: f64) -> bool {
        let mut ends = [self.path.start(), self.path.end()].into_iter().zip(self.joined);
        ends.any(|(end, is_joined)| is_joined && end.is_some_and(|end| end.distance(p) <= reach))
    }
}

/// The purpose of a band.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum BandKind {
    /// An open weld that ends in the air.
    Weld,
    /// A wall between chambers.
    Wall,
    /// The edge of an island.
    Island,
    /// The outer edge of the air.
    Outer,
}

impl BandKind {
    /// Whether the band lies within the air.
    pub(crate) fn is_inner(self) -> bool {
        matches!(self, Self::Weld | Self::Wall)
    }
}

/// A closed edge that the cut follows.
pub(crate) struct FollowedEdge {
    pub path: Path,
    /// Distance of the cut outside the edge, mm.
    pub distance: f64,
}

/// Bands, and the region that they enclose.
#[derive(Default)]
pub(crate) struct Bands {
    pub list: Vec<Band>,
    /// The closed centre lines before ports open them.
    pub closed: Vec<Path>,
    pub cut_edges: Vec<FollowedEdge>,
    pub mouths: Vec<Mouth>,
    pub air: AirSide,
    /// The numbers of the ports that edges have taken, with a channel or with a fault.
    pub taken_ports: Vec<usize>,
}

/// The bands around the air of `opened`, whose curves have `names`. There are none where the air has faults; `earlier` are those of the
/// passes before.
///
/// Fabric between edges must have room for the bands first. Where two bands lie on each other, they are then one wall. Last, ports open
/// the closed centre lines.
pub(crate) fn bands_around(
    opened: OpenedRegions,
    names: &[String],
    sketch: &FabricSketch<'_>,
    rules: &Rules,
    earlier: &[ShapeFault],
) -> Noted<Bands> {
    let mut notes = narrow_fabric(&opened, names, sketch, rules);
    let no_bands = Bands { taken_ports: opened.taken_ports.clone(), ..Bands::default() };
    let faults = [earlier, &notes.faults].concat();
    if faults.iter().any(|fault| fault.code == ShapeCode::Crowded) {
        return (no_bands, notes);
    }
    let (CenterBoundaries { boundaries: offset, spines }, pass_notes) =
        center_boundaries(&opened.regions, rules, names, &faults);
    notes += pass_notes;
    if earlier.iter().chain(&notes.faults).any(|fault| fault.code != ShapeCode::NotFinite) {
        return (no_bands, notes);
    }
    let OpenedRegions { regions: air, closed: air_edges, mouths, taken_ports } = opened;
    let (half, length) = (rules.band / 2.0, rules.band + rules.allowance);
    let (Regions { boundaries, walls }, pass_notes) = one_band_a_wall(offset, names, rules);
    notes += pass_notes;
    // Distances outwards add up: the cut may follow the centre lines where edges were united.
    let (followed, distance) =
        if walls.is_empty() { (&air.boundaries, length) } else { (&boundaries, length - half) };
    let outer = followed.iter().filter(|boundary| boundary.outer);
    let cut_edges = outer.map(|boundary| FollowedEdge { path: boundary.path.clone(), distance }).collect();
    let closed = boundaries.iter().map(|boundary| boundary.path.clone()).collect();
    let mut list: Vec<Band> = Vec::new();
    for Boundary { path, sources, outer } in boundaries {
        let kind = if outer { BandKind::Outer } else { BandKind::Island };
        list.extend(opened_bands(path, &named(&sources, names), kind, &mouths, rules));
    }
    let drawn_walls: Vec<Wall> = air.walls.into_iter().map(|wall| lengthened(wall, half)).collect();
    let side = AirSide {
        edges: air.boundaries.into_iter().map(|boundary| boundary.path).collect(),
        closed: air_edges,
        seams: drawn_walls.iter().map(|wall| wall.path.clone()).collect(),
        ..AirSide::default()
    };
    let wall_bands = drawn_walls.into_iter().chain(walls);
    list.extend(wall_bands.map(|wall| wall.into_band(BandKind::Wall, names)));
    list.extend(spines.into_iter().map(|spine| spine.into_band(BandKind::Weld, names)));
    (Bands { list, closed, cut_edges, mouths, air: side, taken_ports }, notes)
}

impl Wall {
    /// The band along the wall, which is joined to others unless it is a weld.
    fn into_band(self, kind: BandKind, names: &[String]) -> Band {
        let names = named(&self.sources, names);
        Band { path: self.path, names, kind, joined: [kind == BandKind::Wall; 2] }
    }
}

/// The centre lines of the bands along boundaries.
#[derive(Default)]
struct CenterBoundaries {
    boundaries: Vec<Boundary>,
    /// Open ones along slots and islands that are as wide as a band.
    spines: Vec<Wall>,
}

/// The centre lines of the boundaries' bands, and the spines of slots and islands that are as wide as a band. `earlier` are the faults of
/// the passes before: an overlap that they tell is not told again.
///
/// The offset of a boundary is one loop with the turn of the boundary. A boundary without one has no room for its band; one that falls into
/// several comes too near to itself.
fn center_boundaries(
    regions: &Regions,
    rules: &Rules,
    names: &[String],
    earlier: &[ShapeFault],
) -> Noted<CenterBoundaries> {
    let (half, two_bands) = (rules.band / 2.0, 2.0 * rules.band);
    let mut notes = SealingNotes::default();
    let mut centers = CenterBoundaries::default();
    for Boundary { path, sources, outer } in &regions.boundaries {
        let names = named(sources, names);
        let CenterLines { loops, spines } = center_lines(path, half, rules.join);
        let is_spine = loops.is_empty() && !spines.is_empty();
        let spine = |path| Wall { path, sources: sources.clone(), on_boundary: [false; 2] };
        centers.spines.extend(spines.into_iter().map(spine));
        let same_turn = loops.iter().filter(|line| (line.area() > 0.0) == *outer).count();
        match loops.as_slice() {
            [center] if same_turn == 1 => {
                let sources = sources.clone();
                centers.boundaries.push(Boundary { path: center.clone(), sources, outer: *outer });
            }
            [] if is_spine => {}
            [] => notes.faults.push(no_room(path, names, two_bands)),
            _ => {
                let is_known = earlier.iter().chain(&notes.faults).any(|fault| {
                    let is_overlap =
                        matches!(fault.code, ShapeCode::BandsOverlap | ShapeCode::ChannelOverlap);
                    is_overlap && fault.names.iter().any(|name| names.contains(name))
                });
                if !is_known {
                    let place = path.start().unwrap_or(Point::ORIGIN);
                    let finding =
                        format!("the band along {} falls into {} loops", Quoted(&names), loops.len());
                    let remedy = "make the fabric between its edges wider";
                    let fault = ShapeFault::new(ShapeCode::BandsOverlap, place, finding, remedy);
                    notes.faults.push(ShapeFault { names, allowed: two_bands, ..fault });
                }
            }
        }
    }
    (centers, notes)
}

/// The fault of an island that is narrower than two bands.
fn no_room(island: &Path, names: Vec<String>, two_bands: f64) -> ShapeFault {
    let bounds = island.bounds();
    let size = bounds.width().min(bounds.height());
    let finding = format!("island {} of {size:.3} mm has no room for a band around", Quoted(&names));
    let remedy = format!("make it at least {two_bands} mm wide, or draw a seam along its middle");
    let fault = ShapeFault::new(ShapeCode::NoRoom, bounds.center(), finding, remedy);
    ShapeFault { names, found: size, allowed: two_bands, ..fault }
}

/// The centre lines `offset` as boundaries and walls: where two bands lie on each other, that stretch is one wall.
fn one_band_a_wall(offset: Vec<Boundary>, names: &[String], rules: &Rules) -> Noted<Regions> {
    let mut notes = SealingNotes::default();
    let lines: Vec<(usize, Path)> = offset.iter().map(|boundary| boundary.path.clone()).enumerate().collect();
    let pieces = lines.iter().map(|(source, path)| Piece { path: path.clone(), source: *source });
    let (pieces, doubled) = notes.unless_crowded(without_doubles(pieces.collect(), rules.join));
    if doubled.is_empty() {
        return (Regions { boundaries: offset, walls: Vec::new() }, notes);
    }
    let line_network = network(&pieces, 2.0 * rules.join);
    let line_names: Vec<String> =
        offset.iter().map(|boundary| named(&boundary.sources, names).join("+")).collect();
    let (mut united, pass_notes) = regions(&line_network, &lines, &line_names, rules.join);
    notes += pass_notes;
    for boundary in &mut united.boundaries {
        boundary.sources = sources_of(&boundary.sources, &offset);
    }
    for wall in &mut united.walls {
        wall.sources = sources_of(&wall.sources, &offset);
    }
    (united, notes)
}

/// The drawn curves of the lines with `numbers` in `offset`.
fn sources_of(numbers: &[usize], offset: &[Boundary]) -> Vec<usize> {
    let mut sources: Vec<usize> = numbers.iter().flat_map(|number| offset[*number].sources.clone()).collect();
    sources.sort_unstable();
    sources.dedup();
    sources
}

/// A wall that ends on an edge goes on to the centre line of the band along that edge, `distance` mm farther.
fn lengthened(wall: Wall, distance: f64) -> Wall {
    let mut segments = wall.path.segments.clone();
    let (Some(start), Some(end)) = (wall.path.start(), wall.path.end()) else { return wall };
    let length = wall.path.length();
    if let (true, Some(tangent)) = (wall.on_boundary[0], wall.path.tangent_at(0.0)) {
        segments.insert(0, Line::new(start - tangent * distance, start).into());
    }
    if let (true, Some(tangent)) = (wall.on_boundary[1], wall.path.tangent_at(length)) {
        segments.push(Line::new(end, end + tangent * distance).into());
    }
    let path = merged(&Path { segments, closed: wall.path.closed });
    Wall { path, ..wall }
}

/// The bands along the closed centre line `path`, half a band outside the edges of the air, without the parts past its mouths.
pub(super) fn opened_bands(
    path: Path,
    names: &[String],
    kind: BandKind,
    mouths: &[Mouth],
    rules: &Rules,
) -> Vec<Band> {
    let bounds = path.bounds().outset(ON_SIDE);
    let mut parts = vec![path];
    for mouth in mouths {
        let lateral = mouth.half + rules.band / 2.0;
        let sides = [lateral, -lateral].map(|side| mouth.point(rules.overrun, side));
        if !sides.iter().all(|side| bounds.contains(*side)) {
            continue;
        }
        let has_sides = |path: &Path| sides.iter().all(|side| path.distance(*side) < ON_SIDE);
        let Some(number) = parts.iter().position(has_sides) else { continue };
        let part = parts.swap_remove(number);
        if part.closed {
            parts.extend(mouth.open(&part, rules.overrun, lateral));
            continue;
        }
        let [a, b] = sides.map(|side| part.nearest(side).map_or(0.0, |nearest| nearest.s));
        parts.push(part.part(0.0, a.min(b)));
        parts.push(part.part(a.max(b), part.length()));
    }
    parts.retain(|path| path.length() > NOTHING);
    let band = |path| Band { path, names: names.to_vec(), kind, joined: [false; 2] };
    parts.into_iter().map(band).collect()
}
