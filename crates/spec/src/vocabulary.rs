//! The vocabulary of each family of controllers: which words it understands, as a table.
//!
//! Both the reader of a profile's own lines and the verifier's reader of programs use it. The way in which a controller runs a
//! word (units of time, tolerances of arcs, lengths of lines) concerns the verifier only.

use self::Command as C;
use crate::dialect::Dialect;
use crate::machine::Controller;

/// Letter, ten times the number, and the command.
type CodeRow = (u8, u16, C);

/// Codes that all controllers share.
const COMMON: [CodeRow; 5] = [
    (b'G', 0, C::Rapid),
    (b'G', 10, C::Line),
    (b'G', 40, C::Dwell),
    (b'G', 900, C::Absolute),
    (b'G', 910, C::Relative),
];

/// Arcs, planes, units and feed modes.
const GEOMETRY: [CodeRow; 7] = [
    (b'G', 20, C::ArcCw),
    (b'G', 30, C::ArcCcw),
    (b'G', 170, C::PlaneXy),
    (b'G', 200, C::Inches),
    (b'G', 210, C::Millimetres),
    (b'G', 930, C::InverseTime),
    (b'G', 940, C::PerMinute),
];

/// Other codes of the RS274/NGC family.
const RS274: [CodeRow; 6] = [
    (b'G', 610, C::ExactPath),
    (b'G', 901, C::CentersAbsolute),
    (b'G', 911, C::CentersRelative),
    (b'M', 0, C::Pause),
    (b'M', 20, C::End),
    (b'M', 300, C::End),
];

/// A laser as a spindle: GRBL's laser mode (doc/markdown/laser_mode.md).
const LASER: [CodeRow; 3] =
    [(b'M', 30, C::BeamConstant), (b'M', 40, C::BeamByMotion), (b'M', 50, C::BeamOff)];

/// Codes that printers share.
const PRINTER: [CodeRow; 3] =
    [(b'M', 730, C::Progress), (b'M', 1040, C::HeatOnly), (b'M', 1090, C::HeatAndWait)];

/// Marlin's own: motors off at the end.
const MARLIN: [CodeRow; 3] = [(b'M', 0, C::Pause), (b'M', 840, C::End), (b'M', 2050, C::Setting)];

/// Klipper's own; G20 is an error there.
const KLIPPER: [CodeRow; 2] = [(b'G', 210, C::Millimetres), (b'M', 840, C::End)];

/// Bambu's own: motors off at the end (`M18` in its own last lines).
const BAMBU: [CodeRow; 1] = [(b'M', 180, C::End)];

/// RepRapFirmware's own; M0 ends the job, M226 waits.
const REPRAPFIRMWARE: [CodeRow; 4] =
    [(b'M', 0, C::End), (b'M', 2030, C::Setting), (b'M', 2260, C::Pause), (b'T', 0, C::Setting)];

/// The words that a controller understands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vocabulary {
    /// The dialect, by which service lines are read.
    pub dialect: Dialect,
    /// The codes that it shares with others, and its own.
    codes: &'static [&'static [CodeRow]],
    /// Commands of `codes` that it does not support.
    except: &'static [Command],
    /// Whether it draws arcs, options of single controllers aside; if not, no arc is read.
    pub draws_arcs: bool,
    /// Whether it surely reads the decimals of G90.1 and G91.1; other controllers may read these as G90 and G91.
    subcodes: bool,
    /// Commands that are words of more than a letter, alone on their line with parameters of their own.
    pub words: &'static [(&'static str, Command)],
    /// Modes that the controller is always in: no program needs to set them.
    pub fixed: &'static [Command],
    /// Letters of the words that carry numbers.
    pub parameters: &'static str,
    /// Whether the controller drives a laser, and S sets its power.
    pub drives_laser: bool,
}

impl Vocabulary {
    /// The plain subset that every controller reads alike. G61 is left out. Arcs, and G91.1 with them, are read only for a
    /// profile that states that its controller draws them.
    const GENERIC: Self = Self {
        dialect: Dialect::Generic,
        codes: &[&COMMON, &GEOMETRY, &RS274],
        except: &[C::ExactPath],
        draws_arcs: true,
        subcodes: false,
        words: &[],
        fixed: &[],
        parameters: "XYZIJFP",
        drives_laser: false,
    };

    /// LinuxCNC.
    const LINUXCNC: Self = Self {
        dialect: Dialect::LinuxCnc,
        codes: &[&COMMON, &GEOMETRY, &RS274],
        except: &[],
        draws_arcs: true,
        subcodes: true,
        words: &[],
        fixed: &[],
        parameters: "XYZIJFP",
        drives_laser: false,
    };

    /// GRBL 1.1, grblHAL and FluidNC: no G90.1.
    const GRBL: Self = Self {
        dialect: Dialect::Grbl,
        codes: &[&COMMON, &GEOMETRY, &RS274],
        except: &[C::CentersAbsolute],
        draws_arcs: true,
        subcodes: true,
        words: &[],
        fixed: &[],
        parameters: "XYZIJFP",
        drives_laser: false,
    };

    /// GRBL's family with a laser: M3, M4 and M5, and S for the power.
    const GRBL_LASER: Self = Self {
        codes: &[&COMMON, &GEOMETRY, &RS274, &LASER],
        parameters: "XYZIJFPS",
        drives_laser: true,
        ..Self::GRBL
    };

    /// Marlin without its options: no arcs, planes or inches.
    const MARLIN: Self = Self {
        dialect: Dialect::Marlin,
        codes: &[&COMMON, &PRINTER, &MARLIN],
        except: &[],
        draws_arcs: false,
        subcodes: false,
        words: &[],
        fixed: &[C::Millimetres, C::PerMinute, C::PlaneXy, C::CentersRelative],
        parameters: "XYZFPSRT",
        drives_laser: false,
    };

    /// Klipper without `[gcode_arcs]`: PAUSE of `[pause_resume]`, extended commands.
    const KLIPPER: Self = Self {
        dialect: Dialect::Klipper,
        codes: &[&COMMON, &PRINTER, &KLIPPER],
        except: &[],
        draws_arcs: false,
        subcodes: false,
        words: &[
            ("PAUSE", C::Pause),
            ("SET_IDLE_TIMEOUT", C::Setting),
            ("SET_VELOCITY_LIMIT", C::Setting),
            ("SET_HEATER_TEMPERATURE", C::HeatOnly),
            ("TEMPERATURE_WAIT", C::HeatAndWait),
        ],
        fixed: &[C::PerMinute],
        parameters: "XYZFPSRT",
        drives_laser: false,
    };

    /// RepRapFirmware 3: arc centres always from the start.
    const REPRAPFIRMWARE: Self = Self {
        dialect: Dialect::RepRapFirmware,
        codes: &[&COMMON, &GEOMETRY, &PRINTER, &REPRAPFIRMWARE],
        except: &[],
        draws_arcs: true,
        subcodes: false,
        words: &[],
        fixed: &[C::CentersRelative],
        parameters: "XYZIJFPSRT",
        drives_laser: false,
    };

    /// Bambu's firmware, whose sources are not published: only words of its own start and end lines, and M400 U1, with which Bambu
    /// Studio pauses (`machine_pause_gcode`).
    const BAMBU: Self = Self {
        dialect: Dialect::Bambu,
        codes: &[&COMMON, &PRINTER, &BAMBU],
        except: &[],
        draws_arcs: false,
        subcodes: false,
        words: &[("M400 U1", C::Pause)],
        fixed: &[C::Millimetres, C::PerMinute, C::PlaneXy, C::CentersRelative],
        parameters: "XYZFPSRT",
        drives_laser: false,
    };

    /// Whether M109 waits with S for a cold heater only, and with R for one that is too hot, too.
    pub const fn waits_by_r(self) -> bool {
        match self.dialect {
            Dialect::Marlin | Dialect::RepRapFirmware => true,
            Dialect::Generic
            | Dialect::LinuxCnc
            | Dialect::Grbl
            | Dialect::GrblHal
            | Dialect::FluidNc
            | Dialect::Klipper
            | Dialect::Bambu => false,
        }
    }

    /// The words of a controller of family `dialect` that draws arcs if its family does.
    pub const fn for_dialect(dialect: Dialect) -> Self {
        match dialect {
            Dialect::Generic => Self::GENERIC,
            Dialect::LinuxCnc => Self::LINUXCNC,
            Dialect::Grbl | Dialect::GrblHal | Dialect::FluidNc => Self::GRBL,
            Dialect::Marlin => Self::MARLIN,
            Dialect::Klipper => Self::KLIPPER,
            Dialect::RepRapFirmware => Self::REPRAPFIRMWARE,
            Dialect::Bambu => Self::BAMBU,
        }
    }

    /// The words of `controller`.
    pub const fn for_controller(controller: &Controller) -> Self {
        let family = match controller.laser {
            Some(_) => Self::GRBL_LASER,
            None => Self::for_dialect(controller.dialect),
        };
        if controller.arcs { family } else { family.without_arcs() }
    }

    /// This vocabulary without the words for arcs.
    pub const fn without_arcs(self) -> Self {
        Self { draws_arcs: false, ..self }
    }

    /// Every code that the controller supports: letter, number, command; in this order.
    pub fn codes(self) -> impl Iterator<Item = (char, f64, Command)> {
        let mut rows: Vec<CodeRow> =
            self.codes.concat().into_iter().filter(|(.., command)| self.reads(*command)).collect();
        rows.sort_unstable_by_key(|(letter, tenths, _)| (*letter, *tenths));
        rows.into_iter()
            .map(|(letter, tenths, command)| (char::from(letter), f64::from(tenths) / 10.0, command))
    }

    /// The command of the code `letter` `number`, if the controller supports it.
    pub fn command(self, letter: u8, number: f64) -> Option<Command> {
        let is_whole = (number * 10.0).fract().abs() < 1e-9;
        let is = |(l, tenths, _): &&CodeRow| {
            *l == letter && f64::from(*tenths) == (number * 10.0).round() && is_whole
        };
        let mut rows = self.codes.iter().flat_map(|codes| codes.iter());
        rows.find(is).map(|(.., command)| *command).filter(|command| self.reads(*command))
    }

    /// Whether the controller supports a code of its family.
    fn reads(self, command: Command) -> bool {
        let for_arcs = match command {
            Command::ArcCw | Command::ArcCcw => true,
            Command::CentersAbsolute | Command::CentersRelative => !self.subcodes,
            _ => false,
        };
        !self.except.contains(&command) && (self.draws_arcs || !for_arcs)
    }
}

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
    /// The laser is on with the power S, whether the tool moves or rests.
    BeamConstant,
    /// The laser is on with the power S at the feed, with less where the tool is slower, and off at rest.
    BeamByMotion,
    /// The laser is off.
    BeamOff,
}

/// The group of commands that are alone on their line.
const ALONE: u8 = 9;
/// The group of commands to a laser.
const BEAM: u8 = 10;

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
            Self::HeatAndWait | Self::HeatOnly | Self::Progress | Self::Setting => ALONE,
            Self::BeamConstant | Self::BeamByMotion | Self::BeamOff => BEAM,
        }
    }

    /// Whether the command is alone on its line, with words of its own.
    pub const fn stands_alone(self) -> bool {
        self.group() == ALONE
    }

    /// Whether it changes how other lines are read, or how the controller moves, and does nothing itself.
    pub const fn is_setting(self) -> bool {
        matches!(self, Self::Setting) || matches!(self.group(), 2..=6 | 8)
    }

    /// Letters that have a meaning with this command only.
    pub const fn own_letters(self) -> &'static [u8] {
        match self {
            Self::Dwell => b"P",
            Self::HeatAndWait => b"RST",
            Self::HeatOnly => b"ST",
            Self::Progress => b"PR",
            Self::Setting => b"IST",
            Self::BeamConstant | Self::BeamByMotion => b"S",
            _ => b"",
        }
    }
}
