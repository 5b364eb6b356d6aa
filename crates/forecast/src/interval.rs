//! Intervals of numbers.

use spec::units::Length;

/// From the least to the largest value in which a computed shell's value lies in at least 95 % of cases.
pub type Interval = [f64; 2];

/// A range of lengths in mm.
pub fn mm(range: Interval) -> Interval {
    range.map(|metres| Length::from_metres(metres).0)
}

/// A range scaled by a factor of 0 or more.
pub fn scaled(range: Interval, factor: f64) -> Interval {
    range.map(|end| factor * end)
}

/// The interval that holds both.
pub fn hull([low, high]: Interval, other: Interval) -> Interval {
    [low.min(other[0]), high.max(other[1])]
}

/// Distance of `value` from the farther end of its range, by itself.
pub fn relative_error(value: f64, [low, high]: Interval) -> f64 {
    (high - value).max(value - low) / value
}

/// The sum of ranges: errors of equal stars are the same, so that ends add up; `None` if any of them is unknown.
pub fn sum(ranges: impl IntoIterator<Item = Option<Interval>>) -> Option<Interval> {
    ranges.into_iter().try_fold([0.0, 0.0], |[low, high], range| range.map(|[a, b]| [low + a, high + b]))
}
