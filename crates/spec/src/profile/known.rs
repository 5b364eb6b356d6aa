//! Values that a profile may leave unknown.

use crate::allowed::Allowed;
use crate::section::Section;
use crate::shape::ValueShape;
use crate::units::Quantity;

/// The word for an unknown value.
const UNKNOWN: &str = "unknown";

/// A plain number, or `None` for "unknown" and for nothing at all.
pub(super) fn known_number(s: &mut Section<'_, '_>, key: &'static str, allowed: Allowed) -> Option<f64> {
    known_as(s, key, |s| s.number(key, allowed))
}

/// A quantity, or `None` for "unknown" and for nothing at all.
pub(super) fn quantity_or_unknown<Q: Quantity>(
    s: &mut Section<'_, '_>,
    key: &'static str,
    allowed: Allowed,
) -> Option<Q> {
    known_as(s, key, |s| s.quantity(key, allowed))
}

/// The value that `read` takes of `key`, or `None` if the value is "unknown".
pub(super) fn known_as<T>(
    s: &mut Section<'_, '_>,
    key: &'static str,
    read: impl FnOnce(&mut Section<'_, '_>) -> Option<T>,
) -> Option<T> {
    unless(s, key, UNKNOWN, read).flatten()
}

/// What `read` takes of `key`, or `None` if the value is `word`, which replaces a number.
pub(super) fn unless<T>(
    s: &mut Section<'_, '_>,
    key: &'static str,
    word: &'static str,
    read: impl FnOnce(&mut Section<'_, '_>) -> T,
) -> Option<T> {
    if s.take(key, ValueShape::Text).and_then(|value| value.as_text()) == Some(word) {
        return None;
    }
    let value = read(s);
    s.or_word(key, word);
    Some(value)
}
