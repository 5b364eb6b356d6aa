//! The machine: what a profile in `templates/machines/` or of the user's own says about one controller.

use crate::units::{Length, Speed};

/// A complete and valid machine profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// What the profile calls itself.
    pub name: String,
    /// One line for `stargrip-cam machines`.
    pub description: String,
    /// The words the controller understands.
    pub dialect: Dialect,
    /// Reachable area from the origin, X by Y; `None` if unknown: the sheet is then the only limit.
    pub work_area: Option<(Length, Length)>,
    /// Longest line the controller reads, in characters without the line end.
    pub line_length: usize,
    /// How the iron gets hot.
    pub heating: Heating,
    /// Heights of the iron's tip above the release layer.
    pub heights: Heights,
    /// Length of the ramp along the path on which the iron goes down before, and up after, a seam.
    pub ramp: Length,
    /// Speed to assume for travel (G0), for time estimates only.
    pub travel_speed: Speed,
    /// Speed of the trace program.
    pub trace_speed: Speed,
    /// Lines that put the controller into a known state: units, plane, distance, arc and feed mode.
    pub start: Vec<String>,
    /// The line at which the machine waits for the operator.
    pub pause: String,
    /// Lines that end the program.
    pub end: Vec<String>,
}

/// A family of controllers that read the same words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// The plain subset that every controller reads.
    Generic,
}

/// How the iron gets to its temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heating {
    /// The operator sets a soldering station and confirms.
    Operator,
}

/// Heights of the tip; Z 0 is the top of the release layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heights {
    /// While sealing: 0 for a rigid iron, below 0 for a spring-loaded one.
    pub contact: Length,
    /// While travelling between seams.
    pub travel: Length,
    /// Before and after the job.
    pub park: Length,
}
