//! Chopped programs: the verifier agrees with the plan at every precision of the file and of the steps.

use std::f64::consts::TAU;

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::geom::{Point, Vec2};
use stargrip_cam::pipeline::{Sources, build, read_back};
use stargrip_cam::spec::{Source, read};

use crate::{built, findings_with, machine, profile, recounted, spec_text, text, try_built};

const CHOP: &str = "[machine]\nfeed_floor = \"chop\"\n";
const JOB: &str = "star-1-seal.gcode";

fn with_path(path: &str) -> String {
    spec_text(&format!("{CHOP}[accuracy]\npath = \"{path}\"\n"))
}

/// Positions in the file are rounded, and the steps to them as well: at 0.01 mm a stroke may have a step more or less than its exact ends
/// give, which on GRBL takes 33 ms.
#[test]
fn coarse_files_are_proven_on_every_chopping_profile() {
    for name in crate::with_floor() {
        for path in ["0.01 mm", "0.1 mm", "1 mm"] {
            let build = built(&with_path(path), profile(name));
            assert_eq!(read_back(&build.output_files()).findings, [], "{name} {path}");
        }
    }
}

/// Round hinges at 160 steps/mm and 10 mm/s^2, at the default precision.
#[test]
fn round_hinges_are_proven_at_160_steps() {
    let text = include_str!("../../designs/round-hinges.toml");
    let fine = profile("grbl").replace("steps_per_mm = 80", "steps_per_mm = 160");
    let build = built(&format!("{text}\n{CHOP}"), &fine);
    assert_eq!(read_back(&build.output_files()).findings, []);
}

/// A ramp of 0.05 mm for 10 mm of height: where the file states thousandths, its strokes would go straight down.
#[test]
fn a_ramp_steeper_than_the_file_can_state_is_refused() {
    let steep = profile("grbl")
        .replace("ramp = \"3 mm\"", "ramp = \"0.05 mm\"")
        .replace("contact = \"-0.3 mm\"", "contact = \"-5 mm\"");
    let refusals = try_built(&with_path("0.01 mm"), &steep).map(|_| ()).expect_err("a plunge");
    assert_eq!(refusals[0].code, "steep-ramp");
    let shortest = refusals[0].remedy.split(' ').find_map(|word| word.parse::<f64>().ok()).expect("a ramp");
    assert!(shortest > 0.05 && shortest < 1.0, "{}", refusals[0].remedy);
    let long_enough = steep.replace("0.05 mm", &format!("{shortest} mm"));
    for path in ["0.01 mm", "0.001 mm"] {
        let build = built(&with_path(path), &long_enough);
        assert_eq!(read_back(&build.output_files()).findings, [], "{path}");
    }
}

/// Marlin joins a move of fewer than six steps to the next one and keeps its dwell: no dwell follows such a move.
#[test]
fn marlin_dwells_only_after_moves_that_it_makes() {
    // Corners of 0.3 and 1 mm, whose chords are short.
    for corner in ["0.3 mm", "1 mm", "2 mm"] {
        let spec =
            spec_text(CHOP).replace("corner_radius = \"2 mm\"", &format!("corner_radius = \"{corner}\""));
        let build = built(&spec, profile("marlin"));
        assert_eq!(read_back(&build.output_files()).findings, [], "{corner}");
        let code = text(&build, JOB);
        let (mut position, mut executed) = ([0.0, 0.0], [0.0, 0.0]);
        let (mut last, mut dwells) = (0.0_f64, 0);
        for line in code.lines() {
            let word = |letter: char| {
                line.split(' ').find_map(|word| word.strip_prefix(letter)?.parse::<f64>().ok())
            };
            if line.starts_with("G0 ") || line.starts_with("G1 ") {
                position = [word('X').unwrap_or(position[0]), word('Y').unwrap_or(position[1])];
                let steps =
                    |i: usize| ((position[i] * 80.0).round() - (executed[i] * 80.0_f64).round()).abs();
                last = steps(0).max(steps(1)).max(if line.contains('Z') { 6.0 } else { 0.0 });
                if last >= 6.0 {
                    executed = position;
                }
            } else if line.starts_with("G4 ") {
                dwells += 1;
                assert!(last >= 6.0, "{corner}: {line} after {last} steps");
            }
        }
        assert!(dwells > 500, "{corner}");
    }
}

/// A custom `chop_feed` below the controller's lowest feed is refused in planning; the remedy's value is accepted.
#[test]
fn a_chop_feed_below_the_floor_is_refused() {
    let with_feed = |feed: &str| {
        let keys = format!("acceleration = \"10 mm/s^2\"\nchop_feed = \"{feed}\"");
        profile("grbl").replace("acceleration = \"10 mm/s^2\"", &keys)
    };
    // 22.9 mm/min along an axis and 32.4 mm/min at 45 degrees are the least.
    for feed in ["12 mm/min", "24 mm/min", "32 mm/min"] {
        let refusals = try_built(&spec_text(CHOP), &with_feed(feed)).map(|_| ()).expect_err(feed);
        let [refusal] = &refusals[..] else { panic!("{refusals:?}") };
        assert_eq!(refusal.code, "no-chop", "{refusals:?}");
        let word = |unit: &&str| *unit == "mm/s;";
        let words: Vec<&str> = refusal.remedy.split(' ').collect();
        let slowest = words.iter().position(word).and_then(|i| words.get(i - 1)).expect("a speed");
        let build = built(&spec_text(CHOP), &with_feed(&format!("{slowest} mm/s")));
        assert_eq!(read_back(&build.output_files()).findings, [], "{slowest}");
    }
}

/// A dwell after a move of a few steps is a finding: the controller waits before it has made the move.
#[test]
fn a_dwell_after_a_joined_move_is_found() {
    let build = built(&spec_text(CHOP), profile("marlin"));
    let code = text(&build, JOB);
    // The first long stroke of the seal is cut in two, the first of 2 steps, each with half of the dwell.
    let lines: Vec<&str> = code.lines().collect();
    let i = lines
        .windows(2)
        .position(|two| two[0].starts_with("G1 X") && !two[0].contains('Z') && two[1].starts_with("G4 P"));
    let i = i.expect("a stroke");
    let previous = lines[..i].iter().rev().find(|line| line.starts_with("G1 ")).expect("a move");
    let word = |line: &str, letter: char| {
        line.split(' ').find_map(|word| word.strip_prefix(letter)?.parse::<f64>().ok()).expect("a word")
    };
    let part = |letter: char| 0.8 * word(previous, letter) + 0.2 * word(lines[i], letter);
    let mut edited: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
    edited.insert(i, "G4 P200".to_owned());
    edited.insert(i, format!("G1 X{:.4} Y{:.4}", part('X'), part('Y')));
    let findings = findings_with(&build, JOB, &recounted(&edited));
    assert!(findings.iter().any(|finding| finding.code == "short-stroke"), "{findings:?}");
}

/// Pieces of a step or less on every controller: where positions are rounded, some are nothing and some a step, which takes a tenth of a
/// second from rest to rest on grblHAL's slow boards.
#[test]
fn dense_polylines_are_proven_on_every_chopping_profile() {
    let polyline = |count: u32, radius: f64, waves: f64| {
        let point = |i: u32| {
            let angle = f64::from(i) * TAU / f64::from(count);
            Point::new(100.0, 100.0) + Vec2::unit(angle) * (radius * (1.0 + 0.2 * libm::cos(waves * angle)))
        };
        let points: Vec<Point> = (0..count).map(point).collect();
        let path: Vec<String> = points.iter().map(|p| format!("{:.5} {:.5}", p.x, p.y)).collect();
        let [x, y] = [points[0].x - 4.0, points[0].y];
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"200mm\" viewBox=\"0 0 200 200\" fill=\"none\" \
             stroke=\"#000\"><g id=\"air\"><path d=\"M{}Z\"/></g><g id=\"port\"><path d=\"M{x:.5} {y:.5}h8\"/></g></svg>",
            path.join("L")
        )
    };
    let text = "schema = 1\nname = \"dense\"\n[drawing]\nfile = \"d.svg\"\n[drawing.layers]\nair = [\"air\"]\nport = [\"port\"]\n[machine]\n\
         profile = \"own.toml\"\nfeed_floor = \"chop\"\n".to_string();
    let reading = read(&Source::new("spec", text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    for name in crate::with_floor() {
        for (count, radius, waves) in [(1000, 40.0, 3.0), (1500, 25.0, 5.0), (2000, 55.0, 2.0)] {
            let polyline_spec = reading.clone().with_drawing(polyline(count, radius, waves).as_bytes()).spec;
            let sources = Sources { spec: &text, machine: profile(name) };
            let result = build(&polyline_spec, &machine(profile(name)), sources, &KindRequest::default());
            let result = result.unwrap_or_else(|refusals| panic!("{name} {count}: {refusals}"));
            assert_eq!(read_back(&result.output_files()).findings, [], "{name} {count} {radius} {waves}");
        }
    }
}
