//! `stargrip_cam._native`: the crate's interface for the package. It converts, waits and raises; it computes nothing.
//!
//! | module | content |
//! |---|---|
//! | `spec` | `Spec`: a valid spec with its text |
//! | `gripper` | the spec of a gripper for an object |
//! | `toml` | Python's dicts and values as TOML, and back |
//! | `faults` | refusals as exceptions |
//! | `waiting` | long calls: without the GIL, with progress, until Ctrl-C |
//! | `arrays` | NumPy arrays, each by one copy of memory |
//! | `shapes`, `design`, `piece` | `Line`, `Arc`, `Contour`, `Star`, `Design`, `Piece`, `Seam` |
//! | `build` | `Build`, and the proof of a directory |
//! | `answer`, `mesh`, `body` | predictions as attributes, `Mesh`, the closed `Body` |
//! | `prediction` | the prediction of a gripper |
//! | `arguments`, `options` | arguments of functions, and their conversion into options of commands |
//! | `actuator` | a single hinge |
//! | `optimum` | the best star |
//! | `sweep` | many designs, a column an array |
//! | `aligned` | programs for a sheet that was moved |
//! | `workshop` | coupons, feed check, the rest of a job, machine profiles |
//! | `command` | the command `stargrip-cam` |

#![allow(missing_docs, reason = "what macros make of a module has none; the rooms have theirs")]

mod actuator;
mod aligned;
mod answer;
mod arguments;
mod arrays;
mod body;
mod build;
mod command;
mod design;
mod equality;
mod faults;
mod gripper;
mod mesh;
mod optimum;
mod options;
mod piece;
mod prediction;
mod shapes;
mod spec;
mod sweep;
mod toml;
mod waiting;
mod workshop;

use pyo3::prelude::*;

/// Fabrication CAM for fabric star soft grippers.
#[pymodule]
mod _native {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::actuator::actuator;
    #[pymodule_export]
    use super::aligned::{Aligned, align};
    #[pymodule_export]
    use super::answer::{ActuatorPrediction, Chamber, DrawnPrediction, Prediction, keys};
    #[pymodule_export]
    use super::body::Body;
    #[pymodule_export]
    use super::build::{Build, build, prove};
    #[pymodule_export]
    use super::command::run;
    #[pymodule_export]
    use super::design::{Design, Star, design};
    #[pymodule_export]
    use super::mesh::Mesh;
    #[pymodule_export]
    use super::optimum::{Optimum, optimize};
    #[pymodule_export]
    use super::piece::{Piece, Seam};
    #[pymodule_export]
    use super::prediction::{predict, repeat};
    #[pymodule_export]
    use super::shapes::{Arc, Contour, Line};
    #[pymodule_export]
    use super::spec::Spec;
    #[pymodule_export]
    use super::sweep::{sweep, sweep_columns};
    #[pymodule_export]
    use super::workshop::{coupon, feed_check, machines, rest};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        super::answer::add_properties::<Prediction>(module.py())?;
        super::answer::add_properties::<DrawnPrediction>(module.py())?;
        super::answer::add_properties::<Chamber>(module.py())?;
        super::answer::add_properties::<ActuatorPrediction>(module.py())?;
        module.add("__version__", stargrip_cam::manifest::Tool::current().version)
    }
}
