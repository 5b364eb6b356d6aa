//! Specs and machine profiles from text: their values and their messages.

mod faults;
mod random;
mod stars;

use stargrip_cam::spec::{Faults, Reading, Source, Spec, read};

/// The shortest valid spec.
const SHORTEST: &str = r#"schema = 1
name = "shortest"
[star]
points = 5
inner_radius = "50 mm"
tube_width = "30 mm"
tip_angle = "30 deg"
"#;

fn try_read(text: &str) -> Result<Reading, Faults> {
    read(&Source::new("spec.toml", text))
}

fn spec(text: &str) -> Spec {
    match try_read(text) {
        Ok(reading) => reading.spec,
        Err(faults) => panic!("{faults}"),
    }
}

/// The codes of all faults, in the order of their places.
fn codes(text: &str) -> Vec<&'static str> {
    match try_read(text) {
        Ok(reading) => reading.warnings.list().iter().map(|fault| fault.code).collect(),
        Err(faults) => faults.list().iter().map(|fault| fault.code).collect(),
    }
}
