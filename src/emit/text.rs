//! Names and notes on their way into outputs.

/// The text with every character that could have a meaning for a controller replaced by `_`, cut to `most` characters.
///
/// The result holds letters, digits, blanks and `. , - _ + = : /`: no bracket, semicolon, per cent sign, quote,
/// line break or control character can come out, and nothing outside ASCII.
pub(crate) fn inert(text: &str, most: usize) -> String {
    let mut out = String::with_capacity(text.len().min(most));
    for c in text.chars().take(most) {
        let known =
            c.is_ascii_alphanumeric() || matches!(c, ' ' | '.' | ',' | '-' | '_' | '+' | '=' | ':' | '/');
        out.push(if known { c } else { '_' });
    }
    out
}
