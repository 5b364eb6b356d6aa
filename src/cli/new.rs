//! `stargrip-cam new`

use std::path::PathBuf;

use crate::cli::failure::{Failure, say};
use crate::cli::harmless::shown;
use crate::cli::new_object::{ObjectArgs, chosen};
use crate::cli::text_file::write_new;
use crate::cli::{defaults, schema};
use crate::spec;

/// Arguments of `new`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// What to call the design; the file is called like it.
    #[arg(default_value = "star")]
    name: String,
    #[command(flatten)]
    object: ObjectArgs,
}

/// Writes a starter spec into the current directory; never over a file that is there.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let name = args.name.strip_suffix(".toml").unwrap_or(&args.name);
    let starter = || spec::starter(name).map_err(|fault| Failure::Message(fault.to_string()));
    let (text, said) = match chosen(name, &args.object)? {
        // One's own defaults were part of the search.
        Some((text, said)) => (format!("#:schema ./{}\n{text}", spec::SCHEMA_FILE), said),
        None => (defaults::written_into(starter()?)?, String::new()),
    };
    let path = PathBuf::from(format!("{}.toml", file_stem(&args.name)));
    write_new(&path, &text)?;
    schema::write_beside(&path)?;
    let path = shown(&path);
    say(&format!("{said}wrote {path}\nnext: edit it, then `stargrip-cam build {path}`\n"))
}

/// The name as a file name anywhere: ASCII letters, digits and dashes.
pub(super) fn file_stem(name: &str) -> String {
    // Who names the file means the design.
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let mut stem = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() {
            stem.push(c.to_ascii_lowercase());
        } else if !stem.is_empty() && !stem.ends_with('-') {
            stem.push('-');
        }
    }
    let stem = stem.trim_end_matches('-');
    if stem.is_empty() { "star".to_owned() } else { stem.to_owned() }
}
