//! Single rows as lossless texts, for callers that collect them until a study is complete.

use crate::study::batch::{ColumnValues, RowBatch};
use crate::study::output::{Column, ColumnKind};

/// The cells of the first row of `batch`; `None` for an empty cell.
pub fn cells(batch: &RowBatch) -> Vec<Option<String>> {
    let cell = |values: &ColumnValues| match values {
        // `{}` prints the shortest decimals that read back to the same number.
        ColumnValues::Real(values) => values.first().filter(|value| !value.is_nan()).map(ToString::to_string),
        ColumnValues::Whole(values) => values.first().map(ToString::to_string),
        ColumnValues::Text(values) => values.first().cloned().flatten().map(String::from),
    };
    batch.columns.iter().map(cell).collect()
}

/// The row that has these cells, under these columns, of which the first is its number; `None` if they do not fit.
pub fn batch(columns: &[Column], cells: Vec<Option<String>>) -> Option<RowBatch> {
    if columns.len() != cells.len() {
        return None;
    }
    let row: usize = cells.first()?.as_ref()?.parse().ok()?;
    let value = |(column, cell): (&Column, Option<String>)| {
        Some(match (column.kind, cell) {
            (ColumnKind::Real, None) => ColumnValues::Real(vec![f64::NAN]),
            (ColumnKind::Real, Some(text)) => ColumnValues::Real(vec![text.parse().ok()?]),
            (ColumnKind::Whole, text) => ColumnValues::Whole(vec![text?.parse().ok()?]),
            (ColumnKind::Text, text) => ColumnValues::Text(vec![text.map(Into::into)]),
        })
    };
    let columns = columns.iter().zip(cells).map(value).collect::<Option<_>>()?;
    Some(RowBatch { rows: row..row + 1, columns })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_comes_back_as_it_was() {
        let column = |kind| Column { name: String::new(), unit: None, kind, about: String::new() };
        let columns =
            [ColumnKind::Whole, ColumnKind::Real, ColumnKind::Real, ColumnKind::Text, ColumnKind::Text]
                .map(column);
        let number = 0.1 + 0.2;
        let row = RowBatch {
            rows: 7..8,
            columns: vec![
                ColumnValues::Whole(vec![7]),
                ColumnValues::Real(vec![number]),
                ColumnValues::Real(vec![f64::NAN]),
                ColumnValues::Text(vec![Some("a, \"b\"\n".into())]),
                ColumnValues::Text(vec![None]),
            ],
        };
        let back = batch(&columns, cells(&row)).expect("its own cells");
        assert_eq!((back.rows, back.columns.len()), (7..8, 5));
        let [
            ColumnValues::Whole(first),
            ColumnValues::Real(known),
            ColumnValues::Real(unknown),
            ColumnValues::Text(word),
            ColumnValues::Text(none),
        ] = &back.columns[..]
        else {
            panic!("other kinds: {:?}", back.columns)
        };
        assert_eq!((first[0], known[0].to_bits()), (7, number.to_bits()));
        assert!(unknown[0].is_nan() && none[0].is_none());
        assert_eq!(word[0].as_deref(), Some("a, \"b\"\n"));
        let mut short = cells(&row);
        let _ = short.pop();
        assert!(batch(&columns, short).is_none());
        let mut torn = cells(&row);
        torn[1] = Some("0.3x".to_owned());
        assert!(batch(&columns, torn).is_none());
    }
}
