//! Text that is not ours, as it may go to a terminal.

use std::borrow::Cow;
use std::ffi::OsStr;

use crate::spec;

/// A path, or another text that is not ours, as it may stand in a line on a terminal: it cannot end the line.
pub(super) fn shown(text: impl AsRef<OsStr>) -> String {
    spelt_out(&text.as_ref().to_string_lossy(), spec::misleads).into_owned()
}

/// `text` as it may go to a terminal: what would move its cursor, ring, or turn its text around is spelt out.
///
/// All text leaves through here, whatever it quotes. The spelling, `\u001b`, is JSON's, so that an object means the
/// same afterwards.
pub(super) fn escaped(text: &str) -> Cow<'_, str> {
    spelt_out(text, |c| spec::misleads(c) && !matches!(c, '\n' | '\t'))
}

/// `text` with the characters that `bad` names spelt out; none of them is beyond U+FFFF.
fn spelt_out(text: &str, bad: impl Fn(char) -> bool + Copy) -> Cow<'_, str> {
    if !text.contains(bad) {
        return text.into();
    }
    let spelt = |c: char| if bad(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() };
    text.chars().map(spelt).collect::<String>().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foreign_text_is_harmless_on_a_terminal() {
        let hostile = "e\u{1b}]0;pwn\u{7}\u{1b}[2J\u{9b}31m\u{7f}\u{202e}gpj\u{2066}\r";
        assert_eq!(
            shown(hostile),
            "e\\u001b]0;pwn\\u0007\\u001b[2J\\u009b31m\\u007f\\u202egpj\\u2066\\u000d"
        );
        assert_eq!(shown("a\nproven, no findings"), "a\\u000aproven, no findings");
        assert_eq!(escaped("two\n\tlines, é 星"), "two\n\tlines, é 星");
    }

    #[test]
    fn an_object_means_the_same_afterwards() {
        let object = serde_json::json!({ "found": "a\u{202e}\u{9b}\u{1b}\n\\b" });
        let text = escaped(&object.to_string()).into_owned();
        assert!(!text.contains(spec::misleads), "{text}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), object);
    }
}
