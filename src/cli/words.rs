//! Options that take one of the words of a table; and lists that end early.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// The parser of the words in `table`, each with its `help`; no help if that is empty.
pub(super) fn words<T: Copy + Send + Sync + 'static>(
    table: &'static [(&'static str, T)],
    help: &'static [&'static str],
) -> impl TypedValueParser<Value = T> {
    let possible_value = |(i, (word, _)): (usize, &(&'static str, T))| match help.get(i) {
        Some(help) => PossibleValue::new(*word).help(*help),
        None => PossibleValue::new(*word),
    };
    PossibleValuesParser::new(table.iter().enumerate().map(possible_value))
        .try_map(|word| value_of(table, &word).ok_or("no such word"))
}

/// The value of `word`.
pub(super) fn value_of<T: Copy>(table: &[(&str, T)], word: &str) -> Option<T> {
    table.iter().find(|(own, _)| *own == word).map(|(_, value)| *value)
}

/// How many of `number` things are beyond the first `limit`, which are listed.
pub(super) fn count_beyond(number: usize, limit: usize) -> Option<usize> {
    number.checked_sub(limit).filter(|more| *more > 0)
}
