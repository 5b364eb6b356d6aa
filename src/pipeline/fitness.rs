//! Whether a gripper does what its own `[load]` asks of it: the verdict that `check` and `build` begin with.
//!
//! A gripper is **unfit** if it bursts at its own pressure, or if no star of it can hold its own object. There is such a gripper,
//! and a machine can make it, so [`Forecast`] lets it pass: it is `check` and `build` that refuse it unless told otherwise.

use crate::design::{Refusal, RefusalCode, Refusals};
use crate::forecast::prediction::StarPrediction;
use crate::forecast::verdict::{Holds, Verdict, verdict};
use crate::pipeline::Forecast;
use crate::spec::{Load, key};
use crate::units::{Least, Length, Most, Pressure};

impl Forecast {
    /// What becomes of the object; `None` where the spec does not ask.
    pub fn verdict(&self) -> Option<Verdict> {
        verdict(&self.spec, &self.prediction.as_ref()?.stars)
    }

    /// Why the gripper is unfit, star by star; empty if it is fit, if nothing is asked, or if that is not known.
    pub fn unfit(&self) -> Refusals {
        let object = match self.verdict() {
            Some(Verdict { holds: Holds::No, .. }) => self.not_held(),
            _ => Vec::new(),
        };
        // One star that holds it will do.
        let object = if object.len() == self.design.firsts().count() { object } else { Vec::new() };
        object.into_iter().chain(self.bursts()).collect()
    }

    /// Why each distinct star does not hold the object, as far as that is known.
    fn not_held(&self) -> Vec<Refusal> {
        let (Some(load), Some(prediction)) = (&self.spec.load, &self.prediction) else { return Vec::new() };
        let Some(object) = load.object_radius else { return Vec::new() };
        let firsts = self.design.firsts().filter_map(|placed| {
            let (star, spec) =
                (prediction.stars.get(placed.index - 1)?, self.spec.stars.get(placed.index - 1)?);
            not_held(object, spec.inner_radius, star).map(|refusal| self.of_star(refusal, placed.index))
        });
        firsts.collect()
    }

    /// Which distinct stars burst at the pressure of `[load]`.
    fn bursts(&self) -> Vec<Refusal> {
        let (Some(load), Some(prediction)) = (&self.spec.load, &self.prediction) else { return Vec::new() };
        let firsts = self.design.firsts().filter_map(|placed| {
            let refusal = bursts(load, prediction.stars.get(placed.index - 1)?)?;
            Some(self.of_star(refusal, placed.index))
        });
        firsts.collect()
    }

    /// `refusal`, with the star's number where there are several.
    fn of_star(&self, refusal: Refusal, index: usize) -> Refusal {
        if self.design.firsts().count() < 2 {
            return refusal;
        }
        Refusal { found: format!("star {index}: {}", refusal.found), ..refusal }
    }
}

fn not_held(object: Length, inner_radius: Length, star: &StarPrediction) -> Option<Refusal> {
    let at = key::load::OBJECT_RADIUS;
    if object > inner_radius {
        let found = format!(
            "the object has a radius of {object}, the flat star an inner radius of {inner_radius}: it does not enter"
        );
        let remedy = format!("at most {inner_radius}, or an inner_radius of more than {object}");
        return Some(Refusal::new(at, RefusalCode::ObjectTooWide, found, remedy));
    }
    let [least, most] = star.graspable_radius_mm?;
    // Where the range is known, the object may lie within it.
    let least = star.ranges.final_radius_mm.map_or(least, |[low, _]| low);
    if object.0 < least {
        let found = format!(
            "the inflated star closes to a radius of {} mm and does not touch the object of {object}",
            Least(least)
        );
        let remedy =
            format!("at least {} mm, or a star that closes further: a smaller inner_radius", Least(least));
        return Some(Refusal::new(at, RefusalCode::ObjectTooThin, found, remedy));
    }
    if object.0 > most {
        let found = format!(
            "the inflated star opens to a radius of {} mm and does not close around the object of {object}",
            Most(most)
        );
        let remedy = format!(
            "from {} to {} mm; or a larger inner_radius, fewer points or a smaller tube_width",
            Least(least),
            Most(most)
        );
        return Some(Refusal::new(at, RefusalCode::ObjectTooWide, found, remedy));
    }
    None
}

fn bursts(load: &Load, star: &StarPrediction) -> Option<Refusal> {
    let (pressure, burst) = (load.pressure?, Pressure(star.burst_pressure_kPa?));
    if burst >= pressure {
        return None;
    }
    let round = star.evidence.safe_radius_mm.map_or_else(String::new, |mm| {
        format!(", or tip_radius and corner_radius of at least {}", Length(mm))
    });
    let found =
        format!("the pressure is {pressure}, and the seal is predicted to burst at {} kPa", Most(burst.0));
    let remedy = format!("at most {} kPa{round}, or a stronger seal or a smaller tube_width", Most(burst.0));
    Some(Refusal::new(key::load::PRESSURE, RefusalCode::Bursts, found, remedy))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::Forecast;
    use crate::spec::{Machine, Source, read, starter};

    fn forecast(more: &str) -> Forecast {
        let text = starter("x").expect("a name") + more;
        let reading = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}"));
        let machine = Machine::builtin("generic").expect("built in");
        Forecast::of(reading.spec, machine).expect("a design")
    }

    fn codes(forecast: &Forecast) -> Vec<String> {
        forecast.unfit().iter().map(|refusal| refusal.code.to_string()).collect()
    }

    fn holds(forecast: &Forecast) -> Option<Holds> {
        forecast.verdict().map(|verdict| verdict.holds)
    }

    #[test]
    fn what_is_not_asked_is_not_judged() {
        assert_eq!(forecast("").verdict(), None);
        let bare = forecast("[load]\npressure = \"37 kPa\"\n");
        assert_eq!((holds(&bare), codes(&bare)), (None, vec![]));
    }

    #[test]
    fn an_object_between_final_and_inner_radius_is_fit_and_no_other() {
        let with =
            |mm: f64| forecast(&format!("[load]\npressure = \"37 kPa\"\nobject_radius = \"{mm} mm\"\n"));
        assert_eq!(codes(&with(30.0)), [""; 0]);
        let (thin, wide) = (with(5.0), with(51.0));
        assert_eq!((holds(&thin), codes(&thin)), (Some(Holds::No), vec!["object-too-thin".to_owned()]));
        assert_eq!((holds(&wide), codes(&wide)), (Some(Holds::No), vec!["object-too-wide".to_owned()]));
        let remedy = &thin.unfit()[0].remedy;
        let least: f64 = remedy.split(' ').find_map(|word| word.parse().ok()).expect("a number");
        assert_eq!(codes(&with(least)), [""; 0], "{remedy}");
    }

    #[test]
    fn what_no_table_knows_is_no_verdict() {
        let soft = forecast("[load]\npressure = \"0.1 kPa\"\nobject_radius = \"30 mm\"\n");
        assert_eq!((holds(&soft), codes(&soft)), (Some(Holds::Unknown), vec![]));
    }

    #[test]
    fn a_stack_is_unfit_if_none_of_its_stars_holds_the_object() {
        let wide = "[stack]\ncount = 2\n[[stack.star]]\nindex = 2\ninner_radius = \"60 mm\"\n";
        let with = |mm: f64| {
            let text = starter("x").expect("a name").replace("[stack]", wide);
            let text = format!("{text}\n[load]\npressure = \"37 kPa\"\nobject_radius = \"{mm} mm\"\n");
            let spec = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
            Forecast::of(spec, Machine::builtin("generic").expect("built in")).expect("a design")
        };
        assert_eq!(codes(&with(55.0)), [""; 0]);
        let neither = with(65.0);
        assert_eq!(codes(&neither).len(), 2);
        assert!(neither.unfit()[1].found.starts_with("star 2: "), "{:?}", neither.unfit());
    }

    #[test]
    fn a_pressure_above_burst_is_refused_with_a_radius_that_would_hold() {
        let with = |strength: &str, radius: &str| {
            let text = starter("x").expect("a name");
            let text = text.replace("[fabric]", &format!("[fabric]\nseal_strength = \"{strength}\""));
            let text = text.replace(
                "\n[star]\n",
                &format!("\n[star]\ntip_radius = \"{radius}\"\ncorner_radius = \"{radius}\"\n"),
            );
            let text = format!("{text}\n[load]\npressure = \"37 kPa\"\n");
            let spec = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
            Forecast::of(spec, Machine::builtin("generic").expect("built in")).expect("a design")
        };
        assert_eq!(codes(&with("10 N/mm", "0 mm")), [""; 0]);
        let weak = with("3 N/mm", "0 mm");
        assert_eq!(codes(&weak), ["bursts"]);
        let radius = weak.prediction.expect("asked").first.evidence.safe_radius_mm.expect("one helps");
        assert_eq!(codes(&with("3 N/mm", &format!("{radius} mm"))), [""; 0]);
    }
}
