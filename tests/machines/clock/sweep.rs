//! Controllers that look ahead over the whole queue and follow every ramp exactly: Klipper (klippy/toolhead.py, Move and LookAheadQueue;
//! kinematics/cartesian.py), RepRapFirmware (Movement/DDA.cpp, InitStandardMove) and LinuxCNC in exact path mode, which is assumed to stop
//! at every bend: it is never slower.

use super::legs::{Leg, Task};
use super::track::Track;

/// The limit of speed at the junction of two legs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Corner {
    /// A stop at every bend.
    Stop,
    /// GRBL's junction deviation, mm.
    Deviation(f64),
    /// Klipper's square corner velocity, mm/s.
    Square(f64),
    /// Changes of the speed of the axes, mm/s (M566; Prusa: CLASSIC_JERK).
    Jerk([f64; 3]),
}

/// Settings of such a controller.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweep {
    /// Acceleration: of each axis for RepRapFirmware and LinuxCNC, along the path for Klipper, mm/s^2.
    pub(crate) acceleration: f64,
    /// Acceleration of Z, where each axis has its own, mm/s^2.
    pub(crate) z_acceleration: f64,
    /// Largest speed of each axis, mm/s.
    pub(crate) speed: [f64; 3],
    pub(crate) corner: Corner,
    /// Seconds for a dwell's P word of 1.
    pub(crate) dwell: f64,
}

/// A leg as it is planned; speeds squared.
struct Plan {
    leg: Leg,
    unit: [f64; 3],
    speed: f64,
    acceleration: f64,
    entry: f64,
}

impl Plan {
    /// The highest speed squared after this leg from `entry`, or before it to the same.
    fn reach(&self, entry: f64) -> f64 {
        entry + 2.0 * self.acceleration * self.leg.length()
    }
}

impl Sweep {
    pub(crate) fn run(self, tasks: &[Task], track: &mut Track) {
        let mut queue = Vec::new();
        for task in tasks {
            match task {
                Task::Leg(leg) => {
                    let plan = self.plan(leg, queue.last());
                    queue.push(plan);
                }
                Task::Dwell(time) => {
                    flush(&mut queue, track);
                    track.rest(time * self.dwell);
                }
                Task::Halt => {
                    flush(&mut queue, track);
                    track.halt();
                }
            }
        }
        flush(&mut queue, track);
        track.halt();
    }

    fn plan(&self, leg: &Leg, previous: Option<&Plan>) -> Plan {
        let (way, length) = (leg.way(), leg.length());
        let unit = way.map(|d| d / length);
        let limit_along =
            |most: f64, i: usize| if unit[i] == 0.0 { f64::INFINITY } else { most / unit[i].abs() };
        let limit = (0..3).map(|i| limit_along(self.speed[i], i)).fold(f64::INFINITY, f64::min);
        let speed = leg.feed.map_or(limit, |feed| limit.min(feed / 60.0));
        let acceleration = match self.corner {
            Corner::Square(_) => self.acceleration,
            _ => [self.acceleration, self.acceleration, self.z_acceleration]
                .into_iter()
                .zip(0..)
                .map(|(most, i)| limit_along(most, i))
                .fold(f64::INFINITY, f64::min),
        };
        let mut plan = Plan { leg: *leg, unit, speed, acceleration, entry: 0.0 };
        if let Some(previous) = previous {
            plan.entry = self.corner(previous, &plan).min(speed.min(previous.speed).powi(2));
        }
        plan
    }

    /// The highest speed squared where two legs meet.
    fn corner(&self, previous: &Plan, plan: &Plan) -> f64 {
        match self.corner {
            // Exact path mode may stop "in order to change direction" (linuxcnc.org/docs, G61); an arc's chords exist only in this model.
            Corner::Stop => {
                let cos: f64 = (0..3).map(|i| plan.unit[i] * previous.unit[i]).sum();
                let goes_on = cos > 0.999_999 || plan.leg.line == previous.leg.line;
                if goes_on { f64::INFINITY } else { 0.0 }
            }
            Corner::Jerk(jerk) => {
                let turns = (0..3).map(|i| (jerk[i] / (plan.unit[i] - previous.unit[i]).abs()).powi(2));
                turns.fold(f64::INFINITY, f64::min)
            }
            Corner::Square(_) | Corner::Deviation(_) => {
                // Move.calc_junction.
                let cos = -(0..3).map(|i| plan.unit[i] * previous.unit[i]).sum::<f64>();
                let (sin_half, cos_half) =
                    ((0.5 * (1.0 - cos)).max(0.0).sqrt(), (0.5 * (1.0 + cos)).max(0.0).sqrt());
                if sin_half >= 1.0 || cos_half <= 0.0 {
                    return f64::INFINITY;
                }
                let deviation = match self.corner {
                    Corner::Square(square) => square * square * (2.0_f64.sqrt() - 1.0) / self.acceleration,
                    Corner::Deviation(deviation) => deviation,
                    _ => 0.0,
                };
                let bend = sin_half / (1.0 - sin_half) * deviation * self.acceleration;
                let shorter = plan.leg.length().min(previous.leg.length());
                bend.min(0.5 * shorter * self.acceleration * sin_half / cos_half)
            }
        }
    }
}

/// Every leg from its entry to the next one's, the last to a stop.
fn flush(queue: &mut Vec<Plan>, track: &mut Track) {
    let mut exit = 0.0;
    for plan in queue.iter_mut().rev() {
        plan.entry = plan.entry.min(plan.reach(exit));
        exit = plan.entry;
    }
    let mut limit = 0.0_f64;
    for plan in queue.iter_mut() {
        plan.entry = plan.entry.min(limit);
        limit = plan.reach(plan.entry);
    }
    let exits: Vec<f64> = queue.iter().skip(1).map(|plan| plan.entry).chain([0.0]).collect();
    for (plan, exit) in queue.drain(..).zip(exits) {
        track.begin(&plan.leg);
        let Plan { acceleration: a, entry, speed, .. } = plan;
        let length = plan.leg.length();
        let top = (speed * speed).min(0.5 * (entry + exit) + a * length).max(entry.max(exit));
        let (up, down) = (0.5 * (top - entry) / a, 0.5 * (top - exit) / a);
        let [v0, v1, v2] = [entry, top, exit].map(f64::sqrt);
        for (way, seconds) in [
            (up, (v1 - v0) / a),
            (length - down, (length - up - down).max(0.0) / v1),
            (length, (v1 - v2) / a),
        ] {
            track.moved(way / length, seconds);
        }
    }
}
