//! Heights from the first word on: the iron goes up before it goes anywhere, and never above the park height.

use crate::geom::Bounds;
use crate::spec::Heights;
use crate::verify::judge::HEIGHT;
use crate::verify::read::gcode::{MoveKind, Program};
use crate::verify::{FindingCode, Findings};

/// Reports every motion before X, Y and Z are known that does not go up first and then stay up and within `area`, and
/// every motion above the park height.
pub(in crate::verify) fn check(heights: &Heights, area: &Bounds, program: &Program, findings: &mut Findings) {
    let (travel, park) = (heights.travel.0, heights.park.0);
    for (step, i) in program.blind.iter().zip(0..) {
        let [x, y, z] = step.to;
        let up = z.is_some_and(|z| (travel - HEIGHT..=park + HEIGHT).contains(&z));
        let rises = z.is_some_and(|z| (z - park).abs() <= HEIGHT) && step.named == [false, false, true];
        let within = x.is_none_or(|x| (area.min.x..=area.max.x).contains(&x))
            && y.is_none_or(|y| (area.min.y..=area.max.y).contains(&y));
        let is_first = i == 0;
        if !(up && within && step.kind == MoveKind::Rapid && (rises || !is_first)) {
            let told = |(name, value): (char, Option<f64>)| value.map(|value| format!("{name}{value}"));
            let axes: Vec<String> = "XYZ".chars().zip(step.to).filter_map(told).collect();
            let allowed = format!("first G0 Z{park}, then G0 within the sheet at Z{travel} to Z{park}");
            findings.add(FindingCode::BlindMove, step.line, format!("a move to {}", axes.join(" ")), allowed);
        }
    }
    for step in program.moves.iter().filter(|step| step.to.z > park + HEIGHT) {
        let found = format!("Z{}", step.to.z);
        findings.add(
            FindingCode::OutsideWorkArea,
            step.line,
            found,
            format!("at most Z{park}, the park height"),
        );
    }
}
