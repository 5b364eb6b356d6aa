//! The end of a job that begins now, as time of day: printed on the terminal only, never written to a file.

use jiff::{SignedDuration, Zoned};

/// The end of a job of `seconds` that begins at `now`, in the zone of `now`: "Monday 23 November at 02:52 CET"; `None` above about a
/// thousand years.
pub(super) fn finish(now: &Zoned, seconds: f64) -> Option<String> {
    // More than a thousand years have no useful date.
    if !(0.0..3.2e10).contains(&seconds) {
        return None;
    }
    let end = now.checked_add(SignedDuration::try_from_secs_f64(seconds.round()).ok()?).ok()?;
    let day = match (end.date() == now.date(), end.year() == now.year()) {
        (true, _) => "today".to_owned(),
        (_, true) => end.strftime("%A %-d %B").to_string(),
        _ => end.strftime("%A %-d %B %Y").to_string(),
    };
    Some(format!("{day} at {}", end.strftime("%H:%M %Z")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end(now: &str, seconds: f64) -> String {
        finish(&now.parse().expect("a time"), seconds).unwrap_or_default()
    }

    #[test]
    fn an_end_has_its_weekday_in_the_zone_where_the_job_begins() {
        let day = 86_400.0;
        assert_eq!(end("2026-11-22T10:00[UTC]", 3599.0), "today at 10:59 UTC");
        assert_eq!(end("2026-11-22T23:00:01[UTC]", 3599.0), "Monday 23 November at 00:00 UTC");
        assert_eq!(end("2026-11-22T10:00+01:00[+01:00]", 17.0 * 3600.0), "Monday 23 November at 03:00 +01");
        assert_eq!(end("2026-12-31T10:00[UTC]", day), "Friday 1 January 2027 at 10:00 UTC");
        for seconds in [f64::NAN, f64::INFINITY, -1.0, 1e11] {
            assert_eq!(end("2026-11-22T10:00[UTC]", seconds), "");
        }
    }
}
