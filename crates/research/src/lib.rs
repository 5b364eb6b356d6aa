//! Shells that fit and validate the predictions of `stargrip-cam`: the selection, the results, and the tables made
//! of them. The program itself does not depend on this crate.

use sha2::{Digest, Sha256};
use std::fmt::Write;

pub mod ladders;
pub mod residuals;
pub mod stars;
pub mod validation;

/// The SHA-256 of `text`, in hexadecimal.
fn sha256(text: impl AsRef<[u8]>) -> String {
    let mut out = String::new();
    for byte in Sha256::digest(text) {
        // Writing to a String never fails.
        let _ = write!(out, "{byte:02x}");
    }
    out
}
