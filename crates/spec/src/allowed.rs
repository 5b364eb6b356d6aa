//! Ranges of allowed values.

use serde_json::{Value, json};

use crate::units::Readable;

/// Lengths greater than zero: 1 um to 100 m, at both ends far beyond the abilities of fabric and iron.
pub(super) const SIZE: Allowed = Allowed::closed(1e-3, 1e5);
/// Lengths that may be zero, up to 100 m.
pub(super) const EXTRA: Allowed = Allowed::closed(0.0, 1e5);
/// Speeds of the iron, mm/s.
pub const SEAL_SPEEDS: Allowed = Allowed::closed(1e-3, 1e3);

/// A range of numbers, each end in or out; it never holds NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowed {
    low: f64,
    low_in: bool,
    high: f64,
    high_in: bool,
}

impl Allowed {
    /// `low <= x <= high`.
    pub const fn closed(low: f64, high: f64) -> Self {
        Self { low, low_in: true, high, high_in: true }
    }

    /// `low < x <= high`.
    pub const fn half_open(low: f64, high: f64) -> Self {
        Self { low, low_in: false, high, high_in: true }
    }

    /// `low < x < high`.
    pub const fn open(low: f64, high: f64) -> Self {
        Self { low, low_in: false, high, high_in: false }
    }

    /// Whether `x` is in the range.
    pub fn contains(self, x: f64) -> bool {
        let low = if self.low_in { x >= self.low } else { x > self.low };
        let high = if self.high_in { x <= self.high } else { x < self.high };
        low && high
    }

    /// As JSON Schema.
    pub(super) fn schema(self) -> Value {
        let low = if self.low_in { "minimum" } else { "exclusiveMinimum" };
        let high = if self.high_in { "maximum" } else { "exclusiveMaximum" };
        json!({ "type": "number", low: self.low, high: self.high })
    }

    /// The range in words; `unit` is "" for plain numbers.
    pub fn in_words(self, unit: &str) -> String {
        let gap = if unit.is_empty() { "" } else { " " };
        format!(
            "must be {} {}{gap}{unit} and {} {}{gap}{unit}",
            if self.low_in { "at least" } else { "more than" },
            Readable(self.low),
            if self.high_in { "at most" } else { "less than" },
            Readable(self.high),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_in_or_out_as_said() {
        assert!(Allowed::closed(0.0, 1.0).contains(0.0) && Allowed::closed(0.0, 1.0).contains(1.0));
        assert!(!Allowed::half_open(0.0, 1.0).contains(0.0) && Allowed::half_open(0.0, 1.0).contains(1.0));
        assert!(!Allowed::open(0.0, 1.0).contains(1.0) && Allowed::open(0.0, 1.0).contains(0.5));
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!Allowed::closed(-1e300, 1e300).contains(x));
        }
    }

    #[test]
    fn words_name_both_ends() {
        assert_eq!(Allowed::half_open(-1.0, 0.5).in_words(""), "must be more than -1 and at most 0.5");
        assert_eq!(
            Allowed::open(0.0, 180.0).in_words("deg"),
            "must be more than 0 deg and less than 180 deg"
        );
    }
}
