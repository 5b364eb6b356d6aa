//! The fifth pass, from bands to the **cut** around them, the cuts inside it, and the valves in the faces of chambers.

use crate::bands::Bands;
use crate::fault::{Noted, Quoted, ShapeCode, ShapeFault, quoted};
use crate::holes::{CutPaths, cuts_around_bands, webs};
use crate::mended::{MendedCuts, NamedPath};
use crate::mouth::Mouth;
use crate::offset::offset_right;
use crate::offset_graph::merged;
use crate::regions::{ALONG, depth, side_points};
use crate::segments::{Approach, Segments};
use crate::sketch::{DrawnCurve, DrawnPort, Rules, thousandths_up};
use geom::{Bounds, Enclosures, Line, Path, Point, Segment, intersections};

/// The cut around a piece, and the closed paths that are cut inside it.
pub(crate) struct SketchCuts {
    pub outline: Option<Path>,
    pub inner: Vec<Path>,
}

/// The cuts around and between `bands`, and faults of those that come too near to bands or to each other. `drawn_curves` are the cuts of the sketch.
///
/// Drawn cuts are the outline and cuts inside it; without any the outline follows the edges. Faults of single curves hide that no outline
/// is closed, and that mouths are not reached.
pub(crate) fn cuts(
    drawn_curves: &[DrawnCurve],
    mended: MendedCuts,
    ports: &[DrawnPort],
    rules: &Rules,
    bands: &Bands,
) -> Noted<SketchCuts> {
    let MendedCuts { holes: (mut inner, mut notes), cuts: (drawn_cuts, cut_notes) } = mended;
    let holes = inner.len();
    let faults_of_holes = notes.faults.len();
    notes += cut_notes;
    let are_drawn = !drawn_curves.is_empty();
    let outlines = if are_drawn {
        let enclosures = Enclosures::new(drawn_cuts.iter().map(|cut| &cut.path));
        let (outermost, inside_others): (Vec<NamedPath>, _) =
            drawn_cuts.into_iter().partition(|cut| depth(&enclosures, &cut.path) == 0);
        inner.extend(inside_others);
        outermost
    } else {
        offset_outlines(bands, rules)
    };
    let cuts = CutPaths { outlines, inner, holes, are_drawn };
    let has_faults = notes.faults.len() > faults_of_holes;
    match cuts.outlines.len() {
        1 => {}
        0 if bands.list.is_empty() || has_faults => {}
        0 => notes.faults.extend(no_outline(drawn_curves)),
        _ => notes.faults.push(several_outlines(&cuts, rules)),
    }
    // Several outlines along the bands lie in the bands of each other: that follows from their number.
    if cuts.outlines.len() < 2 || are_drawn {
        notes.faults.extend(cuts_in_bands(&cuts, ports, rules, bands));
        notes.faults.extend(seams_outside(&cuts, bands));
    }
    if notes.faults.len() == faults_of_holes && !cuts.outlines.is_empty() {
        notes.faults.extend(unreached_mouths(&cuts, bands, ports, rules));
    }
    let faults = cuts_around_bands(&cuts, bands, &notes.faults);
    notes.faults.extend(faults);
    notes += webs(&cuts, rules);
    let outline = cuts.outlines.into_iter().next().map(|cut| cut.path);
    (SketchCuts { outline, inner: cuts.inner.into_iter().map(|cut| cut.path).collect() }, notes)
}

/// The outlines along the bands, without those within others. One that only overlaps another is not within it.
fn offset_outlines(bands: &Bands, rules: &Rules) -> Vec<NamedPath> {
    let flap = rules.band + rules.allowance;
    let paths = bands
        .cut_edges
        .iter()
        .filter_map(|edge| offset_cut(&edge.path, edge.distance, &bands.mouths, flap, rules.overrun));
    let mut outlines: Vec<NamedPath> = paths.map(|path| NamedPath { path, names: Vec::new() }).collect();
    if outlines.len() > 1 {
        let enclosures = Enclosures::new(outlines.iter().map(|cut| &cut.path));
        let is_within = |segment: &Segment| depth(&enclosures, &Path::open(vec![*segment])) > 0;
        outlines.retain(|cut| !cut.path.segments.iter().all(is_within));
    }
    outlines
}

/// The fault of drawn cuts of which none is closed.
fn no_outline(cuts: &[DrawnCurve]) -> Option<ShapeFault> {
    let first = cuts.first()?;
    let names: Vec<String> = cuts.iter().map(|drawn| drawn.name.clone()).collect();
    let place = first.path.point_at(0.0).unwrap_or(Point::ORIGIN);
    let finding =
        format!("the cuts {} meet or share an edge, so none of them is the outline", Quoted(&names));
    let remedy = "draw closed cuts that do not meet, one around each piece";
    let fault = ShapeFault::new(ShapeCode::Outlines, place, finding, remedy);
    Some(ShapeFault { names, found: 0.0, allowed: 1.0, ..fault })
}

/// The fault of several outlines.
fn several_outlines(cuts: &CutPaths, rules: &Rules) -> ShapeFault {
    let CutPaths { outlines, are_drawn, .. } = cuts;
    let count = outlines.len();
    let place = outlines.get(1).and_then(|cut| cut.path.start()).unwrap_or(Point::ORIGIN);
    let names: Vec<String> = outlines.iter().flat_map(|cut| cut.names.clone()).collect();
    let remedy = if *are_drawn {
        "draw each around edges of air or seams, or give a cut without any the role `ignore`".to_owned()
    } else {
        let distance = 2.0 * rules.band;
        format!(
            "move them more than {distance} mm apart, where each is a piece of its own, or draw one cut around all \
             of it on a layer with the role `cut`"
        )
    };
    #[expect(clippy::cast_precision_loss, reason = "a count of curves")]
    let number = count as f64;
    let fault = ShapeFault::new(ShapeCode::Outlines, place, format!("{count} outlines to be cut"), remedy);
    ShapeFault { names, found: number, allowed: 1.0, ..fault }
}

/// The outline at `distance` mm outside an edge, straight across its mouths, whose flaps end `flap` mm outside the air. It runs around a
/// channel on whose sides it would begin more than `longest` mm past the mouth: there the bands end.
fn offset_cut(edge: &Path, distance: f64, mouths: &[Mouth], flap: f64, longest: f64) -> Option<Path> {
    let loops = offset_right(edge, distance).into_iter();
    let mut cut = loops.max_by(|a, b| a.area().total_cmp(&b.area()))?;
    for mouth in mouths {
        let lateral = mouth.half + flap;
        let begin = mouth.sides_begin(&cut, lateral).filter(|begin| *begin <= longest);
        let Some(open) = begin.and_then(|begin| mouth.open(&cut, begin, lateral)) else { continue };
        let (Some(start), Some(end)) = (open.start(), open.end()) else { continue };
        let mut segments = open.segments;
        segments.push(Line::new(end, start).into());
        cut = merged(&Path::closed(segments));
    }
    Some(cut)
}

/// Faults where a cut or a hole comes into a band, or a hole lies in the air or off the piece.
///
/// Outlines may cross the bands beside the hose of a port, outside the drawn edge. Of each cut the place nearest to a band is told.
fn cuts_in_bands(cuts: &CutPaths, ports: &[DrawnPort], rules: &Rules, bands: &Bands) -> Vec<ShapeFault> {
    let half = rules.band / 2.0;
    let segments = Segments::new(bands.list.iter().map(|band| &band.path));
    let outline = Enclosures::new(cuts.outlines.iter().map(|cut| &cut.path));
    let air = Enclosures::new(&bands.closed);
    let mut faults = Vec::new();
    for (number, cut) in cuts.outlines.iter().chain(&cuts.inner).enumerate() {
        let is_inner = number >= cuts.outlines.len();
        let names = &cut.names;
        let approaches = segments.approaches(&cut.path, half);
        let too_near = approaches
            .filter(|near| near.distance < half - 1e-6 && !is_in_mouth(near.place, &bands.mouths, rules));
        if let Some(approach) = too_near.min_by(|a, b| a.distance.total_cmp(&b.distance)) {
            let mouths: &[Mouth] = if is_inner { &[] } else { &bands.mouths };
            let mouth = mouths.iter().find(|mouth| is_past_edge(mouth, approach.place, rules.band));
            let remedy = mouth.filter(|_| !names.is_empty()).map(|mouth| across_channel(mouth, ports, rules));
            faults.push(cut_in_band(names, &approach, remedy, half));
        }
        let (place, _) = side_points(&cut.path, 1e-6);
        if is_inner && outline.enclosing(place).is_empty() && !cuts.outlines.is_empty() {
            let finding = format!("{} lies outside of the cut", Quoted(names));
            let fault = ShapeFault::new(ShapeCode::CutInBand, place, finding, "move it inside");
            faults.push(ShapeFault { names: names.clone(), ..fault });
        }
        if is_inner && air.enclosing(place).len() % 2 == 1 {
            let is_on_edge = bands.closed.iter().any(|edge| edge.distance(place) <= half + rules.join);
            let region = if is_on_edge { "on the edge of the air" } else { "in the air" };
            let finding = format!("{} lies {region}", Quoted(names));
            let remedy = format!(
                "move it, or draw an island around it whose edge keeps {} mm from it, the width of a band",
                rules.band
            );
            let fault = ShapeFault::new(ShapeCode::CutInBand, place, finding, remedy);
            faults.push(ShapeFault { names: names.clone(), ..fault });
        }
    }
    faults
}

/// The fault of a cut of curves `names` that comes nearer than `half` a band to the middle of a band; without names it is the cut along
/// the bands. The `remedy` is that at the channel of a port, if it is there.
fn cut_in_band(names: &[String], approach: &Approach, remedy: Option<String>, half: f64) -> ShapeFault {
    let cut = if names.is_empty() { "the cut along the bands".to_owned() } else { Quoted(names).to_string() };
    let distance = approach.distance;
    let finding = if distance < 1e-6 {
        format!("{cut} crosses a band")
    } else {
        format!("{cut} comes within {distance:.3} mm of the middle of a band")
    };
    let remedy = remedy.unwrap_or_else(|| {
        if names.is_empty() {
            "draw one cut around all of it on a layer with the role `cut`".to_owned()
        } else {
            format!("keep {half} mm from the middle of every band, half a band")
        }
    });
    let fault = ShapeFault::new(ShapeCode::CutInBand, approach.place, finding, remedy);
    ShapeFault { names: names.to_vec(), found: distance, allowed: half, ..fault }
}

/// Whether a cut may cross a band at `p`, beside the hose in a mouth.
fn is_in_mouth(p: Point, mouths: &[Mouth], rules: &Rules) -> bool {
    mouths.iter().any(|mouth| (p - mouth.at).length() <= hose_reach(mouth, rules) + 1e-6)
}

/// Distance from the middle of a mouth within which a cut may cross the bands beside the hose, mm.
fn hose_reach(mouth: &Mouth, rules: &Rules) -> f64 {
    mouth.half + rules.band + 2.0 * rules.overrun
}

/// Whether `p` lies beside the channel of `mouth` outside the drawn edge, at most a band from it.
fn is_past_edge(mouth: &Mouth, p: Point, band: f64) -> bool {
    mouth.local(p).0 > -mouth.length && mouth.is_beside(p, band)
}

/// The remedy of an outline that crosses the bands beside the hose too near the edge.
fn across_channel(mouth: &Mouth, ports: &[DrawnPort], rules: &Rules) -> String {
    let lateral = mouth.half + rules.band / 2.0;
    let limit = mouth.length - (hose_reach(mouth, rules).powi(2) - lateral.powi(2)).sqrt();
    let limit = thousandths_up(limit.max(rules.band));
    format!(
        "at port {} it must lie at least {limit:.3} mm outside the edge: only there may it cross the \
         bands beside the hose",
        quoted(&ports[mouth.port].name)
    )
}

/// Faults of seams outside of the outline, except for those out of a mouth.
fn seams_outside(cuts: &CutPaths, bands: &Bands) -> Vec<ShapeFault> {
    let mut faults = Vec::new();
    if cuts.outlines.is_empty() {
        return faults;
    }
    let outline = Enclosures::new(cuts.outlines.iter().map(|cut| &cut.path));
    for band in &bands.list {
        let (place, _) = side_points(&band.path, 1e-6);
        // The longest segment may lie out of a mouth: the seam of a small edge is shorter than its ends beside the hose.
        let middles = band.path.segments.iter().map(|segment| segment.point(ALONG));
        let mut places = std::iter::once(place).chain(middles);
        if places.all(|place| outline.enclosing(place).is_empty()) {
            let finding = format!("the seam of {} lies outside of the cut", Quoted(&band.names));
            let fault = ShapeFault::new(ShapeCode::CutInBand, place, finding, "draw the cut around it");
            faults.push(ShapeFault { names: band.names.clone(), ..fault });
        }
    }
    faults
}

/// Faults of mouths that no cut reaches: the sheets stay one piece in front of them, and no hose goes in.
///
/// A band may close the way out before a cut crosses it. Without a drawn cut the way is also closed where the cut along the bands passes by,
/// farther out than twice the flap around the end of a channel: flaps then bridge a gap.
fn unreached_mouths(cuts: &CutPaths, bands: &Bands, ports: &[DrawnPort], rules: &Rules) -> Vec<ShapeFault> {
    let cut_segments = Segments::new(cuts.outlines.iter().chain(&cuts.inner).map(|cut| &cut.path));
    let band_segments = Segments::new(bands.list.iter().map(|band| &band.path));
    let bounds = cut_segments.list.iter().fold(Bounds::EMPTY, |bounds, cut| bounds.union(cut.bounds));
    let length = bounds.width() + bounds.height();
    let flap = rules.band + rules.allowance;
    let mut faults = Vec::new();
    for mouth in &bands.mouths {
        // A cut may cross the channel anywhere outside the drawn edge.
        let start = -mouth.length - 1e-3;
        let farthest = if cuts.are_drawn { f64::INFINITY } else { 2.0 * (mouth.beyond + flap) };
        let meetings = [-mouth.half, 0.0, mouth.half].map(|across| {
            let way = [start, length].map(|along| mouth.point(along, across));
            [&cut_segments, &band_segments].map(|segments| first_meeting(mouth, way, segments))
        });
        let closing = meetings.iter().find(|[cut, band]| cut.distance >= band.distance);
        let cut_distance = meetings[1][0].distance;
        if closing.is_none() && cut_distance <= farthest {
            continue;
        }
        let port = &ports[mouth.port].name;
        let mut names = vec![port.clone()];
        let mut place = mouth.at;
        let [mut value, mut limit] = [f64::NAN; 2];
        let finding = match closing.map(|[_, band]| (band.distance, band.path)) {
            Some((distance, Some(number))) => {
                let band_names = &bands.list[number].names;
                names.extend(band_names.clone());
                place = mouth.point(distance, 0.0);
                format!("the band of {} closes the way out of port {}", Quoted(band_names), quoted(port))
            }
            Some((_, None)) => format!("no cut lies in front of the mouth of port {}", quoted(port)),
            None => {
                [value, limit] = [cut_distance, farthest];
                format!("the cut passes {cut_distance:.3} mm in front of the mouth of port {}", quoted(port))
            }
        };
        let fault = ShapeFault::new(ShapeCode::ChannelOverlap, place, finding, rules.room_in_front());
        faults.push(ShapeFault { names, found: value, allowed: limit, ..fault });
    }
    faults
}

/// The first of several paths on the way out of a mouth.
struct WayMeeting {
    /// Distance past the mouth, mm; infinite where the way meets no path.
    distance: f64,
    /// The number of the path.
    path: Option<usize>,
}

/// The first meeting of the `way` out of a mouth with one of the `segments`.
fn first_meeting(mouth: &Mouth, way: [Point; 2], segments: &Segments) -> WayMeeting {
    let way = Segment::Line(Line::new(way[0], way[1]));
    let meetings = segments.overlapping(way.bounds()).flat_map(|part| {
        let places = intersections(&part.segment, &way).into_iter();
        places.map(|p| WayMeeting { distance: mouth.local(p).0, path: Some(part.path) })
    });
    let first = meetings.min_by(|a, b| a.distance.total_cmp(&b.distance));
    first.unwrap_or(WayMeeting { distance: f64::INFINITY, path: None })
}
