//! A chamber of any outline between two equal sheets.
//!
//! One sheet is modelled; the other is its image in the plane z = 0. The outline slides in that plane and turns freely, islands and welds lie
//! in it, and supports prevent rigid motions. Sheets that buckle in wrinkles which no mesh resolves (1/eps above
//! 1,000 by the widest place) are computed as sheets that bear no compression: the shape is then the mean of the wrinkles.
//!
//! Left out: contact of the shape with itself, the bands outside the outline, and the connections between chambers.

mod answer;
mod chambers;
mod inflate;
mod measure;
mod pressures;
mod probes;
mod seams;
mod stability;
mod supports;
mod surface;
#[cfg(test)]
mod tests;

pub use answer::{InflatedRegion, MOST_RESOLVED, PlaneState, RegionSeam, SeamPull, Wrinkles};
pub use chambers::{FlatRegion, chambers};
pub use inflate::region;
pub use pressures::PartialPressure;
pub use surface::Surface;
