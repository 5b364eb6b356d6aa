//! Grippers that meet requirements; where none does, a request near it that can be met.

use crate::candidate::Candidate;
use crate::load_check::COATED;
use crate::optimize::{Constraints, DesignSearch, Goal, SearchBounds, SearchEffort, sure_payload};
use crate::sizing::{
    Choice, MARGIN, MOST_STARS, Requirements, SEARCHED_MARGIN, Shortfall, Workspace, feasible, no_tube,
};
use inflatable::mechanics::hinge::ring::RingTable;
use inflatable::mechanics::strength::GRAVITY;
use spec::units::{Force, Length, Mass};

/// Requirements that no gripper meets, and the closest ones that can be met.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// The reasons, one sentence each.
    pub reasons: Vec<String>,
    /// The closest requirements that can be met; `None` if none were found.
    pub nearest: Option<Box<NearestRequirements>>,
}

/// Requirements that can be met in place of others, and the grippers that meet them.
#[derive(Clone, Debug, PartialEq)]
pub struct NearestRequirements {
    /// The requirements: less mass, a larger sheet, any pressure, an object that bears more, or an object of
    /// another size.
    pub requirements: Requirements,
    /// The ways to meet them, the best first.
    pub choices: Vec<Choice>,
}

/// Margin on the size of sheets, mm: they are cut with hand tools.
const SHEET: f64 = 10.0;
/// Trial masses as parts of the largest one: near it there are few grippers, and a search may miss them.
const RESERVES: [f64; 3] = [0.9, 0.7, 0.4];
/// Trial forces of one star in place of the object's limit, over the larger one of that limit and the force that all stars need together.
const SHARES: [f64; 10] = [0.25, 0.35, 0.5, 0.7, 1.0, 1.1, 1.4, 2.0, 2.8, 4.0];
/// Trial sizes of objects over the requested one, if no other change is enough.
const SIZES: [f64; 4] = [0.7, 0.4, 0.2, 2.0];

/// The grippers that meet `requirements`, the best first, from `base`: its fabric, seal and radii of
/// curvature.
///
/// # Errors
/// If there is none.
pub fn choose(
    requirements: &Requirements,
    base: &Candidate,
    ring: &RingTable,
) -> Result<Vec<Choice>, Infeasible> {
    feasible(requirements, base, ring).map_err(|obstacle| match obstacle {
        Shortfall::Star(best) => {
            let mut reasons = requirements.reasons(base, best.as_deref());
            let nearest = nearest(requirements, base, ring).map(Box::new);
            // Only a friction that was tried is named: it does not help if other requirements are missed, too.
            let rougher = nearest.iter().map(|nearest| nearest.requirements.friction);
            reasons.extend(rougher.filter(|friction| *friction > requirements.friction).map(|friction| {
                format!("a friction of {friction} would do: silicone-coated corners reach about 1")
            }));
            Infeasible { reasons, nearest }
        }
        Shortfall::Tube => Infeasible { reasons: vec![no_tube(base)], nearest: None },
    })
}

/// The closest requirements to `requirements` that can be met: coated corners or a larger sheet or another pressure, an object that bears
/// more, less mass, at last another size. A largest force may grow, but is never dropped.
fn nearest(requirements: &Requirements, base: &Candidate, ring: &RingTable) -> Option<NearestRequirements> {
    let tried = |requirements: Requirements| {
        let choices = feasible(&requirements, base, ring).ok()?;
        Some(NearestRequirements { requirements, choices })
    };
    let bearing_more = |requirements: Requirements| {
        let asked = requirements.largest_force?.0;
        let all = MARGIN * requirements.mass.0 * GRAVITY / requirements.friction;
        let forces = SHARES.into_iter().map(|share| (100.0 * share * all.max(asked)).ceil() / 100.0);
        forces
            .filter(|force| *force > asked)
            .find_map(|force| tried(Requirements { largest_force: Some(Force(force)), ..requirements }))
    };
    let rougher = |most: f64| {
        let friction = requirements.friction * requirements.mass.0 / most;
        let all = RESERVES.into_iter().map(|part| (100.0 * friction / part).ceil() / 100.0);
        all.filter(|friction| *friction > requirements.friction && *friction <= COATED)
            .find_map(|friction| tried(Requirements { friction, friction_assumed: false, ..*requirements }))
    };
    let lighter = |requirements: Requirements, most: f64| {
        let masses = RESERVES.into_iter().map(|part| three_digits(part * most.min(requirements.mass.0)));
        masses.flatten().find_map(|mass| tried(Requirements { mass, ..requirements }))
    };
    let without_pressure = Requirements { pressure: None, ..*requirements };
    let endless = Requirements { room: Workspace { sheet: None, ..requirements.room }, ..without_pressure };
    let eased = || {
        let larger_sheet = requirements.room.sheet.and_then(|_| on_larger_sheet(requirements, base, ring));
        larger_sheet.or_else(|| requirements.pressure.and_then(|_| tried(without_pressure)))
    };
    let resized = SIZES.map(|factor| {
        let object = Length((factor * requirements.object.0).round().max(1.0));
        Requirements { object, ..endless }
    });
    // Without a largest mass, it is not the mass that is too much.
    let most = heaviest(requirements, base, ring);
    most.map_or_else(eased, rougher)
        .or_else(|| bearing_more(*requirements))
        .or_else(|| lighter(*requirements, most?))
        .or_else(|| {
            (endless != *requirements).then(|| tried(endless).or_else(|| bearing_more(endless))).flatten()
        })
        .or_else(|| resized.into_iter().find_map(tried))
        .or_else(|| resized.into_iter().find_map(|one| lighter(one, heaviest(&one, base, ring)?)))
}

/// The largest mass that the gripper can carry with its margin and all other requirements, kg; `None` if they cannot be
/// met.
fn heaviest(requirements: &Requirements, base: &Candidate, ring: &RingTable) -> Option<f64> {
    let base = requirements.candidate(base);
    let bounds = SearchBounds { stars: 1..=MOST_STARS, ..requirements.bounds(&base)? };
    let constraints = Constraints { payload: None, ..requirements.constraints(&base, 1.0) };
    let search = DesignSearch::new(&base, &bounds, &constraints, Goal::Payload, ring);
    let search = DesignSearch { effort: SearchEffort::QUICK, ..search };
    let most = search.run().best.into_iter().find(|one| one.violation == 0.0)?;
    Some(sure_payload(&most.point, &most.answer)? / SEARCHED_MARGIN)
}

/// A mass rounded down to three digits and whole milligrams; `None` if the result is zero.
pub(super) fn three_digits(mass: f64) -> Option<Mass> {
    let digit = libm::pow(10_f64, libm::log10(mass).floor() - 2.0);
    let mass = ((mass / digit).floor() * digit * 1e6).round() / 1e6;
    (mass > 0.0).then_some(Mass(mass))
}

/// The same on a sheet that is as large as it must be, as far as the machine reaches.
fn on_larger_sheet(
    requirements: &Requirements,
    base: &Candidate,
    ring: &RingTable,
) -> Option<NearestRequirements> {
    let endless = Requirements { room: Workspace { sheet: None, ..requirements.room }, ..*requirements };
    let choices = feasible(&endless, base, ring).ok()?;
    let best = &choices.first()?.best;
    let reach = best.answer.star.tip_reach() + best.point.seal.band.0 + best.point.seal.allowance.0;
    let side = Length(((2.0 * reach + requirements.room.edge.0) / SHEET).ceil() * SHEET);
    let exact = Requirements { room: Workspace { sheet: Some(side), ..requirements.room }, ..*requirements };
    match feasible(&exact, base, ring) {
        Ok(choices) => Some(NearestRequirements { requirements: exact, choices }),
        Err(_) => Some(NearestRequirements { requirements: endless, choices }),
    }
}
