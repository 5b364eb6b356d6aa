//! The modelled cases: the V-actuator, the star, a chamber of any outline; in tests also the hinge without arms.
//!
//! Cases use SI units and radians. Internally, lengths are divided by W and forces a unit of length by Y, so that Y = 1,
//! B = (t/W)^2 / (12 (1 - nu^2)) and p = p W/Y; energies are in Y W^2. One sheet is modelled; results are those of the whole
//! tube, both sheets.
//!
//! Each case runs on a **family** of meshes: a coarse one pressurised from flat, then the same cut finer again and again, each
//! starting from the shape before. A number's **mesh error** comes from the last three.

mod actuator;
mod arm_line;
mod bend;
#[cfg(test)]
mod cell;
mod extremes;
mod fault;
#[cfg(test)]
mod full_star;
mod margin;
mod objects;
mod refinement;
mod region;
mod sector;
mod shape;
mod solid;
mod star;
#[cfg(test)]
mod tests;
mod tube;
mod value;
mod whole;
#[cfg(test)]
mod woven;

pub use actuator::{Actuator, Fineness, MOST_ANGLES, ModelledActuator, VActuator, actuator};
pub use extremes::Extremes;
pub use fault::{Input, ShellFault};
pub use margin::{Margin, MarginLaw};
pub use objects::{Hysteresis, MOST_OBJECTS, Objects};
pub use refinement::{Evidence, OnProgress, Watch};
pub use region::{
    FlatRegion, InflatedRegion, PartialPressure, PlaneState, PlateContact, Pull, PullAtStroke, PulledRegion,
    RegionSeam, STROKES, SeamPull, Surface, Wrinkles, chambers, pull, region,
};
pub use sector::ModelledSector;
pub use shape::InflatedShape;
pub use solid::{BodySeam, SOLID_TITLE};
pub use star::{FlatStar, InflatedStar, star, star_by_sizes};
pub use tube::Tube;
pub use value::Value;
pub use whole::{Symmetry, WholeBody};
