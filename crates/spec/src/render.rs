//! Faults as a person reads them: file, line, caret, the finding, the allowed values, a hint.

use std::collections::BTreeMap;
use std::fmt::Write;

use annotate_snippets::{AnnotationKind, Group, Level as Tone, Message, Origin, Renderer, Snippet};

use crate::fault::{Fault, Severity};
use crate::name::misleads;
use crate::source::{Source, boundary};
use crate::{Code, FaultCode};

/// Most faults shown; a wrong file has thousands.
const SHOWN: usize = 30;

/// Most faults of one code shown that a drawing has.
const ALIKE: usize = 3;

/// Length of a line shown behind the place of its fault, bytes: more than a terminal is wide.
const ROOM: usize = 500;

/// Columns before a line of text: a line's number of at most three digits, blanks and a bar.
const MARGIN: usize = 6;

/// Narrowest terminal for which lines are broken, columns.
const NARROWEST: usize = 40;

/// All of `faults`, which `source` has, without colour.
pub(super) fn plain(source: &Source, faults: &[Fault]) -> String {
    render(source, faults, &Renderer::plain(), None)
}

/// All of `faults`, which `source` has, for a terminal of `width` columns, with or without colours; `None` breaks no lines.
pub(super) fn for_terminal(
    source: &Source,
    faults: &[Fault],
    width: Option<usize>,
    coloured: bool,
) -> String {
    let renderer = if coloured { Renderer::styled() } else { Renderer::plain() };
    let width = width.map(|width| width.max(NARROWEST));
    let renderer = width.map_or(renderer.clone(), |width| renderer.term_width(width));
    render(source, faults, &renderer, width)
}

fn render(source: &Source, faults: &[Fault], renderer: &Renderer, width: Option<usize>) -> String {
    let mut text = String::new();
    let mut alike: BTreeMap<&str, usize> = BTreeMap::new();
    let mut listed: Vec<&Fault> = Vec::new();
    for fault in faults {
        let count = alike.entry(fault.code).or_default();
        *count += usize::from(fault.drawn.is_some());
        if *count <= ALIKE {
            listed.push(fault);
        }
    }
    for fault in listed.iter().take(SHOWN) {
        text.push_str(&rendered(source, fault, renderer, width));
        text.push_str("\n\n");
    }
    if !faults.is_empty() {
        text.push_str(&summary(source, faults, listed.len()));
        let unlisted = alike.iter().filter(|(_, count)| **count > ALIKE);
        let rest: Vec<String> =
            unlisted.map(|(code, count)| format!("{} more {code}", count - ALIKE)).collect();
        if !rest.is_empty() {
            let _ = write!(text, "; not shown: {}", rest.join(", "));
        }
        text.push('\n');
    }
    text
}

fn rendered(source: &Source, fault: &Fault, renderer: &Renderer, width: Option<usize>) -> String {
    let text = &source.text;
    let tone = match fault.level {
        Severity::Error => Tone::ERROR,
        Severity::Warning => Tone::WARNING,
    };
    // Text behind "error[code]: " and behind the longest "  = help: ".
    let head = "warning[]: ".len() + fault.code.len();
    let title = tone.primary_title(marked_text(&broken_lines(&fault.message, width, head))).id(fault.code);
    // A fault of a missing section has no line to show; one of the syntax may be at the end of the last line.
    let is_at_line = fault.code == FaultCode::Syntax.as_str() && !text.is_empty() && !text.ends_with('\n');
    if fault.span.is_empty() && fault.span.start == text.len() && !is_at_line {
        let mut group = title.element(Origin::path(shown_name(source)));
        if !fault.label.is_empty() {
            group = group.element(note(Tone::NOTE, &fault.label, width));
        }
        return renderer.render(&[with_help(group, fault, width)]);
    }
    // Only the line is handed on: the renderer's work grows with the length of its input, once for each fault.
    let start = text[..fault.span.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[fault.span.start..].find('\n').map_or(text.len(), |n| fault.span.start + n);
    let line = text[start..end].trim_end_matches('\r');
    // A very long line is cut: the renderer needs many times its length in memory.
    let line = &line[..boundary(line, (fault.span.start - start).saturating_add(ROOM))];
    let [start_here, end_here] =
        [fault.span.start, fault.span.end].map(|place| place.min(end).saturating_sub(start).min(line.len()));
    let head_of_line = visible(&line[..start_here]);
    let marked = head_of_line.len() + visible(&line[start_here..end_here]).len();
    let visible_line = visible(line);
    // Beside the caret is room for a label that ends within the terminal; another one goes below.
    let column = visible_line[..marked].chars().count() + MARGIN + 1;
    let fits = width.is_none_or(|width| column + fault.label.chars().count() <= width);
    let label_beside = if fits { marked_text(&fault.label) } else { String::new() };
    let snippet = Snippet::source(visible_line)
        .line_start(1 + text[..start].matches('\n').count())
        .path(shown_name(source))
        .annotation(AnnotationKind::Primary.span(head_of_line.len()..marked).label(label_beside));
    let mut group = title.element(snippet);
    if !fits {
        group = group.element(note(Tone::NOTE, &fault.label, width));
    }
    renderer.render(&[with_help(group, fault, width)])
}

/// A line below a fault.
fn note(tone: Tone<'static>, text: &str, width: Option<usize>) -> Message<'static> {
    tone.message(marked_text(&broken_lines(text, width, MARGIN + "= help: ".len())))
}

fn with_help<'a>(group: Group<'a>, fault: &Fault, width: Option<usize>) -> Group<'a> {
    match &fault.help {
        Some(help) => group.element(note(Tone::HELP, help, width)),
        None => group,
    }
}

/// `text` broken between words so that, behind `head` columns, no line is wider than `width`; a longer word stays whole.
fn broken_lines(text: &str, width: Option<usize>, head: usize) -> String {
    let Some(room) = width.map(|width| width.saturating_sub(head)) else { return text.to_owned() };
    let (mut lines, mut column) = (String::new(), 0);
    for word in text.split(' ') {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > room {
            lines.push('\n');
            column = 0;
        } else if !lines.is_empty() {
            lines.push(' ');
            column += 1;
        }
        lines.push_str(word);
        column += length;
    }
    lines
}

/// "spec.toml: 2 errors, 1 warning".
fn summary(source: &Source, faults: &[Fault], listed: usize) -> String {
    let parts =
        [(Severity::Error, "error"), (Severity::Warning, "warning")].map(|(level, word)| {
            match faults.iter().filter(|fault| fault.level == level).count() {
                0 => None,
                1 => Some(format!("1 {word}")),
                n => Some(format!("{n} {word}s")),
            }
        });
    let parts = parts.into_iter().flatten().collect::<Vec<_>>().join(", ");
    let cut = if listed > SHOWN { format!(", the first {SHOWN} shown") } else { String::new() };
    format!("{}: {parts}{cut}", shown_name(source))
}

/// `text` with a mark in place of characters outside ASCII that command a terminal or turn the text around; the renderer has
/// pictures for those in ASCII, but lets the other control characters through.
fn visible(text: &str) -> String {
    let mark = |c: char| if misleads(c) && !c.is_ascii() { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(mark).collect()
}

/// The text of a fault, in which misleading characters of the source are marked.
fn marked_text(text: &str) -> String {
    let mark = |c: char| if misleads(c) && c != '\n' { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(mark).collect()
}

/// The source's name without characters that command a terminal.
fn shown_name(source: &Source) -> String {
    source.name.chars().map(|c| if misleads(c) { '?' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Faults;

    #[test]
    fn lines_end_between_words_and_within_the_terminal() {
        let text = "schema = 1\n[star]\npoints = 5\ntip_angle = \"30 deg\"      # a comment that goes on and on, far beyond the right edge\n";
        let source = Source::new("a.toml", text);
        let start = text.find("\"30").expect("a value");
        let message = "a star of 9 points with an inner radius of 50 mm, a tube width of 30 mm and a tip angle of 30 deg has no arms";
        let label = "at most 7 points, an inner radius of at least 81.4 mm, or a tube width of at most 18.2 mm and a tip angle of 60 deg";
        let fault = Fault::error(FaultCode::Name, start..start + 8, message).label(label).help(label);
        for width in [40, 60, 80, 100] {
            let text = for_terminal(&source, std::slice::from_ref(&fault), Some(width), false);
            let widest = text.lines().map(|line| line.chars().count()).max().expect("lines");
            assert!(widest <= width, "{width}: {widest}\n{text}");
            let words: Vec<&str> = text.split_whitespace().collect();
            for word in message.split(' ').chain(label.split(' ')) {
                assert!(words.contains(&word), "{width}: {word}\n{text}");
            }
        }
    }

    #[test]
    fn what_is_not_written_has_no_caret() {
        for text in ["schema = 1\n", "schema = 1"] {
            let source = Source::new("a.toml", text);
            let fault = Fault::warning(FaultCode::Name, text.len()..text.len(), "m").label("what to write");
            let faults = Faults::new(&source, vec![fault]);
            let text = faults.to_string();
            assert!(
                text.contains("--> a.toml\n") && text.contains("what to write") && !text.contains('^'),
                "{text}"
            );
            let fault = &faults.list()[0];
            assert_eq!((faults.line_of(fault), faults.key_of(fault)), (1, None));
        }
    }

    #[test]
    fn a_line_cannot_command_a_terminal() {
        let misleading: String = (0..=0x2100).filter_map(char::from_u32).filter(|c| misleads(*c)).collect();
        for c in misleading.chars().filter(|c| *c != '\n') {
            let source = Source::new("a", format!("{c}é = {c}1\n"));
            let digit = source.text.find('1').expect("a digit");
            let faults = [Fault::error(FaultCode::Name, digit..digit + 1, "m").label("here")];
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
