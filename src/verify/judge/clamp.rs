//! Moves through clamps.

use crate::geom::{Line, Point, Segment, segment_distance};
use crate::spec::KeepOut;
use crate::verify::read::gcode::Program;
use crate::verify::{FindingCode, Findings};

/// Reports every move that comes nearer to a clamp than `reach`, below its height.
pub(in crate::verify) fn check(zones: &[KeepOut], reach: f64, program: &Program, findings: &mut Findings) {
    for zone in zones {
        let (a, c) =
            (Point::new(zone.x.0, zone.y.0), Point::new(zone.x.0 + zone.width.0, zone.y.0 + zone.depth.0));
        let corners = [a, Point::new(c.x, a.y), c, Point::new(a.x, c.y), a];
        let sides: Vec<Segment> = corners.windows(2).map(|pair| Line::new(pair[0], pair[1]).into()).collect();
        for step in &program.moves {
            let z = step.from.z.min(step.to.z);
            let Some(path) = step.path.filter(|_| zone.height.is_none_or(|height| z <= height.0)) else {
                continue;
            };
            let inside = |p: Point| a.x <= p.x && p.x <= c.x && a.y <= p.y && p.y <= c.y;
            let near = |side: &Segment| segment_distance(side, &path) <= reach - 1e-3;
            if inside(path.start()) || inside(path.end()) || sides.iter().any(near) {
                let found = format!("a move at Z{z} through the clamp {:?}", zone.name);
                findings.add(
                    FindingCode::ClampInTheWay,
                    step.line,
                    found,
                    format!("{reach} mm off every clamp"),
                );
            }
        }
    }
}
