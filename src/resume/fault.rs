//! Reasons why a program cannot be resumed.

use std::fmt;

use proof::verify::Finding;
use spec::TOXIC;
use spec::units::Temperature;

/// The reason why a program cannot be resumed.
#[derive(Clone, Debug, PartialEq)]
pub enum ResumeFault {
    /// A comment of a sealing program of this tool is missing or wrong.
    NotOurs(&'static str),
    /// It is a trace program.
    Trace,
    /// It is a program that cuts.
    Cut,
    /// The program is damaged.
    Damaged(Finding),
    /// The moves do not agree with the comments, or the comments state no valid seal.
    Disagrees(Finding),
    /// It would seal at this temperature, which no spec may request.
    TooHot(Temperature),
    /// The new program would break the rules of the old one.
    Unproven(Finding),
    /// The line does not exist; the number of lines in the file.
    NoSuchLine(usize, usize),
    /// This program, the rest of a job, begins at this fraction of it, and the place lies before.
    BeforeStart(f64),
    /// No seam is within reach of the point; the distance of the nearest one, mm.
    Nowhere(f64),
    /// The job is complete.
    NothingLeft,
}

impl fmt::Display for ResumeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A program that is not understood is told by the comment or the line that is missing or wrong. A place that cannot be resumed
        // is told with the places that can.
        match self {
            Self::NotOurs(what) => write!(
                f,
                "this is not a sealing program of stargrip-cam, or an old one: it has no comment \"{what}: ...\"; build it again"
            ),
            Self::Trace => f.write_str(
                "a trace program seals nothing: run it again from its start, or resume the sealing program",
            ),
            Self::Cut => f.write_str(
                "a cutting program is not resumed: run it again, the tool goes along cuts that are there already",
            ),
            Self::Damaged(finding) => {
                write!(f, "the file is damaged, take it from the published directory again: {finding}")
            }
            Self::Disagrees(finding) => write!(
                f,
                "the moves of the file contradict its comments; copy it from the published directory again: {finding}"
            ),
            Self::TooHot(t) => write!(
                f,
                "the file seals at {t}, and from {TOXIC} the release layer gives off toxic fumes: build it again, cooler"
            ),
            Self::Unproven(finding) => {
                write!(f, "the program for the rest was not written, because it would be wrong: {finding}")
            }
            Self::NoSuchLine(line, lines) => write!(f, "there is no line {line}: the file has 1 to {lines}"),
            Self::BeforeStart(share) => write!(
                f,
                "this program begins at {:.1} % of the job's time: resume the program before it, or run this one again \
                 from its start",
                100.0 * share
            ),
            Self::Nowhere(distance) => write!(
                f,
                "no seam passes there: the nearest is {distance:.1} mm away; give a point on a seam, in the sheet's frame"
            ),
            Self::NothingLeft => f.write_str("nothing is left to seal after that place"),
        }
    }
}

impl std::error::Error for ResumeFault {}
