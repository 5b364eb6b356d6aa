//! A **range** for each predicted quantity: the interval in which the value of a computed shell lies in at least 95 % of cases.
//!
//! A range is made of the errors of `section` with its correction against stars computed as shells ([`errors`]),
//! so it has a sign. It applies within the validated domain; outside it widens with the distance, up to
//! [`errors::BEYOND`] times; further out there is none. [`Domain`] distinguishes the three cases. The limits
//! of high pressure, `fit`, `ring` and `bvp`, have no range: no gripper works there.

pub mod errors;
pub mod shown;

use crate::case::{Case, Hinges};
use crate::interval::{Interval, hull};
use inflatable::mechanics::hinge::Level;
use inflatable::mechanics::star::grasp::Grasp;
use inflatable::mechanics::star::response::{Inflated, Rest};
use serde::Serialize;
use spec::units::Readable;

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
    /// Further factor on the widths of stiffness and force for the fabric's Poisson ratio.
    pub by_fabric: f64,
    /// Radius of the flat tube's hole, m.
    pub flat_hole: f64,
    /// Range of the final radius, m.
    pub radius: Option<Interval>,
    /// Range of the tips' angle at rest, rad; `None` also where arms touch, because contact is part of that equilibrium.
    pub angle: Option<Interval>,
    /// Range of the radial stiffness, N per m; `None` also where arms touch.
    pub stiffness: Option<Interval>,
}

impl Ranges {
    /// Ranges of a star that rests at `rest`.
    pub fn new(case: &Case, inflated: &Inflated<'_>, rest: &Rest) -> Self {
        let Some((place, wider)) = domain(case, inflated) else { return Self::default() };
        let star = &case.mechanism;
        let unit = errors::radius_unit(star.points);
        let by_fabric = errors::poisson_unit(case.sheet.poisson_ratio);
        let stiffer = wider * by_fabric * errors::stiffness_unit(star.points);
        // Arms that touch press on each other; hinge models do not include the effect on the stiffness.
        let free = rest.equilibrium > star.correction.contact_angle;
        let radius_unit = unit * star.width / star.sector_sine();
        let radius = errors::RADIUS.map(|error| (rest.radius + wider * error * radius_unit).max(0.0));
        let angle = errors::ANGLE.map(|error| rest.equilibrium + wider * error * unit);
        Self {
            domain: place,
            wider,
            by_fabric,
            flat_hole: case.inner_radius,
            radius: Some(radius),
            angle: (angle[0] > star.correction.contact_angle).then_some(angle),
            stiffness: free
                .then(|| errors::widened(errors::STIFFNESS, stiffer).map(|part| rest.stiffness * part)),
        }
    }

    /// Range of the stiffness of the hinges of `case`, as factors of it.
    pub fn hinge(&self, case: &Case) -> Option<Interval> {
        if self.domain == Domain::Unknown {
            return None;
        }
        let thin = errors::hinge(case.sheet.thickness / case.mechanism.width);
        Some(hull(errors::widened(errors::HINGE, self.wider), thin))
    }

    /// These ranges bounded by `edge`, the ranges of the star at its [`pressure_edge`]; `rests` are the final
    /// radii at the star's own pressure and at the edge, m.
    ///
    /// If the model closes the star further than at the edge, a shell closes it at least as far; if the model opens it,
    /// a shell opens it by no more. So the upper end of the final radius stops widening with the pressure.
    #[must_use]
    pub fn bounded(self, edge: &Self, [radius, edge_radius]: [f64; 2]) -> Self {
        let bounded = self.radius.zip(edge.radius).map(|([low, high], [_, edge_high])| {
            [low, high.min(edge_high + (radius - edge_radius).max(0.0))]
        });
        Self { radius: bounded.or(self.radius), ..self }
    }

    /// Range of the radial force `force` (N) of `grasp` on an object of radius `rho` (m) within the star that rests at `rest`; `None`
    /// where shells were not opened so far.
    ///
    /// Where the range widens with the object, its lower end does not fall by that: a shell that is opened further presses at least as hard
    /// if the model says so. If the model's force falls, that end is scaled in proportion.
    pub fn force(&self, grasp: &Grasp, force: f64, rho: f64, rest: &Rest) -> Option<Interval> {
        let [low, high] = self.force_alone(grasp, force, rho, rest)?;
        let width = grasp.width();
        let begins = [rest.radius + errors::OPENING * width, errors::flat_begins(self.flat_hole, width)];
        let floors =
            begins.into_iter().filter(|begins| (rest.radius..rho).contains(begins)).filter_map(|begins| {
                let edge_force = grasp.force(begins);
                let [floor, _] = self.force_alone(grasp, edge_force, begins, rest)?;
                Some(scaled_floor(floor, edge_force, force))
            });
        Some([floors.fold(low, f64::max), high])
    }

    /// The range of the force on this object alone, without the edge.
    fn force_alone(&self, grasp: &Grasp, force: f64, rho: f64, rest: &Rest) -> Option<Interval> {
        let [low_radius, high_radius] = self.radius?;
        let opened = (rho - rest.radius) / grasp.width();
        if opened > errors::OPENING_REACHED {
            return None;
        }
        // An opening beyond the validated one widens the range continuously, as an object that nearly fills the flat hole does: a jump
        // would mislead a search.
        let further = (opened / errors::OPENING - 1.0) / (errors::NOT_FAR - 1.0);
        let flat = errors::flat_unit((self.flat_hole - rho) / grasp.width());
        let wider = self.wider * self.by_fabric * flat * (1.0 + further.clamp(0.0, 1.0));
        let [low, high] = errors::widened(errors::FORCE, wider);
        // The start of contact is as uncertain as the radius. Both errors are treated as independent, so
        // they are added in quadrature; ranges made so hold (docs/ranges.md).
        // Arms that touch: the radius without contact is as uncertain.
        let [least_force, greatest_force] = [high_radius, low_radius]
            .map(|from| grasp.force_from(rho, grasp.free_radius() + (from - rest.radius)));
        Some([
            (force - libm::hypot(force - least_force, force * (1.0 - low))).max(0.0),
            force + libm::hypot(greatest_force - force, force * (high - 1.0)),
        ])
    }
}

/// The least force, N, of a shell that pressed with at least `floor` where the model presses with `edge_force`, if the model presses with `force`
/// now: a force that grows stays above that, and one that falls does so in proportion.
pub(super) fn scaled_floor(floor: f64, edge_force: f64, force: f64) -> f64 {
    floor * (force / edge_force).min(1.0)
}

/// Whether stars like `case` were computed as shells, and the factor on the width of its ranges; `None` if too far outside.
fn domain(case: &Case, inflated: &Inflated<'_>) -> Option<(Domain, f64)> {
    let is_sectioned = inflated.has_arms() && inflated.level() == Level::Section;
    let pressure = case.pressure.filter(|_| is_sectioned)?;
    let wider = widening(&places(case, pressure))?;
    Some((if wider > 1.0 { Domain::Extrapolated } else { Domain::Validated }, wider))
}

/// A number by which a star lies inside or outside of what was tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct TriedRatio {
    what: &'static str,
    x: f64,
    /// Where many stars were computed.
    tried: Interval,
    /// Where ranges end.
    reached: Interval,
    /// By how much they are wider there.
    wider: f64,
}

impl TriedRatio {
    /// A number without computed stars outside of `validated`: ranges reach a little further.
    pub(super) fn new(quantity: &'static str, x: f64, validated: Interval) -> Self {
        let extended = [validated[0] / errors::NOT_FAR, validated[1] * errors::NOT_FAR];
        Self { what: quantity, x, tried: validated, reached: extended, wider: errors::BEYOND }
    }

    /// A number with the stars of the set `wide` between `tried` and `extended`.
    fn reaching(self, extended: Interval, wider: f64) -> Self {
        Self { reached: extended, wider, ..self }
    }

    /// How far it lies outside, from 0 where many stars were tried to 1 where ranges end: by its logarithm.
    fn distance(&self) -> f64 {
        let ([low, high], [lowest, highest]) = (self.tried, self.reached);
        if self.x >= low && self.x <= high {
            return 0.0;
        }
        let (factor, end) = match self.x {
            x if x.is_nan() => return f64::INFINITY,
            x if x >= low => (x / high, highest / high),
            x => (low / x.max(0.0), low / lowest),
        };
        if factor > EXACT { libm::log(factor) / libm::log(end) } else { 0.0 }
    }

    /// By how much ranges are wider for it; `None` too far out.
    fn widens(&self) -> Option<f64> {
        (self.distance() <= EXACT).then(|| self.widens_on())
    }

    /// A ratio that widens on at that rate further out.
    pub(super) fn widens_on(&self) -> f64 {
        1.0 + (self.wider - 1.0) * self.distance()
    }
}

/// By how much ranges are wider where numbers lie outside of the intervals that were tried: as for the one that widens them most, and no end
/// of a range jumps where nothing was tried any more; `None` too far out.
pub(super) fn widening<'a>(places: impl IntoIterator<Item = &'a TriedRatio>) -> Option<f64> {
    places.into_iter().try_fold(1.0, |most, place| Some(f64::max(most, place.widens()?)))
}

/// The largest pressure, Pa, at which the ranges of `case` are not wider for its pressure; `None` if its
/// own pressure is not above that.
///
/// Values of shells at that pressure bound those at higher pressure, if the model predicts the direction of the
/// change correctly: see [`Ranges::bounded`].
pub fn pressure_edge(case: &Case) -> Option<f64> {
    let pressure = case.pressure?;
    let tried_places = places(case, pressure);
    let place = tried_places.iter().find(|place| place.what == BENDABILITY && place.x > place.tried[1])?;
    let by_sizes = tried_places.iter().filter(|place| place.what != BENDABILITY);
    let distance = (widening(by_sizes)? - 1.0) / (place.wider - 1.0);
    let edge = place.tried[1] * libm::pow(place.reached[1] / place.tried[1], distance);
    (place.x > EXACT * edge && place.x.is_finite()).then(|| pressure * edge / place.x)
}

/// The name of 1/eps among the numbers by which a star lies inside or outside.
const BENDABILITY: &str = "bendability";

/// Slack for rounding at the ends of the validated intervals.
const EXACT: f64 = 1.0 + 1e-9;

/// Where `case` lies at `pressure` (Pa) among the stars that were tried.
fn places(case: &Case, pressure: f64) -> [TriedRatio; 9] {
    let star = &case.mechanism;
    let slender = case.sheet.thickness / star.width;
    let bendability = case.sheet.bendability(pressure, star.width);
    [
        TriedRatio::new("points", f64::from(star.points), errors::POINTS)
            .reaching(errors::POINTS_REACHED, errors::BEYOND_SIZES),
        TriedRatio::new(BENDABILITY, bendability, errors::bendability(slender)),
        TriedRatio::new("arm length over tube_width", star.arm / star.width, errors::ARM)
            .reaching(errors::ARM_REACHED, errors::BEYOND_SIZES),
        TriedRatio::new("inner_radius over tube_width", case.inner_radius / star.width, errors::HOLE)
            .reaching(errors::HOLE_REACHED, errors::BEYOND_SIZES),
        TriedRatio::new("tip_radius over tube_width", star.tip().r_star, errors::R_STAR),
        TriedRatio::new("corner_radius over tube_width", star.corner().r_star, errors::R_STAR),
        TriedRatio::new("tip_angle in deg", star.tip_angle.to_degrees(), errors::TIP_ANGLE),
        TriedRatio::new("flat arc of a corner in deg", star.corner().arc().to_degrees(), errors::CORNER_ARC),
        TriedRatio::new("thickness over tube_width", slender, errors::SLENDERNESS)
            .reaching(errors::SLENDERNESS_REACHED, errors::BEYOND_THIN),
    ]
}

/// Distance of `case` from the validated domain, as a sum over the quantities: 0 inside. A search uses it to get inside.
pub fn outside_by(case: &Case) -> f64 {
    let Some(pressure) = case.pressure else { return 0.0 };
    let stretch = TriedRatio::new("", case.sheet.stretch(pressure, case.mechanism.width), errors::STRETCH);
    let part = |TriedRatio { x, tried: [low, high], .. }: TriedRatio| {
        (low - x).max(0.0) / low.max(1e-9) + (x - high).max(0.0) / high
    };
    places(case, pressure).into_iter().chain([stretch]).map(part).sum()
}

/// A message with the quantity of `case` outside of the validated domain: "arm length over tube_width is 0.21 (tried: 0.5 to 5)".
pub fn outside_domain(case: &Case) -> String {
    let Some(pressure) = case.pressure else { return String::new() };
    let untried = places(case, pressure).into_iter().filter(|place| place.distance() > 0.0);
    let mut texts: Vec<String> = untried
        .map(|TriedRatio { what, x, tried: [low, high], .. }| {
            let [x, low, high] = [x, low, high].map(|x| Readable((1e4 * x).round() / 1e4));
            format!("{what} is {x} (tried: {low} to {high})")
        })
        .collect();
    if texts.is_empty() {
        let slender = case.sheet.thickness / case.mechanism.width;
        texts.push(format!(
            "the tables of arms do not cover hinges with t/W of {slender:.4} at a stretch of {:.1} % (they \
             cover t/W of 0.005 to 0.03)",
            100.0 * case.sheet.stretch(pressure, case.mechanism.width)
        ));
    }
    texts.join("; ")
}

/// The ranges of a prediction, in its units: `None` if unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
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
    /// Range of the force on the object from a flap that gives way to one that stays straight.
    pub flap_force_N: Option<Interval>,
    /// Range of the payload.
    pub payload_kg: Option<Interval>,
    /// Range of the largest pull on the seal.
    pub seal_pull_N_per_mm: Option<Interval>,
    /// Range of the burst pressure, from the range of the pull; the seal's strength is assumed to be exact.
    pub burst_pressure_kPa: Option<Interval>,
}
