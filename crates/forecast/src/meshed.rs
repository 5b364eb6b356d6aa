//! Numbers of a shell with their mesh errors, of stars and of drawn pieces.

use inflatable::shell::cases::Value;
use serde::Serialize;
use spec::units::Length;

/// A number with its mesh error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeshedValue {
    /// The number.
    pub value: f64,
    /// Mesh error of the value.
    pub mesh_error: f64,
}

impl MeshedValue {
    /// `value` in six digits.
    pub(super) fn rounded(value: Value) -> Self {
        Self { value: six(value.value), mesh_error: six(value.error) }
    }
}

/// The largest value of a quantity, with its place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeshedPlace {
    /// The number: N/mm of pull, mm of height, or a stretch.
    pub value: f64,
    /// Mesh error of the value. Where a hinge turns on a point there is no largest value; then the mesh error is as large as
    /// the value.
    pub mesh_error: f64,
    /// Position of the value on the flat piece; of a star in the half sector next to corner 1, the axis at the origin.
    pub at_mm: [f64; 2],
}

impl MeshedPlace {
    /// The value without its place.
    pub(super) fn number(self) -> MeshedValue {
        MeshedValue { value: self.value, mesh_error: self.mesh_error }
    }

    /// `value` at a place of the flat sheet, m, in six digits.
    pub(super) fn rounded(value: Value, place: [f64; 2]) -> Self {
        let MeshedValue { value, mesh_error } = MeshedValue::rounded(value);
        Self { value, mesh_error, at_mm: place.map(|x| six(Length::from_metres(x).0)) }
    }
}

/// `value` less and plus its mesh error.
pub(super) fn with_error(value: Value) -> [f64; 2] {
    [value.value - value.error, value.value + value.error]
}

/// Six digits: more than any mesh is good for, and few enough that the last bits of a sine do not show.
pub(super) fn six(x: f64) -> f64 {
    format!("{:.5e}", x + 0.0).parse().unwrap_or(x)
}
