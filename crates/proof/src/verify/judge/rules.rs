//! The rules by which the iron is led in every contact, and its phase by its height.

use crate::verify::judge::HEIGHT;
use crate::verify::judge::stroke::shortest_move;
use crate::verify::read::gcode::Move;
use design::SealJob;
use spec::units::Temperature;
use spec::{FeedFloor, Machine, Motion, Process, Seal, Spec};

/// The rules by which the iron is led, whatever its path.
#[derive(Clone, Debug)]
pub struct IronRules<'a> {
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
    /// The rules of every contact, in order.
    pub contacts: Vec<ContactRule>,
    /// The rules of a contact that is not among them.
    pub default: ContactRule,
}

/// The rules of one contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactRule {
    /// Temperature, speed and band.
    pub seal: Seal,
    /// Height in contact, mm.
    pub height: f64,
    /// Wait at travel height after it, s; 0 without one.
    pub cool: f64,
}

impl ContactRule {
    fn new(seal: &Seal, cool: f64, process: &Process) -> Self {
        Self { seal: seal.clone(), height: seal.contact(process).0, cool }
    }
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
    /// The phase of the iron in a move; heights of `travel` and of `contact` in mm.
    pub fn new(step: &Move, travel: f64, contact: f64) -> Self {
        let high = step.from.z.max(step.to.z);
        if is_clear(step, travel) {
            Self::Clear
        } else if high <= contact + HEIGHT {
            Self::Contact
        } else if step.to.z < step.from.z {
            Self::Down
        } else {
            Self::Up
        }
    }
}

/// Whether a move stays at the height of `travel`, mm, or above.
fn is_clear(step: &Move, travel: f64) -> bool {
    step.from.z.min(step.to.z) >= travel - HEIGHT
}

/// The number of contacts that have begun on the way through a program.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactCount {
    contacts: usize,
    is_low: bool,
}

impl ContactRule {
    /// The longest time at rest, s: the time for a tenth of the band, as a longer rest leaves a scar; or that of two of the
    /// shortest moves that the controller makes.
    pub(super) fn longest_rest(&self, motion: &Motion) -> f64 {
        let way = (self.seal.band.0 / 10.0).max(2.0 * shortest_move(motion));
        way / self.seal.speed.0 + 1e-9
    }
}

impl<'a> IronRules<'a> {
    /// The rules for programs of `spec` on `machine` that make the contacts of `job`.
    pub fn new(spec: &'a Spec, machine: &'a Machine, job: &SealJob) -> Self {
        let process = &machine.process;
        let contact = |(contact, index)| {
            let cool = job.cool_after(index).map_or(0.0, |cool| cool.0);
            ContactRule::new(&job.process(contact).seal, cool, process)
        };
        Self {
            process,
            motion: &machine.motion,
            dwell_step: machine.controller.dwell.step.0,
            chops: spec.machine.feed_floor == FeedFloor::Chop,
            timed: true,
            contacts: job.contacts.iter().zip(0..).map(contact).collect(),
            default: ContactRule::new(&spec.seal, 0.0, process),
        }
    }

    /// Whether the iron is away from the fabric in a move.
    pub(super) fn is_clear(&self, step: &Move) -> bool {
        is_clear(step, self.process.heights.travel.0)
    }

    /// The phase of the iron in a move, and the rules of the contact that it belongs to, or of the last one; `count` goes with the moves.
    pub fn follow(&self, count: &mut ContactCount, step: &Move) -> (Phase, &ContactRule) {
        let is_low = !self.is_clear(step);
        count.contacts += usize::from(is_low && !count.is_low);
        count.is_low = is_low;
        let rule = self.rule(count);
        (Phase::new(step, self.process.heights.travel.0, rule.height), rule)
    }

    /// The rules of the contact that began last.
    pub(super) fn rule(&self, count: &ContactCount) -> &ContactRule {
        let place = count.contacts.checked_sub(1);
        place.and_then(|place| self.contacts.get(place)).unwrap_or(&self.default)
    }

    /// The temperatures to which the iron is heated, in order.
    pub(super) fn heats(&self) -> Vec<Temperature> {
        let rules =
            if self.contacts.is_empty() { std::slice::from_ref(&self.default) } else { &self.contacts };
        let temperatures = rules.iter().map(|contact| contact.seal.temperature);
        // A tool of 0 C is cold.
        let mut heats: Vec<Temperature> = temperatures.filter(|temperature| temperature.0 > 0.0).collect();
        heats.dedup();
        heats
    }
}
