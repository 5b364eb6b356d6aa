//! Mouths that no cut reaches: the sheets stay one piece in front of them, and no hose goes in.

use crate::around::Layout;
use crate::fault::{ShapeCode, quoted};
use crate::mouth::Mouth;
use crate::notes::SealingNotes;
use crate::segments::Segments;
use crate::sketch::{Rules, Sketch};
use geom::{Bounds, Line as Chord, Path, Point, Segment, intersections};

/// Faults of mouths that a band closes before one of the `cuts` crosses the way out. Without a drawn cut its way is also closed where the
/// cut along the bands passes by, farther out than twice the flap around the end of a channel: flaps then bridge a gap.
pub(super) fn unreached<'a>(
    cuts: impl Iterator<Item = &'a Path>,
    lines: &Layout,
    sketch: &Sketch,
    rules: &Rules,
    notes: &mut SealingNotes,
) {
    let cuts = Segments::of(cuts);
    let bands = Segments::of(lines.lines.iter().map(|line| &line.path));
    let all = cuts.list.iter().fold(Bounds::EMPTY, |all, cut| all.union(cut.bounds));
    let far = all.width() + all.height();
    let by = rules.band + rules.allowance;
    for mouth in &lines.mouths {
        // A cut may cross the channel anywhere outside the drawn edge.
        let start = -mouth.length - 1e-3;
        let most = if sketch.cuts.is_empty() { 2.0 * (mouth.beyond + by) } else { f64::INFINITY };
        let first = [-mouth.half, 0.0, mouth.half].map(|across| {
            let way = [start, far].map(|along| mouth.point(along, across));
            [&cuts, &bands].map(|segments| first(mouth, way, segments))
        });
        let is_closed = first.iter().any(|[cut, band]| cut >= band);
        let ahead = first[1][0];
        if !is_closed && ahead <= most {
            continue;
        }
        let names = [sketch.ports[mouth.port].name.clone()];
        let port = quoted(&names);
        let (what, numbers) = if is_closed {
            (format!("a band lies between the mouth of port {port} and the cut"), [f64::NAN; 2])
        } else {
            (format!("the cut passes {ahead:.3} mm in front of the mouth of port {port}"), [ahead, most])
        };
        let text = (what, rules.room_in_front());
        notes.fault(ShapeCode::BandsOverlap, &names, mouth.at, text, numbers);
    }
}

/// The distance past the mouth at which the `way` out first meets one of the `segments`; infinite if it does not.
fn first(mouth: &Mouth, way: [Point; 2], segments: &Segments) -> f64 {
    let way = Segment::Line(Chord::new(way[0], way[1]));
    let met = segments.near(way.bounds()).flat_map(|near| intersections(&near.segment, &way));
    met.map(|p| mouth.local(p).0).fold(f64::INFINITY, f64::min)
}
