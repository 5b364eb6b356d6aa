//! The wording of what is wrong with single values.

use crate::spec::FaultCode;
use std::ops::Range;

use crate::spec::fault::{Fault, quoted};
use crate::spec::value::{RawNumber, RawValue};
use crate::units::{Quantity, QuantityFault};

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

/// A text that should be a quantity and is none.
pub(super) fn malformed<Q: Quantity>(
    key: &str,
    text: &str,
    reason: &QuantityFault,
    span: Range<usize>,
) -> Fault {
    let (kind, units, base) = (Q::KIND, Q::unit_list(), Q::UNITS[0].0);
    let message = format!("`{key}` is {}", quoted(text));
    match reason {
        QuantityFault::NotANumber => Fault::error(FaultCode::NotANumber, span, message)
            .label(format!("must be {}: a finite decimal number and a unit", article(kind)))
            .help(format!("write for instance: {key} = \"5 {base}\"; units are {units}")),
        QuantityFault::NoUnit => Fault::error(FaultCode::NoUnit, span, format!("{message}, without a unit"))
            .label(format!("{} needs a unit: {units}", article(kind)))
            .help(format!("write for instance: {key} = \"{} {base}\"", text.trim())),
        QuantityFault::UnknownUnit(unit) => {
            let fault = Fault::error(FaultCode::UnknownUnit, span, message)
                .label(format!("{} is no unit of {kind}: must be one of {units}", quoted(unit)));
            match Q::UNITS.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit)) {
                Some((near, _)) => fault.help(format!("did you mean `{near}`?")),
                None => fault,
            }
        }
    }
}
