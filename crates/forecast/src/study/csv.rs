//! Batches as CSV: a header, a line for each row, empty cells for unknown values, nine digits a number. No text is a formula for a
//! spreadsheet, nor moves the cursor of a terminal.

use crate::study::batch::{ColumnValues, RowBatch};
use crate::study::output::Column;
use spec::misleads;
use std::io::Write;

/// The header line; with `units` a comment line below it with the unit of each column.
pub fn header(columns: &[Column], units: bool) -> String {
    let line = |cell: fn(&Column) -> &str| columns.iter().map(cell).collect::<Vec<_>>().join(",");
    let names = line(|column| &column.name);
    if units { format!("{names}\n#{}\n", line(|column| column.unit.unwrap_or("-"))) } else { names + "\n" }
}

/// The lines of `batch`.
pub fn lines(batch: &RowBatch) -> Vec<u8> {
    let mut out = Vec::with_capacity(batch.rows.len() * (12 * batch.columns.len() + 8));
    // Where each column's last text is: most columns repeat their values for many rows.
    let mut last = vec![0..0; batch.columns.len()];
    for i in 0..batch.rows.len() {
        for (k, (column, last)) in batch.columns.iter().zip(&mut last).enumerate() {
            if k > 0 {
                out.push(b',');
            }
            if i > 0 && repeats(column, i) {
                if last.start < last.end {
                    out.extend_from_within(last.clone());
                }
                continue;
            }
            let start = out.len();
            match column {
                ColumnValues::Real(values) if values[i].is_nan() => {}
                ColumnValues::Real(values) => real(&mut out, values[i]),
                ColumnValues::Whole(values) => whole(&mut out, values[i]),
                ColumnValues::Text(values) => text(&mut out, values[i].as_deref()),
            }
            *last = start..out.len();
        }
        out.push(b'\n');
    }
    out
}

/// Whether the value at `i`, above 0, is that of the row before.
fn repeats(column: &ColumnValues, i: usize) -> bool {
    match column {
        ColumnValues::Real(values) => values[i].to_bits() == values[i - 1].to_bits(),
        ColumnValues::Whole(values) => values[i] == values[i - 1],
        ColumnValues::Text(values) => values[i] == values[i - 1],
    }
}

/// First characters of a cell that spreadsheets read as a formula (OWASP, CSV injection), full-width forms as well.
const FORMULA: [char; 10] = ['=', '+', '-', '@', '\t', '\r', '＝', '＋', '－', '＠'];

/// A word as it is; a sentence in quotes. An apostrophe goes before a formula, and control characters are spelt out, such as `\u001b`.
fn text(out: &mut Vec<u8>, text: Option<&str>) {
    let Some(text) = text else { return };
    let is_word = text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte));
    let is_formula = text.starts_with(FORMULA);
    if is_word && !is_formula && !text.is_empty() {
        out.extend_from_slice(text.as_bytes());
        return;
    }
    // Writing to a Vec never fails.
    let _ = write!(out, "\"{}", if is_formula { "'" } else { "" });
    for c in text.chars() {
        let _ = match c {
            '"' => write!(out, "\"\""),
            '\n' => writeln!(out),
            _ if misleads(c) => write!(out, "\\u{:04x}", u32::from(c)),
            _ => write!(out, "{c}"),
        };
    }
    out.push(b'"');
}

/// Adds `value` with nine significant digits: more than any model here deserves, few enough to be the same everywhere.
fn real(out: &mut Vec<u8>, value: f64) {
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
    let decimals = 11 - BOUNDS.iter().filter(|bound| size >= **bound).count();
    if !quick(out, x, decimals) {
        let _ = write!(out, "{x:.decimals$}");
    }
}

/// From each of these sizes on, nine significant digits have one decimal less; 11 below.
const BOUNDS: [f64; 11] = [1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8];

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
fn whole(out: &mut Vec<u8>, value: i64) {
    if value.unsigned_abs() < 10_u64.pow(16) {
        decimal(out, value < 0, value.unsigned_abs(), 0);
    } else {
        // Writing to a Vec never fails.
        let _ = write!(out, "{value}");
    }
}

/// Adds `digits`, less than 1e16, with the last `decimals`, at most 15, behind the point.
fn decimal(out: &mut Vec<u8>, is_negative: bool, digits: u64, decimals: usize) {
    const EIGHT: u64 = 100_000_000;
    let (high, low) = (digits / EIGHT, eight(digits % EIGHT));
    // Mostly the first of nine digits: the last of eight bytes.
    let high = if high < 10 { high << 56 } else { eight(high) };
    let zeros = if high == 0 { 8 + low.trailing_zeros() / 8 } else { high.trailing_zeros() / 8 };
    // The digits as one number, the first in its lowest byte, so that a shift cuts them.
    let digits = u128::from(high | ASCII) | (u128::from(low | ASCII) << 64);
    let point = 16 - decimals;
    let first = (zeros as usize).min(point - 1);
    let mut text = [b'-'; 40];
    text[1..17].copy_from_slice(&(digits >> (8 * first)).to_le_bytes());
    let mut end = 1 + point - first;
    if decimals > 0 {
        text[end] = b'.';
        text[end + 1..end + 17].copy_from_slice(&(digits >> (8 * point)).to_le_bytes());
        end += 1 + decimals;
    }
    let start = usize::from(!is_negative);
    let len = out.len() + end - start;
    // A copy of a length that the compiler knows needs no call.
    out.extend_from_slice(&text[start..start + 32]);
    out.truncate(len);
}

/// The character 0 in each byte.
const ASCII: u64 = 0x3030_3030_3030_3030;

/// The eight digits of a number below 1e8, a byte each, the first in the lowest: halved three times, all parts at once.
fn eight(number: u64) -> u64 {
    let fours = (number / 10_000) | ((number % 10_000) << 32);
    // n / 100 of n below 10,000, and n / 10 of n below 100: the rounded reciprocals are exact as far as that.
    let hundreds = ((fours * 5243) >> 19) & 0x7f_0000_007f;
    let twos = hundreds | ((fours - 100 * hundreds) << 16);
    let tens = ((twos * 103) >> 10) & 0x000f_000f_000f_000f;
    tens | ((twos - 10 * tens) << 8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shown(x: f64) -> String {
        let mut out = Vec::new();
        real(&mut out, x);
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

    #[test]
    fn whole_numbers_have_all_their_digits() {
        let ends = (0..19).flat_map(|k| [10_i64.pow(k) - 1, 10_i64.pow(k), 7 * (10_i64.pow(k) / 3)]);
        for value in ends.chain(0..20_000).chain([i64::MAX, i64::MIN]) {
            for value in [value, value.wrapping_neg()] {
                let mut out = Vec::new();
                whole(&mut out, value);
                assert_eq!(String::from_utf8(out).expect("digits"), value.to_string());
            }
        }
    }

    #[test]
    fn no_text_is_a_formula_or_moves_the_cursor() {
        for (value, cell) in [
            ("generic", "generic"),
            ("", "\"\""),
            ("a-b", "a-b"),
            ("-2", "\"'-2\""),
            ("=1+1", "\"'=1+1\""),
            ("+1", "\"'+1\""),
            ("@SUM(A1)", "\"'@SUM(A1)\""),
            ("\t=1", "\"'\\u0009=1\""),
            ("＝1", "\"'＝1\""),
            ("a,\"b\"\nc", "\"a,\"\"b\"\"\nc\""),
            ("a\u{1b}[2J\u{9b}\r\u{202e}", "\"a\\u001b[2J\\u009b\\u000d\\u202e\""),
        ] {
            let mut out = Vec::new();
            text(&mut out, Some(value));
            assert_eq!(String::from_utf8(out).expect("text"), cell, "{value:?}");
        }
    }

    #[test]
    fn values_that_repeat_are_written_again() {
        let nan = f64::NAN;
        let words = [None, Some("a \"b\""), Some("a \"b\""), None, Some("c")];
        let columns = vec![
            ColumnValues::Whole(vec![7, 7, 8, 8, 7]),
            ColumnValues::Real(vec![0.5, nan, nan, 0.5, 0.5]),
            ColumnValues::Real(vec![0.0, -0.0, 0.25, 0.25, 0.25]),
            ColumnValues::Text(words.map(|word| word.map(Into::into)).to_vec()),
        ];
        let text = String::from_utf8(lines(&RowBatch { rows: 0..5, columns })).expect("text");
        let expected = "7,0.500000000,0,\n7,,0,\"a \"\"b\"\"\"\n8,,0.250000000,\"a \"\"b\"\"\"\n\
                        8,0.500000000,0.250000000,\n7,0.500000000,0.250000000,c\n";
        assert_eq!(text, expected);
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
