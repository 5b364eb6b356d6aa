//! The prediction of a spec's gripper: from the exact design to values with their evidence.
//!
//! It applies [`inflatable::mechanics`] to the stars of [`design`]; each stage uses the ones above it:
//!
//! | stage | subject |
//! |---|---|
//! | [`case`] | the inputs of a spec for one star, in SI units: the only conversion |
//! | [`seal_load`] | the load on the seal, burst pressure, the smallest radius that withstands it |
//! | [`model_selection`] | the choice of a model |
//! | [`mod@ranges`] | intervals that contain the values of computed shells |
//! | [`outcome`] | an inflated star with its load, in closed forms with ranges: the base of all that follow |
//! | [`pressures`] | values at several pressures, where the spec gives none |
//! | [`meshed`] | a number of a shell with its mesh error |
//! | [`mod@predict`], [`prediction`], [`report`] | the answer with its evidence, for programs and for people |
//! | [`mod@verdict`] | whether the object is held, and the reasons to refuse a gripper that cannot |
//! | [`mod@pose`] | the shape of the inflated star, for every picture |
//! | [`mod@charts`] | curves by pressure, object and number of points, for pictures |
//! | [`model_search`] | the models that were tried for a requested accuracy |
//! | [`accuracy`] | the cheapest model with a requested accuracy |
//! | [`actuator`] | a single hinge between two arms: angle, stiffness and moment |
//! | [`drawn`] | a drawn piece, by the shell on its own regions |
//! | [`shell`] | the same by the shell, which must be selected by name |
//! | [`candidate`], [`mod@study`], [`optimize`] | the same answer for one design among millions |
//! | [`stiffness`] | the fabric's stiffnesses from bench tests |
//! | [`sizing`] | a spec from an object |
//! | [`trade`] | cost and error of each model |
//! | [`keys`] | every key of an answer with its meaning |
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

pub mod accuracy;
pub mod actuator;
pub mod candidate;
pub mod case;
pub mod charts;
pub mod drawn;
mod evidence;
mod folding;
pub mod interval;
pub mod keys;
pub mod linkage;
mod load_check;
pub mod meshed;
pub mod model_search;
pub mod model_selection;
pub mod optimize;
pub mod outcome;
pub mod payload;
pub mod pose;
pub mod predict;
pub mod prediction;
pub mod pressures;
pub mod ranges;
mod remembered;
pub mod report;
mod seal_forecast;
pub mod seal_load;
pub mod shell;
pub mod sizing;
mod star_answer;
mod star_refusal;
pub mod stiffness;
pub mod study;
pub mod tone;
pub mod trade;
pub mod verdict;
pub mod verdict_answer;
pub mod warning;
