//! Programs: path, speed and temperature of the iron, and malformed G-code.

use super::{
    SEAL, TRACE, assert_found, assert_later_fault, assert_program_fault, contact, forged, forged_in, nth,
    with_lines,
};
use crate::support;

#[test]
fn a_moved_point_is_found() {
    assert_program_fault("deviation", |lines| {
        let i = contact(lines, 0) + 4;
        let x = lines[i].split_whitespace().nth(1).expect("a word")[1..].parse::<f64>().expect("a number");
        lines[i] = lines[i].replacen(&format!("X{x}"), &format!("X{}", x + 0.002), 1);
    });
}

#[test]
fn an_arc_for_a_controller_that_draws_none_is_found() {
    assert_program_fault("unknown-word", |lines| {
        let i = nth(lines, "G1 X", 40);
        lines[i] = lines[i].replacen("G1", "G3", 1) + " I1 J0";
    });
}

#[test]
fn a_loop_left_open_is_found() {
    assert_program_fault("open-loop", |lines| {
        let end = nth(lines, "; seam:", 1);
        // Without the last moves of the run; the way up begins where the run now ends.
        let _ = lines.drain(end - 12..end - 3);
    });
}

#[test]
fn a_cut_overlap_is_found() {
    assert_program_fault("missing-overlap", |lines| {
        // The way up, the lift to travel height and the travel come before the next seam.
        let lift = nth(lines, "; seam:", 1) - 3;
        let _ = lines.remove(lift - 1);
    });
}

#[test]
fn a_late_start_and_a_cut_corner_are_found() {
    assert_program_fault("late-start", |lines| {
        // The way down ends where the first move in contact should.
        let i = contact(lines, 0);
        let first = lines.remove(i);
        lines[i - 1] = format!("{first} Z-0.3 F6");
    });
    // The worst place is reported, and it lies further on: past a sharp corner that is cut the way back is taken for the way
    // there.
    assert_later_fault("deviation", |lines| {
        // The move that ends at a vertex of the path.
        let i = nth(lines, "G1 X271.7383 Y239.0098", 0);
        let _ = lines.remove(i);
    });
}

#[test]
fn going_back_is_found() {
    assert_program_fault("backwards", |lines| {
        let i = contact(lines, 0) + 2;
        let (first_line, back) = (lines[i].clone(), lines[i - 1].clone());
        lines.insert(i + 1, back);
        lines.insert(i + 2, first_line);
    });
}

#[test]
fn a_cold_or_wrongly_heated_iron_is_found() {
    assert_later_fault("cold-seal", |lines| {
        let pause = nth(lines, "M0", 0);
        let _ = lines.remove(pause);
    });
    assert_later_fault("cold-seal", |lines| {
        let heat = nth(lines, "; heat:", 0);
        lines[heat] = "; heat: temperature_C=180".to_owned();
    });
}

#[test]
fn a_wrong_feed_is_found() {
    assert_program_fault("wrong-feed", |lines| {
        let i = nth(lines, "G1 ", 0);
        lines[i] = lines[i].replace("F6", "F6.1");
    });
}

#[test]
fn fast_vertical_and_deep_moves_on_the_fabric_are_found() {
    assert_program_fault("rapid-in-contact", |lines| {
        let i = contact(lines, 0) + 1;
        lines[i] = lines[i].replacen("G1", "G0", 1);
    });
    assert_program_fault("plunge", |lines| {
        let i = contact(lines, 0);
        lines.insert(i, "G1 Z5".to_owned());
        lines.insert(i + 1, "G1 Z-0.3".to_owned());
    });
    assert_program_fault("too-deep", |lines| {
        let i = contact(lines, 0) + 1;
        lines[i] += " Z-0.4";
    });
}

#[test]
fn an_iron_at_rest_is_found() {
    // A tenth of the 2 mm band at 0.1 mm/s takes 2 s.
    assert_program_fault("iron-at-rest", |lines| lines.insert(contact(lines, 0) + 3, "G4 P2.1".to_owned()));
    assert_program_fault("iron-at-rest", |lines| lines.insert(contact(lines, 0) + 3, "M0".to_owned()));
    // Shorter, it leaves no scar, and the seam is late all the same.
    assert_program_fault("wrong-feed", |lines| lines.insert(contact(lines, 0) + 3, "G4 P1.9".to_owned()));
}

#[test]
fn a_move_off_the_sheet_is_found() {
    assert_program_fault("outside-work-area", |lines| {
        let i = nth(lines, "G0 X", 0);
        lines.insert(i, "G0 X-1 Y10".to_owned());
        lines.insert(i + 1, "G0 X2 Y10".to_owned());
    });
}

#[test]
fn missing_and_extra_seams_are_found() {
    // A missing line has no number.
    let missing = forged(SEAL, |program| {
        with_lines(program, |lines| {
            let (from, to) = (nth(lines, "; seam:", 1), nth(lines, "M2", 0) - 2);
            let _ = lines.drain(from..to);
        })
    });
    assert_found(&missing, "missing-seam", SEAL);
    assert_program_fault("extra-seam", |lines| {
        let end = nth(lines, "M2", 0);
        for (k, line) in
            ["G1 X50 Y50 F6", "G0 X50 Y60", "G0 Z5", "G1 X53 Y60 Z-0.3", "G1 X60 Y60", "G1 X63 Y60 Z5"]
                .into_iter()
                .enumerate()
        {
            lines.insert(end + k, line.to_owned());
        }
    });
}

#[test]
fn a_trace_that_touches_or_waits_or_lacks_a_path_is_found() {
    let low = forged(TRACE, |program| program.replace("G0 Z5 ", "G0 Z-0.3 "));
    assert_found(&low, "low-trace", TRACE);
    let hot = forged(TRACE, |program| {
        with_lines(program, |lines| {
            let i = nth(lines, "G0 Z30", 0);
            lines.insert(i + 1, "M0".to_owned());
        })
    });
    assert_found(&hot, "hot-trace", TRACE);
    let short = forged(TRACE, |program| {
        with_lines(program, |lines| {
            let (from, to) = (nth(lines, "G0 X", 2), nth(lines, "G0 Z30", 1));
            let _ = lines.drain(from..to);
        })
    });
    assert_found(&short, "missing-seam", TRACE);
}

#[test]
fn a_line_that_the_controller_would_not_read_is_found() {
    let insert = |line: &'static str| {
        move |lines: &mut Vec<String>| lines.insert(contact(lines, 0) + 3, line.to_owned())
    };
    assert_program_fault("unknown-word", insert("M104 S200"));
    assert_program_fault("bad-character", insert("(a comment that closes early) G0 Z-5"));
    assert_program_fault(
        "line-too-long",
        insert("; 34567890123456789012345678901234567890123456789012345678901234567890123"),
    );
    assert_later_fault("mode-unset", |lines| {
        let i = nth(lines, "G21", 0);
        let _ = lines.remove(i);
    });
}

/// Without an inlet the outer loop closes too, and has an overlap that can be missing.
#[test]
fn a_closed_outer_loop_is_checked_for_its_overlap() {
    let spec = format!("{}\n[inlet]\nnone = true\n", support::PAPER);
    let findings = forged_in(&spec, SEAL, |program| {
        with_lines(program, |lines| {
            let park = nth(lines, "G0 Z30", 1);
            let _ = lines.remove(park - 2);
        })
    });
    assert_found(&findings, "missing-overlap", SEAL);
}
