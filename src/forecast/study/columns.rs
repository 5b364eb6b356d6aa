//! The columns of a study: value and unit of each.

use crate::forecast::study::output::OutputColumn;
use crate::spec::study::{Block, Field};

/// The type of a column's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// Numbers; NaN where unknown.
    Real,
    /// Whole numbers, never missing.
    Whole,
    /// Words; `None` for an empty cell.
    Text,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name, with its unit where it has one: "`star.tube_width_mm`". It never changes.
    pub name: String,
    /// The unit, as people write it: "N/m"; `None` for plain numbers and words.
    pub unit: Option<&'static str>,
    /// Type of its values.
    pub kind: ColumnKind,
    /// Its meaning.
    pub about: String,
}

/// The columns of a study of `blocks`: `row`, a column for each axis, `outputs`, and the refusal, with its code if
/// `codes` is set.
pub(super) fn columns(blocks: &[Block], outputs: &[&'static OutputColumn], codes: bool) -> Vec<Column> {
    let text = |name: &str, unit, kind, about: &str| Column {
        name: name.to_owned(),
        unit,
        kind,
        about: about.to_owned(),
    };
    let mut columns =
        vec![text("row", None, ColumnKind::Whole, "the row's number in the whole study, from 0")];
    columns.extend(blocks.iter().flat_map(Block::axes).map(|axis| of_field(&axis.field)));
    columns
        .extend(outputs.iter().map(|output| text(output.name, output.unit, ColumnKind::Real, output.about)));
    if codes {
        let about = "the code of the refusal, a word of docs/codes.md; none for a design with a prediction";
        columns.push(text("refused_code", None, ColumnKind::Text, about));
    }
    columns.push(text("refused", None, ColumnKind::Text, "why this design cannot be made, and the remedy"));
    columns
}

/// The column of a key that varies.
fn of_field(field: &Field) -> Column {
    let kind = match (field.is_whole(), field.is_number()) {
        (true, _) => ColumnKind::Whole,
        (_, true) => ColumnKind::Real,
        _ => ColumnKind::Text,
    };
    let unit = field.unit();
    let name = format!("{}{}", field.key(), unit.map(suffix).unwrap_or_default());
    Column { name, unit, kind, about: format!("the value of `{}`", field.key()) }
}

/// A unit as the end of a column's name.
fn suffix(unit: &str) -> String {
    format!("_{}", unit.replace('/', "_per_").replace(' ', "_").replace('^', "").replace('%', "percent"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_end_the_names_of_columns() {
        let name = |key: &str| of_field(&Field::of(key).expect("a key")).name;
        assert_eq!(name("star.tube_width"), "star.tube_width_mm");
        assert_eq!(name("fabric.seal_strength"), "fabric.seal_strength_N_per_mm");
        assert_eq!(name("fabric.areal_density"), "fabric.areal_density_kg_per_m2");
        assert_eq!(name("fabric.bending_stiffness"), "fabric.bending_stiffness_N_mm");
        assert_eq!(name("accuracy.response"), "accuracy.response_percent");
        assert_eq!(name("load.friction"), "load.friction");
        let kind = |key: &str| of_field(&Field::of(key).expect("a key")).kind;
        assert_eq!(
            ["star.points", "load.friction", "mask.mirror"].map(kind),
            [ColumnKind::Whole, ColumnKind::Real, ColumnKind::Text]
        );
    }
}
