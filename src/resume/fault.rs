//! Why there is no program to go on with.

use std::fmt;

use crate::verify::Finding;

/// Why a program cannot be resumed.
#[derive(Clone, Debug, PartialEq)]
pub enum ResumeFault {
    /// It does not say what a sealing program of this tool says: the comment that is missing or wrong.
    NotOurs(&'static str),
    /// It is damaged.
    Damaged(Finding),
    /// The line is not in the file, which has this many.
    NoSuchLine(usize, usize),
    /// No seam is within reach of the point: the nearest is this far away, mm.
    Nowhere(f64),
    /// Everything had been sealed already.
    NothingLeft,
}

impl fmt::Display for ResumeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotOurs(what) => write!(
                f,
                "this is no sealing program of stargrip-cam, or an old one: no comment \"{what}: ...\"; build it again"
            ),
            Self::Damaged(finding) => {
                write!(f, "the file is damaged, take it from the published directory again: {finding}")
            }
            Self::NoSuchLine(line, lines) => write!(f, "there is no line {line}: the file has 1 to {lines}"),
            Self::Nowhere(distance) => write!(
                f,
                "no seam passes there: the nearest is {distance:.1} mm away; give a point on a seam, in the sheet's frame"
            ),
            Self::NothingLeft => f.write_str("nothing is left to seal after that place"),
        }
    }
}

impl std::error::Error for ResumeFault {}
