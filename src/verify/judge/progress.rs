//! Progress: how far the job is, as its comments and the display say, against the verifier's own reckoning.

use crate::geom::Segment;
use crate::spec;
use crate::spec::Machine;
use crate::verify::finding::quote;
use crate::verify::judge::rules::{IronRules, Phase};
use crate::verify::read::gcode::{Comment, Line, Move, MoveKind};
use crate::verify::{FindingCode, Findings};

/// Longest way, seen from above, between two places at which progress is said, mm: that of a move which is not chopped.
const PIECE: f64 = 5.0;

/// Whether the travel speed and the acceleration are those of each axis, and the speed at which a level way may pass into an
/// upright one, mm/s.
type Habits = (bool, bool, f64);

/// What G0 does: with an F of its own that is the speed along the way. GRBL, LinuxCNC and RepRapFirmware know an acceleration
/// for each axis, Klipper and Marlin (M204) one for all of a way. Of Klipper's `square_corner_velocity` and RepRapFirmware's
/// M566 Z the default is taken; the others all but stop.
fn habits(dialect: spec::Dialect) -> Habits {
    match dialect {
        spec::Dialect::Klipper => (false, false, 5.0),
        spec::Dialect::Marlin => (false, false, 0.0),
        spec::Dialect::RepRapFirmware => (false, true, 10.0),
        spec::Dialect::Generic => (false, true, 0.0),
        _ => (true, true, 0.0),
    }
}

/// How far the job is.
pub(super) struct Clock<'a> {
    rules: &'a IronRules<'a>,
    habits: Habits,
    /// Time so far, s; after the last move the whole time.
    pub(super) seconds: f64,
    /// Contacts so far, each of which is off its schedule by a dwell's step at the most.
    contacts: u32,
    low: bool,
    /// The travel before this move, with its speed at its beginning; whether a move was seen.
    before: Option<([f64; 3], f64)>,
    begun: bool,
    /// Largest deviation of the path, mm, and what the arcs may be longer than the straight moves made of them, mm.
    tolerance: f64,
    shortened: f64,
}

impl<'a> Clock<'a> {
    pub(super) fn new(rules: &'a IronRules<'a>, dialect: spec::Dialect, tolerance: f64) -> Self {
        Self {
            rules,
            habits: habits(dialect),
            seconds: 0.0,
            contacts: 0,
            low: false,
            before: None,
            begun: false,
            tolerance,
            shortened: 0.0,
        }
    }

    /// Contact is on its schedule, which the pace is judged by; a travel takes its length and speeds up and brakes.
    pub(super) fn step(&mut self, step: &Move) {
        let rules = self.rules;
        let length = step.length();
        if !std::mem::replace(&mut self.begun, true) {
            // The first way to somewhere is from X0 Y0, where every program ends.
            self.seconds += self.travel([step.from.x, step.from.y, 0.0]);
        }
        let low = rules.phase(step) != Phase::Clear;
        self.contacts += u32::from(low && !self.low);
        self.low = low;
        if low && length > 0.0 && matches!(step.path, Some(Segment::Line(_))) {
            // A chord with a sagitta s is shorter than its arc by 8 s^2 / (3 L), a quarter of a turn by a tenth; straight is
            // what has a quarter of the tolerance.
            self.shortened += (self.tolerance * self.tolerance / (6.0 * length)).min(0.11 * length);
        }
        let way = [step.to.x - step.from.x, step.to.y - step.from.y, step.to.z - step.from.z];
        let travel = if step.kind == MoveKind::Rapid { self.travel(way) } else { 0.0 };
        if step.kind != MoveKind::Rapid {
            self.before = None;
        }
        self.seconds += match step.kind {
            MoveKind::Rapid => travel,
            _ if low => length / rules.seal.speed.0,
            MoveKind::Feed => step.feed.map_or(0.0, |feed| length / feed * 60.0),
        };
    }

    /// Time of a travel to rest, s, less what the one before it gains if it need not stop where the two meet.
    fn travel(&mut self, way: [f64; 3]) -> f64 {
        let [level, upright] = [way[0].hypot(way[1]), way[2].abs()];
        if level.hypot(upright) <= 0.0 {
            return 0.0;
        }
        let mut gained = 0.0;
        let mut entry = 0.0;
        if let Some((before, begun)) =
            self.before.filter(|(before, _)| (before[2] == 0.0) != (upright == 0.0))
        {
            let reach = |way| {
                let (length, speed, a) = self.limits(way);
                a.map_or(speed, |a| speed.min((2.0 * a * length).sqrt()))
            };
            entry = f64::min(self.habits.2, reach(before)).min(reach(way));
            gained = self.ramped(before, begun, 0.0) - self.ramped(before, begun, entry);
        }
        self.before = Some((way, entry));
        self.ramped(way, entry, 0.0) - gained
    }

    /// Length, mm, highest speed, mm/s, and acceleration, mm/s^2, of a travel: where an axis is what is limited, an oblique
    /// way is faster.
    fn limits(&self, way: [f64; 3]) -> (f64, f64, Option<f64>) {
        let length = way[0].hypot(way[1]).hypot(way[2]);
        let oblique = length / way.into_iter().map(f64::abs).fold(0.0, f64::max);
        let faster = |of_axes: bool| if of_axes { oblique } else { 1.0 };
        let (speed_of_axes, ramp_of_axes, _) = self.habits;
        let a = self.rules.motion.acceleration.map(|a| a.0 * faster(ramp_of_axes));
        (length, self.rules.process.travel_speed.0 * faster(speed_of_axes), a)
    }

    /// Time of a travel that begins and ends at these speeds, s.
    fn ramped(&self, way: [f64; 3], from: f64, to: f64) -> f64 {
        let (length, speed, Some(a)) = self.limits(way) else {
            let (length, speed, _) = self.limits(way);
            return length / speed;
        };
        let far = length + (from.powi(2) + to.powi(2)) / (2.0 * a);
        // Speeding up from rest and braking to rest, less what lies before the one and after the other.
        let whole = if far < speed * speed / a { 2.0 * (far / a).sqrt() } else { far / speed + speed / a };
        whole - (from + to) / a
    }

    /// Longest time between two places at which progress is said, s: on a ramp the way is longer.
    fn piece(&self) -> f64 {
        let process = self.rules.process;
        let (ramp, rise) = (process.ramp.0, process.heights.travel.0 - process.heights.contact.0);
        let climb = ramp.min(PIECE) * ramp.hypot(rise) / ramp;
        climb.max(PIECE) / self.rules.seal.speed.0
    }

    /// By how much the writer's time may differ, s: each contact by a dwell's step, and all of it by rounding and chords.
    pub(super) fn slack(&self) -> f64 {
        let steps = 2.0 * self.rules.dwell_step * f64::from(self.contacts);
        0.1 + 1e-4 * self.seconds + steps + self.shortened / self.rules.seal.speed.0
    }
}

/// What is told of the progress.
pub(super) struct Told<'a> {
    machine: &'a Machine,
    said: Vec<Said>,
    /// When the last move in contact began without a word since the last, s.
    quiet: Option<f64>,
    /// Whether the last line but those of the display told of progress.
    fresh: bool,
    findings: Findings,
}

/// A comment that tells of it.
struct Said {
    comment: Comment,
    /// The line after it, if that is for the display.
    display: Option<String>,
    /// When it stands there, s, and when the last move began without a word before it.
    at: f64,
    quiet: Option<f64>,
}

/// A hundred, and some that are wrong.
const MOST: usize = 300;

impl<'a> Told<'a> {
    pub(super) fn new(machine: &'a Machine) -> Self {
        Self { machine, said: Vec::new(), quiet: None, fresh: false, findings: Findings::default() }
    }

    /// A comment that tells of progress.
    pub(super) fn comment(&mut self, comment: &Comment, clock: &Clock<'_>) {
        if self.said.len() >= MOST {
            let found = quote(&comment.text);
            self.findings.add(FindingCode::OtherComment, comment.line, found, "each per cent once");
            return;
        }
        let quiet = self.quiet.take();
        self.said.push(Said { comment: comment.clone(), display: None, at: clock.seconds, quiet });
        self.fresh = true;
    }

    /// A line, if it is for the display.
    pub(super) fn display(&mut self, line: &Line<'_>) {
        if !line.text.starts_with("M73") {
            return;
        }
        let text = line.text.trim_end();
        match self.said.last_mut() {
            Some(said) if said.comment.line + 1 == line.number => said.display = Some(text.to_owned()),
            _ => {
                let script = &self.machine.script;
                if !script.start.iter().chain(&script.end).any(|own| own.trim() == text) {
                    let allowed = "the progress that a comment before it tells";
                    self.findings.add(FindingCode::OtherComment, line.number, quote(text), allowed);
                }
            }
        }
    }

    /// A move that begins now.
    pub(super) fn step(&mut self, step: &Move, clock: &Clock<'_>) {
        if !std::mem::take(&mut self.fresh) && clock.rules.phase(step) != Phase::Clear {
            self.quiet = Some(clock.seconds);
        }
    }

    /// Judges all that was told, up to the first that is wrong: of a job that takes another time all of it is. `clock` stands
    /// at the end.
    pub(super) fn judge(&mut self, clock: &Clock<'_>, chopped: bool, findings: &mut Findings) {
        // Within a piece nothing is said, and of a chopped program nobody knows where they end.
        let late = clock.slack() + if chopped { clock.piece() } else { 0.0 };
        let mut before = 0.0;
        let mut wrong = std::mem::take(&mut self.findings);
        let all = self.said.iter().map(|said| (said.quiet, Some(said)));
        for (quiet, said) in all.chain([(self.quiet, None)]) {
            // Up to the last move that began without a word, nothing should have been told.
            let missing = quiet.map_or(0.0, |quiet| (100.0 * (quiet - late) / clock.seconds).floor());
            if missing > before {
                let line = said.map(|said| said.comment.line);
                let found = format!("no word of progress after {before} per cent");
                wrong.add(FindingCode::OtherComment, line, found, format!("{missing} per cent told"));
            }
            if let Some(said) = said.filter(|_| wrong.is_empty()) {
                before = said.judge(before, clock, &mut wrong);
                self.shown(said, before, &mut wrong);
            }
            if !wrong.is_empty() {
                break;
            }
        }
        findings.absorb(wrong);
    }

    /// Judges what the display shows of it.
    fn shown(&self, said: &Said, percent: f64, findings: &mut Findings) {
        let remaining = said.remaining().unwrap_or(0.0);
        let plain = format!("M73 P{percent}");
        let allowed: Vec<String> = match self.machine.controller.dialect {
            spec::Dialect::Klipper => vec![plain],
            // Minutes are rounded up from parts of a second that the comment does not tell.
            spec::Dialect::Marlin | spec::Dialect::RepRapFirmware => [remaining - 0.5, remaining + 0.5]
                .map(|seconds| format!("{plain} R{}", ((seconds / 60.0).ceil() + 0.0).max(0.0)))
                .to_vec(),
            _ => Vec::new(),
        };
        let line = said.comment.line + 1;
        match &said.display {
            None if allowed.is_empty() => {}
            Some(text) if allowed.contains(text) => {}
            text => {
                let found = text.as_ref().map_or("no M73".to_owned(), |text| quote(text));
                let allowed = allowed.first().map_or("no M73".to_owned(), |text| quote(text));
                findings.add(FindingCode::OtherComment, line, found, format!("{allowed} after the comment"));
            }
        }
    }
}

impl Said {
    fn remaining(&self) -> Option<f64> {
        self.comment.word("remaining_s")?.parse().ok().filter(|x: &f64| x.is_finite())
    }

    /// Judges the comment; the per cent that it tells.
    fn judge(&self, before: f64, clock: &Clock<'_>, findings: &mut Findings) -> f64 {
        let left = (clock.seconds - self.at).max(0.0);
        let slack = clock.slack();
        let percent = self.comment.word("percent").and_then(|text| text.parse::<u32>().ok()).map(f64::from);
        // Every whole per cent is told where it is reached: not before, nor after the next.
        let whole = |seconds: f64| (100.0 * seconds / clock.seconds).floor();
        let reached = whole(self.at - slack)..=whole(self.at + slack);
        let right = percent.is_some_and(|percent| reached.contains(&percent) && percent > before)
            && self.remaining().is_some_and(|seconds| (seconds - left).abs() <= 0.501 + slack)
            && self.comment.text.split_whitespace().count() == 3;
        if !right {
            let allowed = format!("{} per cent, {left:.0} s to go", whole(self.at));
            let found = quote(&self.comment.text);
            findings.add(FindingCode::OtherComment, self.comment.line, found, allowed);
        }
        percent.unwrap_or(before)
    }
}
