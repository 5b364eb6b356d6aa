//! Cuts a line into words and a comment.

use crate::verify::FindingCode;
use crate::verify::finding::quote;
use crate::verify::read::gcode::{CommentMark, Dialect};
use crate::verify::read::number;

/// A letter with its number, e.g. `X-1.5`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Word {
    pub(super) letter: u8,
    pub(super) number: f64,
}

/// What is wrong with a line's characters: code, found, allowed.
pub(super) type Fault = (FindingCode, String, String);

/// The words of `line` into `words` (emptied first), and its comment without the semicolon.
///
/// At the first fault the rest of the line is given up, words and all: a controller would not run it either.
pub(super) fn cut<'a>(
    line: &'a str,
    dialect: &Dialect,
    words: &mut Vec<Word>,
) -> (Option<&'a str>, Option<Fault>) {
    words.clear();
    if !line.bytes().all(|byte| matches!(byte, b' '..=b'~')) {
        let bad = line.chars().find(|c| !matches!(c, ' '..='~')).unwrap_or_default();
        let fault = (FindingCode::BadCharacter, format!("{bad:?}"), "printable ASCII".to_owned());
        return (None, Some(fault));
    }
    // One bit for each character: all are printable by now.
    let forbidden = dialect.forbidden.bytes().fold(0_u128, |set, byte| set | 1 << (byte & 127));
    if let Some(bad) = line.bytes().find(|byte| forbidden >> byte & 1 == 1) {
        let allowed = format!("no character of {} in {}", dialect.forbidden, dialect.name);
        return (None, Some((FindingCode::BadCharacter, format!("{:?}", char::from(bad)), allowed)));
    }
    let (code, comment) = match split_comment(line, dialect) {
        Ok(parts) => parts,
        Err(fault) => return (None, Some(fault)),
    };
    let mut rest = code.trim_ascii_start();
    while let Some(letter) = rest.bytes().next() {
        let fault = if letter.is_ascii_uppercase() {
            match number::split_number(rest[1..].trim_ascii_start(), false) {
                Some((text, tail)) => match number::parsed(text) {
                    Some(number) => {
                        words.push(Word { letter, number });
                        rest = tail.trim_ascii_start();
                        continue;
                    }
                    None => (FindingCode::BadNumber, quote(text), format!("at most {}", number::LARGEST)),
                },
                None => {
                    (FindingCode::BadNumber, quote(rest), "a decimal number after each letter".to_owned())
                }
            }
        } else {
            (FindingCode::UnknownWord, quote(rest), "a capital letter and a number".to_owned())
        };
        words.clear();
        return (comment, Some(fault));
    }
    (comment, None)
}

/// The line's code, and its comment without the mark.
fn split_comment<'a>(line: &'a str, dialect: &Dialect) -> Result<(&'a str, Option<&'a str>), Fault> {
    if dialect.comments == CommentMark::Semicolon {
        return Ok(line.split_once(';').map_or((line, None), |(code, comment)| (code, Some(comment))));
    }
    let Some((code, rest)) = line.split_once('(') else {
        return match line.find(')') {
            None => Ok((line, None)),
            Some(_) => {
                Err((FindingCode::BadComment, quote(line), "a comment that begins before it ends".to_owned()))
            }
        };
    };
    match rest.split_once(')') {
        Some((comment, "")) if !comment.contains('(') => Ok((code, Some(comment))),
        _ => Err((
            FindingCode::BadComment,
            quote(line),
            "one comment, closed at the end of the line".to_owned(),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::Code;

    fn words(line: &str) -> Result<Vec<(char, f64)>, &'static str> {
        let mut words = Vec::new();
        match cut(line, &Dialect::GENERIC, &mut words) {
            (_, None) => Ok(words.iter().map(|w| (char::from(w.letter), w.number)).collect()),
            (_, Some((code, _, _))) => Err(code.as_str()),
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
