//! How a command fails, and what it prints then.

use std::io;
use std::io::Write;
use std::path::Path;

use serde_json::{Value, json};

use crate::answer::refused::{finding_json, refusal, refused_by};
use crate::cli::escape::{escaped, shown};
use crate::cli::terminal::{fitted, has_colours, width};
use crate::cli::unproven::Unproven;
use crate::cli::{PublishFault, interrupt};
use crate::pipeline::CommandCode;
use crate::spec::{Code, Faults};

/// Why a command did not do what it was asked for, or only a part of it.
#[derive(Debug)]
pub enum Failure {
    /// The spec, the profile or the design is refused.
    Faults(Faults),
    /// Files that were just made do not say what the design says.
    Unproven(Unproven),
    /// Nothing could be published.
    Publish(PublishFault),
    /// No gripper does what is asked: why, and what comes nearest.
    Infeasible(String),
    /// Anything else, in one sentence.
    Message(String),
    /// Arguments that do not go together.
    Usage(String),
    /// Ctrl-C.
    Interrupted,
    /// Ctrl-C, or what a cluster sends before it kills, with what is left.
    Stopped(String),
    /// It has been said already, on standard output.
    Said,
    /// Another version wrote the directory, whose files are right as far as reading shows; said on standard output.
    NotCompared,
    /// The reader of our standard output has gone; there is nobody left to tell.
    Pipe,
}

impl Failure {
    /// A file that could not be read or written.
    pub(super) fn file(what: &str, path: &Path, error: &io::Error) -> Self {
        Self::Message(format!("cannot {what} {}: {error}", shown(path)))
    }

    /// The same for whoever reads JSON: one object on standard output if the answer is a refusal. Its exit code is that of
    /// [`Failure::report`].
    pub(super) fn report_json(self) -> u8 {
        match self.refused() {
            Some(refused) => match say(&format!("{:#}\n", json!({ "refused": refused }))) {
                Ok(()) => 1,
                Err(failure) => failure.report(),
            },
            None => self.report(),
        }
    }

    /// What is refused, one object each; `None` if this is not a refusal, or has been printed already.
    pub(super) fn refused(&self) -> Option<Vec<Value>> {
        let bare = |code: CommandCode, found: &str| vec![refusal(code.as_str(), found)];
        match self {
            Self::Faults(faults) => Some(refused_by(faults)),
            Self::Unproven(unproven) => Some(unproven.findings.iter().map(finding_json).collect()),
            Self::Publish(error) => Some(bare(CommandCode::NotPublished, &error.to_string())),
            Self::Infeasible(text) => Some(bare(CommandCode::Infeasible, text)),
            Self::Message(text) => Some(bare(CommandCode::Failed, text)),
            Self::Usage(_)
            | Self::Interrupted
            | Self::Stopped(_)
            | Self::Said
            | Self::NotCompared
            | Self::Pipe => None,
        }
    }

    /// A refusal for `text` beside an answer for programs, which is printed with it as one object.
    pub(super) fn answered(mut answer: Value, text: &str) -> Self {
        answer["refused"] = json!([refusal(CommandCode::Failed.as_str(), text)]);
        say(&format!("{answer:#}\n")).err().unwrap_or(Self::Said)
    }

    /// Prints it to standard error, and says with which code the process shall end.
    pub(super) fn report(self) -> u8 {
        let text = match self {
            Self::Faults(faults) => {
                tell_faults(&faults);
                return 1;
            }
            Self::Unproven(unproven) => {
                tell_under(&unproven.heading(), &fitted(&unproven.text(), width(&io::stderr())));
                return 1;
            }
            Self::Publish(error) => format!("error: {error}"),
            Self::Infeasible(text) | Self::Message(text) => format!("error: {text}"),
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
            Self::Said => return 1,
            Self::NotCompared => return 3,
            Self::Pipe => return 0,
        };
        tell(&fitted(&text, width(&io::stderr())));
        1
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
    let written = out.write_all(escaped(text).as_bytes()).and_then(|()| out.flush());
    written.map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::Pipe,
        _ => Failure::Message(format!("cannot write to standard output: {error}")),
    })
}

/// Prints to standard error, if there is anything to say.
pub(super) fn tell(text: &str) {
    print(&escaped(text));
}

/// Prints to standard error under a heading that stands out where there are colours.
pub(super) fn tell_under(heading: &str, text: &str) {
    let heading = if has_colours(&io::stderr()) {
        format!("\u{1b}[1;33m{heading}\u{1b}[0m")
    } else {
        heading.to_owned()
    };
    print(&format!("{heading}\n{}", escaped(text)));
}

/// Prints faults to standard error, with colour where somebody sees it. What they quote is harmless already.
fn tell_faults(faults: &Faults) {
    let stream = io::stderr();
    let text = faults.for_terminal(width(&stream), has_colours(&stream));
    // Colours are commands to the terminal, and are ours.
    if has_colours(&stream) { print(&text) } else { tell(&text) }
}

fn print(text: &str) {
    if !text.is_empty() {
        // Nothing is left to do if standard error is gone as well.
        let _ = writeln!(io::stderr(), "{}", text.trim_end());
    }
}
