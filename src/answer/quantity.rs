//! Numbers, quantities and ranges as arguments: finite and within their limits, or refused as wrong usage.

use spec::units::{Quantity, Readable, Stated};
use spec::{Allowed, comma};

/// Range of required lengths: 1 um to 100 m, as in a spec.
pub const SIZE: Allowed = Allowed::closed(1e-3, 1e5);
/// Lengths that may be zero, to 100 m.
pub const EXTRA: Allowed = Allowed::closed(0.0, 1e5);

/// Reads a plain number in `allowed`.
pub fn number(allowed: Allowed) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync {
    move |text| {
        let parsed = text.trim().parse::<f64>().ok();
        parsed.filter(|number| allowed.contains(*number)).ok_or_else(|| {
            let otherwise = format!("{} {}", remedy(text, "it is a number and"), allowed.in_words(""));
            match percent(text).filter(|ratio| allowed.contains(*ratio)) {
                Some(ratio) => format!("not a percentage: write {}; {otherwise}", Readable(ratio)),
                None => otherwise,
            }
        })
    }
}

/// Reads a quantity with its unit, "30 deg", in `allowed` (of the base unit).
pub fn quantity<Q: Quantity>(allowed: Allowed) -> impl Fn(&str) -> Result<Q, String> + Clone + Send + Sync {
    move |text| stated(allowed)(text).map(|stated| stated.quantity)
}

/// Reads a quantity in `allowed` (of the base unit) together with its unit.
pub fn stated<Q: Quantity>(
    allowed: Allowed,
) -> impl Fn(&str) -> Result<Stated<Q>, String> + Clone + Send + Sync {
    move |text| {
        let (base, unit) = Q::KIND.parse(text).map_err(|_| {
            let unit = format!("write the {} as a number and one of {}", Q::KIND.name, Q::KIND.unit_list());
            remedy(text, &unit)
        })?;
        Ok(Stated { quantity: in_range(allowed, Q::from_base(base))?, unit })
    }
}

fn in_range<Q: Quantity>(allowed: Allowed, quantity: Q) -> Result<Q, String> {
    let wrong = || format!("the {} {}", Q::KIND.name, allowed.in_words(Q::KIND.unit()));
    Some(quantity).filter(|quantity| allowed.contains(quantity.base())).ok_or_else(wrong)
}

/// Reads a quantity with its unit, "1.2 kg", or a bare number of its base unit, which older commands take; the base unit's number.
pub fn quantity_or_number<Q: Quantity>(
    allowed: Allowed,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync {
    let quantity = quantity::<Q>(allowed);
    move |text| match text.trim().parse::<f64>() {
        Ok(number) => in_range(allowed, Q::from_base(number)).map(Quantity::base),
        Err(_) => quantity(text).map(Quantity::base),
    }
}

/// Reads a range "FROM..TO" with both ends in `allowed`, or one quantity for a fixed value.
pub fn range<Q: Quantity>(allowed: Allowed) -> impl Fn(&str) -> Result<(Q, Q), String> + Clone + Send + Sync {
    let quantity = quantity::<Q>(allowed);
    move |text| {
        let (from, to) = text.split_once("..").unwrap_or((text, text));
        let end = |end: &str| {
            quantity(end).map_err(|why| match Q::parse(end) {
                Err(_) if from != to => {
                    format!("{why}, at each end: 20 {unit}..40 {unit}", unit = Q::KIND.unit())
                }
                _ => why,
            })
        };
        let (from, to) = (end(from)?, end(to)?);
        if from.base() <= to.base() {
            Ok((from, to))
        } else {
            Err(format!("the range is descending; write \"{to}..{from}\""))
        }
    }
}

/// The ratio of a percentage: 0.5 for "50 %"; `None` if `text` is no percentage.
fn percent(text: &str) -> Option<f64> {
    text.trim().strip_suffix('%')?.trim().parse::<f64>().ok().map(|percent| percent / 100.0)
}

/// The message `otherwise`, after one about a comma in the number.
fn remedy(text: &str, otherwise: &str) -> String {
    match comma(text) {
        Some((fault, ways)) => format!("{fault}: write {ways}; {otherwise}"),
        None => otherwise.to_owned(),
    }
}

/// Reads "FROM..TO/COUNT", or one value: evenly spaced ones, at most `most_values`; `ends` reads the first part.
///
/// # Errors
/// If it is malformed or out of range; the text describes the fault.
pub fn evenly(
    text: &str,
    most_values: u32,
    ends: impl Fn(&str) -> Result<[f64; 2], String>,
) -> Result<Vec<f64>, String> {
    let (range_text, count) = text.split_once('/').unwrap_or((text, "1"));
    let [from, to] = ends(range_text)?;
    let least_values = if from == to { 1 } else { 2 };
    let count = count.trim().parse::<u32>().ok().filter(|count| (least_values..=most_values).contains(count));
    let count = count.ok_or_else(|| {
        format!("give the number of values: write \"{range_text}/COUNT\", with a COUNT of {least_values} to {most_values}")
    })?;
    let parts = (0..count).map(|i| f64::from(i) / f64::from((count - 1).max(1)));
    Ok(parts.map(|part| from + part * (to - from)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::units::{Angle, Length, Mass};

    #[test]
    fn numbers_are_finite_and_in_their_range() {
        let ratio = number(Allowed::half_open(0.0, 1e3));
        assert_eq!(ratio(" 1.5"), Ok(1.5));
        for text in ["nan", "NaN", "inf", "-inf", "infinity", "1e999", "0", "-1", "1e4", "", "x", "1.5 kg"] {
            let message = ratio(text).expect_err(text);
            assert_eq!(message, "it is a number and must be more than 0 and at most 1000", "{text}");
        }
        assert!(ratio("50%").expect_err("a percentage").starts_with("not a percentage: write 0.5; it is"));
        assert!(ratio("1,5").expect_err("a comma").contains("write \"1.5\"; it is a number"));
    }

    #[test]
    fn quantities_are_in_their_range_whatever_their_unit() {
        // Values in and out of range are read in several units. Then come the ways to write commas: each refusal
        // suggests what was meant, if it can be told.
        let length = quantity::<Length>(EXTRA);
        assert_eq!((length("5 cm"), length("0 mm")), (Ok(Length(50.0)), Ok(Length(0.0))));
        let range_of = "the length must be at least 0 mm and at most 100000 mm";
        assert_eq!((length("-1 mm"), length("1e3 m")), (Err(range_of.to_owned()), Err(range_of.to_owned())));
        assert_eq!(length("5"), Err("write the length as a number and one of mm, cm, m, um, in".to_owned()));
        assert_eq!(
            quantity::<Length>(SIZE)("-75 mm"),
            Err("the length must be at least 0.001 mm and at most 100000 mm".to_owned())
        );
        assert!(length("nan mm").is_err() && length("5 deg").is_err());
        for (text, ways) in [
            ("1,234.5 mm", Some("write \"1234.5 mm\"; write the length")),
            (
                "1,234 mm",
                Some("write \"1234 mm\" if the comma separates thousands, else \"1.234 mm\"; write"),
            ),
            ("1,234,567 mm", Some("write \"1234567 mm\"; write")),
            ("-0,5 mm", Some("write \"-0.5 mm\"; write")),
            ("0.3,0.4 mm", None),
            ("5,,5 mm", None),
            ("5 mm, 6 mm", None),
        ] {
            let message = length(text).expect_err(text);
            match ways {
                Some(ways) => assert!(message.contains(ways), "{text}: {message}"),
                None => assert!(message.starts_with("write the length"), "{text}: {message}"),
            }
        }
        assert!(length("5,5 mm").expect_err("a comma").contains("write \"5.5 mm\""));
    }

    #[test]
    fn a_bare_number_is_one_of_the_base_unit() {
        let mass = quantity_or_number::<Mass>(Allowed::half_open(0.0, 1e6));
        assert_eq!([mass("1.2"), mass("1.2 kg"), mass("1200 g")], [Ok(1.2), Ok(1.2), Ok(1.2)]);
        assert_eq!(mass("1.2 N"), Err("write the mass as a number and one of kg, g, lb, oz".to_owned()));
        assert_eq!(mass("-1"), Err("the mass must be more than 0 kg and at most 1000000 kg".to_owned()));
        assert!(mass("nan").is_err() && mass("1,5").expect_err("a comma").contains("write \"1.5\""));
    }

    #[test]
    fn ranges_rise() {
        let angles = range::<Angle>(Allowed::open(0.0, 180.0));
        assert_eq!(angles("10 deg..1 rad").map(|(from, to)| from.0 < to.0), Ok(true));
        assert_eq!(angles("30 deg"), Ok((Angle(30.0), Angle(30.0))));
        assert_eq!(
            angles("30 deg..10 deg"),
            Err("the range is descending; write \"10 deg..30 deg\"".to_owned())
        );
        assert!(angles("0 deg..10 deg").is_err() && angles("10 deg..").is_err());
        let message = angles("20..40").expect_err("no unit");
        assert!(message.ends_with("and one of deg, rad, at each end: 20 deg..40 deg"), "{message}");
    }

    #[test]
    fn every_wrong_count_is_told_the_same() {
        let read =
            |text: &str| evenly(text, 7, |ends| Ok(if ends == "a..b" { [1.0, 2.0] } else { [1.0; 2] }));
        for text in ["a..b", "a..b/1", "a..b/0", "a..b/8", "a..b/x"] {
            let message = "give the number of values: write \"a..b/COUNT\", with a COUNT of 2 to 7";
            assert_eq!(read(text), Err(message.to_owned()), "{text}");
        }
        assert_eq!((read("a..b/2"), read("a")), (Ok(vec![1.0, 2.0]), Ok(vec![1.0])));
    }
}
