//! Numbers for people: as many digits as are of use.

use crate::units::Readable;

/// Digits that a person compares, and more than any prediction is good for.
const DIGITS: i32 = 3;

/// `value` to three significant digits, without an exponent.
pub(super) fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return Readable(value).to_string();
    }
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is below 400")]
    let exponent = value.abs().log10().floor() as i32;
    let scale = 10_f64.powi((DIGITS - 1 - exponent).clamp(-300, 300));
    Readable((value * scale).round() / scale).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_are_left_and_none_is_invented() {
        for (value, text) in [
            (15.823_01, "15.8"),
            (1.452_15, "1.45"),
            (0.052_961_5, "0.053"),
            (2941.15, "2940"),
            (0.999_6, "1"),
            (50.0, "50"),
            (-13.37, "-13.4"),
            (0.0, "0"),
            (1e-9, "0.000000001"),
        ] {
            assert_eq!(rounded(value), text);
        }
    }
}
