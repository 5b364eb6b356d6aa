//! Reasons for a shell without an answer: the found value, the allowed value, the remedy.

use crate::shell::mesh::MeshFault;
use crate::shell::solver::Stop;
use geom::readable::Readable;
use std::fmt;

/// Reason for a case without an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellFault {
    /// A number is out of the range that the shell is made for.
    Range {
        /// The input.
        name: Input,
        /// The given value.
        found: f64,
        /// The least allowed value.
        least: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// The pressure is out of the range in which there are shells of this width and fabric.
    Pressure {
        /// The given one, Pa.
        found: f64,
        /// The least allowed one, Pa.
        least: f64,
        /// The largest allowed one, Pa.
        most: f64,
    },
    /// More of something than one call takes.
    TooMany {
        /// The name of the list.
        name: &'static str,
        /// The given number of items.
        found: usize,
        /// The largest allowed number of items.
        most: usize,
    },
    /// There is no mesh of the case.
    Mesh(MeshFault),
    /// The mesh is too large for this machine.
    TooLarge {
        /// Triangles of the mesh.
        triangles: usize,
    },
    /// No stable equilibrium was found.
    Stopped {
        /// The condition that is not met.
        why: Stop,
        /// 1/eps at which it happened.
        at: f64,
        /// 1/eps of the last equilibrium; 0 if there was none.
        last: f64,
        /// Triangles of the mesh.
        triangles: usize,
    },
    /// The inflated shape lies over itself, and contact of a shape with itself is not computed.
    Overlap {
        /// Two places of the flat rims that cross each other, m.
        places: [[f64; 2]; 2],
    },
    /// The computation was cancelled.
    Cancelled,
}

/// A number that must lie in a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// The tube's width.
    Width,
    /// The fabric's Poisson ratio.
    Poisson,
    /// The fabric's stretching stiffness.
    Stretching,
    /// The fabric's bending stiffness.
    Bending,
    /// The fabric's shear modulus over that of an isotropic sheet.
    Shear,
    /// The fabric's thickness over the tube's width.
    Slenderness,
    /// Bendability: pressure relative to bending stiffness.
    Bendability,
    /// Stretch: pressure relative to stretching stiffness.
    Stretch,
    /// The length of an actuator's arms.
    Arms,
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Each fault names the quantity, its value and the allowed range. A stopped computation names the last
        // pressure at which it had an equilibrium, because a lower pressure is the remedy.
        f.write_str(match self {
            Self::Width => "the width, m",
            Self::Poisson => "Poisson's ratio",
            Self::Stretching => "the stretch stiffness Y, N/m",
            Self::Bending => "the bending stiffness B, N m",
            Self::Shear => "the shear modulus by E / [2 (1 + nu)]",
            Self::Slenderness => "t/W",
            Self::Bendability => "1/eps = p W^3/B",
            Self::Stretch => "p W/Y",
            Self::Arms => "the arms' length by W",
        })
    }
}

impl From<MeshFault> for ShellFault {
    fn from(fault: MeshFault) -> Self {
        Self::Mesh(fault)
    }
}

impl fmt::Display for ShellFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A value outside of its range is named with the range. A solver that stops says why, at which 1/eps, and where the last
        // equilibrium before it was.
        match self {
            Self::Range { name, found, least, most } => {
                let value = Readable(*found);
                write!(f, "{name} is {value}, but shells are computed for {least} to {most} only")
            }
            Self::Pressure { found, least, most } => {
                let [pressure, minimum, maximum] = [found, least, most].map(|pressure| Readable(*pressure));
                write!(
                    f,
                    "the pressure is {pressure} Pa, but shells of this width and fabric are computed for {minimum} to {maximum} Pa only"
                )
            }
            Self::TooMany { name, found, most } => {
                write!(
                    f,
                    "{found} {name} are requested; one call computes at most {most}: request the others in another call"
                )
            }
            Self::Mesh(fault) => fault.fmt(f),
            Self::TooLarge { triangles } => {
                write!(
                    f,
                    "a mesh of {triangles} triangles is too large for this machine; request fewer levels"
                )
            }
            Self::Stopped { why, at, last, triangles } => {
                let reason = match why {
                    Stop::Iterations => "Newton's method does not converge",
                    Stop::Stalled => "no step lowers the energy",
                    Stop::Shift => "the shape stays unstable (no shift makes the Hessian positive definite)",
                    Stop::Unstable => "the forces are in balance, but the shape is not stable",
                    Stop::Contact => "the contact pressures do not converge",
                    Stop::Cancelled => "it was stopped",
                };
                let last_state = if *last > 0.0 {
                    format!("the last one was at 1/eps = {last:.4}")
                } else {
                    "there was none before it".to_owned()
                };
                write!(
                    f,
                    "no equilibrium at 1/eps = {at:.4} on {triangles} triangles: {reason}; {last_state}: use a lower pressure"
                )
            }
            Self::Overlap { places: [[x, y], [other_x, other_y]] } => {
                let [x, y, other_x, other_y] = [x, y, other_x, other_y].map(|metres| 1e3 * metres);
                write!(
                    f,
                    "inflated, the edge at X {x:.1} Y {y:.1} mm crosses that at X {other_x:.1} Y {other_y:.1} mm, and contact of a chamber with \
                     itself is not computed: use a lower pressure, or draw these edges further apart"
                )
            }
            Self::Cancelled => write!(f, "the computation of the shell was stopped"),
        }
    }
}

impl std::error::Error for ShellFault {}
