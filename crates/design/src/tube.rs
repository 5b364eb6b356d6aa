//! The section of a star's tube when it is inflated. Its fabric keeps its length: twice the flat width.

use std::f64::consts::{FRAC_2_PI, PI};

/// Diameter of the straight tube whose flat width is `flat`, in its unit: 2 / pi of it, for its section is a circle of circumference
/// 2 W. Half of the tube rises above the fabric's plane.
pub fn round_tube(flat: f64) -> f64 {
    FRAC_2_PI * flat
}

/// Height of a tube whose flat width is `flat`, and that is `inflated` wide as seen from above: its section is an ellipse with the
/// fabric's length; 0 where it is as wide as flat.
pub fn tube_height(flat: f64, inflated: f64) -> f64 {
    if inflated >= flat {
        return 0.0;
    }
    // It grows with the height. Sixty halvings leave rounding.
    let (mut low, mut high) = (0.0, flat);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if perimeter(inflated, middle) < 2.0 * flat { low = middle } else { high = middle }
    }
    low
}

/// The length around an ellipse, by Ramanujan's second formula: good to 1e-4 for the flattest and to 1e-9 for those of tubes.
fn perimeter(width: f64, height: f64) -> f64 {
    let (a, b) = (width / 2.0, height / 2.0);
    let h = ((a - b) / (a + b)).powi(2);
    PI * (a + b) * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fabric_keeps_its_length() {
        assert!((PI * round_tube(30.0) - 60.0).abs() < 1e-12);
        assert!((tube_height(30.0, round_tube(30.0)) - round_tube(30.0)).abs() < 1e-9);
        let perimeter = |a: f64, b: f64| {
            // A thousand chords.
            let point = |i: u32| {
                let turn = f64::from(i) * PI / 500.0;
                (a / 2.0 * turn.cos(), b / 2.0 * turn.sin())
            };
            (0..1000)
                .map(|i| {
                    let (from, to) = (point(i), point(i + 1));
                    (to.0 - from.0).hypot(to.1 - from.1)
                })
                .sum::<f64>()
        };
        for width in [20.0, 22.0, 24.0, 27.0] {
            let height = tube_height(30.0, width);
            assert!((perimeter(width, height) - 60.0).abs() < 0.01, "{width} {height}");
            assert!(height < round_tube(30.0));
        }
        assert_eq!(tube_height(30.0, 30.0), 0.0);
    }
}
