//! Times of sealing.

use crate::pipeline::Forecast;
use design::PressPlan;
use program::plan::{ProcessTime, Program, process_times};
use spec::SealProcess;

/// Temperature or power, speed and time of every process: "weak at 170 C and 2 mm/s, 3 min; then seal at ...".
pub fn processes_in_words(programs: &[Program]) -> Option<String> {
    let in_words = |time: ProcessTime<'_>| {
        let SealProcess { name, seal, .. } = time.process;
        format!("{name} at {} and {}, {}", seal.heat_in_words(), seal.speed, hours(time.seconds))
    };
    let words: Vec<String> = process_times(programs).into_iter().map(in_words).collect();
    (!words.is_empty()).then(|| words.join("; then "))
}

/// Time of all programs, s, without heating and pauses; of a press the time of all pressings.
pub fn sealing_time(forecast: &Forecast) -> f64 {
    let plan = PressPlan::new(&forecast.spec, &forecast.design);
    plan.map_or_else(|| forecast.programs.iter().map(|program| program.time).sum(), |plan| plan.seconds)
}

/// Time of sealing: "13 h 02 min", or of a press "2 pressings of 10 s at 145 C and 2 bar".
pub fn sealing_in_words(forecast: &Forecast) -> String {
    let plan = forecast.spec.press.as_ref().zip(PressPlan::new(&forecast.spec, &forecast.design));
    plan.map_or_else(|| hours(sealing_time(forecast)), |(press, plan)| plan.in_words(press))
}

/// "13 h 02 min", "22 min"
pub fn hours(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round();
    if minutes < 60.0 {
        return format!("{minutes} min");
    }
    format!("{} h {:02} min", (minutes / 60.0).floor(), minutes % 60.0)
}
