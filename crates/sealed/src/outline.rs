//! The cut around a sealed shape, and the cuts inside it.

use crate::air::{beside, depth};
use crate::fault::{ShapeCode, quoted};
use crate::holes::{around_bands, webs};
use crate::layout::Layout;
use crate::loose::{crossings, loose_ends};
use crate::mouth::Mouth;
use crate::notes::{SealingNotes, named};
use crate::offset::offset_right;
use crate::reach::unreached;
use crate::segments::{Approach, Segments};
use crate::sketch::{DrawnCurve, Rules, Sketch, thousandths_up};
use geom::{Enclosures, Line as Chord, Path, Point, Segment};

/// The outline, and the closed paths that are cut inside it.
pub(super) fn outline(
    sketch: &Sketch,
    rules: &Rules,
    lines: &Layout,
    notes: &mut SealingNotes,
) -> (Option<Path>, Vec<Path>) {
    let mut inner = closed(&sketch.holes, rules, notes);
    let holes = inner.len();
    let before = notes.faults.len();
    let drawn = closed(&sketch.cuts, rules, notes);
    let around = Enclosures::new(drawn.iter().map(|(path, _)| path));
    let mut outlines: Vec<(Path, Vec<String>)> = Vec::new();
    if sketch.cuts.is_empty() {
        let across = rules.band + rules.allowance;
        let most = rules.overrun;
        let offset = |(edge, by): &(Path, f64)| {
            Some((offset_cut(edge, *by, &lines.mouths, across, most)?, Vec::new()))
        };
        outlines.extend(lines.edges.iter().filter_map(offset));
    } else {
        for (path, names) in &drawn {
            let list = if depth(&around, path) == 0 { &mut outlines } else { &mut inner };
            list.push((path.clone(), names.clone()));
        }
    }
    if outlines.len() > 1 && sketch.cuts.is_empty() {
        let within = Enclosures::new(outlines.iter().map(|(path, _)| path));
        // One that only overlaps another is not within it.
        let is_within = |segment: &Segment| depth(&within, &Path::open(vec![*segment])) > 0;
        outlines.retain(|(path, _)| !path.segments.iter().all(is_within));
    }
    match outlines.len() {
        1 => {}
        0 if lines.lines.is_empty() => {}
        0 => no_outline(&sketch.cuts, before, notes),
        count => {
            let place = outlines.get(1).and_then(|(path, _)| path.start()).unwrap_or(Point::ORIGIN);
            let names: Vec<String> = outlines.iter().flat_map(|(_, names)| names.clone()).collect();
            let remedy = if sketch.cuts.is_empty() {
                let apart = 2.0 * rules.band;
                format!(
                    "move them more than {apart} mm apart, where each is a piece of its own, or draw one cut around all \
                     of it on a layer with the role `cut`"
                )
            } else {
                "draw each around edges of air or seams, or give a cut without any the role `ignore`"
                    .to_owned()
            };
            let text = (format!("{count} outlines to be cut"), remedy);
            #[expect(clippy::cast_precision_loss, reason = "a count of curves")]
            let found = count as f64;
            notes.fault(ShapeCode::Outlines, &names, place, text, [found, 1.0]);
        }
    }
    // Several outlines along the bands lie in the bands of each other: that follows from their number.
    if outlines.len() < 2 || !sketch.cuts.is_empty() {
        touching(&outlines, &inner, sketch, rules, lines, notes);
    }
    if notes.faults.len() == before && !outlines.is_empty() {
        unreached(outlines.iter().chain(&inner).map(|(path, _)| path), lines, sketch, rules, notes);
    }
    around_bands(&inner, holes, lines, notes);
    webs(&outlines, &inner, rules, notes);
    (outlines.into_iter().next().map(|(path, _)| path), inner.into_iter().map(|(path, _)| path).collect())
}

/// The fault of drawn cuts of which none is closed, unless an earlier fault, from number `before` on, tells why.
fn no_outline(cuts: &[DrawnCurve], before: usize, notes: &mut SealingNotes) {
    let Some(first) = cuts.first().filter(|_| notes.faults.len() == before) else { return };
    let names: Vec<String> = cuts.iter().map(|drawn| drawn.name.clone()).collect();
    let place = first.path.point_at(0.0).unwrap_or(Point::ORIGIN);
    let cuts = quoted(&names);
    let what = format!("the cuts {cuts} meet or share an edge, so none of them is the outline");
    let remedy = "draw closed cuts that do not meet, one around each piece";
    notes.fault(ShapeCode::Outlines, &names, place, (what, remedy), [0.0, 1.0]);
}

/// Drawn curves that must be closed, mended.
pub(super) fn closed(
    drawn: &[DrawnCurve],
    rules: &Rules,
    notes: &mut SealingNotes,
) -> Vec<(Path, Vec<String>)> {
    let (pieces, network, names) = notes.mended(drawn, rules.join);
    loose_ends((&pieces, &network), &names, rules.join, "close it", notes);
    crossings(&network, &names, rules.join, notes);
    let edges = network.edges.into_iter().filter(|edge| edge.nodes.is_none());
    edges.map(|edge| (edge.path, named(&edge.sources, &names))).collect()
}

/// The outline at `by` mm outside an edge, straight across its mouths, whose flaps end `across` mm outside the air. It runs around a
/// channel on whose sides it would begin more than `most` mm past the mouth: there the bands end.
fn offset_cut(edge: &Path, by: f64, mouths: &[Mouth], across: f64, most: f64) -> Option<Path> {
    let mut cut = offset_right(edge, by).into_iter().max_by(|a, b| a.area().total_cmp(&b.area()))?;
    for mouth in mouths {
        let across = mouth.half + across;
        let Some(along) = mouth.sides_begin(&cut, across).filter(|along| *along <= most) else { continue };
        let Some(open) = mouth.open(&cut, along, across) else { continue };
        let (Some(start), Some(end)) = (open.start(), open.end()) else { continue };
        let mut segments = open.segments;
        segments.push(Chord::new(end, start).into());
        cut = crate::merge::merged(&Path::closed(segments));
    }
    Some(cut)
}

/// Faults where a cut or a hole comes into a band, or a hole lies in the air or off the piece.
fn touching(
    outlines: &[(Path, Vec<String>)],
    inner: &[(Path, Vec<String>)],
    sketch: &Sketch,
    rules: &Rules,
    lines: &Layout,
    notes: &mut SealingNotes,
) {
    let half = rules.band / 2.0;
    let bands = Segments::of(lines.lines.iter().map(|line| &line.path));
    let in_mouth =
        |p: Point| lines.mouths.iter().any(|mouth| (p - mouth.at).length() <= reach(mouth, rules) + 1e-6);
    let outline = Enclosures::new(outlines.iter().map(|(path, _)| path));
    let air = Enclosures::new(&lines.closed);
    for (number, (path, names)) in outlines.iter().chain(inner).enumerate() {
        let approaches = bands.approaches(path, half);
        let too_near = approaches.filter(|near| near.distance < half - 1e-6 && !in_mouth(near.place));
        let nearest = too_near.min_by(|a, b| a.distance.total_cmp(&b.distance));
        if let Some(Approach { distance: far, place, .. }) = nearest {
            let cut = if names.is_empty() { "the cut along the bands".to_owned() } else { quoted(names) };
            let what = if far < 1e-6 {
                format!("{cut} crosses a band")
            } else {
                format!("{cut} comes within {far:.3} mm of the middle of a band")
            };
            let beside = |mouth: &&Mouth| number < outlines.len() && is_past_edge(mouth, place, rules.band);
            let remedy = if names.is_empty() {
                "draw one cut around all of it on a layer with the role `cut`".to_owned()
            } else if let Some(mouth) = lines.mouths.iter().find(beside) {
                across_channel(mouth, sketch, rules)
            } else {
                format!("keep {half} mm from the middle of every band, half a band")
            };
            notes.fault(ShapeCode::CutInBand, names, place, (what, remedy), [far, half]);
        }
        let (place, _) = beside(path, 1e-6);
        if number >= outlines.len() && (outline.around(place).is_empty() && !outlines.is_empty()) {
            let text = (format!("{} lies outside of the cut", quoted(names)), "move it inside");
            notes.fault(ShapeCode::CutInBand, names, place, text, [f64::NAN; 2]);
        }
        if number >= outlines.len() && air.around(place).len() % 2 == 1 {
            let is_on_edge = lines.closed.iter().any(|edge| edge.distance(place) <= half + rules.join);
            let what = if is_on_edge { "on the edge of the air" } else { "in the air" };
            let what = format!("{} lies {what}", quoted(names));
            let remedy = format!(
                "move it, or draw an island around it whose edge keeps {} mm from it, the width of a band",
                rules.band
            );
            notes.fault(ShapeCode::CutInBand, names, place, (what, remedy), [f64::NAN; 2]);
        }
    }
    outside(outlines, lines, notes);
}

/// Distance from the middle of a mouth within which a cut may cross the bands beside the hose, mm.
fn reach(mouth: &Mouth, rules: &Rules) -> f64 {
    mouth.half + rules.band + 2.0 * rules.overrun
}

/// Whether `p` lies beside the channel of `mouth` outside the drawn edge, at most a band from it.
fn is_past_edge(mouth: &Mouth, p: Point, band: f64) -> bool {
    mouth.local(p).0 > -mouth.length && mouth.is_beside(p, band)
}

/// The remedy of an outline that crosses the bands beside the hose too near the edge.
fn across_channel(mouth: &Mouth, sketch: &Sketch, rules: &Rules) -> String {
    let across = mouth.half + rules.band / 2.0;
    let least = mouth.length - (reach(mouth, rules).powi(2) - across.powi(2)).sqrt();
    let port = quoted(std::slice::from_ref(&sketch.ports[mouth.port].name));
    let least = thousandths_up(least.max(rules.band));
    format!(
        "at port {port} it must lie at least {least:.3} mm outside the edge: only there may it cross the \
         bands beside the hose"
    )
}

/// Faults of seams outside of the outline, except for those out of a mouth.
fn outside(outlines: &[(Path, Vec<String>)], lines: &Layout, notes: &mut SealingNotes) {
    if outlines.is_empty() {
        return;
    }
    let outline = Enclosures::new(outlines.iter().map(|(path, _)| path));
    for line in &lines.lines {
        let (place, _) = beside(&line.path, 1e-6);
        if outline.around(place).is_empty() {
            let what = format!("the seam of {} lies outside of the cut", quoted(&line.names));
            let remedy = "draw the cut around it";
            notes.fault(ShapeCode::CutInBand, &line.names, place, (what, remedy), [f64::NAN; 2]);
        }
    }
}
