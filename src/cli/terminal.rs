//! The terminal: how wide it is, whether it has colours, and where lines are broken.

use std::env;
use std::io::IsTerminal;

/// Narrowest terminal for which lines are broken: below it every word would stand alone.
const NARROWEST: usize = 30;

/// The width in columns at which lines for `stream` are broken; `None` if nobody looks at it: what reads a pipe or a file
/// wants whole lines.
pub(super) fn width(stream: &impl IsTerminal) -> Option<usize> {
    if !stream.is_terminal() {
        return None;
    }
    let told = env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    let seen = || terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    told.or_else(seen).filter(|columns| *columns > 0)
}

/// Whether what goes to `stream` may have colours.
pub(super) fn has_colours(stream: &impl IsTerminal) -> bool {
    let unwanted = env::var_os("NO_COLOR").is_some_and(|wish| !wish.is_empty());
    stream.is_terminal() && !unwanted && env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// `text` in lines of at most `width` columns; all but the first begin with `indent` blanks. A word that is longer stays whole: it
/// may be a path that somebody wants to copy.
pub(super) fn wrapped(text: &str, indent: usize, width: Option<usize>) -> String {
    let Some(width) = width.map(|width| width.max(NARROWEST)) else { return text.to_owned() };
    let (mut out, mut column) = (String::new(), 0);
    let lead: String = text.chars().take_while(|c| *c == ' ').collect();
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        let length = word.chars().count();
        if out.is_empty() {
            out.push_str(&lead);
            column = lead.len();
        } else if column + 1 + length > width {
            out.push('\n');
            out.extend(std::iter::repeat_n(' ', indent));
            column = indent;
        } else {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += length;
    }
    out
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
    fn who_reads_a_pipe_gets_whole_lines_and_a_path_stays_whole() {
        let text = "a ".repeat(200) + "/a/very/long/path/that/is/longer/than/the/terminal/is/wide";
        assert_eq!(wrapped(&text, 0, None), text);
        assert!(
            wrapped(&text, 0, Some(40)).lines().any(|line| line.starts_with("/a/very") && line.len() > 40)
        );
    }
}
