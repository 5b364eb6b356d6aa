//! The order of sealing, and where closed seams start.

use std::collections::{BTreeMap, BTreeSet};

use crate::bands::{Band, BandKind};
use geom::{Path, Point, Segment};

/// The bands in the order of sealing: inner ones first, the outer edges last, so that the iron seldom passes over finished bands;
/// among those of a kind the nearest next, open ones from their nearer end. Walls go with the welds: both end in other bands or in the air.
pub(super) fn ordered(mut bands: Vec<Band>) -> Vec<Band> {
    for band in &mut bands {
        if band.path.closed {
            band.path = well_started(&band.path);
        }
    }
    let mut ordered = Vec::with_capacity(bands.len());
    let mut position = Point::ORIGIN;
    let stages: [&[BandKind]; 3] =
        [&[BandKind::Weld, BandKind::Wall], &[BandKind::Island], &[BandKind::Outer]];
    for kinds in stages {
        let (stage, rest): (Vec<Band>, Vec<Band>) =
            bands.into_iter().partition(|band| kinds.contains(&band.kind));
        bands = rest;
        let mut ends: Vec<Ends> =
            stage.iter().enumerate().map(|(number, band)| Ends::new(number, band)).collect();
        let mut remaining: Vec<Option<Band>> = stage.into_iter().map(Some).collect();
        while let Some((next, backwards)) = nearest(&ends, position) {
            let Ends { number, .. } = ends.remove(next);
            let Some(mut band) = remaining[number].take() else { break };
            if backwards {
                band.path = band.path.reversed();
                band.joined.reverse();
            }
            position = band.path.end().unwrap_or(position);
            ordered.push(band);
        }
    }
    ordered
}

/// The start of a band, and its end if it may be sealed from there.
struct Ends {
    number: usize,
    ends: [Option<Point>; 2],
}

impl Ends {
    /// The ends of the band number `number`.
    fn new(number: usize, band: &Band) -> Self {
        let end = if band.path.closed { None } else { band.path.end() };
        Self { number, ends: [band.path.start(), end] }
    }
}

/// The place in `bands` of the one that begins nearest to `position`, and whether its end does.
fn nearest(bands: &[Ends], position: Point) -> Option<(usize, bool)> {
    let mut best: Option<(f64, usize, bool)> = None;
    for (place, band) in bands.iter().enumerate() {
        for (end, backwards) in band.ends.iter().zip([false, true]) {
            let distance = end.map_or(f64::INFINITY, |end| end.distance(position));
            if best.is_none_or(|(least, ..)| distance < least) {
                best = Some((distance, place, backwards));
            }
        }
    }
    best.map(|(_, place, backwards)| (place, backwards))
}

/// Straight segments shorter than this are not looked for as a start, mm: the ways down and up would leave them soon, and some are rounding.
const STRAIGHT: f64 = 1.0;

/// A closed path from the middle of its longest straight segment of some length, or else of its longest segment.
fn well_started(path: &Path) -> Path {
    let mut best: Option<SeamStart> = None;
    let mut length_before = 0.0;
    for segment in &path.segments {
        let length = segment.length();
        let is_straight = matches!(segment, Segment::Line(_)) && length >= STRAIGHT;
        let start = SeamStart { is_straight, length, station: length_before + length / 2.0 };
        if best.as_ref().is_none_or(|best| start.is_better(best)) {
            best = Some(start);
        }
        length_before += length;
    }
    best.map_or_else(|| path.clone(), |best| path.starting_at(best.station))
}

/// A place where a closed path may start: the middle of a segment.
struct SeamStart {
    /// Whether the segment is straight, and of some length.
    is_straight: bool,
    /// Length of the segment, mm.
    length: f64,
    /// Length of the path before the place, mm.
    station: f64,
}

impl SeamStart {
    /// Whether the segment is straight where the other is not, or longer by more than rounding.
    fn is_better(&self, other: &Self) -> bool {
        let is_longer = self.length > other.length * (1.0 + 1e-9);
        if self.is_straight == other.is_straight { is_longer } else { self.is_straight }
    }
}

/// The names of seams: the drawn names where a program can hold them, else the purpose of the seam. No two are alike.
pub(super) fn seam_names(bands: &[Band]) -> Vec<String> {
    let mut unique: BTreeSet<String> = BTreeSet::new();
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut names = Vec::with_capacity(bands.len());
    let outer_count = bands.iter().filter(|band| band.kind == BandKind::Outer).count();
    for band in bands {
        let (word, is_only) = match band.kind {
            BandKind::Outer => ("outer", outer_count == 1),
            BandKind::Island => ("island", false),
            BandKind::Wall => ("wall", false),
            BandKind::Weld => ("weld", false),
        };
        let drawn_name = match band.names.as_slice() {
            [name] => program_name(name),
            _ => String::new(),
        };
        let base = if drawn_name.is_empty() { word.to_owned() } else { drawn_name.clone() };
        // Numbers of a word go up, so that no name is tried twice.
        let number = numbers.entry(base.clone()).or_insert(0);
        let name = loop {
            *number += 1;
            let is_plain = *number == 1 && (is_only || !drawn_name.is_empty());
            let name = if is_plain { base.clone() } else { format!("{base}-{number}") };
            if unique.insert(name.clone()) {
                break name;
            }
        };
        names.push(name);
    }
    names
}

/// The name with letters, digits, "-" and "_" only; empty if it has no letter.
fn program_name(name: &str) -> String {
    let is_plain = |c: &char| c.is_ascii_alphanumeric() || *c == '_' || *c == '-';
    let letters = name.chars().take(40).map(|c| Some(c).filter(is_plain).unwrap_or('-'));
    let word: String = letters.collect();
    let word = word.trim_matches('-').to_owned();
    if word.chars().any(|c| c.is_ascii_alphabetic()) { word } else { String::new() }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use geom::{Arc, Line as Chord};

    fn band(kind: BandKind, name: &str, x: f64, y: f64) -> Band {
        let corners = [[0.0, 0.0], [9.0, 0.0], [9.0, 4.0], [0.0, 4.0], [0.0, 0.0]]
            .map(|[dx, dy]| Point::new(x + dx, y + dy));
        let segments = corners.windows(2).map(|pair| Chord::new(pair[0], pair[1]).into()).collect();
        let closed = matches!(kind, BandKind::Outer | BandKind::Island);
        let path = if closed { Path::closed(segments) } else { Path::open(segments[..1].to_vec()) };
        Band { path, names: vec![name.to_owned()], kind, joined: [false, true] }
    }

    #[test]
    fn inner_seams_come_first_and_the_nearest_next() {
        let bands = vec![
            band(BandKind::Outer, "rim", 0.0, 0.0),
            band(BandKind::Island, "far", 200.0, 0.0),
            band(BandKind::Island, "near", 60.0, 0.0),
            band(BandKind::Wall, "wall", 40.0, 0.0),
            band(BandKind::Weld, "weld", 20.0, 0.0),
        ];
        let ordered = super::ordered(bands);
        assert_eq!(seam_names(&ordered), ["weld", "wall", "near", "far", "rim"]);
        // Closed ones start in the middle of their longest straight segment.
        assert_eq!(ordered[2].path.start(), Some(Point::new(64.5, 0.0)));
        let backwards = super::ordered(vec![band(BandKind::Weld, "w", -9.0, 0.0)]);
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
        let bands = [
            (BandKind::Weld, "a b;c"),
            (BandKind::Weld, "a b;c"),
            (BandKind::Weld, "12"),
            (BandKind::Island, ""),
            (BandKind::Outer, "(x"),
            (BandKind::Outer, ""),
        ]
        .map(|(kind, name)| band(kind, name, 0.0, 0.0));
        assert_eq!(seam_names(&bands), ["a-b-c", "a-b-c-2", "weld-1", "island-1", "x", "outer-1"]);
    }
}
