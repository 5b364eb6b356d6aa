//! The versions of Marlin: by how much a chopped seal is off its speed on a version that the profile does not state.

use crate::plan::{Chop, Pace, Program, Stepper};
use spec::FIRST_STEP_RATE;

/// Tolerance of a chopped seal's mean speed, relative.
pub const MEAN_TOLERANCE: f64 = 0.002;

/// A version of the firmware on which a seal leaves its speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherVersion {
    /// Whether its moves have a rate of their first step.
    pub has_first_rate: bool,
    /// Largest difference of the mean speed, relative: too fast in one direction, and too slow in another.
    pub error: f64,
}

/// The version without the first step's rate, or with it, on which the strokes of `programs` are off by more than 0.2 %; `None` if one
/// program suits both, or the controller has no such versions.
pub fn other_version(programs: &[Program]) -> Option<OtherVersion> {
    let processes = programs.iter().flat_map(|program| &program.processes);
    let versions = processes.filter_map(|paced| match paced.pace {
        Pace::Chopped(chop) => worst(&chop, paced.process.seal.speed.0),
        Pace::Steady => None,
    });
    versions.reduce(|worst, other| if other.error > worst.error { other } else { worst })
}

/// The other version for strokes of `chop`, which seal at `speed` mm/s.
fn worst(chop: &Chop, speed: f64) -> Option<OtherVersion> {
    let stepper = chop.stepper.filter(|stepper| stepper.tick == 0.0)?;
    let has_first_rate = stepper.first_rate.is_none();
    let other = Stepper { first_rate: has_first_rate.then_some(FIRST_STEP_RATE), ..stepper };
    let [x, y, _] = stepper.steps_per_mm;
    let (axis, diagonal) = (chop.longest, chop.longest / libm::hypot(1.0, x / y));
    let errors =
        [[axis * x, 0.0, 0.0], [0.0, axis * y, 0.0], [diagonal * x, diagonal * x, 0.0]].map(|steps| {
            let steps = steps.map(f64::round);
            let difference = other.seconds(steps, chop.speed, chop.acceleration)
                - stepper.seconds(steps, chop.speed, chop.acceleration);
            difference.abs() * speed / chop.longest
        });
    let error = errors.into_iter().fold(0.0, f64::max);
    (error > MEAN_TOLERANCE).then_some(OtherVersion { has_first_rate, error })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::seal_programs;
    use design::Design;
    use spec::units::Speed;
    use spec::{FeedFloor, Machine, Source};

    fn version_at(profile: &str, speed: f64) -> Option<OtherVersion> {
        let text = "schema = 1\nname = \"x\"\n[star]\npoints = 4\ninner_radius = \"25 mm\"\ntube_width = \"16 mm\"\ntip_angle = \"40 deg\"\n";
        let mut spec = spec::read(&Source::new("spec", text)).expect("sound").spec;
        (spec.machine.feed_floor, spec.seal.speed) = (FeedFloor::Chop, Speed(speed));
        let machine = Machine::builtin(profile).expect("built in");
        let design = Design::new(&spec, &machine).expect("a star");
        other_version(&seal_programs(&spec, &machine, &design))
    }

    /// The firmware's own code, bugfix-2.1.x of July 2024, was as much faster along an axis (docs/testing.md).
    #[test]
    fn a_fast_seal_tells_versions_apart_and_a_slow_one_does_not() {
        let at_half = version_at("ender", 0.5).expect("another speed");
        assert!(!at_half.has_first_rate && (at_half.error - 4.735e-3).abs() < 1e-6, "{at_half:?}");
        assert_eq!(version_at("ender", 0.1), None);
        assert_eq!(version_at("grbl", 0.3), None);
    }
}
