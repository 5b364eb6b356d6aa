//! The wording of faults in single values.

use crate::spec::FaultCode;
use std::ops::Range;

use crate::spec::fault::{Fault, quoted};
use crate::spec::value::{RawNumber, RawValue};
use crate::units::{Percent, Pressure, Quantity, QuantityFault, Readable, Temperature};

/// A number that its range does not hold; the range is left to be named.
pub(super) fn out_of_range(key: &str, number: &RawNumber, value: &RawValue) -> Fault {
    Fault::error(FaultCode::OutOfRange, value.span.clone(), format!("`{key}` is {}", number.shown()))
}

/// A section's name as its header is written.
pub(super) fn header(name: &str) -> String {
    if name.contains('.') { format!("[[{name}]]") } else { format!("[{name}]") }
}

/// "a length", "an angle".
pub(super) fn article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

/// Other names of units, and their names in a spec.
const SYNONYMS: [(&str, &str); 8] = [
    ("\u{b0}", "deg"),
    ("degrees", "deg"),
    ("\"", "in"),
    ("\u{2033}", "in"),
    ("inch", "in"),
    ("inches", "in"),
    ("Celsius", "C"),
    ("mm/sec", "mm/s"),
];

/// Names of a unit that specs do not have, because it is not a multiple of theirs.
const FAHRENHEIT: [&str; 3] = ["F", "degF", "\u{b0}F"];

/// Whether the text behind a whole number is the rest of a decimal with a comma, or of thousands.
fn is_decimal_comma(rest: &str) -> bool {
    rest.strip_prefix(',')
        .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()) && !rest.contains(','))
}

/// The unit that a person most likely intends for `key`: for an elastic modulus the usual unit for fabrics, else the base unit.
pub(super) fn usual_unit<Q: Quantity>(key: &str) -> &'static str {
    let is_modulus = Q::KIND == Pressure::KIND && key.ends_with("modulus");
    if is_modulus { "MPa" } else { Q::UNITS[0].0 }
}

/// The remedy for the bare `number` of `key`. One up to 1 may be a share of one or a number of per cent.
pub(super) fn bare_number<Q: Quantity>(key: &str, number: &str) -> String {
    let unit = usual_unit::<Q>(key);
    match number.parse::<f64>() {
        Ok(share) if Q::KIND == Percent::KIND && share > 0.0 && share <= 1.0 => {
            format!(
                "write {key} = \"{} {unit}\" for a share of {number}, or \"{number} {unit}\"",
                Readable(100.0 * share)
            )
        }
        _ => format!("write for instance: {key} = \"{number} {unit}\""),
    }
}

/// The fault of a text that should be a quantity.
pub(super) fn malformed<Q: Quantity>(
    key: &str,
    text: &str,
    reason: &QuantityFault,
    span: Range<usize>,
) -> Fault {
    let (kind, units, base) = (Q::KIND, Q::unit_list(), usual_unit::<Q>(key));
    let message = format!("`{key}` is {}", quoted(text));
    match reason {
        QuantityFault::UnknownUnit(rest) if is_decimal_comma(rest) => {
            let [point, whole] = [".", ""].map(|mark| text.trim().replacen(',', mark, 1));
            let digits = rest.bytes().skip(1).take_while(u8::is_ascii_digit).count();
            let (label, help) = match (digits, rest.contains('.')) {
                (_, true) => ("thousands have no comma", format!("\"{whole}\"")),
                (3, _) => {
                    let both = format!("\"{whole}\" if the comma separates thousands, else \"{point}\"");
                    ("a number has no comma", both)
                }
                _ => ("a decimal point is needed, not a comma", format!("\"{point}\"")),
            };
            Fault::error(FaultCode::NotANumber, span, message)
                .label(label)
                .help(format!("write {key} = {help}"))
        }
        QuantityFault::NotANumber if text.contains('\u{2212}') => {
            Fault::error(FaultCode::NotANumber, span, message)
                .label("its sign is U+2212, a typographic minus sign")
                .help(format!("write {key} = \"{}\"", text.trim().replace('\u{2212}', "-")))
        }
        QuantityFault::NotANumber => Fault::error(FaultCode::NotANumber, span, message)
            .label(format!("must be {}: a finite decimal number and a unit", article(kind)))
            .help(format!("write for instance: {key} = \"5 {base}\"; units are {units}")),
        QuantityFault::NoUnit => Fault::error(FaultCode::NoUnit, span, format!("{message}, without a unit"))
            .label(format!("{} needs a unit: {units}", article(kind)))
            .help(bare_number::<Q>(key, text.trim())),
        QuantityFault::UnknownUnit(unit) => {
            let fault = Fault::error(FaultCode::UnknownUnit, span, message)
                .label(format!("{} is not a unit of {kind}: must be one of {units}", quoted(unit)));
            match meant::<Q>(text, unit) {
                Some(meant) => fault.help(format!("did you mean \"{meant}\"?")),
                None => fault,
            }
        }
    }
}

/// The whole quantity in the unit that `unit` abbreviates; `text` ends with `unit`.
fn meant<Q: Quantity>(text: &str, unit: &str) -> Option<String> {
    let number = text.trim().strip_suffix(unit)?.trim();
    if Q::KIND == Temperature::KIND && FAHRENHEIT.contains(&unit) {
        let celsius = (number.parse::<f64>().ok()? - 32.0) / 1.8;
        return Some(format!("{} C", Readable(celsius.round())));
    }
    let usual =
        SYNONYMS.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit)).map_or(unit, |(_, usual)| usual);
    let (near, _) = Q::UNITS.iter().find(|(name, _)| name.eq_ignore_ascii_case(usual))?;
    Some(format!("{number} {near}"))
}
