//! Moves through clamps.

use crate::verify::judge::Judge;
use crate::verify::read::gcode;
use crate::verify::read::gcode::{BlindMove, Move};
use crate::verify::{Finding, FindingCode, Findings};
use geom::order::sort_by;
use geom::{Bounds, BoxIndex, Line, Point, Segment, segment_distance};
use spec::KeepOut;

/// Depth to which a clamp may be touched, mm: positions in a file are rounded.
const ROUNDING: f64 = 1e-3;

/// The first move in a program, given line by line, that comes nearer to one of `clamps` than `reach`, mm.
pub fn judge_clamps<'a>(
    clamps: &[KeepOut],
    reach: f64,
    lines: impl IntoIterator<Item = &'a str>,
    dialect: gcode::Dialect,
) -> Option<Finding> {
    let (mut judge, mut findings) = (ClampJudge::new(clamps, reach), Findings::default());
    gcode::each_line(lines, dialect, |line| judge.see(line, &mut findings));
    findings.into_vec().into_iter().next()
}

/// Reports every move that comes nearer to a clamp than `reach`, below its height. The first one begins where programs end,
/// at X0 Y0.
pub(super) struct ClampJudge<'a> {
    reach: f64,
    zones: Vec<ClampZone<'a>>,
    /// Most moves are near none of them.
    index: BoxIndex,
}

/// A clamp shrunk by [`ROUNDING`] on each side; moves across it are then found for a reach of 0 as well.
struct ClampZone<'a> {
    clamp: &'a KeepOut,
    bounds: Bounds,
    sides: [Segment; 4],
}

impl<'a> ClampZone<'a> {
    fn new(clamp: &'a KeepOut) -> Self {
        let min = Point::new(clamp.x.0 + ROUNDING, clamp.y.0 + ROUNDING);
        let max = Point::new(clamp.x.0 + clamp.width.0 - ROUNDING, clamp.y.0 + clamp.depth.0 - ROUNDING);
        let [b, d] = [Point::new(max.x, min.y), Point::new(min.x, max.y)];
        let sides = [(min, b), (b, max), (max, d), (d, min)].map(|(from, to)| Line::new(from, to).into());
        Self { clamp, bounds: Bounds { min, max }, sides }
    }

    /// Whether `path` at height `z` comes nearer than `reach`.
    fn is_met(&self, path: &Segment, z: f64, reach: f64) -> bool {
        self.clamp.height.is_none_or(|height| z <= height.0)
            && (self.bounds.contains(path.start())
                || self.bounds.contains(path.end())
                || self.sides.iter().any(|side| segment_distance(side, path) <= reach))
    }
}

impl<'a> ClampJudge<'a> {
    pub(super) fn new(clamps: &'a [KeepOut], reach: f64) -> Self {
        let mut zones: Vec<ClampZone<'_>> = clamps.iter().map(ClampZone::new).collect();
        sort_by(&mut zones, |a, b| {
            let [a, b] = [a.bounds.min, b.bounds.min];
            a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x))
        });
        // A clamp that is thinner than its rims has its corners the other way round.
        let boxes = zones.iter().map(|zone| Bounds::of_points([zone.bounds.min, zone.bounds.max]));
        let index = BoxIndex::new(boxes);
        Self { reach, zones, index }
    }

    /// Reports the clamps that a move along `path`, at height `z` at the least, comes too near to.
    fn report_collisions(&self, path: &Segment, z: f64, line: usize, findings: &mut Findings) {
        let candidates = self.index.overlapping(&path.bounds().outset(self.reach + ROUNDING));
        let zones = candidates.into_iter().map(|number| &self.zones[number]);
        for zone in zones.filter(|zone| zone.is_met(path, z, self.reach)) {
            let fault = format!("a move at Z{z} through the clamp {:?}", zone.clamp.name);
            let allowed = format!("{} mm off every clamp", self.reach);
            findings.add_at(FindingCode::ClampInTheWay, line, fault, allowed);
        }
    }
}

impl Judge for ClampJudge<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        if let Some(path) = &step.path {
            self.report_collisions(path, step.from.z.min(step.to.z), step.line, findings);
        }
    }

    fn blind(&mut self, step: &BlindMove, findings: &mut Findings) {
        if let [Some(x), Some(y), Some(z)] = step.to
            && (x, y) != (0.0, 0.0)
        {
            self.report_collisions(
                &Line::new(Point::ORIGIN, Point::new(x, y)).into(),
                z,
                step.line,
                findings,
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::read::gcode::{Dialect, each_line};
    use spec::units::Length;

    fn findings_of(text: &str, zones: &[KeepOut], reach: f64) -> Vec<Finding> {
        let (mut judge, mut findings) = (ClampJudge::new(zones, reach), Findings::default());
        each_line(text.split_inclusive('\n'), Dialect::GENERIC, |line| judge.see(line, &mut findings));
        findings.into_vec()
    }

    /// The lines that are found in `body`, with a clamp from (10, 20) to (18, 25).
    fn lines(body: &str, reach: f64, height: Option<f64>) -> Vec<Option<usize>> {
        let [x, y, width, depth] = [10.0, 20.0, 8.0, 5.0].map(Length);
        let zone = KeepOut { name: "vice".to_owned(), x, y, width, depth, height: height.map(Length) };
        let text = format!("G21\nG90\nG0 X0 Y0 Z9\n{body}\n");
        let zones = [zone];
        let findings = findings_of(&text, &zones, reach);
        assert!(findings.iter().all(|finding| finding.code == "clamp-in-the-way"));
        findings.iter().map(|finding| finding.line).collect()
    }

    #[test]
    fn a_move_beside_a_clamp_keeps_its_reach_on_every_side() {
        // Half a millimetre inside, and outside, of a reach of 2 mm.
        for (inside, outside) in [
            ("G0 X-9 Y18.5\nG0 X40", "G0 X-9 Y17.5\nG0 X40"),
            ("G0 X-9 Y26.5\nG0 X40", "G0 X-9 Y27.5\nG0 X40"),
            ("G0 X8.5 Y-9\nG0 Y60", "G0 X7.5 Y-9\nG0 Y60"),
            ("G0 X19.5 Y-9\nG0 Y60", "G0 X20.5 Y-9\nG0 Y60"),
        ] {
            assert_eq!(lines(inside, 2.0, None), [Some(5)], "{inside}");
            assert_eq!(lines(outside, 2.0, None), [], "{outside}");
            assert_eq!(lines(inside, 0.0, None), [], "{inside}");
        }
    }

    /// Each of many clamps is found by the moves through it alone, wherever it lies among the others.
    #[test]
    fn every_clamp_of_many_is_found() {
        let position = |i: usize| Length(f64::from(u32::try_from(i).expect("few")) * 10.0);
        let clamp = |i: usize| KeepOut {
            name: i.to_string(),
            x: position(i % 30),
            y: position(i / 30),
            width: Length(4.0),
            depth: Length(4.0),
            height: None,
        };
        let zones: Vec<KeepOut> = (0..900).map(clamp).collect();
        for i in [0, 17, 31, 450, 899] {
            let (x, y) = (zones[i].x.0, zones[i].y.0);
            let text = format!("G21\nG90\nG0 X{} Y{} Z9\nG0 X{}\n", x - 3.0, y + 2.0, x + 5.0);
            // The way there, in line 3, crosses others.
            let clamp_findings =
                findings_of(&text, &zones, 1.0).into_iter().filter(|finding| finding.line == Some(4));
            let texts: Vec<String> = clamp_findings.map(|finding| finding.to_string()).collect();
            assert!(texts.len() == 1 && texts[0].contains(&format!("the clamp \"{i}\"")), "{texts:?}");
        }
    }

    #[test]
    fn within_a_clamp_there_is_no_side_to_be_near_to() {
        assert_eq!(lines("G0 X13.9 Y22.5\nG0 X14.1", 0.1, None), [Some(4), Some(5)]);
        // Each end, and each of its coordinates, counts.
        assert_eq!(lines("G0 X14 Y22.5", 0.0, None), [Some(4)]);
        assert_eq!(lines("G0 X14 Y0\nG0 Y60\nG0 X60\nG0 Y22.5", 0.0, None), [Some(5)]);
    }

    #[test]
    fn the_way_from_the_corner_to_the_first_place_counts() {
        let zone = |z: f64| {
            let [x, y, width, depth] = [10.0, 20.0, 8.0, 5.0].map(Length);
            let height = Some(Length(30.0));
            let zones = [KeepOut { name: "vice".to_owned(), x, y, width, depth, height }];
            let text = format!("G21\nG90\nG0 Z{z}\nG0 X30 Y50\n");
            findings_of(&text, &zones, 1.0).iter().map(|finding| finding.line).collect::<Vec<_>>()
        };
        assert_eq!((zone(30.0), zone(31.0)), (vec![Some(4)], vec![]));
    }

    #[test]
    fn what_passes_above_a_clamp_by_its_lower_end_is_free() {
        let program = |from: f64, to: f64| format!("G0 X0 Y22.5\nG0 Z{from}\nG1 X60 Z{to} F600");
        let collides = |from, to| !lines(&program(from, to), 1.0, Some(4.0)).is_empty();
        assert!(!collides(4.001, 4.001) && !collides(4.001, 9.0) && !collides(9.0, 4.001));
        assert!(collides(4.0, 4.0) && collides(4.0, 9.0) && collides(9.0, 4.0));
        assert!(!lines(&program(9.0, 9.0), 1.0, None).is_empty());
    }

    #[test]
    fn an_arc_is_judged_by_its_bulge() {
        // Half a circle from (4, 16) to (24, 16): its top is (14, 26), its ends are far off.
        assert_eq!(lines("G0 X4 Y16\nG2 X24 Y16 I10 J0 F600", 0.5, None), [Some(5)]);
        // The other half hangs below.
        assert_eq!(lines("G0 X4 Y16\nG3 X24 Y16 I10 J0 F600", 0.5, None), []);
    }
}
