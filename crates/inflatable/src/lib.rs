//! Mechanics of inflatables that are sealed from two flat sheets of fabric.
//!
//! [`mechanics`] has a hinge between two arms and a star of such hinges, in closed forms or by a section at its pressure; [`shell`]
//! computes a whole sheet in triangles. Both use SI units and radians, and do not depend on specs. [`geom`] has the lines and
//! arcs of outlines; [`numerics`] solves the equations.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

// In the order in which data flows; imports go up this list only.

pub mod numerics;

pub mod mechanics;

pub mod shell;
