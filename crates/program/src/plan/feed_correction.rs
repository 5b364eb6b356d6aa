//! From the measured time of a line of the feed check: the value of the profile that explains it.

use crate::plan::{CHECK_LENGTH, Chop, Pace, feed_checks};
use spec::units::{Acceleration, Duration, Speed};
use spec::{LEAST_ACCELERATION, MOST_ACCELERATION, Machine, Spec};

/// Difference between two presses of a stopwatch by hand, s: a smaller one is not seen.
pub const STOPWATCH: f64 = 0.5;

/// Steps of the bisection of an acceleration: 0.1 to 1e6 mm/s^2 to four digits.
const BISECTIONS: u32 = 60;

/// Longest delay that a profile may state, s.
const LONGEST_DELAY: f64 = 1.0;

/// The cause of a line of the feed check that took another time than it must, with its remedy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FeedCorrection {
    /// None: a stopwatch shows no difference.
    None,
    /// Strokes speed up in another way: `acceleration` in `[motion]`.
    Acceleration(Acceleration),
    /// Strokes begin after another delay: `start_delay` in `[motion]`.
    StartDelay(Duration),
    /// No value of the profile explains it: the `speed` in `[seal]` at which a line takes its time.
    SealSpeed(Speed),
    /// More time is lost or won than strokes take: the controller waits in another unit, or not at all.
    Dwell,
    /// The line is not chopped: the speed at which the machine really moved.
    RealSpeed(Speed),
}

/// The correction where a line of 10 mm took `measured` by a stopwatch.
pub fn feed_correction(spec: &Spec, machine: &Machine, measured: Duration) -> FeedCorrection {
    // Dwells are right on every controller that counts in its own clock, so a difference comes from the strokes: each is
    // shorter or longer by the same time. A delay explains it where the profile has one; else the acceleration. Where neither
    // can, the speed of the seal is lowered or raised by as much.
    let nominal = CHECK_LENGTH / spec.seal.speed.0;
    let excess = measured.0 - nominal;
    if excess.abs() <= STOPWATCH {
        return FeedCorrection::None;
    }
    // A line that the controller holds all along is not chopped, and takes its time: the others differ.
    let mut paces = feed_checks(spec, machine).into_iter().map(|(_, program)| program.pace());
    let Some(Pace::Chopped(chop)) = paces.find(|pace| matches!(pace, Pace::Chopped(_))) else {
        return FeedCorrection::RealSpeed(Speed(CHECK_LENGTH / measured.0));
    };
    let excess_of_stroke = excess / chop.strokes(CHECK_LENGTH);
    let stroke = CheckStroke::new(&chop);
    if excess < 0.0 && -excess_of_stroke > stroke.time(chop.acceleration) || excess > nominal {
        return FeedCorrection::Dwell;
    }
    let delay = chop.start_delay + excess_of_stroke;
    if chop.start_delay > 0.0 && (0.0..=LONGEST_DELAY).contains(&delay) {
        return FeedCorrection::StartDelay(Duration(delay));
    }
    match stroke.acceleration(chop.acceleration, excess_of_stroke) {
        Some(acceleration) => FeedCorrection::Acceleration(acceleration),
        None => FeedCorrection::SealSpeed(Speed(spec.seal.speed.0 * measured.0 / nominal)),
    }
}

/// One of the equal strokes of a line along X.
struct CheckStroke<'c> {
    chop: &'c Chop,
    length: f64,
}

impl<'c> CheckStroke<'c> {
    fn new(chop: &'c Chop) -> Self {
        Self { chop, length: CHECK_LENGTH / chop.strokes(CHECK_LENGTH) }
    }

    /// Time of the stroke without its dwell, s.
    fn time(&self, acceleration: f64) -> f64 {
        let steps = self.chop.steps([0.0; 3], [self.length, 0.0, 0.0]);
        Chop { acceleration, ..*self.chop }.moving(steps, self.length, 1)
    }

    /// The acceleration with which the stroke takes longer by `excess`, s, than with `planned`; `None` where none does.
    fn acceleration(&self, planned: f64, excess: f64) -> Option<Acceleration> {
        let required = self.time(planned) + excess;
        let (mut slow, mut fast) = (LEAST_ACCELERATION, MOST_ACCELERATION);
        if !(self.time(fast)..=self.time(slow)).contains(&required) {
            return None;
        }
        for _ in 0..BISECTIONS {
            let middle = (slow * fast).sqrt();
            if self.time(middle) > required { slow = middle } else { fast = middle }
        }
        Some(Acceleration((slow * fast).sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::{FeedFloor, Source};

    /// The paper's star for `profile` at `speed`, whose strokes are chopped.
    fn chopped(profile: &str, speed: f64) -> (Spec, Machine) {
        let text = spec::starter("star").expect("a name");
        let mut spec = spec::read(&Source::new("star", text.as_str())).expect("sound").spec;
        spec.machine.feed_floor = FeedFloor::Chop;
        spec.seal.speed = Speed(speed);
        (spec, Machine::builtin(profile).expect("built in"))
    }

    #[test]
    fn a_wrong_acceleration_or_delay_is_found_again() {
        // A controller runs the strokes that were planned for the profile, with the values of its own.
        for (profile, right) in [("grbl", 3.0), ("fluidnc", 3.0)] {
            let (spec, machine) = chopped(profile, 0.1);
            let planned = Chop::new(&spec, &machine).expect("chopped");
            let (strokes, stroke) = (planned.strokes(CHECK_LENGTH), CheckStroke::new(&planned));
            let excess = strokes * (stroke.time(right) - stroke.time(planned.acceleration));
            let FeedCorrection::Acceleration(corrected) =
                feed_correction(&spec, &machine, Duration(100.0 + excess))
            else {
                panic!("{profile}: {excess} s");
            };
            // Segments of 10 ms make the time jump with the acceleration.
            assert!(
                (stroke.time(corrected.0) - stroke.time(right)).abs() < 0.011,
                "{profile}: {corrected:?}"
            );
        }
        let (spec, machine) = chopped("marlin", 0.1);
        let strokes = Chop::new(&spec, &machine).expect("chopped").strokes(CHECK_LENGTH);
        let delay = machine.motion.start_delay.0;
        let correction = feed_correction(&spec, &machine, Duration(96.0));
        assert_eq!(correction, FeedCorrection::StartDelay(Duration(delay - 4.0 / strokes)));
    }

    #[test]
    fn what_no_value_explains_is_put_into_the_speed() {
        // GRBL's strokes lose 4 ms by their acceleration: none makes a line shorter by 4 s.
        let (spec, machine) = chopped("grbl", 0.1);
        let FeedCorrection::SealSpeed(speed) = feed_correction(&spec, &machine, Duration(96.0)) else {
            panic!("no speed")
        };
        assert!((speed.0 - 0.096).abs() < 1e-9);
        // Without its dwells, or with dwells in another unit, a line takes a part of its time, or many times as long.
        for seconds in [26.0, 900.0] {
            assert_eq!(feed_correction(&spec, &machine, Duration(seconds)), FeedCorrection::Dwell);
        }
        assert_eq!(feed_correction(&spec, &machine, Duration(100.4)), FeedCorrection::None);
        let (spec, machine) = chopped("linuxcnc", 1.0);
        assert_eq!(feed_correction(&spec, &machine, Duration(8.0)), FeedCorrection::RealSpeed(Speed(1.25)));
    }
}
