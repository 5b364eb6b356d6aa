//! Encodings of files: UTF-8, UTF-16, and what an XML declaration names.

use std::borrow::Cow;

use crate::{Fault, Place};

/// Characters of windows-1252 from 0x80 on; a blank stands for those that it leaves out.
const WINDOWS: &str = "\u{20ac} \u{201a}\u{192}\u{201e}\u{2026}\u{2020}\u{2021}\u{2c6}\u{2030}\u{160}\u{2039}\u{152} \u{17d}  \u{2018}\u{2019}\u{201c}\u{201d}\u{2022}\u{2013}\u{2014}\u{2dc}\u{2122}\u{161}\u{203a}\u{153} \u{17e}\u{178}";

/// The text of an SVG.
///
/// # Errors
/// An encoding that is not read, or bytes that are not of the one that the file declares.
pub(crate) fn svg(bytes: &[u8]) -> Result<Cow<'_, str>, Vec<Fault>> {
    let text = match wide(bytes) {
        Some(text) => Cow::Owned(text),
        None => match std::str::from_utf8(bytes) {
            Ok(text) => Cow::Borrowed(text),
            Err(error) => Cow::Owned(declared(bytes, error.valid_up_to())?),
        },
    };
    Ok(with_line_feeds(text))
}

/// The text of a DXF, and whether its bytes were taken as Latin-1: files before 2007 have code pages, and names alone depend on them.
pub(crate) fn dxf(bytes: &[u8]) -> (Cow<'_, str>, bool) {
    if let Some(text) = wide(bytes) {
        return (with_line_feeds(Cow::Owned(text)), false);
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => (with_line_feeds(Cow::Borrowed(text)), false),
        Err(_) => (with_line_feeds(Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect())), true),
    }
}

/// The text of a file of two bytes a character, by its mark or by its first character.
fn wide(bytes: &[u8]) -> Option<String> {
    let (is_big, skip) = match bytes {
        [0xff, 0xfe, ..] => (false, 2),
        [0xfe, 0xff, ..] => (true, 2),
        [b'<' | b' ' | b'0'..=b'9', 0, ..] => (false, 0),
        [0, b'<' | b' ' | b'0'..=b'9', ..] => (true, 0),
        _ => return None,
    };
    let unit = |pair: &[u8]| {
        let pair = [pair[0], pair.get(1).copied().unwrap_or_default()];
        if is_big { u16::from_be_bytes(pair) } else { u16::from_le_bytes(pair) }
    };
    Some(char::decode_utf16(bytes[skip..].chunks(2).map(unit)).map(|c| c.unwrap_or('\u{fffd}')).collect())
}

/// Names of encodings that are read as windows-1252.
const LATIN: [&str; 7] =
    ["iso-8859-1", "latin1", "latin-1", "windows-1252", "cp1252", "iso8859-1", "us-ascii"];

/// The text in the encoding that an XML declaration names; `valid` bytes of it are UTF-8.
fn declared(bytes: &[u8], valid: usize) -> Result<String, Vec<Fault>> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).into_owned();
    let declaration = head.split("?>").next().unwrap_or_default();
    let name = declaration.split_once("encoding").map(|(_, rest)| {
        let rest = rest.trim_start_matches([' ', '=', '"', '\'']);
        rest.split(['"', '\'', ' ']).next().unwrap_or_default().to_ascii_lowercase()
    });
    match name {
        Some(name) if LATIN.contains(&name.as_str()) => Ok(bytes.iter().map(|&byte| latin(byte)).collect()),
        Some(name) if !matches!(name.as_str(), "" | "utf-8" | "utf8") => {
            let text = format!("The encoding {name} is not read; UTF-8, UTF-16 and ISO-8859-1 are.");
            Err(Fault::single(Place::line(1), text, "Save the file as UTF-8."))
        }
        _ => {
            let line = bytes[..valid].split(|&byte| byte == b'\n').count();
            Err(Fault::single(Place::line(line), "The text is not UTF-8.", "Save the file as UTF-8."))
        }
    }
}

/// A character of windows-1252, which has all of ISO-8859-1.
fn latin(byte: u8) -> char {
    let place = usize::from(byte).checked_sub(0x80);
    place.and_then(|place| WINDOWS.chars().nth(place)).filter(|c| *c != ' ').unwrap_or(char::from(byte))
}

/// The text with line feeds where most lines end in a carriage return alone, as on old Macs.
fn with_line_feeds(text: Cow<'_, str>) -> Cow<'_, str> {
    let bytes = text.as_bytes();
    let is_alone = |place: &usize| bytes[*place] == b'\r' && bytes.get(place + 1) != Some(&b'\n');
    let returns = (0..bytes.len()).filter(is_alone).count();
    if returns <= text.matches('\n').count() {
        return text;
    }
    Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn utf16(text: &str, is_big: bool, has_mark: bool) -> Vec<u8> {
        let units = has_mark.then_some(0xfeff).into_iter().chain(text.encode_utf16());
        units.flat_map(|unit: u16| if is_big { unit.to_be_bytes() } else { unit.to_le_bytes() }).collect()
    }

    #[test]
    fn the_same_text_comes_out_of_every_encoding() {
        let text = "<?xml version='1.0' encoding='ISO-8859-1'?>\n<svg id='\u{e4}\u{df}'/>";
        let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect();
        let files = [
            text.as_bytes().to_vec(),
            latin,
            utf16(text, true, true),
            utf16(text, false, true),
            utf16(text, true, false),
            utf16(text, false, false),
        ];
        for bytes in &files {
            assert_eq!(svg(bytes).expect("read"), text);
        }
        assert_eq!(
            svg(b"<?xml encoding=\"windows-1252\"?><a b='\x80'/>").expect("read"),
            "<?xml encoding=\"windows-1252\"?><a b='\u{20ac}'/>"
        );
        let [japanese, undeclared] = [&b"<?xml encoding='Shift_JIS'?><a b='\x83'/>"[..], b"<a b='\x83'/>"]
            .map(|bytes| svg(bytes).expect_err("refused")[0].text.clone());
        assert!(japanese.contains("shift_jis"));
        assert_eq!(undeclared, "The text is not UTF-8.");
        assert_eq!(svg(b"<a>\r<b/>\r</a>").expect("read"), "<a>\n<b/>\n</a>");
        assert_eq!(dxf(b"0\r\nEOF\r\n").0, "0\r\nEOF\r\n");
        assert_eq!(dxf(b"0\rEOF\r"), ("0\nEOF\n".into(), false));
    }
}
