//! Where air can go: loops, closures, the channel between the bands.

use std::fmt;

use crate::design::{Design, LaidSeam, Refusal, RefusalCode, Refusals, Seam, Side, StarDesign};
use crate::geom::{
    Bounds, Path, Segment, intersections, path_distance, path_intersections, segment_distance,
};
use crate::spec::{KeyPath, Machine, Spec, key};

/// Gaps below this are rounding, mm.
const GAP: f64 = 1e-9;

/// What was found about the seams of one star. Lengths in mm, times in s.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// Every loop: what it is, whether it is closed, its overlap, and after how long the closure is sealed again.
    pub loops: Vec<Loop>,
    /// Distance between the starts of the two loops (of an open one: its nearer end).
    pub starts_apart: f64,
    /// Least width of the tube between the two bands.
    pub channel: f64,
    /// Width of the inlet's channel between its bands.
    pub inlet: Option<f64>,
    /// How much of a tip, and of a corner, the band eats: radius drawn, radius made.
    pub eaten: [(f64, f64); 2],
    /// Ways for air.
    pub leaks: Refusals,
    /// Places that may fail.
    pub weaknesses: Vec<String>,
}

/// One loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// "inner" or "outer".
    pub name: &'static str,
    /// Whether it returns to its start.
    pub closed: bool,
    /// Path sealed twice at the closure.
    pub overlap: f64,
    /// From the start, with overlap and ramps, to the next hinge; below 0 the closure lies over one.
    pub to_hinge: f64,
    /// Time between the two passes over the closure; 0 for an open loop.
    pub between_passes: f64,
}

/// What is to be said about one star.
#[derive(Default)]
struct Found {
    leaks: Refusals,
    weaknesses: Vec<String>,
}

impl Found {
    fn leak(&mut self, key: KeyPath, code: RefusalCode, found: String, remedy: &str) {
        self.leaks.push(Refusal::new(key, code, found, remedy.to_owned()));
    }
}

/// What the seams of `part` leave open.
pub fn passage(spec: &Spec, machine: &Machine, part: &StarDesign) -> Passage {
    let [inner, outer] = &part.seams;
    let band = part.band;
    let mut found = Found::default();
    let loops = [inner, outer].map(|seam| closure(spec, machine, seam, part.channel.is_some(), &mut found));
    crossings(part, &mut found);
    let channel = path_distance(&inner.center_line, &outer.center_line) - band;
    if channel <= 0.0 {
        let what = format!("the bands meet: {channel:.3} mm are left between them");
        found.leak(
            key::star::TUBE_WIDTH,
            RefusalCode::BandsMeet,
            what,
            "make tube_width larger, or the band narrower",
        );
    } else if channel < 0.99 * part.star.w {
        found
            .weaknesses
            .push(format!("the tube is {channel:.3} mm wide at its narrowest, of {} mm", part.star.w));
    }
    let inlet = mouth(part, &mut found);
    let nearest = |path: &Path, other: &Path| match (path.start(), other.start()) {
        (Some(a), Some(b)) => a.distance(b),
        _ => 0.0,
    };
    let starts_apart = nearest(&inner.center_line, &outer.center_line);
    if starts_apart < 2.0 * band + spec.seal.overlap.0 {
        found.weaknesses.push(format!("the two loops start only {starts_apart:.1} mm from each other"));
    }
    let (tip, corner) = (part.realised_tip(), part.realised_corner());
    let eaten = [(part.star.r_i, tip.radius), (part.star.r_e, corner.radius)];
    let Found { leaks, weaknesses } = found;
    Passage { loops: loops.into(), starts_apart, channel, inlet, eaten, leaks, weaknesses }
}

/// Where a seam meets the other, or itself.
fn crossings(part: &StarDesign, found: &mut Found) {
    let [inner, outer] = &part.seams;
    let both = path_intersections(&inner.center_line, &outer.center_line).len();
    if both > 0 {
        let what = format!("the two seams cross or touch in {both} places");
        let remedy = "make tube_width larger, or the band narrower";
        found.leak(key::star::TUBE_WIDTH, RefusalCode::SeamsCross, what, remedy);
    }
    for seam in [inner, outer] {
        let own = self_crossings(&seam.center_line);
        if own > 0 {
            let what = format!("the {} seam crosses itself in {own} places", seam.side.loop_name());
            let remedy = "make band narrower, or the arms longer";
            found.leak(key::seal::BAND, RefusalCode::SeamCrossesItself, what, remedy);
        }
    }
}

/// Width of the inlet's mouth between its bands, mm, if there is an inlet.
fn mouth(part: &StarDesign, found: &mut Found) -> Option<f64> {
    let [_, outer] = &part.seams;
    let needed = 2.0 * part.channel?.half_width;
    let ends = outer.center_line.start().zip(outer.center_line.end());
    let width = ends.map_or(0.0, |(a, b)| a.distance(b)) - part.band;
    if width < needed - 1e-6 {
        let what = format!("the inlet's mouth is {width:.3} mm wide, too narrow for the hose");
        let remedy = format!("it needs {needed:.3} mm: make tube_diameter smaller");
        found.leak(key::inlet::TUBE_DIAMETER, RefusalCode::NarrowMouth, what, &remedy);
    }
    Some(width)
}

/// The ways for air out of a pouch but its mouth, which a hose needs `mouth` mm wide between bands of `band` mm.
pub fn pouch_leaks(seam: &LaidSeam, band: f64, mouth: f64) -> Vec<Refusal> {
    let (name, path, mut found) = (&seam.name, &seam.run, Found::default());
    if path.largest_gap() > GAP {
        let what = format!("a gap of {:.6} mm in the {name}", path.largest_gap());
        found.leak(key::seal::BAND, RefusalCode::SeamGap, what, "a seam has no gap: try another band");
    }
    let own = self_crossings(path);
    if own > 0 {
        let what = format!("the {name} crosses itself in {own} places");
        found.leak(
            key::seal::BAND,
            RefusalCode::SeamCrossesItself,
            what,
            "make band narrower, or the arms longer",
        );
    }
    let width = path.start().zip(path.end()).map_or(0.0, |(a, b)| a.distance(b)) - band;
    if width < mouth - 1e-6 {
        let what = format!("the mouth in the {name} is {width:.3} mm wide, too narrow for the hose");
        let remedy = format!("it needs {mouth:.3} mm: make tube_diameter smaller");
        found.leak(key::inlet::TUBE_DIAMETER, RefusalCode::NarrowMouth, what, &remedy);
    }
    found.leaks.into_iter().collect()
}

fn closure(spec: &Spec, machine: &Machine, seam: &Seam, has_inlet: bool, found: &mut Found) -> Loop {
    let path = &seam.center_line;
    let (name, may_open) = (seam.side.loop_name(), seam.side == Side::Outside && has_inlet);
    if path.largest_gap() > GAP {
        let what = format!("a gap of {:.6} mm in the {name} seam", path.largest_gap());
        found.leak(key::seal::BAND, RefusalCode::SeamGap, what, "a seam has no gap: try another band");
    }
    if path.closed == may_open {
        let is = if path.closed { "closed, and the inlet with it" } else { "open without an inlet" };
        found.leak(
            key::inlet::NONE,
            RefusalCode::WrongOpening,
            format!("the {name} loop is {is}"),
            "change [inlet]",
        );
    }
    let run = seam.run();
    let twice = run.length() - path.length();
    if path.closed {
        if (twice - seam.overlap).abs() > 1e-6 || seam.overlap <= 0.0 {
            let what = format!("the {name} loop closes with an overlap of {twice:.3} mm");
            let remedy = format!("overlap must be above 0 mm: at least the band of {}", spec.seal.band);
            found.leak(key::seal::OVERLAP, RefusalCode::NoOverlap, what, &remedy);
        } else if seam.overlap < spec.seal.band.0 {
            found.weaknesses.push(format!(
                "the {name} loop closes with an overlap of {} mm, less than the band of {}",
                seam.overlap, spec.seal.band
            ));
        }
    }
    // The start lies inside a straight segment, whose two halves are the first and the last.
    let straight = |segment: Option<&Segment>| match segment {
        Some(Segment::Line(line)) => line.length(),
        _ => 0.0,
    };
    let (ahead, behind) = (straight(path.segments.first()), straight(path.segments.last()));
    let to_hinge = if path.closed {
        (ahead - seam.overlap - machine.process.ramp.0).min(behind - machine.process.ramp.0)
    } else {
        ahead.min(behind)
    };
    if path.closed && ahead.min(behind) <= 0.0 {
        found.weaknesses.push(format!("the {name} loop starts on a hinge"));
    }
    let between_passes = if path.closed { path.length() / spec.seal.speed.0 } else { 0.0 };
    Loop { name, closed: path.closed, overlap: twice, to_hinge, between_passes }
}

/// How often a path meets itself, neighbours left out.
fn self_crossings(path: &Path) -> usize {
    let (segments, n) = (&path.segments, path.segments.len());
    let pairs = (0..n).flat_map(|i| (i + 2..n).map(move |j| (i, j)));
    pairs
        .filter(|(i, j)| !(path.closed && *i == 0 && *j == n - 1))
        .filter(|(i, j)| !intersections(&segments[*i], &segments[*j]).is_empty())
        .count()
}

/// Least distance between the bands of two stars on one sheet; `None` where there is only one.
pub(super) fn between_stars(design: &Design) -> Option<f64> {
    let lines = |index: usize| {
        let placed = &design.stars[index];
        let part = design.part(placed);
        let paths = part.seams.iter().map(move |seam| placed.placement.path(&seam.center_line));
        let segments = paths.flat_map(|path| path.segments).map(|segment| (segment, segment.bounds()));
        let segments: Vec<(Segment, Bounds)> = segments.collect();
        let around = segments.iter().map(|(_, bounds)| *bounds).fold(Bounds::EMPTY, Bounds::union);
        (placed.sheet, part.band, around, segments)
    };
    let all: Vec<_> = (0..design.stars.len()).map(lines).collect();
    let mut least: Option<f64> = None;
    for (i, (sheet, band, around, a)) in all.iter().enumerate() {
        for (_, _, other, b) in all[i + 1..].iter().filter(|(other, ..)| other == sheet) {
            let reach = |least: Option<f64>| least.unwrap_or(f64::INFINITY).min(1e3) + band;
            if !around.grown(reach(least)).overlaps(other) {
                continue;
            }
            for (s, bounds) in a {
                let zone = bounds.grown(reach(least));
                if !zone.overlaps(other) {
                    continue;
                }
                for (t, _) in b.iter().filter(|(_, bounds)| zone.overlaps(bounds)) {
                    let distance = segment_distance(s, t) - band;
                    least = Some(least.map_or(distance, |known| known.min(distance)));
                }
            }
        }
    }
    least
}

impl fmt::Display for Passage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Loop { name, closed, overlap, to_hinge, between_passes } in &self.loops {
            if *closed {
                let over = if *to_hinge < 0.0 { "over a hinge" } else { "on a straight arm" };
                let hours = between_passes / 3600.0;
                writeln!(
                    f,
                    "    {name} loop: closed {over}, {overlap:.1} mm sealed twice, {hours:.1} h between the passes"
                )?;
            } else {
                writeln!(f, "    {name} loop: opened by the inlet only")?;
            }
        }
        writeln!(
            f,
            "    starts {:.1} mm apart; tube {:.2} mm wide between the bands at its narrowest",
            self.starts_apart, self.channel
        )?;
        if let Some(inlet) = self.inlet {
            writeln!(f, "    inlet {inlet:.2} mm wide between its bands")?;
        }
        for (what, (drawn, made)) in ["tips", "corners"].iter().zip(self.eaten) {
            if made > drawn {
                writeln!(f, "    {what}: drawn with R {drawn:.2} mm, the band makes it {made:.2} mm")?;
            }
        }
        Ok(())
    }
}
