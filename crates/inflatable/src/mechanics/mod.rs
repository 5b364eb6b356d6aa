//! Physics of an inflated star: how far it closes, how hard it grips, at which pressure its seal fails.
//!
//! All in SI units, without specs, sheets and files. From the hinge to the star, each stage is a pure function of
//! the one before:
//!
//! | stage | subject |
//! |---|---|
//! | [`hinge`] | one bend: dimensionless volume V_bar(lambda) by R*; angle, moment, stiffness, seal load |
//! | [`star`] | the mechanism: inner radius against the tip's angle, its widest opening, and corrections from shells |
//! | [`star::response`] | an inflated star: equilibrium, preload and stiffness, force against radius |
//! | [`strength`] | fabric and friction: bendability, operating pressure, payload |
//!
//! Four models of the hinge share one trait, [`hinge::HingeModel`]: [`hinge::fit::Fit`], the published constants;
//! [`hinge::ring::Ring`], the exact limit of a membrane that may wrinkle but not stretch; [`hinge::bvp::Bvp`], the
//! paper's penalised boundary-value problem; [`hinge::section::Section`], a hinge at its pressure, with bending, stretch
//! and hoop compression. All give finite numbers or an error with the found and
//! the allowed value.
//!
//! ```
//! use inflatable::mechanics::hinge::ring::Ring;
//! use inflatable::mechanics::star::{Correction, Mechanism};
//! use inflatable::mechanics::star::response::Inflated;
//!
//! // The paper's star with five points.
//! let star = Mechanism {
//!     points: 5,
//!     arm: 0.06972,
//!     width: 0.03,
//!     tip_angle: 30_f64.to_radians(),
//!     tip_radius: 0.0,
//!     corner_radius: 0.0,
//!     correction: Correction::default(),
//! };
//! let inflated = Inflated::new(&star, &Ring, 37e3)?;
//! let rest = inflated.rest()?;
//! assert!(rest.radius < 0.015);
//! assert!(inflated.force(0.030, &rest)? > 10.0);
//! # Ok::<(), inflatable::mechanics::fault::StarFault>(())
//! ```

pub mod fault;
pub mod hinge;
pub mod star;
pub mod strength;
