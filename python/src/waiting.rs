//! Long calls: the work runs in its own thread without the GIL, while the caller's thread reports progress to Python and checks for Ctrl-C.
//! An interruption raises the exception at once; the work is cancelled, and its answer dropped.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use stargrip_cam::shell::cases::Watch;

/// Interval of checks for signals: too short to notice, too long to cost time.
const LOOK: Duration = Duration::from_millis(50);
/// Least time between two reports to Python.
const PAUSE: Duration = Duration::from_millis(100);
/// Stack of the thread, bytes: as large as the command's main thread.
const STACK: usize = 8 << 20;

/// The connection of the work to its caller: progress, and cancellation.
pub(crate) struct Line {
    told: Sender<(f64, String)>,
    /// Set when the caller no longer waits.
    pub(crate) cancel: Arc<AtomicBool>,
}

impl Line {
    /// Reports the part that is done, 0 to 1, and the current step.
    pub(crate) fn tell(&self, part: f64, step: &str) {
        // The caller may no longer wait.
        let _ = self.told.send((part, step.to_owned()));
    }

    /// Runs `work`, whose observer this is. A drawing of many unknowns is refused, unless it `is_asked` for.
    pub(crate) fn watched<T>(&self, is_asked: bool, work: impl FnOnce(&Watch<'_>) -> T) -> T {
        let tell = |part: f64, what: &str| self.tell(part, what);
        work(&Watch { progress: Some(&tell), cancel: Arc::clone(&self.cancel), is_bounded: !is_asked })
    }

    /// None if the caller no longer waits.
    pub(crate) fn goes_on(&self) -> Option<()> {
        (!self.cancel.load(Ordering::Relaxed)).then_some(())
    }
}

/// The answer of `work`; `progress` is the user's argument: None, a bool or a callable of part and text.
pub(crate) fn wait<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Line) -> T + Send + 'static,
) -> PyResult<T> {
    let progress_hook = hook(py, progress)?;
    let (sender, receiver) = channel();
    let cancel = Arc::new(AtomicBool::new(false));
    let line = Line { told: sender, cancel: Arc::clone(&cancel) };
    // The end of the work drops the line, which disconnects the channel.
    let worker = thread::Builder::new().stack_size(STACK).spawn(move || work(&line))?;
    if let Err(error) = listen(py, progress_hook.as_ref(), receiver) {
        cancel.store(true, Ordering::Relaxed);
        return Err(error);
    }
    let answer = py.detach(|| worker.join());
    let answer =
        answer.map_err(|_| PyRuntimeError::new_err("a fault of stargrip-cam: the computation broke off"))?;
    if let Some(progress_hook) = progress_hook {
        let _ = progress_hook.call1(py, (1.0, "done"))?;
    }
    Ok(answer)
}

/// Reports progress to `hook` until the work ends.
fn listen(py: Python<'_>, hook: Option<&Py<PyAny>>, mut receiver: Receiver<(f64, String)>) -> PyResult<()> {
    let mut last: Option<Instant> = None;
    loop {
        let (back, message) = py.detach(move || {
            let message = receiver.recv_timeout(LOOK);
            (receiver, message)
        });
        receiver = back;
        py.check_signals()?;
        match message {
            Ok((part, what)) => {
                if let Some(hook) = hook.filter(|_| last.is_none_or(|last| last.elapsed() >= PAUSE)) {
                    let _ = hook.call1(py, (part, what))?;
                    last = Some(Instant::now());
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
    }
}

/// The receiver of progress: for `True` a line on the terminal or in the notebook.
fn hook(py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Py<PyAny>>> {
    let Some(object) = progress else { return Ok(None) };
    match object.extract::<bool>() {
        Ok(false) => Ok(None),
        Ok(true) => py.import("stargrip_cam._progress")?.getattr("Line")?.call0().map(|l| Some(l.unbind())),
        Err(_) => Ok(Some(object.clone().unbind())),
    }
}
