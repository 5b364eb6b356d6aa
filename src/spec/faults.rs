//! All faults of one text, in order.

use std::fmt;

use crate::spec::fault::{Fault, Severity};
use crate::spec::raw::RawSpec;
use crate::spec::render;
use crate::spec::source::{Source, boundary};

/// All faults of one source, in the order of their places. It prints without colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults {
    source: Source,
    list: Vec<Fault>,
}

impl Faults {
    /// Collects `list`, the faults of `source`; spans outside the text are drawn to its end.
    pub fn new(source: &Source, mut list: Vec<Fault>) -> Self {
        for fault in &mut list {
            let end = boundary(&source.text, fault.span.end);
            fault.span = boundary(&source.text, fault.span.start).min(end)..end;
        }
        list.sort_by_key(|fault| (fault.span.start, fault.span.end));
        Self { source: source.clone(), list }
    }

    /// The faults in the order of their places.
    pub fn list(&self) -> &[Fault] {
        &self.list
    }

    /// The key at which `fault` points, or its section: `star.points`, `stack.star[2].pitch`, `star`; `None` if it is at neither.
    pub fn key_of(&self, fault: &Fault) -> Option<String> {
        RawSpec::parse(&self.source.text).0.key_at(&fault.span)
    }

    /// The line of the text in which `fault` begins, from 1.
    pub fn line_of(&self, fault: &Fault) -> usize {
        1 + self.source.text.bytes().take(fault.span.start).filter(|byte| *byte == b'\n').count()
    }

    /// The text that contains them.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether at least one of them refuses the text.
    pub fn refuse(&self) -> bool {
        self.list.iter().any(|fault| fault.level == Severity::Error)
    }

    /// All faults for a terminal of `width` columns, with or without colours; `None` breaks no lines. [`fmt::Display`] gives the
    /// same without both.
    pub fn for_terminal(&self, width: Option<usize>, coloured: bool) -> String {
        render::for_terminal(&self.source, &self.list, width, coloured)
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&render::plain(&self.source, &self.list))
    }
}

impl std::error::Error for Faults {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::FaultCode;

    #[test]
    fn spans_are_drawn_into_the_text() {
        let source = Source::new("a", "µ = 1");
        #[expect(clippy::reversed_empty_ranges, reason = "this is what must do no harm")]
        let spans = [1..3, 100..200, 3..1, 2..usize::MAX];
        let faults =
            Faults::new(&source, spans.into_iter().map(|s| Fault::error(FaultCode::Name, s, "m")).collect());
        for fault in faults.list() {
            assert!(source.text.get(fault.span.clone()).is_some(), "{:?}", fault.span);
        }
        assert!(!faults.to_string().is_empty());
    }

    #[test]
    fn a_fault_is_at_a_key_or_a_section_and_in_a_line() {
        let text = "schema = 2\n[star]\npoints = 2\nwdith = 3\n[[stack.star]]\nindex = 1\n[[stack.star]]\nindex = 2\n\
                    pitch = 4\n[fog]\n";
        let faults = crate::spec::read(&Source::new("a", text)).expect_err("many");
        let found: Vec<_> = faults
            .list()
            .iter()
            .map(|fault| (faults.line_of(fault), faults.key_of(fault).unwrap_or_default()))
            .collect();
        let has =
            |line: usize, key: &str| assert!(found.contains(&(line, key.to_owned())), "{key}: {found:?}");
        has(1, "schema");
        has(2, "star"); // the missing key
        has(3, "star.points");
        has(4, "star.wdith");
        has(9, "stack.star[2].pitch");
        has(10, "fog");
    }

    #[test]
    fn faults_stand_in_the_order_of_their_places() {
        let source = Source::new("a", "a\nb\nc\n");
        let faults = Faults::new(
            &source,
            [4, 0, 2].map(|at| Fault::warning(FaultCode::Name, at..at + 1, "m")).into_iter().collect(),
        );
        assert_eq!(faults.list().iter().map(|f| f.span.start).collect::<Vec<_>>(), [0, 2, 4]);
        assert!(!faults.refuse());
        assert!(Faults::new(&source, vec![Fault::error(FaultCode::Name, 0..0, "m")]).refuse());
    }
}
