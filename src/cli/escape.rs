//! Escapes text from outside for output on a terminal.

use std::borrow::Cow;
use std::ffi::OsStr;

/// A path, or another text from outside, escaped for a line on a terminal: it cannot end the line.
pub(super) fn escaped_line(text: impl AsRef<OsStr>) -> String {
    spelt_out(&text.as_ref().to_string_lossy(), spec::misleads).into_owned()
}

/// A path, or another text from outside, as one argument of a command for a POSIX shell that is printed: quoted where it must be, and no
/// option.
pub(super) fn argument(text: impl AsRef<OsStr>) -> String {
    let text = escaped_line(text);
    let text = if text.len() > 1 && text.starts_with('-') { format!("./{text}") } else { text };
    if !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || "-_./+,:@%".contains(c)) {
        text
    } else if text.contains(['$', '`', '"', '\\', '!']) {
        format!("'{}'", text.replace('\'', "'\\''"))
    } else {
        format!("\"{text}\"")
    }
}

/// `text` escaped for a terminal: characters that move the cursor, ring the bell or change the direction of text are spelt out.
///
/// All output passes through this function. The spelling, `\u001b`, is that of JSON, so that a JSON object keeps its meaning.
pub(super) fn escaped(text: &str) -> Cow<'_, str> {
    spelt_out(text, |c| spec::misleads(c) && !matches!(c, '\n' | '\t'))
}

/// `text` with the characters for which `bad` holds spelt out; all of them are at most U+FFFF.
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
            escaped_line(hostile),
            "e\\u001b]0;pwn\\u0007\\u001b[2J\\u009b31m\\u007f\\u202egpj\\u2066\\u000d"
        );
        assert_eq!(escaped_line("a\nproven, no findings"), "a\\u000aproven, no findings");
        assert_eq!(escaped("two\n\tlines, é 星"), "two\n\tlines, é 星");
    }

    #[test]
    fn an_argument_is_one_word_for_a_shell_and_no_option() {
        for (text, word) in [
            ("a/b-1.toml", "a/b-1.toml"),
            ("-", "-"),
            ("-x.toml", "./-x.toml"),
            ("my bottle.toml", "\"my bottle.toml\""),
            ("it's", "\"it's\""),
            ("it's $5", "'it'\\''s $5'"),
            ("a;b", "\"a;b\""),
            ("", "\"\""),
        ] {
            assert_eq!(argument(text), word);
        }
    }

    #[test]
    fn an_object_means_the_same_afterwards() {
        let object = serde_json::json!({ "found": "a\u{202e}\u{9b}\u{1b}\n\\b" });
        let text = escaped(&object.to_string()).into_owned();
        assert!(!text.contains(spec::misleads), "{text}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), object);
    }
}
