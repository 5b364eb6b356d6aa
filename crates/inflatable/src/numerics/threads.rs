//! Work on several threads at the same time.

use rayon::prelude::*;

/// Whether there is one thread only. No code of rayon is in a program for WebAssembly then.
const IS_ALONE: bool = cfg!(target_family = "wasm");

/// The results of `run` for all items, in their order; all threads share the items.
pub fn mapped<T: Send, U: Send>(items: Vec<T>, run: impl Fn(T) -> U + Send + Sync) -> Vec<U> {
    if IS_ALONE { items.into_iter().map(run).collect() } else { items.into_par_iter().map(run).collect() }
}

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
        if IS_ALONE || rayon::current_thread_index().is_some() { Self::One } else { Self::All }
    }

    /// Whether `run` holds for all items; after one for which it does not, others may be left out.
    pub(crate) fn run_while_true<T: Send>(
        self,
        items: Vec<T>,
        run: impl Fn(T) -> bool + Send + Sync,
    ) -> bool {
        match self {
            Self::All if !IS_ALONE && items.len() > 1 => items.into_par_iter().all(run),
            _ => items.into_iter().all(run),
        }
    }

    /// Calls `run` with each item.
    pub(crate) fn run_each<T: Send>(self, items: Vec<T>, run: impl Fn(T) + Send + Sync) {
        let _ = self.run_while_true(items, |item| {
            run(item);
            true
        });
    }
}
