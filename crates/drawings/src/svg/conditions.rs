//! Conditional attributes: an element is drawn only if all of them hold, and of a `<switch>` only the first child that is.

use roxmltree::Node;

use super::shortened;

/// Elements that are shown by reference only, or not at all.
pub(super) const UNSEEN: [&str; 15] = [
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

/// The first conditional attribute of an element that does not hold, with its value. Languages are compared with English, whatever the
/// reader's is, so that a file gives the same drawing everywhere.
pub(super) fn unmet(node: Node<'_, '_>) -> Option<String> {
    let feature = |name: &str| {
        name.strip_prefix("http://www.w3.org/TR/SVG11/feature#").is_some_and(|name| FEATURES.contains(&name))
    };
    let english = |tag: &str| tag.split('-').next().is_some_and(|tag| tag.trim().eq_ignore_ascii_case("en"));
    let holds = |name: &str, value: &str| match name {
        "requiredFeatures" => !value.trim().is_empty() && value.split_ascii_whitespace().all(feature),
        "systemLanguage" => value.split(',').any(english),
        _ => false,
    };
    let given = |name| Some((name, node.attribute(name)?));
    let mut all = ["requiredExtensions", "requiredFeatures", "systemLanguage"].into_iter().filter_map(given);
    let (name, value) = all.find(|(name, value)| !holds(name, value))?;
    Some(format!("{name} \"{}\"", shortened(value)))
}
