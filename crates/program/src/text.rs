//! Names and notes on their way into outputs.

/// [`inert`] text of a picture, with points for what is cut off beyond `limit` characters.
pub fn shortened(text: &str, limit: usize) -> String {
    if text.chars().count() > limit {
        inert(text, limit.saturating_sub(3)) + "..."
    } else {
        inert(text, limit)
    }
}

/// The text with every character that could have a meaning for a controller replaced by `_`, cut to `limit` characters.
///
/// The result holds letters, digits, blanks and `. , - _ + = : /`: no bracket, semicolon, per cent sign, quote,
/// line break or control character can come out, and nothing outside ASCII.
pub fn inert(text: &str, limit: usize) -> String {
    let mut text_out = String::with_capacity(text.len().min(limit));
    for c in text.chars().take(limit) {
        let is_harmless =
            c.is_ascii_alphanumeric() || matches!(c, ' ' | '.' | ',' | '-' | '_' | '+' | '=' | ':' | '/');
        text_out.push(if is_harmless { c } else { '_' });
    }
    text_out
}

/// `template` with every mark, the name of one of `parts` between `open` and `close`, replaced by that part.
///
/// In one pass: the content of one part is not searched for the marks of another.
pub fn filled(template: &str, [open, close]: [&str; 2], parts: &[(&str, &str)]) -> String {
    let mut text =
        String::with_capacity(template.len() + parts.iter().map(|(_, part)| part.len()).sum::<usize>());
    let mut rest = template;
    while let Some((before, tail)) = rest.split_once(open) {
        let Some((mark, after)) = tail.split_once(close) else { break };
        text.push_str(before);
        text.extend(parts.iter().find(|(own, _)| *own == mark).map(|(_, part)| *part));
        rest = after;
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_shows_that_it_is_cut() {
        assert_eq!(shortened(&"a".repeat(24), 24), "a".repeat(24));
        assert_eq!(shortened(&"a".repeat(25), 24), "a".repeat(21) + "...");
    }
}
