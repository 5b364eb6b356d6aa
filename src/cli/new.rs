//! `stargrip-cam new`

use std::path::PathBuf;

use serde_json::json;

use crate::cli::failure::Failure;
use crate::cli::harmless::shown;
use crate::cli::new_object::{ObjectArgs, chosen};
use crate::cli::text_file::write_new;
use crate::cli::voice::Voice;
use crate::cli::{defaults, progress, schema};
use crate::forecast::verdict::Verdict;
use crate::spec;

/// Arguments of `new`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// What to call the design; the file is called like it.
    #[arg(default_value = "star")]
    name: String,
    #[command(flatten)]
    object: ObjectArgs,
    #[command(flatten)]
    voice: Voice,
}

/// Writes a starter spec into the current directory; never over a file that is there.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let name = args.name.strip_suffix(".toml").unwrap_or(&args.name);
    let starter = || spec::starter(name).map_err(|fault| Failure::Message(fault.to_string()));
    let found = progress::during(args.voice, "searching for a gripper", |_| chosen(name, &args.object))?;
    let (text, verdict) = match found {
        // One's own defaults were part of the search.
        Some((text, verdict)) => (format!("#:schema ./{}\n{text}", spec::SCHEMA_FILE), verdict),
        None => (defaults::written_into(starter()?)?, None),
    };
    let path = PathBuf::from(format!("{}.toml", file_stem(&args.name)));
    write_new(&path, &text)?;
    let schema = schema::write_beside(&path)?;
    let json = json!({ "wrote": path, "schema": schema, "verdict": verdict });
    let path = shown(&path);
    let said = verdict.map_or_else(String::new, |verdict| said(name, &verdict));
    args.voice
        .report(&format!("{said}wrote {path}\nnext: edit it, then `stargrip-cam build {path}`\n"), &json)
}

fn said(name: &str, verdict: &Verdict) -> String {
    let more = verdict.one_star().into_iter().chain(verdict.assumed_in_words());
    let reasons = verdict.reasons.iter().cloned().chain(more).map(|reason| format!("  {reason}\n"));
    format!("{name}: {}\n{}", verdict.line(), reasons.collect::<String>())
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
