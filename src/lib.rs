//! Fabrication CAM for fabric-based star soft grippers.

pub mod artifact;
pub mod cli;
pub mod design;
pub mod emit;
pub mod geom;
pub mod manifest;
pub mod mechanics;
pub mod numerics;
pub mod pipeline;
pub mod plan;
pub mod resume;
pub mod spec;
pub mod units;
pub mod verify;
