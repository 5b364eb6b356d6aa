//! A page of Markdown in pieces: headings, fenced blocks, pictures, links.

use std::fs;
use std::path::Path;

use crate::home;

/// Whether a file's name has this ending.
pub(crate) fn ends_in(name: &str, ending: &str) -> bool {
    Path::new(name).extension().is_some_and(|found| found == ending)
}

/// A page.
pub(crate) struct Page {
    /// Path of the page below the sources: "docs/making.md".
    pub(crate) name: String,
    /// The text of the page.
    pub(crate) text: String,
}

/// A part of a page that is tested.
#[derive(Debug)]
pub(crate) enum Piece {
    /// Text of a heading.
    Heading(String),
    /// A fenced block.
    Block(Block),
    /// Path of a picture in the page, and the command's file that it shows (`<!-- from out/star/x.svg -->` above it).
    Picture {
        /// The path in the page.
        file: String,
        /// The alternative text.
        words: String,
        /// A path below the directory in which the page's commands run.
        from: Option<String>,
    },
}

/// A fenced block.
#[derive(Debug)]
pub(crate) struct Block {
    /// The word after the fence: "sh".
    pub(crate) kind: String,
    /// Content of the block, line ends included.
    pub(crate) body: String,
    /// The line of its fence, from 1.
    pub(crate) line: usize,
    /// The reason why it is not run (`<!-- not run: minutes -->` above it).
    pub(crate) not_run: Option<String>,
}

impl Page {
    /// The page `name`.
    pub(crate) fn named(name: &str) -> Self {
        let text = fs::read_to_string(home().join(name)).unwrap_or_else(|why| panic!("{name}: {why}"));
        Self { name: name.to_owned(), text }
    }

    /// README.md and all pages in docs/ except the book's list, sorted.
    pub(crate) fn read_all() -> Vec<Self> {
        let files = fs::read_dir(home().join("docs")).expect("a directory");
        let mut names: Vec<String> = files
            .map(|file| file.expect("a file").file_name().into_string().expect("ASCII"))
            .filter(|name| ends_in(name, "md") && name != "SUMMARY.md")
            .map(|name| format!("docs/{name}"))
            .collect();
        names.push("README.md".to_owned());
        names.sort();
        names.iter().map(|name| Self::named(name)).collect()
    }

    /// Pieces of the page in order.
    pub(crate) fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut remark = String::new();
        let mut open: Option<Block> = None;
        for (line, number) in self.text.lines().zip(1..) {
            if let Some(block) = &mut open {
                if line == "```" {
                    pieces.extend(open.take().map(Piece::Block));
                } else {
                    block.body += line;
                    block.body.push('\n');
                }
                continue;
            }
            if let Some(kind) = line.strip_prefix("```") {
                let not_run = remark.strip_prefix("not run: ").map(str::to_owned);
                open = Some(Block { kind: kind.to_owned(), body: String::new(), line: number, not_run });
            } else if let Some(heading) = line.strip_prefix('#') {
                pieces.push(Piece::Heading(heading.trim_matches(['#', ' ']).to_owned()));
            } else if let Some((words, rest)) = line.strip_prefix("![").and_then(|rest| rest.split_once("]("))
            {
                let source = remark.strip_prefix("from ").map(str::to_owned);
                let file = rest.trim_end_matches(')').to_owned();
                pieces.push(Piece::Picture { file, words: words.to_owned(), from: source });
            }
            let comment = line.strip_prefix("<!-- ").and_then(|rest| rest.strip_suffix(" -->"));
            comment.unwrap_or_default().clone_into(&mut remark);
        }
        assert!(open.is_none(), "{}: a block is not closed", self.name);
        pieces
    }

    /// All targets of links, pictures included, as the page spells them.
    pub(crate) fn links(&self) -> Vec<String> {
        let mut prose = String::new();
        let mut is_code = false;
        for line in self.text.lines() {
            if line.starts_with("```") {
                is_code = !is_code;
            } else if !is_code {
                // Text in a code span is not a link.
                prose.extend(line.split('`').step_by(2).flat_map(|part| [part, "`"]));
                prose.push('\n');
            }
        }
        let ends = prose.split("](").skip(1);
        ends.filter_map(|rest| rest.split_once(')')).map(|(link, _)| link.to_owned()).collect()
    }

    /// The anchors of this page, as GitHub and mdBook name them.
    pub(crate) fn anchors(&self) -> Vec<String> {
        let pieces = self.pieces();
        let headings = pieces.iter().filter_map(|piece| match piece {
            Piece::Heading(text) => Some(text),
            _ => None,
        });
        headings
            .map(|text| {
                let lower = text.to_lowercase();
                let letters = lower.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
                letters.map(|c| if c == ' ' { '-' } else { c }).collect()
            })
            .collect()
    }
}
