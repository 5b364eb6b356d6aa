//! The link that opens a spec in the page, and its QR code.
//!
//! The fragment of the link holds the whole spec, which a browser sends to no server: `#spec=TEXT`, then `&machine=TEXT` for a profile that
//! is not built in, and `&file=NAME&drawing=TEXT` for a drawing. `TEXT` is deflated (RFC 1951) and written in base64url (RFC 4648, 5) without
//! padding. `web/page/link.js` reads it.

mod code;

use std::borrow::Cow;
use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use miniz_oxide::deflate::compress_to_vec;

pub use code::{LinkCode, MOST_LETTERS};

/// How hard texts are packed, 0 to 10.
const PACKED: u8 = 10;

/// What a link holds.
#[derive(Clone, Copy, Debug)]
pub struct LinkedSpec<'a> {
    /// The text of the spec.
    pub spec: &'a str,
    /// The text of its machine profile, if it is not built in.
    pub machine: Option<&'a str>,
    /// Name and content of its drawing, if it has one.
    pub drawing: Option<(&'a str, &'a [u8])>,
}

impl LinkedSpec<'_> {
    /// The fragment of the link, with its `#`.
    pub fn fragment(&self) -> String {
        let mut fragment = format!("#spec={}", packed(self.spec.as_bytes()));
        if let Some(machine) = self.machine {
            fragment.extend(["&machine=", &packed(machine.as_bytes())]);
        }
        if let Some((name, bytes)) = self.drawing {
            fragment.extend(["&file=", &escaped(name), "&drawing=", &packed(bytes)]);
        }
        fragment
    }

    /// The QR code of the link to the page at `address`; `None` if the link is too long for one. Comment lines are left out, for a
    /// smaller code.
    pub fn code(&self, address: &str) -> Option<LinkCode> {
        LinkCode::new(self.short_link(address))
    }

    /// The link to the page at `address`, without comment lines.
    pub fn short_link(&self, address: &str) -> String {
        let short = LinkedSpec { spec: &without_comments(self.spec), ..*self };
        format!("{address}{}", short.fragment())
    }
}

/// `bytes` as the value of a link.
fn packed(bytes: &[u8]) -> String {
    URL_SAFE_NO_PAD.encode(compress_to_vec(bytes, PACKED))
}

/// `text` without blank lines and lines that are comments alone. As it is, if a text of several lines may hold such a line.
fn without_comments(text: &str) -> Cow<'_, str> {
    if text.contains("\"\"\"") || text.contains("'''") {
        return Cow::Borrowed(text);
    }
    let is_kept = |line: &&str| !line.trim_start().is_empty() && !line.trim_start().starts_with('#');
    Cow::Owned(text.lines().filter(is_kept).flat_map(|line| [line, "\n"]).collect())
}

/// `text` with every byte by its number that is not unreserved in an address (RFC 3986, 2.3).
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"-_.~".contains(&byte) {
            escaped.push(char::from(byte));
        } else {
            let _ = write!(escaped, "%{byte:02X}");
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use miniz_oxide::inflate::decompress_to_vec;
    use proptest::prelude::*;

    use super::*;

    fn unpacked(value: &str) -> Vec<u8> {
        decompress_to_vec(&URL_SAFE_NO_PAD.decode(value).expect("base64url")).expect("deflated")
    }

    proptest! {
        #[test]
        fn a_link_holds_what_was_put_in(spec in "\\PC{0,200}", machine in "\\PC{0,99}", name in "\\PC{1,20}", drawing: Vec<u8>) {
            let linked = LinkedSpec { spec: &spec, machine: Some(&machine), drawing: Some((&name, &drawing)) };
            let fragment = linked.fragment();
            prop_assert!(fragment.bytes().all(|byte| byte.is_ascii_graphic()), "{}", fragment);
            let parts: Vec<(&str, &str)> =
                fragment[1..].split('&').map(|part| part.split_once('=').expect("a value")).collect();
            let names: Vec<&str> = parts.iter().map(|(name, _)| *name).collect();
            prop_assert_eq!(names, ["spec", "machine", "file", "drawing"]);
            prop_assert_eq!(unpacked(parts[0].1), spec.as_bytes());
            prop_assert_eq!(unpacked(parts[1].1), machine.as_bytes());
            prop_assert_eq!(unpacked(parts[3].1), drawing);
        }
    }

    #[test]
    fn a_name_of_a_file_ends_no_part() {
        assert_eq!(escaped("a b&c=d#é.svg"), "a%20b%26c%3Dd%23%C3%A9.svg");
    }

    #[test]
    fn comment_lines_are_left_out_but_not_of_long_texts() {
        assert_eq!(without_comments("# a\r\nb = 1 # c\r\n\r\n  # d\n[e]"), "b = 1 # c\n[e]\n");
        let text = "a = \"\"\"\n# b\n\"\"\"\n";
        assert_eq!(without_comments(text), text);
    }
}
