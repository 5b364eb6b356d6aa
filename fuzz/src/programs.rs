//! Programs: read in every dialect, and gone on with.

use std::sync::OnceLock;

use stargrip_cam::artifact::Kind;
use stargrip_cam::geom::{Bounds, Point};
use stargrip_cam::resume::{ResumeAt, Resumed, resume as go_on};
use stargrip_cam::spec::{Comments, Machine};
use stargrip_cam::verify::gcode::{Dialect, Move, MoveKind, Program, read_program};

use super::builds::{CHOPPED, PROFILES, SMALL, built};
use super::edits::{Choices, counted, edited};
use super::shown;

/// An edited job or, from 128 on, any text as a program, in the dialect of the first byte; its line ends do not matter.
pub(super) fn gcode(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let kind = usize::from(choices.byte());
    let bytes = if kind < 128 {
        edited(jobs()[kind % PROFILES.len()].as_bytes(), &mut choices)
    } else {
        choices.rest().to_vec()
    };
    let Ok(text) = std::str::from_utf8(&bytes) else { return };
    let dialect = &dialects()[kind % (2 * PROFILES.len())];
    let program = read_program(text, dialect.clone());
    assert_eq!(program.lines, text.split_inclusive('\n').count());
    assert!(program.moves.is_sorted_by_key(|step| step.line));
    for step in &program.moves {
        assert!(step.length().is_finite() && step.feed.is_none_or(|feed| feed > 0.0), "{step:?}");
    }
    assert!(program.dwells.iter().all(|dwell| dwell.seconds.is_finite() && dwell.seconds >= 0.0));
    shown::findings(&program.findings);
    if !text.contains('\r') {
        assert_eq!(read_program(&text.replace('\n', "\r\n"), dialect.clone()), program);
    }
}

/// The dialects, with comments after semicolons and between parentheses.
fn dialects() -> &'static [Dialect] {
    static DIALECTS: OnceLock<Vec<Dialect>> = OnceLock::new();
    DIALECTS.get_or_init(|| {
        let controller = |name: &str| Machine::builtin(name).expect("built in").controller;
        let marks = [Comments::Semicolon, Comments::Parentheses];
        let all = marks.iter().flat_map(|mark| PROFILES.iter().map(move |name| (mark, name)));
        all.map(|(mark, name)| {
            let mut controller = controller(name);
            controller.comments = *mark;
            Dialect::for_controller(&controller)
        })
        .collect()
    })
}

/// A job, edited or any text at all, gone on with at any place: refused, or a program that does nothing which the old one
/// does not do.
pub(super) fn resume(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let which = choices.byte();
    let place = match choices.byte() % 4 {
        0 => ResumeAt::Line(choices.below(1 << 16)),
        1 => ResumeAt::Share(choices.share() * 0.999),
        2 => ResumeAt::Near(Point::new(200.0 * choices.share(), 200.0 * choices.share())),
        // Up to a day, and beyond the end of most jobs.
        _ => ResumeAt::Time(86_400.0 * choices.share()),
    };
    let overlap = match choices.byte() {
        byte @ 1..64 => Some(f64::from(byte)),
        _ => None,
    };
    let job = if which == 255 {
        String::from_utf8_lossy(choices.rest()).into_owned()
    } else {
        let job = &jobs()[usize::from(which) % jobs().len()];
        counted(&String::from_utf8_lossy(&edited(job.as_bytes(), &mut choices)))
    };
    match go_on(&job, place, overlap) {
        Ok(resumed) => judge(&job, &resumed, overlap),
        Err(fault) => shown::line(&fault.to_string()),
    }
}

/// A job of every dialect, and of those that may have to chop a chopped one.
fn jobs() -> &'static [String] {
    static JOBS: OnceLock<Vec<String>> = OnceLock::new();
    JOBS.get_or_init(|| {
        let steady = PROFILES.iter().map(|name| (SMALL, *name));
        let chopped = ["grbl", "marlin"].into_iter().map(|name| (CHOPPED, name));
        let jobs = steady.chain(chopped).map(|(spec, name)| {
            let built = built(spec, name, &[Kind::SealGcode]);
            let job = built.artifacts.iter().find(|file| file.output.kind == Kind::SealGcode).expect("a job");
            String::from_utf8(job.bytes.clone()).expect("text")
        });
        jobs.collect()
    })
}

/// The moves that are allowed in the new program, derived from the old one alone.
fn judge(old_text: &str, resumed: &Resumed, overlap: Option<f64>) {
    let dialect = dialect_of(old_text);
    let old = read_program(old_text, dialect.clone());
    let new = read_program(&resumed.text, dialect);
    assert_eq!(new.findings, [], "the new program is without fault");
    assert!((0.0..=1.0).contains(&resumed.done) && resumed.overlap >= 0.0, "{resumed:?}");
    // Where short moves are joined, a seam is resumed only at a rest of the iron: at most a stroke farther back.
    let farther = if old_text.contains("chop-moves:") { longest_stroke(&old) } else { 0.0 };
    assert!(overlap.is_none_or(|asked| resumed.overlap <= asked + farther + 1e-6), "{resumed:?}");
    assert!(resumed.line >= 1 && resumed.line <= old.lines, "{}", resumed.line);
    let (area, contact) = (area(&old).outset(0.01), contact(&old));
    let fastest = |program: &Program| {
        let feeds = low(program, contact).map(|step| step.feed.unwrap_or(f64::INFINITY));
        feeds.fold(0.0, f64::max)
    };
    assert!(fastest(&new) <= fastest(&old) * 1.001, "faster: {} of {}", fastest(&new), fastest(&old));
    assert!(low(&new, contact).all(|step| step.kind == MoveKind::Feed && step.heated.is_some()));
    for step in &new.moves {
        assert!(step.to.z >= contact - 1e-9, "line {}: deeper", step.line);
        let at = step.to.xy();
        assert!(area.contains(at), "line {}: beyond the old program's way", step.line);
    }
    let hottest = |program: &Program| {
        let told = program.heats.iter().map(|heat| heat.celsius);
        told.chain(program.pauses.iter().filter_map(|pause| pause.heat)).fold(0.0, f64::max)
    };
    assert!(hottest(&new) <= hottest(&old) && hottest(&new) < 300.0, "{} C", hottest(&new));
}

/// The dialect that a job names, with its own lines' length and comments.
fn dialect_of(text: &str) -> Dialect {
    let told = |line: &str| line.starts_with("; machine: ") || line.starts_with("(machine: ");
    let line = text.lines().find(|line| told(line)).expect("a machine");
    let name = line.split("dialect=").nth(1).and_then(|rest| rest.split([' ', ')']).next());
    let index = PROFILES.iter().position(|known| Some(*known) == name).expect("a dialect");
    let marks = if text.starts_with('(') { PROFILES.len() } else { 0 };
    dialects()[index + marks].clone()
}

fn area(program: &Program) -> Bounds {
    let places = program.moves.iter().flat_map(|step| [step.from.xy(), step.to.xy()]);
    let paths = program.moves.iter().filter_map(|step| step.path).map(|path| path.bounds());
    paths.fold(Bounds::of_points(places), Bounds::union)
}

/// The lowest that a program goes.
fn contact(program: &Program) -> f64 {
    program.moves.iter().map(|step| step.to.z).fold(f64::INFINITY, f64::min)
}

/// The longest way in contact between two dwells, mm.
fn longest_stroke(program: &Program) -> f64 {
    let mut dwells = program.dwells.iter().map(|dwell| dwell.line).peekable();
    let (mut run, mut longest) = (0.0, 0.0_f64);
    for step in low(program, contact(program)) {
        while dwells.next_if(|line| *line < step.line).is_some() {
            run = 0.0;
        }
        run += step.length();
        longest = longest.max(run);
    }
    longest
}

/// The moves at the height of contact.
fn low(program: &Program, contact: f64) -> impl Iterator<Item = &Move> {
    program.moves.iter().filter(move |step| step.from.z.max(step.to.z) <= contact + 1e-6)
}
