//! Sealed shapes: two equal sheets that are sealed along seams, cut around them, and opened by ports.
//!
//! A **seam** is the centre line of a band; a **port** is the opening for a hose; a **chamber** is a region that air can reach
//! through a port, and a **leak** any other way for it. A **piece** is a sealed shape with a name, and may lie on a sheet.
//!
//! A [`Sketch`] becomes a shape in **passes**: it is mended, parted into regions of air, opened by ports, surrounded by bands, cut, and
//! checked. Each pass takes the state that the one before returned. Repairs, warnings and faults come back beside its own state.
//!
//! Nothing here depends on the product of a shape: a product makes shapes, and gives its pieces and seams their names.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

// Blocks of modules in the order in which data flows.

mod fault;
mod sketch;

mod separate;

mod doubles;
mod loose_ends;
mod mended;
mod network;
mod pieces;
mod port_gaps;
mod spikes;

mod graph;
mod regions;

mod mouth;
mod ports;

mod bands;
mod center_lines;
mod drawn_seams;
mod fabric;
mod offset;
mod offset_graph;

mod cut;
mod holes;
mod valve;

mod bottleneck;
mod channel;
mod checks;
mod corners;
mod narrow_places;
mod unsound;

mod order;
mod sealing;

mod joints;
mod name;
mod seam;
mod topology;

mod polyline;
mod separator;

mod segments;

pub use fault::{Repair, ShapeCode, ShapeFault, ShapeWarning};
pub use name::{PieceName, SeamName, scope, seam_in_words};
pub use offset::offset_right;
pub use polyline::{of_polyline, polyline};
pub use sealing::{Sealing, sealed_shape};
pub use seam::{LaidSeam, PlacedPiece, Port, Role, SealedShape, Seam, Valve, frame, laid_seams};
pub use separate::separate;
pub use separator::{AirSide, Separator, Tongue};
pub use sketch::{DrawnCurve, DrawnPort, PortPlace, Rules, Sketch};
pub use topology::{Chamber, Leak, Topology};
