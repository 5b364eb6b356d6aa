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
    /// Corners are travelled exactly.
    ExactPath,
    /// Heat to S, and wait until it is hot.
    HeatAndWait,
    /// Heat to S, and go on; 0 turns the heater off.
    HeatOnly,
    /// Show P per cent, R minutes.
    Progress,
    /// A setting of the controller that moves nothing.
    Setting,
}

/// Unit of the P word of a dwell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DwellUnit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
}

/// How a comment is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommentMark {
    /// From `;` to the end of the line.
    Semicolon,
    /// Between `(` and `)`, alone on its line.
    Parentheses,
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

/// A dialect: everything the interpreter asks about a controller. The tables are in the room `dialects`.
#[derive(Clone, Debug, PartialEq)]
pub struct Dialect {
    /// Its name in machine profiles.
    pub name: &'static str,
    /// Longest line, in bytes without the line end.
    pub line_length: usize,
    /// Letter, ten times the number, and what the code does.
    pub codes: &'static [(u8, u16, Command)],
    /// What of `codes` it does not know.
    pub except: &'static [Command],
    /// Whether it draws arcs; without, no arc is read.
    pub draws_arcs: bool,
    /// Whether it surely reads what follows the point of G90.1 and G91.1, which else are G90 and G91.
    pub subcodes: bool,
    /// Commands that are words of more than a letter, alone on their line (what follows them is their own).
    pub words: &'static [(&'static str, Command)],
    /// Modes that the controller is always in: no program needs to set them.
    pub fixed: &'static [Command],
    /// Letters of the words that carry numbers.
    pub parameters: &'static str,
    /// How comments are marked.
    pub comments: CommentMark,
    /// Characters that must not occur anywhere, comments included.
    pub forbidden: &'static str,
    /// Whether G0 moves at the feed in force, as G1 does.
    pub travel_at_feed: bool,
    /// Unit of a dwell's P word.
    pub dwell: DwellUnit,
    /// A dwell lasts for a multiple of this, rounded up, s; 0 for exactly as long as told.
    pub dwell_step: f64,
    /// When an arc is refused.
    pub arcs: ArcTolerance,
}

impl Dialect {
    /// The same dialect on a controller that reads lines of at most `line_length` bytes, if that is less.
    pub const fn with_line_length(self, line_length: usize) -> Self {
        let line_length = if line_length < self.line_length { line_length } else { self.line_length };
        Self { line_length, ..self }
    }

    /// The same dialect on a controller that draws no arcs.
    pub const fn without_arcs(self) -> Self {
        Self { draws_arcs: false, ..self }
    }

    /// The same dialect with comments between parentheses.
    pub const fn with_parentheses(self) -> Self {
        Self { comments: CommentMark::Parentheses, forbidden: ";!~?", ..self }
    }

    /// What the code `letter` `number` does, if the controller knows it.
    pub(super) fn command(&self, letter: u8, number: f64) -> Option<Command> {
        self.codes
            .iter()
            .find(|(l, tenths, _)| *l == letter && f64::from(*tenths) == (number * 10.0).round())
            .filter(|_| (number * 10.0).fract().abs() < 1e-9)
            .map(|(_, _, command)| *command)
            .filter(|command| {
                !self.except.contains(command) && (self.draws_arcs || !self.is_for_arcs(*command))
            })
    }

    /// Whether only a controller that draws arcs can be told this.
    fn is_for_arcs(&self, command: Command) -> bool {
        match command {
            Command::ArcCw | Command::ArcCcw => true,
            Command::CentersAbsolute | Command::CentersRelative => !self.subcodes,
            _ => false,
        }
    }

    /// How long a dwell with this P word lasts, s.
    pub fn dwell_seconds(&self, p: f64) -> f64 {
        let seconds = match self.dwell {
            DwellUnit::Seconds => p,
            DwellUnit::Milliseconds => p / 1000.0,
        };
        if self.dwell_step > 0.0 { (seconds / self.dwell_step).ceil() * self.dwell_step } else { seconds }
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
            Self::ExactPath => 8,
            Self::HeatAndWait | Self::HeatOnly | Self::Progress | Self::Setting => 9,
        }
    }

    /// Whether the command stands alone on its line, with words of its own.
    pub(super) const fn stands_alone(self) -> bool {
        matches!(self, Self::HeatAndWait | Self::HeatOnly | Self::Progress | Self::Setting)
    }

    /// Whether it changes how other lines are read, or how the controller moves, and does nothing itself.
    pub(super) const fn is_setting(self) -> bool {
        matches!(
            self,
            Self::PlaneXy
                | Self::Inches
                | Self::Millimetres
                | Self::Absolute
                | Self::Relative
                | Self::CentersAbsolute
                | Self::CentersRelative
                | Self::InverseTime
                | Self::PerMinute
                | Self::ExactPath
                | Self::Setting
        )
    }

    /// Letters that mean something with this command only.
    pub(super) const fn own_letters(self) -> &'static [u8] {
        match self {
            Self::Dwell => b"P",
            Self::HeatAndWait | Self::HeatOnly => b"S",
            Self::Progress => b"PR",
            Self::Setting => b"IST",
            _ => b"",
        }
    }
}
