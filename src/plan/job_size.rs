//! Jobs that nobody means: so many moves that no memory should hold them, or a time that is no day's work any more.
//!
//! The limits keep a build within some hundred megabytes, and every figure of a program's comments within the shortest
//! line that a profile may have.

use crate::design::{Refusal, RefusalCode};
use crate::geom::Segment;
use crate::plan::lowest_feed::contact;
use crate::plan::{Pace, Program};
use crate::spec::{Spec, key};

/// Most moves in contact of all programs together: 40 times those of three large stars, chopped.
const MOST_MOVES: f64 = 2e6;
/// Longest time of a program, s: eleven and a half days.
const LONGEST_TIME: f64 = 1e6;

/// The reason for which `programs` are more than a job may be.
pub(super) fn too_large(spec: &Spec, programs: &[Program]) -> Option<Refusal> {
    let moves: f64 = programs.iter().map(moves).sum();
    let time = programs.iter().map(|program| program.time).fold(0.0, f64::max);
    let refuse =
        |key, found, remedy: String| Some(Refusal::new(key, RefusalCode::JobTooLarge, found, remedy));
    if moves > MOST_MOVES {
        let found = format!("the job has {moves:.0} moves in contact");
        let remedy = format!("at most {MOST_MOVES:.0} are written: build fewer or smaller stars at a time");
        return refuse(key::stack::COUNT, found, remedy);
    }
    if time >= LONGEST_TIME {
        let found = format!("a program takes {:.0} h", time / 3600.0);
        let remedy = format!(
            "it must take less than {:.0} h: one program a star, a smaller star, or a speed above {} mm/s if a coupon holds it",
            LONGEST_TIME / 3600.0,
            spec.seal.speed.0
        );
        return refuse(key::seal::SPEED, found, remedy);
    }
    None
}

/// Moves in contact: a piece each, or its strokes.
fn moves(program: &Program) -> f64 {
    let strokes = |piece: &Segment, rise: f64| match program.pace {
        Pace::Steady => 1.0,
        Pace::Chopped(chop) => (piece.length().hypot(rise) / chop.longest).ceil().max(1.0),
    };
    contact(&program.steps).map(|(piece, rise)| strokes(piece, rise)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the comments of a program say of its last seam, at the limits: the longest that they can get.
    #[test]
    fn comments_fit_into_the_shortest_line_of_a_profile() {
        // A star of 200 m, the largest there is, has less than a kilometre of seam.
        let (length, time) = (1e6 - 1e-3, LONGEST_TIME - 1.0);
        let longest = format!("; length: seam=128 star=64 loop=outer length_mm={length:.3} time_s={time}");
        assert!(longest.len() <= 72, "{longest}");
    }
}
