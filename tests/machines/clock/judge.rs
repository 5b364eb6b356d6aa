//! Tolerances of a program's speed and time, and the comparison with its track.

use super::text::{Command, Text};
use super::track::Track;

/// Tolerance of the mean speed of a stretch, relative.
pub(crate) const MEAN: f64 = 0.002;
/// Tolerance of the mean speed on a version of a controller that the profile does not state, relative.
pub(crate) const OTHER_VERSION: f64 = 0.005;
/// Tolerance of the total time, relative.
pub(crate) const TOTAL: f64 = 0.005;
/// Tolerances of the speed within a window, steady and chopped: six strokes have six rests, or one more or less.
const STEADY: f64 = 0.01;
const CHOPPED: f64 = 0.15;
/// Length of a window, mm; and its least number of strokes, for a fast seal with long ones.
const WINDOW: f64 = 1.0;
const STROKES: f64 = 6.0;

/// The largest deviations of a program, relative to the required values.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Deviations {
    pub(crate) mean: f64,
    pub(crate) window: f64,
    pub(crate) total: f64,
}

/// Deviations of `track`, the run of `text`, from `speed` mm/s, and a complaint for each beyond its tolerance. `stop` is the fraction of a
/// window's time that one stop may take where it moves steadily.
pub(crate) fn deviations(text: &Text, track: &Track, speed: f64, stop: f64) -> (Deviations, Vec<String>) {
    deviations_within(MEAN, text, track, speed, stop)
}

/// The deviations of a program, with another tolerance of the mean speed.
pub(crate) fn deviations_within(
    tolerance: f64,
    text: &Text,
    track: &Track,
    speed: f64,
    stop: f64,
) -> (Deviations, Vec<String>) {
    let chopped = text.commands.iter().any(|(_, command)| matches!(command, Command::Dwell(_)));
    let window = (STROKES * text.fact("chop.longest_mm").unwrap_or(0.0)).max(WINDOW);
    let allowed = if chopped { CHOPPED } else { STEADY + stop };
    let mut worst = Deviations::default();
    let mut complaints = Vec::new();
    for stretch in &track.stretches {
        let mean = stretch.speed() / speed - 1.0;
        let (slowest, highest) = stretch.windows(window);
        let deviation = (slowest / speed - 1.0).abs().max((highest / speed - 1.0).abs());
        let finite_deviation = if slowest.is_finite() { deviation } else { 0.0 };
        if !(-tolerance..=tolerance).contains(&mean) {
            complaints.push(format!("line {}: mean speed {:+.2} %", stretch.line, 100.0 * mean));
        }
        if finite_deviation > allowed {
            complaints.push(format!(
                "line {}: {:.1} % within {window} mm",
                stretch.line,
                100.0 * finite_deviation
            ));
        }
        worst.mean = if mean.abs() > worst.mean.abs() { mean } else { worst.mean };
        worst.window = worst.window.max(finite_deviation);
    }
    if let Some(total) = text.fact("total.time_s") {
        worst.total = track.now / total - 1.0;
        if !(-TOTAL..=TOTAL).contains(&worst.total) {
            complaints.push(format!("total {:.0} s, told {total} s", track.now));
        }
    }
    complaints.extend(progress(text, track));
    (worst, complaints)
}

/// Every progress report that differs from the completed part: tolerance a per cent, or half of one and a piece of 5 mm.
fn progress(text: &Text, track: &Track) -> Vec<String> {
    let total = track.now;
    let wrong = text.progress.iter().filter_map(|(line, percent, remaining)| {
        let (_, time) = track.lines.iter().find(|(leg, _)| leg > line)?;
        let error = 100.0 * time / total - percent;
        let right = (-0.6..=1.6).contains(&error) && (total - time - remaining).abs() <= TOTAL * total + 1.0;
        (!right)
            .then(|| format!("line {line}: {percent} % and {remaining} s to go at {time:.0} of {total:.0} s"))
    });
    let rises = text.progress.windows(2).all(|pair| pair[0].1 < pair[1].1);
    wrong.chain((!rises).then(|| "progress that does not rise".to_owned())).collect()
}
