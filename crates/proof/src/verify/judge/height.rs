//! Heights from the first word on: the iron goes up before it goes anywhere, and never above the park height.

use crate::verify::judge::{HEIGHT, Judge};
use crate::verify::read::gcode::{BlindMove, Move, MoveKind};
use crate::verify::{FindingCode, Findings};
use geom::Bounds;
use spec::Heights;

/// Reports every motion before X, Y and Z are known that does not go up first and then stay up and within `area`, and
/// every motion above the park height.
pub(super) struct HeightJudge<'a> {
    heights: &'a Heights,
    area: Bounds,
    /// Whether nothing has moved yet.
    is_first: bool,
}

impl<'a> HeightJudge<'a> {
    pub(super) fn new(heights: &'a Heights, area: Bounds) -> Self {
        Self { heights, area, is_first: true }
    }
}

impl Judge for HeightJudge<'_> {
    fn blind(&mut self, step: &BlindMove, findings: &mut Findings) {
        let (travel, park) = (self.heights.travel.0, self.heights.park.0);
        let Bounds { min, max } = self.area;
        let [x, y, z] = step.to;
        let is_up = z.is_some_and(|z| (travel - HEIGHT..=park + HEIGHT).contains(&z));
        let rises = z.is_some_and(|z| (z - park).abs() <= HEIGHT) && step.named == [false, false, true];
        let is_on_sheet =
            x.is_none_or(|x| (min.x..=max.x).contains(&x)) && y.is_none_or(|y| (min.y..=max.y).contains(&y));
        if !(is_up && is_on_sheet && step.kind == MoveKind::Rapid && (rises || !self.is_first)) {
            let axis_text = |(name, value): (char, Option<f64>)| value.map(|value| format!("{name}{value}"));
            let axes: Vec<String> = "XYZ".chars().zip(step.to).filter_map(axis_text).collect();
            let allowed = format!("first G0 Z{park}, then G0 within the sheet at Z{travel} to Z{park}");
            let fault = format!("a move to {}", axes.join(" "));
            findings.add_at(FindingCode::BlindMove, step.line, fault, allowed);
        }
        self.is_first = false;
    }

    fn step(&mut self, step: &Move, findings: &mut Findings) {
        let park = self.heights.park.0;
        if step.to.z > park + HEIGHT {
            let allowed = format!("at most Z{park}, the park height");
            findings.add_at(FindingCode::OutsideWorkArea, step.line, format!("Z{}", step.to.z), allowed);
        }
    }
}
