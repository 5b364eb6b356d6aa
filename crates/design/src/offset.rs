//! Closed paths of lines and arcs, grown or shrunk by a distance.

use cavalier_contours::polyline::PlineSource;

use geom::Path;
use sealed::{of_polyline, polyline};

/// A closed counterclockwise path whose every point lies `distance` outside `path`, round at its outward corners, or `-distance`
/// inside it; `None` if nothing comes out, or what is shrunk falls apart.
pub(super) fn offset(path: &Path, distance: f64) -> Option<Path> {
    if distance == 0.0 {
        return Some(path.clone());
    }
    // To the right of a counterclockwise path is outside.
    let loops = polyline(path).parallel_offset(-distance);
    let largest = if distance > 0.0 {
        // Where a wedge closes up, the offset also has islands.
        loops.iter().max_by(|a, b| a.area().total_cmp(&b.area()))?
    } else {
        loops.first().filter(|_| loops.len() == 1)?
    };
    let contour = of_polyline(largest);
    let area = contour.area();
    (area > 0.0 && (area > path.area()) == (distance > 0.0)).then_some(contour)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::{Line, Point};
    use std::f64::consts::PI;

    fn rectangle(width: f64, height: f64) -> Path {
        let corners =
            [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(|(x, y)| Point::new(x, y));
        let lines = (0..4).map(|i| Line::new(corners[i], corners[(i + 1) % 4]).into());
        Path::closed(lines.collect())
    }

    /// Steiner's formula: A(r) = A + r L + pi r^2 for a convex outline; inwards a rectangle stays one.
    #[test]
    fn a_rectangle_grows_and_shrinks_as_it_must() {
        let path = rectangle(20.0, 10.0);
        for by in [1e-3, 0.1, 3.0] {
            let area = offset(&path, by).expect("there is room").area();
            assert!((area - (200.0 + 60.0 * by + PI * by * by)).abs() < 1e-9, "{by}: {area}");
            let shrunk = offset(&path, -by).expect("it is wide enough").area();
            assert!((shrunk - (20.0 - 2.0 * by) * (10.0 - 2.0 * by)).abs() < 1e-9, "{by}: {shrunk}");
        }
        assert_eq!(offset(&path, 0.0), Some(path));
    }

    #[test]
    fn what_vanishes_or_falls_apart_is_nothing() {
        assert_eq!(offset(&rectangle(20.0, 10.0), -5.5), None);
        // A dumbbell whose handle is 1 wide.
        let half = [
            corner(0.0, 0.0),
            corner(10.0, 0.0),
            corner(10.0, 4.5),
            corner(20.0, 4.5),
            corner(20.0, 0.0),
            corner(30.0, 0.0),
        ];
        let corners: Vec<Point> =
            half.into_iter().chain(half.into_iter().rev().map(|p| corner(p.x, 10.0 - p.y))).collect();
        let line = |i: usize| Line::new(corners[i], corners[(i + 1) % corners.len()]).into();
        let dumbbell = Path::closed((0..corners.len()).map(line).collect());
        assert!(offset(&dumbbell, -0.4).is_some());
        assert_eq!(offset(&dumbbell, -0.6), None);
    }

    fn corner(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }
}
