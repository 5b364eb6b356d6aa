//! Failures of commands, and their output.

use std::io;
use std::io::Write;
use std::path::Path;

use serde_json::{Value, json};

use crate::answer::refused::{finding_json, refusal, refused_by};
use crate::cli::escape::{escaped, escaped_line};
use crate::cli::findings::Unproven;
use crate::cli::terminal::{fitted, has_colours, width};
use crate::cli::{PublishFault, interrupt};
use crate::pipeline::CommandCode;
use spec::{Code, Faults, NewSpec};

/// The reason why a command failed, or did only a part of its work.
#[derive(Debug)]
pub enum Failure {
    /// The spec, the profile or the design is refused.
    Faults(Faults),
    /// Files that were just made do not agree with the design.
    Unproven(Unproven),
    /// The build could not be published.
    Publish(PublishFault),
    /// No gripper meets the request: the reasons, and other requests with what is to be expected of them.
    Infeasible(String, Vec<String>),
    /// A file that cannot be read or written: its path, and the sentence.
    File(String, String),
    /// Any other failure, in one sentence.
    Message(String),
    /// Arguments that exclude each other.
    Usage(String),
    /// Ctrl-C.
    Interrupted,
    /// Ctrl-C or SIGTERM, with the state of the work.
    Stopped(String),
    /// The failure has been printed already, on standard output.
    Reported,
    /// Another version wrote the directory, and its files agree with the design as far as they can be read; printed on standard output.
    NotCompared,
    /// The reader of standard output has closed it; no further output is possible.
    Pipe,
}

impl Failure {
    /// A failure whose sentence is the text of `fault`.
    #[expect(clippy::needless_pass_by_value, reason = "so it fits `map_err`")]
    pub(super) fn message(fault: impl ToString) -> Self {
        Self::Message(fault.to_string())
    }

    /// A file that could not be read or written.
    pub(super) fn file(operation: &str, path: &Path, error: &io::Error) -> Self {
        Self::File(
            path.display().to_string(),
            format!("cannot {operation} {}: {}", escaped_line(path), reason(operation, error)),
        )
    }

    /// Prints the failure with --json: a refusal is one object on standard output. Returns the exit code of [`Failure::report`].
    pub(super) fn report_json(self) -> u8 {
        let Some(refused) = self.refused() else { return self.report() };
        say(&format!("{:#}\n", json!({ "refused": refused }))).map_or_else(Self::report, |()| 1)
    }

    /// The refusals, one object each; `None` if the failure is no refusal, or has been printed already.
    pub(super) fn refused(&self) -> Option<Vec<Value>> {
        let object = match self {
            Self::Faults(faults) => return Some(refused_by(faults)),
            Self::Unproven(unproven) => return Some(unproven.findings.iter().map(finding_json).collect()),
            Self::Publish(error) => refusal(CommandCode::NotPublished.as_str(), &error.to_string()),
            Self::Infeasible(text, nearest) => {
                let mut object = refusal(CommandCode::Infeasible.as_str(), text);
                object["remedy"] = json!((!nearest.is_empty()).then(|| nearest.join("\n")));
                object
            }
            Self::File(path, text) => {
                let mut object = refusal(CommandCode::Failed.as_str(), text);
                object["file"] = json!(path);
                object
            }
            Self::Message(text) => refusal(CommandCode::Failed.as_str(), text),
            _ => return None,
        };
        Some(vec![object])
    }

    /// Prints a JSON `answer` that contains the refusal `text`, as one object.
    pub(super) fn answered(mut answer: Value, text: &str) -> Self {
        answer["refused"] = json!([refusal(CommandCode::Failed.as_str(), text)]);
        say(&format!("{answer:#}\n")).err().unwrap_or(Self::Reported)
    }

    /// Prints the failure to standard error, and returns the exit code.
    pub(super) fn report(self) -> u8 {
        // The exit codes are those of docs/terminal.md: 1 for a refusal, 2 for a wrong command line, 3 for nothing
        // compared, and the shell's own codes for signals. A closed pipe is no failure.
        let text = match self {
            Self::Faults(faults) => {
                warn(&faults);
                return 1;
            }
            Self::Unproven(unproven) => {
                tell_under(&unproven.heading(), &fitted(&unproven.text(), width(&io::stderr())));
                return 1;
            }
            Self::Publish(error) => format!("error: {error}"),
            Self::Infeasible(text, nearest) => {
                let parts: Vec<String> = [text].into_iter().chain(nearest).collect();
                format!("error: {}", parts.join("\n"))
            }
            Self::File(_, text) | Self::Message(text) => {
                format!("error: {text}")
            }
            Self::Usage(text) => {
                tell(&fitted(&format!("error: {text}"), width(&io::stderr())));
                return 2;
            }
            Self::Interrupted => {
                tell("stopped; nothing was written");
                return interrupt::EXIT;
            }
            Self::Stopped(text) => {
                tell(&text);
                return 130;
            }
            Self::Reported => return 1,
            Self::NotCompared => return 3,
            Self::Pipe => return 0,
        };
        tell(&fitted(&text, width(&io::stderr())));
        1
    }
}

/// The reason why a file cannot be read, written or created (`operation`), with a remedy where there is one.
pub(super) fn reason(operation: &str, error: &io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or_default();
    match (error.kind(), operation) {
        (io::ErrorKind::NotFound, "read") => "it does not exist; check its name and its directory".to_owned(),
        (io::ErrorKind::NotFound, _) => "its directory does not exist; create it, or name another".to_owned(),
        (io::ErrorKind::IsADirectory, _) => "it is a directory; name a file".to_owned(),
        (io::ErrorKind::PermissionDenied, _) => {
            "permission denied; change its rights, or name another".to_owned()
        }
        _ => text.to_owned(),
    }
}

impl From<Faults> for Failure {
    fn from(faults: Faults) -> Self {
        Self::Faults(faults.offer(new_command))
    }
}

/// The command that writes a new spec.
fn new_command(new_spec: NewSpec) -> &'static str {
    match new_spec {
        NewSpec::Starter => "`stargrip-cam new` writes a whole spec to begin with",
        NewSpec::FromDrawing => "`stargrip-cam new --drawing FILE` writes a spec from a drawing",
    }
}

impl From<PublishFault> for Failure {
    fn from(error: PublishFault) -> Self {
        Self::Publish(error)
    }
}

/// Prints to standard output; a closed pipe ends the command silently, as in other filters.
pub(super) fn say(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    let result = stdout.write_all(escaped(text).as_bytes()).and_then(|()| stdout.flush());
    result.map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::Pipe,
        _ => Failure::Message(format!("cannot write to standard output: {error}")),
    })
}

/// Prints to standard error; an empty text prints nothing.
pub(super) fn tell(text: &str) {
    print(&escaped(text));
}

/// Prints to standard error under a heading, which is coloured on a terminal with colours.
pub(super) fn tell_under(heading: &str, text: &str) {
    let heading = if has_colours(&io::stderr()) {
        format!("\u{1b}[1;33m{heading}\u{1b}[0m")
    } else {
        heading.to_owned()
    };
    print(&format!("{heading}\n{}", escaped(text)));
}

/// Prints faults to standard error, with colours on a terminal. Quoted text is escaped already.
pub(super) fn warn(faults: &Faults) {
    if faults.is_empty() {
        return;
    }
    let stream = io::stderr();
    let text = faults.for_terminal(width(&stream), has_colours(&stream));
    // Colours are the program's own control sequences, so they are not escaped.
    if has_colours(&stream) { print(&text) } else { tell(&text) }
}

fn print(text: &str) {
    if !text.is_empty() {
        // A closed standard error leaves no place for a message.
        let _ = writeln!(io::stderr(), "{}", text.trim_end());
    }
}
