//! Jobs that are too large to be intended: in the number of moves, for the memory, or in time, for a day's work.
//!
//! The limits keep a build within some hundred megabytes, and every figure of a program's comments within the shortest
//! line that a profile may have.

use crate::plan::lowest_feed::lowest_along;
use crate::plan::moves::Cuts;
use crate::plan::seal::batches;
use crate::plan::{Pace, Program};
use design::{Design, PlacedPart, Refusal, RefusalCode, SealJob};
use geom::Segment;
use spec::units::Readable;
use spec::{Machine, ProductKind, SealProcess, Spec, key};

/// Most moves in contact of all programs together: 40 times those of three large stars, chopped.
const MOST_MOVES: f64 = 2e6;
/// Longest time of a program, s: eleven and a half days.
const LONGEST_TIME: f64 = 1e6;

/// The reason for which the programs of `design` would have more moves than a job may have; they are counted, not made.
pub fn too_many_moves(spec: &Spec, machine: &Machine, design: &Design) -> Option<Refusal> {
    let total = moves(spec, machine, design);
    if total <= MOST_MOVES {
        return None;
    }
    let fault = format!("the job has {total:.0} moves in contact");
    let (key, pieces) = match spec.product() {
        ProductKind::Stars => (key::stack::COUNT, "stars"),
        ProductKind::Drawing => (key::sheet::COPIES, "pieces"),
    };
    let remedy = format!("at most {MOST_MOVES:.0} are written: build fewer or smaller {pieces} at a time");
    Some(Refusal::new(key, RefusalCode::JobTooLarge, fault, remedy))
}

/// Moves in contact that the programs of `design` have: pieces, or the strokes of each.
fn moves(spec: &Spec, machine: &Machine, design: &Design) -> f64 {
    let of_way = |process: &SealProcess, way: &[(Segment, f64)]| -> f64 {
        let spec = &spec.sealed_by(process);
        let cuts = Cuts::of_seal(spec, machine);
        let pace = Pace::new(spec, machine, lowest_along(&machine.motion, way.iter().copied()));
        let of_segment = |(segment, rise): &(Segment, f64)| {
            let pieces = f64::from(cuts.count(segment));
            let strokes = match pace {
                Pace::Steady => 1.0,
                Pace::Chopped(chop) => chop.strokes(libm::hypot(segment.length() / pieces, rise / pieces)),
            };
            pieces * strokes
        };
        way.iter().map(of_segment).sum()
    };
    let sheets = batches(design, spec.machine.program);
    let of_batch = |placed: &[&PlacedPart]| -> f64 {
        let job = SealJob::new(spec, design, placed, machine.process.ramp.0);
        let processes = job.processes.iter().zip(0..);
        processes.map(|(process, index)| of_way(process, &contacts(machine, &job, index))).sum()
    };
    sheets.iter().map(|(_, placed)| of_batch(placed)).sum()
}

/// The segments in contact of the process at place `process` of `job`, each with the change of height along it.
fn contacts(machine: &Machine, job: &SealJob, process: usize) -> Vec<(Segment, f64)> {
    let contact_height = job.processes[process].seal.contact(&machine.process);
    let rise = machine.process.heights.travel.0 - contact_height.0;
    let mut contacts = Vec::new();
    for seam in job.contacts.iter().filter(|contact| contact.process == process).map(|contact| &contact.laid)
    {
        for (path, rise) in [(&seam.lead_in, rise), (&seam.run, 0.0), (&seam.lead_out, rise)] {
            let flat = path.length();
            let contact = |segment: &Segment| (*segment, rise * segment.length() / flat);
            contacts.extend(path.segments.iter().map(contact));
        }
    }
    contacts
}

/// The reason for which one of `programs` takes longer than a program may.
pub(super) fn too_long(spec: &Spec, programs: &[Program]) -> Option<Refusal> {
    let longest = programs.iter().max_by(|a, b| a.time.total_cmp(&b.time))?;
    if longest.time < LONGEST_TIME {
        return None;
    }
    let fault = format!("a program takes {:.0} h", longest.time / 3600.0);
    let piece = match spec.product() {
        ProductKind::Stars => "star",
        ProductKind::Drawing => "piece",
    };
    let speeds: Option<Vec<f64>> =
        programs.iter().map(|program| fast_enough(spec.seal.speed.0, program)).collect();
    let faster = speeds.map_or_else(String::new, |speeds| {
        let speed = Readable(speeds.into_iter().fold(0.0, f64::max));
        format!(", or a speed of at least {speed} mm/s if a coupon holds it")
    });
    let remedy = format!(
        "it must take less than {:.0} h: one program a {piece}, a smaller {piece}{faster}",
        LONGEST_TIME / 3600.0,
    );
    Some(Refusal::new(key::seal::SPEED, RefusalCode::JobTooLarge, fault, remedy))
}

/// The speed, to three digits, at which a program that was planned at `speed` is short enough; `None` if its travels alone take too
/// long.
fn fast_enough(speed: f64, program: &Program) -> Option<f64> {
    let contact: f64 = program.seams.iter().map(|seam| seam.time).sum();
    let available = LONGEST_TIME - (program.time - contact);
    // What does not depend on the speed, such as the start of each stroke, is within the last digit.
    let speed_needed = 1.001 * speed * contact / available;
    let digit = libm::pow(10.0, libm::log10(speed_needed).floor() - 2.0);
    (available > 0.0).then(|| digit * (speed_needed / digit).ceil())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Pacer, Step, seal_programs};
    use spec::{Source, read, starter};

    /// Strokes of a program as they are made, one by one.
    fn stroke_count(program: &Program, speed: f64) -> u32 {
        let (mut pacer, mut count) = (Pacer::new(program.pace(), speed), 0);
        for step in &program.steps {
            match step {
                Step::TouchDown(ramp) | Step::Lift(ramp) => {
                    for (piece, from, to) in ramp.with_heights() {
                        pacer.strokes(piece, Some((from, to)), |_| count += 1);
                    }
                }
                Step::Seal(pieces) => {
                    for piece in pieces {
                        pacer.strokes(piece, None, |_| count += 1);
                    }
                }
                _ => {}
            }
        }
        count
    }

    #[test]
    fn moves_are_counted_as_they_are_made() {
        let chop = "feed_floor = \"chop\"\n";
        for (name, more, rest) in [
            ("generic", "", ""),
            ("grbl", chop, ""),
            ("marlin", chop, "[accuracy]\npath = \"0.1 mm\"\n"),
            ("fluidnc", "feed_floor = \"chop\"\nprogram = \"sheet\"\n", "[stack]\ncount = 3\n"),
            ("klipper", "", "[stack]\ncount = 2\n[inlet]\nnone = true\n"),
        ] {
            let text = starter("x").expect("a name");
            let star =
                &text[text.find("\n[star]").expect("a star")..text.find("\n[stack]").expect("a stack")];
            let text =
                format!("schema = 1\nname = \"x\"\n{star}\n[machine]\nprofile = {name:?}\n{more}{rest}");
            let spec = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
            let machine = Machine::builtin(name).expect("built in");
            let design = Design::new(&spec, &machine).expect("a design");
            let programs = seal_programs(&spec, &machine, &design);
            let strokes: u32 = programs.iter().map(|program| stroke_count(program, spec.seal.speed.0)).sum();
            assert_eq!(moves(&spec, &machine, &design), f64::from(strokes), "{name}");
        }
    }

    /// The comments of a program on its last seam, at the limits: the longest possible ones.
    #[test]
    fn comments_fit_into_the_shortest_line_of_a_profile() {
        // A star of 200 m, the largest there is, has less than a kilometre of seam.
        let (length, time) = (1e6 - 1e-3, LONGEST_TIME - 1.0);
        let longest = format!("; length: seam=128 star=64 loop=outer length_mm={length:.3} time_s={time}");
        assert!(longest.len() <= 72, "{longest}");
    }
}
