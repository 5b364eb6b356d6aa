//! The pressure at which a seal peels, with its range, and what that says at another pressure.

use crate::case::Case;
use crate::interval::Interval;
use crate::ranges::shown;
use crate::seal_load::pull::{
    BENDABILITY, LoadedHinge, bounds, edge, factor, hardest, is_tried, pull, widest,
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
    pub fn at(pressure: f64, burst: f64, range: Option<Interval>) -> Self {
        let [least, most] = range.unwrap_or([0.0, burst]);
        match pressure {
            _ if pressure > most => Self::Yes,
            _ if pressure > least => Self::Perhaps,
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

/// The kind of hinge whose seal peels first, its inner radius, m, and `k` there: the one with the largest pull, or with the largest part
/// of its strength where tips and corners are sealed by processes of different strength. `None` as of [`hardest`].
fn weakest(case: &Case, ring: &dyn HingeModel) -> Option<(f64, (LoadedHinge, f64))> {
    let (Some(tip_peel), Some(corner_peel)) = (case.peel.tip, case.peel.corner) else {
        return hardest(case, ring);
    };
    if tip_peel == corner_peel {
        return hardest(case, ring);
    }
    let loaded = |hinge: LoadedHinge, peel: f64| {
        let placed = (hinge, hinge.radius(case));
        let k = factor(ring, placed.1 / case.mechanism.width)?;
        Some((bursting(case, k, placed, peel), (k, placed)))
    };
    let (tip, corner) = (loaded(LoadedHinge::Tip, tip_peel)?, loaded(LoadedHinge::Corner, corner_peel)?);
    Some(if tip.0 <= corner.0 { tip.1 } else { corner.1 })
}

/// Pressure (Pa) at which the seal peels at its weakest hinge; `None` without a peel strength.
pub fn burst(case: &Case, ring: &dyn HingeModel) -> Option<f64> {
    let (k, hinge) = weakest(case, ring)?;
    Some(bursting(case, k, hinge, hinge.0.peel(case)?))
}

/// The range of [`burst`], from that of the pull at this pressure; `None` where no shell had a hinge nearly as sharp.
pub fn burst_range(case: &Case) -> Option<Interval> {
    let (k, hinge) = weakest(case, &Ring)?;
    if is_tried(case, hinge.1) { burst_bounds(case, k, hinge) } else { None }
}

/// The burst range of any hinge, to judge the seal by.
pub(crate) fn hardest_bounds(case: &Case) -> Option<Interval> {
    let (k, hinge) = weakest(case, &Ring)?;
    burst_bounds(case, k, hinge)
}

/// The range of the burst pressure (Pa) of a hinge; `None` without a peel strength.
///
/// At its lower end the upper end of the pull is the seal's strength. So a pressure lies below the range if the seal bears the range of the pull
/// there, whatever is known of the pull at the burst pressure. At its upper end the lower end of the pull reaches the strength first, so a
/// pressure lies above the range if the seal bears nothing of the range of the pull there.
pub(super) fn burst_bounds(case: &Case, k: f64, hinge: (LoadedHinge, f64)) -> Option<Interval> {
    let peel = hinge.0.peel(case)?;
    let burst_at = |part: f64| bursting(case, k, hinge, peel / part);
    let range =
        |pressure: f64| bounds(case, k, hinge, pressure).unwrap_or_else(|| widest(case, k, hinge, pressure));
    let predicted = burst_at(1.0);
    let [_, high] = range(predicted);
    // The pull is known best at the shells' pressures, which may lie between the two. After 50 rounds they differ by rounding.
    let sure = last_holding(burst_at(high), predicted, 50, |pressure| {
        let most = bounds(case, k, hinge, pressure).map_or(high, |[_, own]| high.min(own));
        most * pull(case, k, hinge, pressure) <= peel
    });
    // The lower end of the pull grows with the pressure up to the edge, falls where the range widens, and grows on.
    let least = |pressure: f64| range(pressure)[0] * pull(case, k, hinge, pressure);
    let edge = edge(case, hinge.1);
    let [low, _] = widest(case, k, hinge, predicted);
    let certain = last_holding(burst_at(low), predicted, 50, |pressure| {
        least(pressure).max(least(pressure.min(edge))) >= peel
    });
    Some([sure, certain])
}

/// The peel strength (N per m) with which the seal of a hinge surely holds `pressure` (Pa): the upper end of the range of its pull.
pub(super) fn sure_strength(case: &Case, k: f64, hinge: (LoadedHinge, f64), pressure: f64) -> f64 {
    let range = bounds(case, k, hinge, pressure).unwrap_or_else(|| widest(case, k, hinge, pressure));
    range[1] * pull(case, k, hinge, pressure)
}

/// The pressure (Pa) at which the pull at a hinge is `peel` (N per m): the pull grows with the pressure, and less than in proportion.
pub(super) fn bursting(case: &Case, k: f64, hinge: (LoadedHinge, f64), peel: f64) -> f64 {
    // pull = tube p + bent p^(1 - BENDABILITY): between two powers of p, so Newton's method in logarithms gains digits from the start, and
    // the sixth step finds rounding only. The start is the straight tube's pressure.
    let tube = FRAC_1_PI * case.mechanism.width;
    let bent = pull(case, k, hinge, 1.0) - tube;
    let mut pressure = peel / tube;
    for _ in 0..6 {
        let bent = bent * libm::pow(pressure, 1.0 - BENDABILITY);
        let load = tube * pressure + bent;
        let slope = (tube * pressure + (1.0 - BENDABILITY) * bent) / load;
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
    Some((pressure * peel / pull, [low, high].map(|times| pressure * times)))
}

/// The least part of a pull that a mesh error leaves of it.
const LEAST_PULL: f64 = 0.1;
