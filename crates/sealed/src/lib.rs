//! Sealed shapes: two equal sheets that are sealed along seams, cut around them, and opened by ports.
//!
//! A **seam** is the centre line of a band; a **port** is the opening for a hose; a **chamber** is a region that air can reach
//! through a port, and a **leak** any other way for it. A **piece** is a sealed shape with a name, and may lie on a sheet.
//! Nothing here depends on the product of a shape: a product makes shapes, and gives its pieces and seams their names.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

mod air;
mod around;
mod bottleneck;
mod chambers;
mod channel;
mod checks;
mod clean;
mod crossings;
mod drawn_seams;
mod edge_gaps;
mod fabric;
mod faces;
mod fault;
mod flanks;
mod hairpins;
mod holes;
mod join;
mod joints;
mod layout;
mod leak;
mod loose;
mod merge;
mod mouth;
mod name;
mod narrow_places;
mod notes;
mod offset;
mod offset_graph;
mod open_ends;
mod order;
mod outline;
mod polyline;
mod ports;
mod reach;
mod sealing;
mod seam;
mod segments;
mod separate;
mod separator;
mod sets;
mod sketch;
mod spikes;
mod spine;
mod unsound;
mod valve;

pub use chambers::{Chamber, Topology};
pub use fault::{Repair, ShapeCode, ShapeFault, ShapeWarning};
pub use leak::Leak;
pub use name::{PieceName, SeamName, scope, seam_in_words};
pub use offset::offset_right;
pub use polyline::{of_polyline, polyline};
pub use sealing::{Sealing, sealed_shape};
pub use seam::{LaidSeam, PlacedPiece, Port, Role, SealedShape, Seam, Valve, frame, laid_seams};
pub use separate::separate;
pub use separator::{AirSide, Separator};
pub use sketch::{DrawnCurve, DrawnPort, PortPlace, Rules, Sketch};
