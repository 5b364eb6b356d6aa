//! Physical quantities: a number with a unit, as a person writes it in a spec.
//!
//! Each quantity is a type around one `f64` in a fixed unit; its table lists every unit it can be
//! written in. A quantity is written as a decimal number, optional blanks, and a unit: `50 mm`,
//! `0.3mm`, `1.5e-1 mm`. The first unit in a table is the one it is printed in.

use std::fmt;

/// Why a text is not a quantity of the wanted kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum QuantityFault {
    /// The text does not begin with a finite decimal number.
    NotANumber,
    /// The number is there, the unit is not.
    NoUnit,
    /// The unit is none of this quantity's.
    UnknownUnit(String),
}

/// A physical quantity that a spec can state.
pub trait Quantity: Copy + fmt::Display {
    /// What it measures, for messages: "length".
    const KIND: &'static str;
    /// Units in which it can be written, with the factor to the base unit; the first is the base.
    const UNITS: &'static [(&'static str, f64)];
    /// Wraps a value in the base unit.
    fn from_base(value: f64) -> Self;
    /// The value in the base unit.
    fn base(self) -> f64;

    /// Reads `text`.
    ///
    /// # Errors
    /// If it is not a finite decimal number followed by one of [`Quantity::UNITS`].
    fn parse(text: &str) -> Result<Self, QuantityFault> {
        let (value, unit) = split_number(text).ok_or(QuantityFault::NotANumber)?;
        if unit.is_empty() {
            return Err(QuantityFault::NoUnit);
        }
        let (_, factor) = Self::UNITS
            .iter()
            .find(|(name, _)| *name == unit)
            .ok_or_else(|| QuantityFault::UnknownUnit(unit.to_owned()))?;
        let base = value * factor;
        if base.is_finite() { Ok(Self::from_base(base)) } else { Err(QuantityFault::NotANumber) }
    }

    /// The units as a list for messages: "mm, cm, m". Those with a letter that not every keyboard has, which
    /// always have another spelling, are left out.
    fn unit_list() -> String {
        Self::UNITS
            .iter()
            .map(|(name, _)| *name)
            .filter(|name| name.is_ascii())
            .collect::<Vec<_>>()
            .join(", ")
    }
}

/// Splits `text` into its leading finite decimal number and the trimmed rest; `None` if there is no such number.
fn split_number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut end = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits(end);
    end += whole;
    let mut decimals = 0;
    if bytes.get(end) == Some(&b'.') {
        decimals = digits(end + 1);
        end += 1 + decimals;
    }
    if whole + decimals == 0 {
        return None;
    }
    // An exponent counts as one only if digits follow: "2e" would otherwise swallow a unit's first letter.
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits((end + 1 + sign).min(bytes.len()));
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    let value: f64 = text[..end].parse().ok()?;
    value.is_finite().then(|| (value, text[end..].trim()))
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident($kind:literal): $($unit:literal = $factor:expr),+;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
        pub struct $name(pub f64);

        impl Quantity for $name {
            const KIND: &'static str = $kind;
            const UNITS: &'static [(&'static str, f64)] = &[$(($unit, $factor)),+];
            fn from_base(value: f64) -> Self { Self(value) }
            fn base(self) -> f64 { self.0 }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{} {}", Readable(self.0), Self::UNITS[0].0)
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
    /// A mass per area; the field is kg/m^2.
    ArealDensity("mass per area"): "kg/m^2" = 1.0, "g/m^2" = 1e-3;
    /// A ratio written in per cent; the field is the percentage, 10 for a tenth.
    Percent("percentage"): "%" = 1.0;
    /// A duration; the field is s.
    Duration("duration"): "s" = 1.0, "ms" = 1e-3, "min" = 60.0, "h" = 3600.0;
}

impl Angle {
    /// The angle in rad.
    pub fn rad(self) -> f64 {
        self.0.to_radians()
    }
}

impl Percent {
    /// The plain ratio, 0.1 for 10 %.
    pub fn ratio(self) -> f64 {
        self.0 / 100.0
    }
}

/// Prints a number for people: at most six significant digits, no trailing zeros, no exponent.
pub struct Readable(pub f64);

impl fmt::Display for Readable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x = self.0;
        if x == 0.0 || !x.is_finite() {
            return write!(f, "{}", if x == 0.0 { 0.0 } else { x });
        }
        #[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is below 400")]
        let exponent = x.abs().log10().floor() as i32;
        let decimals = usize::try_from(5 - exponent).unwrap_or(0);
        let text = format!("{x:.decimals$}");
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        f.write_str(if text == "-0" { "0" } else { text })
    }
}
