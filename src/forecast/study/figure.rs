//! Numbers as a table shows them.

use std::io::Write;

/// Adds `value` with nine significant digits: more than any model here deserves, few enough to be the same everywhere.
pub(super) fn write(out: &mut Vec<u8>, value: f64) {
    let x = if value == 0.0 { 0.0 } else { value };
    let size = x.abs();
    if size < 1e9 {
        #[expect(clippy::cast_possible_truncation, reason = "its whole part, below 1e9")]
        let part = x as i32;
        if f64::from(part) == x {
            return whole(out, part.into());
        }
    }
    // Writing to a Vec never fails.
    if !(1e-3..1e9).contains(&size) {
        let _ = write!(out, "{x:.8e}");
        return;
    }
    // Decimals so that nine significant digits are shown; the chain is faster than a logarithm.
    let mut decimals = 11;
    let mut bound = 1e-2;
    while size >= bound {
        decimals -= 1;
        bound *= 10.0;
    }
    if !quick(out, x, decimals) {
        let _ = write!(out, "{x:.decimals$}");
    }
}

/// Powers of ten, all exact.
const TENS: [f64; 12] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11];

/// Adds `x` with `decimals` decimals as an integer that was scaled, ten times as fast as the exact way, unless it is so near to the
/// middle between two last digits that the product's rounding could decide.
fn quick(out: &mut Vec<u8>, x: f64, decimals: usize) -> bool {
    let scaled = x.abs() * TENS[decimals];
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1e9")]
    let below = scaled as u32;
    // Nine digits, so that the product is off by less than 1e-6.
    let part = scaled - f64::from(below);
    if (part - 0.5).abs() < 1e-5 {
        return false;
    }
    decimal(out, x < 0.0, u64::from(below) + u64::from(part > 0.5), decimals);
    true
}

/// Adds a whole number.
pub(super) fn whole(out: &mut Vec<u8>, value: i64) {
    decimal(out, value < 0, value.unsigned_abs(), 0);
}

/// Adds `digits` with the last `decimals` behind the point.
fn decimal(out: &mut Vec<u8>, is_negative: bool, mut digits: u64, decimals: usize) {
    let mut text = [0; 24];
    let mut at = text.len();
    let mut put = |byte| {
        at -= 1;
        text[at] = byte;
    };
    let mut last = || {
        let digit = u8::try_from(digits % 10).unwrap_or(0);
        digits /= 10;
        (b'0' + digit, digits == 0)
    };
    for _ in 0..decimals {
        put(last().0);
    }
    if decimals > 0 {
        put(b'.');
    }
    loop {
        let (digit, is_first) = last();
        put(digit);
        if is_first {
            break;
        }
    }
    if is_negative {
        put(b'-');
    }
    out.extend_from_slice(&text[at..]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shown(x: f64) -> String {
        let mut out = Vec::new();
        write(&mut out, x);
        String::from_utf8(out).expect("digits")
    }

    #[test]
    fn numbers_are_plain() {
        let texts = [
            30.0,
            0.5,
            1.0 / 3.0,
            12345.6789,
            1e-7,
            -2.5,
            -0.0,
            0.001,
            123_456_789.5,
            9.999_999_999,
            1e9,
            2e12,
        ]
        .map(shown);
        let expected = [
            "30",
            "0.500000000",
            "0.333333333",
            "12345.6789",
            "1.00000000e-7",
            "-2.50000000",
            "0",
            "0.00100000000",
            "123456790",
            "10.00000000",
            "1.00000000e9",
            "2.00000000e12",
        ];
        assert_eq!(texts, expected);
    }

    /// The standard library's text, which is rounded exactly.
    fn exact(x: f64) -> String {
        let size = x.abs();
        if x.fract() == 0.0 && size < 1e9 {
            return format!("{}", if x == 0.0 { 0.0 } else { x });
        }
        if !(1e-3..1e9).contains(&size) {
            return format!("{x:.8e}");
        }
        let (mut decimals, mut bound) = (11, 1e-2);
        while size >= bound {
            decimals -= 1;
            bound *= 10.0;
        }
        format!("{x:.decimals$}")
    }

    proptest! {
        #[test]
        fn the_quick_way_writes_what_the_exact_way_writes(mantissa in -10.0..10.0_f64, exponent in -5..11_i32, tenths in 0..100_000_000_u32) {
            let free = mantissa * 10_f64.powi(exponent);
            prop_assert_eq!(shown(free), exact(free));
            // Near the middle between two last digits, and near a carry.
            for x in [f64::from(tenths) + 0.5, (f64::from(tenths) + 0.5) * 1e-3, 1.0 - f64::from(tenths) * 1e-12] {
                prop_assert_eq!(shown(x), exact(x));
            }
        }
    }
}
