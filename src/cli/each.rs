//! One command for several specs: each has its answer or its faults, and one that is refused does not keep the others from theirs.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::cli::failure::{Failure, say};
use crate::cli::voice::{Voice, pretty};

/// Does `one` for each of `specs`; of what programs are told, prints one object.
pub(super) fn each(
    specs: &[PathBuf],
    voice: Voice,
    mut one: impl FnMut(&Path) -> Result<Option<Value>, Failure>,
) -> Result<(), Failure> {
    if let [spec] = specs {
        let said = one(spec)?;
        return said.map_or(Ok(()), |said| say(&pretty(&said)));
    }
    let (mut all, mut refused) = (Vec::new(), false);
    for (number, spec) in specs.iter().enumerate() {
        if number > 0 && !voice.quiet && !voice.json {
            say("\n")?;
        }
        match one(spec) {
            Ok(said) => all.extend(said),
            Err(Failure::Pipe) => return Err(Failure::Pipe),
            Err(failure) => {
                refused = true;
                let _ = failure.report();
            }
        }
    }
    if voice.json {
        say(&pretty(&serde_json::json!({ "results": all })))?;
    }
    if refused { Err(Failure::Said) } else { Ok(()) }
}
