//! The prediction of a drawn star.

use crate::stars::draw::{DrawnStar, POISSON, YOUNG};
use inflatable::mechanics::star::residuals::Ratios;
use inflatable::mechanics::star::response::Inflated;
use inflatable::mechanics::star::{Correction, Mechanism};
use inflatable::mechanics::strength::ElasticSheet;
use stargrip_cam::design::Star;
use stargrip_cam::forecast::case::Case;
use stargrip_cam::forecast::model_selection::{correct_by, tabled};
use stargrip_cam::forecast::outcome::Outcome;
use stargrip_cam::spec::StarSpec;
use stargrip_cam::units::{Angle, Length, Pressure};

/// Largest relative mesh error of a stiffness or force in the comparison.
pub(crate) const SETTLED: f64 = 0.25;

/// What `see` makes of the prediction of a drawn star: its corrected case, the inflated star, and its outcome; `None` without a prediction.
pub(crate) fn predicted<T>(
    star: &DrawnStar,
    correction: impl Fn(&Mechanism, f64, Ratios) -> Correction,
    see: impl FnOnce(&Case, &Inflated<'_>, &Outcome) -> Option<T>,
) -> Option<T> {
    let (mut case, pressure) = case_of(star)?;
    let model = tabled(&case, pressure).ok()?;
    correct_by(&mut case, &model, correction).ok()?;
    let inflated = Inflated::new(&case.mechanism, &model, pressure).ok()?;
    let outcome = Outcome::linear(&case, &inflated);
    see(&case, &inflated, &outcome)
}

/// The case of a drawn star, and its pressure, Pa.
pub fn case_of(star: &DrawnStar) -> Option<(Case, f64)> {
    let spec = StarSpec {
        inner_radius: Length(star.inner_radius),
        tube_width: Length(star.width),
        tip_angle: Angle(star.tip_angle),
        tip_radius: Length(star.tip_radius),
        corner_radius: Length(star.corner_radius),
        ..StarSpec::paper(star.points)
    };
    let design_star = Star::new(&spec).ok()?;
    let pressure = Pressure(star.pressure).pascals();
    let sheet = ElasticSheet::new(Length(star.thickness).metres(), 1e6 * YOUNG, POISSON).ok()?;
    let case = Case::bare(&design_star, sheet, pressure);
    Some((case, pressure))
}
