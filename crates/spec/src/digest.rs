//! Checksums as text: SHA-256 detects damaged files and identifies questions, MD5 is what packages for printers carry.

use std::fmt::Write;

use sha2::{Digest, Sha256};

/// SHA-256 of `bytes` in lower-case hexadecimal, 64 digits.
pub fn sha256(bytes: impl AsRef<[u8]>) -> String {
    let mut running = Running::default();
    running.update(bytes);
    running.finish()
}

/// MD5 of `bytes` (RFC 1321) in upper-case hexadecimal, 32 digits: it detects damage, and is no protection against forgery.
///
/// It is short rather than fast: a package has a single program, and the unrolled rounds of a crate make a web page larger.
pub fn md5(bytes: impl AsRef<[u8]>) -> String {
    let bytes = bytes.as_ref();
    // A bit 1, zeros, and the number of bits fill the last block.
    let mut message = bytes.to_vec();
    message.push(0x80);
    message.resize((message.len() + 8).next_multiple_of(BLOCK) - 8, 0);
    message.extend((bytes.len() as u64).wrapping_mul(8).to_le_bytes());
    let start = [0x6745_2301, 0xefcd_ab89, 0x98ba_dcfe, 0x1032_5476];
    let state = message.chunks_exact(BLOCK).fold(start, md5_of_block);
    hexadecimal(state.iter().flat_map(|word| word.to_le_bytes())).to_uppercase()
}

/// Two digits a byte, in lower case.
fn hexadecimal(bytes: impl IntoIterator<Item = u8>) -> String {
    bytes.into_iter().fold(String::new(), |mut text, byte| {
        // Writing to a String does not fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// Length of a block of MD5, bytes.
const BLOCK: usize = 64;
/// Rotations of the steps of each round of MD5, in turn.
const ROTATIONS: [[u32; 4]; 4] = [[7, 12, 17, 22], [5, 9, 14, 20], [4, 11, 16, 23], [6, 10, 15, 21]];

/// The state of MD5 after `block` (RFC 1321, 3.4): four rounds of 16 steps, each with a function, an order of words and rotations of its
/// own.
fn md5_of_block(state: [u32; 4], block: &[u8]) -> [u32; 4] {
    let words: Vec<u32> = block.chunks_exact(4).map(little_endian).collect();
    let [mut a, mut b, mut c, mut d] = state;
    for step in 0..64 {
        let round = step / 16;
        let (mixed, index) = match round {
            0 => ((b & c) | (!b & d), step),
            1 => ((d & b) | (!d & c), 5 * step + 1),
            2 => (b ^ c ^ d, 3 * step + 5),
            _ => (c ^ (b | !d), 7 * step),
        };
        let sum = a.wrapping_add(mixed).wrapping_add(sine_word(step)).wrapping_add(words[index % 16]);
        (a, d, c) = (d, c, b);
        b = b.wrapping_add(sum.rotate_left(ROTATIONS[round][step % 4]));
    }
    let [p, q, r, s] = state;
    [p.wrapping_add(a), q.wrapping_add(b), r.wrapping_add(c), s.wrapping_add(d)]
}

/// The number in four bytes, the lowest first.
fn little_endian(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte))
}

/// The constant of a step of MD5: the whole part of 2^32 |sin(step + 1)|. No sine comes so near to a whole part that its last digits matter:
/// a test compares the digests.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "below 2^32"
)]
fn sine_word(step: usize) -> u32 {
    (libm::sin((step + 1) as f64).abs() * 4_294_967_296.0) as u32
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
        hexadecimal(self.0.finalize())
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

    /// RFC 1321, A.5, has the first three; `printf %0128d 0 | md5sum` and the like print the others, which end beside a block's end.
    #[test]
    fn an_md5_is_that_of_its_standard() {
        assert_eq!(md5(""), "D41D8CD98F00B204E9800998ECF8427E");
        assert_eq!(md5("message digest"), "F96B697D7CB7938D525A2F31AAF161D0");
        let digits = "1234567890".repeat(8);
        assert_eq!(md5(digits), "57EDF4A22BE3C955AC49DA2E2107B67A");
        for (length, digest) in ZEROS {
            assert_eq!(md5("0".repeat(length)), digest, "{length}");
        }
    }

    const ZEROS: [(usize, &str); 5] = [
        (55, "D7FE636BD28E2EE2BA4D6C5898318699"),
        (56, "CE992C2AD906967C63C3F9AB0C2294A9"),
        (63, "5703DB92ACB9D45E3975822C9206453F"),
        (64, "10EAB6008D5642CF42ABD2AA41F847CB"),
        (128, "AA70AAF67B3BAB5029B76CEE92E18AFE"),
    ];

    #[test]
    fn where_a_part_ends_counts() {
        assert_ne!(of_parts(["ab", "c"]), of_parts(["a", "bc"]));
        assert_ne!(of_parts(["abc"]), of_parts(["abc", ""]));
    }
}
