//! The readers of specs, profiles and tables.

use stargrip_cam::coupon::bias::{BiasStrip, read_strip, shear_stiffness};
use stargrip_cam::coupon::{calibrate, listing, read_rows, settings};
use stargrip_cam::pipeline::Forecast;
use stargrip_cam::spec;
use stargrip_cam::spec::Source;
use stargrip_cam::spec::edit::{StarEdit, with_star};

use super::shown;

/// Any bytes as a spec: an accepted one is the same with its own star written into it again.
pub(super) fn spec(bytes: &[u8]) {
    let Some(source) = source("spec.toml", bytes) else { return };
    let reading = match spec::read(&source) {
        Ok(reading) => reading,
        Err(faults) => return shown::faults(&faults),
    };
    let Some(star) = reading.spec.stars.first() else { return };
    match with_star(&source, &StarEdit::new(star)) {
        Ok(text) => {
            let again = spec::read(&Source::new("again", text)).expect("read back");
            assert_eq!(again.spec, reading.spec);
        }
        Err(faults) => shown::faults(&faults),
    }
}

/// Any bytes as a machine profile: an accepted one plans a small gripper, or is refused with a reason.
pub(super) fn machine(bytes: &[u8]) {
    let Some(source) = source("machine.toml", bytes) else { return };
    let machine = match spec::read_machine(&source) {
        Ok(machine) => machine,
        Err(faults) => return shown::faults(&faults),
    };
    let small = spec::read(&Source::new("small", super::builds::SMALL)).expect("valid").spec;
    match Forecast::new(small, machine) {
        Ok(forecast) => {
            let time: f64 = forecast.programs.iter().map(|program| program.time).sum();
            assert!(time.is_finite() && time > 0.0, "{time} s");
        }
        Err(refusals) => refusals.into_iter().for_each(|refusal| {
            shown::line(&refusal.found);
            shown::line(&refusal.remedy);
        }),
    }
}

/// Any bytes as a table: of a peel test or, if the first is odd, of a bias strip.
pub(super) fn table(bytes: &[u8]) {
    let Some((kind, bytes)) = bytes.split_first() else { return };
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let source = Source::new("table.csv", text);
    if kind.is_multiple_of(2) { peel(&source) } else { strip(&source) }
}

fn peel(source: &Source) {
    let rows = match read_rows(source) {
        Ok(rows) => rows,
        Err(faults) => return shown::faults(&faults),
    };
    let settings = settings(&rows);
    assert_eq!(settings.iter().map(|setting| setting.count).sum::<usize>(), rows.len());
    let list = listing(&settings);
    assert!(!list.contains("NaN") && !list.contains("inf"), "{list}");
    match calibrate(&settings, 0.5, 1.5) {
        Ok(chosen) => {
            assert!(chosen.strength >= 0.75 && chosen.count >= 3, "{chosen:?}");
            assert!(!chosen.toml().contains("NaN"), "{}", chosen.toml());
        }
        Err(fault) => shown::line(&fault),
    }
}

/// A strip that is accepted has a shear modulus above 0, or is refused with a reason.
fn strip(source: &Source) {
    let points = match read_strip(source) {
        Ok(points) => points,
        Err(faults) => return shown::faults(&faults),
    };
    let strip = BiasStrip { width: 25.0, length: 200.0 };
    let shear = strip.stiffness(&points).and_then(|stiffness| shear_stiffness(stiffness, 38.4, 0.39));
    match shear {
        Ok(shear) => assert!(shear.is_finite() && shear > 0.0, "{shear}"),
        Err(fault) => shown::line(&fault),
    }
}

fn source(name: &str, bytes: &[u8]) -> Option<Source> {
    match Source::from_bytes(name, bytes) {
        Ok(source) => Some(source),
        Err(faults) => {
            shown::faults(&faults);
            None
        }
    }
}
