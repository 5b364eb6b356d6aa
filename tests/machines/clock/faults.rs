//! The clock detects each kind of fault: one fault each, in a correct program.

use super::controller::{Motors, run};
use super::judge::deviations;
use super::programs::{feed_check, machine, seals, spec};
use super::text::Text;
use super::{FIVE, own_motors};
use stargrip_cam::spec::DialectFamily;

/// The complaints about the program of `dialect` with `edit` applied.
fn complaints(dialect: &str, edit: impl Fn(&str) -> String) -> Vec<String> {
    let (spec, machine) = (spec(dialect, FIVE), machine(dialect, own_motors(dialect)));
    let (_, right) = &seals(&spec, &machine).0[0];
    let wrong = edit(right);
    assert_ne!(*right, wrong);
    let text = Text::read(&wrong);
    deviations(&text, &run(dialect, &text, own_motors(dialect)), spec.seal.speed.0, 0.0).1
}

/// The text with every line replaced by `edit`.
fn lines(code: &str, edit: impl Fn(&str) -> String) -> String {
    code.lines().map(|line| edit(line) + "\n").collect()
}

#[test]
fn dwells_that_are_a_tenth_longer_are_seen() {
    let found = complaints("grbl", |code| {
        lines(code, |line| match line.strip_prefix("G4 P").and_then(|time| time.parse::<f64>().ok()) {
            Some(time) => format!("G4 P{:.3}", 1.1 * time),
            None => line.to_owned(),
        })
    });
    assert!(found.iter().any(|complaint| complaint.contains("mean speed -")), "{found:?}");
    assert!(found.iter().any(|complaint| complaint.starts_with("total")), "{found:?}");
}

#[test]
fn strokes_without_dwells_are_run_together_and_seen() {
    let found = complaints("grbl", |code| {
        lines(code, |line| if line.starts_with("G4") { String::new() } else { line.to_owned() })
    });
    assert!(found.iter().any(|complaint| complaint.contains("mean speed +")), "{found:?}");
}

#[test]
fn a_travel_without_a_feed_of_its_own_crawls_and_is_seen() {
    for dialect in crate::profiles_of(DialectFamily::Printer) {
        let found = complaints(dialect, |code| {
            lines(
                code,
                |line| if line.starts_with("G0 ") { line.replace(" F1200", "") } else { line.to_owned() },
            )
        });
        assert!(found.iter().any(|complaint| complaint.starts_with("total")), "{dialect}: {found:?}");
    }
}

#[test]
fn the_lowest_speed_of_reprapfirmware_is_seen() {
    let found = complaints("reprapfirmware", |code| code.replace("M203 I5\n", ""));
    assert!(found.iter().any(|complaint| complaint.contains("mean speed +400")), "{found:?}");
}

/// Below the lowest step rate GRBL continues at it: 0.38 mm/s along X and Y, 0.54 at 45 degrees, at 80 steps/mm.
#[test]
fn the_floor_of_grbl_is_seen() {
    let motors = Motors { acceleration: 500.0, steps_per_mm: 80.0 };
    let fine = Motors { steps_per_mm: 800.0, ..motors };
    let spec = spec("grbl", FIVE);
    let steady = feed_check(&spec, &machine("grbl", fine)).1;
    let text = Text::read(&steady);
    let speeds = |motors| -> Vec<f64> {
        run("grbl", &text, motors).stretches.iter().map(super::track::Stretch::speed).collect()
    };
    for (speed, floor) in speeds(motors).into_iter().zip([0.3815, 0.3815, 0.5395]) {
        assert!((speed / floor - 1.0).abs() < 0.005, "{speed}, expected {floor}");
    }
    assert!(speeds(fine).iter().all(|speed| (speed / 0.1 - 1.0).abs() < 0.002));
}

/// A wait of 100 ms before each stroke that the program does not contain is detected.
#[test]
fn the_wait_of_marlin_is_seen() {
    let found = complaints("marlin", |code| {
        lines(code, |line| match line.strip_prefix("G4 P").and_then(|time| time.parse::<f64>().ok()) {
            Some(time) => format!("G4 P{:.0}", time + 100.0),
            None => line.to_owned(),
        })
    });
    assert!(found.iter().any(|complaint| complaint.contains("mean speed -7.")), "{found:?}");
}
