//! The time of day at which a job that begins now would end: on the terminal only, never in a file.

use std::time::{SystemTime, UNIX_EPOCH};

/// Seconds of a day.
const DAY: u64 = 86_400;

/// When a job of `seconds` that begins at `now` ends, in UTC; `None` if the clock of this computer is before 1970, or the
/// job has no end.
pub(super) fn finish(now: SystemTime, seconds: f64) -> Option<String> {
    let begins = now.duration_since(UNIX_EPOCH).ok()?.as_secs();
    // A thousand years and more are no time to tell.
    if !(0.0..3.2e10).contains(&seconds) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a thousand years")]
    let ends = begins.checked_add(seconds.round() as u64)?;
    let minutes = (ends % DAY) / 60;
    let days = ends / DAY - begins / DAY;
    Some(format!(
        "started now, sealing would end at about {:02}:{:02} UTC, day +{days}",
        minutes / 60,
        minutes % 60
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn midnight_is_another_day() {
        let at = |seconds: u64| UNIX_EPOCH + Duration::from_secs(seconds);
        let end = |begins, seconds| finish(at(begins), seconds).unwrap_or_default();
        assert!(end(0, 59.0).ends_with("00:00 UTC, day +0"));
        assert!(end(10 * DAY + 82_800, 3599.0).ends_with("23:59 UTC, day +0"));
        assert!(end(10 * DAY + 82_800, 3600.0).ends_with("00:00 UTC, day +1"));
        assert!(end(DAY, 200_000.0).ends_with("07:33 UTC, day +2"));
        assert_eq!(finish(at(0), f64::NAN), None);
        assert_eq!(finish(at(0), f64::INFINITY), None);
    }
}
