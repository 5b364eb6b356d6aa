//! Single rows as texts that lose nothing, for whoever keeps them until there are all.

use crate::forecast::study::batch::{Batch, Values};
use crate::forecast::study::columns::{Column, Kind};

/// The cells of the first row of `batch`; `None` where nothing is known.
pub fn cells(batch: &Batch) -> Vec<Option<String>> {
    let cell = |values: &Values| match values {
        // `{}` prints the shortest decimals that read back to the same number.
        Values::Real(values) => values.first().filter(|value| !value.is_nan()).map(ToString::to_string),
        Values::Whole(values) => values.first().map(ToString::to_string),
        Values::Text(values) => values.first().cloned().flatten().map(String::from),
    };
    batch.columns.iter().map(cell).collect()
}

/// The row that has these cells, under these columns, of which the first is its number; `None` if they do not fit.
pub fn batch(columns: &[Column], cells: Vec<Option<String>>) -> Option<Batch> {
    if columns.len() != cells.len() {
        return None;
    }
    let row: usize = cells.first()?.as_ref()?.parse().ok()?;
    let value = |(column, cell): (&Column, Option<String>)| {
        Some(match (column.kind, cell) {
            (Kind::Real, None) => Values::Real(vec![f64::NAN]),
            (Kind::Real, Some(text)) => Values::Real(vec![text.parse().ok()?]),
            (Kind::Whole, text) => Values::Whole(vec![text?.parse().ok()?]),
            (Kind::Text, text) => Values::Text(vec![text.map(Into::into)]),
        })
    };
    let columns = columns.iter().zip(cells).map(value).collect::<Option<_>>()?;
    Some(Batch { rows: row..row + 1, columns })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_comes_back_as_it_was() {
        let column = |kind| Column { name: String::new(), unit: None, kind, about: String::new() };
        let columns = [Kind::Whole, Kind::Real, Kind::Real, Kind::Text, Kind::Text].map(column);
        let number = 0.1 + 0.2;
        let row = Batch {
            rows: 7..8,
            columns: vec![
                Values::Whole(vec![7]),
                Values::Real(vec![number]),
                Values::Real(vec![f64::NAN]),
                Values::Text(vec![Some("a, \"b\"\n".into())]),
                Values::Text(vec![None]),
            ],
        };
        let back = batch(&columns, cells(&row)).expect("its own cells");
        assert_eq!((back.rows, back.columns.len()), (7..8, 5));
        let [
            Values::Whole(first),
            Values::Real(known),
            Values::Real(unknown),
            Values::Text(word),
            Values::Text(none),
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
