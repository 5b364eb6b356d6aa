//! Output of a block of commands, and its comparison with a page.

use std::path::Path;
use std::process::Command;

use crate::page::{Block, Page};

/// The output of a block of commands.
pub(crate) struct BlockOutput {
    /// Both streams in their order.
    pub(crate) text: String,
    /// Whether the last command succeeded.
    pub(crate) is_done: bool,
    line: usize,
}

impl BlockOutput {
    /// Runs `block` in `dir`, which is also its home, without a terminal.
    pub(crate) fn run_block(block: &Block, dir: &Path) -> Self {
        let program = Path::new(env!("CARGO_BIN_EXE_stargrip-cam")).parent().expect("a directory");
        let mut path = program.as_os_str().to_owned();
        path.push(":");
        path.push(std::env::var_os("PATH").unwrap_or_default());
        let script = format!("exec 2>&1\n{}", block.body);
        let output = Command::new("sh")
            .args(["-eu", "-c", &script])
            .current_dir(dir)
            .env_clear()
            .env("PATH", path)
            .env("HOME", dir)
            .env("TZ", "UTC")
            .output()
            .expect("there is a shell");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Self { text, is_done: output.status.success(), line: block.line }
    }

    /// A failure that the page does not show.
    pub(crate) fn unexpected(self, page: &Page) -> Option<String> {
        let Self { text, is_done, line } = self;
        (!is_done).then(|| format!("{}:{line}: fails, and the page does not say so\n{text}", page.name))
    }
}

/// Whether `output` matches `pattern`.
pub(crate) fn matches(pattern: &str, output: &str) -> bool {
    let pattern: Vec<&str> = pattern.lines().collect();
    let lines: Vec<&str> = output.lines().collect();
    lines_match(&pattern, &lines)
}

fn lines_match(pattern: &[&str], lines: &[&str]) -> bool {
    match pattern.split_first() {
        None => lines.is_empty(),
        Some((&"...", rest)) => (0..=lines.len()).any(|skipped| lines_match(rest, &lines[skipped..])),
        Some((line, rest)) => lines.split_first().is_some_and(|(lines, others)| {
            let is_same = line.strip_suffix(" ...").map_or(lines == line, |start| lines.starts_with(start));
            is_same && lines_match(rest, others)
        }),
    }
}

#[test]
fn what_is_left_out_is_shown_by_dots_alone() {
    assert!(matches("a\n...\nd e ...\n", "a\nb\nc\nd e f\n") && matches("...\nb\n", "b\n"));
    assert!(!matches("a\n", "a\nb\n") && !matches("a\n...\n", "b\n") && !matches("d ...\n", "e d\n"));
}
