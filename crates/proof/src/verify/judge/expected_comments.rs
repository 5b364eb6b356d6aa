//! The structured comments that a program should have, from the design alone.
//!
//! Only what `resume` or the operator relies on is listed: the job, its machine, its strokes, its seams and the iron's temperature.
//! All other comments are proven by the bytes of the whole file.

use crate::verify::judge::stroke::{least_time, shortest_move};
use crate::verify::judge::task::{ProgramTask, ProgramWork};
use geom::Isometry;
use sealed::LaidSeam;
use spec::{CutTool, DwellUnit, Seal, SealProcess, StepRate, ZLimits};

/// The beginning of the operator's instruction, who has no other source.
pub(super) const OPERATOR: &str = "set the iron to ";

/// The keys of the comments that are listed.
pub(super) const KEYS: [&str; 27] = [
    "program",
    "seal",
    "machine",
    "heights",
    "path",
    "place",
    "chop",
    "chop-rest",
    "chop-start",
    "chop-steps",
    "chop-ticks",
    "chop-moves",
    "chop-ramps",
    "z-limits",
    "laser-ramps",
    "process",
    "sealing",
    "seam",
    "pause",
    "cool",
    "cutting",
    "tool",
    "cut",
    "mark",
    "aligned",
    "laser",
    "beam",
];

/// The comments with one of [`KEYS`] or for the operator, in the order of the file. `chopped`: whether each process of the job consists of
/// strokes and dwells.
pub(super) fn expected_comments(task: &ProgramTask<'_>, chopped: &[bool]) -> Vec<String> {
    let purpose = match task.work {
        ProgramWork::Seal => "seal",
        ProgramWork::Trace => "trace",
        ProgramWork::Cut(_) => "cut",
    };
    let mut comments = vec![format!("program: purpose={purpose} {}", task.scope)];
    comments.extend(task.motion.map(|Isometry { rotation, shift, .. }| {
        format!("aligned: turn_deg={} x_mm={} y_mm={}", rotation.to_degrees(), shift.x, shift.y)
    }));
    if let ProgramWork::Cut(tool) = task.work {
        cutting(task, tool, &mut comments);
    }
    if task.work == ProgramWork::Seal {
        seal(&task.spec.seal, &mut comments);
        machine(task, &mut comments);
        let mut processes = task.job.processes.iter().zip(chopped);
        if let Some((process, _)) = processes.find(|(_, is_chopped)| **is_chopped) {
            strokes(task, &process.seal, &mut comments);
        }
        if !task.job.is_plain() {
            processes_and_contacts(task, chopped, &mut comments);
        }
        comments.extend(marks(task));
        if task.arms_laser() {
            comments.push("beam: armed_by=operator".to_owned());
        }
        contacts(task, &mut comments);
    }
    if task.work == ProgramWork::Trace {
        comments.extend(marks(task));
    }
    comments
}

/// Each stop above a mark.
fn marks<'t>(task: &'t ProgramTask<'_>) -> impl Iterator<Item = String> + 't {
    let marks = task.marks.iter().zip(1..);
    marks.map(|(mark, number)| format!("mark: number={number} x_mm={} y_mm={}", mark.x, mark.y))
}

/// Every process, a fact a comment, and the process of every contact.
fn processes_and_contacts(task: &ProgramTask<'_>, chopped: &[bool], comments: &mut Vec<String>) {
    let ProgramTask { machine, ref job, .. } = *task;
    for (SealProcess { name, seal, .. }, is_chopped) in job.processes.iter().zip(chopped) {
        let (height, cool) = (seal.contact(&machine.process).0, seal.cool.0);
        let mut facts = vec![
            heat(seal),
            format!("speed_mm_s={}", seal.speed.0),
            format!("contact_mm={height}"),
            format!("cool_s={cool}"),
        ];
        if let Some((speed, longest)) = stroke_limits(task, seal).filter(|_| *is_chopped) {
            facts.extend([format!("feed_mm_min={}", speed * 60.0), format!("longest_mm={longest}")]);
        }
        comments.extend(facts.iter().map(|fact| format!("process: process={name} {fact}")));
    }
    comments.extend(job.contacts.iter().zip(1..).map(|(contact, i)| {
        let (process, line, pass) = (&job.process(contact).name, contact.line, contact.pass);
        format!("sealing: seam={i} process={process} line={line} pass={pass}")
    }));
}

/// The tool of a cut with its settings, the machine, and every cut.
fn cutting(task: &ProgramTask<'_>, tool: CutTool, comments: &mut Vec<String>) {
    let seal = &task.spec.seal;
    let (v, z) = (seal.speed.0, seal.contact(&task.machine.process).0);
    let word = tool.word();
    let tool = match tool {
        CutTool::HotTip { temperature } => format!("tool={word} temperature_C={}", temperature.0),
        CutTool::DragKnife { blade_offset } => format!("tool={word} blade_offset_mm={}", blade_offset.0),
        CutTool::Laser { power } => format!("tool={word} power_percent={}", power.0),
    };
    comments.extend([format!("cutting: speed_mm_s={v} height_mm={z}"), format!("cutting: {tool}")]);
    machine(task, comments);
    comments.push(format!("tool: {tool}"));
    contacts(task, comments);
}

/// The seal.
fn seal(seal: &Seal, comments: &mut Vec<String>) {
    let (heat, v, w, o) = (heat(seal), seal.speed.0, seal.band.0, seal.overlap.0);
    comments.push(format!("seal: {heat} speed_mm_s={v} band_mm={w} overlap_mm={o}"));
}

/// The temperature of an iron, or the power of a laser.
fn heat(seal: &Seal) -> String {
    let temperature = || format!("temperature_C={}", seal.temperature.0);
    seal.power.map_or_else(temperature, |power| format!("power_percent={}", power.0))
}

/// The machine.
///
/// Words of one comment are always there. A comment that only some machines need comes after them: a laser, the place of the sheet, the
/// limits of Z.
fn machine(task: &ProgramTask<'_>, comments: &mut Vec<String>) {
    let ProgramTask { spec, machine, .. } = *task;
    let (controller, process) = (&machine.controller, &machine.process);
    let heating = controller.heating_name().replace(' ', "-");
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
    if let Some(laser) = controller.laser {
        let focus = spec.seal.contact(process).0;
        comments.push(format!("laser: full_power_S={} focus_mm={focus}", laser.full_power));
    }
    if let [x, y, z] = controller.place.shift()
        && !controller.place.is_origin()
    {
        comments.push(format!("place: x_mm={x} y_mm={y} surface_mm={z}"));
    }
    let limits = machine.motion.z;
    if limits != ZLimits::default() {
        let speed = limits.speed.map(|speed| format!(" speed_mm_s={}", speed.0)).unwrap_or_default();
        let acceleration =
            limits.acceleration.map(|a| format!(" acceleration_mm_s2={}", a.0)).unwrap_or_default();
        comments.push(format!("z-limits:{speed}{acceleration}"));
    }
    if let (Some(_), Some(acceleration)) = (controller.laser, machine.motion.acceleration) {
        comments.push(format!("laser-ramps: acceleration_mm_s2={}", acceleration.0));
    }
}

/// Speed, mm/s, and largest length, mm, of the strokes of `seal`; `None` where too little is known of the machine.
fn stroke_limits(task: &ProgramTask<'_>, seal: &Seal) -> Option<(f64, f64)> {
    let motion = &task.machine.motion;
    let (speed, a) = (motion.chop_speed(seal.speed.0)?, motion.acceleration?.0);
    let (step, delay) = (task.machine.controller.dwell.step.0, motion.start_delay.0);
    let shortest_stroke = (delay + speed / a + step) / (1.0 / seal.speed.0 - 1.0 / speed);
    let shortest = shortest_move(motion);
    let count = if shortest > 0.0 { 15.0 } else { 13.0 };
    let timed = seal.speed.0 * least_time(motion, seal, speed);
    Some((speed, shortest_stroke.max(seal.band.0 / count).max(shortest).max(timed)))
}

/// The comment on the strokes of `seal`, and the settings on which their timing relies.
fn strokes(task: &ProgramTask<'_>, seal: &Seal, comments: &mut Vec<String>) {
    let motion = &task.machine.motion;
    let (Some((speed, longest)), Some(a)) = (stroke_limits(task, seal), motion.acceleration.map(|a| a.0))
    else {
        return;
    };
    let step = task.machine.controller.dwell.step.0;
    let delay = motion.start_delay.0;
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
        if motion.s_curve {
            comments.push("chop-ramps: s_curve=yes".to_owned());
        }
    }
}

/// Each contact with the name of its seam, its length, mm, and its time with both ramps, s; before it the stop of the iron, and after it
/// the wait for it to cool.
fn contacts(task: &ProgramTask<'_>, comments: &mut Vec<String>) {
    let ProgramTask { machine, ref job, .. } = *task;
    let by_operator = !machine.controller.heating.is_by_program();
    for (contact, index) in job.contacts.iter().zip(0..) {
        let (i, stop, seal) = (index + 1, job.stop_before(index), &job.process(contact).seal);
        if stop.pauses {
            comments.push(format!("pause: before={i}"));
        }
        if let Some(heat) = stop.heat.filter(|_| by_operator) {
            comments.push(format!("{OPERATOR}{} C, standby off, wait until hot, press start", heat.0));
        }
        let LaidSeam { name, lead_in, run, lead_out, .. } = &contact.laid;
        let rise = machine.process.heights.travel.0 - seal.contact(&machine.process).0;
        let ramps = libm::hypot(lead_in.length(), rise) + libm::hypot(lead_out.length(), rise);
        let (length, time) = (run.length(), (run.length() + ramps) / seal.speed.0);
        let title = match task.work {
            ProgramWork::Seal | ProgramWork::Trace => format!("seam: seam={i} {}", name.facts()),
            ProgramWork::Cut(_) => format!("cut: cut={i} edge={}", name.piece.word()),
        };
        comments.push(format!("{title} length_mm={length} time_s={time}"));
        if let Some(cool) = job.cool_after(index) {
            comments.push(format!("cool: time_s={}", cool.0));
        }
    }
}
