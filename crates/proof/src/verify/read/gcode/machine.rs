//! Executes blocks: the modes, the position and the heat of the simulated machine.

use crate::verify::read::gcode::block::Block;
use crate::verify::read::gcode::modes::Modes;
use crate::verify::read::gcode::{
    ArcTolerance, Beam, BeamMode, BlindMove, Dialect, Dwell, Event, Heat, Heater, Move, MoveKind, Point3,
    ServiceCall,
};
use crate::verify::{Finding, FindingCode};
use geom::{Arc, Line, Point, Segment};
use spec::{Command, Service};
use std::f64::consts::TAU;

/// A line that is executed, and the list of its events.
pub(super) struct BlockContext<'a> {
    pub(super) block: &'a Block,
    pub(super) line: usize,
    pub(super) dialect: &'a Dialect,
    pub(super) out: &'a mut Vec<Event>,
}

impl BlockContext<'_> {
    fn report(&mut self, code: FindingCode, fault: impl Into<String>, allowed: impl Into<String>) {
        self.out.push(Event::Finding(Finding::in_line(code, self.line, fault, allowed)));
    }
}

/// The simulated machine.
#[derive(Clone, Debug, Default)]
pub(super) struct Machine {
    pub(super) modes: Modes,
    /// Temperature for which a program waited, in degrees Celsius; `None` once another one is set without a wait.
    pub(super) waited_for_celsius: Option<f64>,
    /// The laser, of a machine that has one.
    beam: Beam,
    position: [Option<f64>; 3],
    /// Names of modes whose absence was reported already.
    reported: Vec<&'static str>,
}

impl Machine {
    /// A machine that was just switched on: only the modes that it is always in are known.
    pub(super) fn new(dialect: &Dialect) -> Self {
        let mut machine = Self::default();
        for command in dialect.vocabulary.fixed {
            machine.modes.set(*command);
        }
        machine
    }

    /// The place of the tip, once all three axes were set.
    pub(super) fn position(&self) -> Option<Point3> {
        match self.position {
            [Some(x), Some(y), Some(z)] => Some(Point3::new(x, y, z)),
            _ => None,
        }
    }

    /// Executes a block's modes, dwell and motion (pause and end are the interpreter's).
    ///
    /// Modes count before the motion of their line, as controllers have it. A setting or a command that stands alone ends the
    /// block.
    pub(super) fn execute(&mut self, context: &mut BlockContext<'_>) {
        let BlockContext { block, line, .. } = *context;
        for command in &block.commands {
            self.modes.set(*command);
            let waits = *command == Command::HeatAndWait;
            if waits || *command == Command::HeatOnly {
                let by_r = block.value(b'R').filter(|_| waits);
                let celsius = block.value(b'S').or(by_r).unwrap_or(0.0);
                // With S some controllers do not wait for a heater that is too hot.
                let waits_for_cooler = by_r.is_some() || !context.dialect.vocabulary.waits_by_r();
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a number that is none of a tool is no tool of the profile"
                )]
                let number = block.value(b'T').map(|number| number as u32);
                let heat = Heat { line, celsius, waits, heater: Heater::Hotend(number) };
                self.heat(heat, waits_for_cooler, context.out);
            }
        }
        self.set_beam(context);
        if block.commands.iter().any(|command| command.is_setting()) {
            context.out.push(Event::Setting);
        }
        if block.commands.iter().any(|command| command.stands_alone()) {
            return;
        }
        if let Some(f) = block.value(b'F') {
            self.require(self.modes.units.is_some(), "units (G20, G21)", context);
            self.require(self.modes.feed_mode.is_some(), "feed mode (G93, G94)", context);
            self.modes.feed = Some(if self.modes.is_inverse_time() { f } else { f * self.modes.scale() });
        }
        if let Some(p) = block.value(b'P') {
            context.out.push(Event::Dwell(Dwell { line, seconds: context.dialect.dwell_seconds(p) }));
        }
        if block.has_any(b"XYZIJ") {
            self.travel(context);
        } else if block.has_command(Command::ArcCw) || block.has_command(Command::ArcCcw) {
            context.report(FindingCode::BadArc, "an arc without an end point", "X or Y with I, J");
        }
    }

    /// Follows the words to a laser: S counts before M3, M4 and M5 of its line (gcode.c, gc_execute_line).
    fn set_beam(&mut self, context: &mut BlockContext<'_>) {
        let BlockContext { block, dialect, .. } = *context;
        if !dialect.vocabulary.drives_laser {
            return;
        }
        let mode = block.commands.iter().find_map(|command| match command {
            Command::BeamConstant => Some(BeamMode::Constant),
            Command::BeamByMotion => Some(BeamMode::ByMotion),
            Command::BeamOff => Some(BeamMode::Off),
            _ => None,
        });
        let word = block.value(b'S');
        if mode.is_some() || word.is_some() {
            self.beam = Beam { mode: mode.unwrap_or(self.beam.mode), word: word.unwrap_or(self.beam.word) };
            context.out.push(Event::Beam(self.beam));
        }
    }

    /// Follows a command to a heater; `waits_for_cooler`: it also waits for a heater that is too hot.
    pub(super) fn heat(&mut self, heat: Heat, waits_for_cooler: bool, events: &mut Vec<Event>) {
        let may_be_hotter =
            !waits_for_cooler && self.waited_for_celsius.is_some_and(|hot| hot > heat.celsius + 0.5);
        let is_hot = heat.waits && !may_be_hotter && heat.celsius > 0.0;
        self.waited_for_celsius = is_hot.then_some(heat.celsius);
        events.push(Event::Heat(heat));
    }

    /// Follows a line that puts the machine in order: homing leaves the iron at a place that the program does not state.
    pub(super) fn serve(&mut self, call: ServiceCall, events: &mut Vec<Event>) {
        if let Service::Home(axes) = call.service {
            for (position, _) in self.position.iter_mut().zip(axes).filter(|(_, is_homed)| *is_homed) {
                *position = None;
            }
        }
        events.push(Event::Service(call));
    }

    /// The move to the axis words of the block, with its path and its feed.
    ///
    /// A mode on which the move relies and which was never set is reported, and the move is made nevertheless, so that later
    /// faults are seen. While a coordinate is unknown the move is a blind one.
    fn travel(&mut self, context: &mut BlockContext<'_>) {
        let BlockContext { block, line, .. } = *context;
        let Some(motion) = self.modes.motion else {
            context.report(FindingCode::ModeUnset, "axis words before any motion", "G0, G1, G2 or G3 first");
            return;
        };
        self.require(self.modes.units.is_some(), "units (G20, G21)", context);
        self.require(self.modes.distance.is_some(), "distance mode (G90, G91)", context);
        let start = self.position();
        let Some(to) = self.target(context) else { return };
        let kind = if motion == Command::Rapid { MoveKind::Rapid } else { MoveKind::Feed };
        let arcs = matches!(motion, Command::ArcCw | Command::ArcCcw);
        if !arcs && block.has_any(b"IJ") {
            context.report(FindingCode::UnusedWord, "I or J on a straight move", "I, J with G2, G3 only");
        }
        let at_feed = kind == MoveKind::Feed || context.dialect.travel_at_feed;
        if at_feed && kind == MoveKind::Rapid {
            self.require(self.modes.feed.is_some(), "feed (F)", context);
        }
        let height_known = self.position[2].is_some() || block.value(b'Z').is_some();
        self.position = to;
        let (Some(from), Some(to)) = (start, self.position()) else {
            if kind == MoveKind::Feed || !height_known {
                let fault = "a move from a position that the program never set";
                context.report(FindingCode::UnknownPosition, fault, "rapids first: Z, then X and Y");
            }
            let named = [b'X', b'Y', b'Z'].map(|letter| block.value(letter).is_some());
            // Without a length, a feed by time does not define a speed.
            let feed = self.modes.feed.filter(|_| at_feed && !self.modes.is_inverse_time());
            context.out.push(Event::Blind(BlindMove { line, kind, named, to: self.position, feed }));
            return;
        };
        let path = if arcs {
            self.arc(from.xy(), to.xy(), context)
        } else {
            (from.xy() != to.xy()).then(|| Line::new(from.xy(), to.xy()).into())
        };
        let mut step = Move { line, kind, from, to, path, feed: None, heated: self.waited_for_celsius };
        if at_feed {
            step.feed = self.feed_of(&step, context);
        }
        context.out.push(Event::Move(step));
    }

    /// The position after the block; `None` if it is unknown.
    fn target(&self, context: &mut BlockContext<'_>) -> Option<[Option<f64>; 3]> {
        let mut to = self.position;
        for ((axis, letter), shift) in to.iter_mut().zip(*b"XYZ").zip(context.dialect.shift) {
            let Some(value) = context.block.value(letter) else { continue };
            let value = value * self.modes.scale();
            if !self.modes.is_relative() {
                *axis = Some(value - shift);
            } else if let Some(coordinate) = axis {
                *coordinate += value;
            } else {
                let fault = format!("a displacement {} from an unknown position", char::from(letter));
                context.report(FindingCode::UnknownPosition, fault, "a position (G90) first");
                return None;
            }
        }
        Some(to)
    }

    /// The path of an arc; after a fault the chord, so that the rest can still be read.
    fn arc(&mut self, from: Point, to: Point, context: &mut BlockContext<'_>) -> Option<Segment> {
        self.require(self.modes.plane.is_some(), "plane (G17)", context);
        self.require(self.modes.centers.is_some(), "arc centre mode (G90.1, G91.1)", context);
        let chord = (from != to).then(|| Line::new(from, to).into());
        let absolute = self.modes.centers == Some(Command::CentersAbsolute);
        let (i, j) = (context.block.value(b'I'), context.block.value(b'J'));
        if (i.is_none() && j.is_none()) || (absolute && (i.is_none() || j.is_none())) {
            context.report(FindingCode::BadArc, "an arc without a centre", "I and J");
            return chord;
        }
        let scale = self.modes.scale();
        let (i, j) = (i.unwrap_or(0.0) * scale, j.unwrap_or(0.0) * scale);
        let [x, y, _] = context.dialect.shift;
        let center = if absolute { Point::new(i - x, j - y) } else { Point::new(from.x + i, from.y + j) };
        let ccw = self.modes.motion == Some(Command::ArcCcw);
        match arc(from, to, center, ccw, &context.dialect.arcs) {
            Ok(arc) => Some(arc.into()),
            Err((found, allowed)) => {
                context.report(FindingCode::BadArc, found, allowed);
                chord
            }
        }
    }

    /// The feed of a move in mm/min.
    fn feed_of(&mut self, step: &Move, context: &mut BlockContext<'_>) -> Option<f64> {
        self.require(self.modes.feed_mode.is_some(), "feed mode (G93, G94)", context);
        if self.modes.is_inverse_time() {
            let feed = context.block.value(b'F').map(|f| f * step.length());
            if feed.is_none() {
                context.report(FindingCode::BadFeed, "a move without F in inverse time", "F on each line");
            }
            return feed.filter(|f| *f > 0.0);
        }
        self.require(self.modes.feed.is_some(), "feed (F)", context);
        self.modes.feed
    }

    /// Reports, once, that something relied on a mode that the program has not set.
    fn require(&mut self, set: bool, name: &'static str, context: &mut BlockContext<'_>) {
        if !set && !self.reported.contains(&name) {
            self.reported.push(name);
            let fault = format!("{name} not set");
            context.report(FindingCode::ModeUnset, fault, "every mode set before it is needed");
        }
    }
}

/// Turns below this are full circles: GRBL's `ARC_ANGULAR_TRAVEL_EPSILON`, rad.
const FULL_CIRCLE: f64 = 5e-7;

/// Up to this turn an arc is read as passing through both of its ends, rad.
const LARGEST_CHORDAL: f64 = 1.5 * std::f64::consts::PI;

/// The arc from `from` to `to` about `center`, or why a controller would refuse it (found, allowed).
///
/// Rounded words never give two equal radii. Controllers spread the difference along the arc; here the arc
/// passes through both ends and turns by the angle that they are apart seen from `center`. Up to 90 degrees
/// both agree to a fortieth of the difference, however short the chord. Near full circles, where the chord hardly
/// determines the radius, the mean radius is taken.
pub(super) fn arc(
    from: Point,
    to: Point,
    center: Point,
    ccw: bool,
    tolerance: &ArcTolerance,
) -> Result<Arc, (String, String)> {
    let (r1, r2) = (center.distance(from), center.distance(to));
    let difference = (r1 - r2).abs();
    let allowed = tolerance.free.max((tolerance.relative * r1.max(r2)).min(tolerance.limit));
    if difference > allowed || r1 <= 0.0 || r2 <= 0.0 {
        let fault = format!("radius {r1:.4} mm at the start, {r2:.4} mm at the end");
        return Err((fault, format!("radii > 0 that differ by at most {allowed:.4} mm")));
    }
    let (u, v) = (from - center, to - center);
    let sign = if ccw { 1.0 } else { -1.0 };
    let turn = sign * libm::atan2(u.cross(v), u.dot(v));
    let sweep = sign * if turn < FULL_CIRCLE { (turn + TAU).min(TAU) } else { turn };
    let chordal =
        Arc::from_bulge(from, to, libm::tan(sweep / 4.0)).filter(|_| sweep.abs() <= LARGEST_CHORDAL);
    Ok(chordal.unwrap_or_else(|| Arc::new(center, 0.5 * (r1 + r2), u.angle(), sweep)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::read::gcode::Dialect;

    fn round(p: Point) -> Point {
        Point::new((p.x * 1e3).round() / 1e3, (p.y * 1e3).round() / 1e3)
    }

    #[test]
    fn any_turn_and_size_both_ways() {
        for radius in [0.01, 0.5, 30.0, 2000.0] {
            for degrees in [5.0_f64, 90.0, 170.0, 180.0, 190.0, 355.0] {
                for sign in [1.0, -1.0] {
                    let exact = Arc::new(Point::new(7.0, -3.0), radius, 0.7, sign * degrees.to_radians());
                    let fitted =
                        arc(exact.start(), exact.end(), exact.center, sign > 0.0, &Dialect::GENERIC.arcs)
                            .unwrap();
                    assert!((fitted.sweep - exact.sweep).abs() < 1e-9, "{radius} {degrees}: {fitted:?}");
                    assert!((fitted.radius - radius).abs() < 1e-9 * radius.max(1.0));
                }
            }
        }
    }

    #[test]
    fn rounded_ends_stay_ends() {
        for degrees in [0.02_f64, 0.2, 30.0, 89.0, 180.0, 260.0] {
            let exact = Arc::new(Point::new(7.1234, -3.4321), 30.0, 0.7, degrees.to_radians());
            let (from, to) = (round(exact.start()), round(exact.end()));
            let fitted = arc(from, to, round(exact.center), true, &Dialect::GENERIC.arcs).unwrap();
            assert!(fitted.start().distance(from) < 1e-9 && fitted.end().distance(to) < 1e-9, "{degrees}");
            let middle = exact.at_angle(exact.start_angle + 0.5 * exact.sweep);
            let error = fitted.at_angle(fitted.start_angle + 0.5 * fitted.sweep).distance(middle);
            assert!(error < 0.0015, "{degrees}: {error}");
        }
    }

    #[test]
    fn full_circle_and_refusals() {
        let p = Point::new(1.0, 0.0);
        let circle = arc(p, p, Point::ORIGIN, false, &Dialect::GENERIC.arcs).unwrap();
        assert_eq!(circle.sweep, -TAU);
        let arc_with_error =
            |dx: f64| arc(p, Point::new(0.0, 1.0 + dx), Point::ORIGIN, true, &Dialect::GENERIC.arcs);
        assert!(arc_with_error(0.0049).is_ok() && arc_with_error(0.0051).is_err());
        assert!(arc(p, p, p, true, &Dialect::GENERIC.arcs).is_err());
        let far_start = Point::new(100.0, 0.0);
        let big =
            |d: f64| arc(far_start, Point::new(0.0, 100.0 + d), Point::ORIGIN, true, &Dialect::GENERIC.arcs);
        assert!(big(0.027).is_ok() && big(0.029).is_err());
    }
}
