//! Ranges whose ends count as inside within rounding.

use std::ops::RangeInclusive;

/// Relative distance beyond an end that still counts as inside: a quotient of two numbers that people write is off by
/// less.
const ROUNDING: f64 = 1e-12;

/// Whether `value` is in `range` within rounding: 0.9 mm / 30 mm is in 0 to 0.03. NaN is in no range.
pub fn spans(range: &RangeInclusive<f64>, value: f64) -> bool {
    let (minimum, maximum) = (*range.start(), *range.end());
    value >= minimum - ROUNDING * minimum.abs() && value <= maximum + ROUNDING * maximum.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_is_inside_however_it_was_rounded() {
        assert!(spans(&(0.003..=0.03), 0.03_f64.next_up().next_up()));
        assert!(spans(&(0.003..=0.03), 0.003_f64.next_down()));
        assert!(!spans(&(0.003..=0.03), 0.03 * (1.0 + 1e-9)) && !spans(&(0.003..=0.03), f64::NAN));
        assert!(spans(&(0.0..=1.0), 0.0) && !spans(&(0.0..=1.0), -1e-300));
    }
}
