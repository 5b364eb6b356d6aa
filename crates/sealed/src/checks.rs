//! Requirements of bands and tubes, with numbers and places.

use std::collections::{BTreeMap, BTreeSet};

use crate::bottleneck::{Bottleneck, GapCurve, bottlenecks};
use crate::channel::ChannelSides;
use crate::fault::{ShapeCode, ShapeFault, quoted};
use crate::flanks::Flanks;
use crate::hairpins::hairpins;
use crate::layout::{Layout, Line, LineUse};
use crate::narrow_places::narrow_places;
use crate::notes::SealingNotes;
use crate::segments::Segments;
use crate::sketch::{Rules, Sketch, thousandths_up};
use geom::{Enclosures, Path, Point, Segment, intersections};

/// Lengths that differ by less are alike, mm.
const ALIKE: f64 = 1e-6;

/// The finding about two bands beside each other.
#[derive(Clone, Copy, PartialEq, Eq)]
enum NeckKind {
    /// Their bands overlap.
    Overlap,
    /// The air between them is narrower than two bands.
    Tube,
    /// The air between them is narrower than the least passage.
    Passage,
}

/// Faults where bands overlap or a tube is too narrow, and warnings of narrow passages.
///
/// Every bottleneck gets its kind first. Then those of one kind that are one narrow place are told once, where it is narrowest.
pub(super) fn checked(lines: &Layout, sketch: &Sketch, rules: &Rules, notes: &mut SealingNotes) {
    let channels = ChannelSides::all(lines, rules);
    let crossed = crossing_bands(lines, &channels, sketch, rules.band, notes);
    hairpins(&lines.lines, rules.band, notes);
    let curves: Vec<GapCurve<'_>> =
        lines.lines.iter().map(|line| GapCurve { path: &line.path, joined: line.joined }).collect();
    let widest = rules.least_passage.max(2.0 * rules.band);
    let air = Enclosures::new(&lines.closed);
    let necks = notes.unless_crowded(bottlenecks(&curves, rules.band + widest));
    let kinds: Vec<Option<NeckKind>> = necks
        .iter()
        .map(|neck| {
            // Where bands cross, inside and outside are undefined.
            let is_defined = neck.curves.iter().all(|curve| !crossed.contains(curve));
            neck_kind(neck, &channels, &air, rules).filter(|_| is_defined)
        })
        .collect();
    let limits = [
        (NeckKind::Overlap, rules.band),
        (NeckKind::Tube, 3.0 * rules.band),
        (NeckKind::Passage, rules.band + widest),
    ];
    for (kind, limit) in limits {
        let of_kind = necks.iter().zip(&kinds).filter(|(_, other)| **other == Some(kind));
        for neck in narrow_places(of_kind.map(|(neck, _)| *neck).collect(), &curves, limit) {
            let is_at_foot = kind != NeckKind::Passage && port_at_foot(lines, sketch, &neck, rules, notes);
            if !is_at_foot {
                narrow(kind, &neck, &Flanks::of(&neck, lines, &channels, sketch), rules, notes);
            }
        }
    }
}

/// The kind of a neck between centre lines; `None` if its width is right, or it is a port's own channel.
fn neck_kind(
    neck: &Bottleneck,
    channels: &[ChannelSides<'_>],
    air: &Enclosures,
    rules: &Rules,
) -> Option<NeckKind> {
    if channels.iter().any(|channel| channel.are_around(neck)) {
        return None;
    }
    let tube = neck.width - rules.band;
    if tube < -ALIKE {
        return Some(NeckKind::Overlap);
    }
    let is_past_mouth = neck.points.iter().any(|p| channels.iter().any(|channel| channel.has_past_mouth(*p)));
    let in_air = !is_past_mouth && air.around(neck.middle()).len() % 2 == 1;
    match () {
        () if !in_air => None,
        () if tube < 2.0 * rules.band - ALIKE => Some(NeckKind::Tube),
        () if tube < rules.least_passage - ALIKE => Some(NeckKind::Passage),
        () => None,
    }
}

/// Notes a neck of this kind between `flanks`.
///
/// Bands that overlap and tubes that are too narrow are faults, narrow passages warnings. Where a side belongs to the channel of a port,
/// the port is what has to be moved.
fn narrow(kind: NeckKind, neck: &Bottleneck, flanks: &Flanks, rules: &Rules, notes: &mut SealingNotes) {
    let (tube, place) = (neck.width - rules.band, neck.middle());
    let Flanks { names, text, .. } = flanks;
    match kind {
        NeckKind::Overlap => {
            let least = rules.band;
            let what = format!("an overlap of {:.3} mm between {text}", -tube);
            let remedy = match &flanks.ports[..] {
                [] => format!("move the centre lines to at least {least} mm from each other"),
                [_] => format!("move the port, so that its bands lie at least {least} mm from the other"),
                [..] => rules.ports_apart(),
            };
            let is_band = flanks.ports.is_empty();
            let code = if is_band { ShapeCode::BandsOverlap } else { ShapeCode::ChannelOverlap };
            notes.fault(code, names, place, (what, remedy), [neck.width, least]);
        }
        NeckKind::Tube => {
            let both = 2.0 * rules.band;
            let what = format!("a tube of {tube:.3} mm between {text}");
            let remedy = format!("make it at least {both} mm wide, twice the band");
            notes.fault(ShapeCode::NarrowTube, names, place, (what, remedy), [tube, both]);
        }
        NeckKind::Passage => {
            let least = rules.least_passage;
            let what = format!("a passage of {tube:.3} mm between {text}");
            let remedy = format!("air may flow slowly; make it at least {least} mm (`passage`)");
            notes.warnings.push(ShapeFault::new(
                ShapeCode::NarrowPassage,
                names,
                place,
                (what, remedy),
                [tube, least],
            ));
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
            notes.fault(ShapeCode::ChannelOverlap, &names, foot, (what, remedy), [far, least]);
        }
        return true;
    }
    false
}

/// Faults where centre lines cross, except where one ends on the other; the numbers of the lines that do. A channel that a band closes
/// is told there.
fn crossing_bands(
    layout: &Layout,
    channels: &[ChannelSides<'_>],
    sketch: &Sketch,
    band: f64,
    notes: &mut SealingNotes,
) -> BTreeSet<usize> {
    let lines = &layout.lines;
    let segments = Segments::of(lines.iter().map(|line| &line.path));
    let is_end = |number: usize, p: Point| {
        let Line { path, joined, .. } = &lines[number];
        let mut ends = [path.start(), path.end()].into_iter().zip(joined);
        ends.any(|(end, joined)| *joined && end.is_some_and(|end| end.distance(p) <= band / 2.0 + ALIKE))
    };
    let mut crossings: BTreeMap<[usize; 2], Point> = BTreeMap::new();
    for (i, one) in segments.list.iter().enumerate() {
        for j in segments.index.overlapping(&one.bounds).into_iter().filter(|j| *j < i) {
            let other = &segments.list[j];
            let pair = [other.path, one.path];
            if one.path == other.path || crossings.contains_key(&pair) {
                continue;
            }
            let met = intersections(&one.segment, &other.segment).into_iter();
            if let Some(p) = met.into_iter().find(|p| pair.iter().all(|line| !is_end(*line, *p))) {
                let _ = crossings.insert(pair, p);
            }
        }
    }
    for (pair, place) in &crossings {
        let Flanks { names, text, ports } = Flanks::at(*pair, [*place; 2], lines, channels, sketch);
        let is_closed = |fault: &ShapeFault| {
            fault.code == ShapeCode::ChannelOverlap && ports.iter().any(|port| fault.names.contains(port))
        };
        if notes.faults.iter().any(is_closed) {
            continue;
        }
        let remedy = if ports.is_empty() {
            "end one on the other, or move them apart"
        } else {
            "move the port to where its channel leads straight out"
        };
        notes.fault(ShapeCode::Crossing, &names, *place, (format!("{text} cross"), remedy), [0.0, band]);
    }
    crossings.into_keys().flatten().collect()
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
            notes.warnings.push(ShapeFault::new(
                ShapeCode::SharpCorner,
                names,
                place,
                (what, remedy),
                [found, 0.0],
            ));
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
