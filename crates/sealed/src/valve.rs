//! **Valves** in the face of a chamber: each sits in a hole of one of the two sheets.
//!
//! The **flange** of a valve is sealed to its sheet around the hole before the sheets lie on each other. A seam of the shape there would join
//! both sheets and close the valve, so there is none. The bands keep off the **rim**, the outer edge of the flange.

use crate::Valve;
use crate::air::{beside, enclosing};
use crate::fault::{ShapeCode, quoted};
use crate::layout::{Layout, Line};
use crate::notes::SealingNotes;
use crate::offset::offset_right;
use crate::outline::closed;
use crate::segments::{Approach, Segments};
use crate::separator::counterclockwise;
use crate::sketch::{Rules, Sketch};
use geom::{Enclosures, Path, Point, path_distance};

/// A valve with the names of its curves.
struct NamedValve {
    valve: Valve,
    names: Vec<String>,
    /// Whether its rim is a drawn curve.
    has_rim: bool,
}

/// A band that meets a flange.
struct FlangeBand {
    /// The number of its line.
    line: usize,
    /// The distance of its middle from the rim, mm.
    distance: f64,
    place: Point,
}

/// The valves of a sketch, and faults of those whose flange has no room in the air.
///
/// Of a flange over a band nothing else is noted: the hole may then lie on either side of it.
pub(super) fn placed_valves(
    sketch: &Sketch,
    rules: &Rules,
    layout: &Layout,
    notes: &mut SealingNotes,
) -> Vec<Valve> {
    let list = named_valves(sketch, rules, notes);
    let bands = Segments::of(layout.lines.iter().map(|line| &line.path));
    let air = Enclosures::new(&layout.closed);
    for (number, named) in list.iter().enumerate() {
        if let Some(band) = flange_band(&named.valve, &bands, &layout.lines, rules.band / 2.0) {
            note_band(named, &band, &layout.lines[band.line], rules.band / 2.0, notes);
            continue;
        }
        let (place, _) = beside(&named.valve.hole, 1e-6);
        if air.around(place).len().is_multiple_of(2) {
            let finding = format!("the valve {} lies outside of the air", quoted(&named.names));
            let remedy = "draw it inside of a chamber; a hose on the edge of one is a `port`";
            notes.fault(ShapeCode::MisplacedValve, &named.names, place, (finding, remedy), [f64::NAN; 2]);
        }
        for other in list[..number].iter().filter(|other| have_overlap(&named.valve, &other.valve)) {
            let names = [&other.names[..], &named.names].concat();
            let text = (format!("the flanges of valves {} overlap", quoted(&names)), "move them apart");
            notes.fault(ShapeCode::MisplacedValve, &names, place, text, [f64::NAN; 2]);
        }
    }
    list.into_iter().map(|named| named.valve).collect()
}

/// Notes the fault of a flange that meets the band along `line`, whose middle must lie `least` mm from the rim.
fn note_band(named: &NamedValve, band: &FlangeBand, line: &Line, least: f64, notes: &mut SealingNotes) {
    let [valve, seam] = [&named.names, &line.names].map(|names| quoted(names));
    let finding = format!("the flange of valve {valve} meets the band of {seam}");
    let smaller = if named.has_rim { "draw a smaller rim" } else { "make `flange` smaller" };
    let remedy = format!("keep its rim {least} mm from the middle of every band, or {smaller}");
    let names = [&named.names[..], &line.names].concat();
    notes.fault(ShapeCode::MisplacedValve, &names, band.place, (finding, remedy), [band.distance, least]);
}

/// Holes with their rims: a closed curve alone is a hole, one with another right inside it is the rim of that.
fn named_valves(sketch: &Sketch, rules: &Rules, notes: &mut SealingNotes) -> Vec<NamedValve> {
    let curves = closed(&sketch.valves, rules, notes);
    let enclosures = Enclosures::new(curves.iter().map(|(path, _)| path));
    let outer: Vec<Vec<usize>> = curves.iter().map(|(path, _)| enclosing(&enclosures, path)).collect();
    let mut valves = Vec::new();
    for (number, (path, names)) in curves.iter().enumerate().filter(|(number, _)| outer[*number].is_empty()) {
        let inner: Vec<usize> = (0..curves.len()).filter(|inner| outer[*inner].contains(&number)).collect();
        let (hole, names) = match inner.as_slice() {
            [] => (path, names.clone()),
            [inner] => (&curves[*inner].0, [&curves[*inner].1[..], names].concat()),
            [..] => {
                let place = path.start().unwrap_or(Point::ORIGIN);
                let finding = format!("{} curves of valves lie inside of {}", inner.len(), quoted(names));
                let remedy = "draw a valve as its hole, or as its hole and the rim of its flange around it";
                notes.fault(ShapeCode::MisplacedValve, names, place, (finding, remedy), [f64::NAN; 2]);
                continue;
            }
        };
        let (hole, has_rim) = (counterclockwise(hole), !inner.is_empty());
        let rim = if has_rim { Some(counterclockwise(path)) } else { widened(&hole, rules.flange) };
        valves.extend(rim.map(|rim| NamedValve { valve: Valve { hole, rim }, names, has_rim }));
    }
    valves
}

/// The closed counterclockwise `path` `distance` mm outside of it.
fn widened(path: &Path, distance: f64) -> Option<Path> {
    offset_right(path, distance).into_iter().max_by(|a, b| a.area().total_cmp(&b.area()))
}

/// The band of half width `half` mm along one of `lines` that meets the flange of `valve` most.
fn flange_band(valve: &Valve, bands: &Segments, lines: &[Line], half: f64) -> Option<FlangeBand> {
    let approaches = bands.approaches(&valve.rim, half);
    let too_near = approaches.filter(|approach| approach.distance < half - 1e-6);
    if let Some(Approach { distance, place, path }) =
        too_near.min_by(|a, b| a.distance.total_cmp(&b.distance))
    {
        let place = nearest_place(&valve.rim, &lines[path].path, place);
        return Some(FlangeBand { line: path, distance, place });
    }
    let starts = lines.iter().map(|line| line.path.start()).enumerate();
    let mut enclosed = starts.filter_map(|(line, start)| Some((line, start?)));
    let (line, place) = enclosed.find(|(_, start)| valve.rim.encloses(*start))?;
    Some(FlangeBand { line, distance: 0.0, place })
}

/// The point of `rim` that is nearest to `line`, from `place` on, by steps from one to the other.
fn nearest_place(rim: &Path, line: &Path, mut place: Point) -> Point {
    for _ in 0..200 {
        let Some(facing) = line.nearest(place) else { break };
        let Some(next) = rim.nearest(facing.point) else { break };
        let step = next.point.distance(place);
        place = next.point;
        if step < 1e-9 {
            break;
        }
    }
    place
}

/// Whether two flanges overlap or touch.
fn have_overlap(a: &Valve, b: &Valve) -> bool {
    let starts = [(a, b), (b, a)].map(|(inner, outer)| inner.rim.start().map(|start| (start, outer)));
    path_distance(&a.rim, &b.rim) < 1e-6
        || starts.into_iter().flatten().any(|(start, outer)| outer.rim.encloses(start))
}
