//! The order of travels: the ways of the iron between seams, and the places of the comments for the operator among them.
//!
//! Every rapid goes to a **waypoint**: up to the park height, above the beginning of a seam, down to travel height, and in
//! the end home. A contact, or a path that is traced, is a waypoint too, and so are the comments that announce the heat and
//! each seam: `resume` takes up a seam by them. Before a stop the iron goes up and home.

use crate::verify::judge::{HEIGHT, Judge};
use crate::verify::read::gcode::{BlindMove, Comment, Move, MoveKind};
use crate::verify::{FindingCode, Findings};
use geom::Point;
use spec::Heights;

/// The next event.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Waypoint {
    /// A rapid to this place; coordinates that are not known yet are `None`.
    Rapid([Option<f64>; 3]),
    /// The comment with this key.
    Comment(&'static str),
    /// Moves at the feed, however many.
    Path,
}

/// A path, and the stop before it.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    /// The place where the iron goes down.
    pub(super) start: Point,
    /// The keys of the comments at the stop before it; empty without a stop.
    pub(super) stop: Vec<&'static str>,
    /// Whether a wait follows it.
    pub(super) cools: bool,
}

/// Reports every rapid to another place, and every announcement in another place.
pub(super) struct TravelOrder {
    waypoints: Vec<Waypoint>,
    /// Number of waypoints passed.
    passed: usize,
    /// Slack on places, mm.
    tolerance: f64,
    /// Whether the last motion was along a path.
    on_path: bool,
}

impl TravelOrder {
    /// The way above `marks` and then along `legs`, each with an announcement of the key `title`.
    pub(super) fn new(
        heights: &Heights,
        marks: &[Point],
        legs: impl IntoIterator<Item = Leg>,
        title: Option<&'static str>,
        tolerance: f64,
    ) -> Self {
        let (park, travel) = (heights.park.0, heights.travel.0);
        let lift = Waypoint::Rapid([None, None, Some(park)]);
        let home = Waypoint::Rapid([Some(0.0), Some(0.0), Some(park)]);
        let mut position = [None, None, Some(park)];
        let mut waypoints = vec![Waypoint::Rapid(position)];
        for mark in marks {
            let [high, low] = [park, travel].map(|z| Waypoint::Rapid([Some(mark.x), Some(mark.y), Some(z)]));
            waypoints.extend([high, low, Waypoint::Comment("mark"), high]);
        }
        if !marks.is_empty() {
            waypoints.push(home);
        }
        for (Leg { start, stop, cools }, i) in legs.into_iter().zip(0..) {
            if i > 0 && !stop.is_empty() {
                // The end of the last path is checked by the path's judge.
                waypoints.extend([lift, home]);
                position[2] = Some(park);
            }
            waypoints.extend(stop.into_iter().map(Waypoint::Comment));
            position = [Some(start.x), Some(start.y), position[2]];
            waypoints.push(Waypoint::Rapid(position));
            position[2] = Some(travel);
            waypoints.push(Waypoint::Rapid(position));
            waypoints.extend(title.map(Waypoint::Comment));
            waypoints.push(Waypoint::Path);
            if cools {
                waypoints.push(Waypoint::Comment("cool"));
            }
        }
        waypoints.extend([lift, home]);
        Self { waypoints, passed: 0, tolerance, on_path: false }
    }

    /// Whether `waypoint` is the waypoint `expected`.
    fn is(&self, waypoint: &Waypoint, expected: &Waypoint) -> bool {
        let (Waypoint::Rapid(place), Waypoint::Rapid(expected_place)) = (waypoint, expected) else {
            return waypoint == expected;
        };
        let slacks = [self.tolerance, self.tolerance, HEIGHT];
        (0..3).all(|axis| {
            expected_place[axis].is_none_or(|expected_place| {
                place[axis].is_some_and(|place| (place - expected_place).abs() <= slacks[axis])
            })
        })
    }

    /// The next waypoint, as it was found.
    fn pass(&mut self, waypoint: &Waypoint, line: usize, findings: &mut Findings) {
        if self.waypoints.get(self.passed).is_some_and(|wanted| self.is(waypoint, wanted)) {
            self.passed += 1;
            return;
        }
        let allowed = self.waypoints.get(self.passed).map_or("the end".to_owned(), in_words);
        // If it comes later, what is between is missing; else it is one too many. Of many findings the first do.
        let place = if findings.is_full() { None } else { self.later_place(waypoint) };
        if let Some(place) = place {
            self.passed = place + 1;
        }
        let code = match waypoint {
            Waypoint::Comment(_) => FindingCode::OtherComment,
            _ => FindingCode::StrayTravel,
        };
        findings.add_at(code, line, in_words(waypoint), format!("{allowed} next"));
    }

    /// A later place in the order; the way up from the last path fits too many moves to be identified.
    fn later_place(&self, waypoint: &Waypoint) -> Option<usize> {
        (self.passed..self.waypoints.len())
            .find(|i| !is_vague(&self.waypoints[*i]) && self.is(waypoint, &self.waypoints[*i]))
    }
}

fn is_vague(expected: &Waypoint) -> bool {
    matches!(expected, Waypoint::Rapid([None, ..]))
}

impl Judge for TravelOrder {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        let was_on_path = std::mem::replace(&mut self.on_path, step.kind == MoveKind::Feed);
        if !self.on_path {
            self.pass(&Waypoint::Rapid([step.to.x, step.to.y, step.to.z].map(Some)), step.line, findings);
        } else if !was_on_path {
            self.pass(&Waypoint::Path, step.line, findings);
        }
    }

    fn blind(&mut self, step: &BlindMove, findings: &mut Findings) {
        self.on_path = false;
        self.pass(&Waypoint::Rapid(step.to), step.line, findings);
    }

    fn comment(&mut self, comment: &Comment, findings: &mut Findings) {
        let Some(key) = comment.key() else { return };
        let waypoints = ["heat", "seam", "pause", "cool", "tool", "cut", "mark", "beam"];
        if let Some(key) = waypoints.into_iter().find(|waypoint| *waypoint == key) {
            self.pass(&Waypoint::Comment(key), comment.line, findings);
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        if let Some(missing) = self.waypoints.get(self.passed) {
            findings.add(FindingCode::StrayTravel, "the end", format!("{} next", in_words(missing)));
        }
    }
}

/// A waypoint in words.
fn in_words(waypoint: &Waypoint) -> String {
    match waypoint {
        Waypoint::Rapid(to) => {
            let axis_text =
                |(name, value): (char, &Option<f64>)| value.map(|value| format!("{name}{value:.4}"));
            let axes: Vec<String> = "XYZ".chars().zip(to).filter_map(axis_text).collect();
            format!("G0 to {}", axes.join(" "))
        }
        Waypoint::Comment(key) => format!("the comment {key:?}"),
        Waypoint::Path => "moves at the feed".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::judge::judged;
    use crate::verify::read::gcode::Dialect;
    use spec::units::Length;

    const WAY: [&str; 10] = [
        "G0 Z30",
        "; heat: temperature_C=200",
        "M0",
        "G0 X10 Y20",
        "G0 Z5",
        "; seam: seam=1",
        "G1 X12 Y20 Z0 F6",
        "G1 X14 Y20 Z5",
        "G0 Z30",
        "G0 X0 Y0",
    ];

    /// Code and line (of the way, from 0) of each finding in it.
    fn findings_of(way: &[&str]) -> Vec<(&'static str, Option<usize>)> {
        let heights = Heights { contact: Length(0.0), travel: Length(5.0), park: Length(30.0) };
        let judge = TravelOrder::new(
            &heights,
            &[],
            [Leg { start: Point::new(10.0, 20.0), stop: vec!["heat"], cools: false }],
            Some("seam"),
            1e-3,
        );
        let text = format!("G21\nG90\nG94\n{}\nM2\n", way.join("\n"));
        let mut findings = Findings::default();
        let lines = text.split_inclusive('\n');
        let _ = judged(lines, Dialect::GENERIC, vec![Box::new(judge)], &mut findings);
        let findings = findings.into_vec();
        let is_ours = |code: &str| ["stray-travel", "other-comment"].contains(&code);
        let of_order = findings.iter().filter(|finding| is_ours(finding.code));
        of_order.map(|finding| (finding.code, finding.line.map(|line| line - 4))).collect()
    }

    #[test]
    fn the_way_of_a_job_is_found_right() {
        assert_eq!(findings_of(&WAY), []);
    }

    #[test]
    fn every_travel_and_announcement_has_its_place() {
        let changed = |at: usize, with: &[&'static str]| {
            let mut way = WAY.to_vec();
            let _ = way.splice(at..=at, with.iter().copied()).count();
            way
        };
        let stray = |line: usize| vec![("stray-travel", Some(line))];
        assert_eq!(findings_of(&changed(3, &["G0 X10 Y20", "G0 X80 Y80", "G0 X10 Y20"])).len(), 2);
        assert_eq!(findings_of(&changed(8, &["G0 Z30", "G0 X80 Y80"])), stray(9));
        assert_eq!(
            findings_of(&changed(9, &["G0 X0 Y1"])),
            [stray(9), vec![("stray-travel", None)]].concat()
        );
        assert_eq!(findings_of(&changed(8, &[])), [stray(8), vec![("stray-travel", None)]].concat());
        assert_eq!(findings_of(&changed(5, &[])), stray(5));
        let mut swapped = WAY;
        swapped.swap(5, 6);
        assert_eq!(findings_of(&swapped), [stray(5), vec![("other-comment", Some(6))]].concat());
        let mut early = WAY;
        early.swap(4, 5);
        assert_eq!(findings_of(&early), [vec![("other-comment", Some(4))], stray(5)].concat());
    }
}
