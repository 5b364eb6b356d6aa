//! Selects the model: the one named in the spec, or the cheapest that covers the star at its pressure.

use crate::case::Case;
use inflatable::mechanics::fault::{HingeFault, StarFault};
use inflatable::mechanics::hinge::bvp::Bvp;
use inflatable::mechanics::hinge::fit::Fit;
use inflatable::mechanics::hinge::ring::Ring;
use inflatable::mechanics::hinge::section::{Section, Tabled};
use inflatable::mechanics::hinge::{HingeModel, Level, fit};
use inflatable::mechanics::star::residuals::Ratios;
use inflatable::mechanics::star::{Correction, Mechanism};
use inflatable::mechanics::strength::{ElasticSheet, FULL_ACTUATION, INEXTENSIBLE};
use spec::ModelChoice;

/// Beta of the `bvp` level; its distance from the exact ring is about ln(beta)/beta.
pub const BVP_BETA: f64 = 1000.0;

/// Effect of the arms beyond the end of their table.
pub(super) const ARMS_LET_OUT: &str =
    "about 2 to 14 deg further and be softer; the table of their effect does not cover this hinge";

/// `section` from its table for the hinges of `case` at the gauge pressure `pressure` (Pa): the choice of `auto`.
///
/// # Errors
/// If `section` does not cover one of the hinges at this pressure.
pub fn tabled(case: &Case, pressure: f64) -> Result<Tabled, StarFault> {
    let (star, sheet) = (&case.mechanism, &case.sheet);
    let scales = [sheet.bendability(pressure, star.width), sheet.thickness / star.width, sheet.poisson_ratio];
    let r_stars = [star.tip().r_star, star.corner().r_star];
    Ok(Tabled::new(scales, r_stars)?)
}

/// `case` with the corrections of `model`: `section` gives the width of hinges at pressure and the corrections from shells of stars.
///
/// # Errors
/// If the model refuses the corner's hinge.
pub fn corrected(case: &Case, model: &dyn HingeModel) -> Result<Case, HingeFault> {
    let mut corrected = *case;
    correct(&mut corrected, model)?;
    Ok(corrected)
}

/// [`corrected`] in place.
pub(super) fn correct(case: &mut Case, model: &dyn HingeModel) -> Result<(), HingeFault> {
    correct_by(case, model, Correction::new)
}

/// The case with the correction that `make` makes of the star, its hinges' inflated width over W, and its ratios.
///
/// # Errors
/// The errors of [`corrected`].
pub fn correct_by(
    case: &mut Case,
    model: &dyn HingeModel,
    make: impl Fn(&Mechanism, f64, Ratios) -> Correction,
) -> Result<(), HingeFault> {
    if model.level() != Level::Section {
        return Ok(());
    }
    if let Some(edges) = model.target(case.mechanism.corner().r_star)?.edges {
        let (sheet, width) = (&case.sheet, case.mechanism.width);
        let pressure = case.pressure.unwrap_or(0.0);
        let ratios = Ratios {
            thickness: sheet.thickness / width,
            stretch: sheet.stretch(pressure, width),
            bendability: sheet.bendability(pressure, width),
        };
        case.mechanism.correction = make(&case.mechanism, edges.width, ratios);
    }
    Ok(())
}

/// The limit of high pressure selected by name; `None` where stars are predicted by [`tabled`]: for `section`, whose residuals and
/// ranges belong to the table, for `auto`, and for shells, because a build's files are the same on every machine, and shells are not.
pub fn named_limit(choice: ModelChoice) -> Option<Level> {
    match choice {
        ModelChoice::Fit => Some(Level::Fit),
        ModelChoice::Ring => Some(Level::Ring),
        ModelChoice::Bvp => Some(Level::Bvp),
        ModelChoice::Section | ModelChoice::Auto | ModelChoice::Shell => None,
    }
}

/// The model `bvp`, which depends on the hinge alone.
pub(super) fn bvp() -> Bvp {
    Bvp::new(BVP_BETA, 1e-6)
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
        Level::Bvp => Box::new(bvp()),
        Level::Section => {
            let bendability = sheet.bendability(pressure.ok_or(StarFault::NoPressure)?, width);
            Box::new(Section::new(bendability, sheet.thickness / width, sheet.poisson_ratio)?)
        }
    })
}

/// The model that `choice` selects for the star of `case` at the gauge pressure `pressure` (Pa).
///
/// # Errors
/// If it does not cover the star.
pub fn of_spec(choice: ModelChoice, case: &Case, pressure: f64) -> Result<Box<dyn HingeModel>, StarFault> {
    match named_limit(choice) {
        Some(level) => hinge_model(level, &case.sheet, Some(pressure), case.mechanism.width),
        None => Ok(Box::new(tabled(case, pressure)?)),
    }
}

/// The limits of validity of `model` that `case` exceeds, one sentence each.
pub fn limits_of_validity(model: &dyn HingeModel, case: &Case) -> Vec<String> {
    // The section knows pressure and stretch, so it has one limit: hinges that its table knows without arms only. The
    // other models are limits of high pressure, which each warns of. The fit also warns of the radii for which no
    // constants were published.
    let (star, level) = (&case.mechanism, model.level());
    let r_stars = [star.tip().r_star, star.corner().r_star];
    if level == Level::Section {
        let armless = r_stars.iter().any(|r_star| model.arms(*r_star, 1.0).is_none());
        let warning =
            format!("section computes these hinges without arms, with which they would coil {ARMS_LET_OUT}");
        return armless.then_some(warning).into_iter().collect();
    }
    let mut warnings = Vec::new();
    if let Some(pressure) = case.pressure {
        let bendability = case.sheet.bendability(pressure, star.width);
        warnings.push(if bendability < FULL_ACTUATION {
            format!(
                "bendability {bendability:.0} is below {FULL_ACTUATION:.0}: the hinges are not fully actuated, \
                 which {} does not take into account; section does",
                level.name()
            )
        } else {
            format!(
                "{} is a limiting case that no gripper reaches; its error for this one is unknown: use section or shell",
                level.name()
            )
        });
        let stretch = case.sheet.stretch(pressure, star.width);
        if stretch > INEXTENSIBLE {
            warnings.push(format!(
                "p W / Y is {stretch:.3}: the fabric stretches, which {} does not take into account; section does",
                level.name()
            ));
        }
    }
    if level == Level::Fit {
        for r_star in r_stars {
            let (target, stiffness) = fit::covers(r_star);
            if !target || !stiffness {
                let subject = if stiffness { "target coiling was" } else { "constants were" };
                warnings.push(format!("the published {subject} not given for R* = {r_star:.4}"));
            }
        }
        warnings.dedup();
    }
    warnings
}
