//! Progress of long work on a terminal: one line on standard error with the current step and the elapsed time. It is removed at the end.
//!
//! It appears after half a second, and only on a terminal that can erase a line, without --quiet and --json. Nothing else is printed while
//! it is visible. Ctrl-C removes it before the program ends.

use std::io::stderr;
use std::process;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::cli::failure::Failure;
use crate::cli::interrupt::{self, Listening};
use crate::cli::terminal;
use crate::cli::verbosity::Verbosity;

/// Delay before the line appears: shorter work needs none.
const PATIENCE: Duration = Duration::from_millis(500);
/// Interval of checks of the clock and of Ctrl-C.
const PAUSE: Duration = Duration::from_millis(100);
/// Number of steps of the whole bar: finer than any terminal's resolution.
const WHOLE: u64 = 1000;

/// The line; invisible without a suitable terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    ticker: Option<(Sender<()>, JoinHandle<()>)>,
}

/// Runs `work`, which does not catch signals and writes nothing, with a line that shows `label`.
pub(super) fn with_line<T>(verbosity: Verbosity, label: &str, work: impl FnOnce(&Progress) -> T) -> T {
    work(&Progress::new(verbosity, label, true))
}

/// Runs `work`, which catches Ctrl-C itself, with a line that shows `label`.
pub(super) fn listening<T>(verbosity: Verbosity, label: &str, work: impl FnOnce(&Progress) -> T) -> T {
    work(&Progress::new(verbosity, label, false))
}

impl Progress {
    /// `ends`: whether Ctrl-C ends the program while the line is visible.
    fn new(verbosity: Verbosity, label: &str, ends: bool) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if !(verbosity.is_heard() && terminal::takes_lines_back(&stderr())) {
            return Self { bar, ticker: None };
        }
        bar.set_style(style("{spinner} {msg}, {elapsed}"));
        bar.set_message(label.to_owned());
        let (stop, stopped) = channel();
        let ticking_bar = bar.clone();
        let ticker = thread::Builder::new().spawn(move || tick(&ticking_bar, &stopped, ends));
        Self { bar, ticker: ticker.ok().map(|ticker| (stop, ticker)) }
    }

    /// Shows `step` as the current step.
    pub(super) fn tell(&self, step: &str) {
        self.bar.set_message(step.to_owned());
    }

    /// Shows `step` as the current step, and `part` of the whole, 0 to 1, as done.
    pub(super) fn tell_part(&self, part: f64, step: &str) {
        if self.ticker.is_none() || !(0.0..=1.0).contains(&part) {
            return;
        }
        if self.bar.length().is_none() {
            self.bar.set_length(WHOLE);
            self.bar.set_style(style("[{bar:20}] {percent} %, {msg}, about {eta} left"));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "0 to 1000"
        )]
        self.bar.set_position((part * WHOLE as f64) as u64);
        self.tell(step);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((stop, ticker)) = self.ticker.take() {
            drop(stop);
            let _ = ticker.join();
        }
        self.bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    // Characters that every terminal's font has.
    style.tick_chars("-\\|/ ").progress_chars("=> ")
}

/// Shows the line after the delay, and animates it until the sender of `stopped` is dropped. If it `ends` by Ctrl-C, so does the program.
fn tick(bar: &ProgressBar, stopped: &Receiver<()>, ends: bool) {
    let listening = ends.then(Listening::new);
    let start = Instant::now();
    let mut is_shown = false;
    while stopped.recv_timeout(PAUSE) == Err(RecvTimeoutError::Timeout) {
        if listening.as_ref().is_some_and(Listening::has_heard) {
            bar.finish_and_clear();
            let _ = Failure::Interrupted.report();
            process::exit(i32::from(interrupt::EXIT));
        }
        if !is_shown && start.elapsed() >= PATIENCE {
            bar.set_draw_target(ProgressDrawTarget::stderr());
            is_shown = true;
        }
        if is_shown {
            bar.tick();
        }
    }
}
