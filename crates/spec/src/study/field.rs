//! One key of a spec that a study sets: its shape and its values.

use std::sync::LazyLock;

use crate::FaultCode;
use crate::fault::Fault;
use crate::key::{self, KeyPath};
use crate::processes::check_process_name;
use crate::product::ProductKind;
use crate::raw::RawSpec;
use crate::reading::read_spec;
use crate::section::{Reader, Section};
use crate::shape::ValueShape;
use crate::unknown::nearest;
use crate::value::{RawKind, RawNumber, RawValue};

/// A key of the spec that a study sets.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    key: KeyPath,
    /// The process of a key of one.
    process: Option<String>,
    shape: ValueShape,
}

/// A value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum KeyValue {
    /// A quantity in its base unit, a plain number, or a whole one.
    Number(f64),
    /// A word, or any other text.
    Word(String),
    /// True or false.
    Truth(bool),
}

/// The shape of every key, from the reader.
static SHAPES: LazyLock<Vec<(&'static str, &'static str, ValueShape)>> = LazyLock::new(|| {
    let (raw, _) = RawSpec::parse("[stack]\ncount = 64\n");
    let mut reader = Reader::new(&raw);
    let _ = read_spec(&mut reader);
    reader.shapes().map(|(section, key, shape)| (section, key, shape.clone())).collect()
});

impl Field {
    /// The field of the key `name`, "star.points" or "process.weak.speed"; `None` if a study cannot set it: the key does not exist, or it is
    /// `schema`, the list of single stars, `build.with`, or one of a drawing, of a press or of a tool that cuts, since studies cover stars and
    /// what they do. Whether the spec has the process is not known here.
    pub fn find(name: &str) -> Option<Self> {
        if let Some((process, word)) = process_and_key(name) {
            let key = *process_keys().find(|key| key.key() == word)?;
            check_process_name(process).ok()?;
            return Some(Self { key, process: Some(process.to_owned()), shape: shape_of(key)?.clone() });
        }
        let key = *key::ALL.iter().find(|key| key.to_string() == name)?;
        let shape = shape_of(key)?;
        let of_drawings = [key::sheet::COPIES, key::mask::KIND, key::load::CHAMBERS, key::load::PLATES];
        // The tool that cuts decides no prediction.
        let of_cut_tool = [
            key::cut::TOOL,
            key::cut::TEMPERATURE,
            key::cut::SPEED,
            key::cut::HEIGHT,
            key::cut::BLADE_OFFSET,
            key::cut::POWER,
            key::cut::FOCUS,
        ];
        // A press seals all at once: no prediction depends on how.
        let is_of_another_product = of_drawings.contains(&key)
            || of_cut_tool.contains(&key)
            || key.section() == key::press::CREEP.section()
            || ProductKind::ALL
                .iter()
                .any(|(section, product)| *product != ProductKind::Stars && *section == key.section());
        // A key of a process has the name of the process before it, as above.
        let is_of_process = key.section() == key::process::SPEED.section()
            || [key::star::INNER_PROCESS, key::star::OUTER_PROCESS].contains(&key);
        // A study varies the strength of seams where most specs write it, in [fabric].
        let is_written_twice = key == key::seal::STRENGTH;
        (key != key::root::SCHEMA
            && !is_of_another_product
            && !is_of_process
            && !is_written_twice
            && !matches!(shape, ValueShape::Sections | ValueShape::Choices(_)))
        .then(|| Self { key, process: None, shape: shape.clone() })
    }

    /// The key nearest to `name`, if one is near.
    pub fn nearest_name(name: &str) -> Option<String> {
        if let Some((process, word)) = process_and_key(name) {
            let key_name = nearest(word, process_keys().map(|key| key.key()))?;
            return Some(format!("{PROCESS}.{process}.{key_name}"));
        }
        let of_any_process = name.strip_prefix(PROCESS).and_then(|rest| rest.strip_prefix('.'));
        if let Some(key) = of_any_process.and_then(|word| process_keys().find(|key| key.key() == word)) {
            return Some(format!("{PROCESS}.NAME.{}", key.key()));
        }
        let names: Vec<String> = Self::names().collect();
        let nearest_word = nearest(name, names.iter().map(String::as_str));
        // A name with no section, or with another one, is taken to mean the same key.
        let word = name.rsplit('.').next().unwrap_or(name);
        let ends = |known: &&String| known.rsplit('.').next() == Some(word);
        nearest_word.map(str::to_owned).or_else(|| names.iter().find(ends).cloned())
    }

    /// The names of all fields but those of processes, which a spec names.
    pub fn names() -> impl Iterator<Item = String> {
        key::ALL.iter().map(ToString::to_string).filter(|name| Self::find(name).is_some())
    }

    /// The key, of a process without its name.
    pub fn key(&self) -> KeyPath {
        self.key
    }

    /// The name of the process whose key it is; `None` for all other keys.
    pub fn process(&self) -> Option<&str> {
        self.process.as_deref()
    }

    /// The name that a study has for it: "star.points", "process.weak.speed".
    pub fn name(&self) -> String {
        match &self.process {
            Some(process) => format!("{PROCESS}.{process}.{}", self.key.key()),
            None => self.key.to_string(),
        }
    }

    /// Whether both set the same value of a spec, be it by two keys, such as an object's radius and diameter.
    pub fn is_of_same_value(&self, other: &Self) -> bool {
        self.process == other.process && (self.key == other.key || self.key.twin() == Some(other.key))
    }

    /// The unit of its numbers; `None` if they have none.
    pub fn unit(&self) -> Option<&'static str> {
        match &self.shape {
            ValueShape::Quantity(kind, _) => Some(kind.unit()),
            _ => None,
        }
    }

    /// Whether its values are numbers, so that there are some between two of them.
    pub fn is_number(&self) -> bool {
        matches!(self.shape, ValueShape::Quantity(..) | ValueShape::Number(_) | ValueShape::Count(..))
    }

    /// Whether its values are whole numbers.
    pub fn is_whole(&self) -> bool {
        matches!(self.shape, ValueShape::Count(..))
    }

    /// The value of `text` on a command line: "3", "40 mm", "true".
    ///
    /// # Errors
    /// One sentence that states the value found and the allowed ones.
    pub fn parse(&self, text: &str) -> Result<KeyValue, String> {
        let text = text.trim();
        let kind = match &self.shape {
            ValueShape::Number(_) | ValueShape::Count(..) => number(text).map(RawKind::Number),
            ValueShape::Truth => text.parse().ok().map(RawKind::Truth),
            _ => None,
        };
        let kind = kind.unwrap_or_else(|| RawKind::Text(text.to_owned()));
        let first_fault = |fault: Fault| {
            let help = fault.help.map(|help| format!("; {help}")).unwrap_or_default();
            format!("{}: {}{help}", fault.message, fault.label)
        };
        self.read(&RawValue { kind, span: 0..0 }).map_err(first_fault)
    }

    /// The value that was written as `value`, in its range.
    pub(super) fn read(&self, value: &RawValue) -> Result<KeyValue, Fault> {
        let raw = RawSpec::of_one(self.key, value.clone());
        let mut reader = Reader::new(&raw);
        let mut section = match self.key.section() {
            "" => reader.root(),
            name => reader.section(name),
        };
        let key_value = value_of(&mut section, self.key.key(), &self.shape);
        let unread = || Fault::error(FaultCode::WrongType, value.span.clone(), format!("`{}`", self.name()));
        key_value.ok_or_else(|| reader.faults.pop().unwrap_or_else(unread))
    }

    /// `value` as a spec writes it.
    pub fn toml(&self, value: &KeyValue) -> String {
        match (value, self.unit()) {
            // `{}` prints the shortest decimals that read back to the same number.
            (KeyValue::Number(number), Some(unit)) => format!("\"{number} {unit}\""),
            (KeyValue::Number(number), None) => number.to_string(),
            (KeyValue::Word(word), _) => toml_edit::Value::from(word.as_str()).to_string(),
            (KeyValue::Truth(truth), _) => truth.to_string(),
        }
    }
}

/// The section of processes.
pub(super) const PROCESS: &str = key::process::SPEED.section();

/// The keys of a process.
fn process_keys() -> impl Iterator<Item = &'static KeyPath> {
    key::ALL.iter().filter(|key| key.section() == PROCESS)
}

/// Name and key in "process.weak.speed"; `None` for a name of another form.
fn process_and_key(name: &str) -> Option<(&str, &str)> {
    name.strip_prefix(PROCESS)?.strip_prefix('.')?.split_once('.')
}

/// The shape of the values of `key`.
fn shape_of(key: KeyPath) -> Option<&'static ValueShape> {
    let entry = SHAPES.iter().find(|(section, word, _)| (*section, *word) == (key.section(), key.key()));
    entry.map(|(_, _, shape)| shape)
}

/// A plain number as TOML has it.
fn number(text: &str) -> Option<RawNumber> {
    let value: f64 = text.parse().ok().filter(|value: &f64| value.is_finite())?;
    let integer = text.parse().ok();
    Some(RawNumber { text: text.to_owned(), value, is_integer: integer.is_some(), whole: integer })
}

fn value_of(section: &mut Section<'_, '_>, key: &'static str, shape: &ValueShape) -> Option<KeyValue> {
    match shape {
        ValueShape::Quantity(kind, allowed) => section.in_base(key, *kind, *allowed),
        ValueShape::Number(allowed) => section.number(key, *allowed),
        ValueShape::Count(low, high) => section.count(key, *low, *high).map(f64::from),
        ValueShape::Truth => return section.truth(key).map(KeyValue::Truth),
        ValueShape::Text => return section.text(key).map(|(text, _)| KeyValue::Word(text.to_owned())),
        ValueShape::Choice(words) => {
            let choices: Vec<(&'static str, &'static str)> =
                words.iter().map(|word| (*word, *word)).collect();
            return section.choice(key, &choices).map(|word| KeyValue::Word(word.to_owned()));
        }
        ValueShape::Area(allowed) => {
            let sides = section.area(key, *allowed);
            return sides.map(|[width, depth]| KeyValue::Word(format!("{width} x {depth}")));
        }
        ValueShape::Or(shape, _) => return value_of(section, key, shape),
        ValueShape::Sections
        | ValueShape::Lists(_)
        | ValueShape::NamedLists
        | ValueShape::Quantities(..)
        | ValueShape::Texts
        | ValueShape::Choices(_) => None,
    }
    .map(KeyValue::Number)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A value that every shape takes.
    fn example(shape: &ValueShape) -> String {
        match shape {
            ValueShape::Quantity(kind, allowed) if !allowed.contains(0.5) => format!("-0.5 {}", kind.unit()),
            ValueShape::Quantity(kind, _) => format!("0.5 {}", kind.unit()),
            ValueShape::Area(_) => "220 mm x 210 mm".to_owned(),
            ValueShape::Number(_) => "0.25".to_owned(),
            ValueShape::Count(low, _) => low.to_string(),
            ValueShape::Truth => "true".to_owned(),
            ValueShape::Choice(words) => words[0].to_owned(),
            ValueShape::Or(shape, _) => example(shape),
            ValueShape::Text
            | ValueShape::Texts
            | ValueShape::Lists(_)
            | ValueShape::NamedLists
            | ValueShape::Quantities(..)
            | ValueShape::Choices(_)
            | ValueShape::Sections => "x".to_owned(),
        }
    }

    #[test]
    fn every_key_takes_a_value_and_gives_it_back() {
        for name in Field::names() {
            let field = Field::find(&name).expect("a field");
            let text = example(&field.shape);
            let value = field.parse(&text).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            let (raw, _) = RawSpec::parse(&format!("x = {}", field.toml(&value)));
            let back = field.read(raw.root().get("x").expect("written"));
            assert_eq!(back.ok(), Some(value), "{name}");
        }
    }

    #[test]
    fn keys_that_no_study_sets_are_these() {
        let names = key::ALL.iter().map(ToString::to_string);
        let unset_names: Vec<String> = names.filter(|name| Field::find(name).is_none()).collect();
        let expected = [
            "schema",
            "star.inner_process",
            "star.outer_process",
            "stack.star",
            "drawing.file",
            "drawing.units",
            "drawing.join",
            "drawing.passage",
            "drawing.flange",
            "drawing.layers",
            "drawing.process",
            "drawing.measure",
            "seal.strength",
            "process.temperature",
            "process.speed",
            "process.height",
            "process.passes",
            "process.lines",
            "process.overlap",
            "process.cool",
            "process.pause",
            "process.strength",
            "process.power",
            "process.focus",
            "mask.kind",
            "cut.tool",
            "cut.temperature",
            "cut.speed",
            "cut.height",
            "cut.blade_offset",
            "cut.power",
            "cut.focus",
            "sheet.copies",
            "press.temperature",
            "press.time",
            "press.pressure",
            "press.layers",
            "press.creep",
            "press.paper",
            "press.plates",
            "load.chambers",
            "load.plates",
            "build.with",
        ];
        assert_eq!(unset_names, expected);
    }

    #[test]
    fn values_out_of_range_say_what_is_allowed() {
        let refusal_of =
            |name: &str, text: &str| Field::find(name).expect("a key").parse(text).expect_err("refused");
        assert_eq!(refusal_of("star.points", "2"), "`points` is 2: must be from 3 to 64");
        assert_eq!(
            refusal_of("star.points", "4.5"),
            "`points` in [star] is the number 4.5: must be a whole number, without quotes and unit"
        );
        assert_eq!(
            refusal_of("star.tube_width", "0 mm"),
            "`tube_width` is `0 mm`: must be at least 0.001 mm and at most 100000 mm"
        );
        assert!(
            refusal_of("star.tube_width", "3")
                .starts_with("`tube_width` is `3`, without a unit: a length needs a unit")
        );
        assert!(refusal_of("accuracy.model", "secton").ends_with("did you mean \"section\"?"));
        assert!(refusal_of("mask.mirror", "yes").contains("must be true or false"));
    }

    #[test]
    fn keys_are_known_by_name() {
        assert_eq!(Field::nearest_name("star.tube_widht").as_deref(), Some("star.tube_width"));
        assert_eq!(Field::nearest_name("tube_width").as_deref(), Some("star.tube_width"));
        assert_eq!(Field::nearest_name("colour of the fabric"), None);
        assert!(Field::find("schema").is_none() && Field::find("stack.star").is_none());
    }

    #[test]
    fn every_key_of_a_process_is_one_with_its_name() {
        for key in process_keys() {
            let name = format!("process.weak.{}", key.key());
            let field = Field::find(&name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!((field.name(), field.process(), field.key()), (name, Some("weak"), *key));
            let value = field.parse(&example(&field.shape)).unwrap_or_else(|fault| panic!("{fault}"));
            assert_eq!(field.parse(field.toml(&value).trim_matches('"')), Ok(value));
        }
        for name in [
            "process.speed",
            "process.seal.speed",
            "process.a b.speed",
            "process.weak.band",
            "process.a.b.speed",
        ] {
            assert_eq!(Field::find(name), None, "{name}");
        }
        assert_eq!(Field::nearest_name("process.weak.sped").as_deref(), Some("process.weak.speed"));
        assert_eq!(Field::nearest_name("process.speed").as_deref(), Some("process.NAME.speed"));
        let [weak, strong] =
            ["weak", "strong"].map(|name| Field::find(&format!("process.{name}.speed")).expect("a key"));
        assert!(weak.is_of_same_value(&weak) && !weak.is_of_same_value(&strong));
        let refusal = weak.parse("0 mm/s").expect_err("refused");
        assert!(refusal.contains("must be"), "{refusal}");
    }
}
