//! The terminal: its width, its colours, and line breaks.

use std::env;
use std::io::IsTerminal;

/// Narrowest terminal for which lines are broken: below it every line would hold a single word.
const NARROWEST: usize = 30;

/// The width in columns at which lines for `stream` are broken; `None` for a pipe or a file, whose reader needs unbroken lines.
pub(super) fn width(stream: &impl IsTerminal) -> Option<usize> {
    if !stream.is_terminal() {
        return None;
    }
    let stated_columns = env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    let measured_columns = || terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    stated_columns.or_else(measured_columns).filter(|columns| *columns > 0)
}

/// Whether output to `stream` may have colours.
pub(super) fn has_colours(stream: &impl IsTerminal) -> bool {
    let unwanted = env::var_os("NO_COLOR").is_some_and(|wish| !wish.is_empty());
    takes_lines_back(stream) && !unwanted
}

/// Whether a line on `stream` can be erased: it is a terminal, and not a dumb one.
pub(super) fn takes_lines_back(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// `text` in lines of at most `width` columns; all but the first begin with `indent` blanks. Blanks between words are kept except at line
/// ends. A longer word is not broken: it may be a path to copy.
pub(super) fn wrapped(text: &str, indent: usize, width: Option<usize>) -> String {
    let Some(width) = width.map(|width| width.max(NARROWEST)) else { return text.to_owned() };
    let (mut lines, mut column, mut blanks) = (String::new(), 0, 0);
    for word in text.split(' ') {
        let length = word.chars().count();
        let is_first = lines.trim_start().is_empty();
        if length > 0 && !is_first && column + blanks + length > width {
            lines.push('\n');
            blanks = indent;
            column = 0;
        }
        if length > 0 {
            lines.extend(std::iter::repeat_n(' ', blanks));
            lines.push_str(word);
            column += blanks + length;
            blanks = 0;
        }
        blanks += 1;
    }
    lines
}

/// Every line of `text` in lines of at most `width` columns; continuation lines are indented by 2 more columns.
pub(super) fn fitted(text: &str, width: Option<usize>) -> String {
    let lines = text.split('\n').map(|line| {
        let indent = line.chars().take_while(|c| *c == ' ').count() + 2;
        wrapped(line, indent, width)
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_no_wider_than_the_terminal_and_lose_nothing() {
        let text = "  - the lowest feed of this machine is unknown: run `stargrip-cam feedcheck`, and measure the time";
        for width in 1..120 {
            let lines = wrapped(text, 4, Some(width));
            let widest = lines.lines().map(|line| line.chars().count()).max().expect("a line");
            assert!(widest <= width.max(NARROWEST), "{width}: {lines}");
            let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
            assert_eq!(words(&lines), words(text));
            assert!(
                lines.starts_with("  - the") && lines.lines().skip(1).all(|line| line.starts_with("    "))
            );
        }
    }

    #[test]
    fn columns_stay_where_they_are() {
        let text = "label      what stands beside it and goes on\n  a  table  row";
        assert_eq!(fitted(text, Some(80)), text);
        assert_eq!(fitted(text, None), text);
        let lines = "label      what stands beside\n  it and goes on\n  a  table  row";
        assert_eq!(fitted(text, Some(30)), lines);
        assert_eq!(
            wrapped("label      what stands beside it", 11, Some(30)),
            "label      what stands beside\n           it"
        );
        for text in ["", " ", "\n", "a\n\nb\n"] {
            assert_eq!(fitted(text, Some(40)), text.replace("\n ", "\n").trim_matches(' '), "{text:?}");
        }
    }

    #[test]
    fn who_reads_a_pipe_gets_whole_lines_and_a_path_stays_whole() {
        let text = "a ".repeat(200) + "/a/very/long/path/that/is/longer/than/the/terminal/is/wide";
        assert_eq!(wrapped(&text, 0, None), text);
        assert!(
            wrapped(&text, 0, Some(40)).lines().any(|line| line.starts_with("/a/very") && line.len() > 40)
        );
    }
}
