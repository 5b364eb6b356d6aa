//! Which model answers: the one that was asked for, or the cheapest whose estimated error is accepted.

use crate::mechanics::fault::StarFault;
use crate::mechanics::hinge::bvp::Bvp;
use crate::mechanics::hinge::fit::Fit;
use crate::mechanics::hinge::ring::{Ring, RingTable};
use crate::mechanics::hinge::section::{Section, arms};
use crate::mechanics::hinge::{HingeModel, Level, fit};
use crate::mechanics::strength::{ElasticSheet, FULL_ACTUATION, INEXTENSIBLE, LimitEstimate, limit_estimate};

/// What the answer must be good for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// R* of the star's tip and corner.
    pub r_stars: [f64; 2],
    /// Bendability 1/eps; `None` without a pressure: then the limit of high pressure is meant.
    pub bendability: Option<f64>,
    /// Stretch p W / Y; 0 without a pressure.
    pub stretch: f64,
    /// Relative error that is accepted.
    pub accepted: f64,
}

/// A model, the error to expect of it, and why it was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The model.
    pub level: Level,
    /// Estimated relative errors of coiling and stiffness against a real hinge.
    pub error: LimitEstimate,
    /// One sentence.
    pub reason: String,
    /// Whether the error is accepted.
    pub good_enough: bool,
}

/// Beta of the `bvp` level; its distance from the exact ring is about ln(beta)/beta.
pub const BVP_BETA: f64 = 1000.0;

/// What is known of the arms where their table ends.
pub(super) const ARMS_LET_OUT: &str =
    "some 2 to 14 deg further and soften; the table of their effect ends before this hinge";

/// Of `section` where its table of arms ends: arms let a hinge coil 2 to 14 deg further and soften it by a tenth and more, by
/// shell computations of single hinges.
const WITHOUT_ARMS: LimitEstimate = LimitEstimate { coiling: 0.1, stiffness: 0.25 };

/// Of `section` with its arms, against shells of single hinges that the table does not hold (docs/models.md).
const WITH_ARMS: LimitEstimate = LimitEstimate { coiling: 0.02, stiffness: 0.1 };

/// Estimated errors of `level`: its distance from the exact ring, and the ring's from a real hinge.
///
/// The last part is the finite bendability and the stretch of the fabric; stiffness counts only if there is a pressure.
pub fn estimate(level: Level, question: &Question, table: &RingTable) -> LimitEstimate {
    let mut own = LimitEstimate { coiling: 0.0, stiffness: 0.0 };
    for r_star in question.r_stars {
        let one = match (level, table.at(r_star)) {
            (Level::Section, _) => return of_section(question),
            (Level::Fit, Ok(exact)) => LimitEstimate {
                coiling: (fit::TARGET_COILING / exact.lambda_t - 1.0).abs(),
                stiffness: (fit::target_curvature(r_star) / exact.curvature - 1.0).abs(),
            },
            (Level::Fit, Err(_)) => LimitEstimate { coiling: 1.0, stiffness: 1.0 },
            (Level::Ring, _) => LimitEstimate { coiling: 1e-12, stiffness: 1e-12 },
            (Level::Bvp, _) => {
                let gap = BVP_BETA.ln() / BVP_BETA;
                LimitEstimate { coiling: 2.0 * gap, stiffness: 7.0 * gap }
            }
        };
        own.coiling = own.coiling.max(one.coiling);
        own.stiffness = own.stiffness.max(one.stiffness);
    }
    let Some(bendability) = question.bendability else { return own };
    let limit = limit_estimate(bendability);
    LimitEstimate {
        coiling: own.coiling + limit.coiling + question.stretch,
        stiffness: own.stiffness + limit.stiffness + question.stretch,
    }
}

fn of_section(question: &Question) -> LimitEstimate {
    let Some(bendability) = question.bendability else { return WITHOUT_ARMS };
    let tau = (question.stretch / bendability).sqrt();
    let known = question.r_stars.iter().all(|r_star| arms::arms(bendability, tau, *r_star).is_some());
    if known { WITH_ARMS } else { WITHOUT_ARMS }
}

/// The cheapest level whose errors are accepted; the exact ring if none is.
pub fn choose(question: &Question, table: &RingTable) -> Choice {
    let percent = |x: f64| format!("{:.3} %", 100.0 * x);
    let accepted = percent(question.accepted);
    for level in [Level::Fit, Level::Ring] {
        let error = estimate(level, question, table);
        let worst = error.coiling.max(error.stiffness);
        if worst <= question.accepted {
            let reason = format!(
                "{} is the cheapest model whose estimated error, {}, is within the accepted {accepted}",
                level.name(),
                percent(worst)
            );
            return Choice { level, error, reason, good_enough: true };
        }
    }
    let error = estimate(Level::Ring, question, table);
    let reason = format!(
        "no model is estimated to be within the accepted {accepted}; ring, the exact membrane limit, is the best: \
         closing to {}, forces to {}",
        percent(error.coiling),
        percent(error.stiffness)
    );
    Choice { level: Level::Ring, error, reason, good_enough: false }
}

/// The model that was asked for by name, with the error to expect of it.
pub fn take(level: Level, question: &Question, table: &RingTable) -> Choice {
    let error = estimate(level, question, table);
    let good_enough = error.coiling.max(error.stiffness) <= question.accepted;
    Choice { level, error, reason: format!("{} was asked for", level.name()), good_enough }
}

/// The model of `level` for hinges of `sheet` (tube width `width`, m) at the gauge pressure `pressure` (Pa).
///
/// # Errors
/// If `section` has no pressure, or does not cover it with this sheet.
pub fn hinge_model(
    level: Level,
    sheet: &ElasticSheet,
    pressure: Option<f64>,
    width: f64,
) -> Result<Box<dyn HingeModel>, StarFault> {
    Ok(match level {
        Level::Fit => Box::new(Fit),
        Level::Ring => Box::new(Ring),
        Level::Bvp => Box::new(Bvp::new(BVP_BETA, 1e-6)),
        Level::Section => {
            let bendability = sheet.bendability(pressure.ok_or(StarFault::NoPressure)?, width);
            Box::new(Section::new(bendability, sheet.thickness / width, sheet.poisson_ratio)?)
        }
    })
}

/// What lies outside of the models' validity, in words.
pub fn limits_of_validity(level: Level, question: &Question) -> Vec<String> {
    let mut warnings = Vec::new();
    if level == Level::Section {
        if of_section(question) == WITHOUT_ARMS {
            warnings.push(format!(
                "section computes these hinges without arms, which let them coil {ARMS_LET_OUT}"
            ));
        }
        return warnings;
    }
    if let Some(bendability) = question.bendability
        && bendability < FULL_ACTUATION
    {
        warnings.push(format!(
            "bendability {bendability:.0} is below {FULL_ACTUATION:.0}: the hinges are not fully actuated, \
             and the star closes less than predicted"
        ));
    }
    if question.stretch > INEXTENSIBLE {
        warnings.push(format!(
            "p W / Y is {:.3}: the fabric stretches, which {} does not take into account; section does",
            question.stretch,
            level.name()
        ));
    }
    if level == Level::Fit {
        for r_star in question.r_stars {
            let (target, stiffness) = fit::covers(r_star);
            if !target || !stiffness {
                let what = if stiffness { "target coiling was" } else { "constants were" };
                warnings.push(format!("the published {what} not given for R* = {r_star:.4}"));
            }
        }
        warnings.dedup();
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn question(accepted: f64, bendability: Option<f64>) -> Question {
        Question { r_stars: [0.1, 0.1], bendability, stretch: 0.001, accepted }
    }

    #[test]
    fn the_cheapest_that_is_good_enough_is_taken() {
        let table = RingTable::new().expect("solved");
        assert_eq!(choose(&question(0.2, None), &table).level, Level::Fit);
        assert_eq!(choose(&question(0.05, None), &table).level, Level::Ring);
        assert!(choose(&question(0.05, None), &table).good_enough);
    }

    #[test]
    fn where_none_is_good_enough_it_says_so() {
        let table = RingTable::new().expect("solved");
        let choice = choose(&question(0.1, Some(400.0)), &table);
        assert!(choice.level == Level::Ring && !choice.good_enough && choice.error.stiffness > 0.5);
        assert!(choice.reason.contains("no model"));
        assert!(!limits_of_validity(Level::Ring, &question(0.1, Some(400.0))).is_empty());
        assert!(limits_of_validity(Level::Ring, &question(0.1, Some(4000.0))).is_empty());
    }

    #[test]
    fn the_fit_is_not_stretched_beyond_its_range() {
        let sharp = Question { r_stars: [0.0, 0.1], ..question(0.1, None) };
        assert_eq!(limits_of_validity(Level::Fit, &sharp).len(), 1);
        assert!(limits_of_validity(Level::Fit, &question(0.1, None)).is_empty());
    }
}
