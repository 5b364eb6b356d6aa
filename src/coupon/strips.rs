//! The grid of seal strips: temperature by speed by height, of a laser power by speed, each repeated, and its table.

use std::collections::HashMap;
use std::fmt;
use std::fmt::Write;

use crate::emit;
use crate::emit::GridCell;
use geom::{Bounds, Line, Path, Point, Vec2};
use spec::units::{Length, Percent, Quantity, Speed, Temperature};
use spec::{Allowed, CONTACT, FOCUSES, Machine, POWERS, SEAL_SPEEDS, Seal, Spec, TOXIC};

/// Temperatures of strips, C: no coating melts in a hot room, and from the upper end on the release layer is toxic.
pub const TEMPERATURES: Allowed = Allowed::open(40.0, TOXIC.0);
/// Width of a specimen of the T-peel test, mm (ASTM F88).
pub(super) const WIDTH: f64 = 25.0;
/// Length of its legs, mm.
pub(super) const LEGS: f64 = 75.0;
/// Excess length of the seal over the specimen at both ends, mm; it is cut off, because the iron came down and went up there.
const WASTE: f64 = 5.0;
/// Largest number of strips in a row.
const ROW: f64 = 6.0;
/// Distance between the edge of the sheet and a ramp, mm.
const EDGE: f64 = 10.0;

/// The settings to vary.
#[derive(Clone, Debug, PartialEq)]
pub struct StripGrid {
    /// Temperatures of the iron; none of a laser.
    pub temperatures: Vec<Temperature>,
    /// Powers of a laser; none of an iron.
    pub powers: Vec<Percent>,
    /// Speeds of the tool.
    pub speeds: Vec<Speed>,
    /// Heights of the tip in contact, or of a laser's focus.
    pub heights: Vec<Length>,
    /// Number of seals with each setting; at least three for a spread.
    pub repeats: usize,
}

/// What heats a strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StripHeat {
    /// An iron.
    Temperature(Temperature),
    /// A laser.
    Power(Percent),
}

impl StripHeat {
    /// Sets `seal` to this heat.
    pub(super) fn set(self, seal: &mut Seal) {
        match self {
            Self::Temperature(temperature) => seal.temperature = temperature,
            Self::Power(power) => seal.power = Some(power),
        }
    }

    /// The number in the unit of its column in the table.
    fn number(self) -> f64 {
        match self {
            Self::Temperature(temperature) => temperature.0,
            Self::Power(power) => power.0,
        }
    }

    /// The heat in the name of a program: "200C", "80permille".
    fn in_name(self) -> String {
        match self {
            Self::Temperature(temperature) => format!("{}C", temperature.0.round()),
            Self::Power(power) => format!("{}permille", (10.0 * power.0).round()),
        }
    }
}

impl fmt::Display for StripHeat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Temperature(temperature) => temperature.fmt(f),
            Self::Power(power) => power.fmt(f),
        }
    }
}

/// One strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestStrip {
    /// Number in the table and on the fabric, from 1.
    pub number: usize,
    /// Temperature of the iron, or power of a laser.
    pub heat: StripHeat,
    /// Speed of the tool.
    pub speed: Speed,
    /// Height of the tip, or of a laser's focus.
    pub height: Length,
    /// Start of the seal.
    pub start: Point,
}

impl StripGrid {
    /// All combinations of temperature or power, speed and height: one program each.
    pub fn settings(&self) -> impl Iterator<Item = (StripHeat, Speed, Length)> {
        let temperatures = self.temperatures.iter().copied().map(StripHeat::Temperature);
        let heats = temperatures.chain(self.powers.iter().copied().map(StripHeat::Power));
        let pairs = heats.flat_map(|heat| self.speeds.iter().map(move |v| (heat, *v)));
        pairs.flat_map(|(t, v)| self.heights.iter().map(move |h| (t, v, *h)))
    }

    /// Why `machine` does not seal strips with these settings, as text with the allowed ones; `None` if it does.
    pub fn refusal(&self, machine: &Machine) -> Option<String> {
        let lowest = machine.process.lowest_contact();
        let too_low = || {
            self.heights.iter().find(|h| h.0 < lowest.0).map(|h| {
            format!("a height of {h}; it must be {lowest} for the profile's tip without a spring: set `spring_loaded = true` if it has one")
        })
        };
        let is_laser = machine.controller.laser.is_some();
        let wrong_tool = if is_laser { !self.temperatures.is_empty() } else { !self.powers.is_empty() };
        if wrong_tool {
            return Some("a laser has powers, and an iron has temperatures: neither has both".to_owned());
        }
        out_of_range("temperature", &self.temperatures, TEMPERATURES)
            .or_else(|| out_of_range("power", &self.powers, POWERS))
            .or_else(|| out_of_range("speed", &self.speeds, SEAL_SPEEDS))
            .or_else(|| out_of_range("height", &self.heights, if is_laser { FOCUSES } else { CONTACT }))
            .or_else(too_low)
            .or_else(|| self.alike())
    }

    /// Two settings with the same file name, as text with the required difference; `None` if all names differ.
    fn alike(&self) -> Option<String> {
        let mut first_settings = HashMap::new();
        let name_and_setting = |(t, v, h)| (program_name(self, t, v, h), format!("{t} at {v}, Z {h}"));
        let (first, twin) = self.settings().map(name_and_setting).find_map(|(name, setting)| {
            let first = first_settings.get(&name).cloned();
            let _ = first_settings.entry(name).or_insert_with(|| setting.clone());
            Some((first?, setting))
        })?;
        let heats = if self.powers.is_empty() {
            "temperatures must differ by at least 1 C"
        } else {
            "powers must differ by at least 0.1 %"
        };
        Some(format!(
            "the settings {first} and {twin} cannot be told apart; {heats}, speeds by at \
             least 0.001 mm/s, heights by at least 0.001 mm, and each be given once (--repeats seals a setting more often)"
        ))
    }

    /// All strips, in rows from the lower left; the rows are as long as the work area of `machine` allows.
    pub fn strips(&self, machine: &Machine) -> Vec<TestStrip> {
        let ramp = machine.process.ramp.0.max(WASTE);
        let (edge, pitch) = (EDGE + ramp, WIDTH + 2.0 * WASTE + 2.0 * ramp);
        let room = machine.bench.work_area.map_or(f64::INFINITY, |(x, _)| x.0 - EDGE);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 6")]
        let row = (room / pitch).floor().clamp(1.0, ROW) as usize;
        let settings = self.settings().flat_map(|setting| (0..self.repeats).map(move |_| setting));
        settings
            .enumerate()
            .map(|(i, (heat, speed, height))| {
                #[expect(clippy::cast_precision_loss, reason = "a few hundred strips at most")]
                let (column, row) = ((i % row) as f64, (i / row) as f64);
                let start = Point::new(edge + column * pitch, 15.0 + row * (LEGS + 15.0));
                TestStrip { number: i + 1, heat, speed, height, start }
            })
            .collect()
    }
}

/// The first of `values` that is not `allowed`, as text with the allowed ones.
pub(super) fn out_of_range<Q: Quantity>(word: &str, values: &[Q], allowed: Allowed) -> Option<String> {
    let wrong = values.iter().find(|value| !allowed.contains(value.base()))?;
    Some(format!("a {word} of {wrong}; it {}", allowed.in_words(Q::KIND.unit())))
}

impl TestStrip {
    /// The path of the iron in contact.
    pub fn seam(&self) -> Path {
        let end = Point::new(self.start.x + WIDTH + 2.0 * WASTE, self.start.y);
        Path::open(vec![Line::new(self.start, end).into()])
    }

    /// Position of its number: on the specimen, above the band.
    pub(super) fn label(&self, band: f64) -> Point {
        Point::new(self.start.x + WASTE + 2.0, self.start.y + band / 2.0 + 3.0)
    }
}

/// All strips on one page, each with its setting and its specimen.
pub fn overview(spec: &Spec, grid: &StripGrid, strips: &[TestStrip]) -> String {
    let cells: Vec<GridCell> = strips
        .iter()
        .map(|strip| {
            let min = strip.start + Vec2::new(WASTE, -spec.seal.band.0);
            let specimen = Bounds { min, max: min + Vec2::new(WIDTH, LEGS) };
            let words = vec![
                strip.heat.to_string(),
                strip.speed.to_string(),
                format!("Z {}", strip.height),
                program_name(grid, strip.heat, strip.speed, strip.height),
            ];
            GridCell { number: strip.number, seam: strip.seam(), specimen, words }
        })
        .collect();
    emit::cells(&format!("seal strips: {}", spec.name), &cells, spec.seal.band.0)
}

/// Name of the program of a setting of `grid`, without its ending; it contains the height if the grid has several.
pub(super) fn program_name(grid: &StripGrid, heat: StripHeat, speed: Speed, height: Length) -> String {
    let z = match grid.heights.len() {
        0 | 1 => String::new(),
        _ => format!("-z{}um", (height.0 * 1e3).round()),
    };
    format!("strips-{}-{}um-s{z}", heat.in_name(), (speed.0 * 1e3).round())
}

/// The table to fill in, as CSV.
pub fn table(strips: &[TestStrip]) -> String {
    let is_laser = strips.iter().any(|strip| matches!(strip.heat, StripHeat::Power(_)));
    let [heat_name, height_name] =
        if is_laser { ["power_percent", "focus_mm"] } else { ["temperature_C", "height_mm"] };
    let mut lines = format!("strip,{heat_name},speed_mm_s,{height_name},peel_N,failure\n");
    for strip in strips {
        let TestStrip { number, heat, speed, height, .. } = strip;
        let _ = writeln!(lines, "{number},{},{},{},,", heat.number(), speed.0, height.0);
    }
    lines
}
