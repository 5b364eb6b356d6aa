//! From a design to the programs of a machine: order, pace, time and travel of the iron, and G-code in every dialect.
//!
//! [`plan`] turns a [`design::Design`] into [`plan::Program`]s, steps without a dialect, or refuses what the machine cannot do;
//! [`gcode`] spells them. [`number`] alone writes coordinates, and [`text`] alone lets a user's text into a program.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

pub mod plan;

pub mod number;

pub mod text;

pub mod gcode;
