//! One design among many: the same closed forms as a prediction's, by the section's table, in a few microseconds.

mod star_cases;

use crate::case::Case;
use crate::interval::{Interval, scaled};
use crate::model_selection::tabled;
use crate::outcome::Outcome;
use crate::payload::{Bearers, stack_payload};
use crate::prediction::StackPayload;
use crate::seal_load::burst;
use design::{Refusal, RefusalCode, SHEETS, Star, cut_area, opening};
use inflatable::mechanics::fault::{HingeFault, StarFault};
use inflatable::mechanics::hinge::fit::Fit;
use inflatable::mechanics::hinge::ring::RingTable;
use spec::units::{Length, Pressure};
use spec::{Code, Fabric, Inlet, Load, ModelChoice, ProcessSpec, Seal, Spec, StarSpec};
use std::fmt;

/// One gripper, in the spec's units: the values of a spec that determine its prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The lowest star.
    pub star: StarSpec,
    /// All stars, bottom first, if they differ; empty if all are as the lowest. A search has equal stars only.
    pub unequal: Vec<StarSpec>,
    /// The fabric.
    pub fabric: Fabric,
    /// The seal.
    pub seal: Seal,
    /// The processes that loops of its stars may name.
    pub processes: Vec<ProcessSpec>,
    /// The inlet.
    pub inlet: Option<Inlet>,
    /// Diameter of the registration holes.
    pub hole_diameter: Length,
    /// The load; values that the spec leaves out are `None`.
    pub load: Load,
    /// Number of stars.
    pub stars: u32,
    /// Thickness of the frame's plates, between which they lie.
    pub plate: Length,
    /// Room between the flat star and the opening of a plate.
    pub clearance: Length,
    /// The model: `ring` and `fit` as limits, for all others `section`.
    pub model: ModelChoice,
}

/// The predicted values of one design; `None` where an input is missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The flat star.
    pub star: Star,
    /// The inputs as the model uses them.
    pub case: Case,
    /// The outcome of the lowest star, with linear hinges; `None` without a pressure, or where `section` does not cover it.
    pub outcome: Option<Outcome>,
    /// The outcome of the star that meets the widest part of the object: the same where all stars meet the same radius.
    pub grip: Option<Outcome>,
    /// Pressure of full actuation.
    pub operating_pressure: Pressure,
    /// Burst pressure.
    pub burst: Option<Pressure>,
    /// Payload of the stack, kg.
    pub payload: Option<f64>,
    /// Range of the payload.
    pub payload_range: Option<Interval>,
    /// Fabric of one star, both sheets, mm^2; `None` if the star cannot be cut out as the spec requires.
    pub fabric: Option<f64>,
}

/// Reason for a design without an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefusedDesign {
    /// A code for scripts, such as "no-arm": one of docs/codes.md.
    pub code: &'static str,
    /// The found value, the allowed values, and the remedy.
    pub text: String,
}

impl fmt::Display for RefusedDesign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for RefusedDesign {}

impl From<Refusal> for RefusedDesign {
    fn from(refusal: Refusal) -> Self {
        Self { code: refusal.code.as_str(), text: refusal.to_string() }
    }
}

impl From<StarFault> for RefusedDesign {
    fn from(fault: StarFault) -> Self {
        Self::unpredicted(fault.to_string())
    }
}

impl RefusedDesign {
    /// A design without a prediction.
    pub(super) fn unpredicted(text: String) -> Self {
        Self { code: RefusalCode::NoPrediction.as_str(), text }
    }
}

impl Candidate {
    /// The gripper of `spec`; `None` if it has no stars.
    pub fn from_spec(spec: &Spec) -> Option<Self> {
        let first = spec.stars.first()?;
        // Predictions do not depend on where an inlet is, or how a star is turned.
        let differ = spec.stars.iter().any(|star| {
            let placed = StarSpec { rotation: first.rotation, inlet_tip: first.inlet_tip, ..star.clone() };
            placed != *first
        });
        Some(Self {
            star: first.clone(),
            unequal: if differ { spec.stars.clone() } else { Vec::new() },
            fabric: spec.fabric.clone(),
            seal: spec.seal.clone(),
            processes: spec.processes.clone(),
            inlet: spec.inlet.clone(),
            hole_diameter: spec.sheet.hole_diameter,
            load: spec.load.clone().unwrap_or_default(),
            stars: u32::try_from(spec.stars.len()).unwrap_or(u32::MAX),
            plate: spec.frame.plate_thickness,
            clearance: spec.frame.clearance,
            model: spec.accuracy.model,
        })
    }

    /// The predicted values, with linear hinges; `ring` gives the load on the seal.
    ///
    /// # Errors
    /// If there is no such star, or a model has no answer for it.
    pub fn answer(&self, ring: &RingTable) -> Result<Answer, RefusedDesign> {
        self.answer_by(ring, |case| match self.model {
            ModelChoice::Ring => Outcome::correcting(case, ring).map(Some),
            ModelChoice::Fit => Outcome::correcting(case, &Fit).map(Some),
            ModelChoice::Auto | ModelChoice::Section | ModelChoice::Shell | ModelChoice::Bvp => {
                by_section(case)
            }
        })
    }

    /// The answer with the outcome from `outcome_of`, which gives the case its model's corrections; `None` where the model does not cover it.
    ///
    /// # Errors
    /// The errors of [`Candidate::answer`].
    pub(super) fn answer_by(
        &self,
        ring: &RingTable,
        outcome_of: impl Fn(&mut Case) -> Result<Option<Outcome>, StarFault>,
    ) -> Result<Answer, RefusedDesign> {
        let star = Star::for_band(&self.star, self.seal.band)?;
        let case = Case::new(&star, &self.fabric, &self.seal, Some(&self.load))?
            .with_strengths(self.strengths(&self.star))
            .above_plate(Some(opening([self.star.inner_radius.0], self.clearance.0)));
        let cases = self.different_cases(&star, &case)?;
        let mut case = cases.first().map_or(case, |(case, _)| *case);
        let outcome = outcome_of(&mut case)?;
        let mut grip = outcome;
        let mut payload = payload_of_equal(outcome.as_ref(), self.stars);
        if !cases.is_empty() {
            let answers = cases
                .into_iter()
                .map(|(mut case, slopes)| Ok((case.object.unwrap_or(0.0), slopes, outcome_of(&mut case)?)));
            let bearing_stars = answers.collect::<Result<Vec<_>, StarFault>>()?;
            grip = bearing_stars.iter().max_by(|a, b| a.0.total_cmp(&b.0)).and_then(|widest| widest.2);
            let bearers: Vec<Bearers> = bearing_stars
                .into_iter()
                .map(|(_, slopes, outcome)| Bearers::of_outcome(outcome.as_ref(), slopes))
                .collect();
            payload = stack_payload(&self.load, &bearers);
        }
        let area =
            cut_area(&star, &self.seal, self.inlet.as_ref(), self.star.inlet_tip, self.hole_diameter.0);
        Ok(Answer {
            operating_pressure: Pressure::from_pascals(case.operating_pressure()),
            burst: burst(&case, ring).map(Pressure::from_pascals),
            star,
            case,
            outcome,
            grip,
            payload: payload.kg,
            payload_range: payload.range_kg,
            fabric: area.map(|area| SHEETS * area),
        })
    }
}

impl Answer {
    /// The answer of a stack of `count` stars that all meet the object as this one does.
    #[must_use]
    pub fn of_stars(mut self, count: u32) -> Self {
        let payload = payload_of_equal(self.grip.as_ref(), count);
        (self.payload, self.payload_range) = (payload.kg, payload.range_kg);
        self
    }
}

/// The payload of `stars` stars that all meet the middle of the object, as the star of `outcome` does.
fn payload_of_equal(outcome: Option<&Outcome>, stars: u32) -> StackPayload {
    let count = f64::from(stars);
    StackPayload {
        kg: outcome.and_then(|outcome| outcome.payload).map(|of_one| count * of_one),
        range_kg: outcome.and_then(|outcome| outcome.payload_range).map(|of_one| scaled(of_one, count)),
    }
}

/// The outcome of the star of `case` by `section`, with whose corrections it is left; `None` where `section` does not cover the star.
fn by_section(case: &mut Case) -> Result<Option<Outcome>, StarFault> {
    let Some(pressure) = case.pressure else { return Ok(None) };
    match tabled(case, pressure) {
        Ok(model) => Outcome::correcting(case, &model).map(Some),
        Err(StarFault::Hinge(HingeFault::Scale { .. } | HingeFault::RStar { .. })) => Ok(None),
        Err(fault) => Err(fault),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predict::predict;
    use design::Design;
    use spec::units::LineForce;
    use spec::{Source, read, starter};

    /// Rounded hinges that differ, a stack, all optional inputs, and outer loops so weak that corners may open first.
    fn spec(radii: [f64; 2]) -> Spec {
        let star = "\n[star]\nouter_process = \"weak\"\n";
        let text = starter("x").expect("a name").replace("\n[star]\n", star)
            + "\n[process.weak]\nstrength = \"0.9 N/mm\"\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nobject_height = \"150 mm\"\nobject_shape = \"cylinder\"\nfriction = 0.5\n";
        let mut spec = read(&Source::new("x", text)).expect("valid").spec;
        spec.accuracy.model = spec::ModelChoice::Ring;
        spec.fabric.seal_strength = Some(LineForce(3.0));
        spec.fabric.areal_density = Some(spec::units::ArealDensity(0.27));
        spec.stars = vec![spec.stars[0].clone(); 3];
        for star in &mut spec.stars {
            (star.tip_radius, star.corner_radius) = (Length(radii[0]), Length(radii[1]));
        }
        spec
    }

    #[test]
    fn a_candidate_says_what_the_prediction_says() {
        // The search computes with candidates, and people read predictions. Both are made from equal specs with sharp
        // and round hinges, by two models, and their numbers compared to rounding.
        let profile = Source::new("generic", spec::builtin_machine("generic").expect("built in"));
        let machine = spec::read_machine(&profile).expect("valid");
        let table = RingTable::new().expect("solved");
        let radii = [[0.0, 0.0], [2.0, 0.0], [0.0, 3.0], [1.5, 2.5]];
        let models = [spec::ModelChoice::Ring, spec::ModelChoice::Auto];
        for (radii, model) in radii.into_iter().flat_map(|radii| models.map(|model| (radii, model))) {
            let mut gripper = spec(radii);
            gripper.accuracy.model = model;
            let design = Design::new(&gripper, &machine).expect("makeable");
            let full = predict(&gripper, &design).expect("predictable");
            let fast = Candidate::from_spec(&gripper).expect("a star").answer(&table).expect("feasible");
            let mass = fast.fabric.map(|area| area * 0.27e-3);
            let stated = |value: Option<f64>| value.expect("asked for");
            let outcome = fast.outcome.expect("a limit");
            let [smallest, largest] = outcome.graspable.map(|metres| Length::from_metres(metres).0);
            let first = &full.first;
            let pairs = [
                (fast.star.l, first.arm_length_mm),
                (outcome.contraction, stated(first.contraction)),
                (smallest, stated(first.final_radius_mm)),
                (largest, first.graspable_radius_mm.expect("a limit")[1]),
                (fast.operating_pressure.0, first.operating_pressure_kPa),
                (stated(outcome.stiffness), stated(first.radial_stiffness_N_per_m)),
                (stated(outcome.object_force()), stated(first.object_force_N)),
                (stated(fast.payload), stated(first.payload_kg)),
                (stated(fast.burst.map(|p| p.0)), stated(first.burst_pressure_kPa)),
                (stated(mass), stated(first.mass_g)),
                (3.0 * stated(mass), stated(full.stack_mass_g)),
            ];
            for (a, b) in pairs {
                assert!((a / b - 1.0).abs() < 1e-9, "{radii:?}: {a} {b}");
            }
        }
    }

    /// A ball that the lowest star would not let in enters from above, past two wider ones.
    #[test]
    fn unequal_stars_are_counted_one_by_one() {
        // Stacks of three unequal stars hold balls and a cylinder at different heights. Force, payload and range are
        // those of the whole prediction.
        let profile = Source::new("generic", spec::builtin_machine("generic").expect("built in"));
        let machine = spec::read_machine(&profile).expect("valid");
        let table = RingTable::new().expect("solved");
        for (radius, shape) in [(45.0, None), (49.0, None), (40.0, Some(spec::ObjectShape::Cylinder))] {
            let mut gripper = spec([0.0, 0.0]);
            gripper.accuracy.model = spec::ModelChoice::Auto;
            gripper.stars[1].inner_radius = Length(55.0);
            gripper.stars[2] =
                StarSpec { inner_radius: Length(60.0), pitch: Length(34.0), ..gripper.stars[2].clone() };
            let load = gripper.load.as_mut().expect("given");
            (load.object_radius, load.object_height, load.object_shape) =
                (Some(Length(radius)), Some(Length(150.0)), shape);
            let design = Design::new(&gripper, &machine).expect("makeable");
            let full = predict(&gripper, &design).expect("predictable").first;
            let fast = Candidate::from_spec(&gripper).expect("a star").answer(&table).expect("feasible");
            let force = fast.outcome.expect("known").object_force();
            assert_eq!(force.is_some(), full.object_force_N.is_some(), "{radius}");
            let [range, of_full] =
                [fast.payload_range, full.ranges.payload_kg].map(|range| range.expect("known"));
            let pairs = [
                (force, full.object_force_N),
                (fast.payload, full.payload_kg),
                (Some(range[0]), Some(of_full[0])),
                (Some(range[1]), Some(of_full[1])),
            ];
            for (a, b) in pairs.into_iter().filter_map(|(a, b)| Some((a?, b?))) {
                assert!((a / b - 1.0).abs() < 1e-9, "{radius}: {a} {b}");
            }
        }
    }

    /// The two outer stars pass above and below a ball of 60 mm, and meet one of 120 mm where it is 89 mm across.
    #[test]
    fn stars_of_a_stack_meet_a_ball_at_their_own_heights() {
        let profile = Source::new("generic", spec::builtin_machine("generic").expect("built in"));
        let machine = spec::read_machine(&profile).expect("valid");
        let table = RingTable::new().expect("solved");
        for (radius, pitch) in [(30.0, 40.0), (40.0, 25.0), (44.0, 25.0)] {
            let mut gripper = spec([0.0, 0.0]);
            gripper.accuracy.model = spec::ModelChoice::Auto;
            gripper.stars.iter_mut().for_each(|star| star.pitch = Length(pitch));
            let load = gripper.load.as_mut().expect("given");
            (load.object_radius, load.object_height, load.object_shape) = (Some(Length(radius)), None, None);
            let design = Design::new(&gripper, &machine).expect("makeable");
            let full = predict(&gripper, &design).expect("predictable");
            let fast = Candidate::from_spec(&gripper).expect("a star").answer(&table).expect("feasible");
            let radii: Vec<f64> = full.stars.iter().filter_map(|star| star.object_radius_mm).collect();
            let end = f64::max(radius * radius - pitch * pitch, 0.0).sqrt();
            assert!(
                (radii[0] - end).abs() < 1e-9 && (radii[1] - radius).abs() < 1e-9 && radii[2] == radii[0],
                "{radii:?}"
            );
            let forces: Vec<f64> = full.stars.iter().filter_map(|star| star.object_force_N).collect();
            assert!(forces[0] < forces[1] && forces[2] == forces[0], "{forces:?}");
            let sum: f64 = full.stars.iter().filter_map(|star| star.payload_kg).sum();
            for payload in [fast.payload, full.first.payload_kg] {
                assert!((payload.expect("asked for") - sum).abs() < 1e-9, "{payload:?} {sum}");
            }
            let grip = fast.grip.and_then(|own| own.object_force()).expect("held");
            assert!((grip - forces[1]).abs() < 1e-9, "{grip} {forces:?}");
        }
    }
}
