//! Batches as CSV: a header, a line for each row, empty cells for unknown values, nine digits a number. No text is a formula for a
//! spreadsheet, nor moves the cursor of a terminal.

use crate::study::batch::{ColumnValues, RowBatch};
use crate::study::output::Column;
use spec::misleads;
use std::io::Write;

/// The header line; with `units` a comment line below it with the unit of each column.
pub fn header(columns: &[Column], units: bool) -> String {
    let names = columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>().join(",");
    if !units {
        return names + "\n";
    }
    let units = columns.iter().map(|column| column.unit.unwrap_or("-")).collect::<Vec<_>>().join(",");
    format!("{names}\n#{units}\n")
}

/// The lines of `batch`.
pub fn lines(batch: &RowBatch) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(batch.rows.len() * (12 * batch.columns.len() + 8));
    for i in 0..batch.rows.len() {
        for (k, column) in batch.columns.iter().enumerate() {
            if k > 0 {
                bytes.push(b',');
            }
            match column {
                ColumnValues::Real(values) if values[i].is_nan() => {}
                ColumnValues::Real(values) => real(&mut bytes, values[i]),
                // Writing to a Vec never fails.
                ColumnValues::Whole(values) => drop(write!(bytes, "{}", values[i])),
                ColumnValues::Text(values) => text(&mut bytes, values[i].as_deref()),
            }
        }
        bytes.push(b'\n');
    }
    bytes
}

/// First characters of a cell that spreadsheets read as a formula (OWASP, CSV injection), full-width forms as well.
const FORMULA: [char; 10] = ['=', '+', '-', '@', '\t', '\r', '＝', '＋', '－', '＠'];

/// A word as it is; a sentence in quotes. An apostrophe goes before a formula, and control characters are spelt out, such as `\u001b`.
fn text(bytes: &mut Vec<u8>, text: Option<&str>) {
    let Some(text) = text else { return };
    let is_word = text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte));
    let is_formula = text.starts_with(FORMULA);
    if is_word && !is_formula && !text.is_empty() {
        bytes.extend_from_slice(text.as_bytes());
        return;
    }
    // Writing to a Vec never fails.
    let _ = write!(bytes, "\"{}", if is_formula { "'" } else { "" });
    for c in text.chars() {
        let _ = match c {
            '"' => write!(bytes, "\"\""),
            '\n' => writeln!(bytes),
            _ if misleads(c) => write!(bytes, "\\u{:04x}", u32::from(c)),
            _ => write!(bytes, "{c}"),
        };
    }
    bytes.push(b'"');
}

/// Adds `value` with nine significant digits, whole numbers below 1e9 without decimals: more than any model here deserves, few enough to
/// be the same everywhere.
fn real(bytes: &mut Vec<u8>, value: f64) {
    let x = if value == 0.0 { 0.0 } else { value };
    let size = x.abs();
    // Writing to a Vec never fails.
    let _ = if x.fract() == 0.0 && size < 1e9 {
        write!(bytes, "{x}")
    } else if (1e-3..1e9).contains(&size) {
        let decimals = 11 - BOUNDS.iter().filter(|bound| size >= **bound).count();
        write!(bytes, "{x:.decimals$}")
    } else {
        write!(bytes, "{x:.8e}")
    };
}

/// From each of these sizes on, nine significant digits have one decimal less; 11 below.
const BOUNDS: [f64; 11] = [1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8];

#[cfg(test)]
mod tests {
    use super::*;

    fn digits(x: f64) -> String {
        let mut bytes = Vec::new();
        real(&mut bytes, x);
        String::from_utf8(bytes).expect("digits")
    }

    #[test]
    fn numbers_are_plain() {
        for (number, text) in [
            (30.0, "30"),
            (0.5, "0.500000000"),
            (1.0 / 3.0, "0.333333333"),
            (12345.6789, "12345.6789"),
            (1e-7, "1.00000000e-7"),
            (-2.5, "-2.50000000"),
            (-0.0, "0"),
            (0.001, "0.00100000000"),
            (123_456_789.5, "123456790"),
            (9.999_999_999, "10.00000000"),
            (1e9, "1.00000000e9"),
            (2e12, "2.00000000e12"),
        ] {
            assert_eq!(digits(number), text);
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
            let mut bytes = Vec::new();
            text(&mut bytes, Some(value));
            assert_eq!(String::from_utf8(bytes).expect("text"), cell, "{value:?}");
        }
    }

    #[test]
    fn unknown_values_are_empty_cells() {
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
}
