//! Decimal numbers in files, by a strict grammar: no `nan`, no `inf`, nothing out of range.

/// Largest magnitude a coordinate in a file may have: a kilometre in mm, so that squares stay exact enough.
pub(in crate::verify) const LARGEST: f64 = 1e6;

/// Splits `[+-] digits [. digits] [e [+-] digits]` (the exponent only if allowed) off the front of `text`.
///
/// At least one digit must stand before or after the point. Returns the number's text and the rest.
pub(in crate::verify) fn split_number(text: &str, exponent: bool) -> Option<(&str, &str)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut at = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits(at);
    at += whole;
    let mut fraction = 0;
    if bytes.get(at) == Some(&b'.') {
        fraction = digits(at + 1);
        at += 1 + fraction;
    }
    if whole + fraction == 0 {
        return None;
    }
    if exponent && matches!(bytes.get(at), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(at + 1), Some(b'+' | b'-')));
        let power = digits(at + 1 + sign);
        if power > 0 {
            at += 1 + sign + power;
        }
    }
    // Only ASCII bytes were passed over, so `at` is a character boundary.
    Some(text.split_at(at))
}

/// The value of a number's text; `None` if it is not a number or beyond [`LARGEST`].
pub(in crate::verify) fn value(text: &str) -> Option<f64> {
    let (number, rest) = split_number(text, true)?;
    if rest.is_empty() { parsed(number) } else { None }
}

/// The value of a number that [`split_number`] found; `None` beyond [`LARGEST`].
pub(in crate::verify) fn parsed(number: &str) -> Option<f64> {
    number.parse().ok().filter(|x: &f64| x.abs() <= LARGEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grammar() {
        for (text, number, rest) in [
            ("1.5X", "1.5", "X"),
            ("-.5-1", "-.5", "-1"),
            ("+3.", "+3.", ""),
            ("1e5", "1e5", ""),
            ("1e", "1", "e"),
            ("1e+", "1", "e+"),
            ("1.2.3", "1.2", ".3"),
        ] {
            assert_eq!(split_number(text, true), Some((number, rest)), "{text}");
        }
        assert_eq!(split_number("1e5", false), Some(("1", "e5")));
        for text in ["", "-", ".", "+.", "nan", "inf", "e5", "٣"] {
            assert_eq!(split_number(text, true), None, "{text}");
        }
    }

    #[test]
    fn range() {
        assert_eq!(value("1e6"), Some(1e6));
        for text in ["1e7", "-1e999", "NaN", "1 ", "0x10", "infinity"] {
            assert_eq!(value(text), None, "{text}");
        }
    }
}
