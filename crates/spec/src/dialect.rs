//! Dialects: the words that controllers understand.

crate::choices! {
    /// Controllers that read the same words.
    Dialect,
    /// The name of the dialect in profiles and in programs.
    name;
    /// The plain subset that every controller reads.
    Generic: "generic",
    /// LinuxCNC.
    LinuxCnc: "linuxcnc",
    /// GRBL 1.1 on an AVR.
    Grbl: "grbl",
    /// grblHAL.
    GrblHal: "grblhal",
    /// FluidNC.
    FluidNc: "fluidnc",
    /// Marlin.
    Marlin: "marlin",
    /// Klipper.
    Klipper: "klipper",
    /// RepRapFirmware.
    RepRapFirmware: "reprapfirmware",
    /// The firmware of Bambu Lab's printers.
    Bambu: "bambu",
}

/// What dialects have in common: the machines whose habits their controllers follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DialectFamily {
    /// An unknown controller, for which programs hold only what all controllers read.
    Plain,
    /// Controllers of mills: G0 has a speed of its own, dwells are in seconds, arcs are drawn.
    Mill,
    /// Controllers of printers: G0 runs at the feed in force, dwells are in milliseconds, heaters and progress have words.
    Printer,
}

impl Dialect {
    /// The family of its machines.
    pub const fn family(self) -> DialectFamily {
        match self {
            Self::Generic => DialectFamily::Plain,
            Self::LinuxCnc | Self::Grbl | Self::GrblHal | Self::FluidNc => DialectFamily::Mill,
            Self::Marlin | Self::Klipper | Self::RepRapFirmware | Self::Bambu => DialectFamily::Printer,
        }
    }

    /// Whether its controllers drive a laser as programs need it: M4 with a power that follows the speed, and none in G0. GRBL 1.1
    /// (doc/markdown/laser_mode.md) and grblHAL (settings.c, `Mode_Laser`) with $32=1, FluidNC with a `Laser` spindle (Spindles/Laser.h).
    pub const fn drives_lasers(self) -> bool {
        match self {
            Self::Grbl | Self::GrblHal | Self::FluidNc => true,
            Self::Generic
            | Self::LinuxCnc
            | Self::Marlin
            | Self::Klipper
            | Self::RepRapFirmware
            | Self::Bambu => false,
        }
    }

    /// Whether the timer of its controller's long steps wraps around.
    pub const fn timer_wraps(self) -> bool {
        match self {
            Self::FluidNc => true,
            Self::Generic
            | Self::LinuxCnc
            | Self::Grbl
            | Self::GrblHal
            | Self::Marlin
            | Self::Klipper
            | Self::RepRapFirmware
            | Self::Bambu => false,
        }
    }

    /// Longest line that any of its controllers reads, in characters without the line end: GRBL's protocol.h, Marlin's
    /// `MAX_CMD_SIZE`; up to 255 where others read longer ones. Generic programs fit into all of them, with a reserve.
    pub fn longest_line(self) -> u32 {
        match self {
            Self::Generic => 72,
            Self::Grbl => 80,
            // Bambu's buffer is unknown: no longer than Marlin's.
            Self::Marlin | Self::Bambu => 95,
            Self::LinuxCnc | Self::GrblHal | Self::FluidNc | Self::Klipper | Self::RepRapFirmware => 255,
        }
    }

    /// The usual name.
    pub fn title(self) -> &'static str {
        match self {
            Self::Generic => "the controller",
            Self::LinuxCnc => "LinuxCNC",
            Self::Grbl => "GRBL",
            Self::GrblHal => "grblHAL",
            Self::FluidNc => "FluidNC",
            Self::Marlin => "Marlin",
            Self::Klipper => "Klipper",
            Self::RepRapFirmware => "RepRapFirmware",
            Self::Bambu => "Bambu's firmware",
        }
    }
}
