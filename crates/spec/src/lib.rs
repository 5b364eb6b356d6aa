//! The user's input: from TOML text to a complete, valid [`Spec`], or all of its faults at once.
//!
//! A **raw spec** is the text as parsed, with the place of each key and value in the source; a **spec** is complete (every
//! default filled in) and valid (every value in its range). Faults that only the geometry shows, for instance a negative arm
//! length, are refused later, by the design stage; it points at the key concerned with [`RawSpec::span_of`].
//!
//! The way of a text: [`Source`] (bytes that are UTF-8), [`RawSpec`] (TOML), a reader that takes each key with
//! its kind and range, [`Reading`] (the spec and its warnings) or [`Faults`]. A machine profile goes the same way.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

mod dialect;
pub mod digest;
pub mod units;

mod accuracy;
mod allowed;
mod choice;
mod code;
mod cut;
mod defaults;
mod drawing;
pub mod edit;
mod fault;
mod faults;
mod foreign;
pub mod key;
mod laser;
mod load;
mod machine;
mod material;
mod measure;
mod message;
mod model;
mod motion;
mod name;
mod press;
mod processes;
mod product;
mod profile;
mod raw;
mod reading;
mod release_layer;
mod render;
mod schema;
mod seal;
mod seal_process;
mod section;
mod service;
mod shape;
mod source;
mod stars;
mod starter;
pub mod study;
mod syntax;
mod unknown;
mod value;
mod values;
mod vocabulary;

/// The name of the program in its files.
pub const PROGRAM: &str = "stargrip-cam";

pub use accuracy::{Accuracy, Detail, ModelChoice};
pub use allowed::{Allowed, SEAL_SPEEDS};
pub use code::{Code, FaultCode};
pub use cut::{CutProcess, CutSpec, CutTool};
pub use defaults::with_defaults;
pub use dialect::{Dialect, DialectFamily};
pub use drawing::{DrawingContent, DrawingSpec, LayerRole};
pub use fault::{DrawnPlace, Fault, NewSpec, Severity, shortened};
pub use faults::Faults;
pub use key::KeyPath;
pub use laser::{FOCUSES, LASER_PROFILE, POWERS, seals_by_laser};
pub use machine::{
    Bench, CONTACT, Comments, Controller, DwellUnit, Dwells, Heating, Heights, KeepOut, LaserDrive, Limits,
    Machine, Process, Script, SealingTool, SheetPlace,
};
pub use material::{builtin_material, builtin_materials, with_material};
pub use measure::{MeasuredFigure, WrittenMeasure};
pub use message::comma;
pub use model::{
    Bed, BuildSpec, Colours, Extra, Fabric, FeedFloor, FrameSpec, Inlet, Load, MachineChoice, Marks, Mask,
    MaskKind, ObjectShape, ProgramScope, Sheet, Spec, StarSpec,
};
pub use motion::{Motion, StepRate, ZLimits};
pub use name::{NAME_LENGTH, check_name, is_plain_word, misleads};
pub use press::{PAPER_CREEP, PRESS_PROFILE, PRESS_TIMES, PaperSize, Press, PressLayer};
pub use processes::{DEFAULT_PROCESS, ProcessSpec, check_process_name};
pub use product::ProductKind;
pub use profile::{
    FIRST_STEP_RATE, LEAST_ACCELERATION, MOST_ACCELERATION, UNSERVED_MACHINES, UnservedMachine,
    builtin_machine, builtin_machines, limits_set_by, machine_remedy, read_machine, usual_profile,
};
pub use raw::RawSpec;
pub use reading::{FEWEST_POSTS, Reading, SMALLEST_HOLE, read, written_profile};
pub use release_layer::TOXIC;
pub use schema::{SCHEMA_FILE, machine_schema, schema};
pub use seal::{Seal, SealPause};
pub use seal_process::{SealProcess, seam_strength};
pub use service::{Service, WARMEST, WarmPart, Warming};
pub use source::{SIZE_LIMIT, Source};
pub use starter::{drawing_starter, quoted, starter};
pub use unknown::nearest;
pub use values::{Setting, drawing_settings, form_settings, has_default, settings};
pub use vocabulary::{Command, Vocabulary};
