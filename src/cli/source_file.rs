//! The text of a spec or a profile, from a file or from standard input.

use std::path::Path;

use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::whole_file::{given_bytes, is_standard_input};
use spec::{SIZE_LIMIT, Source};

/// The spec's name in a published directory.
pub(super) const SPEC: &str = "spec.toml";

/// Reads a text file, or standard input for "-", up to the size limit of a spec.
pub(super) fn read_source(path: &Path) -> Result<Source, Failure> {
    let is_file = !is_standard_input(path);
    if is_file && path.is_dir() {
        return Err(Failure::File(path.display().to_string(), is_directory(path)));
    }
    let bytes = given_bytes(path, SIZE_LIMIT as u64 + 1).map_err(|error| {
        if is_file {
            Failure::file("read", path, &error)
        } else {
            Failure::Message(format!("cannot read standard input: {error}"))
        }
    })?;
    let name = if is_file { path.display().to_string() } else { "standard input".to_owned() };
    Ok(Source::from_bytes(name, &bytes)?)
}

/// A message that `path` is a directory, with the spec in it that may be meant.
fn is_directory(path: &Path) -> String {
    let (dir, spec) = (escaped_line(path), path.join(SPEC));
    if spec.is_file() {
        format!("{dir} is a directory: name the spec in it, {}", escaped_line(spec))
    } else {
        format!("{dir} is a directory, and there is no {SPEC} in it: name a spec")
    }
}
