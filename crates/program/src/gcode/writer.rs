//! The writer: lines of G-code, one at a time.

use crate::gcode::dialect::Spelling;
use crate::number::{Decimals, number};
use crate::plan::is_straight;
use crate::text::inert;
use geom::{Point, Segment};
use spec::units::Length;
use spec::{Comments, Controller, Machine, Process, Seal, SealProcess, Spec};

/// The data besides the steps from which a program is written.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// The user's name for the design; any text.
    pub name: &'a str,
    /// Temperature, speed, band and overlap.
    pub seal: &'a Seal,
    /// Largest deviation from the exact geometry.
    pub path: Length,
    /// The controller that reads the program.
    pub controller: &'a Controller,
    /// The way in which the iron is led.
    pub process: &'a Process,
}

impl<'a> Facts<'a> {
    /// The facts about programs of `spec` for `machine`.
    pub fn new(spec: &'a Spec, machine: &'a Machine) -> Self {
        let Machine { controller, process, .. } = machine;
        Self { name: &spec.name, seal: &spec.seal, path: spec.accuracy.path, controller, process }
    }
}

/// Writes lines, and remembers the iron's position by the numbers written.
pub(super) struct Writer<'a> {
    /// The lines so far.
    pub(super) out: String,
    /// The data besides the steps.
    pub(super) facts: Facts<'a>,
    decimals: Decimals,
    /// The spelling of the dialect.
    pub(super) spelling: Spelling,
    /// The iron's position by the numbers written, in the controller's coordinates.
    pub(super) at: Point,
    /// The feed in force, mm/min.
    pub(super) feed: Option<f64>,
    /// The S word in force, of a laser that is on, and the one that the next move along a path needs.
    beam: Option<[f64; 2]>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(facts: Facts<'a>) -> Self {
        Self {
            out: String::new(),
            facts,
            decimals: Decimals::for_tolerance(facts.path),
            spelling: Spelling::new(facts.controller.dialect),
            at: Point::ORIGIN,
            feed: None,
            beam: None,
        }
        .at_corner()
    }

    /// The writer with the iron above the sheet's lower left corner, where programs begin and end.
    fn at_corner(mut self) -> Self {
        self.at = self.round(Point::ORIGIN);
        self
    }

    /// The nearest point that the file can express to `p` of the sheet, in the controller's coordinates.
    pub(super) fn round(&self, p: Point) -> Point {
        let [x, y, _] = self.facts.controller.place.shift();
        self.decimals.round_point(Point::new(p.x + x, p.y + y))
    }

    /// The height `z` above the release layer, in the controller's coordinates.
    pub(super) fn height_of(&self, z: f64) -> f64 {
        z + self.facts.controller.place.surface.0
    }

    /// A line as it is.
    pub(super) fn line(&mut self, text: &str) {
        self.out.push_str(text);
        self.out.push('\n');
    }

    /// A comment, cut to the length that the controller reads.
    pub(super) fn comment(&mut self, text: &str) {
        let room = self.facts.controller.line_length.saturating_sub(2);
        self.marked(&inert(text, room));
    }

    /// A structured comment, "key: word=value word=value": words that a line has no room for go on in the next one, under the
    /// same key, so that no digit is cut.
    pub(super) fn facts(&mut self, text: &str) {
        let room = self.facts.controller.line_length.saturating_sub(2);
        let Some((key, words)) = text.split_once(": ") else { return self.comment(text) };
        let mut line = format!("{key}:");
        for word in words.split(' ') {
            if line.len() + 1 + word.len() > room && line.len() > key.len() + 1 {
                self.comment(&line);
                line.truncate(key.len() + 1);
            }
            line.push(' ');
            line.push_str(word);
        }
        self.comment(&line);
    }

    /// A comment of the profile's own, which may name settings such as `$1`.
    pub(super) fn requirement(&mut self, text: &str) {
        let room = self.facts.controller.line_length.saturating_sub(4);
        let parts: Vec<String> = text.split('$').map(|part| inert(part, room)).collect();
        self.marked(&parts.join("$"));
    }

    fn marked(&mut self, text: &str) {
        let line = match self.facts.controller.comments {
            Comments::Semicolon => format!("; {text}").trim_end().to_owned(),
            Comments::Parentheses => format!("({})", text.trim_end()),
        };
        self.line(&line);
    }

    /// The whole text, with a last line that counts them.
    pub(super) fn finished(mut self) -> String {
        let lines = self.out.lines().count() + 1;
        self.comment(&format!("end of program, {lines} lines"));
        self.out
    }

    /// Straight up or down.
    pub(super) fn height(&mut self, z: f64) {
        self.word("G0 Z", self.height_of(z));
        self.end_travel();
    }

    /// As fast as possible, in the plane.
    pub(super) fn travel(&mut self, end: Point) {
        let end = self.round(end);
        self.word("G0 X", end.x);
        self.word(" Y", end.y);
        self.at = end;
        self.end_travel();
    }

    /// Ends a travel with its feed where the controller would go on at the seal's; the next cut states its own.
    fn end_travel(&mut self) {
        if self.spelling.travel_at_feed {
            self.out.push_str(" F");
            self.out.push_str(&number(self.facts.process.travel_speed.0 * 60.0));
            self.feed = None;
        }
        self.out.push('\n');
    }

    /// The S word with which `process` seals; `None` of an iron.
    pub(super) fn full_beam(&self, process: &SealProcess) -> Option<f64> {
        Some(self.facts.controller.laser?.word(process.seal.power?.0))
    }

    /// Arms a laser without power: M4 keeps it off where nothing moves.
    pub(super) fn beam_ready(&mut self) {
        self.line("M4 S0");
        self.beam = Some([0.0; 2]);
    }

    /// The S word of the moves that follow; `None` without a laser.
    pub(super) fn set_beam(&mut self, word: Option<f64>) {
        self.beam = self.beam.zip(word).map(|([in_force, _], word)| [in_force, word]);
    }

    /// Switches a laser off.
    pub(super) fn beam_off(&mut self) {
        self.line("M5");
        self.beam = None;
    }

    /// One feed move along `piece`, to height `z` if given, at `speed` mm/s.
    pub(super) fn cut(&mut self, piece: &Segment, z: Option<f64>, speed: f64) {
        let (from, to) = (self.at, self.round(piece.end()));
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
            self.word(" Z", self.height_of(z));
        }
        if let Some(center) = center {
            self.word(" I", center.x - from.x);
            self.word(" J", center.y - from.y);
        }
        let feed = speed * 60.0;
        if self.feed != Some(feed) {
            self.feed = Some(feed);
            self.out.push_str(" F");
            self.out.push_str(&number(feed));
        }
        self.power_word();
        self.at = to;
        self.out.push('\n');
    }

    /// The S word of a laser, where it changes.
    fn power_word(&mut self) {
        if let Some([in_force, word]) = &mut self.beam
            && in_force != word
        {
            *in_force = *word;
            self.out.push_str(" S");
            self.out.push_str(&number(*word));
        }
    }

    /// Centre of the arc through the rounded points; `None` where a straight move is as good.
    fn center(&self, piece: &Segment, from: Point, to: Point) -> Option<Point> {
        let Segment::Arc(arc) = piece else { return None };
        if !self.facts.controller.arcs || is_straight(piece, self.facts.path) {
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
