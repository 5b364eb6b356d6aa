//! Runs one command for several specs: each has its own answer or faults, and a refused spec does not stop the others.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::cli::failure::{Failure, say};
use crate::cli::verbosity::{Verbosity, pretty};

/// Calls `answer_one` for each of `specs`; prints their JSON answers as one object.
pub(super) fn run(
    specs: &[PathBuf],
    verbosity: Verbosity,
    mut answer_one: impl FnMut(&Path) -> Result<Option<Value>, Failure>,
) -> Result<(), Failure> {
    // A single spec keeps the answer and the exit code of its own. Of several specs every one is answered, and a
    // failure does not stop the others. In JSON all answers and refusals form one object, so that a program reads it
    // whole.
    if let [spec] = specs {
        let answer = answer_one(spec)?;
        return answer.map_or(Ok(()), |answer| say(&pretty(&answer)));
    }
    let (mut answers, mut failed, mut refused) = (Vec::new(), false, Vec::new());
    for (number, spec) in specs.iter().enumerate() {
        if number > 0 && !verbosity.quiet && !verbosity.json {
            say("\n")?;
        }
        match answer_one(spec) {
            Ok(answer) => answers.extend(answer),
            Err(Failure::Pipe) => return Err(Failure::Pipe),
            Err(failure) => {
                failed = true;
                match failure.refused().filter(|_| verbosity.json) {
                    Some(reasons) => refused.extend(reasons),
                    None => {
                        let _ = failure.report();
                    }
                }
            }
        }
    }
    if verbosity.json {
        let mut answer = serde_json::json!({ "results": answers });
        if !refused.is_empty() {
            answer["refused"] = refused.into();
        }
        say(&pretty(&answer))?;
    }
    if failed { Err(Failure::Reported) } else { Ok(()) }
}
