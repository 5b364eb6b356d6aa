//! A star without a prediction: the key of the spec that is best changed, and the values that it may have.

use crate::case::Case;
use crate::pressures::{modelled, outside_section, pressures};
use crate::star_answer::mm;
use design::{RefusalCode, StarDesign};
use inflatable::mechanics::fault::{HingeFault, HingeRatio, StarFault};
use spec::units::{Least, Most};
use spec::{Fabric, KeyPath, Spec, key};
use std::fmt;

/// Reason for a missing prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictFault {
    /// What kind of refusal it is.
    pub code: RefusalCode,
    /// Number of the star, 1 = bottom; `None` if it is not about one star.
    pub star: Option<usize>,
    /// The key of the spec that is best changed.
    pub key: KeyPath,
    /// The found value, and the allowed one if `remedy` does not name it.
    pub what: String,
    /// The way to a prediction; `None` if `what` names it, or none is known.
    pub remedy: Option<String>,
}

impl fmt::Display for PredictFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(star) = self.star {
            write!(f, "star {star}: ")?;
        }
        write!(f, "{}: {}", self.key, self.what)?;
        self.remedy.iter().try_for_each(|remedy| write!(f, ": {remedy}"))
    }
}

impl std::error::Error for PredictFault {}

impl PredictFault {
    /// A missing prediction of no star in particular, at `key`, where `problem` says all.
    pub fn new(key: KeyPath, problem: String) -> Self {
        Self { code: RefusalCode::NoPrediction, star: None, key, what: problem, remedy: None }
    }

    /// This fault with a `remedy`.
    pub(crate) fn with_remedy(self, remedy: impl Into<String>) -> Self {
        Self { remedy: Some(remedy.into()), ..self }
    }
}

/// `fault` of star `star`, made of `part` by `spec`, with the key that is best changed. The star itself exists: a design was made of it.
pub(super) fn located(star: usize, spec: &Spec, part: &StarDesign, fault: &StarFault) -> PredictFault {
    let case = Case::of_part(spec, part).ok();
    let mended = case.and_then(|case| beyond_range(&spec.fabric, &case, fault));
    if let Some((key, remedy)) = mended {
        let fault = PredictFault::new(key, fault.to_string()).with_remedy(remedy);
        return PredictFault { star: Some(star), ..fault };
    }
    let problem_and_remedy = case.and_then(|case| {
        let (problem, _) = outside_section(fault, &case.sheet, case.mechanism.width, case.pressure?)?;
        // Not every pressure that `section` covers has a prediction.
        Some((problem, modelled(&case).map(pressures)))
    });
    if let Some((problem, remedy)) = problem_and_remedy {
        return PredictFault { star: Some(star), remedy, ..PredictFault::new(key::load::PRESSURE, problem) };
    }
    let key = match fault {
        StarFault::Dimension { symbol, .. } => match *symbol {
            "p" => key::load::PRESSURE,
            "E" => key::fabric::YOUNG_MODULUS,
            "nu" => key::fabric::POISSON_RATIO,
            _ => key::fabric::THICKNESS,
        },
        StarFault::NoPressure => key::load::PRESSURE,
        StarFault::Radius { .. } => key::load::OBJECT_RADIUS,
        StarFault::Hinge(_) | StarFault::Root(_) => key::star::TIP_ANGLE,
    };
    PredictFault { star: Some(star), ..PredictFault::new(key, fault.to_string()) }
}

/// The key of a ratio that no pressure brings into the range of `section`, with the values that the key may have; `None` if `fault` is about
/// no such ratio.
fn beyond_range(fabric: &Fabric, case: &Case, fault: &StarFault) -> Option<(KeyPath, String)> {
    let width = case.mechanism.width;
    match *fault {
        StarFault::Hinge(HingeFault::Scale { ratio: HingeRatio::Poisson, least, most, .. }) => {
            Some((key::fabric::POISSON_RATIO, poisson_values([least, most])))
        }
        StarFault::Hinge(HingeFault::Scale { ratio: HingeRatio::Thickness, least, most, .. }) => {
            let factors = [least, most].map(|ratio| ratio * width / case.sheet.thickness);
            let (key, of_fabric) = thickness_values(fabric, factors);
            let [narrow, wide] = [most, least].map(|ratio| mm(case.sheet.thickness / ratio));
            let widths = format!("a tube_width from {} to {} mm", Least(narrow), Most(wide));
            Some((key, format!("{of_fabric}, or {widths}")))
        }
        StarFault::Hinge(HingeFault::RStar { found, most }) => {
            let is_tip = case.mechanism.tip().r_star.total_cmp(&found).is_eq();
            let key = if is_tip { key::star::TIP_RADIUS } else { key::star::CORNER_RADIUS };
            Some((key, format!("a radius of at most {} mm", Most(mm(most * width)))))
        }
        _ => None,
    }
}

/// The values of a Poisson's ratio from `lowest` to `highest`.
pub(crate) fn poisson_values([lowest, highest]: [f64; 2]) -> String {
    format!("a poisson_ratio from {lowest} to {highest}")
}

/// The key that sets the thickness of the even sheet of `fabric`, and its values for a thickness that is larger by these `factors`, from the
/// least to the most: a measured stiffness replaces thickness and modulus.
pub(crate) fn thickness_values(fabric: &Fabric, factors: [f64; 2]) -> (KeyPath, String) {
    // B = Y t^2 / [12 (1 - nu^2)].
    if let Some(bending) = fabric.bending_stiffness {
        let [lowest, highest] = factors.map(|factor| bending.0 * factor.powi(2));
        let values = format!("a bending_stiffness from {} to {} N mm", Least(lowest), Most(highest));
        (key::fabric::BENDING_STIFFNESS, values)
    } else if let Some(stretch) = fabric.stretch_stiffness {
        let [highest, lowest] = factors.map(|factor| stretch.0 / factor.powi(2));
        let values = format!("a stretch_stiffness from {} to {} N/mm", Least(lowest), Most(highest));
        (key::fabric::STRETCH_STIFFNESS, values)
    } else {
        let [lowest, highest] = factors.map(|factor| fabric.thickness.0 * factor);
        (key::fabric::THICKNESS, format!("a thickness from {} to {} mm", Least(lowest), Most(highest)))
    }
}
