//! Ctrl-C and what a cluster sends before it kills: a wish to stop, which leaves no half file.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::SigId;
use signal_hook::consts::{SIGINT, SIGTERM};

/// Whether a signal asked to stop.
pub(in crate::cli) struct Stop {
    flag: Arc<AtomicBool>,
    registered: Vec<SigId>,
}

impl Stop {
    /// Listens from now on. The second signal ends the process at once.
    pub(in crate::cli) fn new() -> Self {
        let flag = Arc::new(AtomicBool::new(false));
        let mut registered = Vec::new();
        for signal in [SIGINT, SIGTERM] {
            // In this order: the second signal finds the flag raised by the first.
            let second = signal_hook::flag::register_conditional_shutdown(signal, 130, Arc::clone(&flag));
            let first = signal_hook::flag::register(signal, Arc::clone(&flag));
            registered.extend(second.into_iter().chain(first));
        }
        Self { flag, registered }
    }

    /// The flag that is raised.
    pub(in crate::cli) fn flag(&self) -> &AtomicBool {
        &self.flag
    }

    /// Whether it was raised.
    pub(in crate::cli) fn is_raised(&self) -> bool {
        self.flag.load(Ordering::Relaxed)
    }
}

impl Drop for Stop {
    fn drop(&mut self) {
        for registered in &self.registered {
            let _ = signal_hook::low_level::unregister(*registered);
        }
    }
}
