//! Ctrl-C (SIGINT) and SIGTERM: they end the program, unless a [`Listening`] exists. Then the first signal asks the work to stop, and the
//! second one ends the program. So does the first one where the work does not stop: it may wait for a reader of its output. SIGXFSZ, the limit
//! of a file's size, is a failed write.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Once};
use std::thread;
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::{flag, low_level};

/// Exit code after Ctrl-C, by the convention of shells.
pub(super) const EXIT: u8 = 130;

/// Time for the work to stop after the first signal: longer than the slowest step between two looks at the flag.
const GRACE: Duration = Duration::from_secs(10);
/// Interval of looks at the flag.
const PAUSE: Duration = Duration::from_millis(200);

/// Set by the first signal while a [`Listening`] exists.
static HEARD: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
/// Whether a signal ends the program at once: no [`Listening`] exists.
static FREE: LazyLock<Arc<AtomicBool>> = LazyLock::new(|| Arc::new(AtomicBool::new(true)));

/// While it exists, a first signal does not end the program. At most one may exist at a time.
pub(super) struct Listening;

impl Listening {
    /// Starts to catch signals.
    pub(super) fn new() -> Self {
        static ONCE: Once = Once::new();
        // In this order: the second signal finds the flag that the first one set. Handlers are never removed, because Ctrl-C would then do
        // nothing at all. Where they cannot be set, a signal ends the program as usual.
        ONCE.call_once(|| {
            for signal in [SIGINT, SIGTERM] {
                let _ = flag::register_conditional_default(signal, Arc::clone(&FREE));
                let _ = flag::register_conditional_shutdown(signal, i32::from(EXIT), Arc::clone(&HEARD));
                let _ = flag::register(signal, Arc::clone(&HEARD));
            }
            let _ = thread::Builder::new().spawn(end_deaf_work);
        });
        HEARD.store(false, Ordering::SeqCst);
        FREE.store(false, Ordering::SeqCst);
        Self
    }

    /// Whether a signal has arrived.
    #[expect(clippy::unused_self, reason = "only a listener may read the signal")]
    pub(super) fn has_heard(&self) -> bool {
        HEARD.load(Ordering::SeqCst)
    }

    /// The flag that a signal sets.
    #[expect(clippy::unused_self, reason = "only a listener may read the signal")]
    pub(super) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&HEARD)
    }
}

/// Ignores SIGXFSZ, which would end the program in the middle of a file at the limit of its size (`ulimit -f`). The write fails instead, and
/// the command ends with a message and removes what it has begun.
pub(super) fn outlive_size_limit() {
    // Where no handler can be set, the signal ends the program as usual.
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Ends the program [`GRACE`] after a signal if the [`Listening`] that heard it still exists.
fn end_deaf_work() -> ! {
    let mut waited = Duration::ZERO;
    loop {
        thread::sleep(PAUSE);
        let is_asked = HEARD.load(Ordering::SeqCst) && !FREE.load(Ordering::SeqCst);
        waited = if is_asked { waited + PAUSE } else { Duration::ZERO };
        if waited >= GRACE {
            low_level::exit(i32::from(EXIT));
        }
    }
}

impl Drop for Listening {
    fn drop(&mut self) {
        FREE.store(true, Ordering::SeqCst);
    }
}
