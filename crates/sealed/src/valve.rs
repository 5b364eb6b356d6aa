//! **Valves** in the face of a chamber: each sits in a hole of one of the two sheets.
//!
//! The **flange** of a valve is sealed to its sheet around the hole before the sheets lie on each other. A seam of the shape there would join
//! both sheets and close the valve, so there is none. The bands keep off the **rim**, the outer edge of the flange.

use crate::Valve;
use crate::air::{beside, enclosing};
use crate::fault::{ShapeCode, quoted};
use crate::layout::Layout;
use crate::notes::SealingNotes;
use crate::offset::offset_right;
use crate::outline::closed;
use crate::segments::{Approach, Segments};
use crate::separator::counterclockwise;
use crate::sketch::{Rules, Sketch};
use geom::{Enclosures, Point, path_distance};

/// A valve with the names of its curves.
struct NamedValve {
    valve: Valve,
    names: Vec<String>,
    /// Whether its rim is a drawn curve.
    has_rim: bool,
}

/// The valves of a sketch, and faults of those whose flange has no room in the air.
pub(super) fn valves(sketch: &Sketch, rules: &Rules, lines: &Layout, notes: &mut SealingNotes) -> Vec<Valve> {
    let named = paired(sketch, rules, notes);
    let bands = Segments::of(lines.lines.iter().map(|line| &line.path));
    let air = Enclosures::new(&lines.closed);
    for (number, NamedValve { valve, names, has_rim }) in named.iter().enumerate() {
        if let Some((distance, place, line)) = band_within(valve, &bands, lines, rules.band / 2.0) {
            let band = quoted(&lines.lines[line].names);
            let what = format!("the flange of valve {} meets the band of {band}", quoted(names));
            let least = rules.band / 2.0;
            let or = if *has_rim { "draw a smaller rim" } else { "make `flange` smaller" };
            let remedy = format!("keep its rim {least} mm from the middle of every band, or {or}");
            let names = [&names[..], &lines.lines[line].names].concat();
            let numbers = [distance, least];
            notes.fault(ShapeCode::MisplacedValve, &names, place, (what, remedy), numbers);
            continue;
        }
        let (place, _) = beside(&valve.hole, 1e-6);
        if air.around(place).len().is_multiple_of(2) {
            let what = format!("the valve {} lies outside of the air", quoted(names));
            let remedy = "draw it inside of a chamber; a hose on the edge of one is a `port`";
            notes.fault(ShapeCode::MisplacedValve, names, place, (what, remedy), [f64::NAN; 2]);
        }
        for other in named[..number].iter().filter(|other| overlap(valve, &other.valve)) {
            let names = [&other.names[..], names].concat();
            let what = format!("the flanges of valves {} overlap", quoted(&names));
            let text = (what, "move them apart");
            notes.fault(ShapeCode::MisplacedValve, &names, place, text, [f64::NAN; 2]);
        }
    }
    named.into_iter().map(|named| named.valve).collect()
}

/// Holes with their rims: a closed curve alone is a hole, one with another right inside it is the rim of that.
fn paired(sketch: &Sketch, rules: &Rules, notes: &mut SealingNotes) -> Vec<NamedValve> {
    let drawn = closed(&sketch.valves, rules, notes);
    let around = Enclosures::new(drawn.iter().map(|(path, _)| path));
    let outer: Vec<Vec<usize>> = drawn.iter().map(|(path, _)| enclosing(&around, path)).collect();
    let mut valves = Vec::new();
    for (number, (path, names)) in drawn.iter().enumerate().filter(|(number, _)| outer[*number].is_empty()) {
        let inner: Vec<usize> = (0..drawn.len()).filter(|inner| outer[*inner].contains(&number)).collect();
        let (hole, names) = match inner.as_slice() {
            [] => (path, names.clone()),
            [inner] => (&drawn[*inner].0, [&drawn[*inner].1[..], names].concat()),
            [..] => {
                let place = path.start().unwrap_or(Point::ORIGIN);
                let what = format!("{} curves of valves lie inside of {}", inner.len(), quoted(names));
                let remedy = "draw a valve as its hole, or as its hole and the rim of its flange around it";
                notes.fault(ShapeCode::MisplacedValve, names, place, (what, remedy), [f64::NAN; 2]);
                continue;
            }
        };
        let hole = counterclockwise(hole);
        let has_rim = !inner.is_empty();
        let grown =
            || offset_right(&hole, rules.flange).into_iter().max_by(|a, b| a.area().total_cmp(&b.area()));
        let rim = if has_rim { Some(counterclockwise(path)) } else { grown() };
        valves.extend(rim.map(|rim| NamedValve { valve: Valve { hole, rim }, names, has_rim }));
    }
    valves
}

/// The line whose band meets the flange of `valve`: the distance of its middle from the rim, mm, the place, and its number.
fn band_within(valve: &Valve, bands: &Segments, lines: &Layout, half: f64) -> Option<(f64, Point, usize)> {
    let too_near = bands.approaches(&valve.rim, half).filter(|near| near.distance < half - 1e-6);
    let nearest = too_near.min_by(|a, b| a.distance.total_cmp(&b.distance));
    let inside = || {
        let mut starts = lines.lines.iter().map(|line| line.path.start()).enumerate();
        starts.find_map(|(line, start)| Some((0.0, start.filter(|start| valve.rim.encloses(*start))?, line)))
    };
    nearest.map(|Approach { distance, place, path }| (distance, place, path)).or_else(inside)
}

/// Whether two flanges overlap or touch.
fn overlap(a: &Valve, b: &Valve) -> bool {
    let is_inside = |a: &Valve, b: &Valve| a.rim.start().is_some_and(|start| b.rim.encloses(start));
    path_distance(&a.rim, &b.rim) < 1e-6 || is_inside(a, b) || is_inside(b, a)
}
