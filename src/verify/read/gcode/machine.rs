//! Executes blocks: the modes, the position and the heat of the simulated machine.

use crate::geom::{Line, Point, Segment};
use crate::verify::read::gcode::arc::arc;
use crate::verify::read::gcode::block::Block;
use crate::verify::read::gcode::modes::Modes;
use crate::verify::read::gcode::{Command, Dialect, Dwell, Event, Move, MoveKind, Point3};
use crate::verify::{Finding, FindingCode};

/// The simulated machine.
#[derive(Clone, Debug, Default)]
pub(super) struct Machine {
    pub(super) modes: Modes,
    /// Temperature in force, in degrees Celsius.
    pub(super) heated: Option<f64>,
    position: [Option<f64>; 3],
    /// Names of modes whose absence was reported already.
    reported: Vec<&'static str>,
}

impl Machine {
    /// A machine that was just switched on: only the modes that it is always in are known.
    pub(super) fn new(dialect: &Dialect) -> Self {
        let mut machine = Self::default();
        for command in dialect.fixed {
            machine.modes.set(*command);
        }
        machine
    }

    /// Where the tip is, once all three axes were told.
    pub(super) fn at(&self) -> Option<Point3> {
        match self.position {
            [Some(x), Some(y), Some(z)] => Some(Point3::new(x, y, z)),
            _ => None,
        }
    }

    /// Executes a block's modes, dwell and motion (pause and end are the interpreter's).
    pub(super) fn execute(&mut self, block: &Block, line: usize, dialect: &Dialect, out: &mut Vec<Event>) {
        for command in &block.commands {
            self.modes.set(*command);
            match command {
                Command::HeatAndWait => self.heated = block.value(b'S').filter(|t| *t > 0.0),
                Command::HeatOnly => self.heated = None,
                _ => {}
            }
        }
        if block.commands.iter().any(|command| command.stands_alone()) {
            return;
        }
        if let Some(f) = block.value(b'F') {
            self.require(self.modes.units.is_some(), "units (G20, G21)", line, out);
            self.require(self.modes.feed_mode.is_some(), "feed mode (G93, G94)", line, out);
            self.modes.feed = Some(if self.modes.is_inverse_time() { f } else { f * self.modes.scale() });
        }
        if let Some(p) = block.value(b'P') {
            let seconds = dialect.dwell_seconds(p);
            out.push(Event::Dwell(Dwell { line, seconds, at: self.at() }));
        }
        if block.has_any(b"XYZIJ") {
            self.travel(block, line, dialect, out);
        } else if block.has(Command::ArcCw) || block.has(Command::ArcCcw) {
            report(out, FindingCode::BadArc, line, "an arc without an end point", "X or Y with I, J");
        }
    }

    fn travel(&mut self, block: &Block, line: usize, dialect: &Dialect, out: &mut Vec<Event>) {
        let Some(motion) = self.modes.motion else {
            report(
                out,
                FindingCode::ModeUnset,
                line,
                "axis words before any motion",
                "G0, G1, G2 or G3 first",
            );
            return;
        };
        self.require(self.modes.units.is_some(), "units (G20, G21)", line, out);
        self.require(self.modes.distance.is_some(), "distance mode (G90, G91)", line, out);
        let before = self.at();
        let Some(to) = self.target(block, line, out) else { return };
        let kind = if motion == Command::Rapid { MoveKind::Rapid } else { MoveKind::Feed };
        let arcs = matches!(motion, Command::ArcCw | Command::ArcCcw);
        if !arcs && block.has_any(b"IJ") {
            report(out, FindingCode::UnusedWord, line, "I or J on a straight move", "I, J with G2, G3 only");
        }
        let height_known = self.position[2].is_some() || block.value(b'Z').is_some();
        self.position = to;
        let (Some(from), Some(to)) = (before, self.at()) else {
            if kind == MoveKind::Feed || !height_known {
                let found = "a move from a position that the program never set";
                report(out, FindingCode::UnknownPosition, line, found, "rapids first: Z, then X and Y");
            }
            return;
        };
        let path = if arcs {
            self.arc(block, from.xy(), to.xy(), line, dialect, out)
        } else {
            (from.xy() != to.xy()).then(|| Line::new(from.xy(), to.xy()).into())
        };
        let mut step = Move { line, kind, from, to, path, feed: None, heated: self.heated };
        if kind == MoveKind::Feed {
            step.feed = self.feed_of(&step, block, line, out);
        }
        out.push(Event::Move(step));
    }

    /// The position after the block; `None` if it cannot be known.
    fn target(&self, block: &Block, line: usize, out: &mut Vec<Event>) -> Option<[Option<f64>; 3]> {
        let mut to = self.position;
        for (axis, letter) in to.iter_mut().zip(*b"XYZ") {
            let Some(value) = block.value(letter) else { continue };
            let value = value * self.modes.scale();
            if !self.modes.is_relative() {
                *axis = Some(value);
            } else if let Some(at) = axis {
                *at += value;
            } else {
                let found = format!("a displacement {} from nowhere", char::from(letter));
                report(out, FindingCode::UnknownPosition, line, &found, "a position (G90) first");
                return None;
            }
        }
        Some(to)
    }

    /// The path of an arc; after a fault the chord, so that what follows can still be read.
    fn arc(
        &mut self,
        block: &Block,
        from: Point,
        to: Point,
        line: usize,
        dialect: &Dialect,
        out: &mut Vec<Event>,
    ) -> Option<Segment> {
        self.require(self.modes.plane.is_some(), "plane (G17)", line, out);
        self.require(self.modes.centers.is_some(), "arc centre mode (G90.1, G91.1)", line, out);
        let chord = (from != to).then(|| Line::new(from, to).into());
        let absolute = self.modes.centers == Some(Command::CentersAbsolute);
        let (i, j) = (block.value(b'I'), block.value(b'J'));
        if (i.is_none() && j.is_none()) || (absolute && (i.is_none() || j.is_none())) {
            report(out, FindingCode::BadArc, line, "an arc without a centre", "I and J");
            return chord;
        }
        let scale = self.modes.scale();
        let (i, j) = (i.unwrap_or(0.0) * scale, j.unwrap_or(0.0) * scale);
        let center = if absolute { Point::new(i, j) } else { Point::new(from.x + i, from.y + j) };
        let ccw = self.modes.motion == Some(Command::ArcCcw);
        match arc(from, to, center, ccw, &dialect.arcs) {
            Ok(arc) => Some(arc.into()),
            Err((found, allowed)) => {
                report(out, FindingCode::BadArc, line, &found, &allowed);
                chord
            }
        }
    }

    /// The feed of a move in mm/min.
    fn feed_of(&mut self, step: &Move, block: &Block, line: usize, out: &mut Vec<Event>) -> Option<f64> {
        self.require(self.modes.feed_mode.is_some(), "feed mode (G93, G94)", line, out);
        if self.modes.is_inverse_time() {
            let feed = block.value(b'F').map(|f| f * step.length());
            if feed.is_none() {
                report(out, FindingCode::BadFeed, line, "a move without F in inverse time", "F on each line");
            }
            return feed.filter(|f| *f > 0.0);
        }
        self.require(self.modes.feed.is_some(), "feed (F)", line, out);
        self.modes.feed
    }

    /// Reports, once, that something relied on a mode that the program has not set.
    fn require(&mut self, set: bool, name: &'static str, line: usize, out: &mut Vec<Event>) {
        if !set && !self.reported.contains(&name) {
            self.reported.push(name);
            report(
                out,
                FindingCode::ModeUnset,
                line,
                &format!("{name} not set"),
                "every mode set before it is needed",
            );
        }
    }
}

/// Adds a finding to the events.
pub(super) fn report(out: &mut Vec<Event>, code: FindingCode, line: usize, found: &str, allowed: &str) {
    out.push(Event::Finding(Finding::new(code, line, found, allowed)));
}
