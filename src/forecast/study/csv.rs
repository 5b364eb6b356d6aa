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
    for i in 0..batch.rows.len() {
        for (k, column) in batch.columns.iter().enumerate() {
            if k > 0 {
                out.push(b',');
            }
            match column {
                ColumnValues::Real(values) if values[i].is_nan() => {}
                ColumnValues::Real(values) => figure::write(&mut out, values[i]),
                ColumnValues::Whole(values) => figure::whole(&mut out, values[i]),
                ColumnValues::Text(values) => text(&mut out, values[i].as_deref()),
            }
        }
        out.push(b'\n');
    }
    out
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
