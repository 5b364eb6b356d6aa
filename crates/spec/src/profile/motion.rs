//! Reads the properties of the motors.

use crate::FaultCode;
use crate::allowed::Allowed;
use crate::dialect::Dialect;
use crate::fault::Fault;
use crate::motion::{Motion, StepRate, ZLimits};
use crate::profile::known::{known_number, quantity_or_unknown, unless};
use crate::section::Section;
use crate::units::{Acceleration, Duration, Speed};

/// Least acceleration of the axes, mm/s^2.
pub const LEAST_ACCELERATION: f64 = 0.1;
/// Largest acceleration of an axis, mm/s^2: no machine exceeds it.
pub const MOST_ACCELERATION: f64 = 1e6;
/// Steps per mm: from a coarse belt to a fine screw with microsteps.
const STEPS: Allowed = Allowed::closed(1e-3, 1e6);
/// Lowest step rates, steps/s: from a step a quarter of an hour to a rate that only a broken timer would have.
const RATE: Allowed = Allowed::closed(1e-3, 1e5);

/// The rate of a move's first step in Marlin to 2.0.x, steps/s (planner.cpp, `MINIMAL_STEP_RATE`).
pub const FIRST_STEP_RATE: f64 = 120.0;
/// Largest speed of Z, mm/s: from a slow screw to a linear motor.
const Z_SPEED: Allowed = Allowed::closed(1e-3, 1e3);
/// Fewest steps of a move: more than a misconfigured firmware requires.
const MOVE: Allowed = Allowed::closed(0.0, 100.0);

/// What a dialect says of the motors where a profile does not.
struct MotionDefaults {
    /// The rate of a move's first step at least, steps/s.
    first_step_rate: Option<f64>,
    /// Fewest steps of a move.
    min_move_steps: f64,
    /// Whether every board has a lowest step rate.
    has_floor: bool,
}

impl MotionDefaults {
    /// The defaults of `dialect`. Marlin: planner.cpp, `MINIMAL_STEP_RATE`, and Configuration_adv.h, `MIN_STEPS_PER_SEGMENT`, with
    /// the values of most boards.
    const fn new(dialect: Dialect) -> Self {
        match dialect {
            Dialect::Marlin => {
                Self { first_step_rate: Some(FIRST_STEP_RATE), min_move_steps: 6.0, has_floor: true }
            }
            Dialect::Generic
            | Dialect::LinuxCnc
            | Dialect::Grbl
            | Dialect::GrblHal
            | Dialect::FluidNc
            | Dialect::Klipper
            | Dialect::RepRapFirmware
            | Dialect::Bambu => Self { first_step_rate: None, min_move_steps: 0.0, has_floor: false },
        }
    }
}

/// Reads `[motion]` of a controller of `dialect`.
pub(super) fn read_motion(s: &mut Section<'_, '_>, dialect: Dialect) -> Motion {
    // Steps are given for all axes or for none. What a profile leaves out is unknown, which is not zero: the clock and
    // the chop need to tell both apart. The dialect decides what the controller's planner adds.
    let axes = ["x_steps_per_mm", "y_steps_per_mm", "z_steps_per_mm"];
    let steps_per_mm = match axes.map(|axis| known_number(s, axis, STEPS)) {
        [Some(x), Some(y), Some(z)] => Some([x, y, z]),
        [None, None, None] => None,
        _ => {
            let message = "[motion] has the steps of some axes only";
            let allowed = "must set `x_steps_per_mm`, `y_steps_per_mm` and `z_steps_per_mm`, or none of them";
            s.report(Fault::error(FaultCode::Conflict, s.place(), message).label(allowed));
            None
        }
    };
    let step_rate = match unless(s, "min_step_rate", "none", |s| known_number(s, "min_step_rate", RATE)) {
        None => StepRate::NoLimit,
        Some(rate) => rate.map_or(StepRate::Unknown, StepRate::AtLeast),
    };
    let defaults = MotionDefaults::new(dialect);
    if defaults.has_floor && step_rate == StepRate::NoLimit {
        refuse_no_floor(s, dialect);
    }
    let rate = unless(s, "first_step_rate", "none", |s| s.number("first_step_rate", RATE));
    Motion {
        steps_per_mm,
        step_rate,
        min_feed: s.quantity("min_feed", Allowed::closed(0.0, 1e3)).unwrap_or(Speed(0.0)),
        acceleration: quantity_or_unknown(
            s,
            "acceleration",
            Allowed::closed(LEAST_ACCELERATION, MOST_ACCELERATION),
        ),
        chop_feed: quantity_or_unknown(s, "chop_feed", Allowed::closed(1e-3, 1e3)),
        start_delay: s.quantity("start_delay", Allowed::closed(0.0, 1.0)).unwrap_or(Duration(0.0)),
        tick: quantity_or_unknown(s, "tick", Allowed::closed(0.0, 0.1)),
        wraps: dialect.timer_wraps(),
        first_step_rate: rate.and_then(|rate| rate.or(defaults.first_step_rate)),
        min_move_steps: s.number("min_move_steps", MOVE).unwrap_or(defaults.min_move_steps),
        z: ZLimits {
            speed: s.quantity("z_speed", Z_SPEED),
            acceleration: s.quantity::<Acceleration>(
                "z_acceleration",
                Allowed::closed(LEAST_ACCELERATION, MOST_ACCELERATION),
            ),
        },
        s_curve: s.truth("s_curve").unwrap_or(false),
    }
}

/// Refuses `min_step_rate = "none"` of a dialect of which every board has a floor.
fn refuse_no_floor(s: &mut Section<'_, '_>, dialect: Dialect) {
    let (place, title) = (s.place_of("min_step_rate"), dialect.title());
    let message = format!("`min_step_rate` is \"none\", but {title} has a floor on every board");
    let fault = Fault::error(FaultCode::Conflict, place, message)
        .label(format!("must be a step rate, such as 32: with 32 bits {title} rounds rates up to whole steps a second"))
        .help("at r steps/s it runs up to 1/r too fast: 0.2 % at 500, 17 % at 6; slower seals need `feed_floor = \"chop\"`");
    s.report(fault);
}
