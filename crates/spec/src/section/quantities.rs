//! Quantities: numbers with a unit, alone, by name, and as the two sides of an area.

use std::ops::Range;

use crate::allowed::Allowed;
use crate::fault::{Fault, quoted};
use crate::message::{article, bare_number, malformed};
use crate::section::Section;
use crate::shape::ValueShape;
use crate::units::{Length, Quantity, QuantityFault, QuantityKind, Readable};
use crate::value::{RawKind, RawValue};
use crate::{Code, FaultCode};

impl Section<'_, '_> {
    /// A quantity within `allowed`; `None` if it is absent or faulty.
    pub(crate) fn quantity<Q: Quantity>(&mut self, key: &'static str, allowed: Allowed) -> Option<Q> {
        self.in_base(key, Q::KIND, allowed).map(Q::from_base)
    }

    /// A quantity of some kind in its base unit within `allowed`; `None` if it is absent or faulty.
    pub(crate) fn in_base(&mut self, key: &'static str, kind: QuantityKind, allowed: Allowed) -> Option<f64> {
        let value = self.take(key, ValueShape::Quantity(kind, allowed))?;
        self.quantity_of(key, value, kind, allowed)
    }

    /// Quantities by name within `allowed`, in the order of the text; those that are faulty are left out.
    pub(crate) fn quantities<Q: Quantity>(
        &mut self,
        key: &'static str,
        allowed: Allowed,
    ) -> Vec<(String, Q)> {
        let Some(value) = self.take(key, ValueShape::Quantities(Q::KIND, allowed)) else { return Vec::new() };
        let Some(table) = value.as_table() else {
            let label = format!("must be a section, [{}.{key}], with a quantity for each name", self.name);
            let _: Option<()> = self.refuse_type(key, value, &label);
            return Vec::new();
        };
        let mut quantities = Vec::new();
        for entry in &table.0 {
            if let Some(base) = self.quantity_of(&entry.key, &entry.value, Q::KIND, allowed) {
                quantities.push((entry.key.clone(), Q::from_base(base)));
            }
        }
        quantities
    }

    /// The quantity `value` of `key` in its base unit; `None` if it is faulty.
    fn quantity_of(
        &mut self,
        key: &str,
        value: &RawValue,
        kind: QuantityKind,
        allowed: Allowed,
    ) -> Option<f64> {
        let a_quantity = article(kind.name);
        let fault = match &value.kind {
            RawKind::Text(text) => match kind.parse(text) {
                Ok((number, _)) if allowed.contains(number) => return Some(number),
                Ok((number, _)) => {
                    let base = format!("{} {}", Readable(number), kind.unit());
                    // Far out of every range the number in the base unit only adds digits.
                    let is_plain = base == text.trim() || number.abs() > 1e9;
                    let base_text = if is_plain { String::new() } else { format!(", that is {base}") };
                    let message = format!("`{key}` is {}{base_text}", quoted(text));
                    Fault::error(FaultCode::OutOfRange, value.span.clone(), message)
                        .label(allowed.in_words(kind.unit()))
                }
                Err(reason) => malformed(kind, key, text, &reason, value.span.clone()),
            },
            RawKind::Number(number) => {
                // The example for a value of `nan` is a number.
                let example = if number.value.is_finite() { number.shortened_text() } else { "5".to_owned() };
                let message = format!("`{key}` is the bare number {}", number.shortened_text());
                Fault::error(FaultCode::NoUnit, value.span.clone(), message)
                    .label(format!("{a_quantity} needs a unit: {}", kind.unit_list()))
                    .help(bare_number(kind, key, &example))
            }
            _ => {
                let label = format!("must be {a_quantity} in quotes, with a unit: {}", kind.unit_list());
                self.wrong_type(key, value, &label)
            }
        };
        self.report(fault);
        None
    }

    /// Two lengths within `allowed` with an x between, the unit after each or after both: "220 mm x 220 mm"; `None` if
    /// it is absent or faulty.
    pub(crate) fn area(&mut self, key: &'static str, allowed: Allowed) -> Option<[Length; 2]> {
        let (area_text, span) = self.word(key, ValueShape::Area(allowed))?;
        let Some((width, depth)) = area_text.split_once(['x', '\u{d7}']) else {
            self.report(not_an_area(span, format!("`{key}` is {}", quoted(area_text))));
            return None;
        };
        let unit = depth.trim_start_matches(|c: char| c.is_ascii_digit() || " .+-".contains(c));
        let width = match Length::parse(width) {
            Err(QuantityFault::NoUnit) => format!("{} {unit}", width.trim()),
            _ => width.trim().to_owned(),
        };
        let lengths = [width.as_str(), depth.trim()].map(|text| match Length::parse(text) {
            Ok(found) if allowed.contains(found.base()) => Ok(found),
            Ok(_) => {
                let message = format!("`{key}` is {}", quoted(text));
                let fault = Fault::error(FaultCode::OutOfRange, span.clone(), message);
                Err(fault.label(allowed.in_words(Length::KIND.unit())))
            }
            Err(QuantityFault::NoUnit) => {
                let sides = [width.trim(), depth.trim()].map(|side| match Length::parse(side) {
                    Err(QuantityFault::NoUnit) => format!("{side} mm"),
                    _ => side.to_owned(),
                });
                let message = format!("`{key}` is {}, without a unit", quoted(area_text));
                let fault = not_an_area(span.clone(), message);
                let help = format!("write for instance: {key} = \"{}\"", sides.join(" x "));
                Err(Fault { code: FaultCode::NoUnit.as_str(), ..fault.help(help) })
            }
            Err(reason) => Err(malformed(Length::KIND, key, text, &reason, span.clone())),
        });
        match lengths {
            [Ok(width), Ok(depth)] => Some([width, depth]),
            // One fault is enough: both are of one key.
            [Err(fault), _] | [_, Err(fault)] => {
                self.report(fault);
                None
            }
        }
    }
}

fn not_an_area(span: Range<usize>, message: String) -> Fault {
    let label = "must be two lengths with an x between: \"220 mm x 220 mm\"";
    Fault::error(FaultCode::WrongType, span, message).label(label)
}
