//! Words in the names of layers, and the roles that they suggest.

use artwork::Element;
use spec::LayerRole;

/// Words by role. A name has the role of the first row with one of its words.
const WORDS: [(LayerRole, &[&str]); 8] = [
    (
        LayerRole::Ignore,
        &["note", "text", "dim", "guide", "construction", "ignore", "label", "background", "registration"],
    ),
    (LayerRole::Measure, &["measure"]),
    (LayerRole::Pull, &["pull"]),
    (LayerRole::Port, &["port", "inlet", "hose", "valve"]),
    (LayerRole::Hole, &["hole", "punch", "drill"]),
    (LayerRole::Cut, &["cut", "outline", "contour"]),
    (LayerRole::Seam, &["seam", "weld", "seal", "barrier"]),
    (LayerRole::Air, &["air", "chamber", "tube", "bladder", "pouch"]),
];

/// The role that a word in the name of a layer suggests.
pub(super) fn word_role(name: &str) -> Option<LayerRole> {
    let small = name.to_lowercase();
    WORDS.iter().find(|(_, words)| words.iter().any(|word| small.contains(word))).map(|(role, _)| *role)
}

/// Whether a name is that of a valve, which sits on the edge of a chamber or in its face.
pub(super) fn is_valve(name: &str) -> bool {
    name.to_lowercase().contains("valve")
}

/// Whether a name is that of a page, which programs put around a drawing or draw as a rectangle.
pub(super) fn is_page(name: &str) -> bool {
    name.to_lowercase().contains("artboard")
}

/// The colour among the names of an element.
pub(super) fn colour_of(element: &Element) -> Option<&str> {
    let hex = |digits: &str| digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    let number = |digits: &str| digits.parse::<u8>().is_ok();
    let is_colour = |name: &&str| {
        name.trim_start_matches("fill ").strip_prefix('#').is_some_and(hex)
            || name.strip_prefix("color ").is_some_and(number)
    };
    element.layers[..element.own_names].iter().map(String::as_str).find(is_colour)
}
