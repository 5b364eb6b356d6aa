//! Polylines for the eye: paths as few whole numbers, hundredths of a millimetre, each point as its way from the one before.

use crate::emit::chords::chords;
use geom::{Path, Point};

/// Largest distance of a polyline from its path, mm, beside rounding: a tenth of what is visible where a star fills a screen.
const WITHIN: f64 = 0.02;
/// Largest distance of the chords that it is chosen from to the path, mm.
const CHORD: f64 = 0.005;

/// The path's corners, first absolute, then each as a step, in hundredths of a millimetre; a closed one does not return.
pub(super) fn polyline(path: &Path) -> Vec<i64> {
    let corners = chords(path, CHORD);
    let mut corners_kept = thinned(&corners);
    if path.closed && corners_kept.len() > 1 && corners_kept.first() == corners_kept.last() {
        let _ = corners_kept.pop();
    }
    let (mut steps, mut last) = (Vec::with_capacity(2 * corners_kept.len()), (0, 0));
    for point in corners_kept {
        let rounded = (hundredths(point.x), hundredths(point.y));
        steps.extend([rounded.0 - last.0, rounded.1 - last.1]);
        last = rounded;
    }
    steps
}

/// A length in hundredths of a millimetre.
pub(super) fn hundredths(mm: f64) -> i64 {
    #[expect(clippy::cast_possible_truncation, reason = "below 1e7, and saturating")]
    let rounded = (mm * 100.0).round() as i64;
    rounded
}

/// The points without those that lie within [`WITHIN`] of the lines between the others (Douglas and Peucker).
fn thinned(points: &[Point]) -> Vec<Point> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut is_kept = vec![false; points.len()];
    is_kept[0] = true;
    is_kept[last] = true;
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let line = (points[from], points[to]);
        let worst = (from + 1..to)
            .map(|i| (i, distance_from_line(line, points[i])))
            .fold((from, 0.0), |best: (usize, f64), next| if next.1 > best.1 { next } else { best });
        if worst.1 > WITHIN {
            is_kept[worst.0] = true;
            open.extend([(from, worst.0), (worst.0, to)]);
        }
    }
    points.iter().zip(is_kept).filter(|(_, is_kept)| *is_kept).map(|(point, _)| *point).collect()
}

/// Distance of `p` from the line between two points.
fn distance_from_line((a, b): (Point, Point), p: Point) -> f64 {
    let chord = b - a;
    let length = chord.dot(chord);
    let share = if length > 0.0 { ((p - a).dot(chord) / length).clamp(0.0, 1.0) } else { 0.0 };
    a.lerp(b, share).distance(p)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::{Arc, Line, Segment};

    #[test]
    fn few_points_stay_near_the_path() {
        let circle =
            Path::closed(vec![Arc::new(Point::new(7.0, -3.0), 30.0, 0.3, std::f64::consts::TAU).into()]);
        let line = Path::open(vec![Segment::from(Line::new(Point::new(0.0, 0.0), Point::new(1.0, 2.0))); 1]);
        assert_eq!(polyline(&line), [0, 0, 100, 200]);
        let numbers = polyline(&circle);
        assert!(numbers.len() < 300, "{}", numbers.len());
        let (mut x, mut y) = (0, 0);
        let mut corners = Vec::new();
        for step in numbers.chunks(2) {
            (x, y) = (x + step[0], y + step[1]);
            #[expect(clippy::cast_precision_loss, reason = "small")]
            corners.push(Point::new(x as f64 / 100.0, y as f64 / 100.0));
        }
        let next = corners.iter().cycle().skip(1);
        for (a, b) in corners.iter().zip(next) {
            let radius = a.midpoint(*b).distance(Point::new(7.0, -3.0));
            assert!((radius - 30.0).abs() < WITHIN + CHORD + 0.01, "{radius}");
        }
    }
}
