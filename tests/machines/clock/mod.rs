//! A second clock: it reads the text of the programs and applies the rules of each firmware, as its source states them. It shares no code
//! with the plan, whose pacing it checks, nor with `verify`.
//!
//! GRBL on an AVR, grblHAL on an ESP32, FluidNC, Marlin on both kinds of boards, Klipper, RepRapFirmware, LinuxCNC; `generic`, and by
//! assumption `prusa` and `bambu`, are run by a controller that looks ahead as Klipper does. The rules omit the time for transferring and reading lines (except 1.1 ms a stroke on the
//! AVR), and the accuracy of the controller's own oscillator.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "firmware reckons in 32 bits, and so does its clock"
)]

pub(crate) mod controller;
mod faults;
mod grbl;
mod grid;
pub(crate) mod judge;
mod legs;
mod marlin;
mod programs;
mod sweep;
pub(crate) mod text;
mod timer;
pub(crate) mod track;

use stargrip_cam::plan::Chop;
use stargrip_cam::resume::{ResumeAt, resume};
use stargrip_cam::units::Speed;

use self::controller::{BOARDS, Motors, run, run_ender, run_marlin};
use self::judge::{OTHER_VERSION, deviations, deviations_within};
use self::marlin::{IDLE_TIMES, Version};
use self::programs::{all_profiles, coupon_programs, feed_check, machine, machine_of_ender, seals, spec};
use self::text::Text;

/// Tolerance of the time of a resumed program, as a part of it.
const RESUMED: f64 = 0.002;

/// Tolerance of a mean speed beside the error of dwells: whole dwells and whole steps.
const ROUNDING: f64 = 5e-4;

const FIVE: &str = include_str!("../../../designs/paper-five-points.toml");
const ROUND: &str = include_str!("../../../designs/round-hinges.toml");
const CONICAL: &str = include_str!("../../../designs/conical-stack.toml");

/// The motors in the profile of a dialect.
pub(crate) fn own_motors(dialect: &str) -> Motors {
    let acceleration = match dialect {
        "fluidnc" => 25.0,
        "marlin" => 3000.0,
        "ender" => 500.0,
        "prusa" => 1250.0,
        _ => 10.0,
    };
    Motors { acceleration, steps_per_mm: 80.0 }
}

/// Mean speed, windows and total time of all seals, in every dialect.
#[test]
fn every_program_runs_as_its_controller_was_told() {
    for dialect in all_profiles() {
        let motors = own_motors(dialect);
        let (spec, machine) = (spec(dialect, FIVE), machine(dialect, motors));
        let mut all = seals(&spec, &machine).0;
        all.push(feed_check(&spec, &machine));
        all.extend(coupon_programs(&spec, &machine));
        for (name, code) in all {
            let text = Text::read(&code);
            let speed = text.fact("seal.speed_mm_s").unwrap_or(spec.seal.speed.0);
            let track = run(dialect, &text, motors);
            let (deviation, complaints) = deviations(&text, &track, speed, motors.stop(speed));
            println!("{dialect} {name} {deviation:?}");
            assert!(complaints.is_empty(), "{dialect}: {name}: {complaints:?}");
        }
    }
}

/// The last minutes of a job: the travel from the sheet's corner to the seam is a large part of them.
#[test]
fn the_rest_of_a_job_takes_as_long_as_it_states() {
    for dialect in all_profiles() {
        let motors = own_motors(dialect);
        let (spec, machine) = (spec(dialect, FIVE), machine(dialect, motors));
        let (name, code) = seals(&spec, &machine).0.swap_remove(0);
        for share in [0.5, 0.99] {
            let rest =
                resume(&code, ResumeAt::Share(share), None).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            let text = Text::read(&rest.text);
            let stated = text.fact("total.time_s").expect("a time");
            let off = run(dialect, &text, motors).now - stated;
            println!("{dialect} {share} {off:+.2} s of {stated} s");
            assert!(off.abs() < RESUMED * stated + 0.2, "{dialect} {share}: {off:+.2} s of {stated} s");
        }
    }
}

/// A trace states no total to compare with; none of its paths is slow.
#[test]
fn traces_travel_and_do_not_crawl() {
    for dialect in all_profiles() {
        let motors = Motors { acceleration: 1000.0, steps_per_mm: 80.0 };
        let (spec, machine) = (spec(dialect, FIVE), machine(dialect, motors));
        for (name, code) in seals(&spec, &machine).1 {
            let track = run(dialect, &Text::read(&code), motors);
            let length: f64 = track.stretches.iter().map(|stretch| stretch.length).sum();
            // 20 mm/s, travels, and stops at the corners.
            let told = length / 20.0;
            assert!((told..3.0 * told).contains(&track.now), "{dialect}: {name}: {} of {told} s", track.now);
        }
    }
}

/// An Ender-3 with a version of Marlin that its profile states: slow and fast seals, with ramps and lifts of its slower Z, around sharp
/// corners and round ones, with a display that takes hardly any time and with a slow one.
#[test]
fn an_ender_keeps_every_speed_on_the_version_of_its_profile() {
    let motors = own_motors("ender");
    // Faster, the iron would rest too long on small arcs.
    for (design, version) in
        [(FIVE, Version::Two), (FIVE, Version::Newest), (ROUND, Version::Two), (ROUND, Version::Newest)]
    {
        let machine = machine_of_ender(motors, version);
        for speed in [0.1, 0.2, 0.5, 1.0] {
            let mut star = spec("ender", design);
            star.seal.speed = Speed(speed);
            let dwell_error = Chop::new(&star, &machine).and_then(|chop| chop.dwell_error(speed));
            for ((name, code), idle) in
                seals(&star, &machine).0.iter().flat_map(|program| IDLE_TIMES.map(|idle| (program, idle)))
            {
                let text = Text::read(code);
                let track = run_ender(&text, motors, version, idle);
                let (deviation, complaints) = deviations(&text, &track, speed, 0.0);
                println!("{version:?} {name} {speed} mm/s, idle {idle} s: {deviation:?}");
                let case = format!("{version:?} {name} {speed} mm/s, idle {idle} s");
                if idle == IDLE_TIMES[1] {
                    assert!(complaints.is_empty(), "{case}: {complaints:?}");
                } else {
                    // A fast seal has strokes in which a millisecond is more than the tolerance; `check` says so.
                    let error = dwell_error.expect("Marlin");
                    assert!(deviation.mean.abs() < error + ROUNDING, "{case}: {deviation:?}");
                }
            }
        }
    }
}

/// One program is valid for every board, although versions differ in the rate of a first step; tips and corners included.
#[test]
fn every_marlin_keeps_the_speed_of_one_program() {
    for design in [FIVE, ROUND, CONICAL] {
        for acceleration in [3000.0, 500.0] {
            let motors = Motors { acceleration, ..own_motors("marlin") };
            let (spec, machine) = (spec("marlin", design), machine("marlin", motors));
            for (name, code) in seals(&spec, &machine).0 {
                let text = Text::read(&code);
                for board in BOARDS {
                    let track = run_marlin(&text, motors, board);
                    let (found, complaints) =
                        deviations_within(OTHER_VERSION, &text, &track, spec.seal.speed.0, 0.0);
                    println!("{name} {acceleration} {board:?} {found:?}");
                    assert!(complaints.is_empty(), "{name}: {board:?}: {complaints:?}");
                }
            }
        }
    }
}
