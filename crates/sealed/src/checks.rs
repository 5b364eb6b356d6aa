//! The last pass, from bands to **checked** bands: requirements of bands, tubes and chambers, with values and places.

use std::collections::{BTreeMap, BTreeSet};

use crate::bands::Bands;
use crate::bottleneck::{Bottleneck, GapCurve, bottlenecks};
use crate::channel::{ChannelSides, CheckedSketch, Flanks};
use crate::corners::{hairpins, sharp_corners};
use crate::fault::{Quoted, SealingNotes, ShapeCode, ShapeFault, quoted};
use crate::narrow_places::narrow_places;
use crate::segments::Segments;
use crate::sketch::{DrawnPort, Rules, thousandths_up};
use geom::{Enclosures, Point, intersections};

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

/// Faults where bands overlap or a tube is too narrow, and warnings of narrow passages and sharp corners. `earlier` are the faults of the
/// passes before: what they tell is not told again.
///
/// Every bottleneck gets its kind first. Then those of one kind that are one narrow place are told once, where it is narrowest.
pub(crate) fn checked(
    bands: &Bands,
    ports: &[DrawnPort],
    rules: &Rules,
    earlier: &[ShapeFault],
) -> SealingNotes {
    let mut notes = SealingNotes::default();
    let check = CheckedSketch { bands, ports, channels: ChannelSides::list(bands, rules) };
    let crossings = band_crossings(bands, rules.band);
    notes.faults.extend(crossing_faults(&crossings, &check, rules, earlier));
    let crossed: BTreeSet<usize> = crossings.into_keys().flatten().collect();
    notes.faults.extend(hairpins(&bands.list, rules.band));
    let curves: Vec<GapCurve<'_>> =
        bands.list.iter().map(|band| GapCurve { path: &band.path, joined: band.joined }).collect();
    let widest = rules.least_passage.max(2.0 * rules.band);
    let air = Enclosures::new(&bands.closed);
    let necks = notes.unless_crowded(bottlenecks(&curves, rules.band + widest));
    let kinds: Vec<Option<NeckKind>> = necks
        .iter()
        .map(|neck| {
            // Where bands cross, inside and outside are undefined.
            let is_defined = neck.curves.iter().all(|curve| !crossed.contains(curve));
            neck_kind(neck, &check.channels, &air, rules).filter(|_| is_defined)
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
            let port_fault =
                if kind == NeckKind::Passage { None } else { port_at_foot(bands, ports, &neck, rules) };
            let Some(fault) = port_fault else {
                let flanks = Flanks::of_curves(neck.curves, neck.points, &check);
                let is_passage = kind == NeckKind::Passage;
                let list = if is_passage { &mut notes.warnings } else { &mut notes.faults };
                list.push(narrow_neck(kind, &neck, &flanks, rules));
                continue;
            };
            // The end may be near both sides of the channel.
            let is_new = |other: &ShapeFault| other.names != fault.names || other.place != fault.place;
            if earlier.iter().chain(&notes.faults).all(is_new) {
                notes.faults.push(fault);
            }
        }
    }
    notes.warnings.extend(sharp_corners(bands, rules));
    notes
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
    let in_air = !is_past_mouth && air.enclosing(neck.middle()).len() % 2 == 1;
    match () {
        () if !in_air => None,
        () if tube < 2.0 * rules.band - ALIKE => Some(NeckKind::Tube),
        () if tube < rules.least_passage - ALIKE => Some(NeckKind::Passage),
        () => None,
    }
}

/// The fault or warning of a neck of this kind between `flanks`.
///
/// Bands that overlap and tubes that are too narrow are faults, narrow passages warnings. Where a side belongs to the channel of a port,
/// the port is what has to be moved.
fn narrow_neck(kind: NeckKind, neck: &Bottleneck, flanks: &Flanks, rules: &Rules) -> ShapeFault {
    let (tube, place) = (neck.width - rules.band, neck.middle());
    let text = &flanks.text;
    let fault = match kind {
        NeckKind::Overlap => {
            let limit = rules.band;
            let finding = format!("an overlap of {:.3} mm between {text}", -tube);
            let remedy = match &flanks.ports[..] {
                [] => format!("move the centre lines to at least {limit} mm from each other"),
                [_] => format!("move the port, so that its bands lie at least {limit} mm from the other"),
                [..] => rules.ports_apart(),
            };
            let is_band = flanks.ports.is_empty();
            let code = if is_band { ShapeCode::BandsOverlap } else { ShapeCode::ChannelOverlap };
            let fault = ShapeFault::new(code, place, finding, remedy);
            ShapeFault { found: neck.width, allowed: limit, ..fault }
        }
        NeckKind::Tube => {
            let limit = 2.0 * rules.band;
            let finding = format!("a tube of {tube:.3} mm between {text}");
            let remedy = format!("make it at least {limit} mm wide, twice the band");
            let fault = ShapeFault::new(ShapeCode::NarrowTube, place, finding, remedy);
            ShapeFault { found: tube, allowed: limit, ..fault }
        }
        NeckKind::Passage => {
            let limit = rules.least_passage;
            let finding = format!("a passage of {tube:.3} mm between {text}");
            let remedy = format!("air may flow slowly; make it at least {limit} mm (`passage`)");
            let fault = ShapeFault::new(ShapeCode::NarrowPassage, place, finding, remedy);
            ShapeFault { found: tube, allowed: limit, ..fault }
        }
    };
    ShapeFault { names: flanks.names.clone(), ..fault }
}

/// The fault of the port whose channel takes the place where a weld or a wall meets the edge, if that is why `neck` is too narrow.
fn port_at_foot(bands: &Bands, ports: &[DrawnPort], neck: &Bottleneck, rules: &Rules) -> Option<ShapeFault> {
    let [a, b] = neck.curves.map(|i| &bands.list[i]);
    let inner = match [a.kind.is_inner(), b.kind.is_inner()] {
        [true, false] => a,
        [false, true] => b,
        [true, true] | [false, false] => return None,
    };
    for mouth in bands.mouths.iter().filter(|mouth| mouth.is_beside(neck.middle(), 2.0 * rules.band)) {
        let limit = mouth.half + rules.band / 2.0;
        let ends = [inner.path.start(), inner.path.end()].into_iter().flatten();
        let feet = ends.filter(|foot| mouth.is_beside(*foot, rules.band));
        let mut distances = feet.map(|foot| (foot, mouth.local(foot).1.abs()));
        let Some((foot, distance)) = distances.find(|(_, distance)| *distance < limit) else { continue };
        let port = &ports[mouth.port].name;
        let finding = format!(
            "port {} lies {distance:.3} mm from the end of {}, whose band meets the hose's channel",
            quoted(port),
            Quoted(&inner.names)
        );
        let remedy =
            format!("put the port at least {:.3} mm from there along the edge", thousandths_up(limit));
        let names = [std::slice::from_ref(port), &inner.names[..]].concat();
        let fault = ShapeFault::new(ShapeCode::ChannelOverlap, foot, finding, remedy);
        return Some(ShapeFault { names, found: distance, allowed: limit, ..fault });
    }
    None
}

/// Places where two centre lines cross, by the numbers of the bands, except where one ends on the other.
fn band_crossings(bands: &Bands, width: f64) -> BTreeMap<[usize; 2], Point> {
    let segments = Segments::new(bands.list.iter().map(|band| &band.path));
    let reach = width / 2.0 + ALIKE;
    let mut crossings: BTreeMap<[usize; 2], Point> = BTreeMap::new();
    for (i, part) in segments.list.iter().enumerate() {
        for j in segments.index.overlapping(&part.bounds).into_iter().filter(|j| *j < i) {
            let other = &segments.list[j];
            let pair = [other.path, part.path];
            if part.path == other.path || crossings.contains_key(&pair) {
                continue;
            }
            let mut places = intersections(&part.segment, &other.segment).into_iter();
            if let Some(p) =
                places.find(|p| pair.iter().all(|band| !bands.list[*band].is_joined_at(*p, reach)))
            {
                let _ = crossings.insert(pair, p);
            }
        }
    }
    crossings
}

/// The faults of bands that cross. A channel that a band closes is told by `earlier` faults.
fn crossing_faults(
    crossings: &BTreeMap<[usize; 2], Point>,
    check: &CheckedSketch<'_>,
    rules: &Rules,
    earlier: &[ShapeFault],
) -> Vec<ShapeFault> {
    let mut faults = Vec::new();
    for (pair, place) in crossings {
        let Flanks { names, text, ports } = Flanks::of_curves(*pair, [*place; 2], check);
        let is_closed = earlier.iter().any(|fault| {
            fault.code == ShapeCode::ChannelOverlap && ports.iter().any(|port| fault.names.contains(port))
        });
        if is_closed {
            continue;
        }
        let remedy = if ports.is_empty() {
            "end one on the other, or move them apart"
        } else {
            "move the port to where its channel leads straight out"
        };
        let fault = ShapeFault::new(ShapeCode::Crossing, *place, format!("{text} cross"), remedy);
        faults.push(ShapeFault { names, found: 0.0, allowed: rules.band, ..fault });
    }
    faults
}
