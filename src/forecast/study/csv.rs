//! Batches as CSV: a header, a line for each row, empty cells for unknown values.

use crate::forecast::study::batch::{ColumnValues, RowBatch};
use crate::forecast::study::columns::Column;
use crate::forecast::study::figure;

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
                ColumnValues::Real(values) => figure::write(&mut out, values[i]),
                ColumnValues::Whole(values) => figure::whole(&mut out, values[i]),
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

/// A word as it is; a sentence in quotes.
fn text(out: &mut Vec<u8>, text: Option<&str>) {
    let Some(text) = text else { return };
    let is_word = text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte));
    if is_word && !text.is_empty() {
        out.extend_from_slice(text.as_bytes());
    } else {
        out.push(b'"');
        out.extend_from_slice(text.replace('"', "\"\"").as_bytes());
        out.push(b'"');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
