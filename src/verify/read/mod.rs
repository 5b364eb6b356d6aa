//! Readers: text and bytes to lines, arcs and moves, by each format's own rules. No input makes one panic.

pub(in crate::verify) mod drawing;
pub(in crate::verify) mod dxf;
pub(in crate::verify) mod dxf_words;
pub mod gcode;
pub(in crate::verify) mod number;
pub mod pdf;
pub(in crate::verify) mod stl;
pub(in crate::verify) mod svg;
mod svg_path;
pub(in crate::verify) mod svg_words;
