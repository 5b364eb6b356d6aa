//! What a spec's gripper will do: from the exact design to a prediction that says how good it is.
//!
//! It asks [`crate::mechanics`] about stars that [`crate::design`] has made; each stage stands on the ones above it:
//!
//! | stage | what it knows |
//! |---|---|
//! | [`case`] | what a spec asks about one star, in SI units: the only conversion |
//! | [`seal_load`] | the load on the seal, burst pressure, the radius that would hold |
//! | [`model_selection`] | which model answers |
//! | [`mod@ranges`] | in which intervals the values of computed shells lie |
//! | [`outcome`] | an inflated star with its load, in closed forms with their ranges: for all that follow |
//! | [`pressures`] | what it does at several pressures, where none is given |
//! | [`mod@predict`], [`prediction`], [`report`] | the answer with its evidence, for programs and for people |
//! | [`mod@verdict`] | whether the object is held, and why a gripper that cannot is refused |
//! | [`mod@pose`] | the shape of the inflated star, for every picture |
//! | [`mod@charts`] | the same by pressure, object and number of points, for pictures |
//! | [`actuator`] | a single hinge between two arms: angle, stiffness and moment |
//! | [`drawn`] | a drawn piece, by the shell on its own regions |
//! | [`shell`] | the same by the shell, which is asked by name only |
//! | [`candidate`], [`mod@study`], [`optimize`] | the same answer for one design among millions |
//! | [`stiffness`] | from bench tests to what a spec says of its fabric |
//! | [`sizing`] | from an object to a spec |
//! | [`trade`] | what each model costs, and how far it is off |
//! | [`keys`] | every key of an answer with its meaning |

pub mod actuator;
pub mod candidate;
pub mod case;
pub mod charts;
pub mod drawn;
pub mod keys;
mod load_check;
pub mod model_selection;
pub mod optimize;
pub mod outcome;
pub mod pose;
pub mod predict;
pub mod prediction;
pub mod pressures;
pub mod ranges;
pub mod report;
pub mod seal_load;
pub mod shell;
pub mod sizing;
mod star_answer;
pub mod stiffness;
pub mod study;
pub mod trade;
pub mod verdict;
