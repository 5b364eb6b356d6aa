//! The header: the data that a person or program needs who has the file alone.

use crate::gcode::writer::{Facts, Writer};
use crate::number::number;
use crate::plan::{
    LASER_SAFETY, Pace, PacedProcess, PauseReason, Program, Purpose, SeamReport, Step, Stepper,
    homing_by_hand, laser_settings,
};
use sealed::scope;
use spec::{CutTool, DwellUnit, Machine, Seal, ZLimits};

/// Writes the header of `program`.
pub(super) fn header(writer: &mut Writer<'_>, machine: &Machine, program: &Program) {
    let purpose = match program.purpose {
        Purpose::Seal => "seal",
        Purpose::Trace => "trace",
        Purpose::Cut => "cut",
    };
    writer.comment(&format!("stargrip-cam {purpose} program"));
    writer.comment(&format!("name: {}", writer.facts.name));
    if let Some(maker) = writer.spelling.maker {
        writer.comment(maker);
    }
    writer.comment(&format!("program: purpose={purpose} {}", sheet_and_pieces(program)));
    writer.comment(match writer.facts.controller {
        controller if !controller.place.is_origin() => {
            "frame: coordinates of the machine after homing, the sheet lies at place"
        }
        controller if controller.laser.is_some() => {
            "frame: origin at lower left of the sheet, Z0 on the upper sheet"
        }
        _ => "frame: origin at lower left of the sheet, Z0 on the release layer",
    });
    if let Some(motion) = program.motion {
        let (turn, x, y) =
            (number(motion.rotation.to_degrees()), number(motion.shift.x), number(motion.shift.y));
        writer.facts(&format!("aligned: turn_deg={turn} x_mm={x} y_mm={y}"));
    }
    match program.purpose {
        Purpose::Seal => {
            seal_facts(writer);
            machine_facts(writer);
            conditions(writer, machine, program);
            if !program.is_plain() {
                processes(writer, machine, program);
            }
        }
        Purpose::Cut => {
            cut_facts(writer, program);
            machine_facts(writer);
            conditions(writer, machine, program);
        }
        Purpose::Trace => {}
    }
    for (seam, i) in program.seams.iter().zip(1..) {
        writer.comment(&contact_facts(program.purpose, "length", i, seam));
        if !program.is_plain() {
            let process = &program.processes[seam.process].process.name;
            let (line, pass) = (seam.line, seam.pass);
            writer.comment(&format!("sealing: seam={i} process={process} line={line} pass={pass}"));
        }
    }
    if program.purpose == Purpose::Trace {
        // Corners, which a slow machine brakes for, come on top.
        writer.comment(&format!("total: time_s={:.0}", program.time));
    } else {
        let length: f64 = program.seams.iter().map(|seam| seam.length).sum();
        writer.comment(&format!("total: length_mm={length:.3} time_s={:.0}", program.time));
    }
}

/// The seal, which a new program for the rest of the job needs.
fn seal_facts(writer: &mut Writer<'_>) {
    let seal = writer.facts.seal;
    let (heat, v) = (heat_fact(seal), number(seal.speed.0));
    let (w, o) = (number(seal.band.0), number(seal.overlap.0));
    writer.facts(&format!("seal: {heat} speed_mm_s={v} band_mm={w} overlap_mm={o}"));
}

/// The temperature or the power of a seal as a word of a structured comment.
fn heat_fact(seal: &Seal) -> String {
    match seal.power {
        Some(power) => format!("power_percent={}", number(power.0)),
        None => format!("temperature_C={}", number(seal.temperature.0)),
    }
}

/// The tool of a program that cuts, and its settings.
fn cut_facts(writer: &mut Writer<'_>, program: &Program) {
    let Facts { seal, process, .. } = writer.facts;
    let (v, z) = (number(seal.speed.0), number(seal.contact(process).0));
    writer.facts(&format!("cutting: speed_mm_s={v} height_mm={z}"));
    let tool = program.steps.iter().find_map(|step| match step {
        Step::Pause(PauseReason::Tool(tool)) => Some(*tool),
        _ => None,
    });
    if let Some(tool) = tool {
        writer.facts(&format!("cutting: {}", tool_facts(tool)));
    }
}

/// A tool as words of a structured comment: "tool=drag-knife blade_offset_mm=0.25".
pub(super) fn tool_facts(tool: CutTool) -> String {
    let word = tool.word();
    match tool {
        CutTool::HotTip { temperature } => format!("tool={word} temperature_C={}", number(temperature.0)),
        CutTool::DragKnife { blade_offset } => {
            format!("tool={word} blade_offset_mm={}", number(blade_offset.0))
        }
        CutTool::Laser { power } => format!("tool={word} power_percent={}", number(power.0)),
    }
}

/// The machine, which a new program for the rest of the job needs.
fn machine_facts(writer: &mut Writer<'_>) {
    let Facts { controller, process, path, .. } = writer.facts;
    let heating = controller.heating_name().replace(' ', "-");
    let (dialect, line) = (controller.dialect.name(), controller.line_length);
    let arcs = if controller.arcs { "yes" } else { "no" };
    writer.facts(&format!("machine: dialect={dialect} heating={heating} arcs={arcs} line={line}"));
    let heights = &process.heights;
    let (contact, travel) = (number(heights.contact.0), number(heights.travel.0));
    let (park, ramp) = (number(heights.park.0), number(process.ramp.0));
    writer.facts(&format!("heights: contact_mm={contact} travel_mm={travel} park_mm={park} ramp_mm={ramp}"));
    let (path, rapid) = (number(path.0), number(process.travel_speed.0));
    let unit = match controller.dwell.unit {
        DwellUnit::Seconds => "s",
        DwellUnit::Milliseconds => "ms",
    };
    writer.facts(&format!("path: tolerance_mm={path} travel_mm_s={rapid} dwell={unit}"));
    if let Some(laser) = controller.laser {
        let (full, focus) = (number(laser.full_power), number(writer.facts.seal.contact(process).0));
        writer.facts(&format!("laser: full_power_S={full} focus_mm={focus}"));
    }
    if !controller.place.is_origin() {
        let [x, y, z] = controller.place.shift().map(number);
        writer.facts(&format!("place: x_mm={x} y_mm={y} surface_mm={z}"));
    }
}

/// The limits of Z, where they are lower than those of X and Y, and the acceleration with which a laser brakes at bends.
fn limits(writer: &mut Writer<'_>, machine: &Machine) {
    let limits = machine.motion.z;
    let speed = limits.speed.map(|speed| format!(" speed_mm_s={}", number(speed.0)));
    let acceleration = limits.acceleration.map(|a| format!(" acceleration_mm_s2={}", number(a.0)));
    if limits != ZLimits::default() {
        writer.facts(
            &["z-limits:".to_owned(), speed.unwrap_or_default(), acceleration.unwrap_or_default()].concat(),
        );
    }
    if let Some(acceleration) = machine.motion.acceleration.filter(|_| machine.controller.laser.is_some()) {
        writer.facts(&format!("laser-ramps: acceleration_mm_s2={}", number(acceleration.0)));
    }
}

/// The processes of the program, a fact a line: the name of one is as long as a line may be short.
fn processes(writer: &mut Writer<'_>, machine: &Machine, program: &Program) {
    for PacedProcess { process, pace, .. } in &program.processes {
        let seal = &process.seal;
        writer.comment(&format!("process: process={} {}", process.name, heat_fact(seal)));
        let mut facts = vec![
            ("speed_mm_s", seal.speed.0),
            ("contact_mm", seal.contact(&machine.process).0),
            ("cool_s", seal.cool.0),
        ];
        if let Pace::Chopped(chop) = pace {
            facts.extend([("feed_mm_min", chop.speed * 60.0), ("longest_mm", chop.longest)]);
        }
        for (word, value) in facts {
            writer.comment(&format!("process: process={} {word}={}", process.name, number(value)));
        }
    }
}

/// The tasks of the operator, and the settings on which a chopped program relies.
fn conditions(writer: &mut Writer<'_>, machine: &Machine, program: &Program) {
    // Limits come first. A chopped program states its strokes and all that their timing depends on, then what it requires of the
    // machine. Lines of the profile are last.
    limits(writer, machine);
    let chopped = program.processes.iter().find_map(|paced| match paced.pace {
        Pace::Chopped(chop) => Some(chop),
        Pace::Steady => None,
    });
    if let Some(chop) = chopped {
        let (feed, a) = (number(chop.speed * 60.0), number(chop.acceleration));
        let (longest, step) = (number(chop.longest), number(chop.step));
        writer.facts(&format!("chop: feed_mm_min={feed} longest_mm={longest}"));
        let delay = number(chop.start_delay);
        writer.facts(&format!("chop-rest: acceleration_mm_s2={a} step_s={step}"));
        writer.facts(&format!("chop-start: delay_s={delay}"));
        if let Some(stepper @ Stepper { steps_per_mm, rate, tick, .. }) = chop.stepper {
            let ([x, y, z], rate, tick) = (steps_per_mm.map(number), number(rate), number(tick));
            writer.facts(&format!("chop-steps: x={x} y={y} z={z}"));
            writer.facts(&format!("chop-ticks: rate_Hz={rate} tick_s={tick}"));
            if stepper.first_rate.is_some() || stepper.least_steps > 0.0 {
                let (first, steps) = (number(stepper.first_rate.unwrap_or(0.0)), number(stepper.least_steps));
                writer.facts(&format!("chop-moves: first_Hz={first} least_steps={steps}"));
            }
            if stepper.s_curve {
                writer.facts("chop-ramps: s_curve=yes");
            }
        }
        let axes =
            if chop.stepper.is_some_and(|stepper| stepper.tick > 0.0) { "X, Y and Z" } else { "X and Y" };
        writer.requirement(&format!("requires: an acceleration of {a} mm/s2 in {axes}"));
        if let Some([x, y, _]) = machine.motion.steps_per_mm {
            writer.requirement(&format!("requires: at least {x} and {y} steps/mm in X and Y"));
        }
    }
    laser_conditions(writer, machine);
    if let Some(line) = homing_by_hand(machine) {
        writer.requirement(&format!("requires: {line}"));
    }
    for line in &machine.script.requires {
        writer.requirement(&format!("requires: {line}"));
    }
}

/// The settings on which a program for a laser relies, and what protects the people around it.
fn laser_conditions(writer: &mut Writer<'_>, machine: &Machine) {
    let Some(laser) = machine.controller.laser else { return };
    for line in laser_settings(&machine.controller, laser) {
        writer.requirement(&format!("requires: {line}"));
    }
    for line in LASER_SAFETY {
        writer.comment(&format!("safety: {line}"));
    }
}

/// The scope of the program: "sheet=1 stars=1-3", "piece=disc".
fn sheet_and_pieces(program: &Program) -> String {
    let pieces = scope(&program.pieces);
    let is_numbered = program.pieces.iter().any(|piece| piece.number().is_some());
    if is_numbered { format!("sheet={} {pieces}", program.sheet) } else { pieces }
}

/// The structured comment about one contact of a program.
pub(super) fn contact_facts(purpose: Purpose, key: &str, index: usize, contact: &SeamReport) -> String {
    let SeamReport { name, length, time, .. } = contact;
    let (word, name) = match purpose {
        Purpose::Seal | Purpose::Trace => ("seam", name.facts()),
        Purpose::Cut => ("cut", format!("edge={}", name.piece.word())),
    };
    format!("{key}: {word}={index} {name} length_mm={length:.3} time_s={time:.0}")
}
