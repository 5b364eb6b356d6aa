//! From the text of a study file to the study.

use geom::order::sort_by_key;
use std::ops::Range;

use crate::FaultCode;
use crate::accuracy::{Detail, ModelChoice};
use crate::fault::{Fault, quoted};
use crate::faults::Faults;
use crate::foreign::Document;
use crate::key;
use crate::reading::{read_schema, read_with};
use crate::section::Reader;
use crate::shape::ValueShape;
use crate::source::Source;
use crate::study::axis::{Axis, Block, MOST_VALUES, RandomSample, counted_out, ends_of};
use crate::study::field::{Field, KeyValue, PROCESS};
use crate::value::{RawEntry, RawKind, RawTable, RawValue};

/// A study as its file defines it.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// The text, for faults that are found later.
    pub source: Source,
    /// The spec around which values are varied: a path relative to the study file.
    pub spec: String,
    /// The model that predicts; `None`: the spec's.
    pub model: Option<ModelChoice>,
    /// The fineness of shells' meshes, and its place in the text; `None`: medium.
    pub fineness: Option<(Detail, Range<usize>)>,
    /// Fields with a value that replaces the spec's.
    pub set: Vec<(Field, KeyValue)>,
    /// The axes that vary, by block; the last runs fastest. Never empty.
    pub blocks: Vec<Block>,
    /// The requested columns; `None`: all.
    pub outputs: Option<Vec<Wanted>>,
    /// Where the text names a process; empty for a study without a text.
    pub processes: Vec<NamedProcess>,
}

/// A place of a study's text that names a process of the spec.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedProcess {
    /// Name of the process.
    pub name: String,
    /// Place of the key.
    pub place: Range<usize>,
}

/// A requested column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// Name of the output.
    pub name: String,
    /// Place of the name in the text.
    pub place: Range<usize>,
}

/// Most values that are drawn.
const MOST_DRAWN: u32 = 1_000_000_000;

/// Reads a study file: `schema`, `spec`, `model`, `fineness`, `outputs`, `[set]`, and at least one of `[vary]` (every combination of its
/// lists), `[rows]` (lists of one length that go on together) and `[draw]` (drawn between two ends).
///
/// # Errors
/// All faults of the text at once.
pub fn read_study(source: &Source) -> Result<StudyFile, Faults> {
    read_with(source, Document::Study, |reader| read_file(reader, source)).map(|(file, _, _)| file)
}

fn read_file(reader: &mut Reader<'_>, source: &Source) -> StudyFile {
    let mut root = reader.root();
    root.require(&[("schema", "1"), ("spec", "\"spec.toml\"")]);
    read_schema(&mut root, 1);
    let allowed = "must be the path of a spec, relative to this file";
    let spec = root.path("spec", FaultCode::Name, allowed).unwrap_or_default();
    let model = root.choice("model", &ModelChoice::ALL);
    let place = root.place_of("model");
    let fineness = root.choice("fineness", &Detail::ALL).map(|detail| (detail, root.place_of("fineness")));
    let selected = |(name, place): (&str, Range<usize>)| Wanted { name: name.to_owned(), place };
    let outputs = root.texts("outputs").map(|names| names.into_iter().map(selected).collect());
    // A key may be set once in the whole file: the sections are read one after the other, and each adds its keys. A process is only noted
    // here, because the spec that has it is read later.
    let mut keys = SeenKeys::default();
    if model.is_some() {
        let field = Field::find(&key::accuracy::MODEL.to_string());
        if let Some(field) = field {
            keys.add(field, place, "model", &mut reader.faults);
        }
    }
    let set = read_set(reader, &mut keys);
    let mut blocks = Vec::from_iter(read_draw(reader, &mut keys));
    blocks.extend(read_rows(reader, &mut keys));
    blocks.extend(read_vary(reader, &mut keys));
    if blocks.is_empty() && reader.faults.is_empty() {
        let fault = Fault::error(FaultCode::MissingKey, usize::MAX..usize::MAX, "nothing is varied")
            .label("a study needs [vary], [rows] or [draw]")
            .help("write for instance: vary.star.points = [3, 4, 5]");
        reader.faults.push(fault);
    }
    StudyFile {
        source: source.clone(),
        spec,
        model,
        fineness,
        set,
        blocks,
        outputs,
        processes: keys.processes(),
    }
}

/// The keys that were set so far, with the section that sets them.
#[derive(Default)]
struct SeenKeys(Vec<SeenKey>);

/// A key with the section and the place that set it.
struct SeenKey {
    field: Field,
    section: &'static str,
    place: Range<usize>,
}

impl SeenKeys {
    /// Adds `field`; a fault if it, or its twin, is there already.
    fn add(&mut self, field: Field, place: Range<usize>, section: &'static str, faults: &mut Vec<Fault>) {
        if let Some(earlier) = self.0.iter().find(|earlier| earlier.field.is_of_same_value(&field)) {
            let name = field.name();
            let problem = if earlier.field == field {
                format!("`{name}` is set twice")
            } else {
                format!("`{name}` is set besides `{}`, the same size", earlier.field.name())
            };
            let fault = Fault::error(FaultCode::Conflict, place.clone(), problem);
            let label = format!("{} sets it already", earlier.section);
            faults.push(fault.label(label).help("delete one of them"));
        }
        self.0.push(SeenKey { field, section, place });
    }

    /// The places of keys of processes.
    fn processes(&self) -> Vec<NamedProcess> {
        let place_of = |key: &SeenKey| {
            let name = key.field.process()?.to_owned();
            Some(NamedProcess { name, place: key.place.clone() })
        };
        self.0.iter().filter_map(place_of).collect()
    }
}

/// A key of the study, with its value.
struct Leaf<'r> {
    /// The key of the spec.
    field: Field,
    /// The span of its name.
    place: Range<usize>,
    /// The value of the key.
    value: &'r RawValue,
}

/// The keys of `table`, in the order in which they were written; a fault for each that the spec does not have.
fn leaves<'r>(table: &'r RawTable, faults: &mut Vec<Fault>) -> Vec<Leaf<'r>> {
    let mut leaves = Vec::new();
    for entry in &table.0 {
        gather(entry, "", &mut leaves, faults);
    }
    sort_by_key(&mut leaves, |leaf| leaf.place.start);
    leaves
}

fn gather<'r>(entry: &'r RawEntry, section: &str, leaves: &mut Vec<Leaf<'r>>, faults: &mut Vec<Fault>) {
    let name = format!("{section}{}", entry.key);
    if let Some(field) = Field::find(&name) {
        leaves.push(Leaf { field, place: entry.key_span.clone(), value: &entry.value });
        return;
    }
    let holds_keys = section.is_empty() || section == format!("{PROCESS}.");
    if let Some(table) = entry.value.as_table().filter(|_| holds_keys) {
        for inner in &table.0 {
            gather(inner, &format!("{name}."), leaves, faults);
        }
        return;
    }
    let help = match Field::nearest_name(&name) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "keys are written with their section: star.points, load.pressure".to_owned(),
    };
    let problem = if name.starts_with("stack.star") || name == "schema" {
        format!("{} cannot be set by a study", quoted(&name))
    } else {
        format!("unknown key {}", quoted(&name))
    };
    let fault = Fault::error(FaultCode::UnknownKey, entry.key_span.clone(), problem);
    faults.push(fault.label("must be a key of the spec").help(help));
}

/// The leaves of section `name`, each once.
fn section<'r>(reader: &mut Reader<'r>, name: &'static str, keys: &mut SeenKeys) -> Vec<Leaf<'r>> {
    let Some(table) = reader.free(name).and_then(RawValue::as_table) else { return Vec::new() };
    let section_leaves = leaves(table, &mut reader.faults);
    for leaf in &section_leaves {
        keys.add(leaf.field.clone(), leaf.place.clone(), name, &mut reader.faults);
    }
    section_leaves
}

/// What was found, or `None` and its fault among `faults`.
fn or_fault<T>(result: Result<T, Fault>, faults: &mut Vec<Fault>) -> Option<T> {
    result.map_err(|fault| faults.push(fault)).ok()
}

fn read_set(reader: &mut Reader<'_>, keys: &mut SeenKeys) -> Vec<(Field, KeyValue)> {
    let leaves = section(reader, "set", keys).into_iter();
    let set = leaves.filter_map(|leaf| {
        let value = or_fault(leaf.field.read(leaf.value), &mut reader.faults)?;
        Some((leaf.field, value))
    });
    set.collect()
}

fn read_vary(reader: &mut Reader<'_>, keys: &mut SeenKeys) -> Vec<Block> {
    let leaves = section(reader, "vary", keys).into_iter();
    leaves.filter_map(|leaf| Block::new(vec![or_fault(read_axis(leaf), &mut reader.faults)?])).collect()
}

fn read_rows(reader: &mut Reader<'_>, keys: &mut SeenKeys) -> Option<Block> {
    let mut axes: Vec<Axis> = Vec::new();
    for leaf in section(reader, "rows", keys) {
        let (name, place) = (leaf.field.name(), leaf.value.span.clone());
        let Some(axis) = or_fault(read_axis(leaf), &mut reader.faults) else { continue };
        if let Some(first) = axes.first().filter(|first| first.len() != axis.len()) {
            let problem = format!("`{name}` has {} values in [rows]", axis.len());
            let label =
                format!("must have {}, as `{}`: a row takes one of each", first.len(), first.field.name());
            reader.faults.push(Fault::error(FaultCode::CellCount, place, problem).label(label));
        }
        axes.push(axis);
    }
    Block::new(axes)
}

/// A list of values, or a range that is counted out.
fn read_axis(Leaf { field, value, .. }: Leaf<'_>) -> Result<Axis, Fault> {
    let values = match &value.kind {
        RawKind::List(list) if list.is_empty() => {
            return Err(axis_fault(&field, value, FaultCode::OutOfRange, "must hold at least one value"));
        }
        RawKind::List(list) if list.len() > MOST_VALUES as usize => {
            return Err(axis_fault(
                &field,
                value,
                FaultCode::OutOfRange,
                &format!("must hold at most {MOST_VALUES} values"),
            ));
        }
        // One fault is enough: an error in the first of a thousand values is in all of them.
        RawKind::List(list) => list.iter().map(|value| field.read(value)).collect::<Result<_, _>>()?,
        RawKind::Text(text) if text.contains("..") => counted_out(&field, text)
            .map_err(|reason| axis_fault(&field, value, FaultCode::OutOfRange, &reason))?,
        _ => {
            let fault = axis_fault(
                &field,
                value,
                FaultCode::WrongType,
                "must be a list, [a, b, c], or \"FROM..TO/COUNT\"",
            );
            return Err(fault.help("a single fixed value belongs in [set]"));
        }
    };
    Ok(Axis::listed(field, values))
}

fn axis_fault(field: &Field, value: &RawValue, code: FaultCode, label: &str) -> Fault {
    let problem = format!("`{}` is {}", field.name(), value.in_words());
    Fault::error(code, value.span.clone(), problem).label(label)
}

fn read_draw(reader: &mut Reader<'_>, keys: &mut SeenKeys) -> Option<Block> {
    let mut section = reader.section("draw");
    if section.is_written() {
        section.require(&[("count", "1000"), ("between", "{ \"star.tube_width\" = \"10 mm..40 mm\" }")]);
    }
    let count = section.count("count", 1, MOST_DRAWN).map_or(1, u64::from);
    let seed = section.count("seed", 0, u32::MAX).map_or(1, u64::from);
    let latin = section.choice("method", &[("latin", true), ("random", false)]).unwrap_or(true);
    let between_ends = section.take("between", ValueShape::Sections)?;
    let Some(table) = between_ends.as_table() else {
        let allowed = "must be a section, [draw.between], of keys with \"FROM..TO\"";
        section.refuse(FaultCode::WrongType, "between", "`between` is not a section", allowed);
        return None;
    };
    let mut axes = Vec::new();
    for leaf in leaves(table, &mut reader.faults) {
        keys.add(leaf.field.clone(), leaf.place.clone(), "draw", &mut reader.faults);
        axes.extend(or_fault(drawn_axis(leaf, count, seed, latin), &mut reader.faults));
    }
    Block::new(axes)
}

/// The values of one key, `count` between two ends.
fn drawn_axis(
    Leaf { field, value, .. }: Leaf<'_>,
    count: u64,
    seed: u64,
    latin: bool,
) -> Result<Axis, Fault> {
    let ends = match &value.kind {
        RawKind::Text(text) => ends_of(&field, text),
        _ => Err("must be a text, \"FROM..TO\"".to_owned()),
    };
    let ends = ends.and_then(|[from, to]| {
        let problem = "the range is descending: write the smaller end first";
        if from <= to { Ok([from, to]) } else { Err(problem.to_owned()) }
    });
    let [from, to] = ends.map_err(|why| axis_fault(&field, value, FaultCode::OutOfRange, &why))?;
    let key = RandomSample::number(&field.name());
    let is_whole = field.is_whole();
    Ok(Axis::sampled(field, RandomSample { from, to, whole: is_whole, seed, key, count, latin }))
}
