//! Paints of strokes and fills.

use std::str::FromStr;

use svgtypes::Color;

/// Paint of a stroke or a fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Paint {
    /// None, or without any opacity.
    None,
    Colour([u8; 3]),
    /// A gradient, a pattern, or a colour of a kind that is not read: visible, and names no layer.
    Other,
}

impl Paint {
    /// The paint that a `value` of the property `name` ("stroke" or "fill") declares, where `current` is the colour of the text:
    /// `Some(None)` for the parent's, `None` if the value is not understood.
    #[expect(
        clippy::option_option,
        reason = "not understood, the parent's, and a paint are three answers of CSS"
    )]
    pub(super) fn declared(name: &str, value: &str, current: [u8; 3]) -> Option<Option<Self>> {
        let value = value.trim();
        let lower = value.to_ascii_lowercase();
        match lower.as_str() {
            "inherit" | "unset" | "revert" | "revert-layer" => return Some(None),
            "none" => return Some(Some(Self::None)),
            "initial" if name == "stroke" => return Some(Some(Self::None)),
            "initial" => return Some(Some(Self::Colour([0; 3]))),
            "currentcolor" => return Some(Some(Self::Colour(current))),
            _ => {}
        }
        if lower.starts_with("url(") {
            let fallback = value.find(')').map_or("", |end| value[end + 1..].trim());
            // A colour behind the reference names the layer; "none" there is for a reference that leads nowhere.
            return Some(Some(colour(fallback).filter(|paint| *paint != Self::None).unwrap_or(Self::Other)));
        }
        colour(value).map(Some)
    }
}

/// A colour; one without opacity is no paint. Behind it colours of print may stand, as in "#ff0000 icc-color(...)".
fn colour(text: &str) -> Option<Paint> {
    let parsed = Color::from_str(text).ok().or_else(|| with_opacity(text)).or_else(|| {
        let (first, rest) = text.split_once(char::is_whitespace)?;
        let is_function = !first.contains('(') && rest.contains('(') && rest.trim_end().ends_with(')');
        is_function.then(|| Color::from_str(first).ok()).flatten()
    })?;
    Some(if parsed.alpha == 0 { Paint::None } else { Paint::Colour([parsed.red, parsed.green, parsed.blue]) })
}

/// A colour function whose opacity is in per cent, as in "rgb(255 0 0 / 50%)".
fn with_opacity(text: &str) -> Option<Color> {
    let (channels, last) = text.strip_suffix(')')?.rsplit_once(['/', ',', ' '])?;
    let opacity: f64 = last.trim().strip_suffix('%')?.parse().ok()?;
    Color::from_str(&format!("{}, {})", channels.trim_end_matches([' ', '/', ',']), opacity / 100.0)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paints_are_read_or_told_from_those_that_are_not() {
        // Colours in all ways of writing, paints that cannot be seen, values that are not understood, references, and
        // words that stand for another paint.
        let red = Some(Some(Paint::Colour([255, 0, 0])));
        for text in [
            "#ff0000",
            "#F00",
            "red",
            "RED",
            " rgb(255,0,0) ",
            "rgb(100%, 0%, 0%)",
            "hsl(0 100% 50%)",
            "#ff0000 icc-color(a, 0, 1, 1, 0)",
            "#f00 device-cmyk(0,1,1,0)",
            "url(#g) red",
            "rgba(255 0 0 / 50%)",
            "#ff0000ff",
        ] {
            assert_eq!(Paint::declared("stroke", text, [9; 3]), red, "{text}");
        }
        for text in [
            "none",
            "NONE",
            "transparent",
            "rgba(1,2,3,0)",
            "#12345600",
            "#1230",
            "rgb(0 0 0 / 0)",
            "hsla(0, 0%, 0%, 0)",
            "rgb(0 0 0 / 0%)",
            "rgba(0,0,0,0%)",
            "initial",
        ] {
            assert_eq!(Paint::declared("stroke", text, [9; 3]), Some(Some(Paint::None)), "{text}");
        }
        for text in [
            "light-dark(#f00, #0f0)",
            "var(--a)",
            "oklch(50% 0.1 20)",
            "device-cmyk(0,1,1,0)",
            "context-stroke",
            "color(display-p3 1 0 0)",
            "",
            "lab(1 2 3)",
            "color-mix(in srgb, red, blue)",
        ] {
            assert_eq!(Paint::declared("stroke", text, [9; 3]), None, "{text}");
        }
        for text in ["url(#g)", "url(#g) none", "url(\"#g\")"] {
            assert_eq!(Paint::declared("fill", text, [9; 3]), Some(Some(Paint::Other)), "{text}");
        }
        assert_eq!(Paint::declared("fill", "inherit", [9; 3]), Some(None));
        assert_eq!(Paint::declared("fill", "currentColor", [9; 3]), Some(Some(Paint::Colour([9; 3]))));
    }
}
