//! Effect of arms on a hinge, computed: **ladders** of V-actuators at rising pressures, as shells, and the table made of them.
//!
//! A ladder is one tau, R* and nu at all pressures of the table's grid; its answer is a self-contained text with a
//! checksum of its own in its last line. All texts together are joined into the table, `section` subtracted.

use crate::inflations::{Inflation, inflations};
use crate::{sealed, sha256, unsealed};
use inflatable::mechanics::fault::HingeFault;
use inflatable::mechanics::hinge::HingeModel;
use inflatable::mechanics::hinge::section::{Section, arms};
use inflatable::mechanics::star::correction::TABLE_ARM;
use inflatable::shell::cases::{Fineness, Margin, ShellFault, Tube, VActuator, Value, Watch};
use inflatable::shell::element::Fabric;
use std::f64::consts::{FRAC_PI_4, PI};
use std::fmt;
use std::fmt::Write;

/// Their width, m. Ratios alone matter.
const WIDTH: f64 = 0.02;
/// Their Y, N/m.
const STRETCH: f64 = 1e4;
/// Meshes of some 12,000, 50,000 and 200,000 unknowns, begun on one of 3,000.
pub const FINENESS: Fineness = Fineness { cells: 10.0, cuts: 3 };
/// Poisson's ratios besides the table's, and the places of the grid at which they are computed, at its first angle.
const OTHER_POISSONS: [f64; 2] = [0.2, 0.49];
const OTHERS: [(usize, usize); 3] = [(0, 3), (1, 0), (2, 4)];

/// One ladder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ladder {
    /// Number of the ladder, from 1.
    pub number: usize,
    /// phi_0, deg.
    pub angle: f64,
    /// t / [W sqrt(12 (1 - nu^2))].
    pub tau: f64,
    /// R*.
    pub r_star: f64,
    /// nu.
    pub poisson: f64,
}

/// Ladders of the table, arc by arc and tau by tau; those after them test the dependence on nu.
pub fn ladders() -> Vec<Ladder> {
    let mut list = Vec::new();
    for arc in arms::ARCS {
        for tau in arms::TAUS {
            for r_star in arms::R_STARS {
                list.push(Ladder::new(list.len() + 1, arc, tau, r_star, arms::POISSON));
            }
        }
    }
    for poisson in OTHER_POISSONS {
        for (tau, r_star) in OTHERS {
            let (tau, r_star) = (arms::TAUS[tau], arms::R_STARS[r_star]);
            list.push(Ladder::new(list.len() + 1, arms::ARCS[0], tau, r_star, poisson));
        }
    }
    for r_star in arms::THIN_R_STARS {
        list.push(Ladder::new(list.len() + 1, arms::THIN_ARC, arms::THIN_TAU, r_star, arms::POISSON));
    }
    list
}

impl Ladder {
    fn new(number: usize, arc: f64, tau: f64, r_star: f64, poisson: f64) -> Self {
        Self { number, angle: 180.0 - arc, tau, r_star, poisson }
    }

    /// alpha_0, rad.
    pub fn arc(&self) -> f64 {
        PI - self.angle.to_radians()
    }

    /// Whether it is one of the table's own.
    pub fn is_in_table(&self) -> bool {
        self.poisson == arms::POISSON && !self.is_thin()
    }

    /// Whether it is of the table of thin fabric.
    pub fn is_thin(&self) -> bool {
        self.tau == arms::THIN_TAU
    }

    /// 1/eps of its pressures.
    fn bendabilities(&self) -> Vec<f64> {
        let bendabilities = arms::bendabilities(self.tau);
        bendabilities[if self.is_thin() { arms::PRESSURES - arms::THIN_PRESSURES } else { 0 }..].to_vec()
    }

    /// Computes it; returns its text with the results.
    ///
    /// # Errors
    /// If the shell refuses, or is cancelled.
    pub fn compute(&self, fineness: Fineness, watch: &Watch<'_>) -> Result<String, ShellFault> {
        let bendabilities = self.bendabilities();
        let bending = STRETCH * (self.tau * WIDTH).powi(2);
        let fabric = Fabric::isotropic(STRETCH, bending, self.poisson);
        let pressures: Vec<f64> = bendabilities.iter().map(|b| b * bending / WIDTH.powi(3)).collect();
        let case = VActuator {
            tube: Tube { width: WIDTH, fabric, pressure: pressures[0] },
            radius: self.r_star * WIDTH,
            arm_length: TABLE_ARM * WIDTH,
            angle: self.angle.to_radians(),
            margin: Margin::NONE,
        };
        let inflations_found = inflations(&case, &pressures, fineness, watch)?;
        let mut text = String::from(
            "# A V-actuator with arms of 4 W as a shell; `research ladders`.\n# 1/eps; alpha, deg, its mesh error, on \
             three meshes; C alpha_0 / (p W^3), its mesh error, on three meshes.\n",
        );
        let Self { number, angle, tau, r_star, poisson } = self;
        let Fineness { cells, cuts } = fineness;
        let _ = writeln!(
            text,
            "ladder {number} phi_0 {angle} tau {tau} R* {r_star} nu {poisson} cells {cells} cuts {cuts}"
        );
        for ((b, pressure), inflations_found) in bendabilities.iter().zip(pressures).zip(inflations_found) {
            let Some(Inflation { angle, stiffness, .. }) = inflations_found else { break };
            let alpha = angle.shifted(-PI).scaled(-1.0_f64.to_degrees());
            let unit = pressure * WIDTH.powi(3) / self.arc();
            let _ = writeln!(text, "{b:.3} {} {}", value(alpha, 4), value(stiffness.scaled(unit.recip()), 5));
        }
        Ok(sealed(&text))
    }
}

fn value(value: Value, decimals: usize) -> String {
    let Value { value, error, meshes: [a, b, c] } = value;
    format!("{value:.decimals$} {error:.decimals$} {a:.decimals$} {b:.decimals$} {c:.decimals$}")
}

/// A ladder's text as it is read back.
#[derive(Clone, Debug, PartialEq)]
pub struct LadderTable {
    /// The ladder.
    pub ladder: Ladder,
    /// 1/eps; alpha, deg, and its mesh error; C alpha_0 / (p W^3) and its mesh error.
    pub points: Vec<[f64; 5]>,
}

impl LadderTable {
    /// Reads a text; `None` if it is torn, or not one of the ladders.
    pub fn read(text: &str) -> Option<Self> {
        let mut lines = unsealed(text)?;
        let words: Vec<&str> = lines.next()?.split(' ').collect();
        let ["ladder", number, "phi_0", angle, "tau", tau, "R*", r_star, "nu", poisson, ..] = words[..]
        else {
            return None;
        };
        let number = number.parse().ok()?;
        let ladder = *ladders().get(usize::checked_sub(number, 1)?)?;
        let stated = Ladder {
            number,
            angle: angle.parse().ok()?,
            tau: tau.parse().ok()?,
            r_star: r_star.parse().ok()?,
            poisson: poisson.parse().ok()?,
        };
        let point = |line: &str| {
            let numbers: Option<Vec<f64>> = line.split(' ').map(|word| word.parse().ok()).collect();
            let [b, alpha, alpha_error, _, _, _, c, c_error, _, _, _] = numbers?[..] else { return None };
            Some([b, alpha, alpha_error, c, c_error])
        };
        let points: Option<Vec<[f64; 5]>> = lines.map(point).collect();
        (stated == ladder).then_some(Self { ladder, points: points? })
    }

    /// For each pressure 1/eps, delta and its error, the arms' give and its error, deg.
    ///
    /// # Errors
    /// If the section has no such hinge.
    pub fn arms(&self) -> Result<Vec<[f64; 5]>, HingeFault> {
        let Ladder { tau, r_star, poisson, .. } = self.ladder;
        let arc = self.ladder.arc();
        let hinge_arms = |[b, alpha, alpha_error, c, c_error]: [f64; 5]| {
            let section = Section::by_ratios(b, tau, poisson).target(r_star)?;
            let tanh = (arc / FRAC_PI_4).tanh();
            let delta = (alpha - section.lambda * arc.to_degrees()) / tanh;
            let softened = -section.curvature / c * arc.to_degrees();
            Ok([b, delta, alpha_error / tanh, softened - arc.to_degrees(), softened * c_error / c])
        };
        self.points.iter().copied().map(hinge_arms).collect()
    }
}

/// Reason for ladders that form no table.
#[derive(Clone, Debug, PartialEq)]
pub enum JoinFault {
    /// A ladder is missing.
    Missing(usize),
    /// A ladder ends before its last pressure.
    Short(usize),
    /// The section refuses.
    Hinge(HingeFault),
}

impl fmt::Display for JoinFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(number) => write!(f, "ladder {number} is missing: compute it first"),
            Self::Short(number) => write!(f, "ladder {number} ends before its last pressure"),
            Self::Hinge(fault) => fault.fmt(f),
        }
    }
}

impl std::error::Error for JoinFault {}

/// The table of all its ladders, or that of `thin` fabric, as the text that is shipped.
///
/// # Errors
/// If one of them is missing or incomplete.
pub fn join(climbed: &[LadderTable], thin: bool) -> Result<String, JoinFault> {
    let mut body = String::new();
    let of_table = |ladder: &Ladder| if thin { ladder.is_thin() } else { ladder.is_in_table() };
    for ladder in ladders().into_iter().filter(of_table) {
        let number = ladder.number;
        let table = climbed.iter().find(|climbed| climbed.ladder.number == number);
        let points = table.ok_or(JoinFault::Missing(number))?.arms().map_err(JoinFault::Hinge)?;
        if points.len() != ladder.bendabilities().len() {
            return Err(JoinFault::Short(number));
        }
        for [b, angle, angle_error, give, give_error] in points {
            let Ladder { angle: phi, tau, r_star, .. } = ladder;
            let _ = writeln!(
                body,
                "{phi} {tau} {r_star} {b:.3} {angle:.4} {angle_error:.4} {give:.3} {give_error:.3}"
            );
        }
    }
    let hash = sha256(&body);
    let option = if thin { " --thin" } else { "" };
    Ok(format!(
        "# What arms add to a hinge; read by crates/inflatable/src/mechanics/hinge/section/arms.rs.\n\
         # Made by `research ladders DIR` and `research ladders DIR --join{option}` (crates/research). SHA-256 of the lines below: {hash}\n\
         # phi_0, deg, tau, R*, 1/eps; delta and its mesh error, the arms' give and its mesh error, deg.\n{body}"
    ))
}
