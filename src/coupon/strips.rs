//! The grid of seal strips: temperature by speed by height, each as often as asked, and its table.

use std::fmt::Write;

use crate::geom::Line;
use crate::geom::Path;
use crate::geom::Point;
use crate::units::Length;
use crate::units::Speed;
use crate::units::Temperature;

/// Width of a specimen of the T-peel test, mm (ASTM F88).
pub(super) const WIDTH: f64 = 25.0;
/// Length of its legs, mm.
pub(super) const LEGS: f64 = 75.0;
/// What the seal is longer than the specimen at both ends, mm: cut off, for there the iron came down and went up.
const WASTE: f64 = 5.0;
/// Strips in a row.
const ROW: usize = 6;

/// What is varied.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Temperatures of the iron.
    pub temperatures: Vec<Temperature>,
    /// Speeds of the iron.
    pub speeds: Vec<Speed>,
    /// Heights of the tip in contact.
    pub heights: Vec<Length>,
    /// How often each setting is sealed; at least three for a spread.
    pub repeats: usize,
}

/// One strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Its number in the table and on the fabric, from 1.
    pub number: usize,
    /// Temperature of the iron.
    pub temperature: Temperature,
    /// Speed of the iron.
    pub speed: Speed,
    /// Height of the tip.
    pub height: Length,
    /// Where it begins.
    pub start: Point,
}

impl Grid {
    /// Every pair of temperature and speed: one program each.
    pub fn settings(&self) -> impl Iterator<Item = (Temperature, Speed)> {
        self.temperatures.iter().flat_map(|t| self.speeds.iter().map(|v| (*t, *v)))
    }

    /// Every strip, in rows from the lower left.
    pub fn strips(&self) -> Vec<Strip> {
        let settings = self.settings().flat_map(|(t, v)| {
            self.heights.iter().flat_map(move |h| (0..self.repeats).map(move |_| (t, v, *h)))
        });
        settings
            .enumerate()
            .map(|(i, (temperature, speed, height))| {
                #[expect(clippy::cast_precision_loss, reason = "a few hundred strips at most")]
                let (column, row) = ((i % ROW) as f64, (i / ROW) as f64);
                let start = Point::new(15.0 + column * (WIDTH + 4.0 * WASTE), 15.0 + row * (LEGS + 15.0));
                Strip { number: i + 1, temperature, speed, height, start }
            })
            .collect()
    }
}

impl Strip {
    /// What the iron travels in contact.
    pub fn seam(&self) -> Path {
        let end = Point::new(self.start.x + WIDTH + 2.0 * WASTE, self.start.y);
        Path::open(vec![Line::new(self.start, end).into()])
    }
}

/// The table to fill in, as CSV.
pub fn table(strips: &[Strip]) -> String {
    let mut out = String::from("strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n");
    for strip in strips {
        let Strip { number, temperature, speed, height, .. } = strip;
        let _ = writeln!(out, "{number},{},{},{},,", temperature.0, speed.0, height.0);
    }
    out
}
