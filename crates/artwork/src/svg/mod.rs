//! SVG files: SVG 1.1 and the static parts of SVG 2.
//!
//! [`guard`] limits the parser's work, [`viewport`] finds the page in mm, [`walk`] goes through the tree with its transforms,
//! styles and references, and [`shapes`] and [`path_data`] give the pieces.

mod clip;
mod conditions;
mod document;
mod guard;
mod paint;
mod path_data;
mod properties;
mod selector;
mod shapes;
mod sheet;
mod style;
mod transform;
mod viewport;
mod walk;

use roxmltree::{Document, Node, NodeType, ParsingOptions};

use self::document::{SvgSource, is_svg, shortened};
use crate::collector::Collector;
use crate::{Artwork, Fault, Options, Place, Weight};

/// Reads an SVG file.
///
/// # Errors
/// All faults of the file, each with its place: content other than XML or SVG, a page without physical size, faulty path data,
/// numbers, transforms and lengths, references that lead to themselves, and exceeded limits.
pub fn read_svg(bytes: &[u8], options: &Options) -> Result<Artwork, Vec<Fault>> {
    crate::admit::admit(bytes, crate::Format::Svg, options)?;
    let text = &*crate::encoding::svg(bytes)?;
    let document = parsed(text, options)?;
    let mut collector = Collector::new(options);
    let root = document.root_element();
    if !is_svg(root) || root.tag_name().name() != "svg" {
        let text = format!("The root element is <{}>, not <svg>.", root.tag_name().name());
        collector.refuse(Place::line(1), text, "Export the drawing as SVG.");
        return collector.finish();
    }
    let source = SvgSource::new(text, sheet(&document, &mut collector));
    if let Some((map, viewport)) = viewport::page(root, head(text), &mut collector) {
        // A limit that is exceeded is among the faults.
        let _ = walk::SvgWalk::new(&document, &source, &mut collector).run(&map, viewport);
    }
    collector.finish()
}

/// The first text of a file, where programs name themselves.
fn head(text: &str) -> &str {
    let mut end = text.len().min(2048);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
}

fn parsed<'t>(text: &'t str, options: &Options) -> Result<Document<'t>, Vec<Fault>> {
    guard::admit(text)?;
    // Texts between elements are nodes too.
    let nodes_limit = u32::try_from(options.limits.visits.saturating_mul(4)).unwrap_or(u32::MAX);
    let parsing = ParsingOptions { allow_dtd: true, nodes_limit, ..ParsingOptions::default() };
    Document::parse_with_options(text, parsing).map_err(|error| {
        let line = usize::try_from(error.pos().row).unwrap_or(1);
        let text = match error {
            roxmltree::Error::NodesLimitReached => format!("The file has more than {nodes_limit} nodes."),
            error => format!("The file is not well-formed XML: {error}."),
        };
        Fault::single(Place::line(line), text, "Save the drawing as plain SVG again.")
    })
}

/// The rules of all style sheets in the file; notes on those that are not applied.
fn sheet(document: &Document<'_>, collector: &mut Collector<'_>) -> sheet::StyleSheet {
    let mut sheet = sheet::StyleSheet::new();
    for node in document.root().descendants() {
        match node.node_type() {
            NodeType::Element if is_svg(node) && node.tag_name().name() == "style" => {
                let media = node.attribute("media").unwrap_or_default();
                if sheet::applies(&format!("@media {media}")) != Some(false) {
                    let texts = node.descendants().filter(Node::is_text);
                    let text: String = texts.filter_map(|child| child.text()).collect();
                    sheet.add(&text);
                }
            }
            NodeType::PI if node.pi().is_some_and(|pi| pi.target == "xml-stylesheet") => {
                collector.note(Weight::Lost, Place::default(), "A style sheet in another file is not read.");
            }
            _ => {}
        }
    }
    for rule in &sheet.unread {
        let text =
            format!("The style rule \"{}\" is not applied: its selector is not read.", shortened(&rule.text));
        let weight = if rule.changes_geometry { Weight::Lost } else { Weight::Information };
        collector.note(weight, Place::default(), text);
    }
    sheet
}
