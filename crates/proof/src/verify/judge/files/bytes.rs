//! Compares the bytes of a directory with those that this version makes of its spec.
//!
//! This does not prove the writer (both have the same faults), but it finds differences that no reader checks: a comment, a
//! colour, a label, a figure of the manifest.

use crate::manifest::MANIFEST;
use crate::verify::finding::quote;
use crate::verify::judge::files::proof::{Method, Proof};
use crate::verify::{Finding, FindingCode, OutputFiles};

/// Names the first difference of the file `name` of `files` from `right`, made anew; if it is equal, it is proven by that, and
/// its hash is returned if it was taken.
pub fn compare_bytes(name: &str, right: &[u8], files: &OutputFiles<'_>, proof: &mut Proof) -> Option<String> {
    // A missing file is a finding of its own.
    let bytes = files.get(name)?;
    if bytes == right {
        return mark_equal(name, right, files, proof);
    }
    // The manifest's hashes differ with the files, which have been named.
    if !(name == MANIFEST && proof.findings.iter().any(|finding| finding.file != MANIFEST)) {
        proof.findings.push(first_difference(bytes, right).in_file(name));
    }
    None
}

/// Marks the file `name` of `files` as proven by its bytes if they are equal to `right`, made anew; its hash then, if it was
/// taken.
pub fn mark_equal(name: &str, right: &[u8], files: &OutputFiles<'_>, proof: &mut Proof) -> Option<String> {
    let _ = files.get(name).filter(|bytes| *bytes == right)?;
    let file = proof.files.iter_mut().find(|file| file.path == name)?;
    // Spec, profile and drawing are the sources of all other files: they are not made anew.
    if !file.output.kind.is_source() {
        file.by = Method::Bytes;
    }
    Some(file.sha256.clone())
}

/// The first difference of `actual` from `right`.
pub fn first_difference(actual: &[u8], right: &[u8]) -> Finding {
    let place = actual.iter().zip(right).take_while(|(a, b)| a == b).count();
    let is_text = [actual, right].iter().all(|bytes| std::str::from_utf8(bytes).is_ok());
    if !right.contains(&b'\r') && actual.iter().filter(|byte| **byte != b'\r').eq(right) {
        return Finding::new(FindingCode::Differs, "carriage returns (CR)", "none: nothing else differs");
    }
    if !is_text {
        let fault = format!("{} at byte {place}", byte_text(actual, place));
        return Finding::new(FindingCode::Differs, fault, byte_text(right, place));
    }
    let line = actual[..place].split(|byte| *byte == b'\n').count();
    Finding::in_line(FindingCode::Differs, line, line_text(actual, place), line_text(right, place))
}

/// The byte at `place`, for a message.
fn byte_text(bytes: &[u8], place: usize) -> String {
    bytes.get(place).map_or("the end".to_owned(), |byte| format!("{byte:#04x}"))
}

/// The line around `place`, for a message. A long line is cut to the part from 30 bytes before `place` on.
fn line_text(bytes: &[u8], place: usize) -> String {
    if place >= bytes.len() {
        return "the end of the file".to_owned();
    }
    let start = bytes[..place].iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let rest = &bytes[start.max(place.saturating_sub(30))..];
    let end = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
    quote(&String::from_utf8_lossy(&rest[..end]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_difference_is_named_with_its_line() {
        let finding = first_difference(b"a\nbc\nd\n", b"a\nbd\nd\n");
        assert_eq!(
            (finding.line, finding.found.as_str(), finding.allowed.as_str()),
            (Some(2), "\"bc\"", "\"bd\"")
        );
        let ends = first_difference(b"a\r\nb\r\n", b"a\nb\n");
        assert_eq!((ends.line, ends.found.as_str()), (None, "carriage returns (CR)"));
        let cut = first_difference(b"a\n", b"a\nb\n");
        assert_eq!((cut.line, cut.found.as_str()), (Some(2), "the end of the file"));
        let binary = first_difference(b"\xff\x00", b"\xff\x01");
        assert_eq!(
            (binary.line, binary.found.as_str(), binary.allowed.as_str()),
            (None, "0x00 at byte 1", "0x01")
        );
    }
}
