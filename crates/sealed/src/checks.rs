//! Requirements of bands and tubes, with numbers and places.

use std::collections::BTreeMap;

use crate::around::{Layout, Line, LineUse};
use crate::bottleneck::{Bottleneck, GapCurve, bottlenecks};
use crate::fault::{ShapeCode, quoted};
use crate::hairpins::hairpins;
use crate::notes::SealingNotes;
use crate::segments::Segments;
use crate::sketch::{Rules, Sketch, thousandths_up};
use geom::{Enclosures, Path, Point, Segment, intersections};

/// Lengths that differ by less are alike, mm.
const ALIKE: f64 = 1e-6;

/// Faults where bands overlap or a tube is too narrow, and warnings of narrow passages.
pub(super) fn checked(lines: &Layout, sketch: &Sketch, rules: &Rules, notes: &mut SealingNotes) {
    crossing_bands(&lines.lines, rules.band, notes);
    hairpins(&lines.lines, rules.band, notes);
    let curves: Vec<GapCurve<'_>> =
        lines.lines.iter().map(|line| GapCurve { path: &line.path, joined: line.joined }).collect();
    let both = 2.0 * rules.band;
    let limit = rules.band + rules.least_passage.max(both);
    let air = Enclosures::new(&lines.closed);
    for neck in notes.unless_crowded(bottlenecks(&curves, limit)) {
        let in_air = air.around(neck.middle()).len() % 2 == 1;
        let tube = neck.width - rules.band;
        if is_mouth(lines, &neck, tube) {
            continue;
        }
        let mut names: Vec<String> = neck.curves.iter().flat_map(|i| lines.lines[*i].names.clone()).collect();
        names.dedup();
        if tube < both - ALIKE && port_at_foot(lines, sketch, &neck, rules, notes) {
            continue;
        }
        let (least, passage) = (rules.band, rules.least_passage);
        let what = |found: String| format!("{found} between the bands of {}", quoted(&names));
        if tube < -ALIKE {
            let what = what(format!("an overlap of {:.3} mm", -tube));
            let text = (what, format!("move the centre lines to at least {least} mm from each other"));
            notes.fault(ShapeCode::BandsOverlap, &names, neck.middle(), text, [neck.width, least]);
        } else if in_air && tube < both - ALIKE {
            let what = what(format!("a tube of {tube:.3} mm"));
            let text = (what, format!("make it at least {both} mm wide, twice the band"));
            notes.fault(ShapeCode::NarrowTube, &names, neck.middle(), text, [tube, both]);
        } else if in_air && tube < passage - ALIKE {
            let what = what(format!("a passage of {tube:.3} mm"));
            let text = (what, format!("air may flow slowly; make it at least {passage} mm (`passage`)"));
            notes.warning(ShapeCode::NarrowPassage, &names, neck.middle(), text, [tube, passage]);
        }
    }
}

/// Notes the port whose channel takes the place where a weld or a wall meets the edge, if that is why `neck` is too narrow.
fn port_at_foot(
    lines: &Layout,
    sketch: &Sketch,
    neck: &Bottleneck,
    rules: &Rules,
    notes: &mut SealingNotes,
) -> bool {
    let [one, other] = neck.curves.map(|i| &lines.lines[i]);
    let is_inner = |line: &Line| matches!(line.kind, LineUse::Weld | LineUse::Wall);
    let inner = match [is_inner(one), is_inner(other)] {
        [true, false] => one,
        [false, true] => other,
        _ => return false,
    };
    for mouth in lines.mouths.iter().filter(|mouth| mouth.is_beside(neck.middle(), 2.0 * rules.band)) {
        let least = mouth.half + rules.band / 2.0;
        let feet = [inner.path.start(), inner.path.end()].into_iter().flatten();
        let beside = feet.filter(|foot| mouth.is_beside(*foot, rules.band));
        let mut far = beside.map(|foot| (foot, mouth.local(foot).1.abs()));
        let Some((foot, far)) = far.find(|(_, far)| *far < least) else { continue };
        let port = [sketch.ports[mouth.port].name.clone()];
        let what = format!(
            "port {} lies {far:.3} mm from the end of {}, whose band meets the hose's channel",
            quoted(&port),
            quoted(&inner.names)
        );
        let remedy =
            format!("put the port at least {:.3} mm from there along the edge", thousandths_up(least));
        let names = [&port, &inner.names[..]].concat();
        // The end may be near both sides of the channel.
        if notes.faults.iter().all(|fault| fault.names != names || fault.place != foot) {
            notes.fault(ShapeCode::BandsOverlap, &names, foot, (what, remedy), [far, least]);
        }
        return true;
    }
    false
}

/// Whether a narrow place is the channel of a port, whose width is that of its hose.
fn is_mouth(lines: &Layout, neck: &Bottleneck, tube: f64) -> bool {
    lines.mouths.iter().any(|mouth| {
        let (along, across) = mouth.local(neck.middle());
        along <= mouth.beyond + 1.0
            && along > -mouth.depth.max(100.0)
            && across.abs() <= mouth.half / 2.0
            && tube >= 2.0 * mouth.half - ALIKE
    })
}

/// Faults where centre lines cross, except where one ends on the other.
fn crossing_bands(lines: &[Line], band: f64, notes: &mut SealingNotes) {
    let segments = Segments::of(lines.iter().map(|line| &line.path));
    let is_end = |number: usize, p: Point| {
        let Line { path, joined, .. } = &lines[number];
        let mut ends = [path.start(), path.end()].into_iter().zip(joined);
        ends.any(|(end, joined)| *joined && end.is_some_and(|end| end.distance(p) <= band / 2.0 + ALIKE))
    };
    let mut told: BTreeMap<[usize; 2], Point> = BTreeMap::new();
    for (i, one) in segments.list.iter().enumerate() {
        for j in segments.index.overlapping(&one.bounds).into_iter().filter(|j| *j < i) {
            let other = &segments.list[j];
            let pair = [other.path, one.path];
            if one.path == other.path || told.contains_key(&pair) {
                continue;
            }
            let met = intersections(&one.segment, &other.segment).into_iter();
            if let Some(p) = met.into_iter().find(|p| pair.iter().all(|line| !is_end(*line, *p))) {
                let _ = told.insert(pair, p);
            }
        }
    }
    for ([a, b], place) in told {
        let names = [lines[a].names.clone(), lines[b].names.clone()].concat();
        let what = format!("the bands of {} cross", quoted(&names));
        let remedy = "end one on the other, or move them apart";
        notes.fault(ShapeCode::Crossing, &names, place, (what, remedy), [0.0, band]);
    }
}

/// Distance below which only one of the unsealed places of an edge is reported, mm.
const APART: f64 = 10.0;

/// Warnings of hinges and slits narrower than the iron is round, where fabric between the air's edge and the band stays unsealed.
pub(super) fn sharp_corners(lines: &Layout, rules: &Rules, notes: &mut SealingNotes) {
    let half = rules.band / 2.0;
    let segments = Segments::of(lines.lines.iter().map(|line| &line.path));
    // The corners of a port are its own, not the drawing's.
    let is_drawn = |place: &Point| lines.mouths.iter().all(|mouth| !mouth.has_corner(*place, 0.0));
    for edge in &lines.air.edges {
        let mut open: Vec<(f64, Point, usize)> = Vec::new();
        for place in inward_places(edge).filter(is_drawn) {
            let mut nearest = (f64::INFINITY, 0);
            let far = segments.index.least(place, |i| {
                let far = segments.list[i].segment.distance(place);
                if far < nearest.0 {
                    nearest = (far, segments.list[i].path);
                }
                far
            });
            if far - half > 0.05 * rules.band {
                open.push((far - half, place, nearest.1));
            }
        }
        open.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut told: Vec<(f64, usize, Vec<Point>)> = Vec::new();
        for (found, place, line) in open {
            match told.iter_mut().find(|(_, _, places)| places[0].distance(place) <= APART) {
                Some((_, _, places)) if places.iter().all(|known| known.distance(place) > half) => {
                    places.push(place);
                }
                Some(_) => {}
                None => told.push((found, line, vec![place])),
            }
        }
        for (found, line, places) in told {
            let place = places[0];
            let more = match places.len() - 1 {
                0 => String::new(),
                more => format!(" (and {more} more within {APART} mm)"),
            };
            let names = &lines.lines[line].names;
            let own = quoted(names);
            let what = format!(
                "a hinge of {own} is sharper than the iron, {found:.3} mm or more stay unsealed{more}"
            );
            let remedy = format!("round it with at least {half} mm");
            notes.warning(ShapeCode::SharpCorner, names, place, (what, remedy), [found, 0.0]);
        }
    }
}

/// The corners at which a closed edge turns away from the air on its left, and the middle of each arc that does so.
fn inward_places(edge: &Path) -> impl Iterator<Item = Point> {
    let segments = &edge.segments;
    (0..segments.len()).flat_map(move |i| {
        let (before, after) = (&segments[(i + segments.len() - 1) % segments.len()], &segments[i]);
        let (a, b) = (before.tangent(1.0), after.tangent(0.0));
        let corner = (libm::atan2(a.cross(b), a.dot(b)) < -1e-6).then(|| after.start());
        let middle = matches!(after, Segment::Arc(arc) if arc.sweep < 0.0).then(|| after.point(0.5));
        corner.into_iter().chain(middle)
    })
}
