//! The shipped tables, and the values between their places.

use super::*;
use sha2::{Digest, Sha256};

#[test]
fn the_shipped_table_is_whole_and_on_its_grid() {
    let body: String =
        SHIPPED.lines().filter(|line| !line.starts_with('#')).flat_map(|line| [line, "\n"]).collect();
    let hash = Sha256::digest(body.as_bytes())
        .iter()
        .fold(String::new(), |text, byte| text + &format!("{byte:02x}"));
    assert!(SHIPPED.contains(&hash), "{hash}");
    let mut lines = body.lines();
    for arc in ARCS {
        for (tau, r_star) in TAUS.into_iter().flat_map(|tau| R_STARS.map(|r_star| (tau, r_star))) {
            for b in bendabilities(tau) {
                let words: Vec<f64> = (lines.next().expect("a line").split(' '))
                    .map(|word| word.parse().expect("a number"))
                    .collect();
                assert_eq!((180.0 - words[0], words[1], words[2]), (arc, tau, r_star));
                assert!((words[3] / b - 1.0).abs() < 1e-5);
                let arms_at_arc = arms(b, tau, r_star).expect("on the grid").arms(arc.to_radians());
                let delta = arms_at_arc.angle.to_degrees() / (arc / 45.0).tanh();
                assert!((delta - words[4]).abs() < 2e-3, "{arms_at_arc:?} {words:?}");
                assert!((arms_at_arc.give.to_degrees() - words[6]).abs() < 1e-2, "{arms_at_arc:?} {words:?}");
            }
        }
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn it_ends_where_it_ends() {
    let tau = 4e-3;
    assert!(arms(100.0, tau, 0.0).is_some() && arms(6250.0, tau, 1.0).is_some());
    for (b, tau, r_star) in [
        (99.0, tau, 0.1),
        (6260.0, tau, 0.1),
        (390.0, THIN_TAU, 0.1),
        (1000.0, 1.42e-3, 0.1),
        (1000.0, 2e-3, 0.46),
        (1.01e4, 2e-3, 0.1),
        (500.0, 0.01, 0.1),
        (500.0, tau, 1.01),
    ] {
        assert_eq!(arms(b, tau, r_star), None, "{b} {tau} {r_star}");
    }
    assert_eq!(arms(f64::NAN, tau, 0.1), None);
    assert_eq!(arms(500.0, f64::NAN, 0.1), None);
}

#[test]
fn thin_fabric_has_its_own_table_which_meets_the_grid() {
    // The file's hash is that of its own body. Each of its lines is read back through `arms`. At the grid's edge
    // the thin table and the grid give one answer.
    let body: String =
        SHIPPED_THIN.lines().filter(|line| !line.starts_with('#')).flat_map(|line| [line, "\n"]).collect();
    let hash = Sha256::digest(body.as_bytes())
        .iter()
        .fold(String::new(), |text, byte| text + &format!("{byte:02x}"));
    assert!(SHIPPED_THIN.contains(&hash), "{hash}");
    let mut lines = body.lines();
    for r_star in THIN_R_STARS {
        for b in &bendabilities(THIN_TAU)[PRESSURES - THIN_PRESSURES..] {
            let words: Vec<f64> = (lines.next().expect("a line").split(' '))
                .map(|word| word.parse().expect("a number"))
                .collect();
            assert_eq!((180.0 - words[0], words[1], words[2]), (THIN_ARC, THIN_TAU, r_star));
            let arms_at_arc = arms(*b, THIN_TAU, r_star).expect("in the table").arms(THIN_ARC.to_radians());
            let delta = arms_at_arc.angle.to_degrees() / (THIN_ARC / 45.0).tanh();
            assert!((delta - words[4]).abs() < 2e-3, "{arms_at_arc:?} {words:?}");
            let is_round = r_star == THIN_R_STARS[1];
            assert!(
                !is_round || (arms_at_arc.give.to_degrees() - words[6]).abs() < 1e-2,
                "{arms_at_arc:?} {words:?}"
            );
        }
    }
    assert_eq!(lines.next(), None);
    for (b, r_star, arc) in [(150.0, 0.0, 2.0), (800.0, 0.1, 1.0), (9e3, 0.4, 2.6)] {
        let [thin, grid] = [1.0 - 1e-5, 1.0 - 1e-7].map(|part| arms(b, part * edge(), r_star));
        let (thin, grid) = (thin.expect("thin").arms(arc), grid.expect("grid").arms(arc));
        assert!((thin.angle - grid.angle).abs() < 1e-5 && (thin.give - grid.give).abs() < 1e-3);
    }
}

#[test]
fn it_leads_on_from_place_to_place() {
    // The table is continuous between the grid's places, and arms always let a hinge coil further.
    let mut previous: Option<Arms> = None;
    for step in 0..=400 {
        let part = f64::from(step) / 400.0;
        let tau = TAUS[0] * (TAUS[2] / TAUS[0]).powf(part);
        let current = arms(300.0 + 600.0 * part, tau, part * part).expect("inside").arms(2.6 - 2.2 * part);
        assert!(current.angle > 0.0 && current.give > -0.2, "{part}: {current:?}");
        if let Some(previous) = previous {
            assert!((current.angle - previous.angle).abs() < 0.005, "{part}: {previous:?} {current:?}");
            assert!((current.give - previous.give).abs() < 0.03, "{part}: {previous:?} {current:?}");
        }
        previous = Some(current);
    }
}
