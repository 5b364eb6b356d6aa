//! The rules by which the iron is led, and its phase by its height.

use crate::verify::judge::HEIGHT;
use crate::verify::judge::stroke::shortest_move;
use crate::verify::read::gcode::Move;
use spec::{FeedFloor, Heights, Machine, Motion, Process, Seal, Spec};

/// The rules by which the iron is led, whatever its path.
#[derive(Clone, Copy, Debug)]
pub struct IronRules<'a> {
    /// Temperature, speed and band.
    pub seal: &'a Seal,
    /// Heights and travels.
    pub process: &'a Process,
    /// Properties of the motors.
    pub motion: &'a Motion,
    /// The step to which the controller rounds dwells up, s.
    pub dwell_step: f64,
    /// Whether the speed may be made of strokes and dwells.
    pub chops: bool,
    /// Whether all data for the timing of strokes are known.
    pub timed: bool,
}

/// The phase of the iron, from its heights.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Phase {
    /// Away from the fabric.
    Clear,
    /// Moving down.
    Down,
    /// In contact.
    Contact,
    /// Moving up.
    Up,
}

impl Phase {
    /// The phase of the iron in a move.
    pub fn new(step: &Move, heights: &Heights) -> Self {
        let (low, high) = (step.from.z.min(step.to.z), step.from.z.max(step.to.z));
        if low >= heights.travel.0 - HEIGHT {
            Self::Clear
        } else if high <= heights.contact.0 + HEIGHT {
            Self::Contact
        } else if step.to.z < step.from.z {
            Self::Down
        } else {
            Self::Up
        }
    }
}

impl<'a> IronRules<'a> {
    /// The rules for programs of `spec` on `machine`.
    pub fn new(spec: &'a Spec, machine: &'a Machine) -> Self {
        Self {
            seal: &spec.seal,
            process: &machine.process,
            motion: &machine.motion,
            dwell_step: machine.controller.dwell.step.0,
            chops: spec.machine.feed_floor == FeedFloor::Chop,
            timed: true,
        }
    }

    /// The phase of the iron in a move.
    pub(super) fn phase(&self, step: &Move) -> Phase {
        Phase::new(step, &self.process.heights)
    }

    /// The longest time at rest, s: the time for a tenth of the band, as a longer rest leaves a scar; or that of two of the
    /// shortest moves that the controller makes.
    pub(super) fn longest_rest(&self) -> f64 {
        let way = (self.seal.band.0 / 10.0).max(2.0 * shortest_move(self.motion));
        way / self.seal.speed.0 + 1e-9
    }
}
