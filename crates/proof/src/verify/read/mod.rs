//! Readers: text and bytes to lines, arcs and moves, by each format's own rules. No input makes one panic.

pub(super) mod drawing;
pub(super) mod dxf;
pub(super) mod dxf_words;
pub mod gcode;
pub(super) mod number;
pub(super) mod stl;
pub(super) mod svg;
mod svg_path;
pub(super) mod svg_words;
pub(super) mod zip;
