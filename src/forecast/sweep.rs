//! Many designs: every combination of values along some axes, one CSV row each.
//!
//! Rows are numbered; row i is the same whoever computes it, so a sweep can be cut into parts and run in any number of threads.

use crate::forecast::candidate::{Answer, Candidate};
use crate::forecast::outcome::Outcome;
use crate::forecast::ranges::Interval;
use crate::mechanics::hinge::ring::RingTable;
use crate::units::{Angle, Length, LineForce, Pressure, Quantity};
use rayon::prelude::*;
use std::fmt::Write;
use std::ops::Range;

/// A value of the spec that can be varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// `star.points`
    Points,
    /// `star.inner_radius`, mm
    InnerRadius,
    /// `star.tube_width`, mm
    TubeWidth,
    /// `star.tip_angle`, deg
    TipAngle,
    /// `star.tip_radius`, mm
    TipRadius,
    /// `star.corner_radius`, mm
    CornerRadius,
    /// `fabric.thickness`, mm
    Thickness,
    /// `fabric.young_modulus`, kPa
    YoungModulus,
    /// `fabric.seal_strength`, N/mm
    SealStrength,
    /// `load.pressure`, kPa
    Pressure,
    /// `load.object_radius`, mm
    ObjectRadius,
    /// `load.friction`
    Friction,
}

const KEYS: [(&str, Key, &str); 12] = [
    ("star.points", Key::Points, ""),
    ("star.inner_radius", Key::InnerRadius, "_mm"),
    ("star.tube_width", Key::TubeWidth, "_mm"),
    ("star.tip_angle", Key::TipAngle, "_deg"),
    ("star.tip_radius", Key::TipRadius, "_mm"),
    ("star.corner_radius", Key::CornerRadius, "_mm"),
    ("fabric.thickness", Key::Thickness, "_mm"),
    ("fabric.young_modulus", Key::YoungModulus, "_kPa"),
    ("fabric.seal_strength", Key::SealStrength, "_N_per_mm"),
    ("load.pressure", Key::Pressure, "_kPa"),
    ("load.object_radius", Key::ObjectRadius, "_mm"),
    ("load.friction", Key::Friction, ""),
];

/// Most rows of a sweep: beyond, a row number would not be exact in a spreadsheet, and the file not fit on a disk.
const MOST_ROWS: usize = 1_000_000_000;
/// Rows that one task computes: long enough to hide the hand-over, short enough for a smooth progress bar.
const CHUNK: usize = 4096;

/// One axis: a key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is varied.
    pub key: Key,
    /// Its values in the spec's own units: mm, deg, kPa, N/mm.
    pub values: Vec<f64>,
}

impl Axis {
    /// Reads `KEY=A,B,C` or `KEY=FROM..TO/COUNT`: `star.points=3,4,5`, `star.tube_width=10 mm..40 mm/31`.
    ///
    /// # Errors
    /// One sentence that says what is wrong.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (name, list) = text.split_once('=').ok_or(format!("`{text}` is not KEY=VALUES"))?;
        let known = || KEYS.map(|(name, ..)| name).join(", ");
        let &(_, key, _) = KEYS
            .iter()
            .find(|(known, ..)| *known == name.trim())
            .ok_or_else(|| format!("`{}` cannot be varied; these can: {}", name.trim(), known()))?;
        let values = match list.split_once("..") {
            Some((from, rest)) => {
                let (to, count) = rest
                    .split_once('/')
                    .ok_or(format!("`{list}` lacks the number of values: FROM..TO/COUNT"))?;
                let count: u32 =
                    count.trim().parse().map_err(|_| format!("`{count}` is not a number of values"))?;
                let (from, to) = (key.parse(from)?, key.parse(to)?);
                if !(1..=1_000_000).contains(&count) {
                    return Err(format!("{count} values; allowed are 1 to 1000000"));
                }
                let step = f64::from(count.saturating_sub(1)).max(1.0);
                (0..count).map(|i| from + (to - from) * f64::from(i) / step).collect()
            }
            None => list.split(',').map(|value| key.parse(value)).collect::<Result<Vec<_>, _>>()?,
        };
        if let Some(part) = values.iter().find(|value| key == Key::Points && value.fract() != 0.0) {
            return Err(format!(
                "{part} is not a number of points: choose the number of values so that all are whole"
            ));
        }
        Ok(Self { key, values })
    }
}

impl Key {
    fn parse(self, text: &str) -> Result<f64, String> {
        fn quantity<Q: Quantity>(text: &str) -> Result<f64, String> {
            Q::parse(text.trim()).map(Q::base).map_err(|_| {
                format!("`{}` is no {}; write a number and one of {}", text.trim(), Q::KIND, Q::unit_list())
            })
        }
        match self {
            Self::Points | Self::Friction => {
                let value: f64 =
                    text.trim().parse().map_err(|_| format!("`{}` is not a number", text.trim()))?;
                let whole = self == Self::Friction || (value.fract() == 0.0 && (3.0..=64.0).contains(&value));
                if value.is_finite() && value > 0.0 && whole {
                    Ok(value)
                } else {
                    Err(format!("`{}`: points are 3 to 64, friction is above 0", text.trim()))
                }
            }
            Self::TipAngle => quantity::<Angle>(text),
            Self::YoungModulus | Self::Pressure => quantity::<Pressure>(text),
            Self::SealStrength => quantity::<LineForce>(text),
            _ => quantity::<Length>(text),
        }
    }

    /// Puts `value`, in the spec's own unit, into `point`.
    pub fn set(self, point: &mut Candidate, value: f64) {
        let Candidate { star, fabric, load, .. } = point;
        match self {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "checked to be 3 to 64"
            )]
            Self::Points => star.points = value as u32,
            Self::InnerRadius => star.inner_radius = Length(value),
            Self::TubeWidth => star.tube_width = Length(value),
            Self::TipAngle => star.tip_angle = Angle(value),
            Self::TipRadius => star.tip_radius = Length(value),
            Self::CornerRadius => star.corner_radius = Length(value),
            Self::Thickness => fabric.thickness = Length(value),
            Self::YoungModulus => fabric.young_modulus = Pressure(value),
            Self::SealStrength => fabric.seal_strength = Some(LineForce(value)),
            Self::Pressure => load.pressure = Some(Pressure(value)),
            Self::ObjectRadius => load.object_radius = Some(Length(value)),
            Self::Friction => load.friction = Some(value),
        }
    }
}

/// A sweep around one design.
#[derive(Clone, Debug)]
pub struct Sweep {
    base: Candidate,
    axes: Vec<Axis>,
    table: RingTable,
}

impl Sweep {
    /// Every combination of the axes' values; the last axis runs fastest.
    ///
    /// # Errors
    /// One sentence, if there are no axes, too many rows, or a key twice.
    pub fn new(base: Candidate, axes: Vec<Axis>) -> Result<Self, String> {
        if axes.is_empty() {
            return Err("nothing is varied".to_owned());
        }
        for (i, axis) in axes.iter().enumerate() {
            if axes[..i].iter().any(|other| other.key == axis.key) {
                return Err(format!("`{}` is varied twice", name_of(axis.key).0));
            }
        }
        let rows = axes.iter().try_fold(1_usize, |product, axis| product.checked_mul(axis.values.len()));
        if rows.is_none_or(|rows| rows > MOST_ROWS) {
            return Err(format!("more than {MOST_ROWS} rows"));
        }
        let table = RingTable::new().map_err(|fault| fault.to_string())?;
        Ok(Self { base, axes, table })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// The rows of part `part` (from 1) of `parts`.
    pub fn part(&self, part: usize, parts: usize) -> Range<usize> {
        let rows = self.rows() as u128;
        let cut = |k: usize| usize::try_from(rows * k as u128 / parts as u128).unwrap_or(usize::MAX);
        cut(part.saturating_sub(1))..cut(part)
    }

    /// The header line.
    pub fn header(&self) -> String {
        let mut header = String::from("row");
        for axis in &self.axes {
            let (name, unit) = name_of(axis.key);
            let _ = write!(header, ",{name}{unit}");
        }
        header.push_str(
            ",arm_length_mm,tip_equilibrium_angle_deg,final_radius_mm,contraction,operating_pressure_kPa,\
             radial_stiffness_N_per_m,object_force_N,payload_kg,burst_pressure_kPa,fabric_cm2,bendability,stretch,\
             burst_margin,widest_radius_mm,final_radius_lo_mm,final_radius_hi_mm,object_force_lo_N,object_force_hi_N,\
             payload_lo_kg,payload_hi_kg,refused\n",
        );
        header
    }

    /// The design of row `row`.
    pub fn point(&self, row: usize) -> Candidate {
        let mut point = self.base.clone();
        self.for_each_value(row, |key, value| key.set(&mut point, value));
        point
    }

    fn for_each_value(&self, row: usize, mut with: impl FnMut(Key, f64)) {
        let mut stride = self.rows();
        let mut rest = row;
        for axis in &self.axes {
            stride /= axis.values.len();
            with(axis.key, axis.values[(rest / stride).min(axis.values.len() - 1)]);
            rest %= stride;
        }
    }

    /// The lines of `rows`, computed in parallel, handed in order to `write`, which may stop by returning false.
    pub fn run(&self, rows: Range<usize>, mut write: impl FnMut(&str, usize) -> bool) {
        let mut start = rows.start;
        while start < rows.end {
            // One batch is in memory at a time, whatever the size of the sweep.
            let end = rows.end.min(start + CHUNK * 64);
            let chunks: Vec<Range<usize>> =
                (start..end).step_by(CHUNK).map(|from| from..end.min(from + CHUNK)).collect();
            let texts: Vec<(String, usize)> =
                chunks.into_par_iter().map(|chunk| (self.lines(chunk.clone()), chunk.len())).collect();
            for (text, count) in texts {
                if !write(&text, count) {
                    return;
                }
            }
            start = end;
        }
    }

    fn lines(&self, rows: Range<usize>) -> String {
        let mut out = String::with_capacity(rows.len() * 160);
        for row in rows {
            let _ = write!(out, "{row}");
            self.for_each_value(row, |_, value| {
                let _ = write!(out, ",{}", Plain(value));
            });
            let point = self.point(row);
            match point.answer(&self.table) {
                Ok(answer) => write_answer(&mut out, &answer, point.load.pressure),
                Err(fault) => {
                    let _ = writeln!(out, "{}\"{fault}\"", ",".repeat(COLUMNS + 1));
                }
            }
        }
        out
    }
}

/// Columns of an answer, `refused` not counted.
const COLUMNS: usize = 20;

fn write_answer(out: &mut String, answer: &Answer, pressure: Option<Pressure>) {
    let own = answer.outcome.as_ref();
    let mm = |metres: f64| Length::from_metres(metres).0;
    let radius = own.and_then(|own| own.ranges.radius).map(|range| range.map(mm));
    let force = own.and_then(|own| own.force_range);
    let low = |range: Option<Interval>| range.map(|range| range[0]);
    let high = |range: Option<Interval>| range.map(|range| range[1]);
    let values: [Option<f64>; COLUMNS] = [
        Some(answer.star.l),
        own.map(|own| own.rest.equilibrium.to_degrees()),
        own.map(|own| mm(own.rest.radius)),
        own.map(|own| own.contraction),
        Some(answer.operating_pressure.0),
        own.and_then(|own| own.stiffness),
        own.and_then(Outcome::object_force),
        answer.payload,
        answer.burst.map(|pressure| pressure.0),
        // mm^2 to cm^2.
        answer.fabric.map(|area| area / 100.0),
        own.and_then(|own| own.bendability),
        own.and_then(|own| own.stretch),
        answer.burst.zip(pressure).map(|(burst, pressure)| burst.0 / pressure.0),
        own.map(|own| mm(own.graspable[1])),
        low(radius),
        high(radius),
        low(force),
        high(force),
        low(answer.payload_range),
        high(answer.payload_range),
    ];
    for value in values {
        out.push(',');
        if let Some(value) = value {
            let _ = write!(out, "{}", Plain(value));
        }
    }
    out.push_str(",\n");
}

/// A number with nine significant digits: more than any model here deserves, few enough to be the same everywhere.
struct Plain(f64);

impl std::fmt::Display for Plain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let x = if self.0 == 0.0 { 0.0 } else { self.0 };
        if x.fract() == 0.0 && x.abs() < 1e9 {
            return write!(f, "{x}");
        }
        let size = x.abs();
        if (1e-3..1e9).contains(&size) {
            // Decimals so that nine significant digits are shown; the chain is faster than a logarithm.
            let mut decimals = 11;
            let mut bound = 1e-2;
            while size >= bound {
                decimals -= 1;
                bound *= 10.0;
            }
            return write!(f, "{x:.decimals$}");
        }
        write!(f, "{x:.8e}")
    }
}

fn name_of(key: Key) -> (&'static str, &'static str) {
    KEYS.iter().find(|(_, known, _)| *known == key).map_or(("", ""), |(name, _, unit)| (*name, *unit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{Source, read, starter};

    fn base() -> Candidate {
        let text = starter("x").expect("a name")
            + "\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nfriction = 0.5\n";
        Candidate::of(&read(&Source::new("x", text)).expect("valid").spec).expect("a star")
    }

    fn sweep() -> Sweep {
        let axes =
            ["star.points=3,4,5,9", "star.tube_width=20 mm..40 mm/33", "star.tip_angle=20 deg..60 deg/101"];
        Sweep::new(base(), axes.map(|text| Axis::parse(text).expect("valid")).to_vec()).expect("small")
    }

    fn csv(sweep: &Sweep, rows: Range<usize>) -> String {
        let mut out = String::new();
        sweep.run(rows, |text, _| {
            out.push_str(text);
            true
        });
        out
    }

    #[test]
    fn axes_are_read_with_units() {
        let axis = Axis::parse("star.tube_width=1 cm..40 mm/4").expect("valid");
        assert_eq!((axis.key, axis.values), (Key::TubeWidth, vec![10.0, 20.0, 30.0, 40.0]));
        assert_eq!(Axis::parse("load.pressure=10 kPa, 0.2 bar").expect("valid").values, vec![10.0, 20.0]);
        assert_eq!(Axis::parse("star.points=5..5/1").expect("valid").values, vec![5.0]);
        for wrong in [
            "x",
            "star.width=1 mm",
            "star.points=2",
            "star.points=4.5",
            "star.points=3..6/3",
            "star.tube_width=3",
            "star.tube_width=1 mm..2 mm",
            "star.tube_width=1 mm..2 mm/0",
            "load.friction=-1",
        ] {
            assert!(Axis::parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn parts_and_threads_make_the_same_rows() {
        let sweep = sweep();
        assert_eq!(sweep.rows(), 4 * 33 * 101);
        let whole = csv(&sweep, 0..sweep.rows());
        let parts: String = (1..=7).map(|k| csv(&sweep, sweep.part(k, 7))).collect();
        assert_eq!(whole, parts);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        assert_eq!(whole, pool.install(|| csv(&sweep, 0..sweep.rows())));
        assert_eq!(whole.lines().count(), sweep.rows());
        let columns = sweep.header().split(',').count();
        assert!(
            whole.lines().filter(|line| !line.contains('"')).all(|line| line.split(',').count() == columns)
        );
        assert!(whole.contains("9,") && whole.contains("the arms would be"), "refusals are said");
    }

    #[test]
    fn numbers_are_plain() {
        let texts = [30.0, 0.5, 1.0 / 3.0, 12345.6789, 1e-7, -2.5, -0.0].map(|x| Plain(x).to_string());
        assert_eq!(
            texts,
            ["30", "0.500000000", "0.333333333", "12345.6789", "1.00000000e-7", "-2.50000000", "0"]
        );
    }
}
