//! Whether a gripper holds the object of its `[load]`, in one word and with reasons.

use crate::forecast::outcome::Hold;
use crate::forecast::prediction::StarPrediction;
pub use crate::forecast::prediction::{Holds, Verdict};
use crate::forecast::ranges::{Interval, sum};
use crate::mechanics::strength::GRAVITY;
use crate::spec::{Load, Spec};
use crate::units::{Force, Mass};

/// The verdict on the object of `spec` between `stars`; `None` without an object or a pressure.
pub fn verdict(spec: &Spec, stars: &[StarPrediction]) -> Option<Verdict> {
    let load = spec.load.as_ref()?;
    let object = load.object_radius.filter(|_| load.pressure.is_some())?;
    let force = stars.iter().map(|star| star.object_force_N).sum::<Option<f64>>();
    let range = sum(stars.iter().map(|star| star.ranges.object_force_N));
    let needed = needed_force(load);
    let mut judged = Judged::default();
    for (number, star) in (1..).zip(stars) {
        if number == 1 || *star != stars[0] {
            judged.star(number, star, object.0, load.largest_force);
        }
    }
    judged.mass(force, range, needed);
    Some(Verdict {
        holds: judged.holds(),
        force_N: force,
        force_range_N: range,
        needed_N: needed,
        reasons: judged.reasons,
    })
}

/// m g / mu, N.
fn needed_force(load: &Load) -> Option<f64> {
    let (Mass(mass), friction) = load.mass.zip(load.friction)?;
    Some(mass * GRAVITY / friction)
}

/// What was found.
#[derive(Default)]
struct Judged {
    refuted: bool,
    /// Distinct stars, and those of them that do not touch the object: one that does will do.
    stars: usize,
    idle: usize,
    doubted: bool,
    reasons: Vec<String>,
}

impl Judged {
    fn holds(&self) -> Holds {
        match (self.is_refuted(), self.doubted) {
            (true, _) => Holds::No,
            (_, true) => Holds::Unknown,
            _ => Holds::Yes,
        }
    }

    fn is_refuted(&self) -> bool {
        self.refuted || self.idle == self.stars
    }

    fn pass(&mut self, why: String) {
        self.idle += 1;
        self.reasons.push(why);
    }

    fn refute(&mut self, why: String) {
        self.refuted = true;
        self.reasons.push(why);
    }

    fn doubt(&mut self, why: String) {
        self.doubted = true;
        self.reasons.push(why);
    }

    fn star(&mut self, number: usize, star: &StarPrediction, object: f64, bears: Option<Force>) {
        let of = |what: String| format!("star {number}: {what}");
        self.stars += 1;
        if let Some(margin) = star.burst_margin.filter(|margin| *margin < 1.0) {
            self.refute(of(format!("it bursts at {margin:.2} of the pressure")));
        }
        let Some([least, most]) = star.graspable_radius_mm else {
            return self.doubt(of(star.evidence.choice.clone()));
        };
        if object > most {
            return self.pass(of(format!("the object does not go in: it opens to {most:.1} mm")));
        }
        match star.ranges.final_radius_mm {
            Some([low, _]) if object < low => {
                return self
                    .pass(of(format!("it closes to {least:.1} mm only and does not reach the object")));
            }
            Some([_, high]) if object < high => {
                self.doubt(of(format!("it may close to {high:.1} mm only, and not reach the object")));
            }
            None if object < least => {
                return self
                    .pass(of(format!("it closes to {least:.1} mm only and does not reach the object")));
            }
            Some(_) | None => {}
        }
        if star.hold == Some(Hold::Untried) {
            self.doubt(of("how hard it presses on the object is not known".to_owned()));
        }
        match (bears, star.ranges.object_force_N, star.object_force_N) {
            (Some(Force(bears)), Some([low, _]), _) if low > bears => {
                self.refute(of(format!(
                    "it presses with {low:.1} N at least, and the object bears {bears:.1} N"
                )));
            }
            (Some(Force(bears)), Some([_, high]), _) if high > bears => {
                self.doubt(of(format!("it may press with {high:.1} N, and the object bears {bears:.1} N")));
            }
            (Some(Force(bears)), None, Some(force)) if force > bears => {
                self.doubt(of(format!(
                    "by the model it presses with {force:.1} N, and the object bears {bears:.1} N"
                )));
            }
            _ => {}
        }
    }

    fn mass(&mut self, force: Option<f64>, range: Option<Interval>, needed: Option<f64>) {
        if self.is_refuted() {
            return;
        }
        match (needed, range, force) {
            (Some(needed), Some([_, high]), _) if high < needed => {
                self.refute(format!("friction needs {needed:.1} N, and there are {high:.1} N at most"));
            }
            (Some(needed), Some([low, _]), _) if low < needed => {
                self.doubt(format!("friction needs {needed:.1} N, and there may be {low:.1} N only"));
            }
            (_, None, Some(force)) => {
                let said =
                    needed.map_or(String::new(), |needed| format!(" and friction needs {needed:.1} N,"));
                self.doubt(format!(
                    "by the model it presses with {force:.1} N,{said} but how far that is off is not known"
                ));
            }
            _ => {}
        }
    }
}
