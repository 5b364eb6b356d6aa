//! Studies: many designs at once, a row each.
//!
//! Rows are numbered; row i is the same on every machine and in any number of threads, so a study can be split into parts
//! that run anywhere.
//!
//! | stage | subject |
//! |---|---|
//! | [`spec::study`] | the study file |
//! | `designs` | the design of row i |
//! | `answers` | the values of its model |
//! | `output`, `outputs`, `wanted` | the values of a row, with their units |
//! | [`batch`] | rows as columns of numbers, computed in parallel; rows that take seconds each |
//! | [`csv`] | batches as bytes |

mod answers;
pub mod batch;
pub mod csv;
mod designs;
mod output;
mod outputs;
mod wanted;

pub use batch::{ColumnValues, RowBatch};
pub use output::{Column, ColumnKind};

use crate::candidate::{Candidate, RefusedDesign};
use crate::shell::Detail;
use crate::study::answers::Models;
use crate::study::designs::Designs;
use crate::study::output::{ModelKinds, OutputColumn};
use inflatable::mechanics::hinge::ring::RingTable;
use spec::digest::of_parts;
use spec::study::{Axis, Block, Field, KeyValue, StudyFile, with_fields};
use spec::{Fault, FaultCode, Faults, ModelChoice, Source, Spec, key, nearest, read};
use std::ops::Range;

/// Most rows of a study: beyond, a row number would not be exact in a spreadsheet, and the file not fit on a disk.
pub const MOST_ROWS: usize = 1_000_000_000;

/// Many designs around one spec.
#[derive(Debug)]
pub struct Study {
    designs: Designs,
    outputs: Vec<&'static OutputColumn>,
    columns: Vec<Column>,
    codes: bool,
    models: Models,
    is_slow: bool,
}

impl Study {
    /// The study of `file` around the spec `spec`, which the file names.
    ///
    /// # Errors
    /// The faults of the spec; those of the values that the study sets; a column that does not exist, or that none of its models has;
    /// a fineness of shell meshes without a shell; too many rows.
    pub fn new(file: &StudyFile, spec: &Source) -> Result<Self, Faults> {
        let model = file.model.map(model_setting);
        let set: Vec<(Field, KeyValue)> = file.set.iter().cloned().chain(model).collect();
        let out_of_range = |problem: String| {
            Faults::new(&file.source, vec![Fault::error(FaultCode::OutOfRange, 0..0, problem)])
        };
        check_processes(file, &read(spec)?.spec)?;
        let spec = edited(spec, &set)?;
        let study_designs = designs(&spec, file.blocks.clone())?.map_err(out_of_range)?;
        let models = study_designs.models();
        let kinds = ModelKinds::new(&models);
        if let Some((_, place)) = file.fineness.as_ref().filter(|_| !kinds.shells) {
            let fault = Fault::error(FaultCode::Conflict, place.clone(), "`fineness` is for shells only")
                .label("no row of this study computes a shell")
                .help("write model = \"shell\", or delete it");
            return Err(Faults::new(&file.source, vec![fault]));
        }
        let outputs = match &file.outputs {
            None => wanted::available(kinds),
            Some(names) => wanted::by_names(names, &file.source, kinds)?,
        };
        let detail = file.fineness.as_ref().map_or(Detail::Medium, |(detail, _)| *detail);
        let is_slow = any_slow(&models);
        Self::with_outputs(study_designs, outputs, Some(detail), is_slow).map_err(out_of_range)
    }

    /// Every combination of the values of `axes` around the spec `spec`, with the fixed columns of `sweep --vary`
    /// and its models: `section` answers for a spec whose model is `bvp` or `shell`.
    ///
    /// # Errors
    /// The faults of the spec, or one sentence: no key is varied, one is varied twice, a varied model is not one of these, or there are
    /// too many rows.
    pub fn vary(spec: &Source, axes: Vec<Axis>) -> Result<Result<Self, String>, Faults> {
        let spec_read = read(spec)?.spec;
        for (i, Axis { field, .. }) in axes.iter().enumerate() {
            let name = field.name();
            let earlier =
                axes[..i].iter().map(|other| &other.field).find(|other| other.is_of_same_value(field));
            if let Some(earlier) = earlier {
                return Ok(Err(if earlier == field {
                    format!("`{name}` is varied twice")
                } else {
                    format!("`{}` and `{name}` are the same size: vary one of them", earlier.name())
                }));
            }
            if let Some(MissingProcess { problem, remedy }) = missing_process(&spec_read, field) {
                return Ok(Err(format!("`{name}`: {problem}; {remedy}")));
            }
        }
        let varies_models = axes.iter().any(|axis| axis.field.key() == key::accuracy::MODEL);
        let blocks = axes.into_iter().filter_map(|axis| Block::new(vec![axis])).collect();
        Ok(designs(spec, blocks)?.and_then(|designs| {
            if varies_models && any_slow(&designs.models()) {
                let problem = "`accuracy.model` is varied with bvp or shell, which only a study file computes: vary fit, ring, \
                            section and auto, or write the same [vary] into a study file";
                return Err(problem.to_owned());
            }
            Self::with_outputs(designs, wanted::plain(), None, false)
        }))
    }

    /// `detail`: how fine the meshes of shells are; `None` for a sweep without a study file.
    fn with_outputs(
        designs: Designs,
        outputs: Vec<&'static OutputColumn>,
        detail: Option<Detail>,
        is_slow: bool,
    ) -> Result<Self, String> {
        let ring = RingTable::new().map_err(|fault| fault.to_string())?;
        let codes = detail.is_some();
        let columns = output::columns(&designs.blocks, &outputs, codes);
        Ok(Self { designs, outputs, columns, codes, models: Models { ring, detail }, is_slow })
    }

    /// Number of rows, at least 1.
    pub fn rows(&self) -> usize {
        self.designs.rows
    }

    /// The columns: `row`, the varied keys, the outputs of each design, and the reason for a refusal.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The rows of part `part` (from 1) of `parts`: a partition into parts that differ by one row at most.
    pub fn part(&self, part: usize, parts: usize) -> Range<usize> {
        let rows = self.rows() as u128;
        let [start, end] = [part.saturating_sub(1), part]
            .map(|k| usize::try_from(rows * k as u128 / parts as u128).unwrap_or(usize::MAX));
        start..end
    }

    /// The design of row `row`.
    ///
    /// # Errors
    /// If the values of this row make no valid spec.
    pub fn design(&self, row: usize) -> Result<Candidate, RefusedDesign> {
        self.designs.design(row)
    }

    /// Identifies the study: a hash of the version of this program, the spec as read, the varied keys, and
    /// the columns. Comments and layout do not matter.
    pub fn fingerprint(&self) -> String {
        let mut parts = vec![
            env!("CARGO_PKG_VERSION").to_owned(),
            self.designs.identity(),
            format!("{:?}", self.columns),
        ];
        parts.extend(self.models.detail.filter(|_| self.is_slow).map(|detail| format!("{detail:?}")));
        of_parts(parts)
    }
}

/// A process that a study names and its spec does not have.
struct MissingProcess {
    problem: String,
    remedy: String,
}

/// The process of `field`, if it is none of `spec`; `None` if it is, and for keys of no process.
fn missing_process(spec: &Spec, field: &Field) -> Option<MissingProcess> {
    let name = field.process()?;
    let names: Vec<&str> = spec.processes.iter().map(|process| process.name.as_str()).collect();
    if names.contains(&name) {
        return None;
    }
    let remedy = match nearest(name, names.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if names.is_empty() => format!("write its section in the spec, [process.{name}]"),
        None => format!("write its section in the spec, [process.{name}]; there are {}", names.join(", ")),
    };
    Some(MissingProcess { problem: format!("the spec has no process `{name}`"), remedy })
}

/// Checks that `spec` has every process whose keys the study sets or varies.
fn check_processes(file: &StudyFile, spec: &Spec) -> Result<(), Faults> {
    let varied = file.blocks.iter().flat_map(Block::axes).map(|axis| &axis.field);
    let mut faults = Vec::new();
    for field in file.set.iter().map(|(field, _)| field).chain(varied) {
        let Some(MissingProcess { problem, remedy }) = missing_process(spec, field) else { continue };
        let section_place =
            file.processes.iter().find(|process| Some(process.name.as_str()) == field.process());
        let place = section_place.map_or(0..0, |process| process.place.clone());
        let fault = Fault::error(FaultCode::UnknownProcess, place, problem);
        let fault = fault.label("must be the name of a section [process.NAME] of the spec").help(remedy);
        if !faults.contains(&fault) {
            faults.push(fault);
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(Faults::new(&file.source, faults)) }
}

/// The designs of `blocks` around `spec`; one sentence if no key is varied, or there are too many designs.
fn designs(spec: &Source, blocks: Vec<Block>) -> Result<Result<Designs, String>, Faults> {
    let reading = read(spec)?;
    if blocks.is_empty() {
        return Ok(Err("nothing is varied".to_owned()));
    }
    let rows = blocks.iter().try_fold(1_usize, |product, block| product.checked_mul(block.len()));
    if rows.is_none_or(|rows| rows > MOST_ROWS) {
        return Ok(Err(format!("more than {MOST_ROWS} rows")));
    }
    let Some(base) = Candidate::from_spec(&reading.spec) else {
        return Ok(Err("the spec has no star".to_owned()));
    };
    Ok(Ok(Designs::new(base, spec.clone(), reading, blocks)))
}

/// Whether a row of one of these models takes a second to minutes.
fn any_slow(models: &[ModelChoice]) -> bool {
    models.iter().any(|model| matches!(model, ModelChoice::Bvp | ModelChoice::Shell))
}

/// `accuracy.model` as a setting.
fn model_setting(model: ModelChoice) -> (Field, KeyValue) {
    let entry = ModelChoice::ALL.iter().find(|(_, own)| *own == model);
    let word = entry.map_or("auto", |(word, _)| word);
    let field = Field::find(&key::accuracy::MODEL.to_string());
    #[expect(clippy::expect_used, reason = "a test reads every key")]
    let field = field.expect("a key");
    (field, KeyValue::Word(word.to_owned()))
}

/// `spec` with the fixed values of a study.
fn edited(spec: &Source, set: &[(Field, KeyValue)]) -> Result<Source, Faults> {
    // A fault of the spec's own is shown in the spec as it was written.
    let _ = read(spec)?;
    if set.is_empty() {
        return Ok(spec.clone());
    }
    let text = with_fields(spec, set.iter().map(|(field, value)| (field, value.clone())))?;
    Ok(Source::new(format!("{}, as the study sets it", spec.name), text))
}
