//! SVG and DXF drawings as exact lines and circular arcs, in mm with y up.
//!
//! A reader takes the bytes of a file and touches nothing else. The tokens of the file become **pieces** (lines, elliptical arcs,
//! Beziers), an affine map leads each to mm, and the pieces become **segments**: lines and circular arcs exactly,
//! all else by tangent-continuous arcs within a tolerance. Every detail that is resolved or left out has a [`Note`]. The crate
//! assigns no roles: each [`Element`] has the names by which a caller may do so.
//!
//! ```
//! use artwork::{Figure, Options, read};
//!
//! let svg = br##"<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="20mm" viewBox="0 0 40 20">
//!   <g id="chamber"><circle cx="10" cy="10" r="5" stroke="red"/></g></svg>"##;
//! let drawing = read("rest.svg", svg, &Options::new(0.01)).expect("a drawing");
//! let circle = &drawing.elements[0];
//! assert_eq!(circle.layers, ["#ff0000", "chamber"]);
//! let Figure::Path(path) = &circle.figure else { panic!("a path") };
//! assert_eq!((path.segments.len(), path.closed), (1, true));
//! assert!((path.length() - 31.415926535897931).abs() < 1e-12);
//! ```
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // the last digits of std differ between systems (clippy.toml)

// In the order in which data flows; imports go up this list only.

mod artwork;

mod options;

mod affine;

mod biarc;

mod piece;

mod spline;

mod collector;

mod admit;

mod encoding;

mod dxf;

mod svg;

mod reading;

pub use admit::Format;
pub use artwork::{Artwork, AssumedUnit, Element, Fault, Figure, Note, Place, Weight};
pub use collector::NO_LENGTH;
pub use dxf::read_dxf;
pub use options::{Limits, Options, Unit};
pub use reading::read;
pub use svg::read_svg;
