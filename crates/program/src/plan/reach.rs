//! The reach of the machine: every path of a program, with its ramps down and up, must lie inside the work area.

use crate::plan::Step;
use design::{Refusal, RefusalCode};
use geom::{Bounds, Path, Point};
use spec::{Machine, key};

/// Slack, mm: rounding.
const SLACK: f64 = 1e-6;

/// The refusal of `steps` that `machine` cannot reach; `None` if it can, or if its work area is unknown. `subject` has these
/// steps, and `remedy` makes them smaller.
pub fn refusal_beyond(machine: &Machine, subject: &str, steps: &[Step], remedy: &str) -> Option<Refusal> {
    let (x, y) = machine.bench.work_area?;
    let extent = steps
        .iter()
        .filter(|step| step.is_contact())
        .map(|step| Path::open(step.pieces().to_vec()).bounds())
        .fold(Bounds::EMPTY, Bounds::union);
    let area = Bounds { min: Point::new(-SLACK, -SLACK), max: Point::new(x.0 + SLACK, y.0 + SLACK) };
    if area.contains(extent.min) && area.contains(extent.max) {
        return None;
    }
    Some(Refusal::new(
        key::machine::PROFILE,
        RefusalCode::OutOfReach,
        format!(
            "{subject} needs X {:.1} to {:.1} mm, Y {:.1} to {:.1} mm; the machine reaches 0 to {:.1} mm, 0 to {:.1} mm",
            extent.min.x, extent.max.x, extent.min.y, extent.max.y, x.0, y.0
        ),
        format!(
            "must lie inside the profile's [work_area]: {remedy}; or correct [work_area], if it is larger"
        ),
    ))
}
