//! Corners that the iron cannot follow: **hairpins** of welds, whose legs lie on each other, and hinges sharper than the iron is round.

use crate::bands::{Band, Bands};
use crate::fault::{Quoted, ShapeCode, ShapeFault, ShapeWarning};
use crate::segments::Segments;
use crate::sketch::Rules;
use geom::order::sort_by;
use geom::{Path, Point, Segment};

/// Faults of sharp corners of welds and walls whose legs, as far as both go, are never a band from each other. Legs shorter than the band
/// are its end.
///
/// The search for bottlenecks leaves out neighbours, which are near each other at every corner.
pub(super) fn hairpins(bands: &[Band], width: f64) -> Vec<ShapeFault> {
    let mut faults = Vec::new();
    for band in bands.iter().filter(|band| band.kind.is_inner()) {
        let segments = &band.path.segments;
        let mut stations = vec![0.0];
        for segment in segments {
            stations.push(stations[stations.len() - 1] + segment.length());
        }
        for (i, pair) in segments.windows(2).enumerate() {
            if pair[0].tangent(1.0).dot(pair[1].tangent(0.0)) >= 0.0 {
                continue;
            }
            let spread = leg_spread(&band.path, &stations, i + 1, width);
            if let Some(spread) = spread.filter(|spread| *spread < width - 1e-6) {
                let finding = format!(
                    "the legs of a corner of {} lie at most {spread:.3} mm from each other",
                    Quoted(&band.names)
                );
                let remedy = format!("spread them to at least {width} mm, or draw one line");
                let fault = ShapeFault::new(ShapeCode::BandsOverlap, pair[1].start(), finding, remedy);
                faults.push(ShapeFault { names: band.names.clone(), found: spread, allowed: width, ..fault });
            }
        }
    }
    faults
}

/// The largest distance of points equally far from the corner before the segment `number` on both legs, where it is known to be below `band`;
/// `None` for legs shorter than that. `stations` are the lengths before each segment.
fn leg_spread(path: &Path, stations: &[f64], number: usize, band: f64) -> Option<f64> {
    let (corner, length) = (stations[number], stations[stations.len() - 1]);
    let shorter = corner.min(length - corner);
    if shorter <= band {
        return None;
    }
    let mut spread = spread_at(path, stations, corner, shorter);
    // A quarter more each time: few places, however long the legs are.
    let mut distance = band / 2.0;
    while distance < shorter && spread < band {
        spread = spread.max(spread_at(path, stations, corner, distance));
        distance *= 1.25;
    }
    Some(spread)
}

/// The distance of the two points of `path` that lie `distance` mm along it from the station `corner`.
fn spread_at(path: &Path, stations: &[f64], corner: f64, distance: f64) -> f64 {
    let [a, b] = [corner - distance, corner + distance].map(|s| {
        let i = stations.partition_point(|start| *start <= s).clamp(1, path.segments.len()) - 1;
        path.segments[i].point(((s - stations[i]) / (stations[i + 1] - stations[i])).clamp(0.0, 1.0))
    });
    a.distance(b)
}

/// Distance below which only one of the unsealed places of an edge is reported, mm.
const APART: f64 = 10.0;

/// A place of an edge that the band does not seal.
#[derive(Clone, Copy)]
struct UnsealedPlace {
    /// Length of the fabric between edge and band, mm.
    length: f64,
    place: Point,
    /// The number of the nearest band.
    band: usize,
}

/// Warnings of hinges and slits narrower than the iron is round, where fabric between the air's edge and the band stays unsealed.
pub(super) fn sharp_corners(bands: &Bands, rules: &Rules) -> Vec<ShapeWarning> {
    let segments = Segments::new(bands.list.iter().map(|band| &band.path));
    let mut warnings = Vec::new();
    for edge in &bands.air.edges {
        for (unsealed, further) in separate_places(unsealed_places(edge, bands, &segments, rules), rules) {
            let further = match further {
                0 => String::new(),
                further => format!(" (and {further} more within {APART} mm)"),
            };
            let UnsealedPlace { length, place, band } = unsealed;
            let names = bands.list[band].names.clone();
            let finding = format!(
                "a hinge of {} is sharper than the iron, {length:.3} mm or more stay unsealed{further}",
                Quoted(&names)
            );
            let remedy = format!("round it with at least {} mm", rules.band / 2.0);
            let fault = ShapeFault::new(ShapeCode::SharpCorner, place, finding, remedy);
            warnings.push(ShapeFault { names, found: length, allowed: 0.0, ..fault });
        }
    }
    warnings
}

/// The unsealed places of an edge. The corners of a port are its own, not the drawing's.
fn unsealed_places(edge: &Path, bands: &Bands, segments: &Segments, rules: &Rules) -> Vec<UnsealedPlace> {
    let is_drawn = |place: &Point| bands.mouths.iter().all(|mouth| !mouth.has_corner(*place, 0.0));
    let mut unsealed = Vec::new();
    for place in inward_places(edge).filter(is_drawn) {
        let mut nearest = (f64::INFINITY, 0);
        let distance = segments.index.least_distance(place, |i| {
            let distance = segments.list[i].segment.distance(place);
            if distance < nearest.0 {
                nearest = (distance, segments.list[i].path);
            }
            distance
        });
        let length = distance - rules.band / 2.0;
        if length > 0.05 * rules.band {
            unsealed.push(UnsealedPlace { length, place, band: nearest.1 });
        }
    }
    unsealed
}

/// The longest of unsealed places near each other, each with the number of further ones that lie half a band apart.
fn separate_places(mut places: Vec<UnsealedPlace>, rules: &Rules) -> Vec<(UnsealedPlace, usize)> {
    sort_by(&mut places, |a, b| b.length.total_cmp(&a.length));
    let mut groups: Vec<Vec<UnsealedPlace>> = Vec::new();
    for place in places {
        let group = groups.iter_mut().find(|group| group[0].place.distance(place.place) <= APART);
        match group {
            Some(group) => {
                if group.iter().all(|other| other.place.distance(place.place) > rules.band / 2.0) {
                    group.push(place);
                }
            }
            None => groups.push(vec![place]),
        }
    }
    groups.iter().map(|group| (group[0], group.len() - 1)).collect()
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
