//! The writer: lines of G-code into a sink, one at a time.

use std::fmt;

use crate::emit::gcode::dialect::Spelling;
use crate::emit::number::{Decimals, number};
use crate::emit::text::inert;
use crate::plan::is_straight;
use crate::spec::{Comments, Controller, Machine, Process, Seal, Spec};
use crate::units::Length;
use inflatable::geom::{Point, Segment};

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
pub(super) struct Writer<'a, W> {
    out: &'a mut W,
    facts: Facts<'a>,
    decimals: Decimals,
    /// The spelling of the dialect.
    pub(super) spelling: Spelling,
    /// Lines so far.
    pub(super) lines: usize,
    /// The iron's position by the numbers written.
    pub(super) at: Point,
    /// The feed in force, mm/min.
    pub(super) feed: Option<f64>,
    line: String,
}

impl<'a, W: fmt::Write> Writer<'a, W> {
    pub(super) fn new(out: &'a mut W, facts: Facts<'a>) -> Self {
        Self {
            out,
            facts,
            decimals: Decimals::for_tolerance(facts.path),
            spelling: Spelling::of(facts.controller.dialect),
            lines: 0,
            at: Point::ORIGIN,
            feed: None,
            line: String::new(),
        }
    }

    /// The nearest point that the file can express.
    pub(super) fn round(&self, p: Point) -> Point {
        self.decimals.round_point(p)
    }

    /// A line as it is.
    pub(super) fn line(&mut self, text: &str) -> fmt::Result {
        self.out.write_str(text)?;
        self.out.write_char('\n')?;
        self.lines += 1;
        Ok(())
    }

    /// A comment, cut to the length that the controller reads.
    pub(super) fn comment(&mut self, text: &str) -> fmt::Result {
        let room = self.facts.controller.line_length.saturating_sub(2);
        self.marked(&inert(text, room))
    }

    /// A structured comment, "key: word=value word=value": words that a line has no room for go on in the next one, under the
    /// same key, so that no digit is cut.
    pub(super) fn facts(&mut self, text: &str) -> fmt::Result {
        let room = self.facts.controller.line_length.saturating_sub(2);
        let Some((key, words)) = text.split_once(": ") else { return self.comment(text) };
        let mut line = format!("{key}:");
        for word in words.split(' ') {
            if line.len() + 1 + word.len() > room && line.len() > key.len() + 1 {
                self.comment(&line)?;
                line.truncate(key.len() + 1);
            }
            line.push(' ');
            line.push_str(word);
        }
        self.comment(&line)
    }

    /// A comment of the profile's own, which may name settings such as `$1`.
    pub(super) fn requirement(&mut self, text: &str) -> fmt::Result {
        let room = self.facts.controller.line_length.saturating_sub(4);
        let parts: Vec<String> = text.split('$').map(|part| inert(part, room)).collect();
        self.marked(&parts.join("$"))
    }

    fn marked(&mut self, text: &str) -> fmt::Result {
        let line = match self.facts.controller.comments {
            Comments::Semicolon => format!("; {text}").trim_end().to_owned(),
            Comments::Parentheses => format!("({})", text.trim_end()),
        };
        self.line(&line)
    }

    /// The last line: how many there are.
    pub(super) fn sentinel(&mut self) -> fmt::Result {
        let lines = self.lines + 1;
        self.comment(&format!("end of program, {lines} lines"))
    }

    /// Straight up or down.
    pub(super) fn height(&mut self, z: f64) -> fmt::Result {
        self.word("G0 Z", z);
        self.travel_feed();
        self.end_line()
    }

    /// As fast as possible, in the plane.
    pub(super) fn travel(&mut self, to: Point) -> fmt::Result {
        let to = self.round(to);
        self.word("G0 X", to.x);
        self.word(" Y", to.y);
        self.at = to;
        self.travel_feed();
        self.end_line()
    }

    /// The feed of a travel, on every one where the controller would go on at the seal's; the next cut states its own.
    fn travel_feed(&mut self) {
        if self.spelling.travel_at_feed {
            self.line.push_str(" F");
            self.line.push_str(&number(self.facts.process.travel_speed.0 * 60.0));
            self.feed = None;
        }
    }

    /// One feed move along `piece` to its `end`, to height `z` if given, at `speed` mm/s.
    pub(super) fn cut(&mut self, piece: &Segment, end: Point, z: Option<f64>, speed: f64) -> fmt::Result {
        let (from, to) = (self.at, self.round(end));
        if from == to && z.is_none() {
            return Ok(());
        }
        let center = self.center(piece, from, to);
        self.line.push_str(match (piece, center) {
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
            self.line.push_str(" F");
            self.line.push_str(&number(feed));
        }
        self.at = to;
        self.end_line()
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
        self.line.push_str(letter);
        self.decimals.write(&mut self.line, value);
    }

    fn end_line(&mut self) -> fmt::Result {
        let mut line = std::mem::take(&mut self.line);
        let written = self.line(&line);
        // The room is used again.
        line.clear();
        self.line = line;
        written
    }
}
