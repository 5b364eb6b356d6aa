//! A sketch: curves that a person drew, by role, and the rules by which they become a sealed shape.

use geom::{Path, Point};

/// A drawn curve.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCurve {
    /// The name in the drawing: an element's id. May be empty.
    pub name: String,
    /// The curve.
    pub path: Path,
}

/// The place of a drawn port.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PortPlace {
    /// A point on an edge, or in the gap between two free ends of edges.
    At(Point),
    /// A short line across an edge.
    Across([Point; 2]),
}

/// A drawn port: a hose goes in here.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPort {
    /// The name in the drawing. May be empty.
    pub name: String,
    /// The place.
    pub place: PortPlace,
}

/// Drawn curves by role.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sketch {
    /// Edges of the air side. An edge with air on both sides is the centre line of a wall.
    pub air: Vec<DrawnCurve>,
    /// Centre lines of bands: closed, or open.
    pub seams: Vec<DrawnCurve>,
    /// Ports.
    pub ports: Vec<DrawnPort>,
    /// The cut: one outline, and cuts inside it. Without any the cut follows the edges.
    pub cuts: Vec<DrawnCurve>,
    /// Holes to be punched.
    pub holes: Vec<DrawnCurve>,
    /// Valves in the faces of chambers: holes in one sheet, alone or with the rim of the flange around them.
    pub valves: Vec<DrawnCurve>,
}

/// The rules by which a sketch becomes a sealed shape. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Width of a band, > 0.
    pub band: f64,
    /// Fabric between a band and the cut, >= 0.
    pub allowance: f64,
    /// Ends nearer than this are joined, and curves nearer than this along a stretch are one.
    pub join: f64,
    /// Path that is sealed twice where a closed seam meets its start.
    pub overlap: f64,
    /// Flat width between the bands at a port, > 0.
    pub port_width: f64,
    /// Overrun of a port's bands past the cut, mm.
    pub overrun: f64,
    /// A passage narrower than this is a warning.
    pub least_passage: f64,
    /// Width of a valve's flange around its hole where its rim is not drawn, mm, > 0.
    pub flange: f64,
}

impl Rules {
    /// Rules for the tests of this crate.
    #[cfg(test)]
    pub(crate) const SAMPLE: Self = Self {
        band: 2.0,
        allowance: 8.0,
        join: 0.05,
        overlap: 5.0,
        port_width: 6.0,
        overrun: 1.0,
        least_passage: 5.0,
        flange: 10.0,
    };

    /// Largest distance of a port from its edge, mm.
    pub(crate) fn farthest_port(&self) -> f64 {
        self.port_width.max(5.0)
    }

    /// The remedy for a port with too little fabric in front of it: a channel, its flap and that of the edge opposite need that much.
    pub(crate) fn room_in_front(&self) -> String {
        let room = 3.0 * (self.band + self.allowance) + self.overrun + 1.0;
        format!(
            "put it on an edge that the cut follows, with at least {:.3} mm of fabric in front of it, or draw all cuts, \
             one of them through the mouth, on a layer with the role `cut`",
            thousandths_up(room)
        )
    }

    /// The remedy for ports whose channels meet: their least distance, rounded up.
    pub(crate) fn ports_apart(&self) -> String {
        let distance = self.port_width + 2.0 * self.band;
        format!("put ports at least {:.3} mm from each other", thousandths_up(distance))
    }
}

/// A least length, mm, to the thousandth that a message prints.
pub(crate) fn thousandths_up(mm: f64) -> f64 {
    (1000.0 * mm - 1e-6).ceil() / 1000.0
}

impl PortPlace {
    /// The middle of the place.
    pub fn middle(&self) -> Point {
        match self {
            Self::At(point) => *point,
            Self::Across([a, b]) => a.midpoint(*b),
        }
    }
}
