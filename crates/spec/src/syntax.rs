//! Messages for syntax errors of TOML, in plain words.

use std::ops::Range;

use crate::FaultCode;
use crate::fault::{Fault, quoted};
use crate::source::boundary;
use crate::value::{RawKind, RawTable, RawValue};

/// Number of syntax errors from which a text is taken for another kind of file, not for a spec with slips.
pub(super) const FLOOD: usize = 13;

/// Errors that are reported of a flood: the first names the cause.
const REPORTED: usize = 3;

/// Quotes of typographers, and the plain ones that TOML has.
const QUOTES: [(char, char); 7] = [
    ('\u{201c}', '"'),
    ('\u{201d}', '"'),
    ('\u{201e}', '"'),
    ('\u{2018}', '\''),
    ('\u{2019}', '\''),
    ('\u{ab}', '"'),
    ('\u{bb}', '"'),
];

/// A fault for each of `errors`, which the parser found in `text` and between which it read `root`; of a flood the first few.
pub(super) fn faults(errors: &[toml::de::Error], text: &str, root: &RawTable) -> Vec<Fault> {
    if errors.len() < FLOOD {
        let own = (0..errors.len()).filter(|i| !follows(&errors[..*i], &errors[*i], text));
        return own.map(|i| fault(&errors[i], text, root)).collect();
    }
    let mut faults: Vec<Fault> = errors.iter().take(REPORTED).map(|error| fault(error, text, root)).collect();
    if let Some(last) = faults.last_mut() {
        let note =
            format!("there are {} more syntax errors: is this the right file?", errors.len() - REPORTED);
        last.help = Some(last.help.take().map_or(note.clone(), |help| format!("{help}; {note}")));
    }
    faults
}

/// Whether `error` follows from one of the errors `before`: in the same line, or a duplicate key in a duplicate section.
fn follows(before: &[toml::de::Error], error: &toml::de::Error, text: &str) -> bool {
    let start = |error: &toml::de::Error| error.span().unwrap_or(0..0).start;
    let is_duplicate = |error: &toml::de::Error| error.message() == "duplicate key";
    before.iter().any(|other| {
        // The errors are in no order.
        let (from, to) = (start(other), start(error));
        let between = text.get(from.min(to)..from.max(to)).unwrap_or_default();
        match (is_duplicate(other), is_duplicate(error)) {
            (true, true) => {
                let mut lines = between.lines().skip(1).chain([line_of(text, to)]);
                from < to && is_header(line_of(text, from)) && !lines.any(is_header)
            }
            (false, false) => !between.contains('\n'),
            _ => false,
        }
    })
}

/// Whether `line` opens a section.
fn is_header(line: &str) -> bool {
    line.trim_start().starts_with('[')
}

/// The parser's messages have the form "found, expected allowed".
fn fault(error: &toml::de::Error, text: &str, root: &RawTable) -> Fault {
    let span = error.span().unwrap_or(0..0);
    let line = line_of(text, span.start);
    let as_error = |found: &str, span: &Range<usize>| Fault::error(FaultCode::Syntax, span.clone(), found);
    let value = line.split_once('=').map(|(_, value)| value);
    let begins = |quote: char| value.is_some_and(|value| value.trim_start().starts_with(quote));
    if let Some((curly, plain)) = QUOTES.into_iter().find(|(curly, _)| begins(*curly)) {
        let plainly = |c| QUOTES.iter().find(|(curly, _)| *curly == c).map_or(c, |(_, plain)| *plain);
        let right: String = line.chars().map(plainly).collect();
        let found = format!("the quotes are typographic, {curly} is U+{:04X}", u32::from(curly));
        return as_error(&found, &span)
            .label(format!("plain quotes are needed: {plain}"))
            .help(format!("write {}", right.trim()));
    }
    if let Some(right) = with_point(line) {
        return as_error("a number with a decimal comma", &span)
            .label("a decimal point is needed")
            .help(format!("write {right}"));
    }
    let value = value.and_then(|value| value.split('#').next());
    match error.message().split_once(", expected ") {
        Some(("string values must be quoted", _)) if value.is_some_and(|value| value.trim().is_empty()) => {
            as_error("no value after `=`", &span).label("write the value here, or delete the line")
        }
        // A quantity without quotes.
        Some((found, "literal string")) => as_error(found, &span).label("write it in quotes: \"...\""),
        Some((found, allowed)) => as_error(found, &span).label(format!("expected {allowed}")),
        None if error.message() == "duplicate key" => duplicate(text, &span, root),
        None => as_error(error.message(), &span),
    }
}

/// A key that is written twice, and where first.
fn duplicate(text: &str, span: &Range<usize>, root: &RawTable) -> Fault {
    let key = text.get(span.clone()).unwrap_or_default();
    let message = format!("duplicate key {}", quoted(key));
    let fault = Fault::error(FaultCode::Syntax, span.clone(), message);
    let name = key.trim_matches(['"', '\'']);
    // Sections do not interleave: the latest one of this name before is the one of this section. Of a section that is opened
    // twice the parser keeps the later place.
    let header = line_of(text, span.start).trim();
    let written = latest(root, name, span.start).map(|at| 1 + text[..at].matches('\n').count());
    let opened = || text.lines().position(|line| line.trim() == header).map(|before| 1 + before);
    let here = 1 + text.get(..span.start).map_or(0, |before| before.matches('\n').count());
    match written.or_else(opened).filter(|line| *line < here) {
        Some(line) => fault.label(format!("line {line} has it already")).help("delete one of the two"),
        None => fault.label("this key occurs earlier"),
    }
}

/// The last place before `end` at which a key `name` is written.
fn latest(table: &RawTable, name: &str, end: usize) -> Option<usize> {
    let mut found = None;
    for entry in &table.0 {
        if entry.key == name && entry.key_span.start < end {
            found = found.max(Some(entry.key_span.start));
        }
        found = found.max(within(&entry.value, name, end));
    }
    found
}

fn within(value: &RawValue, name: &str, end: usize) -> Option<usize> {
    match &value.kind {
        RawKind::Table(table) => latest(table, name, end),
        RawKind::List(list) => list.iter().filter_map(|item| within(item, name, end)).max(),
        _ => None,
    }
}

/// The line around byte `at`.
fn line_of(text: &str, at: usize) -> &str {
    let at = boundary(text, at);
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let end = text[at..].find('\n').map_or(text.len(), |length| at + length);
    &text[start..end]
}

/// The line with a point, if its value is a bare number with a decimal comma.
fn with_point(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next()?.trim();
    let (whole, part) = value.split_once(',')?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let sound = is_number(whole.trim_start_matches(['+', '-'])) && is_number(part);
    sound.then(|| format!("{} = {whole}.{part}", key.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw::RawSpec;

    fn first(text: &str) -> Fault {
        RawSpec::parse(text).1.into_iter().next().unwrap_or_else(|| panic!("no fault in {text}"))
    }

    #[test]
    fn typographers_quotes_are_named_with_what_to_write() {
        for text in
            ["a = 1\nb = \u{201c}50 mm\u{201d}\n", "b = \u{201e}50 mm\u{201c}", "b = \u{ab}50 mm\u{bb}"]
        {
            let fault = first(text);
            assert!(fault.message.contains("typographic") && fault.message.contains("U+"), "{fault:?}");
            assert_eq!(
                fault.help.as_deref().map(|help| help.split(';').next().unwrap_or_default()),
                Some("write b = \"50 mm\"")
            );
        }
    }

    #[test]
    fn a_decimal_comma_is_named_with_what_to_write() {
        let fault = first("[load]\nfriction = 0,5 # bare\n");
        assert!(fault.message.contains("decimal comma"), "{fault:?}");
        assert!(fault.help.is_some_and(|help| help.starts_with("write friction = 0.5")));
        assert_eq!(with_point("a = [1,2]"), None);
        assert_eq!(with_point("a = 1,2,3"), None);
    }

    #[test]
    fn a_duplicate_says_where_the_first_is() {
        let text = "kerf = 1\n[cut]\nkerf = 2\n[frame]\nx = 1\nkerf = 3\ny = 2\nkerf = 4\n[cut]\n";
        let (_, faults) = RawSpec::parse(text);
        assert_eq!(faults.len(), 2, "{faults:?}");
        assert_eq!(
            (faults[0].message.as_str(), faults[0].label.as_str()),
            ("duplicate key `kerf`", "line 6 has it already")
        );
        assert_eq!(
            (faults[1].message.as_str(), faults[1].label.as_str()),
            ("duplicate key `cut`", "line 2 has it already")
        );
    }

    #[test]
    fn a_flood_is_counted() {
        let (_, faults) = RawSpec::parse(&"?\n".repeat(50));
        assert_eq!(faults.len(), REPORTED);
        assert!(
            faults
                .last()
                .and_then(|fault| fault.help.as_ref())
                .is_some_and(|help| help.contains("more syntax errors"))
        );
    }

    #[test]
    fn a_line_is_found_wherever_one_asks() {
        for at in 0..20 {
            let _ = line_of("µ = é\r\n€\n", at);
        }
        assert_eq!(line_of("a\nbc\nd", 3), "bc");
    }
}
