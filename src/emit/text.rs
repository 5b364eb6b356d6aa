//! Names and notes on their way into outputs.

/// The text with every character that could mean something to a controller replaced by `_`, cut to `most` characters.
///
/// What stays is letters, digits, blanks and `. , - _ + = : /`: no bracket, semicolon, per cent sign, quote,
/// line break or control character can come out, and nothing outside ASCII.
pub(crate) fn inert(text: &str, most: usize) -> String {
    let keep = |c: char| if c.is_ascii_alphanumeric() || " .,-_+=:/".contains(c) { c } else { '_' };
    text.chars().take(most).map(keep).collect()
}
