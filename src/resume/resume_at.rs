//! The place where a job has stopped.

use crate::resume::ResumeFault;
use crate::resume::toolpath::{TimedMove, Toolpath};
use geom::Point;
use proof::verify::Phase;

/// Largest distance of a given point from a seam, mm: the accuracy of a position read from a display or a ruler.
const REACH: f64 = 10.0;
/// Displays show whole percentages.
const SHOWN: f64 = 0.01;

/// The place where the job stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ResumeAt {
    /// Before the execution of this line, counted from 1.
    Line(usize),
    /// At this fraction of the whole job's time, 0 to 1, as every program shows it: that of a rest, too.
    Share(f64),
    /// This long after the start of this program, s, without heating and pauses.
    Time(f64),
    /// Near this point of the sheet. Of two passes over it the first counts: sealing twice is safer than a gap.
    Near(Point),
}

/// A place on the toolpath.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StopPoint {
    /// Line of the move.
    pub(super) line: usize,
    /// The iron's state in it.
    pub(super) phase: Phase,
    /// Path in contact since the start of the seam's run, mm.
    pub(super) along: f64,
    /// Fraction of the whole job's time before it, 0 to 1.
    pub(super) done: f64,
}

impl StopPoint {
    /// The place at this fraction of a move of `toolpath`, 0 to 1.
    fn new(toolpath: &Toolpath<'_>, timed_move: &TimedMove, fraction: f64) -> Self {
        let length = if timed_move.phase == Phase::Contact { timed_move.step.length() } else { 0.0 };
        let share = toolpath.share_at(timed_move.begins + fraction * timed_move.seconds);
        Self {
            line: timed_move.step.line,
            phase: timed_move.phase,
            along: timed_move.along + fraction * length,
            done: share,
        }
    }
}

impl ResumeAt {
    /// The place on the toolpath.
    pub(super) fn find(self, toolpath: &Toolpath<'_>) -> Result<StopPoint, ResumeFault> {
        match self {
            Self::Line(line) if line == 0 || line > toolpath.lines => {
                Err(ResumeFault::NoSuchLine(line, toolpath.lines))
            }
            Self::Line(line) => first(toolpath, |step| (step.step.line >= line).then_some(0.0)),
            Self::Share(share) if share < toolpath.share_at(0.0) - SHOWN => {
                Err(ResumeFault::BeforeStart(toolpath.share_at(0.0)))
            }
            Self::Share(share) => place_after(toolpath, toolpath.time_at(share)),
            Self::Time(time) => {
                // The first travel is no part of the moves' times: too early is safe, too late leaves a gap.
                let lead = toolpath.stated.map_or(0.0, |stated| (stated - toolpath.seconds).max(0.0));
                place_after(toolpath, (time - lead).max(0.0))
            }
            Self::Near(point) => place_near(toolpath, point),
        }
    }
}

/// The place `time` s after the first travel.
fn place_after(toolpath: &Toolpath<'_>, time: f64) -> Result<StopPoint, ResumeFault> {
    first(toolpath, |step| {
        let fraction = if step.seconds > 0.0 { (time - step.begins) / step.seconds } else { 0.0 };
        (step.begins + step.seconds > time).then_some(fraction.clamp(0.0, 1.0))
    })
}

/// The first move for which `fraction_of` returns a fraction; the job stopped there.
fn first(
    toolpath: &Toolpath<'_>,
    fraction_of: impl Fn(&TimedMove) -> Option<f64>,
) -> Result<StopPoint, ResumeFault> {
    let stop = toolpath.moves().find_map(|step| Some(StopPoint::new(toolpath, &step, fraction_of(&step)?)));
    stop.ok_or(ResumeFault::NothingLeft)
}

/// The place in contact that is nearest to `point`.
fn place_near(toolpath: &Toolpath<'_>, point: Point) -> Result<StopPoint, ResumeFault> {
    let mut best: Option<(f64, StopPoint)> = None;
    for step in toolpath.moves().filter(|step| step.phase == Phase::Contact) {
        let Some(path) = step.step.path else { continue };
        let t = path.nearest_fraction(point);
        let distance = path.point(t).distance(point);
        if best.is_none_or(|(least, _)| distance < least - 1e-6) {
            best = Some((distance, StopPoint::new(toolpath, &step, t)));
        }
    }
    match best {
        None => Err(ResumeFault::NothingLeft),
        Some((distance, _)) if distance > REACH => Err(ResumeFault::Nowhere(distance)),
        Some((_, stop)) => Ok(stop),
    }
}
