//! How a command fails, and what it prints then.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::io;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

use crate::cli::{PublishFault, findings};
use crate::spec;
use crate::spec::Faults;
use crate::verify::Finding;

/// Why a command did not do what it was asked for. All of them end with exit code 1.
#[derive(Debug)]
pub(super) enum Failure {
    /// The spec, the profile or the design is refused.
    Faults(Faults),
    /// Outputs do not say what the design says.
    Findings(Vec<Finding>),
    /// Nothing could be published.
    Publish(PublishFault),
    /// Anything else, in one sentence.
    Message(String),
    /// It has been said already, on standard output.
    Said,
    /// The reader of our standard output has gone; there is nobody left to tell.
    Pipe,
}

impl Failure {
    /// A file that could not be read or written.
    pub(super) fn file(what: &str, path: &Path, error: &io::Error) -> Self {
        Self::Message(format!("cannot {what} {}: {error}", shown(path)))
    }

    /// Prints it to standard error.
    pub(super) fn report(self) -> ExitCode {
        let text = match self {
            Self::Faults(faults) => {
                tell_faults(&faults);
                return ExitCode::FAILURE;
            }
            Self::Findings(findings) => {
                let lines = findings::lines(&findings).join("\n");
                format!("error: {} findings; nothing was published\n{lines}", findings.len())
            }
            Self::Publish(error) => format!("error: {error}"),
            Self::Message(text) => format!("error: {text}"),
            Self::Said => return ExitCode::FAILURE,
            Self::Pipe => return ExitCode::SUCCESS,
        };
        tell(&text);
        ExitCode::FAILURE
    }
}

impl From<Faults> for Failure {
    fn from(faults: Faults) -> Self {
        Self::Faults(faults)
    }
}

impl From<PublishFault> for Failure {
    fn from(error: PublishFault) -> Self {
        Self::Publish(error)
    }
}

/// Prints warnings to standard error, if there are any.
pub(super) fn warn(faults: &Faults) {
    if !faults.is_empty() {
        tell_faults(faults);
    }
}

/// Prints to standard output; a closed pipe ends the command quietly, as other filters do.
pub(super) fn say(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let written = out.write_all(harmless(text).as_bytes()).and_then(|()| out.flush());
    written.map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::Pipe,
        _ => Failure::Message(format!("cannot write to standard output: {error}")),
    })
}

/// Prints to standard error, if there is anything to say.
pub(super) fn tell(text: &str) {
    print(&harmless(text));
}

/// Prints faults to standard error, with colour where somebody sees it. What they quote is harmless already.
fn tell_faults(faults: &Faults) {
    if io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none() {
        print(&faults.coloured());
    } else {
        tell(&faults.to_string());
    }
}

fn print(text: &str) {
    if !text.is_empty() {
        // Nothing is left to do if standard error is gone as well.
        let _ = writeln!(io::stderr(), "{}", text.trim_end());
    }
}

/// A path, or another text that is not ours, as it may stand in a line on a terminal: it cannot end the line.
pub(super) fn shown(text: impl AsRef<OsStr>) -> String {
    escaped(&text.as_ref().to_string_lossy(), spec::misleads).into_owned()
}

/// `text` as it may go to a terminal: what would move its cursor, ring, or turn its text around is spelt out.
///
/// All text leaves through here, whatever it quotes. The spelling, `\u001b`, is JSON's, so that an object means the
/// same afterwards.
fn harmless(text: &str) -> Cow<'_, str> {
    escaped(text, |c| spec::misleads(c) && !matches!(c, '\n' | '\t'))
}

/// `text` with the characters that `bad` names spelt out; none of them is beyond U+FFFF.
fn escaped(text: &str, bad: impl Fn(char) -> bool + Copy) -> Cow<'_, str> {
    if !text.contains(bad) {
        return text.into();
    }
    let spelt = |c: char| if bad(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() };
    text.chars().map(spelt).collect::<String>().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foreign_text_is_harmless_on_a_terminal() {
        let hostile = "e\u{1b}]0;pwn\u{7}\u{1b}[2J\u{9b}31m\u{7f}\u{202e}gpj\u{2066}\r";
        assert_eq!(
            shown(hostile),
            "e\\u001b]0;pwn\\u0007\\u001b[2J\\u009b31m\\u007f\\u202egpj\\u2066\\u000d"
        );
        assert_eq!(shown("a\nproven, no findings"), "a\\u000aproven, no findings");
        assert_eq!(harmless("two\n\tlines, é 星"), "two\n\tlines, é 星");
    }

    #[test]
    fn an_object_means_the_same_afterwards() {
        let object = serde_json::json!({ "found": "a\u{202e}\u{9b}\u{1b}\n\\b" });
        let text = harmless(&object.to_string()).into_owned();
        assert!(!text.contains(spec::misleads), "{text}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), object);
    }
}
