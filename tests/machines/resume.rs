//! Resumes at every move of a job: the new program seals the rest and an overlap, and nothing else.

use crate::{PROFILES, built, machine, profile, profiles_of, read_for, recounted, spec_text, star, text};
use stargrip_cam::geom::{Path, Point, Segment};
use stargrip_cam::pipeline::read_back;
use stargrip_cam::resume::{ResumeAt, ResumeFault, resume};
use stargrip_cam::spec::DialectFamily;
use stargrip_cam::verify::follow;
use stargrip_cam::verify::gcode::Move;
use std::env;

const FILE: &str = "star-1-seal.gcode";

pub(super) fn job(name: &str) -> String {
    text(&star(name), FILE)
}

fn moves(name: &str, text: &str) -> Vec<Move> {
    let program = read_for(&machine(profile(name)), text);
    assert_eq!(program.findings, [], "{name}");
    program.moves
}

/// The contacts in order: the ramp down and the run of each.
fn contacts(moves: &[Move]) -> Vec<(Vec<Move>, Vec<Move>)> {
    let mut out: Vec<(Vec<Move>, Vec<Move>)> = Vec::new();
    let mut clear = true;
    for step in moves {
        let (low, high) = (step.from.z.min(step.to.z), step.from.z.max(step.to.z));
        if low > 5.0 - 1e-6 {
            clear = true;
            continue;
        }
        if clear {
            out.push(Default::default());
            clear = false;
        }
        let last = out.last_mut().expect("pushed");
        if high < -0.299 {
            last.1.push(*step);
        } else if step.to.z < step.from.z {
            last.0.push(*step);
        }
    }
    out
}

fn segments(steps: &[Move]) -> Vec<Segment> {
    steps.iter().filter_map(|step| step.path).collect()
}

fn length(steps: &[Move]) -> f64 {
    steps.iter().map(Move::length).sum()
}

/// Resumes at `line` and compares the sealed path with the remaining one.
fn check(name: &str, job: &str, whole: &[(Vec<Move>, Vec<Move>)], line: usize) {
    // The completed parts of the contacts before `line`, of the interrupted one only a part.
    let done = |run: &[Move]| run.iter().filter(|step| step.line < line).map(Move::length).sum::<f64>();
    let resumed = match resume(job, ResumeAt::Line(line), None) {
        Ok(resumed) => resumed,
        Err(ResumeFault::NothingLeft) => {
            assert!(whole.iter().all(|(_, run)| done(run) >= length(run) - 1e-9), "{name} line {line}");
            return;
        }
        Err(fault) => panic!("{name} line {line}: {fault}"),
    };
    // Marlin joins short moves: there a seam continues at a stop, up to a stroke farther back.
    let overlap = if name == "marlin" { resumed.overlap.max(5.0) } else { 5.0 };
    assert!(overlap < 5.2, "{name} line {line}: {overlap}");
    let rest_moves = moves(name, &resumed.text);
    let rest = contacts(&rest_moves);
    assert!(!rest.is_empty(), "{name} line {line}");
    let first = whole.len() - rest.len();
    let begun = &whole[first].1;
    assert!(done(begun) < length(begun) - 1e-9, "{name} line {line}: a whole seam is sealed again");
    for (_, run) in &whole[..first] {
        assert!(done(run) >= length(run) - 1e-9, "{name} line {line}: a seam is left out");
    }
    for (i, ((down, run), (old_down, old_run))) in rest.iter().zip(&whole[first..]).enumerate() {
        assert!(run.iter().chain(down).all(|step| step.heated == Some(200.0)), "{name} line {line}: cold");
        if i > 0 && segments(run) == segments(old_run) && segments(down) == segments(old_down) {
            continue;
        }
        let start = if i == 0 { (done(old_run) - overlap).max(0.0) } else { 0.0 };
        let whole_run = Path::open(segments(old_run));
        let exact = whole_run.part(start, whole_run.length());
        let walked = follow(&segments(run), &exact);
        assert!(walked.largest() < 0.002, "{name} line {line}: {walked:?}");
        assert!(
            walked.start < 0.002 && walked.end > exact.length() - 0.002,
            "{name} line {line}: {walked:?}"
        );
        assert!((walked.length - exact.length()).abs() < 0.01, "{name} line {line}: {walked:?}");
        assert!(
            walked.jump.is_none_or(|(gap, _)| gap < 1e-6)
                && walked.backwards.is_none_or(|(by, _)| by < 0.001)
        );
        // The ramp down follows the seam, or its own ramp.
        let track = Path::open(segments(old_down).into_iter().chain(whole_run.segments.clone()).collect());
        let track = track.part(start, start + 3.0);
        let ramp = follow(&segments(down), &track);
        assert!(ramp.largest() < 0.002, "{name} line {line}: {ramp:?}");
        let flat: f64 = segments(down).iter().map(Segment::length).sum();
        assert!((flat - 3.0).abs() < 0.01, "{name} line {line}: a ramp of {flat} mm");
    }
}

/// At every second move in one dialect, at the others in another.
#[test]
fn at_every_move_of_a_job() {
    for (first, name) in ["generic", "klipper"].into_iter().enumerate() {
        let job = job(name);
        let original = moves(name, &job);
        let whole = contacts(&original);
        for step in original.iter().skip(first).step_by(2) {
            check(name, &job, &whole, step.line);
        }
    }
}

/// Any line, comments and waits too: `RESUMES=500` sets their number for every dialect's job, `DIALECTS=grbl,marlin` selects dialects
/// (docs/resume.md).
#[test]
fn at_many_lines_of_chopped_jobs_and_in_every_dialect() {
    let count = env::var("RESUMES").ok().and_then(|count| count.parse().ok()).unwrap_or(23);
    let chosen = env::var("DIALECTS").ok();
    let is_chosen =
        |name: &&str| chosen.as_ref().is_none_or(|chosen| chosen.split(',').any(|one| one == *name));
    for name in PROFILES.into_iter().filter(is_chosen) {
        let job = job(name);
        let whole = contacts(&moves(name, &job));
        let lines = job.lines().count();
        let mut tried: Vec<usize> = (0..count).map(|i| 1 + i * (lines - 1) / (count - 1).max(1)).collect();
        tried.dedup();
        for line in &tried {
            check(name, &job, &whole, *line);
        }
        let dwells = job.lines().filter(|line| line.starts_with("G4")).count();
        let arcs = job.lines().filter(|line| line.starts_with("G2 ") || line.starts_with("G3 ")).count();
        println!("{name}: {} of {lines} lines, {dwells} waits, {arcs} arcs", tried.len());
    }
}

/// The path back may end just before the end of a stroke: the controller would run on from there into the first old stroke, which is timed
/// from a stop.
#[test]
fn a_sliver_of_a_stroke_is_taken_up_with_the_next() {
    for name in ["grbl", "marlin"] {
        let job = job(name);
        let run = &contacts(&moves(name, &job))[1].1;
        for (i, sliver) in [(200, 1e-4), (303, 1e-3), (404, 3e-3), (555, 6e-3), (600, 0.02)] {
            let overlap = length(&run[i - 20..i]) + sliver;
            let resumed = resume(&job, ResumeAt::Line(run[i].line), Some(overlap));
            let resumed = resumed.unwrap_or_else(|fault| panic!("{name} {i} {sliver}: {fault}"));
            let most = if name == "marlin" { 0.2 } else { 1e-6 };
            assert!((-1e-6..most).contains(&(resumed.overlap - overlap)), "{name} {i}: {}", resumed.overlap);
        }
    }
}

#[test]
fn the_way_back_carries_its_feeds_where_g0_has_none_of_its_own() {
    for name in profiles_of(DialectFamily::Printer) {
        let text = resume(&job(name), ResumeAt::Share(0.4), None).expect("resumed").text;
        let mut after_travel = false;
        for line in text.lines().filter(|line| line.starts_with('G') && line.contains(['X', 'Y', 'Z'])) {
            let travel = line.starts_with("G0 ");
            assert!(!travel || line.ends_with(" F1200"), "{name}: {line}");
            assert!(!after_travel || line.contains(" F"), "{name}: {line}");
            after_travel = travel;
        }
    }
}

/// A program states the timing of its strokes, so that the path back is chopped like the rest.
#[test]
fn the_way_back_is_timed_as_the_rest() {
    for name in ["grbl", "marlin"] {
        let job = job(name);
        let resumed = resume(&job, ResumeAt::Share(0.5), None).expect("resumed").text;
        // In contact: on the ramp down the strokes are cut again.
        let again: Vec<&str> =
            resumed.lines().skip_while(|line| !line.starts_with("; seam:")).take(400).collect();
        let contact = again.windows(2).filter(|two| !two[0].contains('Z') && two[1].starts_with("G4 P"));
        let known: std::collections::BTreeSet<&str> = job.lines().filter(|l| l.starts_with("G4 P")).collect();
        let (count, others) = contact
            .fold((0, 0), |(count, others), two| (count + 1, others + i32::from(!known.contains(two[1]))));
        assert!(count > 50 && others < 5, "{name}: {others} of {count}");
        // An older program does not state its controller's steps: it is resumed all the same.
        let old: Vec<&str> = job.lines().filter(|line| !line.starts_with("; chop-st")).collect();
        assert!(resume(&recounted(&old), ResumeAt::Share(0.5), None).is_ok());
    }
}

/// The value of `word` in the first comment with this key.
fn word(text: &str, key: &str, word: &str) -> f64 {
    let line = text.lines().find(|line| line.starts_with(&format!("; {key}: "))).expect(key);
    let value = line.split(' ').find_map(|one| one.strip_prefix(&format!("{word}=")));
    value.and_then(|value| value.parse().ok()).expect(word)
}

/// The rest states its own length and time, and those of the whole job; hosts read the time of the rest.
#[test]
fn the_rest_tells_its_own_time() {
    for name in ["generic", "klipper", "grbl", "marlin"] {
        let job = job(name);
        let (length, time) = (word(&job, "total", "length_mm"), word(&job, "total", "time_s"));
        for share in [0.1, 0.37, 0.8] {
            let rest = resume(&job, ResumeAt::Share(share), Some(0.0)).expect("resumed");
            let told = word(&rest.text, "total", "time_s");
            assert!((told - rest.seconds).abs() <= 0.5, "{name}: {told}");
            // A ramp and travels are added, which take a minute and a few seconds of acceleration.
            let more = told - (1.0 - share) * time;
            assert!((53.0..77.0).contains(&more), "{name} {share}: {told}, {more} more than the share");
            assert_eq!(word(&rest.text, "job", "time_s"), time, "{name}");
            assert_eq!(word(&rest.text, "job", "length_mm"), length, "{name}");
            // In contact, as the moves are.
            let sealed: f64 =
                contacts(&moves(name, &rest.text)).iter().map(|(_, run)| self::length(run)).sum();
            assert!((word(&rest.text, "total", "length_mm") - sealed).abs() < 0.1, "{name}");
            let seams = rest.text.lines().filter(|line| line.starts_with("; length: ")).count();
            assert_eq!(
                seams,
                rest.text.lines().filter(|line| line.starts_with("; seam: ")).count(),
                "{name}"
            );
            let hosts = rest.text.lines().filter(|line| line.contains("estimated printing time = ")).count();
            assert_eq!(hosts, usize::from(name == "klipper"), "{name}");
            let twice = resume(&rest.text, ResumeAt::Share(f64::midpoint(share, 1.0)), None).expect("twice");
            assert_eq!(word(&twice.text, "job", "time_s"), time, "{name}");
            assert!(twice.seconds < 0.6 * rest.seconds + 60.0, "{name}");
        }
    }
}

/// A rest shows the percentages of the whole job, so a share is one of the whole job in it, too.
#[test]
fn a_share_is_one_of_the_whole_job_however_often_it_was_resumed() {
    for name in ["generic", "klipper", "grbl", "marlin"] {
        let job = job(name);
        let once = resume(&job, ResumeAt::Share(0.5), None).expect("once");
        let again = resume(&once.text, ResumeAt::Share(0.6), None).expect("again");
        for text in [&once.text, &again.text] {
            let [whole, rest] =
                [&job, text].map(|text| resume(text, ResumeAt::Share(0.75), None).expect("resumed"));
            assert!(
                (rest.done - 0.75).abs() < 1e-3 && (whole.done - 0.75).abs() < 1e-3,
                "{name}: {}",
                rest.done
            );
            // The times in a file are whole seconds, and acceleration is a few more.
            assert!((rest.seconds - whole.seconds).abs() < 5.0, "{name}: {} {}", rest.seconds, whole.seconds);
        }
        // The program shows it at the same place.
        if let Some(at) = once.text.lines().position(|line| line.starts_with("M73 P75")) {
            let by_line = resume(&once.text, ResumeAt::Line(at + 1), None).expect("by line");
            assert!((by_line.done - 0.75).abs() < 0.01, "{name}: {}", by_line.done);
        }
        // What lies before the rest is in another program; displays show whole percentages.
        let early = resume(&again.text, ResumeAt::Share(0.1), None);
        let Err(ResumeFault::BeforeStart(start)) = early else { panic!("{name}: {early:?}") };
        assert!((0.58..0.6).contains(&start), "{name}: {start}");
        let shown = resume(&again.text, ResumeAt::Share(start - 0.009), None).expect("its start");
        assert!((shown.seconds - again.seconds).abs() < 120.0, "{name}");
    }
}

#[test]
fn by_time_and_by_place() {
    let job = job("generic");
    let half = resume(&job, ResumeAt::Share(0.5), Some(2.0)).expect("in the middle");
    assert!((half.done - 0.5).abs() < 1e-3 && (half.overlap - 2.0).abs() < 1e-9);
    let original = moves("generic", &job);
    let middle = contacts(&original)[1].1[10];
    let at = middle.path.expect("a path").point(0.5);
    let near = resume(&job, ResumeAt::Near(at), None).expect("near");
    let by_line = resume(&job, ResumeAt::Line(middle.line), None).expect("by line");
    assert!(near.done > by_line.done && near.done - by_line.done < 0.01);
    let nowhere = resume(&job, ResumeAt::Near(Point::new(-500.0, 0.0)), None);
    assert!(matches!(nowhere, Err(ResumeFault::Nowhere(_))), "{nowhere:?}");
    assert!(matches!(resume(&job, ResumeAt::Line(0), None), Err(ResumeFault::NoSuchLine(0, _))));
}

#[test]
fn a_resumed_job_can_be_resumed_and_a_damaged_one_cannot() {
    for name in ["generic", "grbl", "marlin"] {
        let job = job(name);
        let once = resume(&job, ResumeAt::Share(0.3), None).expect("once").text;
        let twice = resume(&once, ResumeAt::Share(0.5), None).expect("twice").text;
        assert!(twice.len() < once.len() && once.len() < job.len());
        let _ = moves(name, &twice);
        let cut = &job[..job.len() / 2];
        assert!(matches!(resume(cut, ResumeAt::Share(0.3), None), Err(ResumeFault::Damaged(_))), "{name}");
    }
    assert!(matches!(resume("", ResumeAt::Line(1), None), Err(ResumeFault::NotOurs(_))));
    let trace = text(&built(&spec_text(""), profile("generic")), "star-1-trace.gcode");
    assert_eq!(resume(&trace, ResumeAt::Line(1), None), Err(ResumeFault::Trace));
}

/// Comments longer than a line lost their last digits, so that `resume` lost the seal's settings.
#[test]
fn a_comment_that_is_longer_than_a_line_keeps_its_digits() {
    let seal = "[seal]\nspeed = \"2.608620702277 mm/s\"\nband = \"1.6123456789 mm\"\noverlap = \"6.8117535114 mm\"\n";
    let build = built(&spec_text(seal), profile("generic"));
    assert_eq!(read_back(&build.output_files()).findings, []);
    let job = text(&build, FILE);
    for part in [
        "; seal: temperature_C=200 speed_mm_s=2.608620702 band_mm=1.612345679\n",
        "; seal: overlap_mm=6.811753511\n",
    ] {
        assert!(job.contains(part), "{part}");
    }
    let rest = resume(&job, ResumeAt::Share(0.4), None).expect("resumed");
    assert!((rest.overlap - 6.811_753_511).abs() < 1e-9, "{}", rest.overlap);
    // Missing or wrong digits are found.
    for (from, to) in
        [("overlap_mm=6.811753511", "overlap_mm=6.8117"), ("; seal: overlap", "; path: overlap")]
    {
        let found = crate::findings_with(&build, FILE, &job.replace(from, to));
        assert_eq!(found.first().map(|finding| finding.code), Some("other-comment"), "{to}");
    }
}

/// Without the path back, the first old line still has the seal's feed.
#[test]
fn the_first_old_line_states_its_feed() {
    for name in PROFILES {
        let job = job(name);
        let resumed = resume(&job, ResumeAt::Share(0.4), None).expect("resumed");
        let old = job.lines().nth(resumed.line - 1).expect("a line");
        let text: Vec<&str> = resumed.text.lines().collect();
        let old_feed =
            |line: &str| line.starts_with('G') && !line.starts_with("G0") && !line.starts_with("G4");
        assert!(old_feed(old) || old.starts_with(';') || old.starts_with('M'), "{name}: {old}");
        // Counted from the end, both programs have the same lines, except the whole job's time.
        let whole = job.lines().filter(|line| line.starts_with("; estimated printing time")).count();
        let back = job.lines().count() - whole - resumed.line;
        let from = text.len() - 1 - back;
        let first = text[from..].iter().find(|line| old_feed(line)).expect("a cut");
        assert!(first.contains(" F"), "{name}: {first}");
    }
}
