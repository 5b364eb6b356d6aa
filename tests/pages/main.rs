//! README and docs/ against the program: commands run and print the shown output, pictures equal the commands' files, references list the
//! reader's keys, and links lead to a page.
//!
//! `INSTA_UPDATE=always cargo test --test pages` renews references and pictures.

mod book;
mod codes;
#[cfg(unix)]
mod commands;
#[cfg(unix)]
mod figures;
mod form;
mod lists;
#[cfg(unix)]
mod output;
mod page;
mod reference;
mod trade;
#[path = "../support/zip.rs"]
mod zip;

use std::path::{Path, PathBuf};

/// The directory of the sources.
fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// Whether generated files are renewed.
fn renews() -> bool {
    std::env::var("INSTA_UPDATE").is_ok_and(|word| word == "always")
}
