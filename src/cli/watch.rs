//! Before you seal: what a person has to see to, or should know, before hours of work begin.

use std::path::Path;

use crate::airtight;
use crate::cli::figure::rounded;
use crate::cli::harmless::shown;
use crate::pipeline::Forecast;
use crate::plan::Pace;
use crate::spec::Machine;
use crate::units::{Readable, Speed};

/// Below this the lowest step rate of a controller matters: firmwares step at 30 to 120 steps/s at least, and a belt has 25 steps/mm
/// or more, which makes some 5 mm/s.
const SLOW: Speed = Speed(5.0);

/// Above this a seal is sealed ten times as fast as those of the paper, 0.1 mm/s.
const FAST: Speed = Speed(1.0);

/// The profile for a machine of which nothing is known.
const UNKNOWN: &str = "generic";

/// Everything to see to, of the spec at `path`, the most pressing first.
pub(super) fn list(forecast: &Forecast, path: &Path) -> Vec<String> {
    let unfit = forecast.unfit();
    let mut list: Vec<String> = unfit.iter().map(|refusal| refusal.found.clone()).collect();
    list.extend(uncertain(forecast));
    // What is said of an unfit gripper is not said twice.
    let is_said = |text: &str| {
        !unfit.is_empty() && ["the object ", "the pressure "].iter().any(|start| text.starts_with(start))
    };
    let weak = airtight::report(&forecast.spec, &forecast.machine, &forecast.design).weaknesses;
    list.extend(weak.into_iter().filter(|text| unfit.is_empty() || !text.contains("burst margin")));
    list.extend(strength(forecast));
    for star in forecast.prediction.iter().flat_map(|prediction| &prediction.stars) {
        let warnings =
            star.evidence.warnings.iter().filter(|text| **text != star.evidence.choice && !is_said(text));
        list.extend(warnings.cloned());
    }
    if is_unknown(&forecast.machine) && !matches!(pace(forecast), Some(Pace::Chopped(_))) {
        list.extend(fast(forecast, path));
        list.push(format!(
            "{} profile: speed, pause and reach are not checked; name your machine with `profile` in [machine], or time what \
             `stargrip-cam feedcheck {}` writes",
            forecast.machine.name,
            shown(path)
        ));
        return unique(list);
    }
    list.extend(speed(forecast, path));
    list.extend(forecast.machine.script.requires.iter().cloned());
    if forecast.machine.bench.work_area.is_none() {
        list.push(format!(
            "the machine must reach {}: `x` and `y` in [work_area] of its profile are unknown",
            sheets(forecast)
        ));
    }
    unique(list)
}

/// `list` with each text once.
fn unique(list: Vec<String>) -> Vec<String> {
    let mut once = Vec::new();
    for text in list {
        if !once.contains(&text) {
            once.push(text);
        }
    }
    once
}

/// Whether the profile is the one that knows neither how slowly its machine goes nor how far it reaches.
fn is_unknown(machine: &Machine) -> bool {
    machine.name == UNKNOWN && machine.motion.speed_range().is_none() && machine.bench.work_area.is_none()
}

fn pace(forecast: &Forecast) -> Option<Pace> {
    forecast.programs.first().map(|program| program.pace)
}

/// That it may not hold its object, unless it is refused for that: what is printed however quiet one is.
pub(super) fn uncertain(forecast: &Forecast) -> Option<String> {
    forecast.uncertain().filter(|_| forecast.unfit().is_empty())
}

/// The sheets' sizes, mm.
pub(super) fn sheets(forecast: &Forecast) -> String {
    let mut sizes: Vec<String> = forecast
        .design
        .sheets
        .iter()
        .map(|sheet| format!("{} x {} mm", rounded(sheet.width), rounded(sheet.height)))
        .collect();
    sizes.dedup();
    sizes.join(", ")
}

/// Whether it is known what the seal holds.
fn strength(forecast: &Forecast) -> Option<String> {
    let _ = forecast.spec.load.as_ref()?.pressure?;
    if forecast.spec.fabric.seal_strength.is_some() {
        return None;
    }
    let report = airtight::report(&forecast.spec, &forecast.machine, &forecast.design);
    let loads = report.stars.iter().flat_map(|star| &star.loads).filter_map(|load| load.load);
    let most = loads.map(|load| load.0).reduce(f64::max)?;
    Some(format!(
        "at which pressure it bursts is unknown: the seal bears {} N/mm, and `seal_strength` in [fabric] is not written",
        rounded(most)
    ))
}

/// Whether the machine goes as slowly as the program says, and whether a fast seal is one.
fn speed(forecast: &Forecast, path: &Path) -> Vec<String> {
    let Forecast { spec, machine, .. } = forecast;
    let (speed, command) = (spec.seal.speed, |name: &str| format!("`stargrip-cam {name} {}`", shown(path)));
    let mut list = Vec::new();
    match pace(forecast) {
        Some(Pace::Chopped(chop)) => list.push(format!(
            "the seal's speed is made of strokes of at most {} mm at {} mm/s, and dwells: they count on an acceleration of {} \
             mm/s^2{}; time what {} writes",
            Readable(chop.longest),
            rounded(chop.speed),
            Readable(chop.acceleration),
            machine.motion.steps_per_mm.map_or(String::new(), |[x, y, _]| {
                format!(" and at least {x} (X) and {y} (Y) steps/mm")
            }),
            command("feedcheck")
        )),
        _ if machine.motion.speed_range().is_none() && speed < SLOW => list.push(format!(
            "the lowest feed of this machine is unknown, and some controllers go several times faster than {speed} \
             without reporting it: time what {} writes",
            command("feedcheck")
        )),
        _ => {}
    }
    list.extend(fast(forecast, path));
    list
}

/// Whether what is sealed so fast is a seal.
fn fast(forecast: &Forecast, path: &Path) -> Option<String> {
    let speed = forecast.spec.seal.speed;
    (speed > FAST).then(|| {
        format!(
            "the paper sealed at 0.1 mm/s: only a peel test tells whether this fabric is tight when sealed at {speed}; \
             `stargrip-cam coupon {}` writes one",
            shown(path)
        )
    })
}
