//! Faults as a person reads them: file, line, caret, what was found, what is allowed, a hint.

use annotate_snippets::{AnnotationKind, Level as Tone, Renderer, Snippet};

use crate::spec::fault::{Fault, Severity};
use crate::spec::name::misleads;
use crate::spec::source::{Source, boundary};

/// Most faults shown; a wrong file has thousands, and nobody reads them.
const SHOWN: usize = 30;

/// How much of a line is shown behind the place of its fault, bytes: more than a terminal is wide.
const ROOM: usize = 500;

/// All of `faults`, which `source` has, without colour.
pub(super) fn plain(source: &Source, faults: &[Fault]) -> String {
    render(source, faults, &Renderer::plain())
}

/// All of `faults`, which `source` has, with the colours of a terminal.
pub(super) fn coloured(source: &Source, faults: &[Fault]) -> String {
    render(source, faults, &Renderer::styled())
}

fn render(source: &Source, faults: &[Fault], renderer: &Renderer) -> String {
    let mut text = String::new();
    for fault in faults.iter().take(SHOWN) {
        text.push_str(&one(source, fault, renderer));
        text.push_str("\n\n");
    }
    if !faults.is_empty() {
        text.push_str(&summary(source, faults));
        text.push('\n');
    }
    text
}

fn one(source: &Source, fault: &Fault, renderer: &Renderer) -> String {
    let text = &source.text;
    // Only the line is handed on: the renderer's work grows with what it is given, once for each fault.
    let start = text[..fault.span.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[fault.span.start..].find('\n').map_or(text.len(), |n| fault.span.start + n);
    let line = text[start..end].trim_end_matches('\r');
    // Of a line without end not all is worth its memory, of which the renderer needs many times its length.
    let line = &line[..boundary(line, (fault.span.start - start).saturating_add(ROOM))];
    let local = |at: usize| at.min(end).saturating_sub(start).min(line.len());
    let (start_here, end_here) = (local(fault.span.start), local(fault.span.end));
    let before = visible(&line[..start_here]);
    let marked = before.len() + visible(&line[start_here..end_here]).len();
    let shown = visible(line);
    let tone = match fault.level {
        Severity::Error => Tone::ERROR,
        Severity::Warning => Tone::WARNING,
    };
    let snippet = Snippet::source(shown)
        .line_start(1 + text[..start].matches('\n').count())
        .path(shown_name(source))
        .annotation(AnnotationKind::Primary.span(before.len()..marked).label(told(&fault.label)));
    let mut group = tone.primary_title(told(&fault.message)).id(fault.code).element(snippet);
    if let Some(help) = &fault.help {
        group = group.element(Tone::HELP.message(told(help)));
    }
    renderer.render(&[group])
}

/// "spec.toml: 2 errors, 1 warning".
fn summary(source: &Source, faults: &[Fault]) -> String {
    let count = |level| faults.iter().filter(|fault| fault.level == level).count();
    let phrase = |n: usize, word: &str| match n {
        0 => None,
        1 => Some(format!("1 {word}")),
        n => Some(format!("{n} {word}s")),
    };
    let parts = [phrase(count(Severity::Error), "error"), phrase(count(Severity::Warning), "warning")];
    let parts = parts.into_iter().flatten().collect::<Vec<_>>().join(", ");
    let cut = if faults.len() > SHOWN { format!(", the first {SHOWN} shown") } else { String::new() };
    format!("{}: {parts}{cut}", shown_name(source))
}

/// `text` with a mark in place of what would command a terminal or turn the text around and is not ASCII; the renderer has
/// pictures for what is, but lets the other control characters through.
fn visible(text: &str) -> String {
    let mark = |c: char| if misleads(c) && !c.is_ascii() { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(mark).collect()
}

/// What is said of a fault, which may repeat what stands in the text: all of that is marked.
fn told(text: &str) -> String {
    let mark = |c: char| if misleads(c) && c != '\n' { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(mark).collect()
}

/// The source's name without what would command a terminal.
fn shown_name(source: &Source) -> String {
    source.name.chars().map(|c| if misleads(c) { '?' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::FaultCode;

    #[test]
    fn a_line_cannot_command_a_terminal() {
        let all: String = (0..=0x2100).filter_map(char::from_u32).filter(|c| misleads(*c)).collect();
        for c in all.chars().filter(|c| *c != '\n') {
            let source = Source::new("a", format!("{c}é = {c}1\n"));
            let at = source.text.find('1').expect("a digit");
            let faults = [Fault::error(FaultCode::Name, at..at + 1, "m").label("here")];
            let text = plain(&source, &faults);
            let repeated = faults.map(|fault| Fault {
                message: format!("m{c}"),
                ..fault.label(format!("l{c}")).help(format!("h{c}"))
            });
            assert!(!plain(&source, &repeated).contains(|c| misleads(c) && c != '\n'), "{c:?}");
            assert!(!text.contains(|c| misleads(c) && c != '\n'), "{text:?}");
            assert!(c.is_ascii() || text.contains("1 | \u{fffd}é = \u{fffd}1\n  |       ^ here"), "{text}");
        }
    }
}
