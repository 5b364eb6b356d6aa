//! Plane geometry of lines and circular arcs, exact in `f64`; it does not depend on grippers.
//!
//! A **segment** is a line or a circular arc; a **path** is a chain of segments, open or closed.
//! Lengths are mm and angles rad by convention only: nothing here depends on the unit.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

mod arc;
mod bounds;
mod circle_fit;
mod enclosure;
mod grid;
mod index;
mod intersect;
mod line;
mod nearest;
pub mod order;
mod path;
mod point;
pub mod readable;
mod region;
mod segment;
pub mod straight;
mod transform;

pub use arc::Arc;
pub use bounds::Bounds;
pub use circle_fit::fitted_circle;
pub use enclosure::Enclosures;
pub use grid::Grid;
pub use index::{BoxIndex, GrowingIndex, SegmentIndex};
pub use intersect::{intersections, path_intersections};
pub use line::Line;
pub use nearest::{Nearest, box_distance, path_distance, segment_distance};
pub use path::Path;
pub use point::{Point, Vec2};
pub use segment::Segment;
pub use transform::Isometry;
