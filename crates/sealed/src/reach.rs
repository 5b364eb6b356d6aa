//! Mouths that no cut reaches: the sheets stay one piece in front of them, and no hose goes in.

use crate::fault::{ShapeCode, quoted};
use crate::layout::Layout;
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
        let closing = first.iter().find(|[cut, band]| cut.0 >= band.0).map(|[_, band]| *band);
        let (ahead, _) = first[1][0];
        if closing.is_none() && ahead <= most {
            continue;
        }
        let mut names = vec![sketch.ports[mouth.port].name.clone()];
        let port = quoted(&names);
        let (what, place, numbers) = match closing {
            Some((along, Some(line))) => {
                let band = &lines.lines[line].names;
                let what = format!("the band of {} closes the way out of port {port}", quoted(band));
                names.extend(band.clone());
                (what, mouth.point(along, 0.0), [f64::NAN; 2])
            }
            Some((_, None)) => {
                (format!("no cut lies in front of the mouth of port {port}"), mouth.at, [f64::NAN; 2])
            }
            None => {
                let what = format!("the cut passes {ahead:.3} mm in front of the mouth of port {port}");
                (what, mouth.at, [ahead, most])
            }
        };
        let text = (what, rules.room_in_front());
        notes.fault(ShapeCode::ChannelOverlap, &names, place, text, numbers);
    }
}

/// The distance past the mouth at which the `way` out first meets one of the `segments`, and the number of its path; infinite if it does
/// not.
fn first(mouth: &Mouth, way: [Point; 2], segments: &Segments) -> (f64, Option<usize>) {
    let way = Segment::Line(Chord::new(way[0], way[1]));
    let met = segments.near(way.bounds()).flat_map(|near| {
        let places = intersections(&near.segment, &way).into_iter();
        places.map(|p| (mouth.local(p).0, Some(near.path)))
    });
    met.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, None))
}
