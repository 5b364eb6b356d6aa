//! Reads the output files back and compares them with the exact geometry: bytes to findings.
//!
//! Nothing here shares code with the writers: a **reader** (G-code, SVG, DXF) turns text into lines and arcs by its format's own
//! rules, and the **comparer** measures their distance from the design. Every fault becomes a **finding**; no input makes a
//! reader panic.

mod code;
mod finding;
mod judge;
mod read;

pub use code::FindingCode;
pub use finding::{Finding, Findings};
pub use judge::clamp::judge_clamps;
pub use judge::expected::{Expected, OutputFiles};
pub use judge::feed_check::FeedCheckTask;
pub use judge::files::bytes::{compare_bytes, first_difference, mark_equal};
pub use judge::files::package::program_in;
pub use judge::files::proof::{FileProof, Method, Proof, prove};
pub use judge::iron::judge_iron;
pub use judge::path::compare::{self, Deviation, deviation};
pub use judge::path::follow::{Following, follow};
pub use judge::rules::{ContactCount, ContactRule, IronRules, Phase};
pub use judge::stroke::stroke_seconds;
pub use judge::task::{ProgramTask, ProgramWork};
pub use read::drawing::Drawing;
pub use read::dxf::read_dxf;
pub use read::gcode;
pub use read::stl::{StlFacet, read_stl};
pub use read::svg::{SvgOrigin, read_svg};
