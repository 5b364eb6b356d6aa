//! Limits on an XML file's demands on its parser, in one pass over the bytes.
//!
//! The parser compares each attribute with all others of its element, and copies the namespaces in scope to each element that
//! declares one; entities repeat text. Without these bounds a small file can take hours or gigabytes.

use crate::{Fault, Place};

/// Most attributes of an element. Inkscape writes about 40 on its root.
const ATTRIBUTES: usize = 256;
/// Most namespace declarations of a file.
const NAMESPACES: usize = 4096;
/// Most bytes that all entities may expand to.
const EXPANDED: usize = 4 << 20;

/// Refuses text that would cost the parser more than linear time or memory.
pub(super) fn admit(text: &str) -> Result<(), Vec<Fault>> {
    if let Some(offset) = crowded(text.as_bytes()) {
        let problem = format!("An element has more than {ATTRIBUTES} attributes.");
        return Err(fault(text, offset, problem));
    }
    if text.matches("xmlns").count() > NAMESPACES {
        let problem = format!("The file declares more than {NAMESPACES} namespaces.");
        return Err(fault(text, 0, problem));
    }
    if let Some(offset) = text.find("<!ENTITY") {
        let subset = &text[offset..text[offset..].find("]>").map_or(text.len(), |end| offset + end)];
        let references = text.bytes().filter(|&byte| byte == b'&').count();
        if subset.contains('&') || subset.len().saturating_mul(references) > EXPANDED {
            let problem = "Its entities are nested, or expand to too much text.".to_owned();
            return Err(fault(text, offset, problem));
        }
    }
    Ok(())
}

/// The fault `problem` at the byte `offset` of `text`.
fn fault(text: &str, offset: usize, problem: String) -> Vec<Fault> {
    let line = text[..offset].matches('\n').count() + 1;
    Fault::single(Place::line(line), problem, "Save the drawing as plain SVG.")
}

/// The place of a tag with too many attributes.
fn crowded(bytes: &[u8]) -> Option<usize> {
    let mut offset = 0;
    while offset < bytes.len() {
        let rest = &bytes[offset..];
        let skipped = [(&b"<!--"[..], &b"-->"[..]), (b"<![CDATA[", b"]]>"), (b"<?", b"?>")];
        if rest[0] != b'<' {
            offset += 1;
        } else if let Some((open, close)) = skipped.iter().find(|(open, _)| rest.starts_with(open)) {
            let inner = &rest[open.len()..];
            let end = inner.windows(close.len()).position(|window| window == *close)?;
            offset += open.len() + end + close.len();
        } else {
            let (mut count, mut quote, mut length) = (0, None, 1);
            while length < rest.len() && (quote.is_some() || rest[length] != b'>') {
                match (rest[length], quote) {
                    (byte, Some(open)) if byte == open => quote = None,
                    (byte @ (b'"' | b'\''), None) => quote = Some(byte),
                    (b'=', None) => count += 1,
                    _ => {}
                }
                length += 1;
            }
            if count > ATTRIBUTES {
                return Some(offset);
            }
            offset += length;
        }
    }
    None
}
