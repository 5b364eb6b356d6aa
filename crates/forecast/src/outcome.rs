//! The response of an inflated star under load: one set of closed forms, with their ranges, for predictions, sweeps and searches.

use crate::case::Case;
use crate::folding::until_arms_fold;
use crate::interval::Interval;
use crate::model_selection::{correct, tabled};
use crate::ranges::errors::OPENING_REACHED;
use crate::ranges::{Domain, Ranges, pressure_edge, scaled_floor};
use inflatable::mechanics::fault::StarFault;
use inflatable::mechanics::hinge::HingeModel;
use inflatable::mechanics::star::grasp::Grasp;
use inflatable::mechanics::star::response::{Inflated, Rest};
use inflatable::mechanics::strength::payload;
use inflatable::numerics::last_holding;
use spec::units::Length;

/// Shortest arm over tube width: shorter ones are no straight tube any more, and the model's hinges would overlap.
pub const SHORTEST_ARM: f64 = 0.5;
/// The last part of the way from rest to the widest opening, where the arms lock. The radius is a parabola there, so at a
/// sixteenth its slope has fallen to a quarter: the same torque makes four times the force.
const LOCKING: f64 = 1.0 / 16.0;
/// The last part by W of the openings of a star at the edge of the validated domain, over which its force stops bounding that of more pressure.
const FADING: f64 = 0.1;

/// One star's outcome in SI units; `None` where a required input is missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The equilibrium, and the widest opening.
    pub rest: Rest,
    /// Whether the star is in the model's domain: always true for a limit; `section` covers stars similar to those computed as shells.
    pub known: bool,
    /// 1 - rho_f / rho_0.
    pub contraction: f64,
    /// Radii that it can hold, m: from rho_f to the largest that both passes the cut hole and the inflated star opens
    /// to; empty, both ends rho_f, if there are none.
    pub graspable: [f64; 2],
    /// Radial stiffness at rest, N per m; `None` also where arms touch, unless the model is a limit.
    pub stiffness: Option<f64>,
    /// Radial force stored in a star whose arms are pressed together, N; only for limits, never validated against a shell.
    pub preload: Option<f64>,
    /// The object's state; needs a pressure.
    pub hold: Option<Grip>,
    /// Mass that friction holds on an upright surface with this star alone, until its arms fold, kg.
    pub payload: Option<f64>,
    /// Mass on this star at which its arms wrinkle between plate and object, kg; `None` without both.
    pub wrinkling: Option<f64>,
    /// Intervals that contain a shell's values; none for a limit, and none with the model's own V_bar.
    pub ranges: Ranges,
    /// Range of the force on the object, N.
    pub force_range: Option<Interval>,
    /// Range of the payload of this star alone, kg.
    pub payload_range: Option<Interval>,
    /// The force while the flap stays straight, if the case has a largest force.
    pub flap: Option<FlapForce>,
}

/// Radial force of one star while the flap in front of its corners stays straight, N: that on an object wider by the flap's depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlapForce {
    /// The predicted force; `None` where a star that is opened so far locks.
    pub force: Option<f64>,
    /// Range of the force on the object: from that of a flap which gives way to that of a straight one; `None` where no shell was opened so
    /// far.
    pub range: Option<Interval>,
}

/// Rounds of halving an interval of radii: its ends then differ by less than is printed.
const ROUNDS: u32 = 40;

/// Rounding of radii, m: an object as wide as the hole enters.
const ROUNDING: f64 = 1e-12;

/// The state of an object within a star.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grip {
    /// It is held with this radial force, N.
    Held(f64),
    /// It is thinner than the final radius.
    TooThin,
    /// The star passes above or below it.
    Beside,
    /// It is wider than the flat star's cut hole, and does not enter.
    TooWideToEnter,
    /// It is wider than the inflated star opens.
    TooWideToOpen,
    /// The model has no force there.
    Unknown(StarFault),
    /// It is held with an unknown force: the star is unlike those that were tried, or no shell was opened this far.
    Untried,
}

impl Outcome {
    /// The outcome of the star of `case` by `model`, with linear hinges and ranges; and the case with the model's corrections.
    ///
    /// # Errors
    /// If the model refuses a hinge, or the star has no equilibrium.
    pub fn by_model(case: &Case, model: &dyn HingeModel) -> Result<(Case, Self), StarFault> {
        let mut case = *case;
        let outcome = Self::correcting(&mut case, model)?;
        Ok((case, outcome))
    }

    /// The outcome of `case`, which gets the model's corrections.
    ///
    /// # Errors
    /// The errors of [`Outcome::by_model`].
    pub fn correcting(case: &mut Case, model: &dyn HingeModel) -> Result<Self, StarFault> {
        correct(case, model)?;
        // Angles and radii of a limit do not depend on the pressure: without one, any will do.
        let inflated = Inflated::new(&case.mechanism, model, case.pressure.unwrap_or(1.0))?;
        Ok(Self::linear(case, &inflated))
    }

    /// The range of the contraction; `case` is the one that was answered.
    pub fn contraction_range(&self, case: &Case) -> Option<Interval> {
        self.ranges.radius.map(|[low, high]| [high, low].map(|radius| 1.0 - radius / case.inner_radius))
    }

    /// With linear hinges, and with ranges where there are any.
    pub fn linear(case: &Case, inflated: &Inflated<'_>) -> Self {
        let rest = inflated.linear_rest();
        let grasp = case.object.and_then(|_| inflated.grasp(&rest));
        let outcome =
            Self::from_rest(case, rest, |rho, rest| inflated.linear_force_by(grasp.as_ref(), rho, rest));
        let ranges = Ranges::new(case, inflated, &outcome.rest);
        let edge = if ranges.domain == Domain::Extrapolated { at_the_edge(case) } else { None };
        let ranges =
            edge.map_or(ranges, |edge| ranges.bounded(&edge.ranges, [outcome.rest.radius, edge.rest.radius]));
        let force_range = outcome.force_range(case, grasp.as_ref(), edge.as_ref(), &ranges);
        // The friction does not depend on the force, and either may be at its end: at least what the lower ends hold, at most what the upper.
        let payload_range = case.friction_range.zip(force_range).map(|(friction, force)| {
            [0, 1].map(|end: usize| {
                until_arms_fold(payload(friction[end], [1.0]) * force[end], outcome.wrinkling)
            })
        });
        let outcome = Self { ranges, force_range, payload_range, ..outcome };
        let flap = case.largest_force.and_then(|_| outcome.flap_force(case, inflated, grasp.as_ref()));
        let outcome = Self { flap, ..outcome };
        if case.mechanism.correction.corner_compliance { outcome.as_far_as_known() } else { outcome }
    }

    /// The force while the flap stays straight, by `grasp`; `None` without an object that the star presses on or may reach.
    pub fn flap_force(
        &self,
        case: &Case,
        inflated: &Inflated<'_>,
        grasp: Option<&Grasp>,
    ) -> Option<FlapForce> {
        let _ = self.object_force()?;
        let radius = case.object.filter(|object| *object > 0.0)? + case.flap();
        let [low, yielding] = self.force_range.map_or([None; 2], |range| range.map(Some));
        if radius <= self.rest.radius {
            // The closest star in its range may reach further.
            return Some(FlapForce { force: Some(0.0), range: self.force_range });
        }
        let force = inflated.linear_force_by(grasp, radius, &self.rest).ok();
        let straight =
            force.zip(grasp).and_then(|(force, grasp)| self.ranges.force(grasp, force, radius, &self.rest));
        let range =
            low.zip(yielding).zip(straight).map(|((low, yielding), [_, high])| [low, high.max(yielding)]);
        Some(FlapForce { force, range })
    }

    /// The range of the force on the object by `grasp`; `None` for a limit, or without a force. `edge` is the star at the edge of the
    /// validated domain, if it lies beyond.
    fn force_range(
        &self,
        case: &Case,
        grasp: Option<&Grasp>,
        edge: Option<&Self>,
        ranges: &Ranges,
    ) -> Option<Interval> {
        let (rho, _, [closest, _]) = (case.object?, self.object_force()?, ranges.radius?);
        match self.hold? {
            Grip::Held(force) => {
                let range = ranges.force(grasp?, force, rho, &self.rest)?;
                Some(self.at_least_as_at(edge, (rho, case.mechanism.width), range))
            }
            // It may close further than predicted. Where arms touch, the object may also lie beyond the radius without contact.
            Grip::TooThin if rho >= closest => {
                let grasp = grasp?;
                let [_, high] = ranges.force(grasp, grasp.force(rho), rho, &self.rest)?;
                Some([0.0, high])
            }
            _ => Some([0.0; 2]),
        }
    }

    /// The least and the largest radius, m, of an object that the star of `case`, which is `inflated`, surely presses on: the range of the
    /// force on it begins above 0. `None` if there is no such object.
    pub fn surely_held(&self, case: &Case, inflated: &Inflated<'_>) -> Option<Interval> {
        let presses = |rho: f64| Self::surely_presses(case, inflated, rho);
        let has_range = |rho: f64| Self::force_range_on(case, inflated, rho).is_some();
        let [smallest, largest] = self.graspable;
        // Where shells were not opened so far, there is no range.
        let widest =
            if has_range(largest) { largest } else { last_holding(smallest, largest, ROUNDS, has_range) };
        Self::surely_presses(case, inflated, widest)
            .then(|| [last_holding(widest, smallest, ROUNDS, presses), widest])
    }

    /// Whether the range of the force on an object of radius `rho`, m, begins above 0.
    fn surely_presses(case: &Case, inflated: &Inflated<'_>, rho: f64) -> bool {
        Self::force_range_on(case, inflated, rho).is_some_and(|[low, _]| low > 0.0)
    }

    /// The range of the force on an object of radius `rho`, m, that enters the star of `case`.
    fn force_range_on(case: &Case, inflated: &Inflated<'_>, rho: f64) -> Option<Interval> {
        let case = Case { object: Some(rho), entering: None, ..*case };
        Self::linear(&case, inflated).force_range
    }

    /// `range` of the force. If the model's force has grown since the edge of the validated domain, its lower end is at least the one
    /// there; if it has fallen, that end is scaled in proportion. This fades where the edge's star hardly opens to the object, of radius
    /// `rho`, or has no range much further out: else it would begin with a jump. `width` is W; both in m.
    fn at_least_as_at(
        &self,
        edge: Option<&Self>,
        (rho, width): (f64, f64),
        [low, high]: Interval,
    ) -> Interval {
        let floor = edge.zip(self.object_force()).and_then(|(edge, force)| {
            let ([floor, _], edge_force) = (edge.force_range?, edge.object_force()?);
            let room = (edge.rest.radius + OPENING_REACHED * width).min(edge.rest.widest.radius) - rho;
            Some(scaled_floor(floor, edge_force, force) * (room / (FADING * width)).clamp(0.0, 1.0))
        });
        [low.max(floor.unwrap_or(0.0)), high]
    }

    /// Removes the values without a range: the ranges are those of a star at its pressure, not of a limit.
    fn as_far_as_known(self) -> Self {
        let is_known = self.ranges.domain != Domain::Unknown;
        let untried = matches!(self.hold, Some(Grip::Held(_))) && self.force_range.is_none();
        Self {
            known: is_known,
            stiffness: self.stiffness.filter(|_| self.ranges.stiffness.is_some()),
            preload: self.preload.filter(|_| self.ranges.stiffness.is_some()),
            hold: if untried || !is_known { self.hold.map(|_| Grip::Untried) } else { self.hold },
            payload: self.payload.filter(|_| is_known && !untried),
            flap: self.flap.filter(|_| is_known && !untried),
            ..self
        }
    }

    /// With the model's own V_bar.
    ///
    /// # Errors
    /// If the model has no equilibrium.
    pub fn nonlinear(case: &Case, inflated: &Inflated<'_>) -> Result<Self, StarFault> {
        Ok(Self::from_rest(case, inflated.rest()?, |rho, rest| inflated.force(rho, rest)))
    }

    fn from_rest(case: &Case, rest: Rest, force: impl Fn(f64, &Rest) -> Result<f64, StarFault>) -> Self {
        // The object decides between holding and four ways not to. Force and payload follow only where it is held.
        // Without a pressure all that depends on one stays unknown.
        let rho_0 = case.inner_radius;
        let hold = case.pressure.and(case.object).map(|rho| match rho {
            _ if rho <= 0.0 => Grip::Beside,
            _ if case.entering.unwrap_or(rho) > case.hole + ROUNDING => Grip::TooWideToEnter,
            _ if rho < rest.radius => Grip::TooThin,
            _ if rho > rest.widest.radius => Grip::TooWideToOpen,
            _ => force(rho, &rest).map_or_else(Grip::Unknown, Grip::Held),
        });
        let object_force = hold.and_then(Grip::force);
        let wrinkling = object_force.and_then(|_| case.wrinkling_mass(rest.angle));
        Self {
            rest,
            known: true,
            contraction: 1.0 - rest.radius / rho_0,
            graspable: [rest.radius, rest.widest.radius.min(case.hole).max(rest.radius)],
            stiffness: case.pressure.map(|_| rest.stiffness),
            preload: case.pressure.map(|_| rest.preload),
            hold,
            payload: case
                .friction
                .zip(object_force)
                .map(|(friction, force)| until_arms_fold(payload(friction, [force]), wrinkling)),
            wrinkling,
            ranges: Ranges::default(),
            force_range: None,
            payload_range: None,
            flap: None,
        }
    }

    /// Radial force on the object, N; 0 on one that the star does not reach.
    pub fn object_force(&self) -> Option<f64> {
        self.hold.and_then(Grip::force)
    }

    /// A warning about the object, if there is one.
    pub fn object_warning(&self, case: &Case) -> Option<String> {
        // One text for each answer to whether the object is held; the diameters are those that the star reaches.
        // None where the object is held without doubt.
        let [smallest, largest, hole] = [self.rest.radius, self.rest.widest.radius, case.hole]
            .map(|radius| format!("{:.2} mm across", 2.0 * Length::from_metres(radius).0));
        match self.hold? {
            Grip::Held(_) => self.locks(case).then(|| {
                format!(
                    "the object is nearly as wide as the inflated star opens, {largest}: the arms lock there, and the \
                     predicted force grows without bound"
                )
            }),
            Grip::TooThin => Some(format!(
                "the object is thinner than the closed star, {smallest}: the star does not reach it"
            )),
            Grip::Beside => Some("the object ends below or above the star: it does not touch it".to_owned()),
            Grip::TooWideToEnter => Some(format!(
                "the object is wider than the cut hole, {hole}: it does not enter"
            )),
            Grip::TooWideToOpen => Some(format!(
                "the object is wider than the inflated star opens, {largest}: the arms lock there, and the star does not \
                 close around it; a larger inner radius, fewer points or a narrower tube open it wider"
            )),
            Grip::Unknown(fault) => Some(format!("no force on the object: {fault}")),
            Grip::Untried => Some(
                "the force is unknown: the object opens the star further than any star that was computed as a shell; \
                 a smaller object opens it less"
                    .to_owned(),
            ),
        }
    }

    /// Whether the object is so wide that rigid arms nearly lock around it.
    pub fn locks(&self, case: &Case) -> bool {
        if case.mechanism.correction.corner_compliance {
            return false;
        }
        let (smallest, largest) = (self.rest.radius, self.rest.widest.radius);
        let [open_slope, closed_slope] =
            [self.rest.widest.angle, self.rest.angle].map(|phi| case.mechanism.radius(phi).slope);
        let is_near = case.object.is_some_and(|rho| largest - rho < LOCKING * (largest - smallest));
        is_near && open_slope < LOCKING.sqrt() * closed_slope
    }
}

/// The star at the largest pressure at which its ranges are not wider for the pressure; `None` where its
/// own is not above that.
fn at_the_edge(case: &Case) -> Option<Outcome> {
    let pressure = pressure_edge(case)?;
    let mut case = Case { pressure: Some(pressure), ..*case };
    let model = tabled(&case, pressure).ok()?;
    Outcome::correcting(&mut case, &model).ok()
}

impl Grip {
    /// Radial force, N; `None` where the star cannot hold the object.
    pub fn force(self) -> Option<f64> {
        match self {
            Self::Held(force) => Some(force),
            Self::TooThin | Self::Beside => Some(0.0),
            Self::TooWideToEnter | Self::TooWideToOpen | Self::Unknown(_) | Self::Untried => None,
        }
    }
}
