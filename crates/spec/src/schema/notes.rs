//! The meanings of keys, from the comments of the starter and of the profile `generic`.

use std::collections::BTreeMap;

use serde_json::Value;

/// The starter's note on a key.
pub(super) struct Note {
    /// In words, without the full stop.
    pub(super) meaning: String,
    /// The default, or an example.
    pub(super) value: Value,
    /// Whether the value is the default; else it is an example.
    pub(super) is_default: bool,
}

/// The starter's notes.
pub(super) struct Notes {
    /// By section and key.
    pub(super) keys: BTreeMap<(String, String), Note>,
    sections: BTreeMap<String, String>,
}

impl Notes {
    /// Reads `text`: sections below the words about them, keys before or below theirs.
    pub(super) fn read(text: &str) -> Self {
        let mut notes = Self { keys: BTreeMap::new(), sections: BTreeMap::new() };
        let (mut section, mut words_above) = (String::new(), Vec::new());
        for line in text.lines() {
            let (is_default, bare) = match line.strip_prefix("## ") {
                Some(bare) => (false, bare),
                None => (line.starts_with("# "), line.trim_start_matches("# ")),
            };
            let (code, words) = bare.split_once('#').map_or((bare, ""), |(code, words)| (code, words.trim()));
            // Indented text is an example inside a sentence.
            let code = if bare.starts_with(' ') { "" } else { code };
            if let Some(name) = code.trim().strip_prefix('[').map(|name| name.trim_matches(['[', ']'])) {
                // A section with a name of the user's: its keys are those of all such sections.
                let kind = if name.starts_with("process.") { "process" } else { name };
                kind.clone_into(&mut section);
                words_above.push(words);
                let section_words = words_above.join(" ").trim().to_owned();
                let _ = notes.sections.insert(section.clone(), section_words);
            } else if let Some((key, value)) =
                code.split_once(" = ").and_then(|(key, value)| Some((key, json_of(value)?)))
            {
                let meaning = if words.is_empty() { words_above.join(" ") } else { words.to_owned() };
                let note = Note { meaning: meaning.trim_end_matches('.').to_owned(), value, is_default };
                let _ = notes.keys.entry((section.clone(), key.to_owned())).or_insert(note);
            } else if line.starts_with("# ") {
                words_above.push(bare);
                continue;
            }
            words_above.clear();
        }
        notes
    }

    /// The note of `key` in `section`.
    pub(super) fn of_key(&self, (section, key): (&str, &str)) -> Option<&Note> {
        self.keys.get(&(section.to_owned(), key.to_owned()))
    }

    /// The note of the section itself; may be empty.
    pub(super) fn of_section(&self, name: &str) -> &str {
        self.sections.get(name).map_or("", String::as_str)
    }
}

/// A value of TOML that JSON writes in the same way; `None` for anything else, such as the words of a sentence.
fn json_of(value: &str) -> Option<Value> {
    serde_json::from_str(value.trim()).ok()
}
