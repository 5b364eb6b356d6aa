//! The ways for air: loops, closures, the channel between the bands.

use std::fmt;

use crate::airtight::shape_leaks;
use design::{Design, FlatPiece, Refusal, RefusalCode, Refusals};
use geom::{Bounds, Segment, path_distance, segment_distance};
use sealed::{Role, Seam, seam_in_words};
use spec::units::Readable;
use spec::{Machine, Spec, key};

/// The passages of one piece. Lengths in mm, times in s.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// All loops: name, whether it is closed, its overlap, and the time until the closure is sealed again.
    pub loops: Vec<Loop>,
    /// Distance between the starts of the two loops of a star.
    pub starts_apart: Option<f64>,
    /// Least width of the tube between the bands; `None` if a drawing has no width below `least_passage`.
    pub channel: Option<f64>,
    /// Width below which a drawing's passages are warned of.
    pub least_passage: Option<f64>,
    /// Width of the inlet's channel between its bands.
    pub inlet: Option<f64>,
    /// Number of inlets.
    pub inlets: usize,
    /// Number of valves in the face.
    pub valves: usize,
    /// Loss of radius at a tip and a corner by the band's width: drawn radius, made radius; for stars only.
    pub eaten: Option<[(f64, f64); 2]>,
    /// Leaks of the piece.
    pub leaks: Refusals,
    /// Places that may fail.
    pub weaknesses: Vec<String>,
}

/// One loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// The seam's name in words: "inner loop" of a star, "crease-left" of a drawing.
    pub name: String,
    /// Purpose of the seam.
    pub role: Role,
    /// Whether it returns to its start.
    pub closed: bool,
    /// Path sealed twice at the closure.
    pub overlap: f64,
    /// Distance from the start, with overlap and ramps, to the next hinge; negative if the closure lies over a hinge.
    pub to_hinge: f64,
    /// Time between the two passes over the closure; 0 for an open loop.
    pub between_passes: f64,
}

/// The passages that the seams of `part` leave open.
pub fn passage(spec: &Spec, machine: &Machine, part: FlatPiece<'_>) -> Passage {
    let (shape, band) = (part.shape(), part.shape().band);
    let is_star = matches!(part, FlatPiece::Star(_));
    let mut leaks: Refusals = shape_leaks(shape, is_star).into_iter().collect();
    let mut weaknesses = Vec::new();
    // A press makes all of a loop at once: it has neither a start nor an overlap.
    let is_ironed = spec.press.is_none();
    let ironed_seams = shape.seams.iter().filter(|_| is_ironed);
    let loops = ironed_seams
        .map(|seam| closure(spec, machine, (seam, is_star), &mut leaks, &mut weaknesses))
        .collect();
    let seams = shape.seams.iter().enumerate();
    let pairs = seams.flat_map(|(i, a)| shape.seams[i + 1..].iter().map(move |b| (a, b)));
    let center_distance = |(a, b): (&Seam, &Seam)| path_distance(&a.center_line, &b.center_line);
    let (channel, least_passage, eaten) = match part {
        FlatPiece::Star(star) => {
            let [tip, corner] = [star.realised_tip(), star.realised_corner()].map(|made| made.radius);
            let channel = pairs.clone().map(center_distance).fold(f64::INFINITY, f64::min) - band;
            (Some(channel), None, Some([(star.star.r_i, tip), (star.star.r_e, corner)]))
        }
        // Bands of a drawing may join; its passages were measured when it was read.
        FlatPiece::Drawn(piece) => (piece.passage, Some(piece.least_passage), None),
    };
    let width = part.tube_width();
    if let Some(channel) = channel.filter(|channel| *channel <= 0.0) {
        let problem = format!("the bands meet: {channel:.3} mm are left between them");
        let remedy = "make tube_width larger, or the band narrower";
        leaks.push(Refusal::new(key::star::TUBE_WIDTH, RefusalCode::BandsMeet, problem, remedy));
    } else if let Some(channel) = channel.filter(|channel| is_star && *channel < 0.99 * width) {
        weaknesses.push(format!("the tube is {channel:.3} mm wide at its narrowest, of {width} mm"));
    }
    let inlet = shape.ports.first().map(|_| shape.port_width(0).unwrap_or(0.0));
    let starts = |(a, b): (&Seam, &Seam)| Some(a.center_line.start()?.distance(b.center_line.start()?));
    let starts_apart = (is_star && is_ironed).then(|| pairs.filter_map(starts).fold(f64::INFINITY, f64::min));
    if let Some(distance) = starts_apart.filter(|distance| *distance < 2.0 * band + spec.seal.overlap.0) {
        weaknesses.push(format!("the two loops start only {distance:.1} mm from each other"));
    }
    let (inlets, valves) = (shape.ports.len(), shape.valves.len());
    Passage { loops, starts_apart, channel, least_passage, inlet, inlets, valves, eaten, leaks, weaknesses }
}

fn closure(
    spec: &Spec,
    machine: &Machine,
    (seam, is_star): (&Seam, bool),
    leaks: &mut Refusals,
    weaknesses: &mut Vec<String>,
) -> Loop {
    let (path, name) = (&seam.center_line, seam_in_words(is_star, &seam.name));
    let run = seam.run();
    let twice = run.length() - path.length();
    if path.closed {
        if (twice - seam.overlap).abs() > 1e-6 || seam.overlap <= 0.0 {
            let problem = format!("the {name} closes with an overlap of {twice:.3} mm");
            let remedy = format!("overlap must be above 0 mm: at least the band of {}", spec.seal.band);
            leaks.push(Refusal::new(key::seal::OVERLAP, RefusalCode::NoOverlap, problem, remedy));
        } else if seam.overlap < spec.seal.band.0 {
            weaknesses.push(format!(
                "the {name} closes with an overlap of {} mm, less than the band of {}",
                seam.overlap, spec.seal.band
            ));
        }
    }
    // The start lies inside a straight segment, whose two halves are the first and the last.
    let [ahead, last_length] = [path.segments.first(), path.segments.last()].map(|segment| match segment {
        Some(Segment::Line(line)) => line.length(),
        _ => 0.0,
    });
    let to_hinge = if path.closed {
        (ahead - seam.overlap - machine.process.ramp.0).min(last_length - machine.process.ramp.0)
    } else {
        ahead.min(last_length)
    };
    // The seal's load is largest at a star's hinge; a drawing has no hinge.
    if is_star && path.closed && ahead.min(last_length) <= 0.0 {
        weaknesses.push(format!("the {name} starts on a hinge"));
    }
    let between_passes = if path.closed { path.length() / spec.seal.speed.0 } else { 0.0 };
    Loop { name, role: seam.role, closed: path.closed, overlap: twice, to_hinge, between_passes }
}

/// Least distance between the bands of two pieces on one sheet; `None` if no sheet has two.
pub(super) fn between_pieces(design: &Design) -> Option<f64> {
    // The boxes of pieces and of segments leave out what lies farther away than the least distance so far. Distances
    // are those of centre lines, less a band.
    let lines = |index: usize| {
        let placed = &design.placed()[index];
        let shape = design.part(placed).shape();
        let paths = shape.seams.iter().map(move |seam| placed.placement.path(&seam.center_line));
        let segments = paths.flat_map(|path| path.segments).map(|segment| (segment, segment.bounds()));
        let segments: Vec<(Segment, Bounds)> = segments.collect();
        let piece_bounds = segments.iter().map(|(_, bounds)| *bounds).fold(Bounds::EMPTY, Bounds::union);
        (placed.sheet, shape.band, piece_bounds, segments)
    };
    let pieces: Vec<_> = (0..design.placed().len()).map(lines).collect();
    let mut least_distance: Option<f64> = None;
    for (i, (sheet, band, around, a)) in pieces.iter().enumerate() {
        for (_, _, other, b) in pieces[i + 1..].iter().filter(|(other, ..)| other == sheet) {
            if !around.outset(reach(least_distance, *band)).overlaps(other) {
                continue;
            }
            for (s, bounds) in a {
                let zone = bounds.outset(reach(least_distance, *band));
                if !zone.overlaps(other) {
                    continue;
                }
                for (t, _) in b.iter().filter(|(_, bounds)| zone.overlaps(bounds)) {
                    let distance = segment_distance(s, t) - band;
                    least_distance = Some(least_distance.map_or(distance, |known| known.min(distance)));
                }
            }
        }
    }
    least_distance
}

/// The distance beyond which nothing is searched, if the least distance so far is known.
fn reach(least_distance: Option<f64>, band: f64) -> f64 {
    least_distance.unwrap_or(f64::INFINITY).min(1e3) + band
}

impl fmt::Display for Passage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // One line for each loop with the way it closes, then the narrowest passages. Drawings have no channel between
        // two loops: they state the narrowest passage. The hinges follow that the band makes rounder than drawn.
        for Loop { name, role, closed, overlap, to_hinge, between_passes } in &self.loops {
            if *closed {
                let closing_place = match self.eaten {
                    None => "",
                    Some(_) if *to_hinge < 0.0 => " over a hinge",
                    Some(_) => " on a straight arm",
                };
                let hours = between_passes / 3600.0;
                writeln!(
                    f,
                    "    {name}: closed{closing_place}, {overlap:.1} mm sealed twice, {hours:.1} h between the passes"
                )?;
            } else if *role == Role::Weld {
                writeln!(f, "    {name}: a weld from end to end")?;
            } else if self.eaten.is_none() {
                writeln!(f, "    {name}: has no open ends")?;
            } else {
                writeln!(f, "    {name}: opened by the inlet only")?;
            }
        }
        let starts = self.starts_apart.map_or(String::new(), |apart| format!("starts {apart:.1} mm apart; "));
        if let Some(channel) = self.channel {
            writeln!(f, "    {starts}tube {channel:.2} mm wide between the bands at its narrowest")?;
        } else {
            let least_passage = Readable(self.least_passage.unwrap_or(0.0));
            let hose = if self.inlet.is_some() { " but the hose's channel" } else { "" };
            writeln!(f, "    no passage{hose} is narrower than {least_passage} mm")?;
        }
        if let Some(inlet) = self.inlet {
            writeln!(f, "    inlet {inlet:.2} mm wide between its bands")?;
        }
        for (what, (drawn, made)) in ["tips", "corners"].iter().zip(self.eaten.into_iter().flatten()) {
            if made > drawn {
                writeln!(f, "    {what}: drawn with R {drawn:.2} mm, the band makes it {made:.2} mm")?;
            }
        }
        Ok(())
    }
}
