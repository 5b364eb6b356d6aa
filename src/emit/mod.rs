//! From design and plan to text. Emitters round and write; they decide nothing else.

mod chords;
mod dxf;
mod mjcf;
mod package;
mod palette;
mod pdf;
mod picture;
mod preview;
mod report;
mod scene;
mod stl;
mod svg;
mod thumbnails;

pub use chords::chords;
pub use dxf::dxf;
pub use mjcf::mjcf;
pub use package::package;
pub use pdf::pdf;
pub use preview::{FaultMark, GridCell, Preview, cells, faults, is_faults};
pub use program::gcode::{FEED_CHECK_TITLE, Facts, estimate, feed_check, steps_text};
pub use program::number::Decimals;
pub use report::{Report, report};
pub use scene::{drawn_scene, scene};
pub use stl::stl;
pub use svg::svg;
pub use thumbnails::gcode;
