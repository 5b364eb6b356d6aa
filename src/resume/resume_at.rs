//! Places at which a job can have stopped.

use crate::geom::Point;
use crate::resume::ResumeFault;
use crate::resume::toolpath::{Phase, Toolpath};

/// Farthest from a seam that a point may be told, mm: as well as one reads a position off a display or a ruler.
const REACH: f64 = 10.0;

/// Where the job stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ResumeAt {
    /// Before this line was done, counted from 1.
    Line(usize),
    /// When this part of the job's time was over, 0 to 1.
    Share(f64),
    /// Near this point of the sheet. Of two passes over it the first counts: rather seal twice than not at all.
    Near(Point),
}

/// A place on the toolpath.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stop {
    /// Index of the step.
    pub(super) step: usize,
    /// Way in contact since the seam's run began, mm.
    pub(super) along: f64,
    /// Part of the job's time before it, 0 to 1.
    pub(super) done: f64,
}

impl ResumeAt {
    /// The place on the toolpath.
    pub(super) fn find(self, toolpath: &Toolpath) -> Result<Stop, ResumeFault> {
        let steps = &toolpath.steps;
        let total = toolpath.seconds();
        let stop = |step: usize, fraction: f64| {
            let at = &steps[step];
            let length = if at.phase == Phase::Contact { at.step.length() } else { 0.0 };
            Stop {
                step,
                along: at.along + fraction * length,
                done: (at.begins + fraction * at.seconds) / total,
            }
        };
        match self {
            Self::Line(line) if line == 0 || line > toolpath.lines => {
                Err(ResumeFault::NoSuchLine(line, toolpath.lines))
            }
            Self::Line(line) => {
                let step = steps.partition_point(|step| step.step.line < line);
                if step < steps.len() { Ok(stop(step, 0.0)) } else { Err(ResumeFault::NothingLeft) }
            }
            Self::Share(share) => {
                let time = share * total;
                let step = steps.partition_point(|step| step.begins + step.seconds <= time);
                let at = steps.get(step).ok_or(ResumeFault::NothingLeft)?;
                let fraction = if at.seconds > 0.0 { (time - at.begins) / at.seconds } else { 0.0 };
                Ok(stop(step, fraction.clamp(0.0, 1.0)))
            }
            Self::Near(point) => {
                let mut best = (f64::INFINITY, 0, 0.0);
                for (i, step) in steps.iter().enumerate().filter(|(_, step)| step.phase == Phase::Contact) {
                    let Some(path) = step.step.path else { continue };
                    let t = path.nearest_fraction(point);
                    let distance = path.point(t).distance(point);
                    if distance < best.0 - 1e-6 {
                        best = (distance, i, t);
                    }
                }
                if best.0.is_infinite() {
                    return Err(ResumeFault::NothingLeft);
                }
                if best.0 > REACH { Err(ResumeFault::Nowhere(best.0)) } else { Ok(stop(best.1, best.2)) }
            }
        }
    }
}
