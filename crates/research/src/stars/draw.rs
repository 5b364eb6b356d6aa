//! The computed stars: drawn by seed, the same on every machine, in five sets that have no star in common; and the paper's.

use std::f64::consts::PI;

use inflatable::shell::cases::{FlatStar, Margin, Tube};
use inflatable::shell::element::Fabric;

/// The use of a star.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// To fit a correction.
    Fit,
    /// To determine ranges.
    Range,
    /// To test both.
    Test,
    /// The stars of the paper's figure of n = 3 to 8, at four pressures.
    Paper,
    /// Thinner fabric, more points, shorter and longer arms than the sets before have: to take wider ranges from, and to try them on.
    Wide,
    /// Three to five points around narrow holes, where objects fill the flat tube's hole: to give residuals, and to try them.
    Narrow,
}

/// One star of a set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnStar {
    /// Set of the star.
    pub set: Set,
    /// Number of the star in its set, from 1.
    pub number: u32,
    /// n.
    pub points: u32,
    /// Flat tube width W, mm.
    pub width: f64,
    /// Inner radius rho_0, mm.
    pub inner_radius: f64,
    /// phi_i0, deg.
    pub tip_angle: f64,
    /// R_i, mm.
    pub tip_radius: f64,
    /// R_e, mm.
    pub corner_radius: f64,
    /// t, mm.
    pub thickness: f64,
    /// p, kPa.
    pub pressure: f64,
}

/// E of all of them, MPa, and nu. A star's ratios depend on E by p/E alone.
pub const YOUNG: f64 = 128.0;
/// nu of all of them.
pub const POISSON: f64 = 0.39;
/// Largest p W / Y.
const STRETCH: f64 = 0.1;
/// Largest phi_e0, deg: a corner turns by 20 deg at least.
const MOST_OPEN: f64 = 160.0;

/// Within which a star is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
struct DrawnBounds {
    /// t/W: as far as the arms' tables go.
    slenderness: [f64; 2],
    /// 1/eps: from where those tables begin to where the shell was tried.
    bendability: [f64; 2],
    /// Arms by W.
    arm: [f64; 2],
    /// rho_0 by W.
    hole: [f64; 2],
    /// Points of the stars: each in turn.
    points: &'static [u32],
}

/// Of the sets before `wide`.
const USUAL: DrawnBounds = DrawnBounds {
    slenderness: [0.0101, 0.03],
    bendability: [100.0, 5000.0],
    arm: [0.5, 5.0],
    hole: [0.5, 6.0],
    points: &[3, 4, 5, 6, 7, 8],
};
/// Of the set `wide`: every other star of thin fabric, the others not among the usual ones for their sizes.
const THIN: DrawnBounds = DrawnBounds {
    slenderness: [0.005, 0.0101],
    bendability: [631.0, 5000.0],
    arm: [0.2, 8.0],
    hole: [0.5, 12.0],
    points: &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12],
};
const ODD: DrawnBounds =
    DrawnBounds { slenderness: USUAL.slenderness, bendability: USUAL.bendability, ..THIN };
/// Of the set `narrow`.
const NARROW: DrawnBounds = DrawnBounds { hole: [0.5, 1.2], points: &[3, 4, 5], ..USUAL };
/// Pressures at which the paper's stars are computed, kPa.
pub const PAPER_PRESSURES: [f64; 4] = [14.0, 20.0, 37.0, 60.0];

impl Set {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Fit, Self::Range, Self::Test, Self::Paper, Self::Wide, Self::Narrow];

    /// Name of the set, the number of its stars, and the seed of its random numbers; no seed if it is not drawn.
    const fn row(self) -> (&'static str, u32, Option<u64>) {
        match self {
            Self::Fit => ("fit", 36, Some(1)),
            Self::Range => ("range", 48, Some(2)),
            Self::Test => ("test", 456, Some(3)),
            Self::Paper => ("paper", 24, None),
            Self::Wide => ("wide", 60, Some(4)),
            Self::Narrow => ("narrow", 60, Some(5)),
        }
    }

    /// Name of the set.
    pub const fn name(self) -> &'static str {
        self.row().0
    }

    /// The number of its stars.
    pub const fn count(self) -> u32 {
        self.row().1
    }

    /// Star number `number` of the set, from 1: the points go round, the rest is drawn, or the paper's.
    pub fn star(self, number: u32) -> DrawnStar {
        let place = number as usize - 1;
        let bounds = match self {
            Self::Wide if place % 2 == place / 10 % 2 => THIN,
            Self::Wide => ODD,
            Self::Narrow => NARROW,
            Self::Fit | Self::Range | Self::Test | Self::Paper => USUAL,
        };
        let points = bounds.points[place % bounds.points.len()];
        let Some(seed) = self.row().2 else {
            let pressure = PAPER_PRESSURES[place / bounds.points.len() % PAPER_PRESSURES.len()];
            return paper(number, points, pressure);
        };
        let mut dice = Dice((seed << 40) + (u64::from(number) << 20));
        loop {
            if let Some(star) = throw((self, number), points, &bounds, &mut dice) {
                return star;
            }
        }
    }
}

/// The paper's star of W = 30 mm with `points` points.
const fn paper(number: u32, points: u32, pressure: f64) -> DrawnStar {
    DrawnStar {
        set: Set::Paper,
        number,
        points,
        width: 30.0,
        inner_radius: 50.0,
        tip_angle: 30.0,
        tip_radius: 0.0,
        corner_radius: 0.0,
        thickness: 0.3,
        pressure,
    }
}

/// One throw; `None` if there is no such star, or it lies outside of `bounds`.
fn throw((set, number): (Set, u32), points: u32, bounds: &DrawnBounds, dice: &mut Dice) -> Option<DrawnStar> {
    // Sizes are thrown first and rounded as a spec writes them; the inner radius follows from the arm. The ratios are judged by the
    // rounded sizes. A wide set leaves out stars within the usual bounds, which have sets of their own.
    let width = rounded(dice.log([15.0, 60.0]), 10.0);
    let thickness = rounded(dice.log([0.1, 0.5]), 1000.0);
    let tip_angle = rounded(dice.even([15.0, 70.0]), 10.0);
    let pressure = rounded(dice.log([5.0, 60.0]), 10.0);
    let sharp = dice.even([0.0, 1.0]) < 0.3;
    let mut radius = || if sharp { 0.0 } else { rounded(dice.even([0.0, 0.3]) * width, 10.0) };
    let (tip_radius, corner_radius) = (radius(), radius());
    let arm = width * dice.log(bounds.arm);
    let (sine, cosine) = (0.5 * tip_angle.to_radians()).sin_cos();
    let reach = arm * sine + (width + tip_radius + corner_radius) * cosine;
    let inner_radius = rounded(reach / (PI / f64::from(points)).sin() - width - corner_radius, 10.0);
    let star = DrawnStar {
        set,
        number,
        points,
        width,
        inner_radius,
        tip_angle,
        tip_radius,
        corner_radius,
        thickness,
        pressure,
    };
    let tube = star.flat().tube;
    let is_within = |value: f64, [low, high]: [f64; 2]| (low..=high).contains(&value);
    let good = |bounds: &DrawnBounds| {
        is_within(thickness / width, bounds.slenderness)
            && is_within(tube.bendability(), bounds.bendability)
            && tube.stretch() < STRETCH
            && tip_angle + 360.0 / f64::from(points) <= MOST_OPEN
            && is_within(inner_radius / width, bounds.hole)
            && is_within(arm / width, bounds.arm)
            && bounds.points.contains(&points)
    };
    (good(bounds) && (set != Set::Wide || !good(&USUAL))).then_some(star)
}

impl DrawnStar {
    /// As the shell's input.
    pub fn flat(&self) -> FlatStar {
        let (t, young) = (1e-3 * self.thickness, 1e6 * YOUNG);
        let bending = young * t.powi(3) / (12.0 * (1.0 - POISSON * POISSON));
        let fabric = Fabric::isotropic(young * t, bending, POISSON);
        FlatStar {
            tube: Tube { width: 1e-3 * self.width, fabric, pressure: 1e3 * self.pressure },
            points: self.points,
            inner_radius: 1e-3 * self.inner_radius,
            tip_angle: self.tip_angle.to_radians(),
            tip_radius: 1e-3 * self.tip_radius,
            corner_radius: 1e-3 * self.corner_radius,
            band: 0.0,
            margin: Margin::NONE,
        }
    }
}

fn rounded(value: f64, factor: f64) -> f64 {
    (value * factor).round() / factor
}

/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators" (2014).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn even(&mut self, [low, high]: [f64; 2]) -> f64 {
        let part = f64::from(u32::try_from(self.next() >> 32).unwrap_or(0)) / f64::from(u32::MAX);
        low + part * (high - low)
    }

    fn log(&mut self, range: [f64; 2]) -> f64 {
        self.even(range.map(f64::ln)).exp()
    }
}
