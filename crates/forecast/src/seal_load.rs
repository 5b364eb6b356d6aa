//! The load of the pressure on the seal at each kind of place of a star, and the radius from which a hinge's seal holds.
//!
//! | room | subject |
//! |---|---|
//! | `pull` | the pull at the inner rims of hinges |
//! | `burst` | the pressure at which the seal peels |

mod burst;
mod pull;

pub(super) use self::burst::weakest_bounds;
pub use self::burst::{Bursting, burst, burst_of_drawn, burst_range, bursts_at, first_to_open};
pub use self::pull::{HingeSeal, LoadedHinge, RANGE, factor, largest_pull, pull, tried_range};

use self::burst::{burst_bounds, bursting, sure_strength};
use self::pull::{R_STAR, is_tried, range};
use crate::case::{Case, mechanism};
use crate::interval::scaled;
use crate::pressures::is_modelled;
use design::{Star, StarDesign};
use inflatable::mechanics::hinge::ring::Ring;
use inflatable::numerics::last_holding;
use spec::Spec;
use spec::units::{Length, LineForce, Pressure, Readable, tenths_up};
use std::f64::consts::{FRAC_1_PI, PI};
use std::fmt;

/// Roundest hinge that is advised, R*: rounder than ten widths no hinge is a hinge, and its pull is within a tenth of the straight tube's.
const ROUNDEST: f64 = 10.0;
/// Sharpest hinge that is looked at, R*: there k is 1e5, more than any seal holds.
const SHARPEST: f64 = 1e-6;

/// The least inner radius of `hinge` at which its seal surely withstands the pressure, rounded up to a hundredth of a mm, so the printed
/// radius is safe; `None` if no radius is known to be large enough, or pressure or peel strength are unknown.
pub fn safe_radius(case: &Case, hinge: LoadedHinge) -> Option<Length> {
    let width = case.mechanism.width;
    let pressure = case.pressure?;
    let is_safe = |r_star: f64| withstands(case, hinge, r_star, pressure);
    // The pull falls with R*; its range is least where the shells were.
    let ends = [(R_STAR[1], SHARPEST), (ROUNDEST, R_STAR[1])];
    let (safe, sharp) = ends.into_iter().find(|(round, _)| withstands(case, hinge, *round, pressure))?;
    // After 60 rounds the ends differ by rounding.
    let r_star = last_holding(safe, sharp, 60, is_safe);
    let hundredths = (Length::from_metres(r_star * width).0 * 100.0).ceil();
    Some(Length(hundredths / 100.0))
}

/// Whether the seal of `hinge` surely withstands `pressure`, Pa, at the radius R* = `r_star`.
fn withstands(case: &Case, hinge: LoadedHinge, r_star: f64, pressure: f64) -> bool {
    let radius = r_star * case.mechanism.width;
    let seal = factor(&Ring, r_star).map(|k| HingeSeal { hinge, radius, k });
    let range = seal.and_then(|seal| burst_bounds(case, seal));
    range.is_some_and(|[low, _]| pressure <= low)
}

/// The hinge that needs the larger radius to hold: the tips are pulled harder, unless the seam at the corners is weaker.
pub(super) fn sharpest_need(case: &Case) -> LoadedHinge {
    let is_corner_weaker = case.peel.tip.zip(case.peel.corner).is_some_and(|(tip, corner)| corner < tip);
    if !is_corner_weaker {
        return LoadedHinge::Tip;
    }
    // `None`: no radius holds.
    match [LoadedHinge::Tip, LoadedHinge::Corner].map(|hinge| safe_radius(case, hinge)) {
        [Some(_), None] => LoadedHinge::Corner,
        [Some(tip), Some(corner)] if corner.0 > tip.0 => LoadedHinge::Corner,
        _ => LoadedHinge::Tip,
    }
}

/// [`safe_radius`], if `star` of `spec`, whose case is `case`, can have it at both tips and corners: it can be made then, and has a
/// prediction if it has one now.
pub(super) fn possible_radius(spec: &Spec, case: &Case, star: &Star, hinge: LoadedHinge) -> Option<Length> {
    // What is advised is computed for the pressures of the shells. Beyond them the pull is less certain, and no rounder hinge may be needed.
    let radius = safe_radius(case, hinge).filter(|radius| radius.metres() > hinge.radius(case))?;
    let round = Case { mechanism: mechanism(&StarDesign::with_radii(spec, star, radius)?), ..*case };
    let pressure = case.pressure?;
    (is_modelled(&round, pressure) || !is_modelled(case, pressure)).then_some(radius)
}

/// The remedy for a hinge whose seal bursts.
pub fn remedy(safe: Option<Length>) -> String {
    match safe {
        Some(radius) => format!("a radius of {radius} would hold"),
        None => {
            "less pressure, a narrower tube or a stronger seal: no radius of such a star is known to be enough"
                .to_owned()
        }
    }
}

/// The load at one kind of place of a star's seal.
#[derive(Clone, Debug, PartialEq)]
pub struct SealLoad {
    /// The loaded place.
    pub place: &'static str,
    /// The radius that the band makes; `None` on straight parts.
    pub radius: Option<Length>,
    /// Pull over p W; `None` if the ring has no solution there, or no pressure is given.
    pub factor: Option<f64>,
    /// Pull at the pressure of `[load]`; `None` without one.
    pub load: Option<LineForce>,
    /// Range of the value; a straight tube's is exact.
    pub range: Option<[LineForce; 2]>,
    /// Peel strength with which the seal surely holds that pressure, also where the range is too uncertain to be printed.
    pub sure_strength: Option<LineForce>,
    /// Pressure at which the peel strength is reached; `None` without the strength of its seam.
    pub burst: Option<Pressure>,
    /// Range of the value; a straight tube's is exact.
    pub burst_range: Option<[Pressure; 2]>,
    /// Whether it bursts at the pressure of `[load]`.
    pub bursting: Option<Bursting>,
    /// Burst pressure over the pressure of `[load]`.
    pub margin: Option<f64>,
    /// The radius from which it certainly holds, where it does not and a radius helps.
    pub safe_radius: Option<Length>,
}

/// The loads at tips, corners, arms and inlet of `part` of `spec`, whose case is `case`.
pub fn seal_loads(spec: &Spec, case: &Case, part: &StarDesign) -> Vec<SealLoad> {
    let width = case.mechanism.width;
    let channel = part.channel.map(|channel| Length(2.0 * channel.half_width).metres());
    let (tips, corners) = (Some(LoadedHinge::Tip), Some(LoadedHinge::Corner));
    // An arm lies between both loops, and the channel is an opening of the outer one.
    let places = [
        SealPlace { name: "tips", hinge: tips, width: Some(width), peel: case.peel.tip },
        SealPlace { name: "corners", hinge: corners, width: Some(width), peel: case.peel.corner },
        SealPlace { name: "arms", hinge: None, width: Some(width), peel: case.least_peel() },
        SealPlace { name: "inlet", hinge: None, width: channel, peel: case.peel.corner },
    ];
    places.iter().filter_map(|place| place.load(spec, case, &part.star)).collect()
}

/// A kind of place of a star with a seal.
struct SealPlace {
    name: &'static str,
    /// The hinge there; `None` at a straight tube.
    hinge: Option<LoadedHinge>,
    /// Width of the tube, m; `None` if the star has no such place.
    width: Option<f64>,
    /// Peel strength of its seam, N per m.
    peel: Option<f64>,
}

impl SealPlace {
    /// The load there, on the seal of `star` of `spec`, whose case is `case`.
    fn load(&self, spec: &Spec, case: &Case, star: &Star) -> Option<SealLoad> {
        // A hinge has a predicted pull with a range, a straight tube an exact one. Pull and burst pressure follow from it
        // where pressure and peel strength are known, the safe radius where the hinge may burst.
        let Self { name, hinge, width, peel } = *self;
        let width = width?;
        let seal = hinge.map(|hinge| HingeSeal::new(case, hinge, &Ring));
        // Pull, its range, and the strength that surely holds it: of a straight tube they are one.
        let pulled = case.pressure.and_then(|p| {
            if let Some(seal) = seal {
                let load = pull(case, seal?, p);
                let load_range = range(case, seal?, p).map(|range| scaled(range, load));
                Some((load, load_range, sure_strength(case, seal?, p)))
            } else {
                let load = FRAC_1_PI * p * width;
                Some((load, Some([load; 2]), load))
            }
        });
        let burst = peel.and_then(|peel| match seal {
            Some(seal) => Some((bursting(case, seal?, peel), burst_bounds(case, seal?))),
            None => Some((PI * peel / width, Some([PI * peel / width; 2]))),
        });
        let (burst, bounds) = burst.map_or((None, None), |(burst, bounds)| (Some(burst), bounds));
        let burst_range = bounds.filter(|_| hinge.is_none_or(|hinge| is_tried(case, hinge.radius(case))));
        let margin = burst.zip(case.pressure).map(|(burst, p)| burst / p);
        let bursting = burst.zip(case.pressure).map(|(burst, p)| Bursting::at_pressure(p, burst, bounds));
        let weak_hinge = hinge.filter(|_| bursting.is_some_and(|bursting| bursting != Bursting::No));
        Some(SealLoad {
            place: name,
            radius: hinge.map(|hinge| Length::from_metres(hinge.radius(case))),
            factor: pulled.zip(case.pressure).map(|((load, ..), p)| load / (p * width)),
            load: pulled.map(|(load, ..)| LineForce::from_newtons_per_metre(load)),
            range: pulled
                .and_then(|(_, range, _)| range)
                .map(|range| range.map(LineForce::from_newtons_per_metre)),
            sure_strength: pulled.map(|(.., sure)| LineForce::from_newtons_per_metre(sure)),
            burst: burst.map(Pressure::from_pascals),
            burst_range: burst_range.map(|range| range.map(Pressure::from_pascals)),
            bursting,
            margin,
            safe_radius: weak_hinge.and_then(|hinge| possible_radius(spec, case, star, hinge)),
        })
    }
}

impl SealLoad {
    /// A warning about a weak seal, if there is one.
    pub fn weakness(&self) -> Option<String> {
        let (margin, bursting) = self.margin.zip(self.bursting)?;
        let remedy = match self.radius {
            Some(_) => remedy(self.safe_radius),
            None => "less pressure, a narrower tube or a stronger seal".to_owned(),
        };
        let margin = rounded_down(margin);
        match bursting {
            Bursting::No => None,
            Bursting::Perhaps => {
                let limits = match self.burst_range {
                    // Rounded outwards: the pressure lies between them.
                    Some([low, high]) => {
                        format!("it holds {:.1} to {:.1} kPa", -tenths_up(-low.0), tenths_up(high.0))
                    }
                    None => "how far it holds is unknown".to_owned(),
                };
                Some(format!(
                    "the seal may burst at the {}: {limits}, burst margin {margin:.2}; {remedy}",
                    self.place
                ))
            }
            Bursting::Yes => Some(format!("burst margin {margin:.2} at the {}; {remedy}", self.place)),
        }
    }
}

/// A margin in hundredths, never shown as larger than it is.
fn rounded_down(margin: f64) -> f64 {
    (margin * 100.0).floor() / 100.0
}

impl fmt::Display for SealLoad {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "pull on the seal at the {}", self.place)?;
        if let Some(radius) = self.radius {
            write!(f, " (radius {} mm)", Readable((radius.0 * 1000.0).round() / 1000.0))?;
        }
        match self.factor {
            Some(factor) => write!(f, ": {factor:.2} p W")?,
            None => write!(f, ": needs a pressure")?,
        }
        if let Some(load) = self.load {
            write!(f, ", {:.2} N/mm", load.0)?;
        }
        match self.range {
            Some([low, high]) if self.radius.is_some() => write!(f, ", {:.2} to {:.2}", low.0, high.0)?,
            None if self.load.is_some() => write!(f, ", range unknown")?,
            _ => (),
        }
        if let Some(burst) = self.burst {
            write!(f, ", bursts at {:.1} kPa", burst.0)?;
        }
        if let Some(margin) = self.margin {
            write!(f, ", margin {:.2}", rounded_down(margin))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
