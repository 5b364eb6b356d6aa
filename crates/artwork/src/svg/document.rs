//! Lines, elements and names of a document.

use roxmltree::Node;

use super::sheet::StyleSheet;

/// Namespace of SVG.
const SVG: &str = "http://www.w3.org/2000/svg";

/// Facts about a file that its tree does not hold.
pub(super) struct SvgSource {
    /// Offsets at which lines start, and those of the first character in each that is no blank.
    lines: Vec<(usize, usize)>,
    /// The rules of its style sheets.
    pub(super) sheet: StyleSheet,
}

impl SvgSource {
    /// The facts about `text`, whose style sheets have the rules of `sheet`.
    pub(super) fn new(text: &str, sheet: StyleSheet) -> Self {
        Self { lines: line_starts(text), sheet }
    }

    /// The line of a node, from 1.
    pub(super) fn line(&self, node: Node<'_, '_>) -> usize {
        self.lines.partition_point(|(start, _)| *start <= node.range().start)
    }

    /// The place of a node in words: "line 12", and if it is not the first there, "line 12, column 40".
    pub(super) fn place_in_words(&self, node: Node<'_, '_>) -> String {
        let (line, offset) = (self.line(node), node.range().start);
        match self.lines.get(line.saturating_sub(1)) {
            Some((start, first)) if offset > *first => format!("line {line}, column {}", offset - start + 1),
            _ => format!("line {line}"),
        }
    }
}

fn line_starts(text: &str) -> Vec<(usize, usize)> {
    let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1));
    let with_indent = |start: usize| {
        let blanks = text.as_bytes()[start..].iter().take_while(|byte| matches!(byte, b' ' | b'\t' | b'\r'));
        (start, start + blanks.count())
    };
    starts.map(with_indent).collect()
}

/// Whether an element is of SVG; files without a namespace are taken as such.
pub(super) fn is_svg(node: Node<'_, '_>) -> bool {
    node.is_element() && node.tag_name().namespace().is_none_or(|namespace| namespace == SVG)
}

/// The user's names for an element, the label of its program before the id.
pub(super) fn names<'a>(node: Node<'a, '_>) -> impl Iterator<Item = &'a str> {
    // Inkscape writes inkscape:label, Illustrator data-name, Affinity serif:id.
    let mut attributes = node.attributes();
    let label = attributes.find(|attribute| match (attribute.name(), attribute.namespace()) {
        ("label", Some(namespace)) => namespace.contains("inkscape"),
        ("data-name", None) => true,
        ("id", Some(namespace)) => namespace.contains("serif"),
        _ => false,
    });
    label.map(|label| label.value()).into_iter().chain(node.attribute("id")).filter(|name| !name.is_empty())
}

/// The beginning of a text of the drawing, as messages show it.
pub(super) fn shortened(text: &str) -> String {
    text.chars().take(60).collect()
}
