//! Ctrl-C, and what a cluster sends before it kills: the end of the program, unless somebody listens, who then ends in order; the
//! second one is the end in any case.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Once};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Exit code of a program that Ctrl-C ended, as shells have it.
pub(super) const EXIT: u8 = 130;

/// Raised by the first of them while somebody listens.
static HEARD: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
/// Whether nobody listens.
static FREE: LazyLock<Arc<AtomicBool>> = LazyLock::new(|| Arc::new(AtomicBool::new(true)));

/// While it lives, the signals are heard and do not end the program. One at a time.
pub(super) struct Listening;

impl Listening {
    /// Begins to listen.
    pub(super) fn new() -> Self {
        static ONCE: Once = Once::new();
        // In this order: the second signal finds the flag that the first one raised. Handlers are never taken back, for then
        // Ctrl-C would do nothing at all. Where they cannot be set, a signal ends the program as ever.
        ONCE.call_once(|| {
            for signal in [SIGINT, SIGTERM] {
                let _ = flag::register_conditional_default(signal, Arc::clone(&FREE));
                let _ = flag::register_conditional_shutdown(signal, i32::from(EXIT), Arc::clone(&HEARD));
                let _ = flag::register(signal, Arc::clone(&HEARD));
            }
        });
        HEARD.store(false, Ordering::SeqCst);
        FREE.store(false, Ordering::SeqCst);
        Self
    }

    /// Whether there was a signal.
    #[expect(clippy::unused_self, reason = "only who listens may ask")]
    pub(super) fn has_heard(&self) -> bool {
        HEARD.load(Ordering::SeqCst)
    }

    /// What is raised by it.
    #[expect(clippy::unused_self, reason = "only who listens may ask")]
    pub(super) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&HEARD)
    }
}

impl Drop for Listening {
    fn drop(&mut self) {
        FREE.store(true, Ordering::SeqCst);
    }
}
