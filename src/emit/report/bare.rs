//! Scripts and styles as reports hold them: without indentation, empty lines, and lines that are comments alone.
//!
//! The compiler takes them away, so that no program holds them either. `web/make-page` does the same, to name the scripts by their hashes.

/// Bytes of which the first `length` are text.
pub(super) struct Bare<const N: usize> {
    pub(super) bytes: [u8; N],
    pub(super) length: usize,
}

/// The lines of `text` that are kept, each without its indentation.
pub(super) const fn bare_lines<const N: usize>(text: &[u8; N]) -> Bare<N> {
    let mut kept_lines = Bare { bytes: [0; N], length: 0 };
    let mut start = 0;
    while start < N {
        while start < N && (text[start] == b' ' || text[start] == b'\t') {
            start += 1;
        }
        let mut end = start;
        while end < N && text[end] != b'\n' {
            end += 1;
        }
        let next = if end < N { end + 1 } else { N };
        if end > start && !is_comment(text, start, end) {
            while start < next {
                kept_lines.bytes[kept_lines.length] = text[start];
                kept_lines.length += 1;
                start += 1;
            }
        }
        start = next;
    }
    kept_lines
}

/// Whether the line from `start` to `end` is a comment and nothing else; one of several lines is none.
const fn is_comment(text: &[u8], start: usize, end: usize) -> bool {
    if end < start + 2 || text[start] != b'/' {
        return false;
    }
    let closes = end >= start + 4 && text[end - 2] == b'*' && text[end - 1] == b'/';
    text[start + 1] == b'/' || (text[start + 1] == b'*' && closes)
}

/// The file of a script or a style without what is for its readers.
macro_rules! bare {
    ($file:literal) => {{
        const TEXT: &[u8; include_bytes!($file).len()] = include_bytes!($file);
        const BARE: $crate::emit::report::bare::Bare<{ TEXT.len() }> =
            $crate::emit::report::bare::bare_lines(TEXT);
        const BYTES: [u8; BARE.length] = match BARE.bytes.first_chunk() {
            Some(bytes) => *bytes,
            None => [0; BARE.length],
        };
        match std::str::from_utf8(&BYTES) {
            Ok(text) => text,
            Err(_) => "",
        }
    }};
}
pub(super) use bare;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_stays_and_comments_go() {
        let text = b"// a\n\n  /** b */\n  let x = 1; // c\n\t/* d */ e\n/* f\ng */\n  //\nend";
        let Bare { bytes, length } = bare_lines(text);
        let bare_text = std::str::from_utf8(&bytes[..length]);
        assert_eq!(bare_text, Ok("let x = 1; // c\n/* d */ e\n/* f\ng */\nend"));
    }
}
