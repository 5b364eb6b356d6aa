//! The rigid motion in space that lays a shape best on its flat chamber.

use crate::shell::element::vector::{Vector, add_scaled, dot, minus, times};

/// A rotation by a unit quaternion about one point, which then lies at another.
pub(super) struct RigidMotion {
    rows: [Vector; 3],
    from: Vector,
    to: Vector,
}

/// Squarings of the matrix whose largest eigenvector is the rotation: what differs from it by a millionth of a millionth is then gone.
const SQUARINGS: u32 = 48;

impl RigidMotion {
    /// The motion that lays `points` best on `flat`, by the mean of squares weighted by `areas`.
    ///
    /// B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions" (1987), section 4: the quaternion is the eigenvector
    /// of the largest eigenvalue of a symmetric matrix, here by squaring that matrix again and again.
    pub(super) fn on_flat(points: &[Vector], flat: &[[f64; 2]], areas: &[f64]) -> Self {
        let flat: Vec<Vector> = flat.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
        let (from, to) = (mean(points, areas), mean(&flat, areas));
        let mut sums = [[0.0; 3]; 3];
        for ((point, place), area) in points.iter().zip(&flat).zip(areas) {
            let (x, y) = (minus(*point, from), minus(*place, to));
            for (row, x) in sums.iter_mut().zip(x) {
                *row = add_scaled(*row, area * x, y);
            }
        }
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = sums;
        let mut matrix = [
            [xx + yy + zz, yz - zy, zx - xz, xy - yx],
            [yz - zy, xx - yy - zz, xy + yx, zx + xz],
            [zx - xz, xy + yx, yy - xx - zz, yz + zy],
            [xy - yx, zx + xz, yz + zy, zz - xx - yy],
        ];
        // With its norm on the diagonal no eigenvalue is negative.
        let size = norm(&matrix);
        (0..4).for_each(|k| matrix[k][k] += size);
        for _ in 0..SQUARINGS {
            let scale = 1.0 / norm(&matrix);
            matrix = product(&matrix.map(|row| row.map(|x| scale * x)));
        }
        let [w, x, y, z] = largest_column(&matrix);
        let rows = [
            [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ];
        Self { rows, from, to }
    }

    /// The place of a point of the shape.
    pub(super) fn place(&self, point: Vector) -> Vector {
        let arm = minus(point, self.from);
        add_scaled(self.rows.map(|row| dot(row, arm)), 1.0, self.to)
    }
}

fn mean(points: &[Vector], areas: &[f64]) -> Vector {
    let sum = points.iter().zip(areas).fold([0.0; 3], |sum, (point, area)| add_scaled(sum, *area, *point));
    times(1.0 / areas.iter().sum::<f64>(), sum)
}

/// The root of the sum of squares.
fn norm(matrix: &[[f64; 4]; 4]) -> f64 {
    matrix.iter().flatten().map(|x| x * x).sum::<f64>().sqrt()
}

/// A symmetric matrix times itself.
fn product(matrix: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    matrix.map(|row| matrix.map(|other| row.iter().zip(other).map(|(a, b)| a * b).sum()))
}

/// The largest column of a matrix of rank one, of unit length: its eigenvector.
fn largest_column(matrix: &[[f64; 4]; 4]) -> [f64; 4] {
    let column = matrix.iter().copied().max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or([0.0; 4]);
    let scale = length(&column);
    column.map(|x| x / scale)
}

/// The length of a column.
fn length(column: &[f64; 4]) -> f64 {
    column.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A long bent strip, turned about a slanted axis and moved, lies where it was, whichever points count how much.
    #[test]
    fn a_turned_shape_is_turned_back() {
        let (count, flat): (u32, Vec<[f64; 2]>) =
            (40, (0..40).map(|k| [0.1 * f64::from(k), 0.1 * f64::from(k % 3)]).collect());
        let areas: Vec<f64> = (0..count).map(|k| 1.0 + 0.3 * f64::from(k % 5)).collect();
        let shape: Vec<Vector> = flat.iter().map(|[x, y]| [*x, *y, 0.05 * x * x]).collect();
        let expected_points: Vec<Vector> = {
            let motion = RigidMotion::on_flat(&shape, &flat, &areas);
            shape.iter().map(|point| motion.place(*point)).collect()
        };
        for angle in [-2.0, 0.4, 3.0] {
            let (sine, cosine) = f64::sin_cos(angle);
            let turned: Vec<Vector> = shape
                .iter()
                .map(|[x, y, z]| {
                    let [x, y] = [cosine * x - sine * y, sine * x + cosine * y];
                    let [y, z] = [cosine * y - sine * z, sine * y + cosine * z];
                    [x + 3.0, y - 1.0, z + 0.2]
                })
                .collect();
            let motion = RigidMotion::on_flat(&turned, &flat, &areas);
            for (point, expected) in turned.iter().zip(&expected_points) {
                let error = minus(motion.place(*point), *expected);
                assert!(dot(error, error).sqrt() < 1e-9, "{angle}: {error:?}");
            }
        }
    }
}
