//! All faults of one text, in order; the faults of bytes that are no text.

use geom::order::sort_by_key;
use std::fmt;

use crate::fault::{Fault, NewSpec, Severity};
use crate::raw::RawSpec;
use crate::source::{SIZE_LIMIT, Source, boundary};
use crate::{FaultCode, render};

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
        sort_by_key(&mut list, |fault| (fault.span.start, fault.span.end));
        Self { source: source.clone(), list }
    }

    /// These faults and one more of the same text, if there is one.
    #[must_use]
    pub fn with_addition(self, addition: Option<Fault>) -> Self {
        Self::new(&self.source, self.list.into_iter().chain(addition).collect())
    }

    /// Adds the way to a new spec to the remedies of the faults that have one, in the words of the interface that shows them.
    #[must_use]
    pub fn offer(mut self, words: fn(NewSpec) -> &'static str) -> Self {
        for fault in &mut self.list {
            if let Some((new_spec, help)) = fault.new_spec.take().zip(fault.help.as_mut()) {
                *help = format!("{}; or {help}", words(new_spec));
            }
        }
        self
    }

    /// The faults in the order of their places.
    pub fn list(&self) -> &[Fault] {
        &self.list
    }

    /// The key at which `fault` points, or its section: `star.points`, `stack.star[2].pitch`, `star`; `None` if it is at neither.
    pub fn key_of(&self, fault: &Fault) -> Option<String> {
        RawSpec::parse(&self.source.text).0.key_at(&fault.span)
    }

    /// The line of the text in which `fault` begins, from 1; the last one if it is about what is not written.
    pub fn line_of(&self, fault: &Fault) -> usize {
        let text_before = self.source.text.trim_end_matches('\n').bytes().take(fault.span.start);
        1 + text_before.filter(|byte| *byte == b'\n').count()
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

impl Source {
    /// A source from the bytes of a file.
    ///
    /// # Errors
    /// If there are more than [`SIZE_LIMIT`] bytes, or if they are not UTF-8; the fault shows the first line that is not.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> Result<Self, Faults> {
        let name = name.into();
        if bytes.len() > SIZE_LIMIT {
            let message = format!("the file is larger than {} MiB", SIZE_LIMIT >> 20);
            let fault = Fault::error(FaultCode::TooLarge, 0..0, message)
                .label("a spec or a profile is a few kB of text")
                .help("is this the right file?");
            return Err(Faults::new(&Self::new(name, ""), vec![fault]));
        }
        match std::str::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, text)),
            Err(error) => {
                let start = error.valid_up_to();
                let byte = bytes.get(start).copied().unwrap_or_default();
                let line_end =
                    bytes[start..].iter().position(|b| *b == b'\n').map_or(bytes.len(), |n| start + n);
                let text = String::from_utf8_lossy(&bytes[..line_end]);
                let fault = Fault::error(
                    FaultCode::NotText,
                    start..start + 1,
                    format!("byte {} is {byte:#04x}: not UTF-8", start + 1),
                )
                .label("the text ends here")
                .help("save the file as UTF-8");
                Err(Faults::new(&Self::new(name, text), vec![fault]))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FaultCode;

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
        let faults = crate::read(&Source::new("a", text)).expect_err("many");
        let places: Vec<_> = faults
            .list()
            .iter()
            .map(|fault| (faults.line_of(fault), faults.key_of(fault).unwrap_or_default()))
            .collect();
        for (line, key) in [
            (1, "schema"),
            (2, "star"), // the missing key
            (3, "star.points"),
            (4, "star.wdith"),
            (9, "stack.star[2].pitch"),
            (10, "fog"),
        ] {
            assert!(places.contains(&(line, key.to_owned())), "{key}: {places:?}");
        }
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

    fn remedies(faults: &Faults) -> String {
        faults.list().iter().filter_map(|fault| fault.help.clone()).collect()
    }

    #[test]
    fn an_interface_offers_a_new_spec_in_its_own_words() {
        for (text, remedy) in
            [("", "Starter; or write for instance"), ("<svg/>", "FromDrawing; or name a TOML file")]
        {
            let faults = crate::read(&Source::new("a", text)).expect_err("no spec");
            assert!(!remedies(&faults).contains("stargrip-cam"), "{faults}");
            let offered = faults.offer(|new_spec| match new_spec {
                NewSpec::Starter => "Starter",
                NewSpec::FromDrawing => "FromDrawing",
            });
            assert!(remedies(&offered).contains(remedy), "{offered}");
        }
    }
}

#[cfg(test)]
mod bytes_tests {
    use super::*;

    #[test]
    fn text_is_taken_as_it_is() {
        let source = Source::from_bytes("a.toml", "schema = 1\r\n# µ\n".as_bytes()).expect("UTF-8");
        assert_eq!(source, Source::new("a.toml", "schema = 1\r\n# µ\n"));
    }

    #[test]
    fn the_line_that_is_not_utf8_is_named() {
        let faults =
            Source::from_bytes("a.toml", b"schema = 1\nname = \"\xe9t\xe9\"\nx").expect_err("Latin-1");
        assert_eq!(faults.list()[0].code, "not-text");
        assert!(faults.to_string().contains("a.toml:2:9"), "{faults}");
    }

    #[test]
    fn a_file_above_the_limit_is_refused_unread() {
        assert!(Source::from_bytes("a", &vec![b'\n'; SIZE_LIMIT]).is_ok());
        let faults = Source::from_bytes("a", &vec![0xff; SIZE_LIMIT + 1]).expect_err("one byte too many");
        assert_eq!(faults.list()[0].code, "too-large");
        assert!(faults.to_string().contains("larger than 1 MiB"), "{faults}");
    }
}
