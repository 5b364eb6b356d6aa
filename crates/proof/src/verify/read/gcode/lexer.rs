//! Cuts a line into words and a comment.

use crate::verify::finding::quote;
use crate::verify::read::gcode::Dialect;
use crate::verify::read::number;
use crate::verify::read::number::Number;
use crate::verify::{Finding, FindingCode};
use spec::Comments;

/// A letter with its number, e.g. `X-1.5`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Word {
    pub(super) letter: u8,
    pub(super) number: f64,
}

impl Word {
    /// The word for a message.
    pub(super) fn text(&self) -> String {
        format!("{}{}", char::from(self.letter), self.number)
    }
}

/// The kind of each byte in a line of some dialect.
#[derive(Clone, Debug)]
pub(super) struct Alphabet([u8; 256]);

/// Must not occur at all: it is not printable, or the dialect forbids it.
const BAD: u8 = 1;
/// Begins or ends a comment.
const MARK: u8 = 2;

impl Alphabet {
    pub(super) fn new(dialect: &Dialect) -> Self {
        let mut kinds = [BAD; 256];
        kinds[usize::from(b' ')..=usize::from(b'~')].fill(0);
        let marks: &[u8] = match dialect.comments {
            Comments::Semicolon => b";",
            Comments::Parentheses => b"()",
        };
        for byte in marks {
            kinds[usize::from(*byte)] |= MARK;
        }
        for byte in dialect.forbidden.bytes() {
            kinds[usize::from(byte)] |= BAD;
        }
        Self(kinds)
    }

    /// The kinds of all bytes of `line`, combined.
    fn kinds_of(&self, line: &str) -> u8 {
        line.bytes().fold(0, |kinds, byte| kinds | self.0[usize::from(byte)])
    }
}

/// The words of `line` into `words` (emptied first), and its comment without the semicolon; `alphabet` is that of `dialect`.
///
/// At the first fault the rest of the line is given up, words and all: a controller would not run it either.
pub(super) fn cut<'a>(
    line: &'a str,
    dialect: &Dialect,
    alphabet: &Alphabet,
    words: &mut Vec<Word>,
) -> (Option<&'a str>, Option<Finding>) {
    words.clear();
    let kinds = alphabet.kinds_of(line);
    if kinds & BAD != 0 {
        return (None, bad_character(line, dialect));
    }
    let (code, comment) = if kinds & MARK == 0 {
        (line, None)
    } else {
        match split_comment(line, dialect) {
            Ok(parts) => parts,
            Err(fault) => return (None, Some(fault)),
        }
    };
    let mut rest = code.trim_ascii_start();
    while let Some(letter) = rest.bytes().next() {
        let fault = if letter.is_ascii_uppercase() {
            match number::read(rest[1..].trim_ascii_start(), false) {
                Some(Number { value: Some(number), rest: tail, .. }) => {
                    words.push(Word { letter, number });
                    rest = tail.trim_ascii_start();
                    continue;
                }
                Some(Number { text, .. }) => {
                    let allowed = format!("at most {}", number::LARGEST);
                    Finding::new(FindingCode::BadNumber, quote(text), allowed)
                }
                None => {
                    Finding::new(FindingCode::BadNumber, quote(rest), "a decimal number after each letter")
                }
            }
        } else {
            Finding::new(FindingCode::UnknownWord, quote(rest), "a capital letter and a number")
        };
        words.clear();
        return (comment, Some(fault));
    }
    (comment, None)
}

/// The first character of `line` that is not printable, or else the first that the dialect forbids.
fn bad_character(line: &str, dialect: &Dialect) -> Option<Finding> {
    let forbidden = |c: &char| dialect.forbidden.contains(*c);
    let (bad, allowed) = match line.chars().find(|c| !matches!(c, ' '..='~')) {
        Some(bad) => (bad, "printable ASCII".to_owned()),
        None => (
            line.chars().find(forbidden)?,
            format!("no character of {} in {}", dialect.forbidden, dialect.name),
        ),
    };
    Some(Finding::new(FindingCode::BadCharacter, format!("{bad:?}"), allowed))
}

/// The line's code, and its comment without the mark.
fn split_comment<'a>(line: &'a str, dialect: &Dialect) -> Result<(&'a str, Option<&'a str>), Finding> {
    if dialect.comments == Comments::Semicolon {
        return Ok(line.split_once(';').map_or((line, None), |(code, comment)| (code, Some(comment))));
    }
    let allowed = match (line.split_once('('), line.contains(')')) {
        (None, false) => return Ok((line, None)),
        (None, true) => "a comment that begins before it ends",
        (Some((code, rest)), _) => match rest.split_once(')') {
            Some((comment, "")) if !comment.contains('(') => return Ok((code, Some(comment))),
            _ => "one comment, closed at the end of the line",
        },
    };
    Err(Finding::new(FindingCode::BadComment, quote(line), allowed))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Result<Vec<(char, f64)>, &'static str> {
        let mut words = Vec::new();
        let dialect = Dialect::GENERIC;
        match cut(line, &dialect, &Alphabet::new(&dialect), &mut words) {
            (_, None) => Ok(words.iter().map(|w| (char::from(w.letter), w.number)).collect()),
            (_, Some(fault)) => Err(fault.code),
        }
    }

    #[test]
    fn words_with_and_without_blanks() {
        let expected = vec![('G', 1.0), ('X', -1.5), ('Y', 0.25)];
        for line in ["G1 X-1.5 Y.25", "G1X-1.5Y.25", "  G 1  X -1.5 Y +0.250  ; and so on"] {
            assert_eq!(words(line), Ok(expected.clone()), "{line}");
        }
        assert_eq!(words("; only a comment, G1 X1"), Ok(vec![]));
        assert_eq!(words(""), Ok(vec![]));
    }

    #[test]
    fn refuses_what_a_controller_refuses() {
        for (line, code) in [
            ("G1 X", "bad-number"),
            ("G1 Xnan", "bad-number"),
            ("G1 X1e3", "bad-number"),
            ("G1 X9999999999", "bad-number"),
            ("g1 x1", "unknown-word"),
            ("%", "unknown-word"),
            ("G1 X1 (a comment)", "bad-character"),
            ("; harmless) G0 Z-9", "bad-character"),
            ("; hold!", "bad-character"),
            ("G1 X1\rM30", "bad-character"),
            ("; \u{2028}G1", "bad-character"),
            ("G1 X\u{661}", "bad-character"),
        ] {
            assert!(words(line).is_err_and(|c| c == code || c == "unknown-word"), "{line}");
        }
    }
}
