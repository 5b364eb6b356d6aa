//! The plan of the programs for a sheet that was moved, and the reasons for which there is none.

use std::fmt;

use crate::pipeline::{Planned, planned, refused};
use design::{AlignmentFault, Design, Refusals};
use geom::Point;
use proof::verify::Finding;
use spec::units::{Length, Quantity};
use spec::{Machine, Spec};

/// The reason for which a sheet that was found again has no programs.
#[derive(Clone, Debug, PartialEq)]
pub enum AlignedFault {
    /// The directory is not a build of this version as it was published.
    NotABuild(String),
    /// The directory has programs for a sheet that was found again.
    Twice,
    /// The directory has no programs.
    NoPrograms,
    /// There are several sheets, this many, and none is named.
    WhichSheet(usize),
    /// The marks do not fit the sheet.
    Marks(AlignmentFault),
    /// The machine cannot run the programs there.
    Refused(Refusals),
    /// The programs would be wrong: a fault of this program.
    Unproven(Vec<Finding>),
}

impl fmt::Display for AlignedFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotABuild(fault) => {
                write!(f, "this is not a build as this version publishes it: {fault}")
            }
            Self::Twice => {
                f.write_str("its sheet was aligned already: align the build from which it was made")
            }
            Self::NoPrograms => f.write_str(
                "it has no programs: build it with seal-gcode, trace-gcode or cut-gcode, or as packages: seal-3mf, trace-3mf or cut-3mf",
            ),
            Self::WhichSheet(number) => {
                write!(f, "it has {number} sheets: name the one that lies on the machine, 1 to {number}")
            }
            Self::Marks(fault) => write!(f, "{fault}"),
            Self::Refused(refusals) => write!(f, "{refusals}"),
            Self::Unproven(findings) => {
                let first = findings.first().map_or_else(String::new, ToString::to_string);
                write!(f, "the programs were not written, because they would be wrong: {first}")
            }
        }
    }
}

/// Largest coordinate of a mark, mm.
const FARTHEST: f64 = 1e6;

/// One coordinate, in mm or with its unit.
fn coordinate(text: &str) -> Option<f64> {
    let text = text.trim();
    let is_plain = text.chars().all(|c| c.is_ascii_digit() || "+-.".contains(c));
    let number = if is_plain { text.parse().ok() } else { Length::parse(text).ok().map(|length| length.0) };
    number.filter(|x: &f64| x.abs() <= FARTHEST)
}

/// A mark as the machine shows it: two coordinates in mm, or with their units, "12.3, 8.1".
///
/// # Errors
/// What is allowed, if the text is another one.
pub fn read_mark(text: &str) -> Result<Point, String> {
    let (x, y) = text.split_once(',').unwrap_or((text, ""));
    match (coordinate(x), coordinate(y)) {
        (Some(x), Some(y)) => Ok(Point::new(x, y)),
        _ => Err("two coordinates in mm, such as \"12.3, 8.1\"".to_owned()),
    }
}

impl Planned {
    /// The programs for a sheet, the only one if none is named, whose marks were found at `measured`.
    ///
    /// # Errors
    /// All reasons of [`Self::new`], or why the sheet cannot be aligned.
    pub fn aligned(
        spec: Spec,
        machine: Machine,
        sheet: Option<usize>,
        measured: [Point; 2],
    ) -> Result<Self, AlignedFault> {
        let design = Design::new(&spec, &machine)
            .map_err(|refusals| AlignedFault::Refused(refused::refused(&spec, &machine, refusals)))?;
        let number = design.sheets.len();
        let sheet = sheet.or((number == 1).then_some(1)).ok_or(AlignedFault::WhichSheet(number))?;
        let alignment = design.alignment(sheet, measured).map_err(AlignedFault::Marks)?;
        planned::planned(spec, machine, design.aligned(&alignment)).map_err(AlignedFault::Refused)
    }
}
