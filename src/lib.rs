//! Fabrication CAM for fabric-based star soft grippers.

pub mod artifact;
pub mod design;
pub mod emit;
pub mod geom;
pub mod manifest;
pub mod mechanics;
pub mod numerics;
pub mod plan;
pub mod spec;
pub mod units;
pub mod verify;
