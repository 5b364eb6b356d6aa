//! Decimal numbers in files, by a strict grammar: no `nan`, no `inf`, nothing out of range.

/// Largest magnitude a coordinate in a file may have: a kilometre in mm, so that squares stay exact enough.
pub(super) const LARGEST: f64 = 1e6;

/// Most digits of a whole number that `f64` always holds exactly, as it does the power of ten that they are divided by.
const EXACT: usize = 15;

/// The powers of ten.
const TENS: [f64; EXACT + 1] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// A number at the front of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Number<'a> {
    /// Value of the number; `None` beyond [`LARGEST`].
    pub(super) value: Option<f64>,
    /// Text of the number.
    pub(super) text: &'a str,
    /// The text behind it.
    pub(super) rest: &'a str,
}

impl Number<'_> {
    /// The number as the radius of an arc, which is no coordinate and may be as large as it likes; `None` if it is not finite.
    pub(super) fn radius(&self) -> Option<f64> {
        self.value.or_else(|| self.text.parse().ok().filter(|radius: &f64| radius.is_finite()))
    }
}

/// Reads `[+-] digits [. digits] [e [+-] digits]` (the exponent only if allowed) off the front of `text`.
///
/// At least one digit must come before or after the point. The text is passed once: up to [`EXACT`] digits and the power of ten
/// are exact, so that their quotient is the nearest number, as `parse` has it; longer numbers are left to `parse`.
pub(super) fn read(text: &str, exponent: bool) -> Option<Number<'_>> {
    let bytes = text.as_bytes();
    let is_negative = bytes.first() == Some(&b'-');
    let mut index = usize::from(is_negative || bytes.first() == Some(&b'+'));
    let (integer_digits, mut mantissa) = digits(&bytes[index..], 0);
    index += integer_digits;
    let mut fraction = 0;
    if bytes.get(index) == Some(&b'.') {
        index += 1;
        (fraction, mantissa) = digits(&bytes[index..], mantissa);
        index += fraction;
    }
    if integer_digits + fraction == 0 {
        return None;
    }
    let mut is_plain = integer_digits + fraction <= EXACT;
    if exponent && let Some(exponent_part) = power(&bytes[index..]) {
        index += exponent_part;
        is_plain = false;
    }
    // Only ASCII bytes were passed over, so `index` is a character boundary.
    let (number, rest) = text.split_at(index);
    let value = if is_plain {
        #[expect(clippy::cast_precision_loss, reason = "exact, see EXACT")]
        let value = mantissa as f64 / TENS[fraction];
        Some(if is_negative { -value } else { value })
    } else {
        number.parse().ok()
    };
    Some(Number { value: value.filter(|x| x.abs() <= LARGEST), text: number, rest })
}

/// The number of digits at the front of `bytes`, and the value of the digits `high_digits` continued by them.
fn digits(bytes: &[u8], high_digits: u64) -> (usize, u64) {
    let (mut count, mut value) = (0, high_digits);
    for byte in bytes {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        // A number of more digits than fit is not used.
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
        count += 1;
    }
    (count, value)
}

/// Length of the exponent at the front of `bytes`, if there is one.
fn power(bytes: &[u8]) -> Option<usize> {
    let (b'e' | b'E', rest) = bytes.split_first()? else { return None };
    let sign = usize::from(matches!(rest.first(), Some(b'+' | b'-')));
    let digits = rest[sign..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    (digits > 0).then_some(1 + sign + digits)
}

/// The value of a number's text; `None` if it is not a number or beyond [`LARGEST`].
pub(super) fn value(text: &str) -> Option<f64> {
    read(text, true).filter(|number| number.rest.is_empty())?.value
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn grammar() {
        let split = |text, exponent| read(text, exponent).map(|number| (number.text, number.rest));
        for (text, number, rest) in [
            ("1.5X", "1.5", "X"),
            ("-.5-1", "-.5", "-1"),
            ("+3.", "+3.", ""),
            ("1e5", "1e5", ""),
            ("1e", "1", "e"),
            ("1e+", "1", "e+"),
            ("1.2.3", "1.2", ".3"),
        ] {
            assert_eq!(split(text, true), Some((number, rest)), "{text}");
        }
        assert_eq!(split("1e5", false), Some(("1", "e5")));
        for text in ["", "-", ".", "+.", "nan", "inf", "e5", "٣"] {
            assert_eq!(split(text, true), None, "{text}");
        }
    }

    #[test]
    fn range() {
        assert_eq!(value("1e6"), Some(1e6));
        for text in ["1e7", "-1e999", "NaN", "1 ", "0x10", "infinity"] {
            assert_eq!(value(text), None, "{text}");
        }
    }

    proptest! {
        #[test]
        fn the_value_is_the_nearest_to_the_bit(text in "[+-]?[0-9]{0,20}[.]?[0-9]{0,20}(e[+-]?[0-9]{1,2})?") {
            let right = text.parse::<f64>().ok().filter(|x| x.abs() <= LARGEST);
            prop_assert_eq!(value(&text).map(f64::to_bits), right.map(f64::to_bits), "{}", text);
        }
    }
}
