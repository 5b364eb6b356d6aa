//! Opens a page in the system's default program.

use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::cli::escape::escaped_line;
use crate::cli::failure::tell;

/// The platform's command that opens a file.
const OPENER: &str = if cfg!(target_os = "macos") {
    "open"
} else if cfg!(windows) {
    "explorer"
} else {
    "xdg-open"
};

/// Interval and number of checks whether the opener has failed. An opener that still runs then shows the page itself.
const LOOKS: (Duration, u32) = (Duration::from_millis(50), 20);

/// Opens the file `page`. A failure is only a note: the files exist in any case.
pub(super) fn open(page: &Path) {
    if let Some(problem) = failure(page) {
        tell(&format!("note: {} was not opened: {problem}", escaped_line(page)));
    }
}

/// The reason of the opener's failure, if it fails at once.
fn failure(page: &Path) -> Option<String> {
    let mut command = Command::new(OPENER);
    let command = command.arg(page).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(error) => return Some(format!("{OPENER}: {error}")),
    };
    let (pause, most_looks) = LOOKS;
    for _ in 0..most_looks {
        match child.try_wait() {
            // Explorer exits with 1 even on success.
            Ok(Some(status)) if status.success() || cfg!(windows) => return None,
            Ok(Some(status)) => return Some(format!("{OPENER} ended with {status}")),
            Ok(None) => sleep(pause),
            Err(error) => return Some(format!("{OPENER}: {error}")),
        }
    }
    None
}
