//! The only place where a coordinate becomes text.

use geom::{Grid, Point};
use spec::units::Length;

/// A fixed number of decimals: every coordinate of a file is on a [`Grid`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimals(Grid);

impl Decimals {
    /// As many decimals as keep rounding below a tenth of the tolerance `path`: see [`Grid::for_tolerance`].
    pub fn for_tolerance(path: Length) -> Self {
        Self(Grid::for_tolerance(path.0))
    }

    /// Exactly `n` decimals, at most 9.
    pub fn exactly(n: u32) -> Self {
        Self(Grid::new(n))
    }

    /// The nearest number that the file can express.
    pub fn round(self, x: f64) -> f64 {
        self.0.round(x)
    }

    /// The nearest point that the file can express.
    pub fn round_point(self, p: Point) -> Point {
        self.0.round_point(p)
    }

    /// Appends `x` in decimal notation without trailing zeros, never `-0`.
    pub fn write(self, text: &mut String, x: f64) {
        let quanta = self.0.quanta(x);
        if quanta < 0 {
            text.push('-');
        }
        let (mut rest, mut decimals) = (quanta.unsigned_abs(), self.0.decimals());
        while decimals > 0 && rest.is_multiple_of(10) {
            rest /= 10;
            decimals -= 1;
        }
        let mut digits = Digits { text: [0; 24], at: 24 };
        if decimals > 0 {
            digits.take(&mut rest, decimals);
            digits.push(b'.');
        }
        // At least one digit comes before the point.
        digits.take(&mut rest, 1);
        while rest > 0 {
            let count = if rest < 10 { 1 } else { 2 };
            digits.take(&mut rest, count);
        }
        // One by one: checking a few bytes for UTF-8, and copying them, takes longer.
        for byte in &digits.text[digits.at..] {
            text.push(char::from(*byte));
        }
    }

    /// `x` as text, see [`Decimals::write`].
    pub fn text(self, x: f64) -> String {
        let mut text = String::new();
        self.write(&mut text, x);
        text
    }
}

/// A value from the spec, to nine decimals: more than any controller reads.
pub fn number(x: f64) -> String {
    Decimals::exactly(9).text(x)
}

/// The nearest number of single precision, in which some formats have their coordinates.
pub fn single(x: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is intended")]
    let single = x as f32;
    single
}

/// A number's text, filled from the right, as the digits come out; 20 digits and a point are the most there can be.
struct Digits {
    text: [u8; 24],
    at: usize,
}

impl Digits {
    fn push(&mut self, byte: u8) {
        self.at -= 1;
        self.text[self.at] = byte;
    }

    /// Takes `count` digits off the end of `rest`, two by two: a division costs more than all the rest.
    fn take(&mut self, rest: &mut u64, count: u32) {
        for _ in 0..count / 2 {
            let pair = (*rest % 100) as u8;
            *rest /= 100;
            self.push(b'0' + pair % 10);
            self.push(b'0' + pair / 10);
        }
        if !count.is_multiple_of(2) {
            self.push(b'0' + (*rest % 10) as u8);
            *rest /= 10;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let four = Decimals::for_tolerance(Length(0.001));
        assert_eq!(four, Decimals::exactly(4));
        for (x, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (-0.000_04, "0"),
            (0.000_05, "0.0001"),
            (-0.000_05, "-0.0001"),
            (1.0, "1"),
            (-10.0, "-10"),
            (0.1, "0.1"),
            (12.34, "12.34"),
            (100.050_01, "100.05"),
            (99_999.999_96, "100000"),
            (1.000_1, "1.0001"),
        ] {
            assert_eq!(four.text(x), text, "{x}");
        }
        assert_eq!(Decimals::exactly(0).text(-1234.5), "-1235");
        assert_eq!(Decimals::exactly(9).text(0.000_000_001), "0.000000001");
    }

    #[test]
    fn rounding_takes_at_most_a_tenth_of_the_tolerance() {
        for tolerance in [0.0001, 0.001, 0.01, 0.1, 1.0] {
            let decimals = Decimals::for_tolerance(Length(tolerance));
            assert!((decimals.round(0.123_456_789) - 0.123_456_789).abs() <= tolerance / 10.0);
        }
    }

    proptest! {
        #[test]
        fn what_is_written_is_what_was_rounded(x in -1e6..1e6_f64, decimals in 0_u32..=9) {
            let decimals = Decimals::exactly(decimals);
            let text = decimals.text(x);
            prop_assert_eq!(text.parse::<f64>().expect("a number"), decimals.round(x), "{}", text);
            prop_assert!(!text.contains('.') || !text.ends_with(['0', '.']), "{}", text);
            prop_assert!(text != "-0" && !text.starts_with("-0 "));
        }
    }
}
