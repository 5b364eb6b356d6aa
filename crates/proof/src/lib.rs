//! From the files of a build to findings: every file is read back and compared with the exact design.
//!
//! [`artifact`] lists the files that a design must have, [`manifest`] is their record, and [`verify`] reads and judges them. Nothing
//! here shares code with the writers: Cargo keeps this crate from `program`, `forecast` and the pictures.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

pub mod artifact;

pub mod manifest;

pub mod verify;
