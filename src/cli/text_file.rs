//! Programs, tables and specs as text files: read up to a limit, and written only as new files or atomically.

use std::fs::{self, File};
use std::io;
use std::io::Write;
use std::path::Path;

use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::whole_file::{first_bytes, given_bytes, refuse_special, write_whole};

/// Largest program, bytes: far more than the largest design needs.
pub(super) const PROGRAM: u64 = 1 << 28;

/// Largest table, bytes: hours of a test at a thousand rows a minute, and small enough to be held in memory.
pub(super) const TABLE: u64 = 1 << 24;

/// Reads a text of at most `limit` bytes given to a command, or standard input for "-".
pub(super) fn read_text(path: &Path, limit: u64) -> Result<String, Failure> {
    if path.is_dir() {
        return Err(Failure::File(
            path.display().to_string(),
            format!("{} is a directory: name a file in it", escaped_line(path)),
        ));
    }
    let bytes = given_bytes(path, limit + 1).map_err(|error| Failure::file("read", path, &error))?;
    if bytes.len() as u64 > limit {
        let mebibytes = limit >> 20;
        let allowed = format!("at most {mebibytes} MiB are read; name another file");
        return Err(Failure::Message(format!("{} is too large: {allowed}", escaped_line(path))));
    }
    String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        Failure::Message(format!(
            "{}: byte {offset} is not UTF-8: save the file as UTF-8",
            escaped_line(path)
        ))
    })
}

/// Writes a new file; an existing one is an error. A file that cannot be written whole is removed.
pub(super) fn write_new(path: &Path, text: &str) -> Result<(), Failure> {
    let result = File::create_new(path).and_then(|mut file| {
        file.write_all(text.as_bytes()).inspect_err(|_| {
            let _ = fs::remove_file(path);
        })
    });
    result.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => {
            Failure::Message(format!("{} exists already; choose another name", escaped_line(path)))
        }
        _ => Failure::file("write", path, &error),
    })
}

/// Bytes at the beginning of a file, in which its kind shows.
const BEGINNING: u64 = 4096;

/// Refuses to write to `path` if it is a pipe, a socket or a device; or a file, not empty, and not `description` by its beginning: a typing error
/// must not cost an input.
pub(super) fn refuse_foreign(
    path: &Path,
    description: &str,
    is_own: impl FnOnce(&str) -> bool,
) -> Result<(), Failure> {
    refuse_special(path).map_err(|error| Failure::file("write", path, &error))?;
    if !path.is_file() {
        return Ok(());
    }
    let start = first_bytes(path, BEGINNING).map_err(|error| Failure::file("read", path, &error))?;
    if start.is_empty() || is_own(&String::from_utf8_lossy(&start)) {
        return Ok(());
    }
    Err(Failure::Message(format!(
        "{} exists and is not {description}: name another file",
        escaped_line(path)
    )))
}

/// Writes or replaces a text file atomically.
pub(super) fn replace(path: &Path, text: &str) -> Result<(), Failure> {
    replace_bytes(path, text.as_bytes())
}

/// Writes or replaces a file atomically.
pub(super) fn replace_bytes(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_whole(path, bytes).map_err(|error| Failure::file("write", path, &error))
}
