//! What is not drawn whatever its style: elements that are shown by reference only, and those whose conditional attributes do not all hold. Of a
//! `<switch>` only the first child that is drawn counts.

use roxmltree::Node;

/// Elements that are shown by reference only, or not at all.
const UNSEEN: [&str; 15] = [
    "defs",
    "symbol",
    "clipPath",
    "mask",
    "pattern",
    "marker",
    "linearGradient",
    "radialGradient",
    "filter",
    "title",
    "desc",
    "metadata",
    "style",
    "view",
    "font",
];

/// Features of SVG 1.1 that are read.
const FEATURES: [&str; 13] = [
    "SVG",
    "SVG-static",
    "CoreAttribute",
    "Structure",
    "BasicStructure",
    "ConditionalProcessing",
    "Style",
    "ViewportAttribute",
    "Shape",
    "PaintAttribute",
    "BasicPaintAttribute",
    "OpacityAttribute",
    "GraphicsAttribute",
];

/// The condition on the reader's language.
pub(super) const LANGUAGE: &str = "systemLanguage";

/// Whether an element with this tag is never drawn where it stands.
pub(super) fn is_unseen(tag: &str) -> bool {
    UNSEEN.contains(&tag) || tag.starts_with("fe")
}

/// The first conditional attribute of an element that does not hold, with its value. Languages are compared with English, whatever the
/// reader's is, so that a file gives the same drawing everywhere.
pub(super) fn unmet<'a>(node: Node<'a, '_>) -> Option<(&'static str, &'a str)> {
    let condition = |name| Some((name, node.attribute(name)?));
    let mut conditions =
        ["requiredExtensions", "requiredFeatures", LANGUAGE].into_iter().filter_map(condition);
    conditions.find(|(name, value)| !is_met(name, value))
}

fn is_met(condition: &str, value: &str) -> bool {
    let feature = |name: &str| {
        name.strip_prefix("http://www.w3.org/TR/SVG11/feature#").is_some_and(|name| FEATURES.contains(&name))
    };
    let english = |tag: &str| tag.split('-').next().is_some_and(|tag| tag.trim().eq_ignore_ascii_case("en"));
    match condition {
        "requiredFeatures" => !value.trim().is_empty() && value.split_ascii_whitespace().all(feature),
        LANGUAGE => value.split(',').any(english),
        _ => false,
    }
}
