//! Limits as they are printed: rounded to the side on which the printed number still holds.

use std::fmt;

use geom::readable::{Readable, decimals};

/// `x`, rounded up to a tenth: an upper end that is printed so holds.
pub fn tenths_up(x: f64) -> f64 {
    (10.0 * x).ceil() / 10.0
}

/// `x`, rounded down to a tenth: less than [`tenths_up`] of any larger value.
pub fn tenths_down(x: f64) -> f64 {
    (10.0 * x).floor() / 10.0
}

/// `x`, rounded down to a hundredth: a largest value that is printed so holds.
pub fn hundredths_down(x: f64) -> f64 {
    (x * 100.0).floor() / 100.0
}

/// Prints a lower limit: as [`Readable`], but rounded up, so that the printed value satisfies it.
pub struct Least(pub f64);

impl fmt::Display for Least {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Readable(directed(self.0, f64::ceil)).fmt(f)
    }
}

/// Prints an upper limit: as [`Readable`], but rounded down, so that the printed value satisfies it.
pub struct Most(pub f64);

impl Most {
    /// The number that is printed.
    pub fn printed(&self) -> f64 {
        directed(self.0, f64::floor)
    }
}

impl fmt::Display for Most {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Readable(self.printed()).fmt(f)
    }
}

/// `x` to six significant digits, in the direction of `round`. A value within rounding of such a number becomes that number.
fn directed(x: f64, round: fn(f64) -> f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let scale = i32::try_from(decimals(x)).map_or(1.0, |decimals| 10_f64.powi(decimals));
    let (scaled, nearest) = (x * scale, (x * scale).round());
    let rounded = if (scaled - nearest).abs() <= 1e-14 * scaled.abs() { nearest } else { round(scaled) };
    let rounded = rounded / scale;
    if rounded.is_finite() { rounded } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_printed_on_the_side_that_will_do() {
        for (x, least, most) in [
            (333.039_378_8, "333.04", "333.039"),
            (147.272_727_27, "147.273", "147.272"),
            (0.1 + 0.2, "0.3", "0.3"),
            (40.0, "40", "40"),
            (0.000_123_456_78, "0.000123457", "0.000123456"),
            (-1.234_567_8, "-1.23456", "-1.23457"),
            (0.0, "0", "0"),
        ] {
            assert_eq!((Least(x).to_string().as_str(), Most(x).to_string().as_str()), (least, most), "{x}");
        }
        assert_eq!(Least(f64::INFINITY).to_string(), "inf");
    }
}
