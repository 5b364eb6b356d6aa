//! Values with their ranges or mesh errors as a person reads them: "12 N, 9 to 15", with as many digits as those leave.

use crate::interval::{Interval, scaled};
use spec::units::Readable;
use std::fmt::Write;

/// Adds `quantity` with its value to a page, if it has one.
pub fn line(page: &mut String, quantity: &str, value: impl Into<Option<String>>) {
    if let Some(value) = value.into() {
        // Writing to a String never fails.
        let _ = writeln!(page, "  {quantity:30}{value}");
    }
}

/// Numbers in a row: "1, 2, 3".
pub fn listed(numbers: &[usize]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// `value` with its range, both in `unit`; without a range "unknown" in place of a number.
pub fn optional_with_range(value: Option<f64>, range: Option<Interval>, unit: &str) -> String {
    match value.zip(range) {
        Some((value, range)) => with_range(value, range, unit),
        None => "unknown".to_owned(),
    }
}

/// `value` with its range, both in `unit`; without a range to three digits, and that it is unknown.
pub fn or_unknown(value: f64, range: Option<Interval>, unit: &str) -> String {
    match range {
        Some(range) => with_range(value, range, unit),
        None => format!("{} {unit}", rounded(value)).trim_end().to_owned() + ", range unknown",
    }
}

/// `value` with its range, both in `unit`.
pub fn with_range(value: f64, range: Interval, unit: &str) -> String {
    with_limit(value, range, unit, None)
}

/// `value` with its range, both in `unit`, which are judged by `limit`: both ends are printed with so many digits that each stays on
/// its side of it. The value has as many as the lower end, or as leave it between the ends.
pub fn with_limit(value: f64, [low, high]: Interval, unit: &str, limit: Option<f64>) -> String {
    let gap = if unit.is_empty() { "" } else { " " };
    if [value, low, high] == [0.0; 3] {
        return format!("0{gap}{unit}");
    }
    let rounding_step = step(high - low);
    // Ends are rounded outwards, so the printed range holds. A small low end keeps a digit: 5 to 140, not 0 to 140.
    let fine =
        if low < rounding_step && low >= 0.1 * rounding_step { 0.1 * rounding_step } else { rounding_step };
    let ends = [end(low, fine, f64::floor, limit), end(high, rounding_step, f64::ceil, limit)];
    let [low, high] = ends.map(|(end, rounding_step)| text(end, rounding_step));
    let step_of_value = step_of(value, fine);
    let keeps_inside = |rounding_step: &f64| {
        let (value, slack) = ((value / rounding_step).round() * rounding_step, 1e-6 * rounding_step);
        ends[0].0 <= value + slack && value <= ends[1].0 + slack
    };
    let step_of_value = finer(step_of_value).find(keeps_inside).unwrap_or(step_of_value);
    format!("{}{gap}{unit}, {low} to {high}", text(value, step_of_value))
}

/// A payload with its range, which is judged by the mass `limit`, all kg: in g where the upper end is below `HEAVY`.
pub fn payload(kg: f64, range: Interval, limit: Option<f64>) -> String {
    if range[1] < HEAVY {
        return with_limit(1e3 * kg, scaled(range, 1e3), "g", limit.map(|kg| 1e3 * kg));
    }
    with_limit(kg, range, "kg", limit)
}

/// Payloads below this are read in g, kg.
const HEAVY: f64 = 0.1;

/// The end `x` of a range, rounded by `round` to `step`, or to a finer one that leaves it on its side of `limit`; and that step.
fn end(x: f64, step: f64, round: fn(f64) -> f64, limit: Option<f64>) -> (f64, f64) {
    let is_kept = |(end, _): &(f64, f64)| {
        limit.is_none_or(|limit| (*end < limit, *end > limit) == (x < limit, x > limit))
    };
    let mut ends = finer(step).map(|step| (round(x / step) * step, step));
    // An end within a millionth of a step of the limit is printed as any other.
    ends.find(is_kept).unwrap_or((round(x / step) * step, step))
}

/// `step`, and up to six digits more.
fn finer(step: f64) -> impl Iterator<Item = f64> {
    (0..=6).map(move |digits| step * 0.1_f64.powi(digits))
}

/// Two numbers with as many decimals as tell them apart from each other and from 0, one at least.
pub fn distinct(a: f64, b: f64) -> [String; 2] {
    let differ = |texts: &[String; 2]| {
        texts[0] != texts[1] && texts.iter().zip([a, b]).all(|(text, number)| number == 0.0 || !is_zero(text))
    };
    let mut texts = (1..9).map(|decimals| [a, b].map(|number| format!("{number:.decimals$}")));
    texts.find(differ).unwrap_or_else(|| [a, b].map(|number| format!("{number:.6}")))
}

/// Whether all digits of a printed number are 0.
fn is_zero(text: &str) -> bool {
    text.chars().all(|c| !c.is_ascii_digit() || c == '0')
}

/// `value` with as many decimals as tell it from both ends of a range, one at least.
pub fn apart_from(value: f64, range: Interval) -> String {
    let [low, high] = range.map(|end| distinct(value, end)).map(|[text, _]| text);
    if high.len() > low.len() { high } else { low }
}

/// `value` in `unit`, as exact as a number with this range is.
pub fn as_exact_as(value: f64, [low, high]: Interval, unit: &str) -> String {
    format!("{} {unit}", text(value, step_of(value, step(high - low))))
}

/// The step to which a value with a range of `step` is rounded: 140 with a range of 500 keeps a digit more, so it is not 100.
fn step_of(value: f64, step: f64) -> f64 {
    if (0.5..1.6).contains(&(value.abs() / step)) { 0.1 * step } else { step }
}

/// `value` with its mesh error, both in `unit`.
pub fn meshed(value: f64, error: f64, unit: &str) -> String {
    let step = decade(error);
    let gap = if unit.is_empty() { "" } else { " " };
    // Rounded up, so the printed error is an upper bound.
    let open = text((error / step).ceil() * step, step);
    format!("{}{gap}{unit}, mesh error {open}", text(value, step))
}

/// `value` to three significant digits, without an exponent: as many as a person compares, and more than any prediction is good for.
pub fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return Readable(value).to_string();
    }
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is below 400")]
    let exponent = libm::log10(value.abs()).floor() as i32;
    let scale = 10_f64.powi((2 - exponent).clamp(-300, 300));
    Readable((value * scale).round() / scale).to_string()
}

/// The power of ten of the first digit of `x`.
fn decade(x: f64) -> f64 {
    if x > 0.0 && x.is_finite() { libm::pow(10_f64, libm::log10(x).floor()) } else { 1e-3 }
}

/// The decade that divides a range of this width into five to fifty parts.
fn step(width: f64) -> f64 {
    decade(0.2 * width)
}

fn text(number: f64, step: f64) -> String {
    let rounded = (number / step).round() * step;
    if step >= 1.0 {
        return Readable(rounded).to_string();
    }
    let mut decimals = 0;
    let mut unit = 1.0;
    while unit > 1.5 * step && decimals < 9 {
        unit *= 0.1;
        decimals += 1;
    }
    let digits = format!("{rounded:.decimals$}");
    if digits.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        digits.trim_start_matches('-').to_owned()
    } else {
        digits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_match_the_range() {
        assert_eq!(with_range(12.345, [9.4, 14.6], "N"), "12 N, 9 to 15");
        assert_eq!(with_range(17.3546, [16.91, 17.62], "mm"), "17.4 mm, 16.9 to 17.7");
        assert_eq!(with_range(1234.5, [1012.0, 1450.0], "N/m"), "1230 N/m, 1010 to 1450");
        assert_eq!(with_range(0.061, [0.0512, 0.0723], "kg"), "0.061 kg, 0.051 to 0.073");
        assert_eq!(with_range(0.0, [-0.001, 0.001], ""), "0.0000, -0.0010 to 0.0010");
        assert_eq!(with_range(0.0, [0.0, 0.0], "N"), "0 N");
        assert_eq!(with_range(18.2, [5.3, 131.0], "N"), "18 N, 5 to 140");
        assert_eq!(with_range(0.037, [0.0234, 0.81], "kg"), "0.04 kg, 0.02 to 0.9");
        assert_eq!(with_limit(24.0, [23.16, 96.5], "kPa", Some(23.0)), "24 kPa, 23.1 to 100");
        assert_eq!(with_range(18.2, [0.03, 131.0], "N"), "20 N, 0 to 140");
    }

    #[test]
    fn ends_stay_on_their_side_of_the_limit() {
        let range_text = |limit: f64| with_limit(40.0, [15.33, 96.5], "kPa", Some(limit));
        assert_eq!(with_range(40.0, [15.33, 96.5], "kPa"), "40 kPa, 10 to 100");
        assert_eq!(range_text(15.0), "40 kPa, 15.3 to 100");
        assert_eq!(range_text(15.4), "40 kPa, 10 to 100");
        assert_eq!(range_text(97.0), "40 kPa, 10 to 96.5");
        assert_eq!(range_text(96.0), "40 kPa, 10 to 100");
        assert_eq!(with_limit(1.6, [0.0043, 3.4], "N", Some(0.0)), "1.6 N, 0.004 to 3.4");
        assert_eq!(with_limit(1.6, [0.0, 3.4], "N", Some(0.0)), "1.6 N, 0.0 to 3.4");
        for k in 1..500 {
            let (low, width) = (0.037 * f64::from(k), 0.011 * f64::from(k % 17 + 1));
            let high = low + width;
            for part in [-0.3, -1e-3, 1e-3, 0.5, 0.999, 1.001, 1.3] {
                let limit = low + part * width;
                let range_text = with_limit(low, [low, high], "", Some(limit));
                let ends: Vec<f64> =
                    range_text.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
                assert_eq!(
                    [ends[1] < limit, ends[2] < limit],
                    [low < limit, high < limit],
                    "{range_text}: {limit}"
                );
                assert!(ends[1] <= low + 1e-9 && ends[2] >= high - 1e-9, "{range_text}: {low} {width}");
            }
        }
    }

    #[test]
    fn numbers_that_differ_are_printed_so() {
        assert_eq!(distinct(7.7, 8.1), ["7.7", "8.1"]);
        assert_eq!(distinct(7.712, 7.7041), ["7.71", "7.70"]);
        // The force that 0.3 g need is not "0.0 N".
        assert_eq!(distinct(0.0098, 0.1), ["0.01", "0.10"]);
        assert_eq!(distinct(0.0, 0.1), ["0.0", "0.1"]);
    }

    #[test]
    fn digits_match_the_mesh_error() {
        assert_eq!(meshed(18.18, 7.44, "N"), "18 N, mesh error 8");
        assert_eq!(meshed(17.3546, 0.4, "mm"), "17.4 mm, mesh error 0.4");
        assert_eq!(meshed(212_345.6, 31.0, "mm^3"), "212350 mm^3, mesh error 40");
        assert_eq!(meshed(1.01234, 0.0008, ""), "1.0123, mesh error 0.0008");
        assert_eq!(meshed(0.0, 0.0, "N"), "0.000 N, mesh error 0.000");
        assert_eq!(as_exact_as(47.2345, [15.4, 25.4], "mm"), "47 mm");
    }

    #[test]
    fn what_is_not_known_has_no_number() {
        assert_eq!(optional_with_range(Some(3.0), None, "N"), "unknown");
        assert_eq!(optional_with_range(None, Some([1.0, 2.0]), "N"), "unknown");
    }

    #[test]
    fn the_ends_that_are_printed_hold() {
        for k in 1..500 {
            let (low, width) = (0.037 * f64::from(k), 0.011 * f64::from(k % 17 + 1));
            let range_text = with_range(low, [low, low + width], "");
            let ends: Vec<f64> = range_text.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
            assert!(ends[1] <= low + 1e-9 && ends[2] >= low + width - 1e-9, "{range_text}: {low} {width}");
        }
    }

    #[test]
    fn three_digits_are_left_and_none_is_invented() {
        for (value, text) in [
            (15.823_01, "15.8"),
            (1.452_15, "1.45"),
            (0.052_961_5, "0.053"),
            (2941.15, "2940"),
            (0.999_6, "1"),
            (50.0, "50"),
            (-13.37, "-13.4"),
            (0.0, "0"),
            (1e-9, "0.000000001"),
        ] {
            assert_eq!(rounded(value), text);
        }
    }
}
