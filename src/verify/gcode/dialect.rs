//! What a family of controllers understands, as a table.

/// What a G or M code does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Travel as fast as possible.
    Rapid,
    /// Straight move at the feed.
    Line,
    /// Clockwise arc at the feed.
    ArcCw,
    /// Counterclockwise arc at the feed.
    ArcCcw,
    /// Wait for a time.
    Dwell,
    /// Arcs lie in the XY plane.
    PlaneXy,
    /// Lengths are inches.
    Inches,
    /// Lengths are millimetres.
    Millimetres,
    /// Coordinates are positions.
    Absolute,
    /// Coordinates are displacements.
    Relative,
    /// I and J are positions.
    CentersAbsolute,
    /// I and J are displacements from the start of the arc.
    CentersRelative,
    /// F is moves per minute.
    InverseTime,
    /// F is length per minute.
    PerMinute,
    /// Wait for the operator.
    Pause,
    /// The program is over.
    End,
}

/// Unit of the P word of a dwell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DwellUnit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
}

/// How the iron is told its temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatBy {
    /// The operator sets it at a pause that follows a comment `; heat: temperature_C=...`.
    OperatorAtPause,
}

/// By how much the distances from an arc's centre to its two ends may differ, mm.
///
/// Accepted: a difference up to `free`, or one up to both `relative` times the radius and `limit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcTolerance {
    /// Always accepted.
    pub free: f64,
    /// Accepted as a fraction of the radius ...
    pub relative: f64,
    /// ... as long as it is no larger than this.
    pub limit: f64,
}

/// A dialect: everything the interpreter asks about a controller.
#[derive(Clone, Debug, PartialEq)]
pub struct Dialect {
    /// Its name in machine profiles.
    pub name: &'static str,
    /// Longest line, in bytes without the line end.
    pub line_length: usize,
    /// Letter, ten times the number, and what the code does.
    pub codes: &'static [(u8, u16, Command)],
    /// Letters of the words that carry numbers.
    pub parameters: &'static str,
    /// Characters that must not occur anywhere, comments included.
    pub forbidden: &'static str,
    /// Unit of a dwell's P word.
    pub dwell: DwellUnit,
    /// When an arc is refused.
    pub arcs: ArcTolerance,
    /// How heat is commanded.
    pub heat: HeatBy,
}

impl Dialect {
    /// The plain subset that every controller reads alike: capital letters, `;` comments, arcs by I and J.
    ///
    /// Parentheses are refused (some controllers end a comment at the first `)`), and so are `!`, `~` and `?`,
    /// which GRBL obeys even inside comments. The arc tolerance is the strictest of GRBL (0.005 mm, or
    /// 0.1 % up to 0.5 mm) and LinuxCNC (about 0.028 mm). The line length is GRBL's 80 with a reserve.
    pub const GENERIC: Self = Self {
        name: "generic",
        line_length: 70,
        codes: &[
            (b'G', 0, Command::Rapid),
            (b'G', 10, Command::Line),
            (b'G', 20, Command::ArcCw),
            (b'G', 30, Command::ArcCcw),
            (b'G', 40, Command::Dwell),
            (b'G', 170, Command::PlaneXy),
            (b'G', 200, Command::Inches),
            (b'G', 210, Command::Millimetres),
            (b'G', 900, Command::Absolute),
            (b'G', 910, Command::Relative),
            (b'G', 901, Command::CentersAbsolute),
            (b'G', 911, Command::CentersRelative),
            (b'G', 930, Command::InverseTime),
            (b'G', 940, Command::PerMinute),
            (b'M', 0, Command::Pause),
            (b'M', 20, Command::End),
            (b'M', 300, Command::End),
        ],
        parameters: "XYZIJFP",
        forbidden: "()!~?",
        dwell: DwellUnit::Seconds,
        arcs: ArcTolerance { free: 0.005, relative: 0.001, limit: 0.028 },
        heat: HeatBy::OperatorAtPause,
    };

    /// The same dialect on a controller that reads lines of at most `line_length` bytes.
    pub const fn with_line_length(self, line_length: usize) -> Self {
        Self { line_length, ..self }
    }

    /// What the code `letter` `number` does, if the controller knows it.
    pub(super) fn command(&self, letter: u8, number: f64) -> Option<Command> {
        self.codes
            .iter()
            .find(|(l, tenths, _)| *l == letter && f64::from(*tenths) == (number * 10.0).round())
            .filter(|_| (number * 10.0).fract().abs() < 1e-9)
            .map(|(_, _, command)| *command)
    }
}

impl Command {
    /// Commands of the same group exclude each other on one line (the modal groups of RS274/NGC).
    pub(super) const fn group(self) -> u8 {
        match self {
            Self::Rapid | Self::Line | Self::ArcCw | Self::ArcCcw => 1,
            Self::Dwell => 0,
            Self::PlaneXy => 2,
            Self::Absolute | Self::Relative => 3,
            Self::CentersAbsolute | Self::CentersRelative => 4,
            Self::InverseTime | Self::PerMinute => 5,
            Self::Inches | Self::Millimetres => 6,
            Self::Pause | Self::End => 7,
        }
    }
}
