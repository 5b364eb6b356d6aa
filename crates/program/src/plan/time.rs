//! Exact time: lengths over speed in contact, dwells, travels that speed up and brake.
//!
//! Heating and pauses depend on the heater and the operator: they are not counted. At the seal's speed
//! acceleration does not count (a hundredth of a second at each corner at most); where a path is chopped it does, and for a laser, too.

use crate::plan::bends::FastTool;
use crate::plan::lowest_feed::lowest_of;
use crate::plan::program::{PacedProcess, SeamList, steps_of};
use crate::plan::travel::{Travel, TravelLimits};
use crate::plan::written::{Precision, Written};
use crate::plan::{Height, Pace, Pacer, Program, Purpose, Step};
use geom::{Point, Segment};
use sealed::PieceName;
use spec::{Machine, Process, SealProcess, Spec};

/// Follows a program step by step and adds up its time.
#[derive(Clone, Debug)]
pub struct Clock<'a> {
    machine: &'a Machine,
    at: Point,
    height: f64,
    /// The travel that has just been made, if the iron may not have stopped after it.
    last: Option<Travel>,
    /// A laser on its way along a path, which has not stopped yet.
    fast: Option<FastTool>,
    /// Time so far, s.
    pub elapsed: f64,
}

impl<'a> Clock<'a> {
    /// A clock at the beginning, with the iron where every program leaves it: parked above the sheet's corner.
    pub fn new(machine: &'a Machine) -> Self {
        let height = height_of(&machine.process, Height::Park);
        Self { machine, at: Point::ORIGIN, height, last: None, fast: None, elapsed: 0.0 }
    }

    /// Adds what a laser loses where it begins to follow `piece` at `speed`, mm/s; `heights` are those of its two ends where they differ.
    /// Any other tool loses nothing.
    pub fn bend(&mut self, piece: &Segment, heights: Option<(f64, f64)>, speed: f64) {
        let Machine { controller, motion, .. } = self.machine;
        let Some(acceleration) = motion.acceleration.filter(|_| controller.laser.is_some()) else { return };
        let rise = heights.map_or(0.0, |(from, to)| to - from);
        let tool = FastTool::following(piece, rise, speed, acceleration.0);
        self.elapsed += tool.loss(piece, rise, self.fast.replace(tool));
    }

    /// Adds what a laser loses where it stops.
    fn stop(&mut self) {
        self.elapsed += self.fast.take().map_or(0.0, FastTool::stop);
    }

    /// Adds a move or wait that took `seconds` and ended at `end`.
    pub fn add(&mut self, end: Point, height: Option<f64>, seconds: f64) {
        self.at = end;
        self.height = height.unwrap_or(self.height);
        self.last = None;
        self.elapsed += seconds;
    }

    /// Adds a travel in the plane.
    pub fn travel(&mut self, end: Point) {
        self.go([end.x - self.at.x, end.y - self.at.y, 0.0]);
        self.at = end;
    }

    /// Adds a move straight up or down.
    pub fn height(&mut self, level: Height) {
        let height = height_of(&self.machine.process, level);
        self.go([0.0, 0.0, height - self.height]);
        self.height = height;
    }

    /// Adds a wait.
    pub fn wait(&mut self, seconds: f64) {
        self.stop();
        self.last = None;
        self.elapsed += seconds;
    }

    fn go(&mut self, way: [f64; 3]) {
        self.stop();
        let Machine { controller, process, motion, .. } = self.machine;
        let (speed, acceleration) = (process.travel_speed.0, motion.acceleration.map(|a| a.0));
        let limits = TravelLimits { dialect: controller.dialect, speed, acceleration, z: motion.z };
        let Some(mut travel) = Travel::new(limits, way) else { return };
        self.elapsed += travel.seconds_after(self.last.as_ref());
        self.last = Some(travel);
    }
}

/// The height of a level, mm.
pub fn height_of(process: &Process, level: Height) -> f64 {
    match level {
        Height::Travel => process.heights.travel.0,
        Height::Park => process.heights.park.0,
    }
}

/// The scope of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Scope {
    /// Purpose of the program.
    pub purpose: Purpose,
    /// Number of its sheet, from 1.
    pub sheet: usize,
    /// Pieces of the program, in the order of sealing.
    pub pieces: Vec<PieceName>,
}

impl Program {
    /// The program of these steps with the contacts of `list` on `machine`, with its paces and its time. A program without processes has
    /// that of `[seal]`.
    pub fn new(spec: &Spec, machine: &Machine, scope: Scope, steps: Vec<Step>, list: SeamList) -> Self {
        let Scope { purpose, sheet, pieces } = scope;
        let SeamList { seams, processes } = list;
        let processes = if processes.is_empty() { vec![spec.default_process()] } else { processes };
        let motion = &machine.motion;
        let paced = |(process, index): (SealProcess, usize)| {
            let lowest = match purpose {
                Purpose::Seal | Purpose::Cut => lowest_of(motion, steps_of(&steps, &seams, index)),
                // The feed check goes at the pace of any other program: that of the worst direction.
                Purpose::Trace => motion.speed_range().map(|(_, most)| most),
            };
            let pace = Pace::new(&spec.sealed_by(&process), machine, lowest);
            PacedProcess { process, pace, overdue: 0.0 }
        };
        let processes: Vec<PacedProcess> = processes.into_iter().zip(0..).map(paced).collect();
        let mut program = Self { purpose, sheet, pieces, steps, seams, processes, time: 0.0, motion: None };
        let (times, overdue) = times_of(&program, spec, machine);
        program.time = times.last().copied().unwrap_or(0.0);
        for (paced, overdue) in program.processes.iter_mut().zip(overdue) {
            paced.overdue = overdue;
        }
        program
    }

    /// The end of each of its steps, s from the beginning: one time a step, the last one is that of the whole program.
    pub fn timeline(&self, spec: &Spec, machine: &Machine) -> Vec<f64> {
        times_of(self, spec, machine).0
    }

    /// The pacer of the process at place `process`, at the start of a contact.
    pub fn pacer(&self, process: usize) -> Pacer {
        let paced = &self.processes[process.min(self.processes.len() - 1)];
        Pacer::new(paced.pace, paced.process.seal.speed.0)
    }
}

/// The end of each step of `program`, s, without heating and pauses; and for each of its processes the largest time by which the iron is
/// early after a stop.
fn times_of(program: &Program, spec: &Spec, machine: &Machine) -> (Vec<f64>, Vec<f64>) {
    let level = machine.process.heights.travel.0;
    let file = Precision { path: spec.accuracy.path, arcs: machine.controller.arcs };
    let mut clock = Clock::new(machine);
    let (mut process, mut pacer) = (0, program.pacer(0));
    let mut overdue = vec![0.0_f64; program.processes.len()];
    let mut times = Vec::with_capacity(program.steps.len());
    for step in &program.steps {
        match step {
            Step::Height(level) => clock.height(*level),
            Step::Travel(to) => clock.travel(*to),
            Step::TouchDown(ramp) | Step::Lift(ramp) => {
                for (piece, from, to) in ramp.with_heights() {
                    clock.bend(piece, Some((from, to)), program.processes[process].process.seal.speed.0);
                    clock.add(piece.end(), Some(to), seal_time(&mut pacer, piece, Some((from, to))));
                }
                overdue[process] = overdue[process].max(pacer.overdue());
            }
            Step::Seal(pieces) => {
                for piece in pieces {
                    clock.bend(piece, None, program.processes[process].process.seal.speed.0);
                    clock.add(piece.end(), None, seal_time(&mut pacer, piece, None));
                }
                overdue[process] = overdue[process].max(pacer.overdue());
            }
            Step::Trace(pieces) => {
                for piece in pieces {
                    // Chords are shorter than their arcs: where the path is coarse by 3 % at the tips.
                    let length = Written::new(piece, [level, level], file).length;
                    clock.add(piece.end(), None, length / machine.process.trace_speed.0);
                }
            }
            // Every contact has a schedule of its own.
            Step::Seam(i) => {
                process = program.seams.get(*i).map_or(0, |seam| seam.process);
                pacer = program.pacer(process);
            }
            Step::Cool(wait) => clock.wait(wait.0),
            Step::Heat(_) | Step::Pause(_) => {}
        }
        times.push(clock.elapsed);
    }
    (times, overdue)
}

/// Time for all strokes of `piece`, s.
fn seal_time(pacer: &mut Pacer, piece: &Segment, heights: Option<(f64, f64)>) -> f64 {
    let mut seconds = 0.0;
    pacer.strokes(piece, heights, |stroke| seconds += stroke.seconds);
    seconds
}
