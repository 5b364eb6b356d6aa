//! Names and notes on their way into outputs.

/// [`inert`] text of a picture's heading, with points for what was cut off.
pub(super) fn heading(text: &str) -> String {
    const MOST: usize = 60;
    if text.chars().count() > MOST { inert(text, MOST - 3) + "..." } else { inert(text, MOST) }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_shows_that_it_is_cut() {
        assert_eq!(heading(&"a".repeat(60)), "a".repeat(60));
        assert_eq!(heading(&"a".repeat(61)), "a".repeat(57) + "...");
    }
}
