//! From design and plan to text. Emitters round and write; they decide nothing else.

mod chords;
mod dxf;
mod gcode;
mod number;
mod palette;
mod pdf;
mod picture;
mod preview;
mod report;
mod scene;
mod stl;
mod svg;
mod text;

pub use chords::chords;
pub use dxf::dxf;
pub use gcode::{FEED_CHECK_TITLE, Facts, estimate, feed_check, gcode, steps_text};
pub use number::Decimals;
pub use pdf::pdf;
pub use preview::{FaultMark, GridCell, Preview, cells, faults, is_faults};
pub use report::{Report, report};
pub use scene::{drawn_scene, scene};
pub use stl::stl;
pub use svg::svg;
