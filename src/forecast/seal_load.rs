//! The load of the pressure on the seal, and the strength of the seal.
//!
//! The **pull on the seal** is the force with which one sheet pulls away from the seam's plane, per length of
//! seam: that of one leg of a T-peel test. The pull within the plane is the same in both sheets; the
//! fused band carries it as fabric, without peeling. A straight tube pulls with p W / pi. The inner rim
//! of a hinge is short and bears the pressure on a whole sector, so it pulls harder, most at the ends of its
//! arc. There is no closed form: [`pull`] takes the tension k p W of the membrane [`Ring`], less the straight
//! tube's, and four numbers from shells (docs/models.md). It is the mean over a piece of seam as long as the
//! band is wide, because a leak has to cross the band. R* = R / W is that of the radius that the band really
//! makes.

use crate::design::{Star, StarDesign};
use crate::forecast::case::{Case, Hinges, mechanism};
use crate::forecast::pressures::is_modelled;
use crate::forecast::ranges::{Interval, TriedRatio, errors, scaled, shown, widening};
use crate::units::{Length, LineForce, Pressure, Readable};
use inflatable::mechanics::hinge::ring::Ring;
use inflatable::mechanics::hinge::{HingeModel, seal_load};
use std::f64::consts::{FRAC_1_PI, PI};
use std::fmt;

/// A kind of hinge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadedHinge {
    /// The tips' inner rims.
    Tip,
    /// The reentrant corners'.
    Corner,
}

impl LoadedHinge {
    /// Its name in messages.
    fn place(self) -> &'static str {
        match self {
            Self::Tip => "tips",
            Self::Corner => "corners",
        }
    }

    /// The part of the hinge's pull beyond the straight tube's, over the ring's, with R = w and 1/eps = 1000:
    /// a corner turns less.
    fn excess(self) -> f64 {
        match self {
            Self::Tip => 1.87,
            Self::Corner => 1.4,
        }
    }
}

/// Roundest hinge that is advised, R*: rounder than ten widths no hinge is a hinge, and its pull is within a tenth of the straight tube's.
const ROUNDEST: f64 = 10.0;
/// Sharpest hinge that is looked at, R*: there k is 1e5, more than any seal holds.
const SHARPEST: f64 = 1e-6;

/// Exponent of its decrease with w / R: a wide band evens out the pull at the ends of a hinge's arc.
const BAND: f64 = 0.29;
/// Exponent of its decrease with 1/eps / 1000: bending keeps the load at the ends of the arc.
const BENDABILITY: f64 = 0.28;
/// Least w / R of the shells: a narrower band meets the same load at the ends of an arc.
const NARROWEST: f64 = 0.2;
/// A shell's pull over the predicted one: the 58 stars that gave the numbers and 22 of 24 others lie inside
/// (docs/models.md).
pub const RANGE: Interval = [0.75, 1.35];
/// R* of those shells.
const R_STAR: Interval = [0.03, 0.3];

/// k, the tension over p W at a hinge's inner rim that cannot stretch, at R* = `r_star`, by the exact `ring` or its table; `None` outside
/// their range.
pub fn factor(ring: &dyn HingeModel, r_star: f64) -> Option<f64> {
    ring.target(r_star).ok().and_then(|state| seal_load(r_star, &state))
}

/// The largest pull (N per m) at the seal of a hinge whose inner rim has the radius `radius` (m), at `pressure` (Pa): the mean over a piece
/// of seam as long as the band is wide. `k` is [`factor`] there.
pub fn pull(case: &Case, k: f64, (hinge, radius): (LoadedHinge, f64), pressure: f64) -> f64 {
    let width = case.mechanism.width;
    let band = libm::pow((case.band / radius).max(NARROWEST), -BAND);
    let bending = libm::pow(case.sheet.bendability(pressure, width) / 1e3, -BENDABILITY);
    pressure * width * (FRAC_1_PI + (k - FRAC_1_PI).max(0.0) * hinge.excess() * band * bending)
}

/// [`RANGE`] at a hinge of radius `radius` (m) at `pressure` (Pa), wider with the distance from the shells;
/// `None` where they are far.
fn range(case: &Case, radius: f64, pressure: f64) -> Option<Interval> {
    let width = case.mechanism.width;
    let bendability = case.sheet.bendability(pressure, width);
    let places = [("", radius / width, R_STAR), ("", bendability, errors::BENDABILITY)];
    widening(&places.map(|(what, x, tried)| TriedRatio::new(what, x, tried))).map(wider)
}

/// The same at pressures too far from the shells: as wide as where ranges end. `None` where the radius is too far from them.
fn widest(case: &Case, radius: f64) -> Option<Interval> {
    let round = TriedRatio::new("", radius / case.mechanism.width, R_STAR);
    widening(&[round]).map(|_| wider(errors::BEYOND))
}

/// [`RANGE`], so much wider.
fn wider(factor: f64) -> Interval {
    RANGE.map(|part| libm::pow(part, factor))
}

/// Whether a seal bursts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bursting {
    /// Nowhere in the range of its burst pressure.
    No,
    /// Within the range it may.
    Perhaps,
    /// Yes, over the whole range; without a range, by the predicted burst pressure.
    Yes,
}

impl Bursting {
    /// At the pressure `pressure` of a seal that bursts at `burst`, with the range of that; all in one unit.
    pub fn at(pressure: f64, burst: f64, range: Option<Interval>) -> Self {
        let [least, most] = range.unwrap_or([burst; 2]);
        match pressure {
            _ if pressure > most => Self::Yes,
            _ if pressure > least => Self::Perhaps,
            _ => Self::No,
        }
    }
}

/// The finding that a seal, which bursts at `burst` kPa, with its range if that is known, certainly bursts at `pressure`.
pub fn bursts_at(pressure: Pressure, burst: f64, range: Option<Interval>) -> String {
    let burst = range.map_or_else(|| Pressure(burst).to_string(), |range| shown::with(burst, range, "kPa"));
    format!("the pressure is {pressure}, and the seal is predicted to burst at {burst}")
}

/// The kind of hinge whose seal has the largest pull, its inner radius, m, and `k` there; the same at all
/// pressures. `None` outside the range of `ring`.
fn hardest(case: &Case, ring: &dyn HingeModel) -> Option<(f64, (LoadedHinge, f64))> {
    let Hinges { tip, corner } = case.realised;
    let [tip, corner] = [(LoadedHinge::Tip, tip), (LoadedHinge::Corner, corner)].map(|hinge| {
        let k = factor(ring, hinge.1 / case.mechanism.width)?;
        Some((pull(case, k, hinge, 1.0), (k, hinge)))
    });
    let (tip, corner) = (tip?, corner?);
    Some(if tip.0 >= corner.0 { tip.1 } else { corner.1 })
}

/// The largest pull on the seal of `case` at its pressure, N per m, its range, and at which kind of hinge it is; `None` without a pressure.
pub fn largest_pull(case: &Case) -> Option<(f64, Option<Interval>, &'static str)> {
    let (pressure, (k, hinge)) = (case.pressure?, hardest(case, &Ring)?);
    let pull = pull(case, k, hinge, pressure);
    Some((pull, range(case, hinge.1, pressure).map(|range| scaled(range, pull)), hinge.0.place()))
}

/// Pressure (Pa) at which the seal peels at its hardest pulled hinge; `None` without a peel strength.
pub fn burst(case: &Case, ring: &dyn HingeModel) -> Option<f64> {
    let peel = case.peel?;
    let (k, hinge) = hardest(case, ring)?;
    Some(bursting(case, k, hinge, peel))
}

/// The range of [`burst`], from that of the pull at this pressure; `None` where no such shell was computed.
pub fn burst_range(case: &Case) -> Option<Interval> {
    let (k, hinge) = hardest(case, &Ring)?;
    hinge_burst_range(case, k, hinge)
}

/// The range of the burst pressure (Pa) of a hinge; `None` where no shell had a hinge like it.
///
/// At its lower end the upper end of the pull is the seal's strength. So a pressure lies below the range if the seal bears the range of the pull
/// there, whatever is known of the pull at the burst pressure.
fn hinge_burst_range(case: &Case, k: f64, hinge: (LoadedHinge, f64)) -> Option<Interval> {
    let peel = case.peel?;
    let at = |part: f64| bursting(case, k, hinge, peel / part);
    let mut bursts = at(1.0);
    let [low, high] = range(case, hinge.1, bursts).or_else(|| widest(case, hinge.1))?;
    let mut holds = at(high);
    // The pull is known best at the shells' pressures, which may lie between the two. Each round halves the ratio's logarithm: after 50 the
    // ends differ by rounding.
    for _ in 0..50 {
        let middle = f64::sqrt(holds * bursts);
        let most = range(case, hinge.1, middle).map_or(high, |[_, own]| high.min(own));
        if most * pull(case, k, hinge, middle) <= peel { holds = middle } else { bursts = middle }
    }
    Some([holds, at(low)])
}

/// The pressure (Pa) at which the pull at a hinge is `peel` (N per m): the pull grows with the pressure, and less than in proportion.
fn bursting(case: &Case, k: f64, hinge: (LoadedHinge, f64), peel: f64) -> f64 {
    // pull = tube p + bent p^(1 - BENDABILITY): between two powers of p, so Newton's method in logarithms gains digits from the start, and
    // the sixth step finds rounding only. The start is the straight tube's pressure.
    let tube = FRAC_1_PI * case.mechanism.width;
    let bent = pull(case, k, hinge, 1.0) - tube;
    let mut pressure = peel / tube;
    for _ in 0..6 {
        let bent = bent * libm::pow(pressure, 1.0 - BENDABILITY);
        let both = tube * pressure + bent;
        let slope = (tube * pressure + (1.0 - BENDABILITY) * bent) / both;
        let next = pressure * libm::pow(peel / both, slope.recip());
        // Every further step would find the same.
        if next == pressure {
            break;
        }
        pressure = next;
    }
    pressure
}

/// The least inner radius of `hinge` at which its seal withstands the pressure at the upper end of [`RANGE`],
/// rounded up to a hundredth of a mm, so the printed radius is safe; `None` if no radius is large enough, or
/// pressure or peel strength are unknown.
pub fn safe_radius(case: &Case, hinge: LoadedHinge) -> Option<Length> {
    let width = case.mechanism.width;
    let (allowed, pressure) = (case.peel?, case.pressure?);
    let at = |r_star: f64| {
        factor(&Ring, r_star).map(|k| RANGE[1] * pull(case, k, (hinge, r_star * width), pressure))
    };
    let (mut low, mut high) = (SHARPEST, ROUNDEST);
    if at(high)? > allowed {
        return None;
    }
    // The pull falls with R*. Each round halves the ratio's logarithm: after 60 the ends differ by rounding.
    for _ in 0..60 {
        let middle = f64::sqrt(low * high);
        if at(middle)? > allowed { low = middle } else { high = middle }
    }
    let hundredths = (Length::from_metres(high * width).0 * 100.0).ceil();
    Some(Length(hundredths / 100.0))
}

/// [`safe_radius`], if `star`, whose case is `case`, can have it at both tips and corners: it has arms then, and a prediction if
/// it has one now.
pub(super) fn possible_radius(case: &Case, star: &Star, hinge: LoadedHinge) -> Option<Length> {
    let own = match hinge {
        LoadedHinge::Tip => case.realised.tip,
        LoadedHinge::Corner => case.realised.corner,
    };
    // What is advised is computed for the pressures of the shells. Beyond them the pull is less certain, and no rounder hinge may be needed.
    let radius = safe_radius(case, hinge).filter(|radius| radius.metres() > own)?;
    let round = Case { mechanism: mechanism(&star.with_radii(radius)?), ..*case };
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
    /// Its range; a straight tube's is exact.
    pub range: Option<[LineForce; 2]>,
    /// Pressure at which the peel strength is reached; `None` without a `seal_strength`.
    pub burst: Option<Pressure>,
    /// Its range; a straight tube's is exact.
    pub burst_range: Option<[Pressure; 2]>,
    /// Whether it bursts at the pressure of `[load]`.
    pub bursting: Option<Bursting>,
    /// Burst pressure over the pressure of `[load]`.
    pub margin: Option<f64>,
    /// The radius from which it certainly holds, where it does not and a radius helps.
    pub safe_radius: Option<Length>,
}

/// The loads at tips, corners, arms and inlet of `part`, whose case is `case`.
pub fn seal_loads(case: &Case, part: &StarDesign) -> Vec<SealLoad> {
    let width = case.mechanism.width;
    let channel = part.channel.map(|channel| Length(2.0 * channel.half_width).metres());
    let places = [
        ("tips", Some((LoadedHinge::Tip, case.realised.tip)), Some(width)),
        ("corners", Some((LoadedHinge::Corner, case.realised.corner)), Some(width)),
        ("arms", None, Some(width)),
        ("inlet", None, channel),
    ];
    let with_width = places.into_iter().filter_map(|(place, hinge, width)| Some((place, hinge, width?)));
    with_width.map(|(place, hinge, width)| at_place((case, &part.star), place, hinge, width)).collect()
}

fn at_place(
    (case, star): (&Case, &Star),
    place: &'static str,
    hinge: Option<(LoadedHinge, f64)>,
    width: f64,
) -> SealLoad {
    let k = hinge.map(|hinge| (hinge, factor(&Ring, hinge.1 / width)));
    let at = |pressure: f64| match k {
        Some((hinge, k)) => k.map(|k| pull(case, k, hinge, pressure)),
        None => Some(FRAC_1_PI * pressure * width),
    };
    let load = case.pressure.and_then(at);
    let pull_range = load.zip(case.pressure).and_then(|(load, p)| match hinge {
        Some((_, radius)) => range(case, radius, p).map(|range| scaled(range, load)),
        None => Some([load; 2]),
    });
    let burst = case.peel.and_then(|peel| match k {
        Some((hinge, k)) => k.map(|k| bursting(case, k, hinge, peel)),
        None => Some(PI * peel / width),
    });
    let burst_range = burst.and_then(|burst| match k {
        Some((hinge, k)) => hinge_burst_range(case, k?, hinge),
        None => Some([burst; 2]),
    });
    let margin = burst.zip(case.pressure).map(|(burst, p)| burst / p);
    let bursting = burst.zip(case.pressure).map(|(burst, p)| Bursting::at(p, burst, burst_range));
    let weak = hinge.filter(|_| bursting.is_some_and(|one| one != Bursting::No));
    SealLoad {
        place,
        radius: hinge.map(|(_, radius)| Length::from_metres(radius)),
        factor: load.zip(case.pressure).map(|(load, p)| load / (p * width)),
        range: pull_range.map(|range| range.map(LineForce::from_newtons_per_metre)),
        load: load.map(LineForce::from_newtons_per_metre),
        burst: burst.map(Pressure::from_pascals),
        burst_range: burst_range.map(|range| range.map(Pressure::from_pascals)),
        bursting,
        margin,
        safe_radius: weak.and_then(|(hinge, _)| possible_radius(case, star, hinge)),
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
                let [low, high] = self.burst_range.unwrap_or_default().map(|p| p.0);
                Some(format!(
                    "the seal may burst at the {}: it holds {low:.1} to {high:.1} kPa, burst margin {margin:.2}; {remedy}",
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

/// Inputs of a drawn seal, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnSeal {
    /// Gauge pressure of the shell, Pa.
    pub pressure: f64,
    /// Peel strength, N per m.
    pub peel: Option<f64>,
}

impl DrawnSeal {
    /// The pressure (Pa) at which a seam peels, with its range. `pull` and its mesh error `error` are the shell's at [`DrawnSeal::pressure`],
    /// N per m. `None` without a peel strength, or without a pull.
    ///
    /// The value assumes a pull in proportion to the pressure. The range includes the mesh error and a pull that grows with p^(1 -
    /// `BENDABILITY`) only, as at the hinges of stars.
    pub fn burst(&self, pull: f64, error: f64) -> Option<(f64, Interval)> {
        let peel = self.peel?;
        let bound = |pull: f64| {
            let ratio = peel / pull;
            [ratio, libm::pow(ratio, (1.0 - BENDABILITY).recip())]
        };
        let least = (pull - error).max(LEAST_PULL * pull);
        if least.is_nan() || least <= 0.0 {
            return None;
        }
        let ends = [bound(pull + error), bound(least)].concat();
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(0.0, f64::max);
        Some((self.pressure * peel / pull, [low, high].map(|times| self.pressure * times)))
    }
}

/// The least part of a pull that a mesh error leaves of it.
const LEAST_PULL: f64 = 0.1;

#[cfg(test)]
mod tests;
