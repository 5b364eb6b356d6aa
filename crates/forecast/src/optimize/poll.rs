//! Scan and poll of a search: a **scan** fills the box evenly, a **poll** tries steps in all directions around a place.
//!
//! A poll's directions rotate from one poll to the next, so that no edge between constraints stops the search in any orientation: they are
//! the columns of I - 2 v v^T with v from the scan's own sequence, which is the same on every run.

/// Values that a search may vary, each as a part of its side of the box, 0 to 1.
pub(super) const AXES: usize = 6;

/// A point of the unit cube, mapped to the box: tip angle, width, tip, corner and inner radius, pressure.
pub(super) type UnitPoint = [f64; AXES];

/// Bases of the scan, one an axis that is varied.
const BASES: [u32; AXES] = [2, 3, 5, 7, 11, 13];

/// Place `index` of the Halton sequence in the axes `varied`; 0 in all others.
pub(super) fn scanned(index: u32, varied: &[usize]) -> UnitPoint {
    let mut place = [0.0; AXES];
    for (axis, base) in varied.iter().zip(BASES) {
        place[*axis] = mirrored(index, base);
    }
    place
}

/// The digits of `index` in `base`, mirrored at the point.
fn mirrored(index: u32, base: u32) -> f64 {
    let (mut rest, mut part, mut sum) = (index, 1.0, 0.0);
    while rest > 0 {
        part /= f64::from(base);
        sum += part * f64::from(rest % base);
        rest /= base;
    }
    sum
}

/// The places that poll number `round` tries around `place` at distance `step` along the axes `varied`; even rounds go along the axes.
pub(super) fn polled(place: UnitPoint, step: f64, varied: &[usize], round: u32) -> Vec<UnitPoint> {
    let normal: Vec<f64> = if round.is_multiple_of(2) {
        vec![0.0; varied.len()]
    } else {
        let direction: Vec<f64> =
            BASES.iter().take(varied.len()).map(|base| mirrored(round, *base) - 0.5).collect();
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 { direction.iter().map(|x| x / length).collect() } else { direction }
    };
    let neighbours = (0..varied.len()).flat_map(|k| {
        [-1.0, 1.0].map(|sign| {
            let mut trial = place;
            for (i, axis) in varied.iter().enumerate() {
                let direction = f64::from(u8::from(i == k)) - 2.0 * normal[i] * normal[k];
                trial[*axis] = (trial[*axis] + sign * step * direction).clamp(0.0, 1.0);
            }
            trial
        })
    });
    neighbours.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The digits of the index in each base, mirrored at the point: 6 is 110, 20, 11 and 6.
    #[test]
    fn the_scan_mirrors_digits() {
        assert_eq!(scanned(1, &[0, 1, 2, 3])[..4], [1.0 / 2.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0]);
        let expected = [3.0 / 8.0, 2.0 / 9.0, 6.0 / 25.0, 6.0 / 7.0];
        let first_places = scanned(6, &[0, 1, 2, 3]);
        assert!(
            first_places
                .iter()
                .zip(expected)
                .all(|(first_places, expected)| (first_places - expected).abs() < 1e-15)
        );
        assert_eq!(scanned(3, &[4]), [0.0, 0.0, 0.0, 0.0, 0.75, 0.0]);
    }

    #[test]
    fn a_poll_goes_as_far_in_directions_that_stand_upright_on_each_other() {
        let (place, varied) = ([0.5; AXES], [0, 1, 3, 5]);
        for round in 0..9 {
            let places = polled(place, 0.1, &varied, round);
            assert_eq!(places.len(), 8);
            let moved: Vec<Vec<f64>> =
                places.iter().map(|to| to.iter().zip(place).map(|(to, from)| to - from).collect()).collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
            for (i, a) in moved.iter().enumerate() {
                assert!((dot(a, a) - 0.01).abs() < 1e-12 && a[2] == 0.0 && a[4] == 0.0);
                assert!(moved.iter().skip(i + 1).all(|b| dot(a, b).abs() < 1e-12 || dot(a, b) < -0.0099));
            }
        }
    }
}
