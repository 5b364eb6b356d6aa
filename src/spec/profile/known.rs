//! Values that a profile may not know.

use crate::spec::allowed::Allowed;
use crate::spec::section::Section;
use crate::spec::shape::Shape;
use crate::units::Quantity;

/// Whether `key` says the word, which stands for a number that there is not.
pub(super) fn says(s: &mut Section<'_, '_>, key: &'static str, word: &str) -> bool {
    s.take(key, Shape::Text).and_then(|value| value.as_text()) == Some(word)
}

/// A plain number, or `None` for "unknown" and for nothing at all.
pub(super) fn known_number(s: &mut Section<'_, '_>, key: &'static str, allowed: Allowed) -> Option<f64> {
    if says(s, key, "unknown") { None } else { s.number(key, allowed) }
}

/// A quantity, or `None` for "unknown" and for nothing at all.
pub(super) fn known<Q: Quantity>(s: &mut Section<'_, '_>, key: &'static str, allowed: Allowed) -> Option<Q> {
    if says(s, key, "unknown") { None } else { s.quantity(key, allowed) }
}
