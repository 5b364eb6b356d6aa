//! The structured comments that a program should have, from the design alone.
//!
//! Only what `resume` or the operator relies on is listed: the job, its machine, its strokes, its seams and the iron's temperature.
//! All other comments are proven by the bytes of the whole file.

use crate::verify::judge::stroke::shortest_move;
use crate::verify::judge::task::ProgramTask;
use sealed::LaidSeam;
use spec::{DwellUnit, Heating, StepRate};

/// The beginning of the operator's instruction, who has no other source.
pub(super) const OPERATOR: &str = "set the iron to ";

/// The keys of the comments that are listed.
pub(super) const KEYS: [&str; 12] = [
    "program",
    "seal",
    "machine",
    "heights",
    "path",
    "chop",
    "chop-rest",
    "chop-start",
    "chop-steps",
    "chop-ticks",
    "chop-moves",
    "seam",
];

/// The comments with one of [`KEYS`] or for the operator, in the order of the file. `chopped`: whether the program consists of strokes and dwells.
pub(super) fn expected_comments(task: &ProgramTask<'_>, chopped: bool) -> Vec<String> {
    let purpose = if task.hot { "seal" } else { "trace" };
    let mut comments = vec![format!("program: purpose={purpose} {}", task.scope)];
    if task.hot {
        job(task, &mut comments);
        if chopped {
            strokes(task, &mut comments);
        }
        if task.machine.controller.heating == Heating::Operator {
            let t = task.spec.seal.temperature.0;
            comments.push(format!("{OPERATOR}{t} C, standby off, wait until hot, press start"));
        }
        seams(task, &mut comments);
    }
    comments
}

/// The seal and the machine.
fn job(task: &ProgramTask<'_>, comments: &mut Vec<String>) {
    let ProgramTask { spec, machine, .. } = *task;
    let (seal, controller, process) = (&spec.seal, &machine.controller, &machine.process);
    let (t, v, w, o) = (seal.temperature.0, seal.speed.0, seal.band.0, seal.overlap.0);
    comments.push(format!("seal: temperature_C={t} speed_mm_s={v} band_mm={w} overlap_mm={o}"));
    let heating = match controller.heating {
        Heating::Operator => "operator",
        Heating::Hotend => "hotend",
    };
    let arcs = if controller.arcs { "yes" } else { "no" };
    let (dialect, line) = (controller.dialect.name(), controller.line_length);
    comments.push(format!("machine: dialect={dialect} heating={heating} arcs={arcs} line={line}"));
    let heights = &process.heights;
    let (contact, travel, park) = (heights.contact.0, heights.travel.0, heights.park.0);
    let ramp = process.ramp.0;
    comments.push(format!("heights: contact_mm={contact} travel_mm={travel} park_mm={park} ramp_mm={ramp}"));
    let unit = match controller.dwell.unit {
        DwellUnit::Seconds => "s",
        DwellUnit::Milliseconds => "ms",
    };
    let (path, rapid) = (spec.accuracy.path.0, process.travel_speed.0);
    comments.push(format!("path: tolerance_mm={path} travel_mm_s={rapid} dwell={unit}"));
}

/// The comment on the strokes, and the settings on which their timing relies.
fn strokes(task: &ProgramTask<'_>, comments: &mut Vec<String>) {
    let ProgramTask { spec, machine, .. } = *task;
    let (motion, seal) = (&machine.motion, &spec.seal);
    let (Some(speed), Some(a)) = (motion.chop_speed(seal.speed.0), motion.acceleration.map(|a| a.0)) else {
        return;
    };
    let step = machine.controller.dwell.step.0;
    let delay = motion.start_delay.0;
    let shortest_stroke = (delay + speed / a + step) / (1.0 / seal.speed.0 - 1.0 / speed);
    let shortest = shortest_move(motion);
    let count = if shortest > 0.0 { 15.0 } else { 13.0 };
    let longest = shortest_stroke.max(seal.band.0 / count).max(shortest);
    comments.push(format!("chop: feed_mm_min={} longest_mm={longest}", speed * 60.0));
    comments.push(format!("chop-rest: acceleration_mm_s2={a} step_s={step}"));
    comments.push(format!("chop-start: delay_s={delay}"));
    if let (StepRate::AtLeast(rate), Some([x, y, z]), Some(tick)) =
        (motion.step_rate, motion.steps_per_mm, motion.tick)
    {
        comments.push(format!("chop-steps: x={x} y={y} z={z}"));
        comments.push(format!("chop-ticks: rate_Hz={rate} tick_s={}", tick.0));
        let (first, fewest) = (motion.first_step_rate.unwrap_or(0.0), motion.min_move_steps);
        if first > 0.0 || fewest > 0.0 {
            comments.push(format!("chop-moves: first_Hz={first} least_steps={fewest}"));
        }
    }
}

/// Each seam with its name, its length in contact, mm, and its time with both ramps, s.
fn seams(task: &ProgramTask<'_>, comments: &mut Vec<String>) {
    let ProgramTask { spec, machine, ref seams, .. } = *task;
    let heights = &machine.process.heights;
    let rise = heights.travel.0 - heights.contact.0;
    let words = |(i, seam): (usize, &LaidSeam)| {
        let length = seam.run.length();
        let ramps = libm::hypot(seam.lead_in.length(), rise) + libm::hypot(seam.lead_out.length(), rise);
        let time = (length + ramps) / spec.seal.speed.0;
        format!("seam: seam={i} {} length_mm={length} time_s={time}", seam.name.facts())
    };
    comments.extend((1..).zip(seams).map(words));
}
