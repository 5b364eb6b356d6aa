//! Numbers of a shell with their mesh errors, of stars and of drawn pieces.

use serde::Serialize;

/// A number with its mesh error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeshedValue {
    /// The number.
    pub value: f64,
    /// Its mesh error.
    pub mesh_error: f64,
}

/// The largest value of a quantity, with its place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeshedPlace {
    /// The number: N/mm of pull, mm of height, or a stretch.
    pub value: f64,
    /// Its mesh error. Where a hinge turns on a point there is no largest value; then the mesh error is as large as
    /// the value.
    pub mesh_error: f64,
    /// Its position on the flat piece; of a star in the half sector next to corner 1, the axis at the origin.
    pub at_mm: [f64; 2],
}
