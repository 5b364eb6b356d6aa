//! Every dialect with its controller: how it reads words, and which clock times it.

use stargrip_cam::spec::{Dialect, DialectFamily};

use super::grbl::Grbl;
use super::legs::{Reading, Task, tasks};
use super::marlin::{IDLE, IDLE_TIMES, Marlin, Version};
use super::sweep::{Corner, Sweep};
use super::text::Text;
use super::timer::Timer;
use super::track::Track;

/// Speed of travels in the profiles, mm/s.
pub(crate) const TRAVEL: f64 = 20.0;

/// The motors in a profile.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motors {
    /// Acceleration of X, Y and Z, mm/s^2.
    pub(crate) acceleration: f64,
    /// Steps per mm of X and Y; Z has as many, or 400.
    pub(crate) steps_per_mm: f64,
}

impl Motors {
    /// The fraction of a window's time that one stop takes: every controller may stop at a corner.
    pub(crate) fn stop(self, speed: f64) -> f64 {
        speed * speed / self.acceleration
    }

    fn steps(self) -> [f64; 3] {
        [self.steps_per_mm, self.steps_per_mm, self.steps_per_mm.max(400.0)]
    }
}

/// The track of a program on the controller of the profile `name`.
pub(crate) fn run(name: &str, text: &Text, motors: Motors) -> Track {
    let dialect = crate::dialect(name);
    let (reading, mut track) = (reading(dialect), Track::default());
    let tasks = tasks(text, &reading);
    match dialect {
        Dialect::Grbl => grbl(Timer::Avr, motors).run(&tasks, &mut track),
        Dialect::GrblHal => grbl(Timer::Esp32, motors).run(&tasks, &mut track),
        Dialect::FluidNc => grbl(Timer::FluidNc, motors).run(&tasks, &mut track),
        // feature/precise_stepping: speeds as they are; Configuration_MK4.h: CLASSIC_JERK, DEFAULT_MAX_ACCELERATION.
        Dialect::Marlin if name == "prusa" => {
            let mk4 = sweep(motors, Corner::Jerk([8.0, 8.0, 2.0]), 1e-3);
            Sweep { z_acceleration: 200.0, ..mk4 }.run(&tasks, &mut track);
        }
        Dialect::Marlin if name == "ender" => ender(motors, Version::Two).run(&tasks, &mut track),
        Dialect::Marlin => marlin(motors, 32.0, Version::Two).run(&tasks, &mut track),
        // klippy/toolhead.py, square_corner_velocity.
        Dialect::Klipper => sweep(motors, Corner::Square(5.0), 1e-3).run(&tasks, &mut track),
        // Config/Configuration.h: M566 of X and Y, and of Z.
        Dialect::RepRapFirmware => {
            sweep(motors, Corner::Jerk([15.0, 15.0, 10.0]), 1e-3).run(&tasks, &mut track);
        }
        // Both are unknown; their corners are those of GRBL.
        Dialect::Bambu => sweep(motors, Corner::Deviation(0.01), 1e-3).run(&tasks, &mut track),
        Dialect::Generic => sweep(motors, Corner::Deviation(0.01), 1.0).run(&tasks, &mut track),
        Dialect::LinuxCnc => sweep(motors, Corner::Stop, 1.0).run(&tasks, &mut track),
    }
    track
}

/// A board for Marlin: a timer of 8 bits has a floor of 32 steps/s, one of 32 bits has none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Board {
    pub(crate) bits: u32,
    pub(crate) version: Version,
}

/// All boards for Marlin.
pub(crate) const BOARDS: [Board; 4] = [
    Board { bits: 8, version: Version::Two },
    Board { bits: 8, version: Version::Newest },
    Board { bits: 32, version: Version::Two },
    Board { bits: 32, version: Version::Newest },
];

/// The track of a program on a board with Marlin.
pub(crate) fn run_marlin(text: &Text, motors: Motors, board: Board) -> Track {
    let mut track = Track::default();
    let tasks: Vec<Task> = tasks(text, &reading(Dialect::Marlin));
    let floor = if board.bits == 8 { 32.0 } else { 1.0 };
    marlin(motors, floor, board.version).run(&tasks, &mut track);
    track
}

fn reading(dialect: Dialect) -> Reading {
    let modal_travel = dialect.family() != DialectFamily::Mill;
    // RepRapFirmware: Config/Configuration.h, DefaultMinFeedrate.
    let lowest_feed = if dialect == Dialect::RepRapFirmware { 30.0 } else { 0.0 };
    let chords = match dialect {
        Dialect::Grbl | Dialect::GrblHal | Dialect::FluidNc => grbl_chords,
        Dialect::RepRapFirmware => duet_chords,
        Dialect::Generic | Dialect::LinuxCnc | Dialect::Marlin | Dialect::Klipper | Dialect::Bambu => {
            fine_chords
        }
    };
    Reading { modal_travel, lowest_feed, chords }
}

/// motion_control.c, mc_arc, with $12 = 0.002 mm.
fn grbl_chords(radius: f64, angle: f64, _: f64) -> f64 {
    (0.5 * angle.abs() * radius / (0.002 * (2.0 * radius - 0.002)).sqrt()).floor()
}

/// GCodes.cpp, DoArcMove; Config/Configuration.h, MaxArcDeviation and the following constants.
fn duet_chords(radius: f64, angle: f64, feed: f64) -> f64 {
    let chord = (8.0 * radius * 0.005).sqrt().min(feed / 60.0 / 200.0).clamp(0.02, 1.0);
    (radius * angle.abs() / chord + 0.8).floor()
}

/// LinuxCNC follows an arc exactly: the chords deviate by at most 1e-5 mm.
fn fine_chords(radius: f64, angle: f64, _: f64) -> f64 {
    (angle.abs() / (8e-5 / radius).sqrt()).ceil()
}

fn grbl(timer: Timer, motors: Motors) -> Grbl {
    let steps_per_mm = motors.steps().map(|s| s as f32);
    let acceleration = [motors.acceleration as f32 * 3600.0; 3];
    Grbl { steps_per_mm, acceleration, max_rate: [TRAVEL as f32 * 60.0; 3], timer }
}

fn marlin(motors: Motors, lowest_rate: f64, version: Version) -> Marlin {
    let Motors { acceleration, .. } = motors;
    Marlin {
        steps_per_mm: motors.steps(),
        acceleration,
        z_acceleration: acceleration,
        speed: [TRAVEL; 3],
        lowest_rate,
        version,
        idle: IDLE,
        s_curve: false,
    }
}

/// config/examples/Creality/Ender-3/CrealityV422/Configuration.h: DEFAULT_MAX_FEEDRATE, DEFAULT_MAX_ACCELERATION, S_CURVE_ACCELERATION.
pub(crate) fn ender(motors: Motors, version: Version) -> Marlin {
    let board = marlin(motors, 1.0, version);
    Marlin { z_acceleration: 100.0, speed: [500.0, 500.0, 5.0], idle: IDLE_TIMES[1], s_curve: true, ..board }
}

/// The track of a program on an Ender-3 with another version, where a call of `idle()` takes `idle`, s.
pub(crate) fn run_ender(text: &Text, motors: Motors, version: Version, idle: f64) -> Track {
    let mut track = Track::default();
    Marlin { idle, ..ender(motors, version) }.run(&tasks(text, &reading(Dialect::Marlin)), &mut track);
    track
}

/// A controller that looks ahead, with the length of a unit of its dwells, s.
fn sweep(motors: Motors, corner: Corner, dwell: f64) -> Sweep {
    let Motors { acceleration, .. } = motors;
    Sweep { acceleration, z_acceleration: acceleration, speed: [TRAVEL; 3], corner, dwell }
}
