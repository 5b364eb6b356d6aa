//! What a star does when it is inflated: how far it closes, how hard it grips, when its seal fails.
//!
//! From the hinge to the gripper, each stage a pure function of the one before:
//!
//! | stage | what it knows |
//! |---|---|
//! | [`hinge`] | one bend: dimensionless volume V_bar(lambda) by R*; angle, moment, stiffness, seal load |
//! | [`star`] | the mechanism: arm length, inner radius against the tip's angle |
//! | [`response`] | an inflated star: where it rests, with which preload and stiffness, force against radius |
//! | [`strength`] | fabric, seal and friction: bendability, operating and burst pressure, payload |
//! | [`choice`], [`predict`] | a spec: which model answers, and its answer with the evidence |
//! | [`cone`] | the reduction of the test that measures the radial force |
//!
//! Three models of the hinge share one trait, [`hinge::HingeModel`]: [`fit::Fit`], the published constants;
//! [`ring::Ring`], the exact limit of a membrane that may wrinkle but not stretch; [`bvp::Bvp`], the paper's
//! penalised boundary-value problem. All take SI units, and give finite numbers or an error that names
//! what was found and what is allowed.
//!
//! ```
//! use stargrip_cam::mechanics::star::response::Inflated;
//! use stargrip_cam::mechanics::hinge::ring::Ring;
//! use stargrip_cam::mechanics::star::{Star, StarGeometry};
//!
//! let star = Star::new(StarGeometry {
//!     points: 5,
//!     inner_radius: 0.05,
//!     width: 0.03,
//!     tip_angle: 30_f64.to_radians(),
//!     tip_radius: 0.0,
//!     corner_radius: 0.0,
//! })?;
//! let inflated = Inflated::new(&star, &Ring, 37e3)?;
//! let rest = inflated.rest()?;
//! assert!(rest.radius < 0.015);
//! assert!(inflated.force(0.030, &rest)? > 10.0);
//! # Ok::<(), stargrip_cam::mechanics::fault::StarFault>(())
//! ```

pub mod fault;
pub mod hinge;
pub mod star;
pub mod strength;
