//! The wording of faults in single values.

use crate::FaultCode;
use std::ops::Range;

use crate::fault::{Fault, quoted};
use crate::units::{Percent, Pressure, Quantity, QuantityFault, QuantityKind, Readable, Temperature};

/// A section's name as its header is written.
pub(super) fn header(name: &str) -> String {
    match name {
        "process" => "[process.NAME]".to_owned(),
        name if name.contains('.') => format!("[[{name}]]"),
        name => format!("[{name}]"),
    }
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

/// A number or quantity with a comma in its number: the fault, and how to write it, quoted; `None` if the text is no such number.
pub fn comma(text: &str) -> Option<(&'static str, String)> {
    let text = text.trim();
    let unsigned = text.trim_start_matches(['+', '-']);
    let end = unsigned.find(|c: char| !c.is_ascii_digit() && c != ',' && c != '.').unwrap_or(unsigned.len());
    let (integer, rest) = unsigned[..end].split_once(',')?;
    let (groups, decimals) = rest.split_once('.').map_or((rest, None), |(groups, rest)| (groups, Some(rest)));
    let groups: Vec<&str> = groups.split(',').collect();
    if !are_digits(integer)
        || !groups.iter().all(|group| are_digits(group))
        || decimals.is_some_and(|rest| rest.contains(','))
    {
        return None;
    }
    let [point, joined] = [".", ""].map(|mark| format!("\"{}\"", text.replace(',', mark)));
    let is_decimal = groups.len() == 1 && decimals.is_none();
    match (groups.iter().all(|group| group.len() == 3), is_decimal) {
        (true, true) => Some((
            "a number has no comma",
            format!("{joined} if the comma separates thousands, else {point}"),
        )),
        (true, false) => Some(("thousands have no comma", joined)),
        (false, true) => Some(("a decimal point is needed, not a comma", point)),
        (false, false) => None,
    }
}

fn are_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// The unit that a person most likely intends for `key`: for an elastic modulus the usual unit for fabrics, else the base unit.
fn usual_unit(kind: QuantityKind, key: &str) -> &'static str {
    let is_modulus = kind == Pressure::KIND && key.ends_with("modulus");
    if is_modulus { "MPa" } else { kind.unit() }
}

/// The remedy for the bare `number` of `key`. One up to 1 may be a share of one or a number of per cent.
pub(super) fn bare_number(kind: QuantityKind, key: &str, number: &str) -> String {
    let unit = usual_unit(kind, key);
    match number.parse::<f64>() {
        Ok(share) if kind == Percent::KIND && share > 0.0 && share <= 1.0 => {
            format!(
                "write {key} = \"{} {unit}\" for a share of {number}, or \"{number} {unit}\"",
                Readable(100.0 * share)
            )
        }
        _ => format!("write for instance: {key} = \"{number} {unit}\""),
    }
}

/// The fault of a text that should be a quantity.
///
/// A comma or a typographic minus explains the text better than the parser's reason, so both are looked for first. The
/// remedy is the text as it was probably meant.
pub(super) fn malformed(
    kind: QuantityKind,
    key: &str,
    text: &str,
    reason: &QuantityFault,
    span: Range<usize>,
) -> Fault {
    let (name, units, a_quantity) = (kind.name, kind.unit_list(), article(kind.name));
    let mut message = format!("`{key}` is {}", quoted(text));
    let (code, label, help) = match (comma(text), reason) {
        (Some((label, help)), _) => {
            (FaultCode::NotANumber, label.to_owned(), Some(format!("write {key} = {help}")))
        }
        (_, QuantityFault::NotANumber) if text.contains('\u{2212}') => (
            FaultCode::NotANumber,
            "its sign is U+2212, a typographic minus sign".to_owned(),
            Some(format!("write {key} = \"{}\"", text.trim().replace('\u{2212}', "-"))),
        ),
        (_, QuantityFault::NotANumber) => (
            FaultCode::NotANumber,
            format!("must be {a_quantity}: a finite decimal number and a unit"),
            Some(format!("write for instance: {key} = \"5 {}\"; units are {units}", usual_unit(kind, key))),
        ),
        (_, QuantityFault::NoUnit) => {
            message.push_str(", without a unit");
            let label = format!("{a_quantity} needs a unit: {units}");
            (FaultCode::NoUnit, label, Some(bare_number(kind, key, text.trim())))
        }
        (_, QuantityFault::UnknownUnit(unit)) => (
            FaultCode::UnknownUnit,
            format!("{} is not a unit of {name}: must be one of {units}", quoted(unit)),
            corrected(kind, text, unit).map(|meant| format!("did you mean \"{meant}\"?")),
        ),
    };
    Fault { help, ..Fault::error(code, span, message).label(label) }
}

/// The whole quantity in the unit that `unit` abbreviates; `text` ends with `unit`.
fn corrected(kind: QuantityKind, text: &str, unit: &str) -> Option<String> {
    let number = text.trim().strip_suffix(unit)?.trim();
    if kind == Temperature::KIND && FAHRENHEIT.contains(&unit) {
        let celsius = (number.parse::<f64>().ok()? - 32.0) / 1.8;
        return Some(format!("{} C", Readable(celsius.round())));
    }
    let usual =
        SYNONYMS.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit)).map_or(unit, |(_, usual)| usual);
    let (name, _) = kind.units.iter().find(|(name, _)| name.eq_ignore_ascii_case(usual))?;
    Some(format!("{number} {name}"))
}
