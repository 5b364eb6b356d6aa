//! From design and plan to text. Emitters round and spell; they decide nothing.

mod dxf;
mod gcode;
mod number;
mod palette;
mod pdf;
mod preview;
mod preview_png;
mod stack_view;
mod stl;
mod svg;
mod text;
mod travel_view;

pub use dxf::dxf;
pub use gcode::{Facts, feed_check, gcode, write_gcode, write_steps};
pub use number::Decimals;
pub use pdf::pdf;
pub use preview::preview;
pub use preview_png::preview_png;
pub use stl::stl;
pub use svg::svg;
