//! Requirements that no gripper meets: which of them exclude each other, and the closest requests that can be met.
//!
//! A **conflict** is a set of requirements that no gripper meets together, though one does without any one of them. It is found by giving
//! up one requirement after the other: those without which there is still no gripper do not belong to it. Its requirements are
//! given up, then the rest is searched for further conflicts. A conflict without any requirement is due to the object's size or the fabric.

use crate::candidate::Candidate;
use crate::sizing::easing::{Finder, Requirement};
use crate::sizing::{Choice, MOST_STARS, Requirements, feasible, no_tube};
use inflatable::mechanics::hinge::ring::RingTable;
use inflatable::mechanics::strength::GRAVITY;
use spec::units::{Force, in_unit};

/// Requirements that no gripper meets, and the closest ones that can be met.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// The reasons, one sentence each.
    pub reasons: Vec<String>,
    /// The closest requirements that can be met, each changed in another way.
    pub nearest: Vec<NearestRequirements>,
}

/// Requirements that can be met in place of others, and the grippers that meet them.
#[derive(Clone, Debug, PartialEq)]
pub struct NearestRequirements {
    /// The requirements.
    pub requirements: Requirements,
    /// The ways to meet them, the best first.
    pub choices: Vec<Choice>,
}

/// Requirements that exclude each other.
struct Conflict {
    members: Vec<Requirement>,
    /// All requirements but those of other conflicts.
    without_other_conflicts: Requirements,
}

/// The order in which requirements are given up: of two that would both do, the first is not part of the conflict.
const LIMITS: [Requirement; 5] =
    [Requirement::Machine, Requirement::Sheet, Requirement::Pressure, Requirement::Force, Requirement::Mass];
/// The order in which a conflict is described: the first of its requirements is missed under the conditions of the others.
const SUBJECTS: [Requirement; 5] =
    [Requirement::Mass, Requirement::Force, Requirement::Sheet, Requirement::Machine, Requirement::Pressure];
/// The order in which ways out are offered.
const OFFERS: [Requirement; 5] =
    [Requirement::Friction, Requirement::Pressure, Requirement::Sheet, Requirement::Force, Requirement::Mass];
/// Most combinations of ways out of several conflicts that are tried.
const COMBINATIONS: usize = 4;
/// A requirement is named as a condition if a way out without it differs by this much, as a logarithm: more than searches differ.
const NOTICED: f64 = 0.1;
/// A value is near another one if they differ by no larger factor.
const NEAR: f64 = 0.9;

/// The grippers that meet `requirements`, the best first, from `base`: its fabric, seal and radii of curvature.
///
/// # Errors
/// If there is none.
pub fn choose(
    requirements: &Requirements,
    base: &Candidate,
    ring: &RingTable,
) -> Result<Vec<Choice>, Infeasible> {
    if requirements.bounds(&requirements.candidate(base)).is_none() {
        return Err(Infeasible { reasons: vec![no_tube(base)], nearest: Vec::new() });
    }
    let choices = feasible(requirements, base, ring);
    if choices.is_empty() { Err(Finder { base, ring }.infeasible(requirements)) } else { Ok(choices) }
}

impl Finder<'_> {
    /// The reasons why no gripper meets `required`, and the requests near it that can be met.
    fn infeasible(&self, required: &Requirements) -> Infeasible {
        let conflicts = self.conflicts(required);
        let mut infeasible = self.explain(required, &conflicts);
        infeasible.reasons.extend(too_gentle(required));
        infeasible
    }

    /// The reasons by the `conflicts` of `required`, and the ways out of them.
    fn explain(&self, required: &Requirements, conflicts: &[Conflict]) -> Infeasible {
        match conflicts {
            [] => self.refuse_size(required),
            [conflict] => {
                let ways = self.ways_out(conflict);
                let subject = conflict.subject();
                let way = ways.iter().find(|(easing, _)| Some(*easing) == subject).map(|(_, way)| way);
                let reasons = self.reasons(conflict, way);
                let offered = ways.into_iter().filter(|(easing, _)| *easing != Requirement::Machine);
                Infeasible { reasons, nearest: offered.map(|(_, nearest)| nearest).collect() }
            }
            several => {
                let reasons = several.iter().flat_map(|conflict| {
                    let subject = conflict.subject();
                    let way = self.eased(&conflict.without_other_conflicts, subject.as_slice());
                    self.reasons(conflict, way.as_ref())
                });
                let reasons = reasons.collect();
                let nearest = combinations(several).find_map(|easings| self.eased(required, &easings));
                Infeasible { reasons, nearest: nearest.into_iter().collect() }
            }
        }
    }

    /// The conflicts of `required`; none if the object's size or the fabric is the reason.
    fn conflicts(&self, required: &Requirements) -> Vec<Conflict> {
        // A requirement belongs to a conflict if giving it up alone makes a gripper possible, while those that do not
        // matter are given up first. The requirements of a conflict are then given up together, and the rest is
        // searched for the next one. At the end each conflict gets the context in which all others are given up.
        let mut conflicts: Vec<Conflict> = Vec::new();
        let mut rest = *required;
        loop {
            let mut only_these = rest;
            let mut members = Vec::new();
            for limit in LIMITS.into_iter().filter(|limit| limit.applies(&rest)) {
                let Some(loosened) = limit.given_up(&only_these) else { continue };
                if self.grippers(&loosened).is_some() {
                    members.push(limit);
                } else {
                    only_these = loosened;
                }
            }
            if members.is_empty() {
                return conflicts;
            }
            rest = members.iter().fold(rest, |rest, limit| limit.given_up(&rest).unwrap_or(rest));
            conflicts.push(Conflict { members, without_other_conflicts: rest });
            if self.grippers(&rest).is_some() {
                break;
            }
        }
        for k in 0..conflicts.len() {
            let rivals = conflicts.iter().enumerate().filter(|(other, _)| *other != k);
            let rivals_members: Vec<Requirement> =
                rivals.flat_map(|(_, other)| other.members.clone()).collect();
            let without_rivals =
                rivals_members.iter().try_fold(*required, |loosened, kind| kind.given_up(&loosened));
            conflicts[k].without_other_conflicts = without_rivals.unwrap_or(*required);
        }
        conflicts
    }

    /// The ways out of the only `conflict`: each of its requirements eased alone, and more friction in place of less mass.
    fn ways_out(&self, conflict: &Conflict) -> Vec<(Requirement, NearestRequirements)> {
        let ways =
            OFFERS.into_iter().chain([Requirement::Machine]).filter(|easing| conflict.is_solved_by(*easing));
        ways.filter_map(|easing| Some((easing, self.eased(&conflict.without_other_conflicts, &[easing])?)))
            .collect()
    }

    /// The reasons of `conflict`; `way` is the nearest request with its subject eased alone.
    fn reasons(&self, conflict: &Conflict, way: Option<&NearestRequirements>) -> Vec<String> {
        let aggravating = way.map_or_else(Vec::new, |way| self.aggravating_requirements(conflict, way));
        conflict.reasons(way, &aggravating)
    }

    /// The requirements that do not belong to `conflict` and make `way`, in which its subject is eased alone, worse.
    fn aggravating_requirements(&self, conflict: &Conflict, way: &NearestRequirements) -> Vec<Requirement> {
        let Some(subject) = conflict.subject() else { return Vec::new() };
        let granted = subject.value(&way.requirements);
        let candidates = LIMITS.into_iter().filter(|limit| !conflict.members.contains(limit));
        candidates
            .filter(|limit| limit.applies(&conflict.without_other_conflicts))
            .filter(|limit| {
                let rest = limit.given_up(&conflict.without_other_conflicts);
                let looser = rest.and_then(|rest| self.eased(&rest, &[subject]));
                let ratio = looser.map_or(1.0, |looser| subject.value(&looser.requirements) / granted);
                libm::fabs(libm::log(ratio)) > NOTICED
            })
            .collect()
    }

    /// The refusal of an object of a size for which no gripper is known: the nearest size with one, and the request for it if it is near.
    fn refuse_size(&self, required: &Requirements) -> Infeasible {
        let width = required.width_in_words();
        let bare =
            LIMITS.iter().try_fold(*required, |bare, limit| limit.given_up(&bare)).unwrap_or(*required);
        let Some(sized) = self.eased(&bare, &[Requirement::Size]) else {
            let reason = "no tube of this fabric was computed as a shell with an object: another fabric";
            return Infeasible { reasons: vec![reason.to_owned()], nearest: Vec::new() };
        };
        let object = sized.requirements.object;
        let ratio = object.0 / required.object.0;
        let end = if ratio < 1.0 { "largest" } else { "smallest" };
        let reasons = vec![format!(
            "an object {width} across is outside the range in which shells were computed: the {end} is about {}",
            sized.requirements.width_in_words()
        )];
        let nearest = is_near(ratio)
            .then(|| self.grippers(&Requirement::Size.with_value(required, object.0)))
            .flatten();
        Infeasible { reasons, nearest: nearest.into_iter().collect() }
    }
}

/// Whether values of this `ratio` are near each other.
fn is_near(ratio: f64) -> bool {
    (NEAR..=1.0 / NEAR).contains(&ratio)
}

/// The ways out of several conflicts: one of each, those first that are offered first.
fn combinations(conflicts: &[Conflict]) -> impl Iterator<Item = Vec<Requirement>> {
    let mut lists: Vec<Vec<Requirement>> = vec![Vec::new()];
    for conflict in conflicts {
        let ways: Vec<Requirement> =
            OFFERS.into_iter().filter(|easing| conflict.is_solved_by(*easing)).collect();
        lists = lists
            .iter()
            .flat_map(|begun| ways.iter().map(move |way| [begun.as_slice(), &[*way]].concat()))
            .collect();
    }
    lists.into_iter().take(COMBINATIONS)
}

impl Conflict {
    /// Whether `easing` eases one of its requirements.
    fn is_solved_by(&self, easing: Requirement) -> bool {
        match easing {
            Requirement::Friction => {
                self.members.contains(&Requirement::Mass) && easing.applies(&self.without_other_conflicts)
            }
            Requirement::Pressure
            | Requirement::Sheet
            | Requirement::Force
            | Requirement::Mass
            | Requirement::Machine
            | Requirement::Size => self.members.contains(&easing),
        }
    }

    /// The requirement that is missed under the conditions of the others.
    fn subject(&self) -> Option<Requirement> {
        SUBJECTS.into_iter().find(|subject| self.members.contains(subject))
    }

    /// What is missed, and by how much: `limit` is the nearest request with its subject eased alone. `aggravating` has the requirements that do
    /// not belong to the conflict and make this limit lower.
    fn reasons(&self, limit: Option<&NearestRequirements>, aggravating: &[Requirement]) -> Vec<String> {
        let Some(subject) = self.subject() else { return Vec::new() };
        let required = &self.without_other_conflicts;
        let companions = SUBJECTS.into_iter().filter(|other| *other != subject);
        let companions =
            companions.filter(|other| self.members.contains(other) || aggravating.contains(other));
        let conditions: String = companions.filter_map(|other| other.condition(required)).collect();
        let eased = limit.map(|nearest| &nearest.requirements);
        let mut reasons = vec![subject.shortfall(required, eased) + &conditions];
        if subject == Requirement::Mass && required.height.is_none() && required.shape.is_none() {
            let reason =
                "the object is taken to be a ball: give its height, and the shape cylinder, if it is not";
            reasons.push(reason.to_owned());
        }
        reasons
    }
}

/// The reason that needs no search: friction needs more force than all stars of the highest stack may press with.
fn too_gentle(required: &Requirements) -> Option<String> {
    let needed_force = required.mass.0 * GRAVITY / required.friction;
    let bears = required.largest_force.filter(|bears| f64::from(MOST_STARS) * bears.0 < needed_force)?;
    let [force_text, mass, bears] = [
        Force(three_digits(needed_force)).to_string(),
        required.mass_in_words(),
        in_unit(bears, required.units.force),
    ];
    Some(format!("friction needs {force_text} to hold {mass}, and the object bears {bears} of each star"))
}

/// A positive number in three digits.
fn three_digits(value: f64) -> f64 {
    let step = libm::pow(10.0, libm::log10(value).floor() - 2.0);
    (value / step).round() * step
}

impl NearestRequirements {
    /// The changes from the requirements `required`, in words.
    pub fn changes(&self, required: &Requirements) -> String {
        self.changed(required).map(|(_, change)| change).collect::<Vec<_>>().join(" and ")
    }

    /// The requirements that differ from `required`, each with its change in words.
    fn changed(&self, required: &Requirements) -> impl Iterator<Item = (Requirement, String)> {
        let easings = OFFERS.into_iter().chain([Requirement::Size]);
        easings.filter_map(|easing| Some((easing, easing.change(required, &self.requirements)?)))
    }

    /// Whether each value is near that of `required`: within a tenth.
    pub fn is_near(&self, required: &Requirements) -> bool {
        self.changed(required)
            .all(|(easing, _)| is_near(easing.value(&self.requirements) / easing.value(required)))
    }
}
