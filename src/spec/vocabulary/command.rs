//! Commands: the effects of a controller's words, whatever their names.

/// The effect of a G or M code.
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

impl Command {
    /// Commands of the same group exclude each other on one line (the modal groups of RS274/NGC).
    pub const fn group(self) -> u8 {
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

    /// Whether the command is alone on its line, with words of its own.
    pub const fn stands_alone(self) -> bool {
        matches!(self, Self::HeatAndWait | Self::HeatOnly | Self::Progress | Self::Setting)
    }

    /// Whether it changes how other lines are read, or how the controller moves, and does nothing itself.
    pub const fn is_setting(self) -> bool {
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

    /// Letters that have a meaning with this command only.
    pub const fn own_letters(self) -> &'static [u8] {
        match self {
            Self::Dwell => b"P",
            Self::HeatAndWait | Self::HeatOnly => b"S",
            Self::Progress => b"PR",
            Self::Setting => b"IST",
            _ => b"",
        }
    }
}
