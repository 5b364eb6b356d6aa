//! The lowest feed that a controller holds, and the refusals where the seal is slower.

use std::f64::consts::FRAC_PI_2;

use crate::plan::process_refusal::of_process;
use crate::plan::program::{ProcessSteps, distinct_processes};
use crate::plan::whole_rates::rounded_up;
use crate::plan::{Chop, Pace, Program, Step};
use design::{Refusal, RefusalCode};
use geom::Segment;
use spec::units::{Least, Most, Speed};
use spec::{FeedFloor, Machine, Motion, ProductKind, Spec, StepRate, key};

/// The lowest speed that `motion` holds all along `piece`, which climbs by `rise`: that of its worst direction.
///
/// `None` if it is unknown. On an arc the worst direction is at an end, or where X and Y step equally often.
pub fn lowest_speed(motion: &Motion, piece: &Segment, rise: f64) -> Option<f64> {
    lowest_on(motion, piece, rise, Motion::lowest_speed)
}

/// The lowest speed along `piece`, which climbs by `rise`, where `lowest` is that of a straight move with these displacements.
fn lowest_on(
    motion: &Motion,
    piece: &Segment,
    rise: f64,
    lowest: impl Fn(&Motion, [f64; 3]) -> Option<f64>,
) -> Option<f64> {
    let length = piece.length();
    let lowest_at = |t: f64| {
        let u = piece.tangent(t);
        lowest(motion, [u.x * length, u.y * length, rise])
    };
    let mut worst = lowest_at(0.0)?.max(lowest_at(1.0)?);
    if let Segment::Arc(arc) = piece {
        let [x, y, _] = motion.steps_per_mm.unwrap_or([1.0; 3]);
        let even = libm::atan2(x, y);
        let quarter = FRAC_PI_2 * arc.sweep.signum();
        for direction in [even, -even, 2.0 * FRAC_PI_2 - even, even - 2.0 * FRAC_PI_2] {
            if let Some(t) = arc.fraction_of(direction - quarter, 0.0) {
                worst = worst.max(lowest_at(t)?);
            }
        }
    }
    Some(worst)
}

/// A refusal for each process whose speed the controller does not hold.
pub(super) fn feed_floor(spec: &Spec, machine: &Machine, programs: &[Program]) -> Vec<Refusal> {
    let parts: Vec<ProcessSteps<'_>> = programs.iter().flat_map(Program::by_process).collect();
    let mut refusals = Vec::new();
    for process in distinct_processes(programs) {
        let steps: Vec<&ProcessSteps<'_>> =
            parts.iter().filter(|part| part.paced.process.name == process.name).collect();
        let refusal = feed_floor_of(&spec.sealed_by(process), machine, &steps);
        refusals.extend(refusal.map(|refusal| of_process(spec, process, refusal)));
    }
    refusals
}

/// The refusal where the controller does not hold the speed of `spec` in the steps of one process.
fn feed_floor_of(spec: &Spec, machine: &Machine, parts: &[&ProcessSteps<'_>]) -> Option<Refusal> {
    // The lowest speed that the machine holds in every program decides. Where a program is chopped, its strokes must be
    // possible instead. The remedy depends on what is too fast: only the ramps, or the seams, too.
    let speed = spec.seal.speed.0;
    let chops = spec.machine.feed_floor == FeedFloor::Chop;
    let (mut floor, mut flatness) = (0.0_f64, 0.0_f64);
    for part in parts {
        flatness = flatness.max(ramp_flatness(&part.steps));
        if let Pace::Chopped(chop) = part.paced.pace {
            let refusal = too_fast_to_chop(spec, machine, &chop).or_else(|| slow_chop_feed(machine, part));
            let refusal = refusal.or_else(|| long_rest(spec, machine, &chop, part.paced.overdue));
            if refusal.is_some() {
                return refusal;
            }
            continue;
        }
        let Some(lowest) = lowest_of(&machine.motion, part.steps.iter().copied()) else {
            return chops.then(|| cannot_chop(machine, speed));
        };
        floor = floor.max(lowest);
    }
    if floor <= speed * (1.0 + 1e-9) {
        return None;
    }
    if chops {
        return Some(cannot_chop(machine, speed));
    }
    let (slowest, flat) = machine.motion.speed_range().unwrap_or((floor, floor));
    if flat <= speed * (1.0 + 1e-9) {
        return Some(slow_ramps(speed, machine, floor, flatness));
    }
    let fastest = floor.max(flat);
    let steps = match machine.motion.steps_per_mm {
        Some([x, y, _]) if x == y => format!("at {x} steps/mm "),
        Some([x, y, _]) => format!("at {x} (X) and {y} (Y) steps/mm "),
        None => String::new(),
    };
    Some(Refusal::new(
        key::seal::SPEED,
        RefusalCode::FeedFloor,
        format!(
            "{steps}{} runs this {}",
            machine.controller.dialect.title(),
            actual_speed(&machine.motion, speed, (slowest, fastest))
        ),
        format!(
            "{}a speed of at least {:.2} mm/s{}",
            // The strokes and dwells of an iron would burn holes.
            if spec.seal.power.is_some() {
                "write "
            } else {
                "write `feed_floor = \"chop\"` in [machine]; or "
            },
            (fastest * (1.0 - 1e-9) * 100.0).ceil() / 100.0,
            finer_steps(&machine.motion, speed, flatness)
        ),
    ))
}

/// The actual speed of a controller for the programmed `speed`, mm/s, which it does not hold, in words; `range` holds its lowest speeds
/// over all directions.
pub fn actual_speed(motion: &Motion, speed: f64, range: (f64, f64)) -> String {
    if let Some(part) = rounded_up(motion, speed) {
        let percent = (1000.0 * part - 1e-9).ceil() / 10.0;
        return format!("up to {percent:.1} % too fast, for it rounds up to whole steps a second");
    }
    // No controller runs below the programmed speed.
    let (slowest, fastest) = (range.0.max(speed), range.1);
    let runs = if fastest - slowest < 0.005 {
        format!("{fastest:.2}")
    } else {
        format!("{slowest:.2} to {fastest:.2}")
    };
    format!("at {runs} mm/s instead of {speed}")
}

/// The steps per mm of all axes that hold `speed`, mm/s, on ramps as flat as that, too, as another remedy; empty where they are unknown.
fn finer_steps(motion: &Motion, speed: f64, flatness: f64) -> String {
    let Some((_, diagonal)) = motion.steps_needed(speed) else { return String::new() };
    let [_, _, z] = motion.steps_per_mm.unwrap_or_default();
    let climbing = z_steps_needed(motion, speed, flatness).filter(|needed| z < *needed);
    let ramps = climbing.map_or(String::new(), |z| format!(" and `z_steps_per_mm` of at least {z:.0}"));
    format!(
        "; or `x_steps_per_mm` and `y_steps_per_mm` of at least {:.0}{ramps} in the profile, if the machine has them",
        diagonal.ceil()
    )
}

/// Steps per mm of Z that hold `speed`, mm/s, on ramps as flat as that, whatever X and Y have.
fn z_steps_needed(motion: &Motion, speed: f64, flatness: f64) -> Option<f64> {
    motion.steps_needed(speed).map(|(along, _)| (along * flatness).ceil())
}

/// The way along the flattest ramp of `steps`, by its rise; 0 without ramps.
fn ramp_flatness(steps: &[&Step]) -> f64 {
    let climbs = contact(steps.iter().copied()).filter(|(_, rise)| *rise != 0.0);
    climbs.map(|(piece, rise)| libm::hypot(piece.length(), rise) / rise.abs()).fold(0.0, f64::max)
}

/// Only the ramps are too slow for the controller, which are steeper than Z has steps for.
fn slow_ramps(speed: f64, machine: &Machine, lowest: f64, flatness: f64) -> Refusal {
    let motion = &machine.motion;
    let [_, _, z] = motion.steps_per_mm.unwrap_or_default();
    Refusal::new(
        key::seal::SPEED,
        RefusalCode::FeedFloor,
        format!(
            "at {z} steps/mm of Z {} runs the ramps at {lowest:.2} mm/s instead of {speed}",
            machine.controller.dialect.title()
        ),
        format!(
            "write `feed_floor = \"chop\"` in [machine]; or `z_steps_per_mm` of at least {:.0} in the profile, if the \
             machine has them; or a speed of at least {:.2} mm/s",
            z_steps_needed(motion, speed, flatness).unwrap_or(z),
            (lowest * (1.0 - 1e-9) * 100.0).ceil() / 100.0
        ),
    )
}

/// The refusal where there is no time for dwells: in strokes of half a band at most, each needs one, of a step or two.
fn too_fast_to_chop(spec: &Spec, machine: &Machine, chop: &Chop) -> Option<Refusal> {
    let (speed, stroke) = (spec.seal.speed, spec.seal.band.0 / 2.0);
    if 2.0 * chop.least > stroke {
        let fault = format!("the controller makes no move below {:.3} mm in every direction", chop.least);
        let remedy =
            format!("band must be at least {:.2} mm, or the profile have finer steps", 4.0 * chop.least);
        return Some(Refusal::new(key::seal::BAND, RefusalCode::NoChop, fault, remedy));
    }
    if chop.longest <= stroke && chop.rest >= 2.0 * chop.step {
        return None;
    }
    let seconds = stroke / chop.speed + chop.cost();
    let limit = (stroke / seconds).min(spec.seal.band.0 / 10.0 / (2.0 * chop.step));
    let fault = format!(
        "a stroke of {stroke:.3} mm at {:.3} mm/s takes {seconds:.3} s with the shortest dwell, too long for {speed}",
        chop.speed
    );
    let mut slower = spec.clone();
    slower.seal.speed = Speed(limit);
    let (key, remedy) = if Chop::new(&slower, machine).is_some_and(|chop| chop.rests(limit)) {
        (key::seal::SPEED, format!("speed must be below {} mm/s", Most(limit)))
    } else {
        (
            key::machine::PROFILE,
            format!("strokes must be slower: {} in the profile", slower_strokes(machine, chop)),
        )
    };
    Some(Refusal::new(key, RefusalCode::NoChop, fault, remedy))
}

/// The change of a profile that lets the controller travel strokes more slowly than those of `chop`.
fn slower_strokes(machine: &Machine, chop: &Chop) -> &'static str {
    let motion = &machine.motion;
    let unlimited = Motion { min_feed: Speed(0.0), ..*motion };
    if motion.chop_feed.is_some() {
        "a lower `chop_feed`"
    } else if unlimited.chop_speed(0.0).is_some_and(|speed| speed < chop.speed / 2.0) {
        "a lower `min_feed`"
    } else {
        "more steps per mm"
    }
}

/// The refusal of a rest that is too long in one place: around a corner, where the controller joins moves of few steps or makes three
/// of them without a wait, or after every stroke, where strokes are long because the axes speed up slowly.
fn long_rest(spec: &Spec, machine: &Machine, chop: &Chop, overdue: f64) -> Option<Refusal> {
    if overdue <= 0.0 {
        return None;
    }
    let rest = chop.rest;
    let (key, fault, remedy) = if chop.least > 0.0 {
        let (key, rounder) = match spec.product() {
            ProductKind::Stars => (key::star::CORNER_RADIUS, "make the arms longer, round tips and corners"),
            ProductKind::Drawing => (key::drawing::FILE, "round the drawn corners"),
        };
        (
            key,
            format!(
                "beside a sharp corner the controller joins moves below {:.3} mm, and on a tight arc three moves begin without a \
                 wait: the iron would rest for {:.2} s in one place; up to {rest:.2} s leave no scar",
                chop.least,
                rest + overdue
            ),
            format!("{rounder}, seal more slowly, or use a machine with more steps per mm"),
        )
    } else {
        (
            key::seal::SPEED,
            format!(
                "after strokes of {:.3} mm the iron would rest for more than {rest:.2} s in one place",
                chop.longest
            ),
            format!(
                "choose another speed, or a higher acceleration or {} in the profile if the machine has it",
                slower_strokes(machine, chop)
            ),
        )
    };
    Some(Refusal::new(key, RefusalCode::NoChop, fault, remedy))
}

/// The profile's own `chop_feed` is one that the controller runs faster, on the ramps or in the plane.
fn slow_chop_feed(machine: &Machine, part: &ProcessSteps<'_>) -> Option<Refusal> {
    let (motion, feed) = (&machine.motion, machine.motion.chop_feed?.0);
    let lowest = contact(part.steps.iter().copied()).try_fold(0.0_f64, |most, (piece, rise)| {
        Some(most.max(lowest_on(motion, piece, rise, Motion::lowest_stroke)?))
    })?;
    if feed >= lowest * (1.0 - 1e-9) {
        return None;
    }
    Some(Refusal::new(
        key::machine::PROFILE,
        RefusalCode::NoChop,
        format!(
            "`chop_feed` of the profile is {feed:.3} mm/s, and the controller runs it at up to {lowest:.3} mm/s"
        ),
        format!(
            "`chop_feed` must be at least {} mm/s; without the key the program chooses a suitable one",
            Least(lowest)
        ),
    ))
}

fn cannot_chop(machine: &Machine, speed: f64) -> Refusal {
    let motion = &machine.motion;
    let mut missing = Vec::new();
    if motion.chop_speed(speed).is_none() {
        if motion.steps_per_mm.is_none() {
            missing.push("steps per mm");
        }
        if motion.step_rate == StepRate::Unknown {
            missing.push("lowest step rate");
        }
    }
    if motion.acceleration.is_none() {
        missing.push("acceleration");
    }
    Refusal::new(
        key::machine::FEED_FLOOR,
        RefusalCode::NoChop,
        format!("the profile {} has no {}", machine.name, missing.join(" and no ")),
        "write what is missing, or `chop_feed` and `acceleration`, in [motion] of your own profile"
            .to_owned(),
    )
}

/// The lowest speed, mm/s, that `motion` holds in every contact of `steps`; `None` if it is unknown.
pub(super) fn lowest_of<'a>(motion: &Motion, steps: impl IntoIterator<Item = &'a Step>) -> Option<f64> {
    lowest_along(motion, contact(steps).map(|(piece, rise)| (*piece, rise)))
}

/// The lowest speed, mm/s, that `motion` holds along `way`, pieces with the change of height along each; `None` if it is unknown.
pub(super) fn lowest_along(motion: &Motion, mut way: impl Iterator<Item = (Segment, f64)>) -> Option<f64> {
    way.try_fold(0.0_f64, |most, (piece, rise)| Some(most.max(lowest_speed(motion, &piece, rise)?)))
}

/// The pieces travelled below travel height, each with the change of height along it.
pub(super) fn contact<'a>(
    steps: impl IntoIterator<Item = &'a Step>,
) -> impl Iterator<Item = (&'a Segment, f64)> {
    steps.into_iter().filter(|step| step.is_contact()).flat_map(|step| {
        let (pieces, rise) = (step.pieces(), step.ramp().map_or(0.0, |ramp| ramp.to - ramp.from));
        let flat: f64 = pieces.iter().map(Segment::length).sum();
        pieces.iter().map(move |piece| (piece, rise * piece.length() / flat))
    })
}
