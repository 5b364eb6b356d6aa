//! Ramps so short that a move on them has no length in the plane: the iron would go straight down.

use crate::design::{Refusal, RefusalCode};
use crate::plan::{Pace, Program, Ramp, Step};
use crate::spec::{Machine, Spec, key};
use crate::units::Least;
use inflatable::geom::Segment;

/// Shortest way in the plane, mm, of a move on a ramp: programs tell two places apart that are a fifth of the tolerance from each
/// other, and 0.002 mm, whatever the tolerance.
fn shortest(spec: &Spec) -> f64 {
    (0.2 * spec.accuracy.path.0).clamp(2e-6, 2e-3)
}

/// The reason for which the ramps of `programs` are too steep.
pub(super) fn too_steep(spec: &Spec, machine: &Machine, programs: &[Program]) -> Option<Refusal> {
    let least = |program: &Program| {
        let ramps = program.steps.iter().filter_map(|step| match step {
            Step::TouchDown(ramp) | Step::Lift(ramp) => Some(ramp),
            _ => None,
        });
        ramps.map(|ramp| least_move(ramp, program.pace)).fold(f64::INFINITY, f64::min)
    };
    let (found, needed) = (programs.iter().map(least).fold(f64::INFINITY, f64::min), shortest(spec));
    if found >= needed {
        return None;
    }
    let ramp = machine.process.ramp;
    Some(Refusal::new(
        key::machine::PROFILE,
        RefusalCode::SteepRamp,
        format!("on the profile's ramp of {ramp} the iron moves {found:.6} mm along the fabric at a time"),
        format!("a ramp of at least {} mm is needed", Least(ramp.0 * needed / found)),
    ))
}

/// The shortest way in the plane of a move on `ramp`, mm.
fn least_move(ramp: &Ramp, pace: Pace) -> f64 {
    let of_piece = |(piece, from, to): (&Segment, f64, f64)| {
        let flat = piece.length();
        match pace {
            Pace::Steady => flat,
            Pace::Chopped(chop) => flat / chop.strokes(libm::hypot(flat, to - from)),
        }
    };
    ramp.with_heights().map(of_piece).fold(f64::INFINITY, f64::min)
}
