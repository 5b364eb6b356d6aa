//! Keys whose values are texts, or words of a list.

use std::ops::Range;

use crate::FaultCode;
use crate::fault::{Fault, quoted};
use crate::name::{check_name, misleads};
use crate::section::Section;
use crate::shape::ValueShape;
use crate::unknown;

impl<'r> Section<'_, 'r> {
    /// A text in quotes and its place; `None` if it is absent or something else.
    pub(crate) fn text(&mut self, key: &'static str) -> Option<(&'r str, Range<usize>)> {
        self.word(key, ValueShape::Text)
    }

    /// A text in quotes; `wrong` returns what is allowed instead of a wrong one, which is a fault of `code`.
    pub(crate) fn checked_text(
        &mut self,
        key: &'static str,
        code: FaultCode,
        wrong: impl FnOnce(&str) -> Option<String>,
    ) -> Option<String> {
        let (text, _) = self.text(key)?;
        if let Some(allowed) = wrong(text) {
            self.refuse(code, key, format!("`{key}` is {}", quoted(text)), allowed);
        }
        Some(text.to_owned())
    }

    /// A path, or a name that a file may have; a wrong one is a fault of `code` with the words `allowed`.
    pub(crate) fn path(&mut self, key: &'static str, code: FaultCode, allowed: &str) -> Option<String> {
        self.checked_text(key, code, |path| is_no_path(path).then(|| allowed.to_owned()))
    }

    /// The key `name`, by the rules of [`check_name`].
    pub(crate) fn name(&mut self) -> Option<String> {
        self.checked_text("name", FaultCode::Name, |name| check_name(name).err())
    }

    /// A text of some shape.
    pub(crate) fn word(&mut self, key: &'static str, shape: ValueShape) -> Option<(&'r str, Range<usize>)> {
        let value = self.take(key, shape)?;
        match value.as_text() {
            Some(found) => Some((found, value.span.clone())),
            None => self.refuse_type(key, value, "must be a text in quotes"),
        }
    }

    /// A list of texts, each with its place; `None` if it is absent or something else.
    pub(crate) fn texts(&mut self, key: &'static str) -> Option<Vec<(&'r str, Range<usize>)>> {
        self.listed(key, ValueShape::Texts)
    }

    /// A list of texts of some shape.
    fn listed(&mut self, key: &'static str, shape: ValueShape) -> Option<Vec<(&'r str, Range<usize>)>> {
        let value = self.take(key, shape)?;
        let label = "must be a list of texts: [\"...\", \"...\"]";
        let Some(list) = value.as_list() else { return self.refuse_type(key, value, label) };
        list.iter()
            .map(|item| match item.as_text() {
                Some(text) => Some((text, item.span.clone())),
                None => self.refuse_type(key, item, label),
            })
            .collect()
    }

    /// One of `choices`, a word in quotes; `None` if it is absent or none of them.
    pub(crate) fn choice<T: Copy>(&mut self, key: &'static str, choices: &[(&'static str, T)]) -> Option<T> {
        let shape = ValueShape::Choice(choices.iter().map(|(name, _)| *name).collect());
        let (word, span) = self.word(key, shape)?;
        self.choice_of(key, (word, span), choices)
    }

    /// Some of `choices`, words in quotes in a list, without duplicates; `None` if the key is absent or one of its words is not a
    /// choice.
    pub(crate) fn choices<T: Copy + PartialEq>(
        &mut self,
        key: &'static str,
        choices: &[(&'static str, T)],
    ) -> Option<Vec<T>> {
        let shape = ValueShape::Choices(choices.iter().map(|(name, _)| *name).collect());
        let mut values = Vec::new();
        for word in self.listed(key, shape)? {
            let value = self.choice_of(key, word, choices)?;
            if !values.contains(&value) {
                values.push(value);
            }
        }
        Some(values)
    }

    /// The one of `choices` that `word` names; reports a word that is not a choice.
    fn choice_of<T: Copy>(
        &mut self,
        key: &'static str,
        (word, span): (&str, Range<usize>),
        choices: &[(&'static str, T)],
    ) -> Option<T> {
        if let Some((_, value)) = choices.iter().find(|(name, _)| *name == word) {
            return Some(*value);
        }
        let list = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
        let mut fault =
            Fault::error(FaultCode::UnknownChoice, span, format!("`{key}` is {}", quoted(word))).label(
                if choices.len() == 1 { format!("must be {list}") } else { format!("must be one of {list}") },
            );
        if let Some(suggestion) = unknown::nearest(word, choices.iter().map(|(name, _)| *name)) {
            fault = fault.help(format!("did you mean \"{suggestion}\"?"));
        }
        self.report(fault);
        None
    }
}

fn is_no_path(path: &str) -> bool {
    path.trim().is_empty() || path.chars().any(misleads)
}
