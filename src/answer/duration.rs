//! Times of sealing.

use crate::pipeline::Forecast;

/// Time of all programs, s, without heating and pauses.
pub fn sealing_time(forecast: &Forecast) -> f64 {
    forecast.programs.iter().map(|program| program.time).sum()
}

/// "13 h 02 min"
pub fn hours(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round();
    format!("{} h {:02} min", (minutes / 60.0).floor(), minutes % 60.0)
}
