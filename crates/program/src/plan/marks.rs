//! Stops above the marks of a sheet, by which the operator finds the sheet again after it was moved.

use crate::plan::program::PauseReason;
use crate::plan::{Height, Step};
use design::{Design, Refusal, RefusalCode};
use geom::Point;
use spec::{Marks, Spec, key};

/// The steps above `marks` and back home, for a tool that is parked.
pub(super) fn mark_steps(marks: &[Point]) -> Vec<Step> {
    let mut steps = Vec::new();
    for (place, number) in marks.iter().zip(1..) {
        steps.extend([
            Step::Travel(*place),
            Step::Height(Height::Travel),
            Step::Pause(PauseReason::Mark { number, place: *place }),
            Step::Height(Height::Park),
        ]);
    }
    if !marks.is_empty() {
        steps.push(Step::Travel(Point::ORIGIN));
    }
    steps
}

/// The refusal of a sheet without marks where programs must stop above them.
pub fn no_marks(spec: &Spec, design: &Design) -> Option<Refusal> {
    if spec.machine.marks == Marks::Ignored {
        return None;
    }
    let sheet = design.sheets.iter().find(|sheet| design.marks(sheet.index).is_none())?;
    Some(Refusal::new(
        key::machine::MARKS,
        RefusalCode::NoMarks,
        format!("sheet {} has no two registration holes above which a program could stop", sheet.index),
        "write hole_diameter above 0 in [sheet], or marks = \"none\"".to_owned(),
    ))
}
