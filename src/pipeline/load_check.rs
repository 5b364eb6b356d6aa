//! The verdict of `check` and `build`: whether a gripper meets its own `[load]`.
//!
//! A gripper is **unfit** if it certainly does not: it bursts, none of its stars can hold the object, it carries too little, it presses too
//! hard, or no model covers it. Such a gripper exists and can be made, so [`Forecast`] accepts it. `check` and `build` refuse it, except
//! with `--anyway`.

use crate::pipeline::Forecast;
use design::Refusals;
use forecast::verdict::{Holds, Verdict, refusals, verdict};

impl Forecast {
    /// The verdict on the object; `None` without an object in the spec.
    pub fn verdict(&self) -> Option<Verdict> {
        verdict(&self.spec, self.prediction.as_ref()?)
    }

    /// The reasons why the gripper is unfit, star by star; empty if it is fit, if it has no requirement, or if the result is uncertain.
    pub fn unfit(&self) -> Refusals {
        let of_stars = self.prediction.as_ref().map(|prediction| refusals(&self.spec, prediction));
        let of_drawing = self.drawn.as_ref().and_then(|drawn| drawn.prediction.bursts());
        of_stars.into_iter().flatten().chain(of_drawing).collect()
    }

    /// A warning that it may not hold the object, with the reasons; `None` if the result is certain.
    pub fn uncertain(&self) -> Option<String> {
        let verdict = self.verdict().filter(|verdict| verdict.holds == Holds::Unknown)?;
        Some(format!("{}: {}", verdict.line(), verdict.reasons.join("; ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::Forecast;
    use design::RefusalCode;
    use spec::{Machine, Source, read, starter};

    fn forecast(extra: &str) -> Forecast {
        of_text(starter("x").expect("a name") + extra)
    }

    fn of_text(text: String) -> Forecast {
        let reading = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}"));
        let machine = Machine::builtin("generic").expect("built in");
        Forecast::new(reading.spec, machine).expect("a design")
    }

    fn codes(forecast: &Forecast) -> Vec<String> {
        forecast.unfit().iter().map(|refusal| refusal.code.to_string()).collect()
    }

    fn verdict_of(forecast: &Forecast) -> Option<Holds> {
        forecast.verdict().map(|verdict| verdict.holds)
    }

    #[test]
    fn what_is_not_asked_is_not_judged() {
        assert_eq!(forecast("").verdict(), None);
        let bare = forecast("[load]\npressure = \"37 kPa\"\n");
        assert_eq!((verdict_of(&bare), codes(&bare)), (None, vec![]));
    }

    #[test]
    fn an_object_between_final_and_inner_radius_is_fit_and_no_other() {
        let with_radius =
            |mm: f64| forecast(&format!("[load]\npressure = \"37 kPa\"\nobject_radius = \"{mm} mm\"\n"));
        assert_eq!(codes(&with_radius(30.0)), [""; 0]);
        let (thin, wide) = (with_radius(5.0), with_radius(51.0));
        assert_eq!((verdict_of(&thin), codes(&thin)), (Some(Holds::No), vec!["object-too-thin".to_owned()]));
        assert_eq!((verdict_of(&wide), codes(&wide)), (Some(Holds::No), vec!["object-too-wide".to_owned()]));
        let remedy = thin.unfit()[0].remedy.clone();
        let smallest: f64 = remedy.split(' ').find_map(|word| word.parse().ok()).expect("a number");
        assert_eq!(codes(&with_radius(smallest)), [""; 0], "{remedy}");
    }

    #[test]
    fn what_no_table_knows_is_no_verdict() {
        let soft = forecast("[load]\npressure = \"0.1 kPa\"\nobject_radius = \"30 mm\"\n");
        assert_eq!(
            (verdict_of(&soft), codes(&soft)),
            (Some(Holds::Unknown), vec!["outside-models".to_owned()])
        );
        // Without an object, a star outside all models is still made.
        let with_values = |[default, own]: [&str; 2], more: &str| {
            let text = starter("x").expect("a name").replace(&format!("# {default}"), own);
            let text = format!("{text}\n[load]\npressure = \"37 kPa\"\n{more}");
            of_text(text)
        };
        for (change, key) in [
            (["thickness = \"0.3 mm\"", "thickness = \"0.1 mm\""], "tube_width"),
            (["poisson_ratio = 0.39", "poisson_ratio = 0.5"], "poisson_ratio"),
        ] {
            assert_eq!(codes(&with_values(change, "")), [""; 0]);
            let unknown = with_values(change, "object_diameter = \"60 mm\"\n");
            assert_eq!(codes(&unknown), ["outside-models"]);
            assert_eq!(unknown.unfit()[0].key.key(), key);
        }
    }

    #[test]
    fn what_may_not_hold_is_said_and_passes() {
        let with_mass = |mass: f64| {
            forecast(&format!(
                "[load]\npressure = \"37 kPa\"\nobject_diameter = \"60 mm\"\nfriction = 0.5\nmass = \"{mass} kg\"\n"
            ))
        };
        let [low, high] = with_mass(0.1).prediction.expect("asked").first.ranges.payload_kg.expect("known");
        let (surely_held, unsure, never_held) =
            (with_mass(0.9 * low), with_mass(0.5 * (low + high)), with_mass(1.1 * high));
        assert_eq!((surely_held.uncertain(), codes(&surely_held)), (None, vec![]));
        assert!(unsure.uncertain().is_some_and(|text| text.starts_with("may hold the object")));
        assert_eq!(codes(&unsure), [""; 0]);
        assert_eq!((never_held.uncertain(), codes(&never_held)), (None, vec!["too-heavy".to_owned()]));
    }

    #[test]
    fn the_size_is_a_diameter_or_a_radius_and_not_both() {
        let [by_diameter, radius] = ["object_diameter = \"70 mm\"", "object_radius = \"35 mm\""]
            .map(|size| forecast(&format!("[load]\npressure = \"37 kPa\"\n{size}\n")).prediction);
        assert!(by_diameter == radius && by_diameter.is_some());
        let two_sizes = "[load]\nobject_diameter = \"70 mm\"\nobject_radius = \"35 mm\"\n";
        let text = starter("x").expect("a name") + two_sizes;
        let faults = read(&Source::new("x", text)).expect_err("both");
        assert!(faults.to_string().contains("conflict"), "{faults}");
    }

    #[test]
    fn an_object_passes_the_cut_hole_or_is_refused_and_little_room_is_warned_of() {
        let with_diameter =
            |mm: f64| forecast(&format!("[load]\npressure = \"37 kPa\"\nobject_diameter = \"{mm} mm\"\n"));
        let warned = |forecast: &Forecast| {
            forecast.design.warnings.iter().any(|warning| warning.code == RefusalCode::TightHole)
        };
        let (free, tight, wide) = (with_diameter(80.0), with_diameter(92.0), with_diameter(95.0));
        assert!(!warned(&free) && warned(&tight) && !warned(&wide));
        assert_eq!([codes(&free), codes(&tight)], [vec![], Vec::<String>::new()]);
        assert_eq!(codes(&wide), ["object-too-wide"]);
        let first = |forecast: &Forecast| forecast.prediction.as_ref().expect("asked").first.clone();
        assert_eq!((first(&free).hole_radius_mm, first(&free).object_gap_mm), (47.0, Some(7.0)));
        assert!(first(&wide).object_gap_mm < Some(0.0));
        // The proposed radius makes room for the object.
        let remedy = wide.unfit()[0].remedy.clone();
        let radius: f64 =
            remedy.split(' ').filter_map(|word| word.parse().ok()).next_back().expect("a number");
        let text = starter("x")
            .expect("a name")
            .replace("inner_radius = \"50 mm\"", &format!("inner_radius = \"{radius} mm\""));
        let text = text + "[load]\npressure = \"37 kPa\"\nobject_diameter = \"95 mm\"\n";
        let wider = of_text(text);
        assert!(codes(&wider).is_empty() && !warned(&wider), "{remedy}");
    }

    #[test]
    fn a_stack_is_unfit_if_none_of_its_stars_holds_the_object() {
        let wide = "[stack]\ncount = 2\n[[stack.star]]\nindex = 2\ninner_radius = \"60 mm\"\n";
        let with_diameter = |mm: f64| {
            let text = starter("x").expect("a name").replace("[stack]", wide);
            let text = format!("{text}\n[load]\npressure = \"37 kPa\"\nobject_radius = \"{mm} mm\"\n");
            of_text(text)
        };
        // The upper star may hold what stops at the lower one.
        let upper = with_diameter(55.0);
        assert_eq!((codes(&upper), verdict_of(&upper)), (vec![], Some(Holds::Unknown)));
        let too_wide = with_diameter(65.0);
        assert_eq!(codes(&too_wide).len(), 2);
        assert!(too_wide.unfit()[1].found.starts_with("star 2: "), "{:?}", too_wide.unfit());
    }

    #[test]
    fn what_cannot_reach_its_place_or_is_not_held_by_all_is_never_held_for_sure() {
        let with_stack = |[stack, load]: [&str; 2]| {
            let text = starter("x").expect("a name").replace("[stack]", &format!("[stack]\n{stack}"));
            let text = format!("{text}\n[load]\npressure = \"37 kPa\"\nfriction = 0.3\n{load}");
            of_text(text)
        };
        let cylinder = "object_shape = \"cylinder\"\nobject_diameter";
        for (stack, load, expected) in [
            // A ball that only the upper star, at its narrow end, would let pass.
            ("count = 3", "object_diameter = \"120 mm\"\nmass = \"5 kg\"".to_owned(), Holds::No),
            ("count = 2", "object_diameter = \"96 mm\"".to_owned(), Holds::No),
            // The stars at both ends are too narrow for what the others hold.
            (
                "count = 4\n[[stack.star]]\nindex = 1\ninner_radius = \"40 mm\"\n[[stack.star]]\nindex = 4\n\
                 inner_radius = \"40 mm\"",
                format!("{cylinder} = \"85 mm\"\nobject_height = \"70 mm\"\nmass = \"1 kg\""),
                Holds::No,
            ),
            // One star is open too little, inflated or flat.
            (
                "count = 2\n[[stack.star]]\nindex = 2\npoints = 8",
                format!("{cylinder} = \"80 mm\"\nobject_height = \"200 mm\"\nmass = \"9 kg\""),
                Holds::Unknown,
            ),
            (
                "count = 2\n[[stack.star]]\nindex = 2\ninner_radius = \"35 mm\"",
                format!("{cylinder} = \"80 mm\"\nobject_height = \"200 mm\"\nmass = \"9 kg\""),
                Holds::Unknown,
            ),
        ] {
            let forecast = with_stack([stack, &load]);
            assert_eq!(verdict_of(&forecast), Some(expected), "{stack} {load}: {:?}", forecast.verdict());
            let refused = expected == Holds::No;
            let too_wide = codes(&forecast).iter().any(|code| code == "object-too-wide");
            assert_eq!(too_wide, refused, "{stack} {load}: {:?}", codes(&forecast));
        }
    }

    #[test]
    fn an_object_as_wide_as_the_hole_is_held() {
        for i in 0..40 {
            // Hundredths of a mm; band and flap are 3 mm.
            let inner = 4500 + 37 * i;
            let mm = |hundredths: i32| f64::from(hundredths) / 100.0;
            let load = format!(
                "\n[load]\npressure = \"37 kPa\"\nobject_diameter = \"{} mm\"\n",
                mm(2 * (inner - 300))
            );
            let text = starter("x").expect("a name") + &load;
            let text =
                text.replace("inner_radius = \"50 mm\"", &format!("inner_radius = \"{} mm\"", mm(inner)));
            let forecast = of_text(text);
            assert_eq!(codes(&forecast), [""; 0], "{inner}: {:?}", forecast.unfit());
        }
    }

    #[test]
    fn stars_that_are_alike_are_all_named() {
        let text = starter("x").expect("a name").replace("[stack]", "[stack]\ncount = 6");
        let text = format!("{text}\n[load]\npressure = \"37 kPa\"\nobject_diameter = \"90 mm\"\n");
        let forecast = of_text(text);
        let reasons = forecast.verdict().expect("an object").reasons;
        assert!(reasons.iter().any(|reason| reason.starts_with("stars 1, 2, 5, 6: ")), "{reasons:?}");
    }

    #[test]
    fn a_pressure_above_burst_is_refused_with_a_radius_that_would_hold() {
        let with_strength = |strength: &str, radius: &str| {
            let text = starter("x").expect("a name");
            let text = text.replace("\n[fabric]\n", &format!("\n[fabric]\nseal_strength = \"{strength}\"\n"));
            let text = text.replace(
                "\n[star]\n",
                &format!("\n[star]\ntip_radius = \"{radius}\"\ncorner_radius = \"{radius}\"\n"),
            );
            let text = format!("{text}\n[load]\npressure = \"37 kPa\"\n");
            of_text(text)
        };
        assert_eq!(codes(&with_strength("10 N/mm", "0 mm")), [""; 0]);
        let weak = with_strength("3 N/mm", "0 mm");
        assert_eq!(codes(&weak), ["bursts"]);
        let first = &weak.prediction.as_ref().expect("asked").first;
        let (burst, range) = first.burst_pressure_kPa.zip(first.ranges.burst_pressure_kPa).expect("known");
        let stated = forecast::ranges::shown::with_range(burst, range, "kPa");
        assert!(weak.unfit()[0].found.ends_with(&stated), "{:?}: {stated}", weak.unfit()[0]);
        let radius = weak.prediction.expect("asked").first.evidence.safe_radius_mm.expect("one helps");
        assert_eq!(codes(&with_strength("3 N/mm", &format!("{radius} mm"))), [""; 0]);
    }

    /// What is named is accepted as it is; where no pressure or radius is, none is named.
    #[test]
    fn the_pressure_and_the_radius_that_are_named_hold() {
        let number = |text: &str, words: &str| -> Option<f64> {
            text.split_once(words)?.1.split([' ', ',']).next()?.parse().ok()
        };
        for (points, inner, width, angle, strength, load, named) in [
            (6, 30.0, 15.0, 40.0, 0.5, "40 kPa", [false, false]),
            (3, 40.0, 30.0, 50.0, 0.5, "10 kPa", [true, false]),
            (5, 50.0, 30.0, 30.0, 3.0, "37 kPa", [true, true]),
            (5, 50.0, 30.0, 30.0, 3.0, "37 kPa\"\nobject_diameter = \"20 mm", [false, true]),
        ] {
            let with_load = |radius: f64, load: &str| {
                of_text(format!(
                    "schema = 1\nname = \"x\"\n[fabric]\nseal_strength = \"{strength} N/mm\"\n[star]\npoints = {points}\n\
                     inner_radius = \"{inner} mm\"\ntube_width = \"{width} mm\"\ntip_angle = \"{angle} deg\"\n\
                     tip_radius = \"{radius} mm\"\ncorner_radius = \"{radius} mm\"\n[load]\npressure = \"{load}\"\n"
                ))
            };
            let refused = with_load(0.0, load).unfit()[0].clone();
            assert_eq!(refused.code, RefusalCode::Bursts);
            let (kpa, mm) = (number(&refused.remedy, "at most "), number(&refused.remedy, "of at least "));
            assert_eq!([kpa.is_some(), mm.is_some()], named, "{points} {load}: {}", refused.remedy);
            if let Some(kpa) = kpa {
                assert_eq!(codes(&with_load(0.0, &format!("{kpa} kPa"))), [""; 0], "{}", refused.remedy);
            }
            if let Some(mm) = mm {
                assert!(!codes(&with_load(mm, load)).contains(&"bursts".to_owned()), "{}", refused.remedy);
            }
        }
    }
}
