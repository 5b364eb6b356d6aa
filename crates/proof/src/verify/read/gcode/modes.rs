//! The modes of a controller: the state that a line inherits from the lines before it.

use spec::Command;

/// Millimetres per inch.
const INCH: f64 = 25.4;

/// The modal state. `None`: the program has not set it, so the controller's own default would decide.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Modes {
    pub(super) motion: Option<Command>,
    pub(super) plane: Option<Command>,
    pub(super) distance: Option<Command>,
    pub(super) centers: Option<Command>,
    pub(super) feed_mode: Option<Command>,
    pub(super) units: Option<Command>,
    /// The F word in force: mm per minute, or moves per minute.
    pub(super) feed: Option<f64>,
}

impl Modes {
    /// Puts a mode into force; other commands change nothing.
    pub(super) fn set(&mut self, command: Command) {
        use Command as C;
        match command {
            C::Rapid | C::Line | C::ArcCw | C::ArcCcw => self.motion = Some(command),
            C::PlaneXy => self.plane = Some(command),
            C::Absolute | C::Relative => self.distance = Some(command),
            C::CentersAbsolute | C::CentersRelative => self.centers = Some(command),
            C::Inches | C::Millimetres => self.units = Some(command),
            C::InverseTime | C::PerMinute => {
                if self.feed_mode != Some(command) {
                    // An F of the other mode has another meaning: it must be given anew.
                    self.feed = None;
                }
                self.feed_mode = Some(command);
            }
            C::Dwell
            | C::Pause
            | C::End
            | C::ExactPath
            | C::HeatAndWait
            | C::HeatOnly
            | C::Progress
            | C::Setting
            | C::BeamConstant
            | C::BeamByMotion
            | C::BeamOff => {}
        }
    }

    /// Millimetres per unit of length.
    pub(super) fn scale(&self) -> f64 {
        if self.units == Some(Command::Inches) { INCH } else { 1.0 }
    }

    /// Whether coordinates are displacements.
    pub(super) fn is_relative(&self) -> bool {
        self.distance == Some(Command::Relative)
    }

    /// Whether F counts moves instead of length.
    pub(super) fn is_inverse_time(&self) -> bool {
        self.feed_mode == Some(Command::InverseTime)
    }
}
