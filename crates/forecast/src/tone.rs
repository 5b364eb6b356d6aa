//! The **tone** of a verdict: how sure a page may look about a gripper or a drawn piece. Every page colours its verdict by it.

use serde::Serialize;

use crate::drawn::prediction::DrawnPrediction;
use crate::prediction::Prediction;
use crate::verdict_answer::Holds;

/// How a verdict is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// It does its work, and its seal is known to bear it.
    Good,
    /// It may fail, or the strength of its seal is unknown.
    Fair,
    /// It fails.
    Bad,
    /// Nothing is predicted.
    Plain,
}

impl Prediction {
    /// The tone of the verdict on the object: good only if every star's burst pressure is known and above its pressure.
    pub fn tone(&self) -> Tone {
        let Some(verdict) = &self.verdict else { return Tone::Plain };
        let bursts = self.stars.iter().any(|star| star.burst_margin.is_some_and(|margin| margin < 1.0));
        match verdict.holds {
            _ if bursts => Tone::Bad,
            Holds::No => Tone::Bad,
            Holds::Unknown => Tone::Fair,
            Holds::Yes if self.stars.iter().any(|star| star.burst_pressure_kPa.is_none()) => Tone::Fair,
            Holds::Yes => Tone::Good,
        }
    }
}

impl DrawnPrediction {
    /// The tone of the pressure in the piece: good only below the whole range of its burst pressure, and without a warning.
    pub fn tone(&self) -> Tone {
        if self.model == "none" {
            return Tone::Plain;
        }
        let Some((range, pressure)) = self.burst_range_kPa.zip(self.pressure_kPa) else { return Tone::Fair };
        if pressure > range[1] {
            Tone::Bad
        } else if pressure > range[0] || !self.evidence.warnings.is_empty() {
            Tone::Fair
        } else {
            Tone::Good
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_is_good_only_below_the_whole_range_of_its_burst_pressure() {
        let range = Some([20.0, 30.0]);
        for (pressure, range, warnings, tone) in [
            (10.0, range, &[][..], Tone::Good),
            (10.0, range, &["it may bend"], Tone::Fair),
            (10.0, None, &[], Tone::Fair),
            (25.0, range, &[], Tone::Fair),
            (31.0, range, &[], Tone::Bad),
        ] {
            let mut prediction = DrawnPrediction { model: "shell", ..DrawnPrediction::default() };
            prediction.pressure_kPa = Some(pressure);
            prediction.burst_range_kPa = range;
            prediction.evidence.warnings = warnings.iter().map(|text| (*text).to_owned().into()).collect();
            assert_eq!(prediction.tone(), tone, "{pressure} {range:?}");
        }
        assert_eq!(DrawnPrediction { model: "none", ..DrawnPrediction::default() }.tone(), Tone::Plain);
    }
}
