//! Sealed shapes: two equal sheets that are sealed along seams, cut around them, and opened by ports.
//!
//! A **seam** is the centre line of a band; a **port** is where a hose goes in; a **chamber** is a region that air can reach through
//! a port, and a **leak** any other way for it. A **piece** is a sealed shape with a name, and may lie on a sheet. Nothing here
//! knows which product a shape belongs to: a product makes shapes, and gives its pieces and seams their names.

mod chambers;
mod laid;
mod name;
mod sealed;
mod seam;

pub use chambers::{Chamber, Leak, Topology};
pub use laid::{LaidSeam, PlacedPiece, frame, laid_seams};
pub use name::{PieceName, SeamName, scope};
pub use sealed::{Port, SealedShape};
pub use seam::{Role, Seam};
