//! Quantities and ranges of quantities as arguments.

use crate::units::Quantity;

/// A quantity with its unit: "30 deg".
pub(super) fn quantity<Q: Quantity>(text: &str) -> Result<Q, String> {
    Q::parse(text).map_err(|_| format!("write a number and one of {}", Q::unit_list()))
}

/// A range "FROM..TO", or one quantity for a fixed value.
pub(super) fn range<Q: Quantity>(text: &str) -> Result<(Q, Q), String> {
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let (from, to) = (quantity::<Q>(from)?, quantity::<Q>(to)?);
    if from.base() <= to.base() { Ok((from, to)) } else { Err("the range falls".to_owned()) }
}
