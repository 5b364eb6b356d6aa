//! Work on several threads at the same time.

use rayon::prelude::*;

/// Which threads share a computation's work. Results do not depend on them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Threads {
    /// The present one alone.
    One,
    /// All of this process.
    All,
}

impl Threads {
    /// All, but the present one alone where it is itself one of many that work at the same time: while it waited for a part of its work, it would
    /// begin another whole computation, and another in that one.
    pub(crate) fn available() -> Self {
        if rayon::current_thread_index().is_none() { Self::All } else { Self::One }
    }

    /// Whether `run` holds for all items; after one for which it does not, others may be left out.
    pub(crate) fn all<T: Send>(self, items: Vec<T>, run: impl Fn(T) -> bool + Send + Sync) -> bool {
        match self {
            Self::All if items.len() > 1 => items.into_par_iter().all(run),
            _ => items.into_iter().all(run),
        }
    }

    /// Calls `run` with each item.
    pub(crate) fn each<T: Send>(self, items: Vec<T>, run: impl Fn(T) + Send + Sync) {
        let _ = self.all(items, |item| {
            run(item);
            true
        });
    }
}
