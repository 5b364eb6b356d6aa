//! A **range** for each predicted quantity: the interval in which the value of a computed shell lies in at least 95 % of cases.
//!
//! A range is made of the errors of `section` with its correction against stars computed as shells ([`errors`]),
//! so it has a sign. It applies within the validated domain; outside it widens with the distance, up to
//! [`errors::BEYOND`] times; further out there is none. [`Domain`] distinguishes the three cases. The limits
//! of high pressure, `fit`, `ring` and `bvp`, have no range: no gripper works there.

pub mod errors;
mod interval;
pub mod shown;

pub use interval::{Interval, mm, scaled, sum};

use crate::forecast::case::{Case, Hinges};
use crate::units::Readable;
use inflatable::mechanics::hinge::{HingeModel, Level};
use inflatable::mechanics::star::response::{Inflated, Rest};
use serde::Serialize;
use std::f64::consts::PI;

/// Position of a star relative to the validated domain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Domain {
    /// Stars all around it were computed as shells.
    Validated,
    /// It lies outside of the validated domain, and not far: ranges are wider.
    Extrapolated,
    /// No computed star is similar, or the model is a limit.
    #[default]
    Unknown,
}

/// Ranges of one star, SI units; `None` if unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ranges {
    /// Domain of the star on which they depend.
    pub domain: Domain,
    /// Factor on their widths compared with the validated domain: from 1 to [`errors::BEYOND`].
    pub wider: f64,
    /// Range of the final radius, m.
    pub radius: Option<Interval>,
    /// Range of the tips' angle at rest, rad; `None` also where arms touch, because contact is part of that equilibrium.
    pub angle: Option<Interval>,
    /// Range of the hinges' stiffness, as factors of it.
    pub hinge: Option<Interval>,
    /// Range of the radial stiffness, N per m; `None` also where arms touch.
    pub stiffness: Option<Interval>,
}

impl Ranges {
    /// Ranges of a star that rests at `rest`.
    pub fn new(case: &Case, inflated: &Inflated<'_>, rest: &Rest) -> Self {
        let Some((domain, wider)) = domain(case, inflated.model()) else { return Self::default() };
        let about =
            |value: f64, errors: Interval, scale: f64| errors.map(|error| value + wider * error * scale);
        let star = &case.mechanism;
        let long = star.arm / star.width;
        let unit = errors::radius_unit(star.points) * star.width / libm::sin(PI / f64::from(star.points));
        let stiffer = wider * errors::stiffness_unit(star.points, long);
        // Arms that touch press on each other; hinge models do not include the effect on the stiffness.
        let free = rest.equilibrium > star.correction.contact_angle;
        let radius = about(rest.radius, errors::RADIUS, unit).map(|end| end.max(0.0));
        let angle = about(rest.equilibrium, errors::ANGLE, angle_unit(long));
        Self {
            domain,
            wider,
            radius: Some(radius),
            angle: (angle[0] > star.correction.contact_angle).then_some(angle),
            hinge: Some(errors::HINGE.map(|part| libm::pow(part, wider))),
            stiffness: free.then(|| errors::STIFFNESS.map(|part| rest.stiffness * libm::pow(part, stiffer))),
        }
    }

    /// The same bounded by `edge`, the ranges of the star at its [`pressure_edge`]; `rests` are the final
    /// radii at the star's own pressure and at the edge, m.
    ///
    /// If the model closes the star further than at the edge, a shell closes it at least as far; if the model opens it,
    /// a shell opens it by no more. So the upper end of the final radius stops widening with the pressure.
    #[must_use]
    pub fn bounded(self, edge: &Self, [here, there]: [f64; 2]) -> Self {
        let bound =
            |[near, far]: Interval, [_, most]: Interval| [near, far.min(most + (here - there).max(0.0))];
        Self {
            radius: self.radius.zip(edge.radius).map_or(self.radius, |(own, edge)| Some(bound(own, edge))),
            ..self
        }
    }

    /// Range of the radial force on an object of radius `rho` (m) within the star `inflated`, which rests at `rest`; `None` where arms
    /// touch, and
    /// where shells were not opened so far.
    pub fn force(&self, inflated: &Inflated<'_>, rho: f64, rest: &Rest) -> Option<Interval> {
        let star = inflated.star();
        let ([near, far], _) = self.radius.zip(self.stiffness)?;
        let opened = (rho - rest.radius) / star.width;
        if opened > errors::NOT_FAR * errors::OPENING {
            return None;
        }
        // An opening beyond the validated one widens the range continuously: a jump would mislead a search.
        let further = (opened / errors::OPENING - 1.0) / (errors::NOT_FAR - 1.0);
        let [low, high] =
            errors::FORCE.map(|part| libm::pow(part, self.wider * (1.0 + further.clamp(0.0, 1.0))));
        // The start of contact is as uncertain as the radius. Both errors are treated as independent, so
        // they are added in quadrature; ranges made so hold (docs/ranges.md).
        let grasp = inflated.grasp(rest);
        let [least, force, most] = [far, rest.radius, near].map(|from| grasp.force(rho, from));
        Some([
            (force - libm::hypot(force - least, force * (1.0 - low))).max(0.0),
            force + libm::hypot(most - force, force * (high - 1.0)),
        ])
    }
}

/// The unit of the error of a tip's angle with arms of `arm` widths: short arms end before they are straight.
pub fn angle_unit(arm: f64) -> f64 {
    libm::pow(arm, if arm < 1.0 { -errors::SHORT_ARM } else { -1.0 })
}

/// Whether stars like `case` were computed as shells, and the factor on the width of its ranges; `None` if too far outside.
fn domain(case: &Case, model: &dyn HingeModel) -> Option<(Domain, f64)> {
    let star = &case.mechanism;
    let hinges = [star.tip(), star.corner()];
    let arms = hinges.iter().all(|hinge| model.arms(hinge.r_star, hinge.arc()).is_some());
    let pressure = case.pressure.filter(|_| arms && model.level() == Level::Section)?;
    let wider = widening(place(case, pressure).map(|(_, x, tried)| (x, tried)))?;
    Some((if wider > 1.0 { Domain::Extrapolated } else { Domain::Validated }, wider))
}

/// Factor on the width of ranges for numbers outside of their validated intervals: in proportion to
/// the logarithm of the largest factor by which a number is outside, so that no end of a range jumps at the edge of the
/// validated domain; `None` if too far outside.
pub(super) fn widening(numbers: impl IntoIterator<Item = (f64, Interval)>) -> Option<f64> {
    let factor = numbers.into_iter().map(|(x, tried)| factor_outside(x, tried)).fold(1.0, f64::max);
    let far = if factor > EXACT { libm::log(factor) / libm::log(errors::NOT_FAR) } else { 0.0 };
    (factor <= errors::NOT_FAR).then_some(1.0 + (errors::BEYOND - 1.0) * far)
}

/// The largest pressure, Pa, at which the ranges of `case` are not wider for its pressure; `None` if its
/// own pressure is not above that.
///
/// Values of shells at that pressure bound those at higher pressure, if the model predicts the direction of the
/// change correctly: see [`Ranges::bounded`].
pub fn pressure_edge(case: &Case) -> Option<f64> {
    let pressure = case.pressure?;
    let (by_pressure, by_sizes): (Vec<_>, Vec<_>) =
        place(case, pressure).into_iter().partition(|(what, ..)| *what == BENDABILITY);
    let sizes = by_sizes.into_iter().map(|(_, x, tried)| factor_outside(x, tried)).fold(1.0, f64::max);
    let factor = by_pressure.first().map(|(_, x, [_, most])| x / most)?;
    (factor > EXACT * sizes && factor.is_finite()).then(|| pressure * sizes / factor)
}

/// By which factor `x` lies outside of an interval; 1 or less inside, infinite where it is no multiple of the interval's end.
fn factor_outside(x: f64, [low, high]: Interval) -> f64 {
    let below = if x >= low { 1.0 } else { low / x.max(0.0) };
    if x.is_nan() { f64::INFINITY } else { below.max(x / high) }
}

/// The name of 1/eps among the numbers by which a star lies inside or outside.
const BENDABILITY: &str = "bendability";

/// Slack for rounding at the ends of the validated intervals.
const EXACT: f64 = 1.0 + 1e-9;

/// Position of `case` at `pressure` (Pa) in the validated domain: for each quantity its name, value and validated interval.
fn place(case: &Case, pressure: f64) -> [(&'static str, f64, Interval); 8] {
    let star = &case.mechanism;
    [
        ("points", f64::from(star.points), errors::POINTS),
        (BENDABILITY, case.sheet.bendability(pressure, star.width), errors::BENDABILITY),
        ("arm length over tube_width", star.arm / star.width, errors::ARM),
        ("inner_radius over tube_width", case.inner_radius / star.width, errors::HOLE),
        ("tip_radius over tube_width", star.tip().r_star, errors::R_STAR),
        ("corner_radius over tube_width", star.corner().r_star, errors::R_STAR),
        ("tip_angle in deg", star.tip_angle.to_degrees(), errors::TIP_ANGLE),
        ("flat arc of a corner in deg", star.corner().arc().to_degrees(), errors::CORNER_ARC),
    ]
}

/// Distance of `case` from the validated domain, as a sum over the quantities: 0 inside. A search uses it to get inside.
pub fn outside_by(case: &Case) -> f64 {
    let Some(pressure) = case.pressure else { return 0.0 };
    let width = case.mechanism.width;
    let table = [
        ("", case.sheet.thickness / width, errors::SLENDERNESS),
        ("", case.sheet.stretch(pressure, width), errors::STRETCH),
    ];
    let all = place(case, pressure).into_iter().chain(table);
    all.map(|(_, x, [low, high])| (low - x).max(0.0) / low.max(1e-9) + (x - high).max(0.0) / high).sum()
}

/// A message with the quantity of `case` outside of the validated domain: "arm length over tube_width is 0.21 (tried: 0.5 to 5)".
pub fn outside(case: &Case) -> String {
    let Some(pressure) = case.pressure else { return String::new() };
    let out = place(case, pressure).into_iter().filter(|(_, x, tried)| factor_outside(*x, *tried) > EXACT);
    let mut out: Vec<String> = out
        .map(|(what, x, [low, high])| {
            format!("{what} is {} (tried: {low} to {high})", Readable((1e3 * x).round() / 1e3))
        })
        .collect();
    if out.is_empty() {
        let slender = case.sheet.thickness / case.mechanism.width;
        out.push(format!(
            "the table of arms ends before hinges with t/W of {slender:.4} at a stretch of {:.1} % (it has t/W of 0.01 to 0.03)",
            100.0 * case.sheet.stretch(pressure, case.mechanism.width)
        ));
    }
    out.join("; ")
}

/// The ranges of a prediction, in its units: `None` if unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct StarRanges {
    /// Range of the final radius.
    pub final_radius_mm: Option<Interval>,
    /// Range of the contraction.
    pub contraction: Option<Interval>,
    /// Range of the tips' angle at rest.
    pub tip_equilibrium_angle_deg: Option<Interval>,
    /// Range of the hinges' stiffness.
    pub hinge_stiffness_Nm: Hinges<Option<Interval>>,
    /// Range of the radial stiffness.
    pub radial_stiffness_N_per_m: Option<Interval>,
    /// Range of the force on the object.
    pub object_force_N: Option<Interval>,
    /// Range of the payload.
    pub payload_kg: Option<Interval>,
    /// Range of the largest pull on the seal.
    pub seal_pull_N_per_mm: Option<Interval>,
    /// Range of the burst pressure, from the range of the pull; the seal's strength is assumed to be exact.
    pub burst_pressure_kPa: Option<Interval>,
}
