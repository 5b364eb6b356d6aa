//! The feed check: paths of 10 mm with a nominal duration at the seal's speed.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

use crate::plan::keep_out::clamps_in_the_way;
use crate::plan::reach::refusal_beyond;
use crate::plan::refusals::contradictions;
use crate::plan::{Height, Program, Purpose, Scope, SeamList, Step};
use design::Refusals;
use geom::{Arc, Line, Point, Segment};
use spec::{Machine, Spec};

/// Length of each way, mm: at 0.1 mm/s it takes 100 s, long enough for a wristwatch.
pub const CHECK_LENGTH: f64 = 10.0;

const SCOPE: Scope = Scope { purpose: Purpose::Trace, sheet: 1, pieces: Vec::new() };

/// The programs for X, Y and 45 degrees, in this order, and where the machine draws arcs for a quarter of a circle in either
/// direction: cold, at travel height, at the seal's pace. A board may take G2 and not move (MKS DLC32, at G2 only).
pub fn feed_checks(spec: &Spec, machine: &Machine) -> Vec<(&'static str, Program)> {
    let diagonal = CHECK_LENGTH / SQRT_2;
    let mut ways = vec![
        ("along X", line_to(CHECK_LENGTH, 0.0)),
        ("along Y", line_to(0.0, CHECK_LENGTH)),
        ("at 45 deg", line_to(diagonal, diagonal)),
    ];
    if machine.controller.arcs {
        let radius = CHECK_LENGTH / FRAC_PI_2;
        // Both lie above and to the right of the origin, as the lines do.
        let clockwise = Arc::new(Point::new(radius, 0.0), radius, PI, -FRAC_PI_2);
        let other = Arc::new(Point::ORIGIN, radius, 0.0, FRAC_PI_2);
        ways.push(("clockwise, G2", clockwise.into()));
        ways.push(("counterclockwise, G3", other.into()));
    }
    let programs = ways.into_iter().map(|(name, way): (_, Segment)| {
        let steps = vec![Step::Travel(way.start()), Step::Height(Height::Travel), Step::Seal(vec![way])];
        (name, Program::new(spec, machine, SCOPE, steps, SeamList::default()))
    });
    programs.collect()
}

/// The line from the origin to a point.
fn line_to(x: f64, y: f64) -> Segment {
    Segment::from(Line::new(Point::ORIGIN, Point::new(x, y)))
}

/// Time of all of `checks`, one after the other, without pauses, s.
pub fn feed_check_seconds(spec: &Spec, machine: &Machine, checks: &[(&'static str, Program)]) -> f64 {
    let steps = checks.iter().flat_map(|(_, program)| program.steps.clone());
    let steps = steps.chain([Step::Height(Height::Park)]).collect();
    Program::new(spec, machine, SCOPE, steps, SeamList::default()).time
}

/// Every reason for which `machine` cannot run the feed check of `programs`, one after the other.
pub fn feed_check_refusals(spec: &Spec, machine: &Machine, programs: &[Program]) -> Refusals {
    let steps = programs.iter().flat_map(|program| program.steps.clone()).collect();
    let program = Program::new(spec, machine, SCOPE, steps, SeamList::default());
    let mut refusals = contradictions(spec, machine, programs);
    refusals.extend(refusal_beyond(
        machine,
        "the feed check",
        &program.steps,
        "a machine that reaches as far",
    ));
    refusals.extend(clamps_in_the_way(spec, machine, &[], &[program]));
    refusals
}
