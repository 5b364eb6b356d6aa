//! Arms that fold under the mass that they carry.

use inflatable::mechanics::star::bearing::FOLDING;

/// The mass that friction holds on an upright surface, `upright`, kg, as far as arms that wrinkle under `wrinkling` kg do not fold.
pub(super) fn until_arms_fold(upright: f64, wrinkling: Option<f64>) -> f64 {
    wrinkling.map_or(upright, |wrinkling| upright.min(FOLDING * wrinkling))
}
