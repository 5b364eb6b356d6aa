//! G-code of the plain subset that every controller reads.
//!
//! End points are rounded first; an arc's centre is then computed from the rounded points and the
//! exact radius, so that start, end and centre of every line of the file agree with each other.
//! Comments of the form `; key: word=value ...` carry what a reader of the file alone needs to know;
//! the last line, after the program's end, counts the lines, so that a file cut short shows.

use std::fmt::Write;

use crate::emit::number::Decimals;
use crate::emit::text::inert;
use crate::geom::Point;
use crate::geom::Segment;
use crate::plan::Level;
use crate::plan::Program;
use crate::plan::Purpose;
use crate::plan::Ramp;
use crate::plan::SeamReport;
use crate::plan::Step;
use crate::spec::Machine;
use crate::spec::Spec;
use crate::units::Temperature;

/// The program as text.
pub fn gcode(spec: &Spec, machine: &Machine, program: &Program) -> String {
    let mut writer = Writer::new(spec, machine);
    writer.header(program);
    for step in &program.steps {
        writer.step(program, step);
    }
    for line in &machine.end {
        writer.line(line);
    }
    let lines = writer.lines + 1;
    writer.line(&format!("; end of program, {lines} lines"));
    writer.out
}

struct Writer<'a> {
    spec: &'a Spec,
    machine: &'a Machine,
    decimals: Decimals,
    out: String,
    lines: usize,
    /// Where the iron is, as the file says.
    at: Point,
    /// The feed in force, mm/min.
    feed: Option<f64>,
}

impl<'a> Writer<'a> {
    fn new(spec: &'a Spec, machine: &'a Machine) -> Self {
        let decimals = Decimals::for_tolerance(spec.accuracy.path);
        Self {
            spec,
            machine,
            decimals,
            out: String::with_capacity(1 << 14),
            lines: 0,
            at: Point::ORIGIN,
            feed: None,
        }
    }

    fn line(&mut self, text: &str) {
        self.out.push_str(text);
        self.end_line();
    }

    fn end_line(&mut self) {
        self.out.push('\n');
        self.lines += 1;
    }

    /// A comment, cut to the length that the controller reads.
    fn comment(&mut self, text: &str) {
        let room = self.machine.line_length.saturating_sub(2);
        let text = inert(text, room);
        self.line(format!("; {text}").trim_end());
    }

    fn header(&mut self, program: &Program) {
        let spec = self.spec;
        let purpose = match program.purpose {
            Purpose::Seal => "seal",
            Purpose::Trace => "trace",
        };
        self.comment(&format!("stargrip-cam {purpose} program"));
        self.comment(&format!("name: {}", spec.name));
        self.comment(&format!("program: purpose={purpose} sheet={} stars={}", program.sheet, stars(program)));
        self.comment("frame: origin at lower left of the sheet, Z0 on the release layer");
        if program.purpose == Purpose::Seal {
            let (t, v) = (number(spec.seal.temperature.0), number(spec.seal.speed.0));
            let (w, o) = (number(spec.seal.band.0), number(spec.seal.overlap.0));
            self.comment(&format!("seal: temperature_C={t} speed_mm_s={v} band_mm={w} overlap_mm={o}"));
        }
        for (seam, i) in program.seams.iter().zip(1..) {
            self.comment(&seam_facts("length", i, seam));
        }
        if program.seams.len() > 1 {
            let length: f64 = program.seams.iter().map(|seam| seam.length).sum();
            self.comment(&format!("total: length_mm={length:.3} time_s={:.0}", program.time));
        }
        for line in &self.machine.start {
            self.line(line);
        }
    }

    fn step(&mut self, program: &Program, step: &Step) {
        match step {
            Step::Height(Level::Travel) => self.height(self.machine.heights.travel.0),
            Step::Height(Level::Park) => self.height(self.machine.heights.park.0),
            Step::Heat(temperature) => self.heat(*temperature),
            Step::Travel(to) => {
                let to = self.decimals.round_point(*to);
                self.word("G0 X", to.x);
                self.word(" Y", to.y);
                self.end_line();
                self.at = to;
            }
            Step::Seam(i) => self.comment(&seam_facts("seam", i + 1, &program.seams[*i])),
            Step::TouchDown(ramp) | Step::Lift(ramp) => self.ramp(ramp),
            Step::Seal(pieces) => {
                for piece in pieces {
                    self.cut(piece, None, self.spec.seal.speed.0);
                }
            }
            Step::Trace(pieces) => {
                for piece in pieces {
                    self.cut(piece, None, self.machine.trace_speed.0);
                }
            }
        }
    }

    fn heat(&mut self, temperature: Temperature) {
        let t = number(temperature.0);
        self.comment(&format!("heat: temperature_C={t}"));
        self.comment(&format!("set the iron to {t} C, standby off, wait until hot, press start"));
        self.line(&self.machine.pause.clone());
    }

    fn height(&mut self, z: f64) {
        self.word("G0 Z", z);
        self.end_line();
    }

    fn ramp(&mut self, ramp: &Ramp) {
        for (piece, z) in ramp.with_heights() {
            self.cut(piece, Some(z), self.spec.seal.speed.0);
        }
    }

    /// One feed move along `piece`, to height `z` if given, at `speed` mm/s.
    fn cut(&mut self, piece: &Segment, z: Option<f64>, speed: f64) {
        let (from, to) = (self.at, self.decimals.round_point(piece.end()));
        if from == to && z.is_none() {
            return;
        }
        let center = self.center(piece, from, to);
        self.out.push_str(match (piece, center) {
            (Segment::Arc(arc), Some(_)) if arc.is_ccw() => "G3",
            (_, Some(_)) => "G2",
            (_, None) => "G1",
        });
        self.word(" X", to.x);
        self.word(" Y", to.y);
        if let Some(z) = z {
            self.word(" Z", z);
        }
        if let Some(center) = center {
            self.word(" I", center.x - from.x);
            self.word(" J", center.y - from.y);
        }
        let feed = speed * 60.0;
        if self.feed != Some(feed) {
            self.feed = Some(feed);
            let _ = write!(self.out, " F{}", number(feed));
        }
        self.end_line();
        self.at = to;
    }

    /// Centre of the arc through the rounded points; `None` where a straight move is as good.
    fn center(&self, piece: &Segment, from: Point, to: Point) -> Option<Point> {
        let Segment::Arc(arc) = piece else { return None };
        let sagitta = arc.radius * (1.0 - (arc.sweep / 2.0).cos());
        // A quarter of the tolerance; rounding has at most a tenth of it.
        if sagitta <= self.spec.accuracy.path.0 / 4.0 {
            return None;
        }
        let chord = to - from;
        let half = chord.length() / 2.0;
        let apothem = (arc.radius * arc.radius - half * half).max(0.0).sqrt();
        Some(from.midpoint(to) + chord.normalized().perp() * (apothem * arc.sweep.signum()))
    }

    fn word(&mut self, letter: &str, value: f64) {
        self.out.push_str(letter);
        self.decimals.write(&mut self.out, value);
    }
}

/// A value from the spec, to nine decimals: more than any controller reads.
fn number(x: f64) -> String {
    Decimals::exactly(9).text(x)
}

fn stars(program: &Program) -> String {
    match (program.stars.first(), program.stars.last()) {
        (Some(first), Some(last)) if first != last => format!("{first}-{last}"),
        (Some(only), _) => only.to_string(),
        _ => "none".to_owned(),
    }
}

fn seam_facts(key: &str, index: usize, seam: &SeamReport) -> String {
    let (star, name) = (seam.star, seam.loop_name());
    format!(
        "{key}: seam={index} star={star} loop={name} length_mm={:.3} time_s={:.0}",
        seam.length, seam.time
    )
}
