//! Shells that fit and validate the predictions of `stargrip-cam`: the selection, the results, and the tables made
//! of them. The program itself does not depend on this crate.

use sha2::{Digest, Sha256};
use std::fmt::Write;

pub mod around;
pub mod cone;
pub mod inflations;
pub mod ladders;
pub mod predicted;
pub mod residuals;
pub mod stars;
pub mod validation;

/// The SHA-256 of `text`, in hexadecimal.
fn sha256(text: impl AsRef<[u8]>) -> String {
    let mut digits = String::new();
    for byte in Sha256::digest(text) {
        // Writing to a String never fails.
        let _ = write!(digits, "{byte:02x}");
    }
    digits
}

/// `text` with its checksum in a last line.
fn sealed(text: &str) -> String {
    format!("{text}{}\n", sha256(text))
}

/// The lines of a sealed text that are no comments; `None` if it is torn.
fn unsealed(text: &str) -> Option<impl Iterator<Item = &str>> {
    let (body, last) = text.trim_end().rsplit_once('\n')?;
    (sha256(format!("{body}\n")) == last).then(|| body.lines().filter(|line| !line.starts_with('#')))
}
