//! Vectors of any length.

/// The sum of the products of their entries, first to last.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `number` in single precision, for numbers that are less precise.
#[expect(clippy::cast_possible_truncation, reason = "the caller knows that the digits are not needed")]
pub(crate) const fn single(number: f64) -> f32 {
    number as f32
}
