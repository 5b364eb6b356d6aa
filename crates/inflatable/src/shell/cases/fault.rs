//! Why a shell has no answer: what was found, what is allowed, what helps.

use crate::shell::mesh::MeshFault;
use crate::shell::solver::Stop;
use std::fmt;

/// Why a case has no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellFault {
    /// A number is out of the range that the shell is made for.
    Range {
        /// What it is.
        name: Input,
        /// What was given.
        found: f64,
        /// The least that is allowed.
        least: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// More of something than one call takes.
    TooMany {
        /// What it is.
        name: &'static str,
        /// How many were given.
        found: usize,
        /// How many are allowed.
        most: usize,
    },
    /// There is no mesh of the case.
    Mesh(MeshFault),
    /// The mesh is too large for this machine.
    TooLarge {
        /// Its triangles.
        triangles: usize,
    },
    /// No stable equilibrium was found.
    Stopped {
        /// What is missing.
        why: Stop,
        /// 1/eps at which it happened.
        at: f64,
        /// 1/eps of the last equilibrium; 0 if there was none.
        last: f64,
        /// Triangles of the mesh.
        triangles: usize,
    },
    /// It was told to stop.
    Cancelled,
}

/// A number that must lie in a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// The tube's width.
    Width,
    /// The fabric's Poisson ratio.
    Poisson,
    /// Its stiffness against stretching.
    Stretching,
    /// Its stiffness against bending.
    Bending,
    /// Its shear modulus by that of an isotropic sheet.
    Shear,
    /// Its thickness over the tube's width.
    Slenderness,
    /// How much pressure there is against bending.
    Bendability,
    /// How much pressure there is against stretching.
    Stretch,
    /// The length of an actuator's arms.
    Arms,
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
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
        match self {
            Self::Range { name, found, least, most } => {
                write!(f, "{name} is {found:.4e}, the shell is made for {least} to {most}")
            }
            Self::TooMany { name, found, most } => {
                write!(
                    f,
                    "{found} {name} are asked for, one call takes {most}: ask for the others in another"
                )
            }
            Self::Mesh(fault) => fault.fmt(f),
            Self::TooLarge { triangles } => {
                write!(
                    f,
                    "a mesh of {triangles} triangles is too large for this machine; ask for fewer levels"
                )
            }
            Self::Stopped { why, at, last, triangles } => {
                let reason = match why {
                    Stop::Iterations => "Newton's method does not come to rest",
                    Stop::Stalled => "no step brings the energy down",
                    Stop::Shift => "no shift makes the Hessian positive definite",
                    Stop::Unstable => "the forces vanish, but the shape is not stable",
                    Stop::Contact => "contact pressures do not come to rest",
                    Stop::Cancelled => "it was told to stop",
                };
                write!(
                    f,
                    "no equilibrium at 1/eps = {at:.4} on {triangles} triangles: {reason}; the last one was at \
                     1/eps = {last:.4}: ask for less pressure"
                )
            }
            Self::Cancelled => write!(f, "the shell was told to stop"),
        }
    }
}

impl std::error::Error for ShellFault {}
