//! A gripper that was found for an object, or for a request near it: in words and as JSON.

use serde_json::{Value, json};

use crate::answer::duration::{sealing_in_words, sealing_time};
use crate::pipeline::Forecast;
use forecast::sizing::Requirements;
use forecast::verdict::{Holds, Verdict};
use spec::units::{count_text, in_unit};

/// A day, s.
const DAY: f64 = 24.0 * 3600.0;

/// A request near another one that can be met.
#[derive(Clone, Debug)]
pub struct NearRequest {
    /// The requirements.
    pub requirements: Requirements,
    /// The changes from the other request, in words.
    pub changes: String,
    /// Whether no value was changed by more than a tenth.
    pub is_near: bool,
    /// The gripper that meets it.
    pub gripper: NewGripper,
}

impl NearRequest {
    /// How far the request is, whether its gripper certainly holds the object, and the changes.
    pub fn offer(&self) -> String {
        let distance = if self.is_near { "near it" } else { "farther away" };
        let certainty = if self.gripper.surely_holds() { "can" } else { "may" };
        format!("a request {distance} that {certainty} be met: {}", self.changes)
    }
}

/// A gripper for an object: its spec and its forecast.
#[derive(Clone, Debug)]
pub struct NewGripper {
    /// The spec's text.
    pub text: String,
    /// The forecast that `check` makes.
    pub forecast: Forecast,
    /// Whether its friction is the default.
    pub friction_assumed: bool,
    /// The unit in which its pressure was requested.
    pub pressure_unit: Option<&'static str>,
}

impl NewGripper {
    /// Whether `check` says that it holds the object.
    pub(super) fn surely_holds(&self) -> bool {
        self.forecast.verdict().is_some_and(|verdict| verdict.holds == Holds::Yes)
    }

    /// The reasons why it may not hold the object, one line; `None` if it certainly holds it.
    pub fn doubt_in_words(&self) -> Option<String> {
        let verdict = self.forecast.verdict().filter(|_| !self.surely_holds())?;
        Some(format!("{}: {}", verdict.line(), verdict.reasons.join("; ")))
    }

    /// The verdict with its reasons, and the chosen values: one line each.
    pub fn in_words(&self) -> String {
        let verdict = self.forecast.verdict();
        let mut lines: Vec<String> = verdict.iter().map(Verdict::line).collect();
        let reasons =
            verdict.iter().flat_map(|verdict| verdict.reasons.iter().cloned().chain(verdict.remarks()));
        lines.extend(reasons.map(|reason| format!("  {reason}")));
        lines.extend(self.star_in_words());
        let days = sealing_time(&self.forecast) / DAY;
        if days >= 1.0 {
            lines.push(format!("  sealing takes {days:.1} days of machine time"));
        }
        lines.join("\n") + "\n"
    }

    /// The chosen values, in one line.
    pub fn star_in_words(&self) -> Option<String> {
        let Forecast { spec, .. } = &self.forecast;
        let (star, load) = (spec.stars.first()?, spec.load.as_ref()?);
        let stars = count_text(spec.stars.len(), "star");
        let [width, height] = self.fabric()?.map(f64::round);
        let pressure_text = load
            .pressure
            .map_or_else(String::new, |pressure| format!("; {}", in_unit(pressure, self.pressure_unit)));
        let friction = load.friction.map_or_else(String::new, |friction| {
            let assumed = if self.friction_assumed { " assumed: change `friction` in [load]" } else { "" };
            format!("; friction {friction}{assumed}")
        });
        Some(format!(
            "{stars} of {} points, tube {} wide, {width} x {height} mm of fabric{pressure_text}; {} of sealing{friction}",
            star.points,
            star.tube_width,
            sealing_in_words(&self.forecast),
        ))
    }

    /// Width and height of the first star's cut, mm.
    fn fabric(&self) -> Option<[f64; 2]> {
        let bounds = self.forecast.design.assembly()?.distinct.first()?.outline.outside.bounds();
        Some([bounds.width(), bounds.height()])
    }

    /// The chosen values as JSON.
    pub fn json(&self) -> Value {
        let Forecast { spec, .. } = &self.forecast;
        let (star, load) = (spec.stars.first(), spec.load.as_ref());
        json!({
            "stars": spec.stars.len(),
            "points": star.map(|star| star.points),
            "tube_width_mm": star.map(|star| star.tube_width.0),
            "fabric_mm": self.fabric(),
            "pressure_kPa": load.and_then(|load| Some(load.pressure?.0)),
            "friction": load.and_then(|load| load.friction),
            "friction_assumed": self.friction_assumed,
            "sealing_time_s": sealing_time(&self.forecast),
        })
    }
}
