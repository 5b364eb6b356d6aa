//! The rest of a laser's job: the beam goes on where it stopped, after an overlap, and is off on the way there.

use stargrip_cam::geom::Path;
use stargrip_cam::resume::{ResumeAt, ResumeFault, resume};
use stargrip_cam::spec::LASER_PROFILE;
use stargrip_cam::verify::gcode::Move;

use crate::clock::controller::{Motors, run};
use crate::clock::text::Text;
use crate::laser::{POWERS, SEAL, profile_of};
use crate::{machine, read_for, recounted, spec_text, text, try_built};

/// Overlap of the closures, mm.
const OVERLAP: f64 = 5.0;

/// The S word in force in each line of `program`, from line 1; 0 while the laser is off.
fn words(program: &str) -> Vec<f64> {
    let (mut armed, mut word) = (false, 0.0);
    let mut words = vec![0.0];
    for line in program.lines() {
        let code = line.split(';').next().unwrap_or_default();
        for token in code.split_whitespace() {
            match token {
                "M4" => armed = true,
                "M5" => armed = false,
                _ => word = token.strip_prefix('S').map_or(word, |word| word.parse().expect("a number")),
            }
        }
        words.push(if armed { word } else { 0.0 });
    }
    words
}

/// Moves with the beam on, each with its power.
fn lit(dialect: &str, program: &str) -> Vec<(Move, f64)> {
    let read = read_for(&machine(&profile_of(dialect)), program);
    assert_eq!(read.findings, [], "{dialect}");
    let powers_of_lines = words(program);
    read.moves
        .iter()
        .map(|step| (*step, powers_of_lines[step.line]))
        .filter(|(_, word)| *word > 0.0)
        .collect()
}

fn powers(moves: &[(Move, f64)]) -> Vec<f64> {
    moves.iter().map(|(_, word)| *word).collect()
}

fn length(moves: &[(Move, f64)]) -> f64 {
    moves.iter().map(|(step, _)| step.length()).sum()
}

#[test]
fn the_beam_goes_on_after_an_overlap_and_is_off_on_the_way() {
    for (dialect, count) in [("grbl", 60), ("grblhal", 12), ("fluidnc", 12)] {
        let build = try_built(&spec_text(POWERS), &profile_of(dialect)).expect("built");
        let job = text(&build, SEAL);
        let job_moves = lit(dialect, &job);
        let lines = job.lines().count();
        for line in (0..count).map(|i| 1 + i * (lines - 1) / (count - 1)) {
            let remaining: Vec<(Move, f64)> =
                job_moves.iter().filter(|(step, _)| step.line >= line).copied().collect();
            let resumed = match resume(&job, ResumeAt::Line(line), None) {
                Ok(resumed) => resumed,
                Err(ResumeFault::NothingLeft) => {
                    assert!(remaining.is_empty(), "{dialect} line {line}");
                    continue;
                }
                Err(fault) => panic!("{dialect} line {line}: {fault}"),
            };
            let rest = lit(dialect, &resumed.text);
            // No more is welded again than the overlap, and all that is left is welded at its power.
            let repeated = length(&rest) - length(&remaining);
            assert!(
                (-0.01..OVERLAP + 0.01).contains(&repeated),
                "{dialect} line {line}: {repeated} mm again"
            );
            assert!((repeated - resumed.overlap).abs() < 0.02, "{dialect} line {line}: {repeated}");
            let tail = &rest[rest.len() - remaining.len().min(rest.len())..];
            assert_eq!(powers(tail), powers(&remaining), "{dialect} line {line}");
            let path = Path::open(rest.iter().filter_map(|(step, _)| step.path).collect());
            for (step, _) in &remaining {
                let middle = step.path.expect("a path").point(0.5);
                assert!(path.distance(middle) < 0.002, "{dialect} line {line}: {middle:?} is left out");
            }
            // The beam is on at its focus alone.
            assert!(
                rest.iter().all(|(step, _)| step.from.z == step.to.z && step.to.z < 12.5),
                "{dialect} line {line}"
            );
            assert!(
                resumed.text.contains("; beam: armed_by=operator"),
                "{dialect} line {line}: nobody is asked"
            );
        }
    }
}

#[test]
fn the_rest_takes_as_long_as_it_states() {
    let job = text(&try_built(&spec_text(POWERS), &profile_of("grbl")).expect("built"), SEAL);
    let motors = Motors { acceleration: 500.0, steps_per_mm: 80.0 };
    for share in [0.1, 0.5, 0.9, 0.95] {
        let rest =
            resume(&job, ResumeAt::Share(share), None).unwrap_or_else(|fault| panic!("{share}: {fault}"));
        let program = Text::read(&rest.text);
        let stated = program.fact("total.time_s").expect("a time");
        let run_time = run(LASER_PROFILE, &program, motors).now;
        println!("{share}: {run_time:.2} s, stated {stated} s");
        assert!((run_time - stated).abs() < 0.002 * stated + 0.6, "{share}: {run_time:.2} of {stated} s");
    }
}

/// A rest of which a line was changed is not resumed again.
#[test]
fn a_changed_beam_is_found() {
    let job = text(&try_built(&spec_text(POWERS), &profile_of("grbl")).expect("built"), SEAL);
    let rest = resume(&job, ResumeAt::Share(0.4), None).expect("a rest").text;
    assert!(resume(&rest, ResumeAt::Share(0.6), None).is_ok());
    for (old, new) in [
        ("M4 S0\n", "M4 S80\n"),
        (" S95", " S195"),
        (" Z13 S0", " Z13"),
        ("\nM5\n", "\n"),
        ("M4 S0", "M3 S0"),
    ] {
        let travel = rest.find("\nG0 X").expect("a travel");
        let forged = format!("{}{}", &rest[..travel], rest[travel..].replacen(old, new, 1));
        assert_ne!(forged, rest, "{old}");
        let forged = recounted(&forged.lines().collect::<Vec<_>>());
        let fault = resume(&forged, ResumeAt::Share(0.6), None).expect_err(old);
        assert!(matches!(fault, ResumeFault::Disagrees(_)), "{old}: {fault}");
    }
}
