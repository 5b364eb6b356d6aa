//! The machine: the settings of one controller, from a profile in `crates/spec/templates/machines/` or the user's own.

use crate::allowed::Allowed;
use crate::dialect::Dialect;
use crate::motion::Motion;
use crate::name::is_plain_word;
use crate::service::Service;
use crate::units::{Acceleration, Duration, Length, Speed};

/// A complete and valid machine profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// The name that the profile gives.
    pub name: String,
    /// One line for `stargrip-cam machines`.
    pub description: String,
    /// The tool that seals.
    pub tool: SealingTool,
    /// The language and abilities of the controller.
    pub controller: Controller,
    /// The process of sealing: heights, ramp, speeds.
    pub process: Process,
    /// The work area and the clamps.
    pub bench: Bench,
    /// Properties of the motors.
    pub motion: Motion,
    /// The profile's own lines.
    pub script: Script,
}

impl Machine {
    /// A heat press, which has neither a controller nor an iron.
    pub(crate) fn press(name: String, description: String) -> Self {
        // No program is written for a press. The controller's values are those of the plainest one, so that a room that asks for
        // one finds nothing that a controller could do.
        let controller = Controller {
            dialect: Dialect::Generic,
            line_length: 72,
            comments: Comments::Semicolon,
            arcs: false,
            dwell: Dwells { unit: DwellUnit::Seconds, step: Duration(1e-3) },
            heating: Heating::Operator,
            thumbnails: false,
            place: SheetPlace::default(),
            laser: None,
        };
        let heights = Heights { contact: Length(0.0), travel: Length(0.0), park: Length(0.0) };
        let process = Process {
            spring_loaded: false,
            heights,
            ramp: Length(0.0),
            travel_speed: Speed(1.0),
            trace_speed: Speed(1.0),
        };
        Self {
            name,
            description,
            tool: SealingTool::Press,
            controller,
            process,
            bench: Bench::default(),
            motion: Motion::UNKNOWN,
            script: Script::default(),
        }
    }
}

/// The tool that seals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SealingTool {
    /// A hot tip that programs lead along the seams.
    Iron,
    /// A laser whose spot programs lead along the seams; the controller drives it.
    Laser,
    /// Two plates, which press a whole sheet at once and run no program. The controller of such a machine means nothing.
    Press,
}

/// The laser of a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaserDrive {
    /// The S word of full power: `$30` of GRBL and grblHAL.
    pub full_power: f64,
}

impl LaserDrive {
    /// The S word of `percent` of full power, in whole thousandths.
    pub fn word(self, percent: f64) -> f64 {
        (self.full_power * percent * 10.0).round() / 1000.0
    }
}

/// The language and abilities of the controller: enough to write a program for it, and to read one.
#[derive(Clone, Debug, PartialEq)]
pub struct Controller {
    /// The words that it understands.
    pub dialect: Dialect,
    /// Longest line that it reads, in characters without the line end.
    pub line_length: usize,
    /// The form of comments.
    pub comments: Comments,
    /// Whether it draws arcs (G2, G3) exactly enough. If not, arcs are cut into chords.
    pub arcs: bool,
    /// The unit of a dwell's time, and the step to which the controller rounds it up.
    pub dwell: Dwells,
    /// The way in which the iron is heated.
    pub heating: Heating,
    /// Whether programs carry pictures for hosts that show them.
    pub thumbnails: bool,
    /// The place of the sheet in the controller's coordinates.
    pub place: SheetPlace,
    /// The laser that it drives; `None` of a machine with an iron.
    pub laser: Option<LaserDrive>,
}

impl Controller {
    /// The heat of the tool, as programs name it: "laser", or the name of the heating.
    pub fn heating_name(&self) -> String {
        if self.laser.is_some() { "laser".to_owned() } else { self.heating.name() }
    }
}

/// The place of the sheet in the controller's coordinates: 0 where the operator sets them by hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SheetPlace {
    /// X of the sheet's lower left corner.
    pub x: Length,
    /// Y of the sheet's lower left corner.
    pub y: Length,
    /// Z of the release layer.
    pub surface: Length,
}

impl SheetPlace {
    /// X, Y and Z that are added to every position of the sheet's frame, mm.
    pub const fn shift(self) -> [f64; 3] {
        [self.x.0, self.y.0, self.surface.0]
    }

    /// Whether coordinates are those of the sheet's frame.
    pub fn is_origin(self) -> bool {
        self == Self::default()
    }
}

/// The process of sealing: the way in which the iron is led over the fabric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Process {
    /// Whether the tip is spring-loaded; a rigid one must stay at height 0 or above.
    pub spring_loaded: bool,
    /// Heights of the iron's tip above the release layer.
    pub heights: Heights,
    /// Length of the ramp along the path on which the iron goes down before, and up after, a seam.
    pub ramp: Length,
    /// Speed of travel (G0): written as a feed where the controller needs one, else for time estimates only.
    pub travel_speed: Speed,
    /// Speed of the trace program.
    pub trace_speed: Speed,
}

impl Process {
    /// Lowest height of the tip in contact.
    pub fn lowest_contact(&self) -> Length {
        Length(lowest_contact(self.spring_loaded))
    }
}

/// Lowest height in contact, mm: a spring is pressed in by at most 20 mm, and a rigid tip would be pressed into the bed.
pub(crate) const fn lowest_contact(spring_loaded: bool) -> f64 {
    if spring_loaded { -20.0 } else { 0.0 }
}

/// Height in contact: above the release layer the iron seals nothing.
pub const CONTACT: Allowed = Allowed::closed(lowest_contact(true), 0.0);

/// Heights are whole micrometres, which every program can state: a program that rounded one would not be at it.
pub(crate) fn to_micrometres(mm: f64) -> f64 {
    (mm * 1000.0).round() / 1000.0
}

/// The work area and the clamps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bench {
    /// Reachable area from the sheet's lower left corner, X by Y; `None` if unknown: the sheet is then the only limit.
    pub work_area: Option<(Length, Length)>,
    /// Places of the clamps.
    pub keep_out: Vec<KeepOut>,
}

/// The profile's own lines, which go into a program as they are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// Lines that set the controller's modes: units, plane, distance, arc and feed mode.
    pub start: Vec<String>,
    /// The line at which the machine waits for the operator.
    pub pause: String,
    /// Lines that end the program.
    pub end: Vec<String>,
    /// Tasks of the operator before the program runs, each a short line.
    pub requires: Vec<String>,
    /// Limits that lines of `start` set.
    pub limits: Limits,
    /// Effects of the service lines of `start`, in order.
    pub services: Vec<Service>,
}

impl Script {
    /// Whether the program finds the axes' zero by itself.
    pub fn homes(&self) -> bool {
        self.services.iter().any(|service| matches!(service, Service::Home(_)))
    }
}

/// Limits that lines of a program set for the moves that follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// No move is slower than this.
    pub lowest_speed: Option<Speed>,
    /// No move is faster than this.
    pub top_speed: Option<Speed>,
    /// Axes speed up by this.
    pub acceleration: Option<Acceleration>,
    /// The heater is switched off after this time without a move.
    pub idle_timeout: Option<Duration>,
}

impl Limits {
    /// These limits, replaced by those that a `newer` line sets.
    pub(crate) fn replaced_by(self, newer: Self) -> Self {
        Self {
            lowest_speed: newer.lowest_speed.or(self.lowest_speed),
            top_speed: newer.top_speed.or(self.top_speed),
            acceleration: newer.acceleration.or(self.acceleration),
            idle_timeout: newer.idle_timeout.or(self.idle_timeout),
        }
    }
}

/// The form of a comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comments {
    /// From `;` to the end of the line.
    Semicolon,
    /// Between `(` and `)`.
    Parentheses,
}

/// Unit and resolution of dwells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dwells {
    /// Unit of the P word.
    pub unit: DwellUnit,
    /// The controller rounds every dwell up to a multiple of this.
    pub step: Duration,
}

/// Unit of a dwell's P word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DwellUnit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
}

/// The way in which the iron reaches its temperature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Heating {
    /// The operator sets a soldering station and confirms.
    Operator,
    /// The controller heats a hotend and waits (M109): that of the tool in use, or of this number.
    Hotend(Option<u32>),
    /// The controller heats the `[heater_generic]` of this name and waits (Klipper).
    Heater(String),
}

/// Most hotends of a machine.
const HOTENDS: u32 = 9;
/// Longest name of a heater, in characters: the line that waits for it must fit.
const HEATER_LENGTH: usize = 16;

impl Heating {
    /// The heating called `text` in profiles: "operator", "hotend", "hotend 1", "heater NAME"; `None` if there is no such.
    pub fn read(text: &str) -> Option<Self> {
        match text.split_once(' ') {
            None if text == "operator" => Some(Self::Operator),
            None if text == "hotend" => Some(Self::Hotend(None)),
            Some(("hotend", number)) if number.len() == 1 => {
                number.parse().ok().filter(|number| *number <= HOTENDS).map(|n| Self::Hotend(Some(n)))
            }
            Some(("heater", name)) if name.len() <= HEATER_LENGTH && is_plain_word(name) => {
                Some(Self::Heater(name.to_owned()))
            }
            _ => None,
        }
    }

    /// Whether the program heats, and no operator.
    pub fn is_by_program(&self) -> bool {
        *self != Self::Operator
    }

    /// The name in profiles.
    pub fn name(&self) -> String {
        match self {
            Self::Operator => "operator".to_owned(),
            Self::Hotend(None) => "hotend".to_owned(),
            Self::Hotend(Some(number)) => format!("hotend {number}"),
            Self::Heater(name) => format!("heater {name}"),
        }
    }
}

/// Heights of the tip, or of a laser's focus; Z 0 is the top of the release layer, or of the sheet below a laser.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heights {
    /// While sealing: 0 for a rigid iron, below 0 for a spring-loaded one; of a laser the height of its focus, above 0.
    pub contact: Length,
    /// While travelling between seams.
    pub travel: Length,
    /// Before and after the job.
    pub park: Length,
}

/// A clamp: a rectangle in the sheet's frame that the iron must not enter.
#[derive(Clone, Debug, PartialEq)]
pub struct KeepOut {
    /// The user's name for it.
    pub name: String,
    /// Lower left corner.
    pub x: Length,
    /// Lower left corner.
    pub y: Length,
    /// Extent along X.
    pub width: Length,
    /// Extent along Y.
    pub depth: Length,
    /// Height of the clamp above the release layer; `None`: the iron must not pass above it at any height.
    pub height: Option<Length>,
}
