//! Chambers whose seams are next to each other.

use inflatable::geom::{Enclosures, Path, path_distance};

/// Whether two regions of air are so near to each other that their seams share a band, or lie within a band's width of each other.
pub(super) fn share_a_band(air: &[Path], band: f64) -> bool {
    let near = 3.0 * band + 1e-3;
    let regions: Vec<Enclosures> = air.iter().map(|edge| Enclosures::new([edge])).collect();
    let is_in = |inner: usize, outer: usize| {
        let place = air[inner].start();
        inner != outer && place.is_some_and(|place| !regions[outer].around(place).is_empty())
    };
    let count = air.len();
    let is_island: Vec<bool> =
        (0..count).map(|edge| (0..count).filter(|outer| is_in(edge, *outer)).count() % 2 == 1).collect();
    // Fabric lies between two chambers, and between an island and a chamber in it.
    let parted_by_fabric = |a: usize, b: usize| match (is_island[a], is_island[b]) {
        (false, false) => true,
        (true, false) => is_in(b, a),
        (false, true) => is_in(a, b),
        (true, true) => false,
    };
    (0..count).any(|a| {
        (0..a).any(|b| {
            let boxes = air[a].bounds().grown(near).overlaps(&air[b].bounds());
            boxes && parted_by_fabric(a, b) && path_distance(&air[a], &air[b]) <= near
        })
    })
}
