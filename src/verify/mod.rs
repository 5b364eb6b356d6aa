//! Reads the output files back and compares them with the exact geometry: bytes to findings.
//!
//! Nothing here shares code with the writers: a **reader** (G-code, SVG, DXF) turns text into lines and
//! arcs by its format's own rules, and the **comparer** measures how far those lie from what the design
//! says. Whatever is wrong becomes a **finding**; no input makes a reader panic.

mod archive;
mod clamp;
pub mod compare;
mod drawing;
mod drawings;
mod dxf;
mod finding;
pub mod gcode;
mod job;
mod measure;
mod number;
mod pace;
mod paper;
pub mod pdf;
mod pdf_content;
mod pdf_object;
mod proof;
mod solid;
mod svg;
mod svg_path;
mod walk;

pub use archive::Archive;
pub use compare::{Deviation, deviation};
pub use drawing::Drawing;
pub use dxf::read_dxf;
pub use finding::{Finding, Findings};
pub use pdf::{PdfPage, read_pdf};
pub use proof::{Proof, prove, prove_archive};
pub use svg::{SvgOrigin, read_svg};
pub use walk::{Walk, walk};
