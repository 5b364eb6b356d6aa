//! Properties of styles that matter to geometry and visibility.

/// Properties by which a style sheet of SVG 2 can change geometry.
pub(super) const GEOMETRY: [&str; 16] = [
    "transform",
    "translate",
    "rotate",
    "scale",
    "offset-path",
    "zoom",
    "d",
    "x",
    "y",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "width",
    "height",
];

/// Whether a value of an opacity or a width is 0 or less.
pub(super) fn is_zero(value: &str) -> bool {
    let number = value.trim_end_matches(|c: char| c == '%' || c.is_ascii_alphabetic()).trim();
    number.parse::<f64>().is_ok_and(|number| number <= 0.0)
}
