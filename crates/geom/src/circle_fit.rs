//! The circle that fits points best.

use crate::{Point, Vec2};

/// Steps of the Gauss-Newton method; each squares the error of points that lie nearly on a circle.
const STEPS: u32 = 20;
/// Determinant below which points count as straight, by the square of the sum of squares around their middle.
const STRAIGHT: f64 = 1e-14;

/// The centre and the radius of the circle with the least sum of squared distances from `points`; `None` of points that lie on a line or in one
/// place, or of fewer than three.
///
/// The start is the circle of the least algebraic distance (Kasa, IEEE Trans. Instrum. Meas. 25, 1976); Gauss-Newton steps of the centre
/// follow, with the mean distance as the radius.
pub fn fitted_circle(points: &[Point]) -> Option<(Point, f64)> {
    if points.len() < 3 {
        return None;
    }
    let middle = points[0] + mean(points.iter().map(|point| *point - points[0]));
    let from_middle: Vec<Vec2> = points.iter().map(|point| *point - middle).collect();
    let squares: Vec<f64> = from_middle.iter().map(|vector| vector.dot(*vector)).collect();
    let scale: f64 = squares.iter().sum();
    let mut center = middle + least_squares(&from_middle, &squares, scale)? * 0.5;
    for _ in 0..STEPS {
        let radius = mean_distance(points, center);
        let outwards: Vec<Vec2> = points.iter().map(|point| (*point - center).normalized()).collect();
        let mean_outwards = mean(outwards.iter().copied());
        let directions: Vec<Vec2> = outwards.iter().map(|direction| *direction - mean_outwards).collect();
        let errors: Vec<f64> = points.iter().map(|point| point.distance(center) - radius).collect();
        // Unit vectors have a sum of squares of at most their number.
        match least_squares(&directions, &errors, number(points.len())) {
            Some(step) => center = center + step,
            None => break,
        }
    }
    let radius = mean_distance(points, center);
    radius.is_finite().then_some((center, radius))
}

fn mean_distance(points: &[Point], center: Point) -> f64 {
    points.iter().map(|point| point.distance(center)).sum::<f64>() / number(points.len())
}

fn mean(vectors: impl ExactSizeIterator<Item = Vec2>) -> Vec2 {
    let count = number(vectors.len());
    vectors.fold(Vec2::new(0.0, 0.0), |sum, vector| sum + vector) * (1.0 / count)
}

#[expect(clippy::cast_precision_loss, reason = "far below 2^52")]
fn number(count: usize) -> f64 {
    count as f64
}

/// The vector x with the least sum of (a . x - b)^2 over `rows` a and `values` b; `None` where rows are parallel in comparison with `scale`.
fn least_squares(rows: &[Vec2], values: &[f64], scale: f64) -> Option<Vec2> {
    let (mut xx, mut xy, mut yy, mut x, mut y) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (row, value) in rows.iter().zip(values) {
        xx += row.x * row.x;
        xy += row.x * row.y;
        yy += row.y * row.y;
        x += row.x * value;
        y += row.y * value;
    }
    let determinant = xx * yy - xy * xy;
    (determinant > STRAIGHT * scale * scale)
        .then(|| Vec2::new((yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_arc(center: Point, radius: f64, sweep: f64) -> Vec<Point> {
        (0..33).map(|k| center + Vec2::unit(0.7 + sweep * f64::from(k) / 32.0) * radius).collect()
    }

    fn sum_of_squares(points: &[Point], center: Point, radius: f64) -> f64 {
        points.iter().map(|point| (point.distance(center) - radius).powi(2)).sum()
    }

    #[test]
    fn points_of_an_arc_give_its_circle() {
        for (radius, sweep) in [(50.0, 6.0), (50.0, 1.0), (2.0, -0.3), (500.0, 0.1)] {
            let center = Point::new(31.0, -800.0);
            let (fitted_center, fitted_radius) =
                fitted_circle(&on_arc(center, radius, sweep)).expect("a circle");
            assert!((fitted_radius - radius).abs() < 1e-6 * radius, "{fitted_radius}");
            assert!(fitted_center.distance(center) < 1e-6 * radius, "{fitted_center:?}");
        }
    }

    #[test]
    fn the_fit_is_the_least_geometric_distance() {
        let mut points = on_arc(Point::ORIGIN, 10.0, 1.2);
        for (k, point) in (0_u32..).zip(points.iter_mut()) {
            let wave = 0.1 * f64::from(k).sin();
            *point = Point::ORIGIN + (*point - Point::ORIGIN) * (1.0 + wave / 10.0);
        }
        let (center, radius) = fitted_circle(&points).expect("a circle");
        let least_sum = sum_of_squares(&points, center, radius);
        for (x, y, r) in [(0.01, 0.0, 0.0), (0.0, 0.01, 0.0), (0.0, 0.0, 0.01), (-0.01, 0.01, 0.01)] {
            assert!(sum_of_squares(&points, center + Vec2::new(x, y), radius + r) > least_sum);
        }
    }

    #[test]
    fn a_line_has_no_circle() {
        let line: Vec<Point> = (0..9).map(|k| Point::new(f64::from(k), 3.0 * f64::from(k))).collect();
        assert_eq!(fitted_circle(&line), None);
        assert_eq!(fitted_circle(&[Point::ORIGIN; 5]), None);
        assert_eq!(fitted_circle(&line[..2]), None);
    }
}
