//! A drawn chamber between two rigid plates: how hard it presses.

use crate::drawn::shapes::hull_of_values;
use crate::interval::Interval;
use crate::meshed::MeshedValue;
use inflatable::shell::cases::{InflatedRegion, PlateContact, Value};
use serde::Serialize;

/// Contact of a chamber with each of two plates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct PlatesPrediction {
    /// Force on one plate.
    pub force_N: MeshedValue,
    /// Range of the force by both stable shapes with their mesh errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_range_N: Option<Interval>,
    /// Area of one sheet that touches its plate.
    pub contact_area_mm2: MeshedValue,
}

impl PlatesPrediction {
    /// The contact of `region`, if it lies between plates.
    pub(super) fn new(region: &InflatedRegion) -> Option<Self> {
        let PlateContact { force, area } = region.plates?;
        let second = region.second.as_deref().and_then(|second| second.plates);
        let range = second.map(|second| hull_of_values(force, second.force));
        Some(Self {
            force_N: not_below_zero(force),
            force_range_N: range,
            contact_area_mm2: not_below_zero(area.scaled(1e6)),
        })
    }
}

/// A plate does not pull: where the sheet hardly touches it, extrapolation may fall below 0.
fn not_below_zero(value: Value) -> MeshedValue {
    MeshedValue::rounded(Value { value: value.value.max(0.0), ..value })
}
