//! Syntax errors of TOML: the parser's text with our code and its place.

use std::collections::BTreeMap;

use crate::FaultCode;
use crate::fault::Fault;
use crate::source::boundary;

/// Number of syntax errors from which a text is taken for another kind of file, not for a spec with slips.
pub(super) const FLOOD: usize = 13;

/// Errors that are reported of a flood: the first names the cause.
const REPORTED: usize = 3;

/// A fault for each line of `text` in which the parser found one of `errors`: the first, of which the others mostly follow; of a flood the
/// first few lines.
pub(super) fn faults(errors: &[toml::de::Error], text: &str) -> Vec<Fault> {
    let mut by_line: BTreeMap<usize, Fault> = BTreeMap::new();
    // The parser gives its errors in no order.
    for error in errors {
        let span = error.span().unwrap_or(0..0);
        let start = boundary(text, span.start);
        let line = text[..start].rfind('\n').map_or(0, |end| end + 1);
        if by_line.get(&line).is_none_or(|first| start < first.span.start) {
            let _ = by_line.insert(line, Fault::error(FaultCode::Syntax, span, error.message()));
        }
    }
    let mut faults: Vec<Fault> = by_line.into_values().collect();
    if errors.len() >= FLOOD {
        faults.truncate(REPORTED);
        if let Some(last) = faults.last_mut() {
            let rest = errors.len() - REPORTED;
            last.help = Some(format!("there are {rest} more syntax errors: is this the right file?"));
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw::RawSpec;

    fn places(text: &str) -> Vec<(usize, String)> {
        let (_, faults) = RawSpec::parse(text);
        let places = faults.into_iter().map(|fault| {
            let line = 1 + text[..fault.span.start].matches('\n').count();
            (line, fault.message)
        });
        places.collect()
    }

    #[test]
    fn a_line_has_the_first_of_its_errors() {
        let text = "a = 1\nb = 50 mm\nc = \u{201c}50 mm\u{201d}\nd = 0,5\ne = \na = 2\n[f\n";
        let lines: Vec<usize> = places(text).into_iter().map(|(line, _)| line).collect();
        assert_eq!(lines, [2, 3, 4, 5, 6, 7], "{:?}", places(text));
        assert_eq!(places("a = 1\na = 2\n"), [(2, "duplicate key".to_owned())]);
    }

    #[test]
    fn a_flood_is_counted() {
        let (_, faults) = RawSpec::parse(&"?\n".repeat(50));
        assert_eq!(faults.len(), REPORTED);
        let help = faults[2].help.as_deref().unwrap_or_default();
        assert!(help.contains("more syntax errors"), "{help}");
    }
}
