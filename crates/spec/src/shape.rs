//! The values that a key takes, as the reader states when it takes them: the schema is made of this, so that the two cannot
//! disagree.

use geom::order::sort_by_key;
use serde_json::{Map, Value, json};

use crate::allowed::Allowed;
use crate::message::article;
use crate::units::{Length, Quantity, QuantityKind};

/// A decimal number, as a JSON Schema's pattern: the number that `units` reads before a unit.
const NUMBER: &str = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";

/// The values that a key takes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ValueShape {
    /// A number and a unit in quotes; the range is in the base unit.
    Quantity(QuantityKind, Allowed),
    /// Two lengths with an x between.
    Area(Allowed),
    /// A plain number.
    Number(Allowed),
    /// A whole number with its ends.
    Count(u32, u32),
    /// true or false.
    Truth,
    /// Any text.
    Text,
    /// A list of texts.
    Texts,
    /// A value of the shape, or one of these words instead.
    Or(Box<ValueShape>, Vec<&'static str>),
    /// One of these words.
    Choice(Vec<&'static str>),
    /// A list of some of these words.
    Choices(Vec<&'static str>),
    /// A list of sections.
    Sections,
    /// A section whose keys are these words, each with a list of texts.
    Lists(Vec<&'static str>),
    /// A section whose keys are names, each with a list of texts.
    NamedLists,
    /// A section whose keys are names, each with a quantity in the range.
    Quantities(QuantityKind, Allowed),
}

impl ValueShape {
    /// The JSON Schema, and the conditions that it cannot express, in words.
    ///
    /// A quantity is a text with a pattern, since a schema has no units; its range is in the words. `Or` adds words to the
    /// schema of another shape.
    pub(super) fn schema(&self) -> (Value, Option<String>) {
        let (schema, range_words) = match self {
            Self::Quantity(kind, allowed) => quantity_schema(*kind, *allowed),
            Self::Area(allowed) => area_schema(*allowed),
            Self::Number(allowed) => (allowed.schema(), format!("A plain number; {}.", allowed.in_words(""))),
            Self::Count(low, high) => {
                let schema = json!({ "type": "integer", "minimum": low, "maximum": high });
                let range_words = format!("A whole number from {low} to {high}.");
                (schema, if low == high { format!("Always {low}.") } else { range_words })
            }
            Self::Or(shape, words) => {
                let (schema, range_words) = shape.schema();
                let ways = std::iter::once(schema).chain(words.iter().map(|word| json!({ "const": word })));
                let list: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                let range_words = format!("{} Or {}.", range_words.unwrap_or_default(), list.join(" or "));
                (json!({ "anyOf": ways.collect::<Vec<_>>() }), range_words)
            }
            Self::Choice(words) => {
                (json!({ "type": "string", "enum": words }), format!("One of {}.", words.join(", ")))
            }
            Self::Choices(words) => {
                let items = json!({ "type": "string", "enum": words });
                let schema = json!({ "type": "array", "items": items, "uniqueItems": true });
                (schema, format!("A list of some of {}.", words.join(", ")))
            }
            Self::Texts => (texts_schema(), "A list of texts.".to_owned()),
            Self::Truth => return (json!({ "type": "boolean" }), None),
            Self::Text => return (json!({ "type": "string" }), None),
            Self::Sections => return (json!({ "type": "array" }), None),
            Self::Quantities(kind, allowed) => {
                let (quantity, by_name) = Self::Quantity(*kind, *allowed).schema();
                let schema = json!({ "type": "object", "additionalProperties": quantity });
                return (
                    schema,
                    by_name
                        .map(|by_name| format!("By name: {}{}", by_name[..1].to_lowercase(), &by_name[1..])),
                );
            }
            Self::NamedLists => {
                return (json!({ "type": "object", "additionalProperties": texts_schema() }), None);
            }
            Self::Lists(words) => {
                let keys: Map<_, _> = words.iter().map(|word| ((*word).to_owned(), texts_schema())).collect();
                let schema = json!({ "type": "object", "additionalProperties": false, "properties": keys });
                return (schema, None);
            }
        };
        (schema, Some(range_words))
    }
}

fn texts_schema() -> Value {
    json!({ "type": "array", "items": { "type": "string" } })
}

fn quantity_schema(kind: QuantityKind, allowed: Allowed) -> (Value, String) {
    let (name, units) = (capital(&article(kind.name)), kind.unit_list());
    let range_words = format!("{name} with its unit ({units}); {}.", allowed.in_words(kind.unit()));
    let pattern = format!(r"^\s*{NUMBER}\s*({})\s*$", alternatives(kind));
    (json!({ "type": "string", "pattern": pattern }), range_words)
}

fn area_schema(allowed: Allowed) -> (Value, String) {
    let range_words = allowed.in_words(Length::KIND.unit());
    let unit = alternatives(Length::KIND);
    let pattern = format!("^\\s*{NUMBER}\\s*({unit})?\\s*[x\u{d7}]\\s*{NUMBER}\\s*({unit})\\s*$");
    let schema = json!({ "type": "string", "pattern": pattern });
    (schema, format!("Two lengths with an x between; each {range_words}."))
}

/// Units as a pattern; the longest first, so that no unit hides another that begins with it.
fn alternatives(kind: QuantityKind) -> String {
    let mut units: Vec<&str> = kind.units.iter().map(|(name, _)| *name).collect();
    sort_by_key(&mut units, |unit| std::cmp::Reverse(unit.len()));
    units.join("|").replace('^', r"\^")
}

/// `text` with a capital letter first.
pub(super) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
