//! From design and plan to text. Emitters round and spell; they decide nothing.

mod dxf;
mod gcode;
mod number;
mod preview;
mod svg;
mod text;

pub use dxf::dxf;
pub use gcode::{Facts, feed_check, gcode, write_gcode, write_steps};
pub use number::Decimals;
pub use preview::preview;
pub use svg::svg;
