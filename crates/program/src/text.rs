//! Names and notes on their way into outputs.

/// [`inert`] text of a picture, with points for what is cut off beyond `most` characters.
pub fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() > most { inert(text, most.saturating_sub(3)) + "..." } else { inert(text, most) }
}

/// The text with every character that could have a meaning for a controller replaced by `_`, cut to `most` characters.
///
/// The result holds letters, digits, blanks and `. , - _ + = : /`: no bracket, semicolon, per cent sign, quote,
/// line break or control character can come out, and nothing outside ASCII.
pub fn inert(text: &str, most: usize) -> String {
    let mut out = String::with_capacity(text.len().min(most));
    for c in text.chars().take(most) {
        let known =
            c.is_ascii_alphanumeric() || matches!(c, ' ' | '.' | ',' | '-' | '_' | '+' | '=' | ':' | '/');
        out.push(if known { c } else { '_' });
    }
    out
}

/// `template` with every mark, the name of one of `parts` between `open` and `close`, replaced by that part.
///
/// In one pass: the content of one part is not searched for the marks of another.
pub fn filled(template: &str, [open, close]: [&str; 2], parts: &[(&str, &str)]) -> String {
    let mut out =
        String::with_capacity(template.len() + parts.iter().map(|(_, part)| part.len()).sum::<usize>());
    let mut rest = template;
    while let Some((before, from)) = rest.split_once(open) {
        let Some((mark, after)) = from.split_once(close) else { break };
        out.push_str(before);
        out.extend(parts.iter().find(|(own, _)| *own == mark).map(|(_, part)| *part));
        rest = after;
    }
    out + rest
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
