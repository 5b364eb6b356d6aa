//! The feed check: three lines of 10 mm that must take as long as the seal's speed says.

use crate::geom::{Line, Point, Segment};
use crate::plan::{Height, Program, Purpose, Scope, Step};
use crate::spec::{Machine, Spec};

/// Length of each line, mm: at 0.1 mm/s it takes 100 s, long enough for a wristwatch.
pub const CHECK_LENGTH: f64 = 10.0;

/// The programs for X, Y and 45 degrees, in this order: cold, at travel height, at the seal's pace.
pub fn feed_checks(spec: &Spec, machine: &Machine) -> Vec<(&'static str, Program)> {
    let diagonal = CHECK_LENGTH / std::f64::consts::SQRT_2;
    let ends = [
        ("along X", Point::new(CHECK_LENGTH, 0.0)),
        ("along Y", Point::new(0.0, CHECK_LENGTH)),
        ("at 45 deg", Point::new(diagonal, diagonal)),
    ];
    ends.map(|(name, end)| {
        let line: Segment = Line::new(Point::ORIGIN, end).into();
        let steps = vec![Step::Travel(Point::ORIGIN), Step::Height(Height::Travel), Step::Seal(vec![line])];
        let scope = Scope { purpose: Purpose::Trace, sheet: 1, stars: Vec::new(), piece: None };
        (name, Program::new(spec, machine, scope, steps, Vec::new()))
    })
    .into()
}
