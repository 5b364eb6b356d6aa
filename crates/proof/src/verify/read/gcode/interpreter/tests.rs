//! Hand-written programs, right and wrong.

use proptest::prelude::*;

use crate::verify::read::gcode::{Dialect, MoveKind, Point3, Program, read_program};
use geom::Segment;

const HEAD: &str = "G21\nG90\nG17\nG91.1\nG94\nG0 Z30\nG0 X0 Y0\n";

/// The body between a good head and a good end.
fn program(body: &str) -> String {
    let text = format!("{HEAD}{body}\nM2\n");
    let lines = text.lines().count() + 1;
    format!("{text}; end of program, {lines} lines\n")
}

/// As most controllers read it: G0 needs no feed.
fn read(text: &str) -> Program {
    read_program(text, Dialect { travel_at_feed: false, ..Dialect::GENERIC })
}

fn codes(text: &str) -> Vec<&'static str> {
    read(text).findings.iter().map(|finding| finding.code).collect()
}

#[test]
fn a_good_program() {
    let body = "; star: index=1 seam_mm=12.5\n; heat: temperature_C=200 by=operator\nM0\n\
                G0 X10 Y0\nG1 Z0 F60\nG1 X15 F6\nG3 X20 Y5 I0 J5\nG2 Y15 J5 F12\nG4 P2.5\nG1 Z5\nG0 Z30";
    let program = read(&program(body));
    assert_eq!(program.findings, []);
    assert_eq!(program.comment("star").and_then(|c| c.number("seam_mm")), Some(12.5));
    assert_eq!((program.pauses[0].line, program.pauses[0].heat), (10, Some(200.0)));
    assert_eq!((program.dwells[0].line, program.dwells[0].seconds), (16, 2.5));
    assert_eq!(program.end, Some(19));
    assert_eq!(program.lines, 20);
    let moves = &program.moves;
    assert_eq!(moves.len(), 7);
    assert_eq!((moves[0].kind, moves[0].line, moves[0].heated), (MoveKind::Rapid, 11, Some(200.0)));
    assert_eq!((moves[1].path, moves[1].feed, moves[1].to.z), (None, Some(60.0), 0.0));
    assert_eq!(moves[2].seconds(), Some(50.0));
    let Some(Segment::Arc(arc)) = moves[3].path else { panic!("{:?}", moves[3]) };
    assert!((arc.sweep - std::f64::consts::FRAC_PI_2).abs() < 1e-12 && (arc.radius - 5.0).abs() < 1e-12);
    let Some(Segment::Arc(arc)) = moves[4].path else { panic!("{:?}", moves[4]) };
    assert!((arc.sweep + std::f64::consts::PI).abs() < 1e-12);
    assert_eq!(moves[4].to, Point3::new(20.0, 15.0, 0.0));
    assert!((moves[4].length() - 5.0 * std::f64::consts::PI).abs() < 1e-12);
}

#[test]
fn other_modes_mean_the_same() {
    let metric = read(&program("G1 X25.4 F25.4\nG3 X50.8 Y25.4 I0 J25.4")).moves;
    for body in [
        "G20\nG1 X1 F1\nG3 X2 Y1 J1",
        "G91\nG1 X25.4 F25.4\nG3 X25.4 Y25.4 J25.4",
        "G90.1\nG1 X25.4 F25.4\nG3 X50.8 Y25.4 I25.4 J25.4",
        "G93\nG1 X25.4 F1\nG3 X50.8 Y25.4 J25.4 F0.6366197723675814",
    ] {
        let result = read(&program(body));
        assert_eq!(result.findings, [], "{body}");
        for (a, b) in metric.iter().zip(&result.moves) {
            assert!((a.to.x - b.to.x).abs() < 1e-12 && (a.to.y - b.to.y).abs() < 1e-12, "{body}");
            assert!((a.length() - b.length()).abs() < 1e-9, "{body}");
            assert!(a.feed.zip(b.feed).is_some_and(|(a, b)| (a - b).abs() < 1e-9), "{body}: {b:?}");
        }
    }
}

#[test]
fn every_seeded_fault_is_found() {
    for (body, code) in [
        ("G1 X5", "mode-unset"),
        ("M7", "unknown-word"),
        ("G18", "unknown-word"),
        ("G1.5 X1 F6", "unknown-word"),
        ("G90.15", "unknown-word"),
        ("N10 G0 X1", "unknown-word"),
        ("G0 X1 X2", "repeated-word"),
        ("G0 G1 X1 F6", "modal-conflict"),
        ("G4 P1 X1", "modal-conflict"),
        ("G4", "unused-word"),
        ("G1 X1 P1 F6", "unused-word"),
        ("G1 X1 I1 F6", "unused-word"),
        ("G4 P-1", "bad-number"),
        ("G1 X1 F0", "bad-feed"),
        ("G1 X1 F-6", "bad-feed"),
        ("G93\nG1 X1 F1\nG1 X2", "bad-feed"),
        ("G2 X5 F6", "bad-arc"),
        ("G2 F6", "bad-arc"),
        ("G2 I5 F6", "bad-arc"),
        ("G2 X10 Y0 I5.1 F6", "bad-arc"),
        ("G0 X1 (fast)", "bad-character"),
        ("; 123456789012345678901234567890123456789012345678901234567890123456789012", "line-too-long"),
        ("; heat: temperature_C=200\nG1 X1 F6", "heat-without-pause"),
        ("; heat: temperature_C=200", "heat-without-pause"),
        ("; heat: temperature_C=nan\nM0", "bad-comment"),
        ("M2\nG0 X1", "after-end"),
        ("G0 X1\n%", "unknown-word"),
    ] {
        assert_eq!(codes(&program(body)).first(), Some(&code), "{body}");
    }
}

#[test]
fn each_mode_is_needed() {
    let body = "G1 X5 Z0 F6\nG2 X5 Y10 J5";
    for mode in ["G21\n", "G90\n", "G17\n", "G91.1\n", "G94\n"] {
        let text = program(body).replacen(mode, "\n", 1);
        assert_eq!(codes(&text), ["mode-unset"], "{mode}");
    }
    let text = program("G1 X5 F6").replacen("G0 Z30\n", "\n", 1);
    assert_eq!(codes(&text)[0], "unknown-position");
    let text = program("G1 X5 F6").replacen("G0 X0 Y0\n", "\n", 1);
    assert_eq!(codes(&text)[0], "unknown-position");
    let text = program("G1 X5 F6").replacen("G90\n", "G91\n", 1);
    assert_eq!(codes(&text)[0], "unknown-position");
}

#[test]
fn a_cold_start_is_cold() {
    let program = read(&program("G1 X5 F6\nM0\nG1 X6"));
    assert!(program.moves.iter().all(|step| step.heated.is_none()));
    assert_eq!(program.pauses[0].heat, None);
}

#[test]
fn truncation_at_any_byte_is_found() {
    let text = program("; heat: temperature_C=200\nM0\nG1 X5 F6\nG1 Z5\nG0 Z30");
    assert_eq!(codes(&text), [""; 0]);
    for end in 0..text.len() {
        assert!(codes(&text[..end]).contains(&"truncated"), "cut at {end}: {:?}", &text[..end]);
    }
    assert!(codes(&format!("{text}\n")).contains(&"truncated"));
    assert!(codes(&text.replacen("\nM0", "", 1)).contains(&"truncated"));
    assert_eq!(codes(&text.replace('\n', "\r\n")), [""; 0]);
}

proptest! {
    #[test]
    fn any_text_is_read(text in "\\PC*|[GMXYZIJFP0-9. ;\\-\n\r:=a-z()]{0,200}") {
        let _ = read(&text);
    }

    #[test]
    fn any_words_are_executed(lines in proptest::collection::vec(("G(0|1|2|3|4|17|20|21|90|91|90.1|91.1|93|94)|M(0|2)|", "( [XYZIJFP]-?[0-9]{1,7}(\\.[0-9]{0,3})?){0,5}"), 0..30)) {
        let text = lines.into_iter().map(|(code, words)| code + &words).collect::<Vec<_>>().join("\n");
        for step in read(&text).moves {
            prop_assert!(step.length().is_finite());
        }
    }
}
