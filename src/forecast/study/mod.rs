//! Studies: many designs at once, a row each.
//!
//! Rows are numbered; row i is the same whoever computes it, so a study can be cut into parts and run in any number of threads,
//! on any number of machines.
//!
//! | stage | what it knows |
//! |---|---|
//! | [`crate::spec::study`] | what a study file asks for |
//! | `designs` | which design row i is |
//! | [`columns`], `outputs` | what is said of it, in which unit |
//! | [`batch`] | rows as columns of numbers, computed in parallel |
//! | [`csv`], `parquet` | batches as bytes |

pub mod batch;
pub mod columns;
pub mod csv;
mod designs;
mod figure;
mod outputs;
#[cfg(feature = "parquet")]
pub mod parquet;

pub use batch::{Batch, Values};
pub use columns::{Column, Kind};

use crate::digest::of_parts;
use crate::forecast::candidate::{Candidate, Refused};
use crate::forecast::study::designs::Designs;
use crate::forecast::study::outputs::{OUTPUTS, Output, chosen};
use crate::mechanics::hinge::ring::RingTable;
use crate::spec::edit::with_values;
use crate::spec::study::{Block, Field, KeyValue, Lane, StudyFile};
use crate::spec::{Fault, read};
use crate::spec::{FaultCode, Faults, ModelChoice, Source, key};
use std::ops::Range;

/// Most rows of a study: beyond, a row number would not be exact in a spreadsheet, and the file not fit on a disk.
pub const MOST_ROWS: usize = 1_000_000_000;

/// Many designs around one spec.
#[derive(Debug)]
pub struct Study {
    designs: Designs,
    outputs: Vec<&'static Output>,
    columns: Vec<Column>,
    codes: bool,
    ring: RingTable,
}

impl Study {
    /// What `file` asks for, around the spec `spec`, which it names.
    ///
    /// # Errors
    /// The faults of the spec; those of what the study sets in it; a column that does not exist; too many rows.
    pub fn new(file: &StudyFile, spec: &Source) -> Result<Self, Faults> {
        let model = file.model.map(model_setting);
        let set: Vec<(Field, KeyValue)> = file.set.iter().cloned().chain(model).collect();
        let told = |place, what: String| {
            Faults::new(&file.source, vec![Fault::error(FaultCode::OutOfRange, place, what)])
        };
        let outputs = match &file.outputs {
            None => OUTPUTS.iter().collect(),
            Some(wanted) => chosen(wanted, &file.source)?,
        };
        let spec = edited(spec, &set)?;
        Self::of(&spec, file.blocks.clone(), outputs, true)?.map_err(|what| told(0..0, what))
    }

    /// Every combination of the values of `lanes` around the spec `spec`, with the columns that `sweep --vary` has had since it
    /// exists.
    ///
    /// # Errors
    /// The faults of the spec, or one sentence: nothing is varied, or a key twice, or there are too many rows.
    pub fn vary(spec: &Source, lanes: Vec<Lane>) -> Result<Result<Self, String>, Faults> {
        for (i, lane) in lanes.iter().enumerate() {
            if lanes[..i].iter().any(|other| other.field.key() == lane.field.key()) {
                return Ok(Err(format!("`{}` is varied twice", lane.field.key())));
            }
        }
        let blocks = lanes.into_iter().filter_map(|lane| Block::new(vec![lane])).collect();
        Self::of(spec, blocks, OUTPUTS.iter().filter(|output| output.plain).collect(), false)
    }

    fn of(
        spec: &Source,
        blocks: Vec<Block>,
        outputs: Vec<&'static Output>,
        codes: bool,
    ) -> Result<Result<Self, String>, Faults> {
        let reading = read(spec)?;
        if blocks.is_empty() {
            return Ok(Err("nothing is varied".to_owned()));
        }
        let rows = blocks.iter().try_fold(1_usize, |product, block| product.checked_mul(block.len()));
        if rows.is_none_or(|rows| rows > MOST_ROWS) {
            return Ok(Err(format!("more than {MOST_ROWS} rows")));
        }
        let (Some(base), Ok(ring)) = (Candidate::of(&reading.spec), RingTable::new()) else {
            return Ok(Err("the spec has no star".to_owned()));
        };
        let columns = columns::columns(&blocks, &outputs, codes);
        let designs = Designs::new(base, (spec.clone(), reading.spec), blocks);
        Ok(Ok(Self { designs, outputs, columns, codes, ring }))
    }

    /// Number of rows, at least 1.
    pub fn rows(&self) -> usize {
        self.designs.rows()
    }

    /// The columns: `row`, what varies, what is wanted of each design, and why it is refused.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The rows of part `part` (from 1) of `parts`: a partition into parts that differ by one row at most.
    pub fn part(&self, part: usize, parts: usize) -> Range<usize> {
        let rows = self.rows() as u128;
        let cut = |k: usize| usize::try_from(rows * k as u128 / parts as u128).unwrap_or(usize::MAX);
        cut(part.saturating_sub(1))..cut(part)
    }

    /// The design of row `row`.
    ///
    /// # Errors
    /// If the values of this row make no valid spec.
    pub fn design(&self, row: usize) -> Result<Candidate, Refused> {
        self.designs.design(row)
    }

    /// What tells this study from every other: a hash of the version of this program, the spec as read, what varies, and
    /// the columns. Comments and layout do not matter.
    pub fn fingerprint(&self) -> String {
        of_parts([env!("CARGO_PKG_VERSION").to_owned(), self.designs.identity(), format!("{:?}", self.columns)])
    }
}

/// `accuracy.model` as a setting.
fn model_setting(model: ModelChoice) -> (Field, KeyValue) {
    let word = match model {
        ModelChoice::Fit => "fit",
        ModelChoice::Ring => "ring",
        ModelChoice::Bvp => "bvp",
        ModelChoice::Section => "section",
        ModelChoice::Shell => "shell",
        ModelChoice::Auto => "auto",
    };
    let field = Field::of(&key::accuracy::MODEL.to_string());
    #[expect(clippy::expect_used, reason = "a test asks every key")]
    let field = field.expect("a key");
    (field, KeyValue::Word(word.to_owned()))
}

/// `spec` with what a study keeps at another value.
fn edited(spec: &Source, set: &[(Field, KeyValue)]) -> Result<Source, Faults> {
    // A fault of the spec's own is shown in the spec as it was written.
    let _ = read(spec)?;
    if set.is_empty() {
        return Ok(spec.clone());
    }
    let values: Vec<_> = set.iter().map(|(field, value)| (field.key(), field.toml(value))).collect();
    let text = with_values(spec, &values)?;
    Ok(Source::new(format!("{}, as the study sets it", spec.name), text))
}
