//! Requirements of bands and tubes, with numbers and places.

use std::collections::BTreeMap;

use crate::shape::around::{Layout, Line};
use crate::shape::bottleneck::{Bottleneck, GapCurve, bottlenecks};
use crate::shape::fault::{ShapeCode, ShapeFault, quoted};
use crate::shape::notes::SealingNotes;
use crate::shape::sketch::Rules;
use inflatable::geom::{BoxIndex, Enclosures, Path, Point, Segment, intersections};

/// Lengths that differ by less are alike, mm.
const ALIKE: f64 = 1e-6;

/// Faults where bands overlap or a tube is too narrow, and warnings of narrow passages.
pub(super) fn checked(lines: &Layout, rules: &Rules, notes: &mut SealingNotes) {
    crossing_bands(&lines.lines, rules.band, notes);
    let curves: Vec<GapCurve<'_>> =
        lines.lines.iter().map(|line| GapCurve { path: &line.path, joined: line.joined }).collect();
    let limit = rules.band + rules.least_passage.max(2.0 * rules.band);
    let air = Enclosures::new(&lines.closed);
    for neck in bottlenecks(&curves, limit) {
        let in_air = air.around(neck.middle()).len() % 2 == 1;
        let tube = neck.width - rules.band;
        if is_mouth(lines, &neck, tube) {
            continue;
        }
        let mut names: Vec<String> = neck.curves.iter().flat_map(|i| lines.lines[*i].names.clone()).collect();
        names.dedup();
        let what = |found: String| format!("{found} between the bands of {}", quoted(&names));
        let (code, text, numbers) = if tube < -ALIKE {
            (
                ShapeCode::BandsOverlap,
                (
                    what(format!("an overlap of {:.3} mm", -tube)),
                    format!("move the centre lines to at least {} mm from each other", rules.band),
                ),
                [neck.width, rules.band],
            )
        } else if in_air && tube < 2.0 * rules.band - ALIKE {
            (
                ShapeCode::NarrowTube,
                (
                    what(format!("a tube of {tube:.3} mm")),
                    format!("make it at least {} mm wide, twice the band", 2.0 * rules.band),
                ),
                [tube, 2.0 * rules.band],
            )
        } else if in_air && tube < rules.least_passage - ALIKE {
            (
                ShapeCode::NarrowPassage,
                (
                    what(format!("a passage of {tube:.3} mm")),
                    format!("air may pass slowly: {} mm and more are common", rules.least_passage),
                ),
                [tube, rules.least_passage],
            )
        } else {
            continue;
        };
        let ((what, remedy), [found, allowed], place) = (text, numbers, neck.middle());
        let fault = ShapeFault { code, names, place, found, allowed, what, remedy };
        let list = if code == ShapeCode::NarrowPassage { &mut notes.warnings } else { &mut notes.faults };
        list.push(fault);
    }
}

/// Whether a narrow place is the channel of a port, whose width is that of its hose.
fn is_mouth(lines: &Layout, neck: &Bottleneck, tube: f64) -> bool {
    lines.mouths.iter().any(|mouth| {
        let from = neck.middle() - mouth.at;
        let (along, across) = (from.dot(mouth.out), from.dot(mouth.out.perp()));
        along <= mouth.beyond + 1.0
            && along > -100.0
            && across.abs() <= mouth.half / 2.0
            && tube >= 2.0 * mouth.half - ALIKE
    })
}

/// Faults where centre lines cross, except where one ends on the other.
fn crossing_bands(lines: &[Line], band: f64, notes: &mut SealingNotes) {
    let segments: Vec<(usize, Segment)> = lines
        .iter()
        .enumerate()
        .flat_map(|(number, line)| line.path.segments.iter().map(move |segment| (number, *segment)))
        .collect();
    let index = BoxIndex::new(segments.iter().map(|(_, segment)| segment.bounds()));
    let mut told: BTreeMap<[usize; 2], Point> = BTreeMap::new();
    for (i, (a, s)) in segments.iter().enumerate() {
        for j in index.overlapping(&s.bounds()).into_iter().filter(|j| *j < i) {
            let (b, t) = &segments[j];
            let is_end = |line: &Line, p: Point| {
                let ends = [(line.path.start(), line.joined[0]), (line.path.end(), line.joined[1])];
                ends.into_iter().any(|(end, joined)| {
                    joined && end.is_some_and(|end| end.distance(p) <= band / 2.0 + ALIKE)
                })
            };
            if a == b || told.contains_key(&[*b, *a]) {
                continue;
            }
            for p in intersections(s, t) {
                if !is_end(&lines[*a], p) && !is_end(&lines[*b], p) {
                    let _ = told.insert([*b, *a], p);
                    break;
                }
            }
        }
    }
    for ([a, b], place) in told {
        let names = [lines[a].names.clone(), lines[b].names.clone()].concat();
        let what = format!("the bands of {} cross", quoted(&names));
        let remedy = "end one on the other, or move them apart".to_owned();
        notes.fault(ShapeCode::Crossing, &names, place, (what, remedy), [0.0, band]);
    }
}

/// Warnings of hinges sharper than the iron is round, where fabric stays unsealed.
pub(super) fn sharp_corners(lines: &Layout, rules: &Rules, notes: &mut SealingNotes) {
    let half = rules.band / 2.0;
    for Line { path, names, .. } in &lines.lines {
        // The corners of a port are its own, not the drawing's.
        let drawn = |place: &Point| lines.mouths.iter().all(|mouth| !mouth.has_corner(*place, half));
        for (place, turn) in right_turns(path).into_iter().filter(|(place, _)| drawn(place)) {
            // From the drawn vertex to the round that the iron leaves.
            let cusp = half * (1.0 / libm::cos(turn / 2.0) - 1.0);
            if cusp > 0.05 * rules.band {
                notes.warnings.push(ShapeFault {
                    code: ShapeCode::SharpCorner,
                    names: names.clone(),
                    place,
                    found: cusp,
                    allowed: 0.0,
                    what: format!(
                        "a hinge of {} is sharper than the iron, {cusp:.3} mm stay unsealed",
                        quoted(names)
                    ),
                    remedy: format!("round it with at least {half} mm"),
                });
            }
        }
    }
}

/// The corners of a centre line at which it turns right, away from the air, with the angle, rad.
fn right_turns(path: &Path) -> Vec<(Point, f64)> {
    let (segments, count) = (&path.segments, path.segments.len());
    let last = if path.closed { count } else { count.saturating_sub(1) };
    let turn = |i: usize| {
        let (a, b) = (segments[i].tangent(1.0), segments[(i + 1) % count].tangent(0.0));
        (segments[i].end(), -libm::atan2(a.cross(b), a.dot(b)))
    };
    (0..last).map(turn).filter(|(_, turn)| *turn > 1e-6).collect()
}
