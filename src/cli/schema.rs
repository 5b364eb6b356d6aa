//! `stargrip-cam schema`

use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, say};
use crate::cli::text_file::write_new;
use crate::cli::verbosity::Quiet;

/// Arguments of `schema`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// Print the schema of a machine profile instead.
    #[arg(long)]
    machine: bool,
    /// Has no effect: only the result is printed.
    #[command(flatten)]
    _quiet: Quiet,
}

/// Prints the JSON Schema of a spec, or of a machine profile.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    say(&if args.machine { spec::machine_schema() } else { spec::schema() })
}

/// Writes the schema beside the spec at `path`, whose first line names it; an existing file is kept. Returns its path.
pub(super) fn write_beside(path: &Path) -> Result<PathBuf, Failure> {
    let file = path.with_file_name(spec::SCHEMA_FILE);
    if !file.exists() {
        write_new(&file, &spec::schema())?;
    }
    Ok(file)
}
