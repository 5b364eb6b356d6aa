//! Checksums as text: SHA-256 detects damaged files and identifies questions, MD5 is what packages for printers carry.

use std::fmt::Write;

use md5::Md5;
use sha2::{Digest, Sha256};

/// SHA-256 of `bytes` in lower-case hexadecimal, 64 digits.
pub fn sha256(bytes: impl AsRef<[u8]>) -> String {
    let mut running = Running::default();
    running.update(bytes);
    running.finish()
}

/// MD5 of `bytes` (RFC 1321) in upper-case hexadecimal, 32 digits: it detects damage, and is no protection against forgery.
pub fn md5(bytes: impl AsRef<[u8]>) -> String {
    Md5::digest(bytes).iter().fold(String::with_capacity(32), |mut text, byte| {
        // Writing to a String does not fail.
        let _ = write!(text, "{byte:02X}");
        text
    })
}

/// SHA-256 of `parts`, each after its length, so that "ab", "c" differs from "a", "bc".
pub fn of_parts(parts: impl IntoIterator<Item = impl AsRef<[u8]>>) -> String {
    let mut running = Running::default();
    for part in parts {
        running.update(part.as_ref().len().to_le_bytes());
        running.update(part);
    }
    running.finish()
}

/// Incremental SHA-256.
#[derive(Clone, Debug, Default)]
pub struct Running(Sha256);

impl Running {
    /// Adds bytes to the hash.
    pub fn update(&mut self, bytes: impl AsRef<[u8]>) {
        self.0.update(bytes);
    }

    /// The hash of all bytes, in lower-case hexadecimal.
    pub fn finish(self) -> String {
        self.0.finalize().iter().fold(String::with_capacity(64), |mut text, byte| {
            // Writing to a String does not fail.
            let _ = write!(text, "{byte:02x}");
            text
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-4 has the first; `sha256sum </dev/null` prints the second.
    #[test]
    fn hashes_are_those_of_the_standard() {
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256("abc"), abc);
        let mut running = Running::default();
        running.update("a");
        running.update("bc");
        assert_eq!(running.finish(), abc);
        assert_eq!(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    }

    /// RFC 1321, A.5, has both.
    #[test]
    fn an_md5_is_that_of_its_standard() {
        assert_eq!(md5(""), "D41D8CD98F00B204E9800998ECF8427E");
        assert_eq!(md5("message digest"), "F96B697D7CB7938D525A2F31AAF161D0");
    }

    #[test]
    fn where_a_part_ends_counts() {
        assert_ne!(of_parts(["ab", "c"]), of_parts(["a", "bc"]));
        assert_ne!(of_parts(["abc"]), of_parts(["abc", ""]));
    }
}
