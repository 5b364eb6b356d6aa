//! Shells by which the predictions of `stargrip-cam` are fitted and judged: which are computed, what was found, and the tables made
//! of them. The program itself depends on none of this.

use sha2::{Digest, Sha256};
use std::fmt::Write;

pub mod ladders;
pub mod stars;
pub mod validation;

/// The SHA-256 of `text`, in hexadecimal.
fn sha256(text: impl AsRef<[u8]>) -> String {
    let mut out = String::new();
    for byte in Sha256::digest(text) {
        // A String takes everything.
        let _ = write!(out, "{byte:02x}");
    }
    out
}
