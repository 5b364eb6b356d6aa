//! The pull on the seal at the inner rims of hinges, with its range.
//!
//! The **pull on the seal** is the force with which one sheet pulls away from the seam's plane, per length of
//! seam: that of one leg of a T-peel test. The pull within the plane is the same in both sheets; the
//! fused band carries it as fabric, without peeling. A straight tube pulls with p W / pi. The inner rim
//! of a hinge is short and bears the pressure on a whole sector, so it pulls harder, most at the ends of its
//! arc. There is no closed form: [`pull`] takes the tension k p W of the membrane [`Ring`], less the straight
//! tube's, and four numbers from shells (docs/models.md). It is the mean over a piece of seam as long as the
//! band is wide, because a leak has to cross the band. R* = R / W is that of the radius that the band really
//! makes.

use crate::case::Case;
use crate::interval::{Interval, scaled};
use crate::ranges::{TriedRatio, errors, widening};
use inflatable::mechanics::hinge::ring::Ring;
use inflatable::mechanics::hinge::{HingeModel, seal_load};
use std::f64::consts::FRAC_1_PI;
use std::sync::LazyLock;

/// A kind of hinge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadedHinge {
    /// The tips' inner rims.
    Tip,
    /// The reentrant corners'.
    Corner,
}

impl LoadedHinge {
    /// Peel strength of its seam, N per m; `None` if unknown.
    pub(super) fn peel(self, case: &Case) -> Option<f64> {
        match self {
            Self::Tip => case.peel.tip,
            Self::Corner => case.peel.corner,
        }
    }

    /// Name in messages.
    pub(super) fn place(self) -> &'static str {
        match self {
            Self::Tip => "tips",
            Self::Corner => "corners",
        }
    }

    /// The radius, m, that the band makes of its inner rim.
    pub(super) fn radius(self, case: &Case) -> f64 {
        match self {
            Self::Tip => case.realised.tip,
            Self::Corner => case.realised.corner,
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

/// The seal at the inner rims of one kind of hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeSeal {
    /// The kind of hinge.
    pub hinge: LoadedHinge,
    /// Radius, m, that the band makes of the inner rim.
    pub radius: f64,
    /// [`factor`] there.
    pub k: f64,
}

impl HingeSeal {
    /// The seal at a `hinge` of the star of `case`; `None` outside the range of `ring`.
    pub(super) fn new(case: &Case, hinge: LoadedHinge, ring: &dyn HingeModel) -> Option<Self> {
        let radius = hinge.radius(case);
        Some(Self { hinge, radius, k: factor(ring, radius / case.mechanism.width)? })
    }
}

/// Exponents of its decrease with w / R, where the band is wider than R and where it is narrower: a wide band evens out the pull at the ends of a
/// hinge's arc. With 0.29 for both, round hinges pulled 11 % harder than predicted, and with 0.4 for narrow bands 6 % (crates/research/pull.py).
const WIDE_BAND: f64 = 0.29;
const NARROW_BAND: f64 = 0.46;
/// Exponent of its decrease with 1/eps / 1000: bending keeps the load at the ends of the arc.
pub(super) const BENDABILITY: f64 = 0.28;
/// Least w / R of the shells: a narrower band meets the same load at the ends of an arc.
const NARROWEST: f64 = 0.2;
/// A shell's pull over the predicted one where the band is at least `WIDE` times as wide as the hinge's radius: all 58 of such stars of 132 lie
/// inside (docs/models.md).
pub const RANGE: Interval = [0.75, 1.35];
/// The pull over the predicted one where the band is at most [`NARROW`] times as wide: a narrow band feels the ends of a hinge's arc, where the
/// pull changes from star to star. 72 of the other 74 stars lie inside.
const NARROW_RANGE: Interval = [0.64, 1.55];
/// w / R between which one range becomes the other.
const WIDE: f64 = 0.8;
const NARROW: f64 = 0.5;
/// R* of those shells.
pub(super) const R_STAR: Interval = [0.03, 0.3];

/// k, the tension over p W at a hinge's inner rim that cannot stretch, at R* = `r_star`, by the exact `ring` or its table; `None` outside
/// their range.
pub fn factor(ring: &dyn HingeModel, r_star: f64) -> Option<f64> {
    ring.target(r_star).ok().and_then(|state| seal_load(r_star, &state))
}

/// The largest pull (N per m) at the `seal` of a hinge at `pressure` (Pa): the mean over a piece of seam as long as the band is wide.
pub fn pull(case: &Case, seal: HingeSeal, pressure: f64) -> f64 {
    let HingeSeal { hinge, radius, k } = seal;
    let width = case.mechanism.width;
    let ratio = (case.band / radius).max(NARROWEST);
    let band = libm::pow(ratio, if ratio < 1.0 { -NARROW_BAND } else { -WIDE_BAND });
    let bending = libm::pow(case.sheet.bendability(pressure, width) / 1e3, -BENDABILITY);
    pressure * width * (FRAC_1_PI + (k - FRAC_1_PI).max(0.0) * hinge.excess() * band * bending)
}

/// The range of [`pull`] with the same arguments, wider with the distance from the shells; `None` where they are far.
pub(super) fn range(case: &Case, seal: HingeSeal, pressure: f64) -> Option<Interval> {
    bounds(case, seal, pressure).filter(|_| is_tried(case, seal.radius))
}

/// Whether shells had hinges nearly as sharp as one of radius `radius` (m).
pub(super) fn is_tried(case: &Case, radius: f64) -> bool {
    widening(&[roundness(case, radius)]).is_some()
}

/// The range of the pull at hinges of any radius, to judge seals by; `None` at pressures that are far from the shells'.
pub(super) fn bounds(case: &Case, seal: HingeSeal, pressure: f64) -> Option<Interval> {
    let bendability = case.sheet.bendability(pressure, case.mechanism.width);
    let wider = widening(&[TriedRatio::new("", bendability, errors::BENDABILITY)])?;
    Some(of_hinge(case, seal, pressure, wider))
}

/// The range of the pull at pressures too far from the shells: as wide as where ranges end.
pub(super) fn widest(case: &Case, seal: HingeSeal, pressure: f64) -> Interval {
    of_hinge(case, seal, pressure, errors::BEYOND)
}

/// The largest pressure, Pa, at which the range at a hinge of radius `radius` (m) is not wider for the pressure.
pub(super) fn edge(case: &Case, radius: f64) -> f64 {
    let distance = (roundness(case, radius).widens_on() - 1.0) / (errors::BEYOND - 1.0);
    let bendability = errors::BENDABILITY[1] * libm::pow(errors::NOT_FAR, distance.min(1.0));
    bendability / case.sheet.bendability(1.0, case.mechanism.width)
}

/// A shell's pull over the predicted one, for a band of `ratio` times the hinge's radius: [`RANGE`], and wider for a narrow band.
pub fn tried_range(ratio: f64) -> Interval {
    let share = (libm::log(WIDE / ratio) / libm::log(WIDE / NARROW)).clamp(0.0, 1.0);
    [0, 1].map(|end: usize| RANGE[end] * libm::pow(NARROW_RANGE[end] / RANGE[end], share))
}

/// [`tried_range`] where it is `factor` times as wide for the pressure. A hinge rounder than [`ROUND`] is nearer to a straight tube, whose pull is
/// exact: what its pull is beyond that is as uncertain as there.
fn of_hinge(case: &Case, seal: HingeSeal, pressure: f64, factor: f64) -> Interval {
    static K: LazyLock<Option<f64>> = LazyLock::new(|| self::factor(&Ring, ROUND));
    let (width, last) = (case.mechanism.width, ROUND * case.mechanism.width);
    let range = errors::widened(
        tried_range(case.band / seal.radius),
        factor.max(roundness(case, seal.radius).widens_on()),
    );
    let Some(least_round) = K.filter(|_| seal.radius > last) else { return range };
    let tube = FRAC_1_PI * pressure * width;
    let roundest_seal = HingeSeal { radius: last, k: least_round, ..seal };
    let (predicted, roundest) = (pull(case, seal, pressure), pull(case, roundest_seal, pressure));
    let part = (predicted - tube) / (roundest - tube);
    range.map(|end| (tube + (end * roundest - tube) * part) / predicted)
}

/// R* of the roundest hinge to which ranges widen.
const ROUND: f64 = R_STAR[1] * errors::NOT_FAR;

/// R* of a hinge of radius `radius` (m) among those of the shells; of one rounder than [`ROUND`] that.
fn roundness(case: &Case, radius: f64) -> TriedRatio {
    TriedRatio::new("", (radius / case.mechanism.width).min(ROUND), R_STAR)
}

/// The seal of the hinges with the largest pull; the same at all pressures. `None` outside the range of `ring`.
pub(super) fn hardest(case: &Case, ring: &dyn HingeModel) -> Option<HingeSeal> {
    let [tip, corner] = [LoadedHinge::Tip, LoadedHinge::Corner].map(|hinge| {
        let seal = HingeSeal::new(case, hinge, ring)?;
        Some((pull(case, seal, 1.0), seal))
    });
    let (tip, corner) = (tip?, corner?);
    Some(if tip.0 >= corner.0 { tip.1 } else { corner.1 })
}

/// The largest pull on the seal of `case` at its pressure, N per m, its range, and at which kind of hinge it is; `None` without a pressure.
pub fn largest_pull(case: &Case) -> Option<(f64, Option<Interval>, &'static str)> {
    let (pressure, seal) = (case.pressure?, hardest(case, &Ring)?);
    let load = pull(case, seal, pressure);
    Some((load, range(case, seal, pressure).map(|range| scaled(range, load)), seal.hinge.place()))
}
