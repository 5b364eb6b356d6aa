//! The order of sealing, and where closed seams start.

use std::collections::{BTreeMap, BTreeSet};

use crate::layout::{Line, LineUse};
use geom::{Path, Point, Segment};

/// The lines in the order of sealing: inner ones first, the outer edges last, so that the iron seldom passes over finished bands;
/// among those of a kind the nearest next, open ones from their nearer end.
pub(super) fn ordered(mut lines: Vec<Line>) -> Vec<Line> {
    for line in &mut lines {
        if line.path.closed {
            line.path = well_started(&line.path);
        }
    }
    let mut ordered = Vec::with_capacity(lines.len());
    let mut at = Point::ORIGIN;
    for stage in [LineUse::Weld, LineUse::Island, LineUse::Outer] {
        // Walls go with the welds: both end in other bands or in the air.
        let kind = |line: &Line| if line.kind == LineUse::Wall { LineUse::Weld } else { line.kind };
        let (own, rest): (Vec<Line>, Vec<Line>) = lines.into_iter().partition(|line| kind(line) == stage);
        lines = rest;
        let mut ends: Vec<Ends> = own.iter().enumerate().map(Ends::of).collect();
        let mut left: Vec<Option<Line>> = own.into_iter().map(Some).collect();
        while let Some((next, backwards)) = nearest(&ends, at) {
            let Ends { number, .. } = ends.remove(next);
            let Some(mut line) = left[number].take() else { break };
            if backwards {
                line.path = line.path.reversed();
                line.joined.reverse();
            }
            at = line.path.end().unwrap_or(at);
            ordered.push(line);
        }
    }
    ordered
}

/// The start of a line, and its end if it may be sealed from there.
struct Ends {
    number: usize,
    ends: [Option<Point>; 2],
}

impl Ends {
    fn of((number, line): (usize, &Line)) -> Self {
        let end = if line.path.closed { None } else { line.path.end() };
        Self { number, ends: [line.path.start(), end] }
    }
}

/// The place in `lines` of the one that begins nearest to `at`, and whether its end does.
fn nearest(lines: &[Ends], at: Point) -> Option<(usize, bool)> {
    let mut best: Option<(f64, usize, bool)> = None;
    for (place, line) in lines.iter().enumerate() {
        for (end, backwards) in line.ends.iter().zip([false, true]) {
            let far = end.map_or(f64::INFINITY, |end| end.distance(at));
            if best.is_none_or(|(least, ..)| far < least) {
                best = Some((far, place, backwards));
            }
        }
    }
    best.map(|(_, place, backwards)| (place, backwards))
}

/// Straight segments shorter than this are not looked for as a start, mm: the ways down and up would leave them soon, and some are rounding.
const STRAIGHT: f64 = 1.0;

/// A closed path from the middle of its longest straight segment of some length, or else of its longest segment.
fn well_started(path: &Path) -> Path {
    let mut best: Option<(bool, f64, f64)> = None;
    let mut before = 0.0;
    for segment in &path.segments {
        let length = segment.length();
        let straight = matches!(segment, Segment::Line(_)) && length >= STRAIGHT;
        let better =
            best.is_none_or(
                |(known, least, _)| {
                    if straight == known { length > least * (1.0 + 1e-9) } else { straight }
                },
            );
        if better {
            best = Some((straight, length, before + length / 2.0));
        }
        before += length;
    }
    best.map_or_else(|| path.clone(), |(_, _, s)| path.starting_at(s))
}

/// The names of seams: the drawn names where a program can hold them, else the purpose of the seam. No two are alike.
pub(super) fn seam_names(lines: &[Line]) -> Vec<String> {
    let mut used: BTreeSet<String> = BTreeSet::new();
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut names = Vec::with_capacity(lines.len());
    let outers = lines.iter().filter(|line| line.kind == LineUse::Outer).count();
    for line in lines {
        let (word, alone) = match line.kind {
            LineUse::Outer => ("outer", outers == 1),
            LineUse::Island => ("island", false),
            LineUse::Wall => ("wall", false),
            LineUse::Weld => ("weld", false),
        };
        let drawn = match line.names.as_slice() {
            [name] => safe(name),
            _ => String::new(),
        };
        let base = if drawn.is_empty() { word.to_owned() } else { drawn.clone() };
        // Numbers of a word go up, so that no name is tried twice.
        let number = numbers.entry(base.clone()).or_insert(0);
        let name = loop {
            *number += 1;
            let plain = *number == 1 && (alone || !drawn.is_empty());
            let name = if plain { base.clone() } else { format!("{base}-{number}") };
            if used.insert(name.clone()) {
                break name;
            }
        };
        names.push(name);
    }
    names
}

/// The name with letters, digits, "-" and "_" only; empty if it has no letter.
fn safe(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let safe: String = name.chars().take(40).map(|c| if plain(c) { c } else { '-' }).collect();
    let safe = safe.trim_matches('-').to_owned();
    if safe.chars().any(|c| c.is_ascii_alphabetic()) { safe } else { String::new() }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use geom::{Arc, Line as Chord};

    fn line(kind: LineUse, name: &str, x: f64, y: f64) -> Line {
        let p = |dx: f64, dy: f64| Point::new(x + dx, y + dy);
        let corners = [p(0.0, 0.0), p(9.0, 0.0), p(9.0, 4.0), p(0.0, 4.0), p(0.0, 0.0)];
        let segments = corners.windows(2).map(|pair| Chord::new(pair[0], pair[1]).into()).collect();
        let closed = matches!(kind, LineUse::Outer | LineUse::Island);
        let path = if closed { Path::closed(segments) } else { Path::open(segments[..1].to_vec()) };
        Line { path, names: vec![name.to_owned()], kind, joined: [false, true] }
    }

    #[test]
    fn inner_seams_come_first_and_the_nearest_next() {
        let lines = vec![
            line(LineUse::Outer, "rim", 0.0, 0.0),
            line(LineUse::Island, "far", 200.0, 0.0),
            line(LineUse::Island, "near", 60.0, 0.0),
            line(LineUse::Wall, "wall", 40.0, 0.0),
            line(LineUse::Weld, "weld", 20.0, 0.0),
        ];
        let ordered = ordered(lines);
        assert_eq!(seam_names(&ordered), ["weld", "wall", "near", "far", "rim"]);
        // Closed ones start in the middle of their longest straight segment.
        assert_eq!(ordered[2].path.start(), Some(Point::new(64.5, 0.0)));
        let backwards = super::ordered(vec![line(LineUse::Weld, "w", -9.0, 0.0)]);
        assert_eq!(backwards[0].path.start(), Some(Point::new(0.0, 0.0)));
        assert_eq!(backwards[0].joined, [true, false]);
    }

    /// A line of a micrometre between round ones is rounding: the seam does not begin there.
    #[test]
    fn a_crumb_is_no_start() {
        let half = |x: f64, from: f64| Arc::new(Point::new(x, 0.0), 9.0, from, PI).into();
        let crumb = |x: f64, y: f64, dx: f64| Chord::new(Point::new(x, y), Point::new(x + dx, y)).into();
        let rim =
            vec![crumb(0.0, -9.0, 1e-3), half(1e-3, -PI / 2.0), crumb(1e-3, 9.0, -1e-3), half(0.0, PI / 2.0)];
        let start = well_started(&Path::closed(rim)).start().unwrap();
        assert!((start.x.abs() - 9.0).abs() < 0.01, "{start:?}");
    }

    #[test]
    fn names_can_stand_in_a_program_and_differ() {
        let named = |kind, name| line(kind, name, 0.0, 0.0);
        let lines = [
            named(LineUse::Weld, "a b;c"),
            named(LineUse::Weld, "a b;c"),
            named(LineUse::Weld, "12"),
            named(LineUse::Island, ""),
            named(LineUse::Outer, "(x"),
            named(LineUse::Outer, ""),
        ];
        assert_eq!(seam_names(&lines), ["a-b-c", "a-b-c-2", "weld-1", "island-1", "x", "outer-1"]);
    }
}
