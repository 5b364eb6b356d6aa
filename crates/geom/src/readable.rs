//! Numbers for people: six significant digits.

use std::fmt;

/// Prints a number for people: at most six significant digits, no trailing zeros, no exponent.
pub struct Readable(pub f64);

impl fmt::Display for Readable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x = self.0;
        if x == 0.0 || !x.is_finite() {
            return write!(f, "{}", if x == 0.0 { 0.0 } else { x });
        }
        let text = format!("{x:.0$}", decimals(x));
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        f.write_str(if text == "-0" { "0" } else { text })
    }
}

/// Decimals that give a number other than 0 six significant digits, if it has fractions so far up.
pub fn decimals(x: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is below 400")]
    let exponent = libm::log10(x.abs()).floor() as i32;
    usize::try_from(5 - exponent).unwrap_or(0)
}
