//! Fabrication CAM for fabric-based star soft grippers.

pub mod geom;
pub mod mechanics;
pub mod numerics;
pub mod spec;
pub mod units;
pub mod verify;
