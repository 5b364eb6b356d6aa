//! Reads ZIP archives whose entries are stored (PKWARE's APPNOTE 6.3.10): no compression, no encryption, no gap between entries.

use std::collections::HashSet;

use crate::verify::finding::quote;
use crate::verify::{Finding, FindingCode};

/// A file in an archive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::verify) struct ZipEntry<'a> {
    /// Name with its folders: `Metadata/plate_1.gcode`.
    pub(in crate::verify) name: &'a str,
    /// Content, which has the checksum that the archive states.
    pub(in crate::verify) content: &'a [u8],
}

/// The fixed part of a header: the bytes with which it begins, and its length.
struct ZipHeader {
    mark: &'static [u8],
    length: usize,
}

/// The header before a content.
const LOCAL: ZipHeader = ZipHeader { mark: b"PK\x03\x04", length: 30 };
/// An entry of the directory.
const CENTRAL: ZipHeader = ZipHeader { mark: b"PK\x01\x02", length: 46 };
/// The record at the end of an archive without a comment.
const END: ZipHeader = ZipHeader { mark: b"PK\x05\x06", length: 22 };

/// Where a header of an entry states its facts: the bytes from its version on, alike in both headers.
const FLAGS: usize = 2;
const METHOD: usize = 4;
const CHECKSUM: usize = 10;
const SIZES: [usize; 2] = [14, 18];
const NAME_LENGTH: usize = 22;
const EXTRA_LENGTH: usize = 24;
/// Length of these facts.
const FACTS: usize = 26;

/// An entry as its headers state it.
struct StatedEntry<'a> {
    name: &'a [u8],
    content: &'a [u8],
    checksum: usize,
    is_stored: bool,
}

/// The entries of an archive, in the order of their contents.
///
/// The directory and the headers before the contents are both read and must agree, and the entries must fill the archive: two programs
/// that read either find the same.
pub(in crate::verify) fn read_zip(bytes: &[u8]) -> Result<Vec<ZipEntry<'_>>, Finding> {
    let stated = stated_entries(bytes).ok_or_else(|| {
        fault("headers that are cut off or disagree", "entries without gaps, their directory, and its end")
    })?;
    let mut names = HashSet::new();
    stated
        .into_iter()
        .map(|StatedEntry { name, content, checksum, is_stored }| {
            let name = std::str::from_utf8(name).unwrap_or_default();
            if name.is_empty() || !names.insert(name) {
                return Err(fault(format!("{} twice, or not a text", quote(name)), "names that differ"));
            }
            if !is_stored {
                return Err(fault(format!("{}, compressed", quote(name)), "stored entries"));
            }
            if usize::try_from(crc32(content)) != Ok(checksum) {
                return Err(fault(format!("{} with another checksum", quote(name)), "the stated CRC-32"));
            }
            Ok(ZipEntry { name, content })
        })
        .collect()
}

/// A finding about the archive.
fn fault(problem: impl Into<String>, allowed: &str) -> Finding {
    Finding::new(FindingCode::BadZip, problem, allowed)
}

/// The entries of the directory; `None` if a header is cut off, or two disagree.
///
/// The record at the end leads to the directory, and each of its entries to a header before a content. All of them must lie one after
/// the other: entries, directory, record.
fn stated_entries(bytes: &[u8]) -> Option<Vec<StatedEntry<'_>>> {
    let end_place = bytes.len().checked_sub(END.length)?;
    let end = headed(bytes, end_place, &END)?;
    // One disk, all entries on it, and no comment.
    if end[4..8] != [0; 4] || end[8..10] != end[10..12] || end[20..] != [0; 2] {
        return None;
    }
    let start = number32(end, 16)?;
    let (mut entries, mut place, mut offset) = (Vec::new(), start, 0);
    for _ in 0..number16(end, 10)? {
        let entry = stated_entry(&bytes[..end_place], place, offset)?;
        place += CENTRAL.length + entry.name.len();
        offset += LOCAL.length + entry.name.len() + entry.content.len();
        entries.push(entry);
    }
    let is_filled =
        place == end_place && offset == start && start.checked_add(number32(end, 12)?)? == end_place;
    is_filled.then_some(entries)
}

/// The entry whose directory entry lies at `place`, and whose content begins with a header at `offset`.
fn stated_entry(bytes: &[u8], place: usize, offset: usize) -> Option<StatedEntry<'_>> {
    let central = headed(bytes, place, &CENTRAL)?;
    let local = headed(bytes, offset, &LOCAL)?;
    let facts = &central[6..6 + FACTS];
    // No comment and no extra field.
    if *facts != local[4..4 + FACTS]
        || number32(central, 42)? != offset
        || central[32..34] != [0; 2]
        || number16(facts, EXTRA_LENGTH)? != 0
    {
        return None;
    }
    let (name_length, length) = (number16(facts, NAME_LENGTH)?, number32(facts, SIZES[0])?);
    let name = part(bytes, place + CENTRAL.length, name_length)?;
    if part(bytes, offset + LOCAL.length, name_length)? != name {
        return None;
    }
    let is_stored = facts[FLAGS..METHOD + 2] == [0; 4] && number32(facts, SIZES[1])? == length;
    let content = part(bytes, offset + LOCAL.length + name_length, length)?;
    Some(StatedEntry { name, content, checksum: number32(facts, CHECKSUM)?, is_stored })
}

/// The fixed part at `place` of such a header; `None` if another thing is there.
fn headed<'a>(bytes: &'a [u8], place: usize, ZipHeader { mark, length }: &ZipHeader) -> Option<&'a [u8]> {
    part(bytes, place, *length).filter(|header| header.starts_with(mark))
}

/// `length` bytes from `place`; `None` beyond the end.
fn part(bytes: &[u8], place: usize, length: usize) -> Option<&[u8]> {
    bytes.get(place..place.checked_add(length)?)
}

/// The number in two bytes at `place`, the lowest first.
fn number16(bytes: &[u8], place: usize) -> Option<usize> {
    Some(usize::from(u16::from_le_bytes(part(bytes, place, 2)?.try_into().ok()?)))
}

/// The number in four bytes at `place`, the lowest first.
fn number32(bytes: &[u8], place: usize) -> Option<usize> {
    usize::try_from(u32::from_le_bytes(part(bytes, place, 4)?.try_into().ok()?)).ok()
}

/// CRC-32 of ISO 3309, a bit at a time.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |remainder, byte| {
        (0..8).fold(remainder ^ u32::from(*byte), |crc, _| {
            if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// `printf ab >a; zip -0 -X a.zip a`, dated 1980-01-01, and `cd` after it.
    const ARCHIVE: &[u8] = b"PK\x03\x04\x14\0\0\0\0\0\0\0\x21\0\x6d\x48\x83\x9e\x02\0\0\0\x02\0\0\0\x01\0\0\0aab\
        PK\x01\x02\x14\0\x14\0\0\0\0\0\0\0\x21\0\x6d\x48\x83\x9e\x02\0\0\0\x02\0\0\0\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0a\
        PK\x05\x06\0\0\0\0\x01\0\x01\0\x2f\0\0\0\x21\0\0\0\0\0";

    fn problem(bytes: &[u8]) -> String {
        read_zip(bytes).expect_err("a fault").found
    }

    #[test]
    fn stored_entries_are_read() {
        assert_eq!(read_zip(ARCHIVE), Ok(vec![ZipEntry { name: "a", content: b"ab" }]));
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    }

    #[test]
    fn each_wrong_byte_is_a_fault() {
        for place in 0..ARCHIVE.len() {
            // The version of the writer, the disk and attributes of an entry decide nothing.
            if matches!(place, 37..39 | 67..75) {
                continue;
            }
            let mut bytes = ARCHIVE.to_vec();
            bytes[place] ^= 0x40;
            assert!(read_zip(&bytes).is_err(), "byte {place}");
        }
        let (head, tail) = ARCHIVE.split_at(31);
        assert_eq!(problem(&[head, b"x", tail].concat()), "headers that are cut off or disagree");
        assert_eq!(problem(b"PK"), "headers that are cut off or disagree");
    }

    proptest! {
        #[test]
        fn no_input_makes_the_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..200), place in 0..80_usize) {
            let _ = read_zip(&bytes);
            let mut damaged = ARCHIVE.to_vec();
            let end = damaged.len().min(place + bytes.len());
            let start = place.min(end);
            damaged[start..end].copy_from_slice(&bytes[..end - start]);
            let _ = read_zip(&damaged);
        }
    }
}
