//! Physical quantities: a number with a unit, as written in a spec.
//!
//! Each quantity is a type around one `f64` in a fixed unit; its table lists every unit it can be
//! written in. A quantity is written as a decimal number, optional blanks, and a unit: `50 mm`,
//! `0.3mm`, `1.5e-1 mm`. The first unit in a table is the one it is printed in.

mod limits;
mod si;

use std::fmt;

pub use geom::readable::Readable;
pub use limits::{Least, Most, hundredths_down, tenths_down, tenths_up};

/// A number of things: "1 finding", "91 findings".
pub fn count_text(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

/// The reason why a text is not a quantity of the required kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum QuantityFault {
    /// The text does not begin with a finite decimal number.
    NotANumber,
    /// The unit is missing.
    NoUnit,
    /// The unit is not one of this quantity.
    UnknownUnit(String),
}

/// A kind of quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuantityKind {
    /// The quantity in messages: "length".
    pub name: &'static str,
    /// Units in which it can be written, at least one, with the factor to the base unit; the first is the base.
    pub units: &'static [(&'static str, f64)],
    /// The unit in which less than a tenth of the base unit is printed, if it is another one.
    pub small: Option<&'static str>,
}

impl QuantityKind {
    /// The unit in which it is printed.
    pub fn unit(self) -> &'static str {
        self.units[0].0
    }

    /// The number of `text` in the base unit, and the unit in which it is written.
    ///
    /// # Errors
    /// If it is not a finite decimal number followed by one of the units.
    pub fn parse(self, text: &str) -> Result<(f64, &'static str), QuantityFault> {
        let (value, unit) = split_number(text).ok_or(QuantityFault::NotANumber)?;
        if unit.is_empty() {
            return Err(QuantityFault::NoUnit);
        }
        let entry = self.units.iter().find(|(name, _)| *name == unit);
        let (unit, factor) = entry.ok_or_else(|| QuantityFault::UnknownUnit(unit.to_owned()))?;
        let base = Some(value * factor).filter(|base| base.is_finite()).ok_or(QuantityFault::NotANumber)?;
        Ok((base, unit))
    }

    /// The size of the unit `name` in the base unit; 1 of none and of an unknown one.
    fn factor(self, name: Option<&str>) -> f64 {
        let unit = self.units.iter().find(|(unit, _)| Some(*unit) == name);
        unit.map_or(1.0, |(_, factor)| *factor)
    }

    /// `value`, in the base unit, as it is printed.
    fn rounded_text(self, value: f64) -> String {
        let unit = self.small.filter(|_| value != 0.0 && libm::fabs(value) < 0.1);
        format!("{} {}", Readable(value / self.factor(unit)), unit.unwrap_or(self.unit()))
    }

    /// The units as a list for messages: "mm, cm, m". Units with a letter that is missing on some keyboards are left out; they always have
    /// another spelling.
    pub fn unit_list(self) -> String {
        let names = self.units.iter().map(|(name, _)| *name).filter(|name| name.is_ascii());
        names.collect::<Vec<_>>().join(", ")
    }
}

/// A physical quantity that a spec can state.
pub trait Quantity: Copy + fmt::Display {
    /// The name and the units of the quantity.
    const KIND: QuantityKind;
    /// Wraps a value in the base unit.
    fn from_base(value: f64) -> Self;
    /// The value in the base unit.
    fn base(self) -> f64;

    /// Reads `text`.
    ///
    /// # Errors
    /// As for [`QuantityKind::parse`].
    fn parse(text: &str) -> Result<Self, QuantityFault> {
        Self::KIND.parse(text).map(|(base, _)| Self::from_base(base))
    }
}

/// The size of the unit `name` of a quantity in its base unit; 1 of none.
pub fn factor<Q: Quantity>(name: Option<&str>) -> f64 {
    Q::KIND.factor(name)
}

/// `quantity` in the unit `name`; of none as it is usually printed.
pub fn in_unit<Q: Quantity>(quantity: Q, name: Option<&str>) -> String {
    name.map_or_else(
        || quantity.to_string(),
        |name| format!("{} {name}", Readable(quantity.base() / factor::<Q>(Some(name)))),
    )
}

/// A quantity with the unit in which it was stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stated<Q> {
    /// The quantity.
    pub quantity: Q,
    /// The name of the unit.
    pub unit: &'static str,
}

impl<Q: Quantity> fmt::Display for Stated<Q> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&in_unit(self.quantity, Some(self.unit)))
    }
}

/// Splits `text` into its leading finite decimal number and the trimmed rest; `None` if there is no such number.
fn split_number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let bytes = text.as_bytes();
    let mut end = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let digits_before = digit_count(&bytes[end..]);
    end += digits_before;
    let mut decimals = 0;
    if bytes.get(end) == Some(&b'.') {
        decimals = digit_count(&bytes[end + 1..]);
        end += 1 + decimals;
    }
    if digits_before + decimals == 0 {
        return None;
    }
    // An exponent counts as one only if digits follow: "2e" would otherwise swallow a unit's first letter.
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digit_count(&bytes[(end + 1 + sign).min(bytes.len())..]);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    let value: f64 = text[..end].parse().ok()?;
    value.is_finite().then(|| (value, text[end..].trim()))
}

/// The number of digits with which `bytes` begin.
fn digit_count(bytes: &[u8]) -> usize {
    bytes.iter().take_while(|byte| byte.is_ascii_digit()).count()
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident($kind:literal $(, small $small:literal)?): $($unit:literal = $factor:expr),+;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
        pub struct $name(pub f64);

        impl Quantity for $name {
            const KIND: QuantityKind = QuantityKind {
                name: $kind,
                units: &[$(($unit, $factor)),+],
                small: [$(Some($small),)? None][0],
            };
            fn from_base(value: f64) -> Self { Self(value) }
            fn base(self) -> f64 { self.0 }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&Self::KIND.rounded_text(self.0))
            }
        }
    )+};
}

quantities! {
    /// A length; the field is mm.
    Length("length"): "mm" = 1.0, "cm" = 10.0, "m" = 1000.0, "um" = 1e-3, "µm" = 1e-3, "μm" = 1e-3, "in" = 25.4;
    /// An angle; the field is degrees, so that "30 deg" is kept exactly.
    Angle("angle"): "deg" = 1.0, "rad" = 180.0 / std::f64::consts::PI;
    /// A pressure or an elastic modulus; the field is kPa.
    Pressure("pressure"): "kPa" = 1.0, "Pa" = 1e-3, "MPa" = 1e3, "GPa" = 1e6, "bar" = 100.0, "mbar" = 0.1, "psi" = 6.894_757_293_168_361;
    /// A temperature; the field is degrees Celsius.
    Temperature("temperature"): "C" = 1.0, "degC" = 1.0, "°C" = 1.0;
    /// A speed; the field is mm/s.
    Speed("speed"): "mm/s" = 1.0, "mm/min" = 1.0 / 60.0, "m/s" = 1000.0, "m/min" = 1000.0 / 60.0, "cm/s" = 10.0;
    /// An acceleration; the field is mm/s^2.
    Acceleration("acceleration"): "mm/s^2" = 1.0, "m/s^2" = 1000.0;
    /// A force per length (the strength of a seal); the field is N/mm.
    LineForce("force per length"): "N/mm" = 1.0, "N/m" = 1e-3, "N/cm" = 0.1, "N/15mm" = 1.0 / 15.0, "N/25mm" = 1.0 / 25.0;
    /// A bending stiffness: moment by length over curvature; the field is N mm.
    BendingStiffness("bending stiffness"): "N mm" = 1.0, "N m" = 1e3, "mN m" = 1.0, "uN m" = 1e-3;
    /// A mass; the field is kg.
    Mass("mass", small "g"): "kg" = 1.0, "g" = 1e-3, "lb" = 0.453_592_37, "oz" = 0.028_349_523_125;
    /// A force; the field is N.
    Force("force", small "mN"): "N" = 1.0, "mN" = 1e-3, "kN" = 1e3;
    /// A mass per area; the field is kg/m^2.
    ArealDensity("mass per area"): "kg/m^2" = 1.0, "g/m^2" = 1e-3;
    /// A ratio written in per cent; the field is the percentage, 10 for a tenth.
    Percent("percentage"): "%" = 1.0;
    /// A duration; the field is s.
    Duration("duration"): "s" = 1.0, "ms" = 1e-3, "min" = 60.0, "h" = 3600.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-12 * b.abs()
    }

    #[test]
    fn every_unit_has_its_size() {
        let lengths = [
            ("1 mm", 1.0),
            ("1 cm", 10.0),
            ("1 m", 1e3),
            ("1 um", 1e-3),
            ("1 µm", 1e-3),
            ("1 μm", 1e-3),
            ("1 in", 25.4),
        ];
        for (text, mm) in lengths {
            assert!(close(Length::parse(text).expect(text).0, mm), "{text}");
        }
        assert_eq!(Angle::parse("30 deg"), Ok(Angle(30.0)));
        assert!(close(Angle::parse("0.5235987755982988 rad").expect("rad").0, 30.0));
        assert!(close(Angle(180.0).rad(), std::f64::consts::PI));
        let pressures = [
            ("1 kPa", 1.0),
            ("1000 Pa", 1.0),
            ("1 MPa", 1e3),
            ("1 GPa", 1e6),
            ("0.37 bar", 37.0),
            ("370 mbar", 37.0),
            ("1 psi", 6.894_757_293_168_361),
        ];
        for (text, kpa) in pressures {
            assert!(close(Pressure::parse(text).expect(text).0, kpa), "{text}");
        }
        for text in ["200 C", "200 degC", "200 °C"] {
            assert_eq!(Temperature::parse(text), Ok(Temperature(200.0)));
        }
        for text in ["0.1 mm/s", "6 mm/min", "0.0001 m/s", "0.006 m/min", "0.01 cm/s"] {
            assert!(close(Speed::parse(text).expect(text).0, 0.1), "{text}");
        }
        assert_eq!(Acceleration::parse("0.5 m/s^2"), Ok(Acceleration(500.0)));
        for text in ["1.2 N/mm", "1200 N/m", "12 N/cm", "18 N/15mm", "30 N/25mm"] {
            assert!(close(LineForce::parse(text).expect(text).0, 1.2), "{text}");
        }
        assert!(close(ArealDensity::parse("300 g/m^2").expect("g/m^2").0, 0.3));
        assert_eq!(Percent::parse("5 %").map(Percent::ratio), Ok(0.05));
        for text in ["1 h", "60 min", "3600 s", "3600000 ms"] {
            assert!(close(Duration::parse(text).expect(text).0, 3600.0), "{text}");
        }
    }

    #[test]
    fn numbers_and_blanks_may_be_written_as_people_do() {
        let five = [
            "5mm",
            " 5  mm ",
            "5\tmm",
            "+5 mm",
            "5. mm",
            "5.0mm",
            "05 mm",
            "50e-1 mm",
            ".5e1 mm",
            "5E0mm",
            "5\u{a0}mm",
        ];
        for text in five {
            assert_eq!(Length::parse(text), Ok(Length(5.0)), "{text}");
        }
        assert_eq!(Length::parse("-.3mm"), Ok(Length(-0.3)));
    }

    #[test]
    fn what_is_no_number_is_said_to_be_none() {
        for text in [
            "", " ", "mm", "nan mm", "inf mm", "-inf mm", "1e999 mm", "1e308 m", ".", "+", "-", "e5 mm",
            ".e1 mm", "½ mm", "५ mm",
        ] {
            assert_eq!(Length::parse(text), Err(QuantityFault::NotANumber), "{text}");
        }
    }

    #[test]
    fn what_is_no_unit_is_said_to_be_none() {
        assert_eq!(Length::parse("5"), Err(QuantityFault::NoUnit));
        assert_eq!(Length::parse("5 "), Err(QuantityFault::NoUnit));
        let faulty = [
            ("5e", "e"),
            ("5e+", "e+"),
            ("5e mm", "e mm"),
            ("0x10 mm", "x10 mm"),
            ("5 MM", "MM"),
            ("5 mm mm", "mm mm"),
            ("5 m\u{308}m", "m\u{308}m"),
            ("5,3 mm", ",3 mm"),
            ("5 5 mm", "5 mm"),
            ("1_000 mm", "_000 mm"),
            ("5 kPa", "kPa"),
        ];
        for (text, unit) in faulty {
            assert_eq!(Length::parse(text), Err(QuantityFault::UnknownUnit(unit.to_owned())), "{text}");
        }
    }

    #[test]
    fn units_are_listed_as_a_keyboard_writes_them() {
        assert_eq!(Length::KIND.unit_list(), "mm, cm, m, um, in");
        assert_eq!(Temperature::KIND.unit_list(), "C, degC");
    }

    #[test]
    fn numbers_print_as_people_read_them() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (0.3, "0.3"),
            (-6.2, "-6.2"),
            (0.1 + 0.2, "0.3"),
            (100_000.0, "100000"),
            (123_456_789.0, "123456789"),
            (1.0 / 3.0, "0.333333"),
            (999_999.7, "1000000"),
            (0.0001, "0.0001"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ];
        for (x, text) in cases {
            assert_eq!(Readable(x).to_string(), text);
        }
        assert_eq!(Length(-0.3).to_string(), "-0.3 mm");
    }

    proptest::proptest! {
        #[test]
        fn no_text_makes_parsing_panic(text in "\\PC{0,20}") {
            if let Ok(length) = Length::parse(&text) {
                proptest::prop_assert!(length.0.is_finite());
            }
        }

        #[test]
        fn what_is_printed_reads_back_to_six_digits(mm in -1e5..1e5_f64) {
            let back = Length::parse(&Length(mm).to_string()).expect("printed");
            proptest::prop_assert!((back.0 - mm).abs() <= 1e-5 * mm.abs());
        }
    }
}
