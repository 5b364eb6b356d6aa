//! Free words of a spec: names and descriptions, which are later written to file headers and title blocks.

use std::fmt;

/// Longest name, in characters.
pub const NAME_LENGTH: usize = 80;

/// The reason why a text cannot be a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameFault {
    /// It is empty or blank.
    Empty,
    /// It has this many characters, more than [`NAME_LENGTH`].
    TooLong(usize),
    /// It holds a control character or a line break.
    Control(char),
    /// It holds a mark that turns the direction of text, so that it reads as another one.
    Direction(char),
    /// It holds a code point that is not a character, which no XML or HTML file may hold.
    NoCharacter(char),
}

impl fmt::Display for NameFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a name needs at least one visible character"),
            Self::TooLong(length) => {
                write!(f, "the name has {length} characters, at most {NAME_LENGTH} are allowed")
            }
            Self::Control(c) => {
                write!(
                    f,
                    "a name must be one line without control characters, here is U+{:04X}",
                    u32::from(*c)
                )
            }
            Self::Direction(c) => {
                write!(
                    f,
                    "a name must read the same everywhere: remove U+{:04X}, which turns the direction of text",
                    u32::from(*c)
                )
            }
            Self::NoCharacter(c) => {
                write!(
                    f,
                    "a name must consist of characters, and U+{:04X} is not one: remove it",
                    u32::from(*c)
                )
            }
        }
    }
}

impl std::error::Error for NameFault {}

/// Checks that `text` can be a name: 1 to [`NAME_LENGTH`] characters, no control character, no line break, no code point that is
/// not a character, and no mark that turns the direction of text (letters that are written from right to left need none).
///
/// # Errors
/// If it cannot.
pub fn check_name(text: &str) -> Result<(), NameFault> {
    match text.chars().find(|c| misleads(*c)) {
        Some(c) if turns(c) => return Err(NameFault::Direction(c)),
        Some(c) if is_no_character(c) => return Err(NameFault::NoCharacter(c)),
        Some(c) => return Err(NameFault::Control(c)),
        None => {}
    }
    if text.chars().all(is_blank) {
        return Err(NameFault::Empty);
    }
    match text.chars().count() {
        length if length > NAME_LENGTH => Err(NameFault::TooLong(length)),
        _ => Ok(()),
    }
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
        assert_eq!(check_name("../a) ; <script> é 星"), Ok(()));
        assert_eq!(check_name(" \u{a0} "), Err(NameFault::Empty));
        for invisible in ["\u{200b}", "\u{3164}\u{3164}", "\u{feff} \u{2060}", "\u{2800}", "\u{e0041}"] {
            assert_eq!(check_name(invisible), Err(NameFault::Empty), "{invisible:?}");
        }
        assert_eq!(check_name("a\u{200d}b"), Ok(()), "a joiner between letters");
        assert_eq!(check_name(&"星".repeat(80)), Ok(()));
        assert_eq!(check_name(&"星".repeat(81)), Err(NameFault::TooLong(81)));
        for c in ['\n', '\r', '\0', '\u{85}', '\u{2028}', '\u{1b}'] {
            assert_eq!(check_name(&format!("a{c}b")), Err(NameFault::Control(c)));
        }
        for c in ['\u{202a}', '\u{202e}', '\u{2066}', '\u{2069}', '\u{200e}', '\u{200f}', '\u{61c}'] {
            assert_eq!(check_name(&format!("a{c}b")), Err(NameFault::Direction(c)));
        }
        for c in ['\u{fffe}', '\u{ffff}'] {
            assert_eq!(check_name(&format!("a{c}b")), Err(NameFault::NoCharacter(c)));
        }
        assert_eq!(check_name("כוכב نجمة"), Ok(()), "right to left, by its letters alone");
    }
}
