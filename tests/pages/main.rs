//! README and docs/ against the program: commands run and print what is shown below
//! them, pictures are what the commands draw, references are what the reader takes, and links lead somewhere.
//!
//! `INSTA_UPDATE=always cargo test --test pages` writes references and pictures anew.

mod book;
mod codes;
#[cfg(unix)]
mod commands;
mod page;
mod reference;
#[cfg(unix)]
mod said;
mod trade;

use std::path::{Path, PathBuf};

/// Where the sources are.
fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// Whether what is generated is to be written anew.
fn renews() -> bool {
    std::env::var("INSTA_UPDATE").is_ok_and(|word| word == "always")
}
