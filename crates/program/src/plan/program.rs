//! Programs and their steps.

use crate::plan::Pace;
use design::Design;
use geom::{Isometry, Point, Segment};
use sealed::{PieceName, SeamName};
use spec::units::{Duration, Length, Temperature};
use spec::{CutTool, Machine, SealProcess};

/// The purpose of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Sealing, hot.
    Seal,
    /// A look at where the iron will go: at travel height, unheated, fast.
    Trace,
    /// Cutting the sheet after the seal, with another tool.
    Cut,
}

/// One program of one sheet, for one piece or several.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Purpose of the program.
    pub purpose: Purpose,
    /// Number of its sheet, from 1.
    pub sheet: usize,
    /// The pieces it covers, in the order of sealing.
    pub pieces: Vec<PieceName>,
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// The contacts, in order: a seam, or one line of a seam once; empty for a trace.
    pub seams: Vec<SeamReport>,
    /// The processes by which its seams are made, with their paces; at least one.
    pub processes: Vec<PacedProcess>,
    /// Time of all steps without heating and pauses, s.
    pub time: f64,
    /// The motion of its sheet, which was found again; `None` for a sheet where it was laid out.
    pub motion: Option<Isometry>,
}

/// A process of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct PacedProcess {
    /// Temperature, speed and everything else of it.
    pub process: SealProcess,
    /// The way in which its speed is reached.
    pub pace: Pace,
    /// Largest time by which the iron is early after the longest rest that leaves no scar, s; 0 where it is on time.
    pub overdue: f64,
}

/// The contacts of a program on its way, and their processes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeamList {
    /// The contacts, in order.
    pub seams: Vec<SeamReport>,
    /// Their processes.
    pub processes: Vec<SealProcess>,
}

/// The steps of a program that one of its processes makes.
#[derive(Clone, Debug)]
pub(super) struct ProcessSteps<'a> {
    /// The process.
    pub(super) paced: &'a PacedProcess,
    /// The steps.
    pub(super) steps: Vec<&'a Step>,
}

/// One step. Heights and speeds are the machine's; positions are in the sheet's frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Straight up or down to a level, away from the fabric.
    Height(Height),
    /// Heating; the operator or the controller confirms it.
    Heat(Temperature),
    /// A pause for the operator.
    Pause(PauseReason),
    /// A wait at travel height, for a seam to cool.
    Cool(Duration),
    /// In a straight line, at the height where it is, clear of the fabric.
    Travel(Point),
    /// A new contact begins: index into [`Program::seams`].
    Seam(usize),
    /// Down to contact along the path.
    TouchDown(Ramp),
    /// In contact, at seal speed.
    Seal(Vec<Segment>),
    /// Up to travel height along the path.
    Lift(Ramp),
    /// At travel height, at trace speed.
    Trace(Vec<Segment>),
}

/// The reason for which a program waits for the operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PauseReason {
    /// A look at the last seam: index of the next one.
    Look(usize),
    /// Goggles on and the enclosure closed before a laser may come on.
    Beam,
    /// Another tool in the place of the iron.
    Tool(CutTool),
    /// The tip is above a mark of the sheet.
    Mark {
        /// Number of the mark, from 1.
        number: usize,
        /// Place of the mark.
        place: Point,
    },
}

impl Step {
    /// The path along which the step moves, in pieces; empty where it moves straight up or down, in a straight line, or not at all.
    pub fn pieces(&self) -> &[Segment] {
        match self {
            Self::TouchDown(ramp) | Self::Lift(ramp) => &ramp.pieces,
            Self::Seal(pieces) | Self::Trace(pieces) => pieces,
            Self::Height(_)
            | Self::Heat(_)
            | Self::Pause(_)
            | Self::Cool(_)
            | Self::Travel(_)
            | Self::Seam(_) => &[],
        }
    }

    /// The ramp of a step that goes down to contact or up from it.
    pub fn ramp(&self) -> Option<&Ramp> {
        match self {
            Self::TouchDown(ramp) | Self::Lift(ramp) => Some(ramp),
            Self::Height(_)
            | Self::Heat(_)
            | Self::Pause(_)
            | Self::Cool(_)
            | Self::Travel(_)
            | Self::Seam(_)
            | Self::Seal(_)
            | Self::Trace(_) => None,
        }
    }

    /// Whether the step is below travel height.
    pub fn is_contact(&self) -> bool {
        match self {
            Self::TouchDown(_) | Self::Seal(_) | Self::Lift(_) => true,
            Self::Height(_)
            | Self::Heat(_)
            | Self::Pause(_)
            | Self::Cool(_)
            | Self::Travel(_)
            | Self::Seam(_)
            | Self::Trace(_) => false,
        }
    }

    /// The point to which the step moves; `None` where it moves straight up or down, or not at all.
    pub fn end(&self) -> Option<Point> {
        if let Self::Travel(point) = self { Some(*point) } else { self.pieces().last().map(Segment::end) }
    }
}

/// A path on which the height changes evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    /// The path in pieces.
    pub pieces: Vec<Segment>,
    /// Height at its beginning, mm.
    pub from: f64,
    /// Height at its end, mm.
    pub to: f64,
}

/// A height of the iron away from the fabric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Height {
    /// Between seams.
    Travel,
    /// Before and after the job.
    Park,
}

/// Length and time of one contact.
#[derive(Clone, Debug, PartialEq)]
pub struct SeamReport {
    /// Name of the seam.
    pub name: SeamName,
    /// Path in contact, overlap included, mm.
    pub length: f64,
    /// Part of it that is covered twice, mm.
    pub overlap: f64,
    /// Time in contact, ramps included, s.
    pub time: f64,
    /// The place of its process in [`Program::processes`].
    pub process: usize,
    /// Number of its line of the band, from 1.
    pub line: u32,
    /// Number of its pass, from 1.
    pub pass: u32,
}

impl Program {
    /// The program with the motion of its sheet, if `design` has one.
    pub(super) fn on_sheet_of(self, design: &Design) -> Self {
        Self { motion: design.motion(self.sheet), ..self }
    }

    /// The pace of its first process: of a program with one process, that of all seams.
    pub fn pace(&self) -> Pace {
        self.processes.first().map_or(Pace::Steady, |paced| paced.pace)
    }

    /// Whether every seam is sealed once, by the process of `[seal]`.
    pub fn is_plain(&self) -> bool {
        self.processes.iter().all(|paced| paced.process.is_plain())
    }

    /// Whether its seams are sealed at more than one temperature.
    pub fn changes_temperature(&self) -> bool {
        let mut temperatures = self.processes.iter().map(|paced| paced.process.seal.temperature);
        let first = temperatures.next();
        temperatures.any(|temperature| Some(temperature) != first)
    }

    /// The steps by process.
    pub(super) fn by_process(&self) -> Vec<ProcessSteps<'_>> {
        let steps = |(paced, index): (_, usize)| ProcessSteps {
            paced,
            steps: steps_of(&self.steps, &self.seams, index),
        };
        self.processes.iter().zip(0..).map(steps).collect()
    }

    /// The numbers of its pieces that are numbered, such as stars.
    pub fn numbers(&self) -> Vec<usize> {
        self.pieces.iter().filter_map(PieceName::number).collect()
    }
}

/// The processes of `programs`, each once, in the order of their first programs.
pub fn distinct_processes<'p>(programs: impl IntoIterator<Item = &'p Program>) -> Vec<&'p SealProcess> {
    let mut processes: Vec<&SealProcess> = Vec::new();
    for paced in programs.into_iter().flat_map(|program| &program.processes) {
        if processes.iter().all(|process| process.name != paced.process.name) {
            processes.push(&paced.process);
        }
    }
    processes
}

/// The lowest height in contact of `programs` on `machine`; `None` without a program.
pub(super) fn lowest_contact(machine: &Machine, programs: &[Program]) -> Option<Length> {
    let heights =
        distinct_processes(programs).into_iter().map(|process| process.seal.contact(&machine.process));
    heights.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The ones of `steps` that make contacts of the process at place `process`, and those before the first contact.
pub(super) fn steps_of<'s>(steps: &'s [Step], seams: &[SeamReport], process: usize) -> Vec<&'s Step> {
    let mut current = process;
    let of_process = |step: &&Step| {
        if let Step::Seam(index) = step {
            current = seams.get(*index).map_or(process, |seam| seam.process);
        }
        current == process
    };
    steps.iter().filter(of_process).collect()
}

impl SeamReport {
    /// Whether it is the first contact of its seam.
    pub fn is_first(&self) -> bool {
        (self.line, self.pass) == (1, 1)
    }
}

impl Ramp {
    /// Length of the way in space, mm.
    pub fn length(&self) -> f64 {
        let flat: f64 = self.pieces.iter().map(Segment::length).sum();
        libm::hypot(flat, self.to - self.from)
    }

    /// The pieces, each with the heights at its two ends.
    pub fn with_heights(&self) -> impl Iterator<Item = (&Segment, f64, f64)> {
        let total: f64 = self.pieces.iter().map(Segment::length).sum();
        let mut length = 0.0;
        let last = self.pieces.len();
        self.pieces.iter().zip(1..).map(move |(piece, i)| {
            let start_height = self.from + (self.to - self.from) * (length / total);
            length += piece.length();
            let height =
                if i == last { self.to } else { self.from + (self.to - self.from) * (length / total) };
            (piece, start_height, height)
        })
    }
}
