//! Comments against the design: what is told to the operator, and what `resume` goes by.
//!
//! Every comment is one that the design asks for, each in its place and once: structured or prose, a comment is a fact.

use std::collections::BTreeMap;

use crate::verify::finding::quote;
use crate::verify::judge::facts::Facts;
use crate::verify::judge::rules::{IronRules, Phase};
use crate::verify::read::gcode::{Comment, MoveKind, Program};
use crate::verify::{FindingCode, Findings};

/// Figures of time are made by adding up strokes and travels: this part of them may be otherwise, and a second.
const TIME: f64 = 0.005;
/// Figures of length are told to a thousandth, mm.
const LENGTH: f64 = 2e-3;
/// All others, beside their sixth digit.
const EXACT: f64 = 1e-6;

/// Reports every comment that the design does not ask for, and the first that is missing.
pub(super) fn check(
    facts: &Facts<'_>,
    clock: &Clock,
    text: &str,
    program: &Program,
    findings: &mut Findings,
) {
    let script = &facts.expected.machine.script;
    let own: Vec<&str> = script.start.iter().chain(&script.end).map(|line| remark(line)).collect();
    let first = program.motion().map_or(usize::MAX, |(first, _)| first);
    let displays = displays(text);
    let room = facts.expected.machine.controller.line_length;
    let (wanted, head) = facts.all();
    let mut wanted = wanted.into_iter().zip(1..);
    let mut told = 0;
    let count = program.comments.len();
    for (comment, i) in program.comments.iter().zip(1..) {
        // The last one counts the lines: the reader has judged it.
        if i == count || comment.text.is_empty() || own.contains(&comment.text.as_str()) {
            continue;
        }
        if comment.key() == Some("progress") {
            told = clock.progress(comment, told, &displays, findings);
            continue;
        }
        let next = wanted.next();
        let right = next.as_ref().is_some_and(|(wanted, place)| {
            says(&comment.text, wanted, room) && (*place > head) == (comment.line > first)
        });
        if !right {
            let allowed = next.map_or("no further comment".to_owned(), |(wanted, _)| quote(&wanted));
            findings.add(FindingCode::OtherComment, comment.line, quote(&comment.text), allowed);
            return;
        }
    }
    if let Some((wanted, _)) = wanted.next() {
        findings.add(FindingCode::OtherComment, None, "nothing more said", quote(&wanted));
    }
}

/// The lines that show the progress on a display, by their number.
fn displays(text: &str) -> BTreeMap<usize, &str> {
    let lines = (1..).zip(text.lines());
    lines.filter(|(_, line)| line.starts_with("M73")).collect()
}

/// The remark of a line of the profile.
fn remark(line: &str) -> &str {
    let after = line.split_once(';').map(|(_, text)| text);
    let within = line.strip_prefix('(').and_then(|text| text.strip_suffix(')'));
    after.or(within).unwrap_or_default().trim()
}

/// Whether a comment says what is wanted, as far as a line has room for it.
fn says(found: &str, wanted: &str, room: usize) -> bool {
    if let Some(name) = wanted.strip_prefix("name: ") {
        return found.strip_prefix("name:").is_some_and(|found| is_name(found.trim(), name.trim(), room));
    }
    let (mut found_words, mut wanted_words) = (found.split(' '), wanted.split(' '));
    loop {
        match (found_words.next(), wanted_words.next()) {
            (None, None) => return true,
            (Some(a), Some(b)) if a == b || is_same_figure(a, b) || is_name(a, b, room) => {}
            // Cut at the end of the line.
            (None, Some(_)) => return found.len() + 4 >= room,
            (Some(a), Some(b)) => {
                return found.len() + 4 >= room && b.starts_with(a) && found_words.next().is_none();
            }
            (Some(_), None) => return false,
        }
    }
}

/// Whether `found` is a name or another text of the user's, in which only what means nothing to a controller is left.
fn is_name(found: &str, wanted: &str, room: usize) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || " .,-_+=:/$".contains(c);
    let mut wanted = wanted.chars();
    let alike = |f: char, w: char| f == w || (f == '_' && (!plain(w) || w == '$'));
    let same = found.chars().all(|f| wanted.next().is_some_and(|w| alike(f, w)));
    same && (wanted.all(|c| c == ' ') || found.len() + 10 >= room)
}

/// Whether both are the same word with the same number, to the tolerance of its kind.
fn is_same_figure(found: &str, wanted: &str) -> bool {
    let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
    let (word, found, wanted) = match (found.split_once('='), wanted.split_once('=')) {
        (Some((a, found)), Some((b, wanted))) if a == b => (a, found, wanted),
        (None, None) => ("", found, wanted),
        _ => return false,
    };
    let (Some(found), Some(wanted)) = (number(found), number(wanted)) else { return false };
    let allowed = match word {
        "time_s" => 1.0 + TIME * wanted.abs(),
        "length_mm" => LENGTH,
        _ => EXACT * wanted.abs().max(1.0),
    };
    (found - wanted).abs() <= allowed
}

/// How far the job is at each of its lines: the verifier's own reckoning.
pub(super) struct Clock {
    /// Line of each move, and the time before it, s.
    begins: Vec<(usize, f64)>,
    /// Time for all of it, s.
    pub(super) seconds: f64,
}

impl Clock {
    /// Contact is on its schedule, which the pace is judged by; a travel takes its length and speeds up and brakes.
    pub(super) fn new(rules: &IronRules<'_>, program: &Program) -> Self {
        let speed = rules.process.travel_speed.0;
        let a = rules.motion.acceleration.map_or(f64::INFINITY, |a| a.0);
        // Too short to reach its speed: half the way is for speeding up.
        let travel = |length: f64| {
            if length * a < speed * speed { 2.0 * (length / a).sqrt() } else { length / speed + speed / a }
        };
        // The first way to somewhere is from X0 Y0, where every program ends.
        let first = program.moves.first().map_or(0.0, |step| step.from.x.hypot(step.from.y));
        let mut begins = Vec::with_capacity(program.moves.len());
        let mut seconds = if first > 0.0 { travel(first) } else { 0.0 };
        for step in &program.moves {
            begins.push((step.line, seconds));
            let length = step.length();
            seconds += match step.kind {
                MoveKind::Rapid if length > 0.0 => travel(length),
                _ if rules.phase(step) == Phase::Clear => step.feed.map_or(0.0, |feed| length / feed * 60.0),
                _ => length / rules.seal.speed.0,
            };
        }
        Self { begins, seconds }
    }

    /// Judges what a comment says of the progress, and the display's line after it; the per cent that it tells.
    fn progress(
        &self,
        comment: &Comment,
        before: u32,
        displays: &BTreeMap<usize, &str>,
        findings: &mut Findings,
    ) -> u32 {
        let at = self.begins.partition_point(|(line, _)| *line < comment.line);
        let done = self.begins.get(at).map_or(self.seconds, |(_, done)| *done);
        let left = (self.seconds - done).max(0.0);
        // Seconds of a long job are more than any coordinate may be.
        let number = |word| comment.word(word)?.parse::<f64>().ok().filter(|x| x.is_finite());
        let (percent, remaining) = (number("percent"), number("remaining_s"));
        let slack = 2.0 + TIME * self.seconds;
        let whole = 100.0 * done / self.seconds;
        let near = |percent: f64| (percent - whole).abs() <= 1.0 + 100.0 * slack / self.seconds;
        let right = percent.is_some_and(|percent| near(percent) && percent > f64::from(before))
            && remaining.is_some_and(|seconds| (seconds - left).abs() <= slack)
            && comment.text.split_whitespace().count() == 3;
        if !right {
            let allowed = format!("about {whole:.0} per cent, {left:.0} s to go");
            findings.add(FindingCode::OtherComment, comment.line, quote(&comment.text), allowed);
        }
        let (percent, minutes) = (percent.unwrap_or(0.0), (remaining.unwrap_or(0.0) / 60.0).ceil());
        let shown = displays.get(&(comment.line + 1)).copied().unwrap_or_default();
        let plain = format!("M73 P{percent}");
        // Minutes are rounded up from parts of a second that the comment does not tell.
        let timed = [minutes, minutes + 1.0].map(|minutes| format!("{plain} R{minutes}"));
        if !shown.is_empty() && shown != plain && !timed.iter().any(|timed| shown == timed) {
            let allowed = format!("{}, as the comment before it says", quote(&timed[0]));
            findings.add(FindingCode::OtherComment, comment.line + 1, quote(shown), allowed);
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a percentage, kept in range"
        )]
        let percent = percent.clamp(0.0, 100.0) as u32;
        percent
    }
}
