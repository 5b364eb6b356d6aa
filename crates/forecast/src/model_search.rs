//! The models that were tried for a requested accuracy, with the errors that they state.

use crate::ranges::shown::rounded;
use serde::Serialize;
use spec::Detail;
use spec::units::Percent;
use std::fmt;

/// One tried model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ModelTrial {
    /// The model.
    pub model: &'static str,
    /// Fineness of a shell's meshes.
    pub fineness: Option<&'static str>,
    /// Stated error; `None` where it has no answer, or states none.
    pub error: Option<f64>,
}

/// The search for a model with a requested accuracy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AccuracySearch {
    /// The largest accepted relative error.
    pub requested: f64,
    /// Whether the answer states no larger error. Otherwise it is that of the least stated error.
    pub met: bool,
    /// The tried models.
    pub trials: Vec<ModelTrial>,
}

impl AccuracySearch {
    /// A search for `accuracy` without trials.
    pub fn new(accuracy: Percent) -> Self {
        Self { requested: accuracy.ratio(), met: false, trials: Vec::new() }
    }

    /// Adds the trial of `model` with meshes of `detail`, which states `error`, and whether that is small enough.
    pub fn record(&mut self, model: &'static str, detail: Option<Detail>, error: Option<f64>) -> bool {
        let fineness = detail.map(Detail::word);
        self.trials.push(ModelTrial { model, fineness, error });
        self.met = error.is_some_and(|error| error <= self.requested);
        self.met
    }

    /// The warning that no model states so small an error; `None` if one does.
    pub fn warning(&self) -> Option<String> {
        let smallest_error = self.trials.iter().filter_map(|trial| trial.error).reduce(f64::min);
        let error_text = smallest_error
            .map_or_else(|| "unknown".to_owned(), |smallest_error| format!("{} %", percent(smallest_error)));
        (!self.met).then(|| {
            format!(
                "no model states an error of at most {} %: the least is {error_text}",
                rounded(100.0 * self.requested)
            )
        })
    }
}

impl fmt::Display for AccuracySearch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "for an error of at most {} %:", rounded(100.0 * self.requested))?;
        for (i, trial) in self.trials.iter().enumerate() {
            let error =
                trial.error.map_or_else(|| "unknown".to_owned(), |error| format!("{} %", percent(error)));
            let fineness = trial.fineness.map_or_else(String::new, |fineness| format!(" {fineness}"));
            write!(f, "{} {}{fineness} {error}", if i > 0 { "," } else { "" }, trial.model)?;
        }
        Ok(())
    }
}

/// A relative error in percent, rounded up to a tenth.
fn percent(error: f64) -> String {
    rounded((1e3 * error - 1e-9).ceil() / 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_in_vain_warns_with_the_least_error() {
        let mut search = AccuracySearch::new(Percent(2.0));
        assert!(search.warning().expect("not met").ends_with("the least is unknown"));
        assert!(!search.record("section", None, None));
        assert!(!search.record("shell", Some(Detail::Coarse), Some(0.3)));
        assert!(!search.record("shell", Some(Detail::Medium), Some(0.1004)));
        let warning = search.warning().expect("not met");
        assert!(warning.contains("at most 2 %") && warning.ends_with("the least is 10.1 %"), "{warning}");
        assert_eq!(
            search.to_string(),
            "for an error of at most 2 %: section unknown, shell coarse 30 %, shell medium 10.1 %"
        );
        assert!(search.record("shell", Some(Detail::Fine), Some(0.02)));
        assert_eq!(search.warning(), None);
    }
}
