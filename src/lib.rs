//! Fabrication CAM for fabric-based star soft grippers.
//!
//! Two sheets of heat-sealable fabric, sealed along a star-shaped path into one closed tube, contract in
//! their plane when inflated, and grip (Andrade-Silva and Marthelot, "Fabric-Based Star Soft Robotic
//! Gripper"). This crate turns a specification of such a gripper into files for a workshop, and proves them.
//!
//! Data flows one way: text is read into a [`spec::Spec`], which becomes an exact [`design::Design`] of lines
//! and arcs, which becomes a machine-neutral plan ([`plan::Program`]); [`emit`] writes both as text, and
//! [`verify`] reads the text back and compares it with the design. [`pipeline`] defines the state after every stage.
//!
//! The physics is a separate crate, `inflatable`. Its modules are re-exported under their names, because designs and predictions use its
//! types.
//!
//! ```
//! use stargrip_cam::design::Design;
//! use stargrip_cam::spec::{self, Machine, Source};
//!
//! let source = Source::new("star.toml", r#"
//!     schema = 1
//!     name = "the paper's star"
//!     [star]
//!     points = 5
//!     inner_radius = "50 mm"
//!     tube_width = "30 mm"
//!     tip_angle = "30 deg"
//! "#);
//! let spec = spec::read(&source)?.spec;
//! let machine = Machine::builtin("generic")?;
//! let design = Design::new(&spec, &machine)?;
//! let star = &design.assembly().expect("stars").distinct[0].star;
//! assert!((star.l - 69.72).abs() < 0.005); // mm, as in the paper
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

pub use artwork;
pub use design;
pub use forecast;
pub use geom;
pub use inflatable::{mechanics, numerics, shell};
pub use program::plan;
pub use proof::{artifact, verify};
pub use sealed;
pub use spec::{self, digest, units};

// In the order in which data flows; imports go up this list only.

pub mod airtight;

pub mod manifest;

pub mod link;

pub mod emit;

pub mod resume;

pub mod coupon;

pub mod pipeline;

pub mod answer;

#[cfg(feature = "cli")]
pub mod cli;
