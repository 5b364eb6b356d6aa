//! Constraints of a design and its violation of them: at the bad end of its ranges, and for a force beyond it, because a search finds
//! the places where a model is most optimistic.

use crate::candidate::{Answer, Candidate};
use crate::outcome::{FlapForce, Grip, Outcome, SHORTEST_ARM};
use crate::ranges::{Domain, outside_by};
use spec::ModelChoice;
use spec::units::Length;

/// Least shortfall of a star just outside of the validated domain.
const LEAST_UNTRIED: f64 = 0.01;
/// By how much constraints are tightened for the search, so that they still hold once the values are rounded.
pub const ROUNDING: f64 = 5e-4;
/// Factor on the lower end of a force's range in a search, and divisor of the upper end: a search finds the places where a model is most
/// optimistic. Of twenty winners chosen by ranges alone, three had payloads 10, 13 and 21 % below the lower end.
pub const SEARCHED: f64 = 0.8;

/// Constraints on a design; absent constraints always hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constraints {
    /// The star must close to the first radius; the second must pass the cut hole, and the inflated star must open to it.
    pub grasp: Option<[Length; 2]>,
    /// A radius that must pass the cut hole.
    pub hole: Option<Length>,
    /// Payload of the stack, kg, at the load's pressure, object and friction.
    pub payload: Option<f64>,
    /// Largest radial force of one star on the object, N.
    pub largest_force: Option<f64>,
    /// Smaller side of the sheet's free area: the cut star must fit.
    pub sheet: Option<Length>,
    /// Burst pressure over pressure.
    pub burst_margin: Option<f64>,
    /// Whether arms must not touch. Required with a force: forces of stars whose arms touch were compared with coarse shells only.
    pub apart: bool,
}

/// A constraint that a design may miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constraint {
    /// Arms are as long as the shortest that models know.
    Arms,
    /// A model covers the star.
    Model,
    /// The star lies in the domain of validated stars.
    Untried,
    /// The arms of tips do not touch.
    Touching,
    /// It closes to the smaller radius that it shall grasp.
    Closing,
    /// It opens to the larger one.
    Opening,
    /// The object passes the cut hole.
    InnerRadius,
    /// It presses no harder than is allowed.
    Pressing,
    /// It meets the object.
    Object,
    /// It carries the payload.
    Payload,
    /// It fits on the sheet.
    Sheet,
    /// The burst pressure is high enough.
    Burst,
}

impl Constraint {
    /// The name in answers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arms => "arms",
            Self::Model => "no model",
            Self::Untried => "untried",
            Self::Touching => "touching",
            Self::Closing => "closing",
            Self::Opening => "opening",
            Self::InnerRadius => "inner_radius",
            Self::Pressing => "pressing",
            Self::Object => "object",
            Self::Payload => "payload",
            Self::Sheet => "sheet",
            Self::Burst => "burst",
        }
    }
}

/// A constraint that a design misses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortfall {
    /// The constraint.
    pub constraint: Constraint,
    /// By how much it is missed, relative to its bound, above 0.
    pub part: f64,
}

/// The constraints that a design misses, as they are collected.
struct Shortfalls(Vec<Shortfall>);

impl Shortfalls {
    /// Adds a constraint, if it is missed.
    fn add(&mut self, constraint: Constraint, part: f64) {
        if part > 0.0 {
            self.0.push(Shortfall { constraint, part });
        }
    }
}

/// Shortfall relative to `minimum`; a missing value counts as zero.
fn short(value: Option<f64>, minimum: f64) -> f64 {
    ((minimum - value.unwrap_or(0.0)) / minimum).max(0.0)
}

/// Excess relative to `maximum`.
fn excess(value: f64, maximum: f64) -> f64 {
    ((value - maximum) / maximum).max(0.0)
}

/// Relative shortfall of a star with `grip` that does not hold the object of `point`.
fn object_shortfall(point: &Candidate, grip: &Outcome) -> Option<f64> {
    match grip.hold? {
        Grip::TooWideToEnter | Grip::TooWideToOpen => Some(0.1),
        Grip::TooThin => {
            let object = point.load.object_radius.map_or(grip.rest.radius, Length::metres);
            Some(excess(grip.rest.radius, object))
        }
        Grip::Beside => Some(1.0),
        Grip::Held(_) | Grip::Unknown(_) | Grip::Untried => None,
    }
}

/// All constraints that `point`, with the values `answer`, violates.
pub fn shortfalls(point: &Candidate, answer: &Answer, constraints: &Constraints) -> Vec<Shortfall> {
    let star = &answer.star;
    let mut shortfalls = Shortfalls(Vec::new());
    shortfalls.add(Constraint::Arms, short(Some(star.l), SHORTEST_ARM * star.w));
    if answer.outcome.is_none() {
        shortfalls.add(Constraint::Model, 10.0);
    }
    if let Some(grip) = &answer.grip {
        if is_at_pressure(point.model) && grip.ranges.domain != Domain::Validated {
            // The more the further out: so that a search finds its way in.
            shortfalls.add(Constraint::Untried, LEAST_UNTRIED + outside_by(&answer.case));
        }
        let forceful =
            constraints.apart || constraints.payload.is_some() || constraints.largest_force.is_some();
        if is_at_pressure(point.model) && forceful {
            // The overlap of the arms, as the tips' angle by which they pass contact, rad.
            let depth = answer.case.mechanism.correction.contact_angle - grip.rest.equilibrium;
            shortfalls.add(Constraint::Touching, if depth >= 0.0 { LEAST_UNTRIED + depth } else { 0.0 });
        }
        if let Some([close, open]) = constraints.grasp {
            let least_sure = grip.ranges.radius.map_or(grip.rest.radius, |[_, high]| high);
            let [widest, least_sure] =
                [grip.rest.widest.radius, least_sure].map(|metres| Length::from_metres(metres).0);
            shortfalls.add(Constraint::Closing, excess(least_sure, close.0));
            shortfalls.add(Constraint::Opening, short(Some(widest), open.0 * (1.0 + ROUNDING)));
        }
        let entering =
            constraints.grasp.map(|[_, open]| open.0).into_iter().chain(constraints.hole.map(|hole| hole.0));
        if let Some(entering) = entering.reduce(f64::max) {
            shortfalls.add(Constraint::InnerRadius, short(Some(star.hole(&point.seal)), entering));
        }
        if let Some(largest_force) = constraints.largest_force {
            // An unknown force may be too large; an object that is not held has a shortfall of its grip.
            let unknown = if matches!(grip.hold, Some(Grip::Untried | Grip::Held(_))) { 1.0 } else { 0.0 };
            shortfalls.add(
                Constraint::Pressing,
                most_force(point, grip).map_or(unknown, |force| excess(force, largest_force)),
            );
        }
        if let Some(part) = object_shortfall(point, grip) {
            shortfalls.add(Constraint::Object, part);
        }
    }
    if let Some(payload) = constraints.payload {
        shortfalls.add(Constraint::Payload, short(sure_payload(point, answer), payload));
    }
    if let Some(side) = constraints.sheet {
        let reach = star.tip_reach() + point.seal.band.0 + point.seal.allowance.0;
        shortfalls.add(Constraint::Sheet, excess(2.0 * reach, side.0));
    }
    if let Some(minimum) = constraints.burst_margin {
        let margin = answer.burst.zip(point.load.pressure).map(|(burst, pressure)| burst.0 / pressure.0);
        shortfalls.add(Constraint::Burst, short(margin, minimum));
    }
    shortfalls.0
}

/// Whether a model applies at the star's pressure, unlike a limit selected by name.
pub fn is_at_pressure(model: ModelChoice) -> bool {
    !matches!(model, ModelChoice::Ring | ModelChoice::Fit)
}

/// The largest force with which it may press while its flap stays straight, N, beyond the upper end of its range; `None` if unknown.
fn most_force(point: &Candidate, outcome: &Outcome) -> Option<f64> {
    match (outcome.flap, outcome.object_force()) {
        (Some(FlapForce { range: Some([_, high]), .. }), _) => Some(high / SEARCHED),
        (Some(FlapForce { force: Some(force), .. }), _) if !is_at_pressure(point.model) => Some(force),
        // The star passes above or below the object.
        (None, Some(0.0)) => Some(0.0),
        _ => None,
    }
}

/// The design payload of the stack, kg, below the lower end of its range; `None` if unknown. A limit selected by name
/// gives its own value.
pub fn sure_payload(point: &Candidate, answer: &Answer) -> Option<f64> {
    match answer.payload_range {
        Some([low, _]) => Some(SEARCHED * low),
        None => answer.payload.filter(|_| !is_at_pressure(point.model)),
    }
}
