//! The values that a key takes, as the reader states when it takes them: the schema is made of this, so that the two cannot
//! disagree.

use serde_json::{Value, json};

use crate::spec::allowed::Allowed;
use crate::spec::message::article;
use crate::units::{Length, Quantity};

/// A decimal number, as a JSON Schema's pattern: the number that `units` reads before a unit.
const NUMBER: &str = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";

/// The values that a key takes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ValueShape {
    /// A number and a unit in quotes.
    Quantity {
        /// "length".
        kind: &'static str,
        /// Every spelling of every unit, the base unit first.
        units: Vec<&'static str>,
        /// In the base unit.
        allowed: Allowed,
    },
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
    /// The same, or one of these words instead.
    Or(Box<ValueShape>, Vec<&'static str>),
    /// One of these words.
    Choice(Vec<&'static str>),
    /// A list of some of these words.
    Choices(Vec<&'static str>),
    /// A list of sections.
    Sections,
    /// A section whose keys are these words, each with a list of texts.
    Lists(Vec<&'static str>),
}

impl ValueShape {
    /// The shape of a quantity.
    pub(super) fn quantity<Q: Quantity>(allowed: Allowed) -> Self {
        Self::Quantity { kind: Q::KIND, units: Q::UNITS.iter().map(|(name, _)| *name).collect(), allowed }
    }

    /// The JSON Schema, and the conditions that it cannot express, in words.
    pub(super) fn schema(&self) -> (Value, Option<String>) {
        let told = match self {
            Self::Quantity { kind, units, allowed } => {
                let range = allowed.in_words(units.first().copied().unwrap_or_default());
                let typed: Vec<&str> = units.iter().copied().filter(|unit| unit.is_ascii()).collect();
                Some(format!("{} with its unit ({}); {range}.", capital(&article(kind)), typed.join(", ")))
            }
            Self::Area(allowed) => {
                let range = allowed.in_words(Length::UNITS[0].0);
                Some(format!("Two lengths with an x between; each {range}."))
            }
            Self::Number(allowed) => Some(format!("A plain number; {}.", allowed.in_words(""))),
            Self::Count(low, high) if low == high => Some(format!("Always {low}.")),
            Self::Count(low, high) => Some(format!("A whole number from {low} to {high}.")),
            Self::Choice(words) => Some(format!("One of {}.", words.join(", "))),
            Self::Choices(words) => Some(format!("A list of some of {}.", words.join(", "))),
            Self::Or(shape, words) => {
                let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                let (_, told) = shape.schema();
                Some(format!("{} Or {}.", told.unwrap_or_default(), words.join(" or ")))
            }
            Self::Texts => Some("A list of texts.".to_owned()),
            Self::Truth | Self::Text | Self::Sections | Self::Lists(_) => None,
        };
        let schema = match self {
            Self::Quantity { units, .. } => {
                json!({ "type": "string", "pattern": format!(r"^\s*{NUMBER}\s*({})\s*$", alternatives(units)) })
            }
            Self::Area(_) => {
                let units: Vec<&str> = Length::UNITS.iter().map(|(name, _)| *name).collect();
                let unit = alternatives(&units);
                let pattern = format!("^\\s*{NUMBER}\\s*({unit})?\\s*[x\u{d7}]\\s*{NUMBER}\\s*({unit})\\s*$");
                json!({ "type": "string", "pattern": pattern })
            }
            Self::Number(allowed) => allowed.schema(),
            Self::Count(low, high) => json!({ "type": "integer", "minimum": low, "maximum": high }),
            Self::Truth => json!({ "type": "boolean" }),
            Self::Text => json!({ "type": "string" }),
            Self::Texts => json!({ "type": "array", "items": { "type": "string" } }),
            Self::Or(shape, words) => {
                let words = words.iter().map(|word| json!({ "const": word }));
                let ways: Vec<Value> = std::iter::once(shape.schema().0).chain(words).collect();
                json!({ "anyOf": ways })
            }
            Self::Choice(words) => json!({ "type": "string", "enum": words }),
            Self::Choices(words) => {
                json!({ "type": "array", "items": { "type": "string", "enum": words }, "uniqueItems": true })
            }
            Self::Sections => json!({ "type": "array" }),
            Self::Lists(words) => {
                let list = json!({ "type": "array", "items": { "type": "string" } });
                let keys: serde_json::Map<String, Value> =
                    words.iter().map(|word| ((*word).to_owned(), list.clone())).collect();
                json!({ "type": "object", "additionalProperties": false, "properties": keys })
            }
        };
        (schema, told)
    }
}

/// Units as a pattern; the longest first, so that no unit hides another that begins with it.
fn alternatives(units: &[&str]) -> String {
    let mut units = units.to_vec();
    units.sort_by_key(|unit| std::cmp::Reverse(unit.len()));
    units.join("|").replace('^', r"\^")
}

/// `text` with a capital letter first.
pub(super) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
