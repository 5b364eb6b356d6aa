//! **Valves** in the face of a chamber: each sits in a hole of one of the two sheets.
//!
//! The **flange** of a valve is sealed to its sheet around the hole before the sheets lie on each other. A seam of the shape there would join
//! both sheets and close the valve, so there is none. The bands keep off the **rim**, the outer edge of the flange.

use crate::Valve;
use crate::bands::{Band, Bands};
use crate::fault::{Noted, Quoted, ShapeCode, ShapeFault};
use crate::mended::NamedPath;
use crate::offset::offset_right;
use crate::regions::{enclosing, side_points};
use crate::segments::{Approach, Segments};
use crate::sketch::Rules;
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
    /// The number of the band.
    band: usize,
    /// The distance of its middle from the rim, mm.
    distance: f64,
    place: Point,
}

/// The valves along the mended `curves`, and faults of those whose flange has no room in the air.
///
/// Of a flange over a band nothing else is noted: the hole may then lie on either side of it.
pub(crate) fn placed_valves(
    curves: Noted<Vec<NamedPath>>,
    rules: &Rules,
    bands: &Bands,
) -> Noted<Vec<Valve>> {
    let (curves, mut notes) = curves;
    let (list, valve_faults) = named_valves(&curves, rules);
    notes.faults.extend(valve_faults);
    let segments = Segments::new(bands.list.iter().map(|band| &band.path));
    let air = Enclosures::new(&bands.closed);
    for (number, named) in list.iter().enumerate() {
        if let Some(meeting) = flange_band(&named.valve, &segments, &bands.list, rules.band / 2.0) {
            let band_names = &bands.list[meeting.band].names;
            notes.faults.push(flange_in_band(named, &meeting, band_names, rules.band / 2.0));
            continue;
        }
        let (place, _) = side_points(&named.valve.hole, 1e-6);
        if air.enclosing(place).len().is_multiple_of(2) {
            let finding = format!("the valve {} lies outside of the air", Quoted(&named.names));
            let remedy = "draw it inside of a chamber; a hose on the edge of one is a `port`";
            let fault = ShapeFault::new(ShapeCode::MisplacedValve, place, finding, remedy);
            notes.faults.push(ShapeFault { names: named.names.clone(), ..fault });
        }
        for other in list[..number].iter().filter(|other| have_overlap(&named.valve, &other.valve)) {
            let names = [&other.names[..], &named.names].concat();
            let finding = format!("the flanges of valves {} overlap", Quoted(&names));
            let fault = ShapeFault::new(ShapeCode::MisplacedValve, place, finding, "move them apart");
            notes.faults.push(ShapeFault { names, ..fault });
        }
    }
    (list.into_iter().map(|named| named.valve).collect(), notes)
}

/// The fault of a flange that meets the band along the curves `band_names`, whose middle must lie `least` mm from the rim.
fn flange_in_band(named: &NamedValve, meeting: &FlangeBand, band_names: &[String], limit: f64) -> ShapeFault {
    let finding =
        format!("the flange of valve {} meets the band of {}", Quoted(&named.names), Quoted(band_names));
    let smaller = if named.has_rim { "draw a smaller rim" } else { "make `flange` smaller" };
    let remedy = format!("keep its rim {limit} mm from the middle of every band, or {smaller}");
    let names = [&named.names[..], band_names].concat();
    let fault = ShapeFault::new(ShapeCode::MisplacedValve, meeting.place, finding, remedy);
    ShapeFault { names, found: meeting.distance, allowed: limit, ..fault }
}

/// Holes with their rims: a closed curve alone is a hole, one with another right inside it is the rim of that.
fn named_valves(curves: &[NamedPath], rules: &Rules) -> (Vec<NamedValve>, Vec<ShapeFault>) {
    let mut faults = Vec::new();
    let enclosures = Enclosures::new(curves.iter().map(|curve| &curve.path));
    let outer: Vec<Vec<usize>> = curves.iter().map(|curve| enclosing(&enclosures, &curve.path)).collect();
    let mut valves = Vec::new();
    for (number, curve) in curves.iter().enumerate().filter(|(number, _)| outer[*number].is_empty()) {
        let NamedPath { path, names } = curve;
        let inner: Vec<usize> = (0..curves.len()).filter(|inner| outer[*inner].contains(&number)).collect();
        let (hole, names) = match inner.as_slice() {
            [] => (path, names.clone()),
            [inner] => (&curves[*inner].path, [&curves[*inner].names[..], names].concat()),
            [..] => {
                let place = path.start().unwrap_or(Point::ORIGIN);
                let finding = format!("{} curves of valves lie inside of {}", inner.len(), Quoted(names));
                let remedy = "draw a valve as its hole, or as its hole and the rim of its flange around it";
                let fault = ShapeFault::new(ShapeCode::MisplacedValve, place, finding, remedy);
                faults.push(ShapeFault { names: names.clone(), ..fault });
                continue;
            }
        };
        let (hole, has_rim) = (hole.counterclockwise(), !inner.is_empty());
        let rim = if has_rim { Some(path.counterclockwise()) } else { widened(&hole, rules.flange) };
        valves.extend(rim.map(|rim| NamedValve { valve: Valve { hole, rim }, names, has_rim }));
    }
    (valves, faults)
}

/// The closed counterclockwise `path` `distance` mm outside of it.
fn widened(path: &Path, distance: f64) -> Option<Path> {
    offset_right(path, distance).into_iter().max_by(|a, b| a.area().total_cmp(&b.area()))
}

/// The one of `bands` of half width `half` mm that meets the flange of `valve` most. `segments` are those of their centre lines.
fn flange_band(valve: &Valve, segments: &Segments, bands: &[Band], half: f64) -> Option<FlangeBand> {
    let approaches = segments.approaches(&valve.rim, half);
    let too_near = approaches.filter(|approach| approach.distance < half - 1e-6);
    if let Some(Approach { distance, place, path }) =
        too_near.min_by(|a, b| a.distance.total_cmp(&b.distance))
    {
        let place = nearest_place(&valve.rim, &bands[path].path, place);
        return Some(FlangeBand { band: path, distance, place });
    }
    let starts = bands.iter().map(|band| band.path.start()).enumerate();
    let mut enclosed = starts.filter_map(|(band, start)| Some((band, start?)));
    let (band, place) = enclosed.find(|(_, start)| valve.rim.encloses(*start))?;
    Some(FlangeBand { band, distance: 0.0, place })
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
