//! Pictures of pixels.

use crate::verify::read::png::read_png;
use crate::verify::{FindingCode, Findings};

/// Reads a PNG.
pub(in crate::verify) fn check(bytes: &[u8], findings: &mut Findings) {
    if read_png(bytes).is_none() {
        let found = format!("{} bytes that are no such picture", bytes.len());
        findings.add(FindingCode::BadPng, None, found, "pixels of three colours, 8 bits each");
    }
}
