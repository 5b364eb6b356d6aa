//! The work of shells: a computation that takes long is refused before it begins, unless it is requested.

use crate::predict::PredictFault;
use design::RefusalCode;
use inflatable::shell::cases::Watch;
use spec::key;
use spec::units::Readable;

/// The estimated size of a computation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ShellWork {
    /// Of the finest meshes, all together.
    pub(crate) unknowns: f64,
    /// On one processor of 2024.
    pub(crate) seconds: f64,
}

impl ShellWork {
    /// Tells `watch` the size before the computation begins, or refuses one of more than `most_seconds` if `watch` is bounded. `subject` is
    /// what is computed, and `remedy` how to compute less.
    ///
    /// # Errors
    /// The refusal.
    pub(crate) fn begin(
        self,
        most_seconds: f64,
        watch: &Watch<'_>,
        [subject, remedy]: [&str; 2],
    ) -> Result<(), PredictFault> {
        let size = format!("about {} unknowns and {}", thousands(self.unknowns), duration(self.seconds));
        if !watch.is_bounded || self.seconds <= most_seconds {
            if let Some(progress) = watch.progress {
                progress(0.0, &size);
            }
            return Ok(());
        }
        let limit = duration(most_seconds);
        let problem = format!("{subject}: {size}; at most {limit} are computed unasked");
        Err(PredictFault {
            code: RefusalCode::LargeShell,
            remedy: Some(remedy.to_owned()),
            ..PredictFault::new(key::accuracy::MODEL, problem)
        })
    }
}

/// A number of unknowns, rounded to thousands.
fn thousands(unknowns: f64) -> Readable {
    Readable(1e3 * (unknowns / 1e3).round())
}

/// `seconds` in words: "40 s", "7 min", "3 h".
fn duration(seconds: f64) -> String {
    match seconds {
        ..90.0 => format!("{:.0} s", seconds.max(1.0)),
        ..5400.0 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.0} h", seconds / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn begin(work: ShellWork, watch: &Watch<'_>) -> Result<(), PredictFault> {
        work.begin(226.0, watch, ["the shell is large", "draw less"])
    }

    #[test]
    fn only_a_large_computation_that_is_not_requested_is_refused() {
        let accepted_work = ShellWork { unknowns: 113_400.0, seconds: 226.0 };
        let bounded_watch = Watch { is_bounded: true, ..Watch::default() };
        assert_eq!(begin(accepted_work, &bounded_watch), Ok(()));
        let refused_work = ShellWork { seconds: 226.1, ..accepted_work };
        assert_eq!(begin(refused_work, &Watch::default()), Ok(()));
        let refusal = begin(refused_work, &bounded_watch).expect_err("too large");
        assert_eq!(refusal.code, RefusalCode::LargeShell);
        let size = "the shell is large: about 113000 unknowns and 4 min; at most 4 min are computed unasked";
        assert_eq!((refusal.what.as_str(), refusal.remedy.as_deref()), (size, Some("draw less")));
    }
}
