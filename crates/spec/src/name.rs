//! Free words of a spec: names and descriptions, which are later written to file headers and title blocks.

/// Longest name, in characters.
pub const NAME_LENGTH: usize = 80;

/// Checks that `text` can be a name: 1 to [`NAME_LENGTH`] characters, no control character, no line break, no code point that is
/// not a character, and no mark that turns the direction of text (letters that are written from right to left need none).
///
/// # Errors
/// The reason why it cannot.
pub fn check_name(text: &str) -> Result<(), String> {
    if let Some(c) = text.chars().find(|c| misleads(*c)) {
        let point = format!("U+{:04X}", u32::from(c));
        return Err(if turns(c) {
            format!("a name must read the same everywhere: remove {point}, which turns the direction of text")
        } else if is_no_character(c) {
            format!("a name must consist of characters, and {point} is not one: remove it")
        } else {
            format!("a name must be one line without control characters, here is {point}")
        });
    }
    if text.chars().all(is_blank) {
        return Err("a name needs at least one visible character".to_owned());
    }
    let length = text.chars().count();
    if length > NAME_LENGTH {
        return Err(format!("the name has {length} characters, at most {NAME_LENGTH} are allowed"));
    }
    Ok(())
}

/// Whether `word` is of ASCII letters, digits, - and _ alone, and at least one of them: a comment or a command of a program may carry it.
pub fn is_plain_word(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-".contains(&byte))
}

/// Whether `c` is invisible: a space, or one of Unicode's fillers, joiners and selectors, which have no shape.
fn is_blank(c: char) -> bool {
    let is_filler = matches!(
        c,
        '\u{ad}' | '\u{34f}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}' | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200d}'
            | '\u{2060}'..='\u{2064}' | '\u{206a}'..='\u{206f}' | '\u{2800}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}'
            | '\u{ffa0}' | '\u{fff0}'..='\u{fff8}' | '\u{e0000}'..='\u{e0fff}'
    );
    c.is_whitespace() || is_filler
}

/// Whether `c` makes a line of text show something else than it contains: a control character, one of Unicode's two line breaks
/// that Rust does not count as such, a mark that turns the direction of text, or a code point that is not a character.
pub fn misleads(c: char) -> bool {
    c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') || turns(c) || is_no_character(c)
}

/// Whether `c` is one of the two code points that are not characters and that XML 1.0 forbids (2.2, production Char).
fn is_no_character(c: char) -> bool {
    matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// Whether `c` is one of Unicode's controls of direction (UAX 9, 2.1 to 2.6).
fn turns(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_one_visible_line() {
        let refused = |name: &str, words: &str| {
            assert!(check_name(name).is_err_and(|why| why.contains(words)), "{name:?}: {words}");
        };
        assert_eq!(check_name("../a) ; <script> é 星"), Ok(()));
        let empty = "at least one visible character";
        refused(" \u{a0} ", empty);
        for invisible in ["\u{200b}", "\u{3164}\u{3164}", "\u{feff} \u{2060}", "\u{2800}", "\u{e0041}"] {
            refused(invisible, empty);
        }
        assert_eq!(check_name("a\u{200d}b"), Ok(()), "a joiner between letters");
        assert_eq!(check_name(&"星".repeat(80)), Ok(()));
        refused(&"星".repeat(81), "the name has 81 characters, at most 80");
        let marked = |c: char, words: &str| {
            refused(&format!("a{c}b"), words);
            refused(&format!("a{c}b"), &format!("U+{:04X}", u32::from(c)));
        };
        for c in ['\n', '\r', '\0', '\u{85}', '\u{2028}', '\u{1b}'] {
            marked(c, "without control characters");
        }
        for c in ['\u{202a}', '\u{202e}', '\u{2066}', '\u{2069}', '\u{200e}', '\u{200f}', '\u{61c}'] {
            marked(c, "turns the direction of text");
        }
        for c in ['\u{fffe}', '\u{ffff}'] {
            marked(c, "must consist of characters");
        }
        assert_eq!(check_name("כוכב نجمة"), Ok(()), "right to left, by its letters alone");
    }
}
