//! The columns of a study: one of answers with its name, its meaning and the models that have it, and all of a table.

use crate::candidate::{Answer, Candidate};
use crate::case::Case;
use crate::folding::until_arms_fold;
use crate::interval::Interval;
use crate::outcome::Outcome;
use crate::shell::request::Measurements;
use inflatable::mechanics::strength::payload;
use spec::ModelChoice;
use spec::study::{Block, Field};

/// A design with its answer.
pub(super) struct StudyRow<'a> {
    pub(super) point: &'a Candidate,
    pub(super) answer: &'a Answer,
    /// The shell's values, if it was computed.
    pub(super) shell: Option<&'a Measurements>,
    /// Whether values that need no model are written without a model's answer; the columns of `sweep --vary` leave them empty.
    pub(super) all: bool,
}

impl StudyRow<'_> {
    /// Case of the row, if the values that depend on the pressure but not on a model are written.
    pub(super) fn at_pressure(&self) -> Option<&Case> {
        (self.all || self.outcome().is_some()).then_some(&self.answer.case)
    }

    /// The values by a hinge model, if it covers the star.
    pub(super) fn outcome(&self) -> Option<&Outcome> {
        self.answer.outcome.as_ref().filter(|outcome| outcome.known)
    }

    /// The value by a hinge model or by the shell.
    pub(super) fn value(
        &self,
        hinges: fn(&Outcome) -> Option<f64>,
        shell: fn(&Measurements) -> Option<f64>,
    ) -> Option<f64> {
        self.shell.map_or_else(|| hinges(self.outcome()?), shell)
    }

    /// Mass that friction holds with a radial force of this many N of each star, of the whole stack, kg; `None` where stars of the stack differ, or
    /// meet different radii of the object, because the shell computes one star and one radius only.
    pub(super) fn payload(&self, force: f64) -> Option<f64> {
        if !self.point.are_alike(&self.answer.star, &self.answer.case) {
            return None;
        }
        let rest = self.shell.map(|shell| shell.tip_angle.value.to_radians())?;
        let of_one = payload(self.point.load.friction?, [force]);
        let of_one = until_arms_fold(of_one, self.answer.case.wrinkling_mass(rest));
        Some(f64::from(self.point.stars) * of_one)
    }
}

/// A column of answers.
#[derive(Debug)]
pub(super) struct OutputColumn {
    /// It ends with the unit, if there is one.
    pub(super) name: &'static str,
    pub(super) about: &'static str,
    pub(super) of: Of,
}

/// The models that have a column, and its value in a row.
#[derive(Debug)]
pub(super) enum Of {
    /// Every model.
    Any(ValueOf),
    /// Models of the hinges.
    Hinges(ValueOf),
    /// Models of the hinges: the least end of a range.
    Low(RangeOf),
    /// Models of the hinges: the largest end of a range.
    High(RangeOf),
    /// Shells.
    Shell(ValueOf),
}

/// A value in a row.
pub(super) type ValueOf = fn(&StudyRow<'_>) -> Option<f64>;

/// A range in a row.
pub(super) type RangeOf = fn(&StudyRow<'_>) -> Option<Interval>;

/// The kinds of models that the rows of a study use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ModelKinds {
    /// One of the hinges.
    pub(super) hinges: bool,
    /// The shell.
    pub(super) shells: bool,
}

impl ModelKinds {
    /// By rows of these models.
    pub(super) fn new(models: &[ModelChoice]) -> Self {
        let is_shell = |model: &ModelChoice| *model == ModelChoice::Shell;
        Self { hinges: !models.iter().all(is_shell), shells: models.iter().any(is_shell) }
    }
}

impl OutputColumn {
    /// Value of the column in `row`; `None` if unknown.
    pub(super) fn value(&self, row: &StudyRow<'_>) -> Option<f64> {
        match self.of {
            Of::Any(of) | Of::Shell(of) => of(row),
            _ if row.shell.is_some() => None,
            Of::Hinges(of) => of(row),
            Of::Low(range) => range(row).map(|[low, _]| low),
            Of::High(range) => range(row).map(|[_, high]| high),
        }
    }

    /// Whether one of the models in `kinds` has this column.
    pub(super) fn is_known(&self, kinds: ModelKinds) -> bool {
        match self.of {
            Of::Any(_) => true,
            Of::Hinges(_) | Of::Low(_) | Of::High(_) => kinds.hinges,
            Of::Shell(_) => kinds.shells,
        }
    }
}

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
    /// Name of the column, with its unit where it has one: "`star.tube_width_mm`". It never changes.
    pub name: String,
    /// The unit, as people write it: "N/m"; `None` for plain numbers and words.
    pub unit: Option<&'static str>,
    /// Type of its values.
    pub kind: ColumnKind,
    /// Meaning of the column.
    pub about: String,
}

impl Column {
    fn new(name: &str, kind: ColumnKind, meaning: &str) -> Self {
        Self { name: name.to_owned(), unit: None, kind, about: meaning.to_owned() }
    }
}

/// The columns of a study of `blocks`: `row`, a column for each axis, `outputs`, and the refusal, with its code if
/// `codes` is set.
pub(super) fn columns(blocks: &[Block], outputs: &[&'static OutputColumn], codes: bool) -> Vec<Column> {
    let mut columns =
        vec![Column::new("row", ColumnKind::Whole, "the row's number in the whole study, from 0")];
    columns.extend(blocks.iter().flat_map(Block::axes).map(|axis| of_field(&axis.field)));
    columns.extend(outputs.iter().map(|output| {
        let column = Column::new(output.name, ColumnKind::Real, output.about);
        Column { unit: unit_of(output.name), ..column }
    }));
    if codes {
        let meaning = "the code of the refusal, a word of docs/codes.md; none for a design with a prediction";
        columns.push(Column::new("refused_code", ColumnKind::Text, meaning));
    }
    columns.push(Column::new("refused", ColumnKind::Text, "why this design cannot be made, and the remedy"));
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
    let name = format!("{}{}", field.name(), unit.map(suffix).unwrap_or_default());
    Column { name, unit, kind, about: format!("the value of `{}`", field.name()) }
}

/// The units of outputs; one that ends as another stands before it.
const UNITS: [&str; 11] = ["N/mm", "mm", "deg", "kPa", "N/m", "N", "kg", "g", "cm^2", "mm^2", "mm^3"];

/// The unit that ends the name of an output.
fn unit_of(name: &str) -> Option<&'static str> {
    UNITS.into_iter().find(|unit| name.ends_with(&suffix(unit)))
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
        for (key, name) in [
            ("star.tube_width", "star.tube_width_mm"),
            ("fabric.seal_strength", "fabric.seal_strength_N_per_mm"),
            ("fabric.areal_density", "fabric.areal_density_kg_per_m2"),
            ("fabric.bending_stiffness", "fabric.bending_stiffness_N_mm"),
            ("accuracy.response", "accuracy.response_percent"),
            ("load.friction", "load.friction"),
        ] {
            assert_eq!(of_field(&Field::find(key).expect("a key")).name, name);
        }
        let kind = |key: &str| of_field(&Field::find(key).expect("a key")).kind;
        assert_eq!(
            ["star.points", "load.friction", "mask.mirror"].map(kind),
            [ColumnKind::Whole, ColumnKind::Real, ColumnKind::Text]
        );
    }
}
