//! Curves around one prediction, for charts: its stars at other pressures, on other objects and with other numbers of points.
//!
//! All curves use the prediction's closed forms and its model. So at the spec's own pressure, object and number of points they equal
//! the prediction, with its ranges. Values that the prediction reports as unknown are left out.

use serde::Serialize;

use crate::case::Case;
use crate::interval::{Interval, mm};
use crate::model_selection::{corrected, named_limit, of_spec};
use crate::outcome::Outcome;
use crate::pose::{Pose, at_angle, holding_angle};
use design::{Design, Meeting, PlacedPart, Star};
use inflatable::mechanics::fault::HingeFault;
use inflatable::mechanics::hinge::{Arms, HingeModel, HingeState, Level};
use inflatable::mechanics::star::response::Inflated;
use spec::units::{Length, Pressure};
use spec::{ModelChoice, Spec, StarSpec};

/// Pressures of a table: up to one and a half times the spec's own, which is one of them, so that every picture has it.
const PRESSURES: u32 = 24;
/// Index of the spec's own pressure.
const OWN: u32 = 16;
/// Radii of a curve of forces.
const RADII: u32 = 40;
/// Numbers of points that are compared.
const POINTS: std::ops::RangeInclusive<u32> = 3..=10;
/// The last part of the radii, before the arms lock and the force grows without bound, is no curve that can be shown.
const SHOWN: f64 = 0.97;

/// The curves of one distinct star. Lengths in mm, pressures in kPa, forces in N.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Charts {
    /// The first star of the stack that it is for.
    pub star: usize,
    /// The model that answered.
    pub model: &'static str,
    /// Values by pressure, rising; pressures without a prediction are left out.
    pub by_pressure: Vec<AtPressure>,
    /// Force by the radius of the object at the spec's own pressure.
    pub by_radius: Vec<AtRadius>,
    /// Values of stars with other numbers of points and all else equal; numbers without a prediction are left out.
    pub by_points: Vec<AtPoints>,
}

/// A star at one pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct AtPressure {
    /// Gauge pressure.
    pub pressure_kPa: f64,
    /// Inner radius of the star without an object.
    pub final_radius_mm: f64,
    /// Range of the final radius; `None` if unknown.
    pub radius_range_mm: Option<Interval>,
    /// Radial force on the spec's object; `None` without one, or where the star cannot hold it.
    pub object_force_N: Option<f64>,
    /// The star as it is drawn: on the object where it reaches it, else closed.
    pub pose: Pose,
}

/// A star around one object.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct AtRadius {
    /// Radius of the object.
    pub radius_mm: f64,
    /// Radial force.
    pub force_N: f64,
    /// Range of the force; `None` if unknown.
    pub force_range_N: Option<Interval>,
}

/// A star of another number of points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct AtPoints {
    /// Number of points.
    pub points: u32,
    /// 1 - `rho_f` / `rho_0`.
    pub contraction: f64,
    /// Range of the contraction; `None` if unknown.
    pub contraction_range: Option<Interval>,
    /// Radial force on the spec's object; `None` without one, or where the star cannot hold it.
    pub object_force_N: Option<f64>,
}

/// The curves of every distinct star of `design`, in the order of [`Design::firsts`], by the model that `spec` selects. Empty for a
/// drawing, and without a pressure, which every curve needs.
pub fn charts(spec: &Spec, design: &Design) -> Vec<Charts> {
    let Some(design) = design.assembly() else { return Vec::new() };
    if spec.load.as_ref().and_then(|load| load.pressure).is_none() {
        return Vec::new();
    }
    let meetings = design.meetings(spec);
    let of_star = |placed: &PlacedPart| {
        let star = &design.part(placed).star;
        let star_spec = spec.stars.get(placed.index - 1)?;
        // The object's radius that this star meets, as in its prediction.
        let meeting = meetings.as_ref().and_then(|all| all.get(placed.index - 1)).copied();
        let case = Case::of_star(spec, star).ok()?.meeting(meeting);
        let question = Question { chosen: spec.accuracy.model, case, star };
        Some(Charts {
            star: placed.index,
            model: named_limit(question.chosen).unwrap_or(Level::Section).name(),
            by_pressure: (1..=PRESSURES).filter_map(|k| question.at_pressure(k)).collect(),
            by_radius: question.by_radius().unwrap_or_default(),
            by_points: question.by_points(spec, star_spec, meeting).unwrap_or_default(),
        })
    };
    design.firsts().filter_map(of_star).collect()
}

/// One star and the model selected for it.
struct Question<'a> {
    chosen: ModelChoice,
    case: Case,
    star: &'a Star,
}

impl Question<'_> {
    /// The model at a pressure, Pa; `None` where it does not cover the star.
    fn model(&self, pressure: f64) -> Option<Box<dyn HingeModel>> {
        let model = of_spec(self.chosen, &self.case, pressure).ok()?;
        if named_limit(self.chosen).is_none() {
            return Some(model);
        }
        let mechanism = &self.case.mechanism;
        let [tip, corner] = [mechanism.tip(), mechanism.corner()].map(|hinge| hinge.r_star);
        let first = (tip, model.target(tip).ok()?);
        let second = if tip == corner { first } else { (corner, model.target(corner).ok()?) };
        Some(Box::new(ModelTargets { model, targets: [first, second] }))
    }

    /// The star at `k` parts of [`OWN`] of the spec's own pressure; `None` where a prediction calls it unknown.
    fn at_pressure(&self, k: u32) -> Option<AtPressure> {
        let pressure = self.case.pressure? * (f64::from(k) / f64::from(OWN));
        let model = self.model(pressure)?;
        let (case, outcome) =
            Outcome::by_model(&Case { pressure: Some(pressure), ..self.case }, &*model).ok()?;
        if !outcome.known {
            return None;
        }
        let rest = outcome.rest.angle;
        let object = case.object.map(Length::from_metres);
        let tip_angle = holding_angle(&case.mechanism, rest, object).unwrap_or(rest);
        Some(AtPressure {
            pressure_kPa: Pressure::from_pascals(pressure).0,
            final_radius_mm: Length::from_metres(outcome.rest.radius).0,
            radius_range_mm: outcome.ranges.radius.map(mm),
            object_force_N: outcome.object_force(),
            pose: Pose::new(&at_angle(self.star, &case.mechanism, tip_angle)),
        })
    }

    fn by_radius(&self) -> Option<Vec<AtRadius>> {
        let pressure = self.case.pressure?;
        let model = self.model(pressure)?;
        let case = corrected(&self.case, &*model).ok()?;
        let inflated = Inflated::new(&case.mechanism, &*model, pressure).ok()?;
        let linear = Outcome::linear(&case, &inflated);
        let [smallest, largest] = linear.graspable;
        // The arms lock where the star opens widest.
        let largest_shown = if largest < linear.rest.widest.radius {
            largest
        } else {
            smallest + SHOWN * (largest - smallest)
        };
        let with_radius = |k: u32| {
            let rho = smallest + (largest_shown - smallest) * f64::from(k) / f64::from(RADII);
            let outcome = Outcome::linear(&case.on_cylinder(rho.min(largest_shown)), &inflated);
            Some(AtRadius {
                radius_mm: Length::from_metres(rho).0,
                force_N: outcome.object_force()?,
                force_range_N: outcome.force_range,
            })
        };
        Some((0..=RADII).filter_map(with_radius).collect())
    }

    fn by_points(
        &self,
        spec: &Spec,
        star_spec: &StarSpec,
        meeting: Option<Meeting>,
    ) -> Option<Vec<AtPoints>> {
        let pressure = self.case.pressure?;
        // Targets hang on R*, the pressure and the width, not on how many hinges there are.
        let model = self.model(pressure)?;
        let with_points = |points: u32| {
            let star = Star::new(&StarSpec { points, inlet_tip: 1, ..star_spec.clone() }).ok()?;
            let (case, outcome) =
                Outcome::by_model(&Case::of_star(spec, &star).ok()?.meeting(meeting), &*model).ok()?;
            outcome.known.then(|| AtPoints {
                points,
                contraction: outcome.contraction,
                contraction_range: outcome.contraction_range(&case),
                object_force_N: outcome.object_force(),
            })
        };
        let further = std::iter::once(star_spec.points).filter(|points| !POINTS.contains(points));
        Some(POINTS.chain(further).filter_map(with_points).collect())
    }
}

/// A model that keeps the two targets of one star, which are most of its work.
struct ModelTargets {
    model: Box<dyn HingeModel>,
    targets: [(f64, HingeState); 2],
}

impl HingeModel for ModelTargets {
    fn level(&self) -> Level {
        self.model.level()
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        self.model.state(r_star, lambda)
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        let target = self.targets.iter().find(|(own, _)| *own == r_star);
        target.map_or_else(|| self.model.target(r_star), |(_, state)| Ok(*state))
    }

    fn onset(&self, r_star: f64) -> Result<Option<f64>, HingeFault> {
        self.model.onset(r_star)
    }

    fn arms(&self, r_star: f64, arc: f64) -> Option<Arms> {
        self.model.arms(r_star, arc)
    }
}
