//! The pressure at which a seal peels, with its range, and what that says at another pressure.

use crate::case::Case;
use crate::interval::Interval;
use crate::ranges::shown;
use crate::seal_load::pull::{
    BENDABILITY, HingeSeal, LoadedHinge, bounds, edge, hardest, is_tried, pull, widest,
};
use inflatable::mechanics::hinge::HingeModel;
use inflatable::mechanics::hinge::ring::Ring;
use inflatable::numerics::last_holding;
use spec::units::Pressure;
use std::f64::consts::FRAC_1_PI;

/// Whether a seal bursts. The range that it is judged by is wider than any that is printed where hinges are sharper than the shells'.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bursting {
    /// Nowhere in the range of its burst pressure.
    No,
    /// Within the range it may; without a range, below the predicted burst pressure.
    Perhaps,
    /// Yes, over the whole range; without a range, above the predicted burst pressure.
    Yes,
}

impl Bursting {
    /// At the pressure `pressure` of a seal that bursts at `burst`, with the range of that; all in one unit.
    pub fn at_pressure(pressure: f64, burst: f64, range: Option<Interval>) -> Self {
        let [low, high] = range.unwrap_or([0.0, burst]);
        match pressure {
            _ if pressure > high => Self::Yes,
            _ if pressure > low => Self::Perhaps,
            _ => Self::No,
        }
    }
}

/// The finding that a seal, which bursts at `burst` kPa, with its range if that is known, certainly bursts at `pressure`.
pub fn bursts_at(pressure: Pressure, burst: f64, range: Option<Interval>) -> String {
    let with_range = |range| shown::with_limit(burst, range, "kPa", Some(pressure.0));
    let burst = range.map_or_else(|| Pressure(burst).to_string(), with_range);
    format!("the pressure is {pressure}, and the seal is predicted to burst at {burst}")
}

/// The seal of the hinges that peels first: the one with the largest pull, or with the largest part of its strength where tips and corners
/// are sealed by processes of different strength. `None` as of [`hardest`], or if a strength is unknown.
fn weakest(case: &Case, ring: &dyn HingeModel) -> Option<HingeSeal> {
    let (tip_peel, corner_peel) = (case.peel.tip?, case.peel.corner?);
    if tip_peel == corner_peel {
        return hardest(case, ring);
    }
    let hinges = [(LoadedHinge::Tip, tip_peel), (LoadedHinge::Corner, corner_peel)];
    let [tip, corner] = hinges.map(|(hinge, peel)| {
        let seal = HingeSeal::new(case, hinge, ring)?;
        Some((bursting(case, seal, peel), seal))
    });
    let (tip, corner) = (tip?, corner?);
    Some(if tip.0 <= corner.0 { tip.1 } else { corner.1 })
}

/// The hinges whose loop opens first, where the two loops have different strengths; `None` where they have one, or one is unknown.
pub fn first_to_open(case: &Case) -> Option<LoadedHinge> {
    weakest(case, &Ring).filter(|_| case.peel.tip != case.peel.corner).map(|seal| seal.hinge)
}

/// Pressure (Pa) at which the seal peels at its weakest hinge; `None` without a peel strength.
pub fn burst(case: &Case, ring: &dyn HingeModel) -> Option<f64> {
    let seal = weakest(case, ring)?;
    Some(bursting(case, seal, seal.hinge.peel(case)?))
}

/// The range of [`burst`], from that of the pull at this pressure; `None` where no shell had a hinge nearly as sharp.
pub fn burst_range(case: &Case) -> Option<Interval> {
    let seal = weakest(case, &Ring)?;
    if is_tried(case, seal.radius) { burst_bounds(case, seal) } else { None }
}

/// The burst range of the weakest hinge, however sharp, to judge the seal by.
pub(crate) fn weakest_bounds(case: &Case) -> Option<Interval> {
    burst_bounds(case, weakest(case, &Ring)?)
}

/// The range of the burst pressure (Pa) of a hinge; `None` without a peel strength.
///
/// At its lower end the upper end of the pull is the seal's strength. So a pressure lies below the range if the seal bears the range of the pull
/// there, whatever is known of the pull at the burst pressure. At its upper end the lower end of the pull reaches the strength first, so a
/// pressure lies above the range if the seal bears nothing of the range of the pull there.
pub(super) fn burst_bounds(case: &Case, seal: HingeSeal) -> Option<Interval> {
    let peel = seal.hinge.peel(case)?;
    let predicted = bursting(case, seal, peel);
    let [_, high] = judged_range(case, seal, predicted);
    // The pull is known best at the shells' pressures, which may lie between the two. After 50 rounds they differ by rounding.
    let holding = last_holding(bursting(case, seal, peel / high), predicted, 50, |pressure| {
        let factor = bounds(case, seal, pressure).map_or(high, |[_, end]| high.min(end));
        factor * pull(case, seal, pressure) <= peel
    });
    // The lower end of the pull grows with the pressure up to the edge, falls where the range widens, and grows on.
    let edge_pressure = edge(case, seal.radius);
    let [low, _] = widest(case, seal, predicted);
    let peeling = last_holding(bursting(case, seal, peel / low), predicted, 50, |pressure| {
        let pulls = [pressure, pressure.min(edge_pressure)].map(|p| least_pull(case, seal, p));
        pulls[0].max(pulls[1]) >= peel
    });
    Some([holding, peeling])
}

/// The range of the pull at `pressure` (Pa), as factors, by which a seal is judged also far from the shells.
fn judged_range(case: &Case, seal: HingeSeal, pressure: f64) -> Interval {
    bounds(case, seal, pressure).unwrap_or_else(|| widest(case, seal, pressure))
}

/// The lower end of the pull at `pressure` (Pa), N per m.
fn least_pull(case: &Case, seal: HingeSeal, pressure: f64) -> f64 {
    judged_range(case, seal, pressure)[0] * pull(case, seal, pressure)
}

/// The peel strength (N per m) with which the seal of a hinge surely holds `pressure` (Pa): the upper end of the range of its pull.
pub(super) fn sure_strength(case: &Case, seal: HingeSeal, pressure: f64) -> f64 {
    judged_range(case, seal, pressure)[1] * pull(case, seal, pressure)
}

/// The pressure (Pa) at which the pull at a hinge is `peel` (N per m): the pull grows with the pressure, and less than in proportion.
pub(super) fn bursting(case: &Case, seal: HingeSeal, peel: f64) -> f64 {
    // pull = tube p + bending p^(1 - BENDABILITY): between two powers of p, so Newton's method in logarithms gains digits from the start, and
    // the sixth step finds rounding only. The start is the straight tube's pressure.
    let tube = FRAC_1_PI * case.mechanism.width;
    let bending = pull(case, seal, 1.0) - tube;
    let mut pressure = peel / tube;
    for _ in 0..6 {
        let bending_load = bending * libm::pow(pressure, 1.0 - BENDABILITY);
        let load = tube * pressure + bending_load;
        let slope = (tube * pressure + (1.0 - BENDABILITY) * bending_load) / load;
        let next = pressure * libm::pow(peel / load, slope.recip());
        // Every further step would find the same.
        if next == pressure {
            break;
        }
        pressure = next;
    }
    pressure
}

/// The pressure (Pa) at which a seam of strength `peel` (N per m) peels, with its range. `pull` and its mesh error `error` are the shell's at
/// `pressure` (Pa), N per m. `None` without a pull.
///
/// The value assumes a pull in proportion to the pressure. The range includes the mesh error and a pull that grows with p^(1 -
/// `BENDABILITY`) only, as at the hinges of stars.
pub fn burst_of_drawn(peel: f64, pressure: f64, [pull, error]: [f64; 2]) -> Option<(f64, Interval)> {
    let smallest = (pull - error).max(LEAST_PULL * pull);
    if smallest.is_nan() || smallest <= 0.0 {
        return None;
    }
    let ratios = [pull + error, smallest].map(|pull| peel / pull);
    let ends = ratios.map(|ratio| [ratio, libm::pow(ratio, (1.0 - BENDABILITY).recip())]).concat();
    let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let high = ends.iter().copied().fold(0.0, f64::max);
    Some((pressure * peel / pull, [low, high].map(|times| pressure * times)))
}

/// The least part of a pull that a mesh error leaves of it.
const LEAST_PULL: f64 = 0.1;
