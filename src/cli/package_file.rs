//! The package of a single program, beside it: for a machine that takes packages.

use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::whole_file::write_whole;
use crate::pipeline::PACKAGE_ENDING;
use std::path::{Path, PathBuf};

/// A package that a command writes beside its program.
pub(super) struct PackageFile<'b> {
    pub(super) path: PathBuf,
    bytes: &'b [u8],
}

impl<'b> PackageFile<'b> {
    /// The package `bytes` of the program that is written to `program`.
    pub(super) fn new(program: &Path, bytes: &'b [u8]) -> Self {
        Self { path: package_path(program), bytes }
    }

    /// Writes it.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub(super) fn write(&self) -> Result<(), Failure> {
        write_whole(&self.path, self.bytes).map_err(|error| Failure::file("write", &self.path, &error))
    }

    /// How a command names it behind the program that it wrote.
    pub(super) fn in_words(&self) -> String {
        format!(" and in a package {}", escaped_line(self.path.file_name().unwrap_or_default()))
    }
}

/// The package beside the program `program`.
pub(super) fn package_path(program: &Path) -> PathBuf {
    let mut name = program.file_name().unwrap_or_default().to_owned();
    name.push(PACKAGE_ENDING);
    program.with_file_name(name)
}
