//! A chamber of any outline between two equal sheets.
//!
//! One sheet is modelled; the other is its image in the plane z = 0. The outline slides in that plane and turns freely, islands and welds lie
//! in it, and supports prevent rigid motions. Wrinkles are resolved up to 1/eps = 5,000 by the widest place, on the shape of the lower energy
//! of those found from flat and from a higher pressure. Beyond, numbers lie between those of a stiffer sheet with resolved wrinkles and those
//! of a sheet that bears no compression, whose shape is the mean of its wrinkles.
//!
//! A shape whose rims cross each other is refused, because contact of the shape with itself is left out; so are the bands outside the outline,
//! and the connections between chambers.

mod answer;
mod branches;
mod chambers;
mod inflate;
mod measure;
mod overlap;
mod plates;
mod pressures;
mod probes;
mod pull;
mod seams;
mod stability;
mod supports;
mod surface;
#[cfg(test)]
mod tests;

pub use answer::{InflatedRegion, PlaneState, PlateContact, RegionSeam, SeamPull, Wrinkles};
pub use chambers::{FlatRegion, chambers};
pub use inflate::region;
pub use pressures::PartialPressure;
pub use pull::{Pull, PullAtStroke, PulledRegion, STROKES, pull};
pub use surface::Surface;
