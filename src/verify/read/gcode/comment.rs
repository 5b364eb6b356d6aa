//! Structured comments: `; key: word=value word=value`.

/// A comment of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Line, from 1.
    pub line: usize,
    /// The text behind the semicolon, trimmed.
    pub text: String,
}

impl Comment {
    /// The key, if the comment is structured: the text before the first colon, when each word after it is `word=value`.
    pub fn key(&self) -> Option<&str> {
        let (key, rest) = self.text.split_once(':')?;
        let words = !rest.trim().is_empty() && rest.split_whitespace().all(|word| word.contains('='));
        (words && !key.is_empty()).then(|| key.trim())
    }

    /// The value of `word` in a structured comment.
    pub fn word(&self, word: &str) -> Option<&str> {
        let _ = self.key()?;
        let (_, rest) = self.text.split_once(':')?;
        rest.split_whitespace().filter_map(|w| w.split_once('=')).find(|(k, _)| *k == word).map(|(_, v)| v)
    }

    /// The value of `word` as a finite number.
    pub fn number(&self, word: &str) -> Option<f64> {
        self.word(word).and_then(crate::verify::read::number::value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comment(text: &str) -> Comment {
        Comment { line: 1, text: text.to_owned() }
    }

    #[test]
    fn key_and_words() {
        let heat = comment("heat: temperature_C=200 by=operator");
        assert_eq!(heat.key(), Some("heat"));
        assert_eq!(heat.number("temperature_C"), Some(200.0));
        assert_eq!(heat.word("by"), Some("operator"));
        assert_eq!(heat.word("speed"), None);
    }

    #[test]
    fn prose_has_no_key() {
        for text in
            ["", "set the station to 200 C: then press start", "name:", ": a=1", "end of program, 7 lines"]
        {
            assert_eq!(comment(text).key(), None, "{text}");
            assert_eq!(comment(text).word("a"), None);
        }
    }

    #[test]
    fn a_value_that_is_no_number() {
        for value in ["nan", "inf", "1e99", "", "hot"] {
            assert_eq!(comment(&format!("heat: temperature_C={value}")).number("temperature_C"), None);
        }
    }
}
