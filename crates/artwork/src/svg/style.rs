//! Style: presentation attributes, `style`, and simple rules of style sheets.

use std::collections::BTreeMap;
use std::str::FromStr;

use roxmltree::Node;
use svgtypes::Color;

/// Properties by which a style sheet of SVG 2 can change geometry.
pub(super) const GEOMETRY: [&str; 17] = [
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
    "transform-origin",
];

/// Declarations by selector: "*", "tag", ".class", "tag.class", "#id", "tag#id".
///
/// Each property of a selector keeps its last value, so looking up is linear in an element's classes.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    rules: BTreeMap<String, BTreeMap<String, Value>>,
    order: usize,
    /// Selectors and at-rules that are not applied.
    pub(super) unread: Vec<String>,
}

/// A value with its rank: importance, specificity, order.
#[derive(Debug, Clone)]
struct Value {
    rank: (bool, u8, usize),
    text: String,
}

impl Sheet {
    /// Adds the rules of a `<style>` element.
    pub(super) fn add(&mut self, text: &str) {
        let text = without_comments(text);
        let mut rest = text.as_str();
        while let Some(brace) = rest.find('{') {
            let head = rest[..brace].trim();
            // Statements such as @import end with a semicolon.
            let (statements, selectors) = head.rsplit_once(';').map_or(("", head), |(a, b)| (a, b.trim()));
            self.unread
                .extend(statements.split(';').map(str::trim).filter(|s| !s.is_empty()).map(str::to_owned));
            let end = block_end(&rest[brace..]);
            let body = rest[brace..brace + end].trim_start_matches('{').trim_end_matches('}');
            if selectors.starts_with('@') {
                if !["@font-face", "@page", "@media print"].iter().any(|rule| selectors.starts_with(rule)) {
                    self.unread.push(selectors.to_owned());
                }
            } else {
                for selector in selectors.split(',') {
                    self.rule(selector.trim(), body);
                }
            }
            rest = &rest[brace + end..];
        }
        self.unread.extend(rest.split(';').map(str::trim).filter(|s| s.starts_with('@')).map(str::to_owned));
    }

    fn rule(&mut self, selector: &str, body: &str) {
        let Some(specificity) = specificity(selector) else {
            // Widths of strokes and fonts change nothing that is read.
            let hides = |name: &str, value| name.ends_with("opacity") && is_zero(value);
            if declarations(body).any(|(name, value)| matters(name) || hides(name, value)) {
                self.unread.push(selector.to_owned());
            }
            return;
        };
        let values = self.rules.entry(selector.to_owned()).or_default();
        for (name, text) in declarations(body) {
            self.order += 1;
            let (text, important) =
                text.strip_suffix("!important").map_or((text, false), |text| (text.trim(), true));
            let value = Value { rank: (important, specificity, self.order), text: text.to_owned() };
            match values.get(name) {
                Some(old) if old.rank > value.rank => {}
                _ => drop(values.insert(name.to_owned(), value)),
            }
        }
    }

    /// The declarations whose selectors match an element.
    fn matching<'s>(&'s self, node: Node<'_, '_>) -> Vec<&'s BTreeMap<String, Value>> {
        let mut found = Vec::new();
        if self.rules.is_empty() {
            return found;
        }
        let tag = node.tag_name().name();
        let mut look = |selector: &str| found.extend(self.rules.get(selector));
        look("*");
        look(tag);
        for class in node.attribute("class").unwrap_or_default().split_ascii_whitespace() {
            look(&format!(".{class}"));
            look(&format!("{tag}.{class}"));
        }
        if let Some(id) = node.attribute("id") {
            look(&format!("#{id}"));
            look(&format!("{tag}#{id}"));
        }
        found
    }
}

/// Whether a property changes what is read: geometry, visibility, clips, markers, or the colour that names a layer.
fn matters(name: &str) -> bool {
    const OTHERS: [&str; 8] =
        ["stroke", "fill", "color", "display", "visibility", "clip-path", "mask", "filter"];
    GEOMETRY.contains(&name) || OTHERS.contains(&name) || name.starts_with("marker")
}

/// Whether a value of `opacity` is 0 or less.
pub(super) fn is_zero(value: &str) -> bool {
    value.trim_end_matches('%').trim().parse::<f64>().is_ok_and(|number| number <= 0.0)
}

/// Rank of a selector; `None` if it is not one of the supported ones.
fn specificity(selector: &str) -> Option<u8> {
    let split = selector.find(['.', '#']).unwrap_or(selector.len());
    let (tag, rest) = selector.split_at(split);
    let is_name = |name: &str| {
        !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '-' || c == '_' || !c.is_ascii())
    };
    let own = match rest.chars().next() {
        None if tag == "*" => return Some(0),
        None => return is_name(tag).then_some(1),
        Some('.') => 2,
        Some(_) => 4,
    };
    ((tag.is_empty() || is_name(tag)) && is_name(&rest[1..])).then_some(own + u8::from(!tag.is_empty()))
}

fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find("/*") {
        out.push_str(&rest[..start]);
        rest = rest[start..].find("*/").map_or("", |end| &rest[start + end + 2..]);
    }
    out.push_str(rest);
    out.replace("<!--", "").replace("-->", "")
}

/// Length of the block that starts with the text, its inner blocks included.
fn block_end(text: &str) -> usize {
    let mut depth = 0;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'{' => depth += 1,
            b'}' if depth == 1 => return at + 1,
            b'}' => depth -= 1,
            _ => {}
        }
    }
    text.len()
}

/// The declarations "name: value; ..." of a block or an attribute.
fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split(';').filter_map(|part| part.split_once(':')).map(|(name, value)| (name.trim(), value.trim()))
}

/// The declarations that apply to an element.
pub(super) struct Cascade<'s, 'a, 'd> {
    node: Node<'a, 'd>,
    inline: Vec<(&'a str, &'a str)>,
    rules: Vec<&'s BTreeMap<String, Value>>,
}

impl<'s, 'a: 's, 'd> Cascade<'s, 'a, 'd> {
    pub(super) fn new(sheet: &'s Sheet, node: Node<'a, 'd>) -> Self {
        let inline = declarations(node.attribute("style").unwrap_or_default()).collect();
        Self { node, inline, rules: sheet.matching(node) }
    }

    /// A property from `style` or a style sheet.
    pub(super) fn styled(&self, name: &str) -> Option<&'s str> {
        let inline = self.inline.iter().rfind(|row| row.0 == name).map(|row| row.1);
        let rule = self.rules.iter().filter_map(|rule| rule.get(name)).max_by_key(|value| value.rank);
        match (inline, rule) {
            (Some(inline), rule)
                if inline.ends_with("!important") || rule.is_none_or(|rule| !rule.rank.0) =>
            {
                Some(inline.strip_suffix("!important").unwrap_or(inline).trim())
            }
            (_, rule) => rule.map(|rule| rule.text.as_str()),
        }
    }

    /// A property from `style`, a style sheet or an attribute.
    pub(super) fn value(&self, name: &str) -> Option<&'s str> {
        self.styled(name).or_else(|| self.node.attribute(name)).map(str::trim)
    }

    /// The same of a property that refers to another element; `None` if it refers to none.
    pub(super) fn applied(&self, name: &str) -> Option<&'s str> {
        self.value(name).filter(|value| !matches!(*value, "none" | "inherit"))
    }
}

/// Paint of a stroke or a fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Paint {
    None,
    Colour([u8; 3]),
    /// A gradient or a pattern.
    Server,
}

/// The inherited properties.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub(super) stroke: Paint,
    pub(super) fill: Paint,
    colour: [u8; 3],
    /// Whether `stroke-opacity` and `fill-opacity` leave something to see.
    opaque: [bool; 2],
    pub(super) visible: bool,
    /// Whether strokes have gaps.
    pub(super) dashed: bool,
}

impl Style {
    /// The style of a document without declarations.
    pub(super) const INITIAL: Self = Self {
        stroke: Paint::None,
        fill: Paint::Colour([0; 3]),
        colour: [0; 3],
        opaque: [true; 2],
        visible: true,
        dashed: false,
    };

    /// The style of an element in an element of this style.
    pub(super) fn inherited(&self, cascade: &Cascade<'_, '_, '_>) -> Self {
        let colour = cascade.value("color").and_then(colour).unwrap_or(self.colour);
        let paint = |name: &str, parent: Paint| match cascade.value(name) {
            None | Some("inherit") => parent,
            Some("none" | "transparent") => Paint::None,
            Some("currentColor" | "currentcolor") => Paint::Colour(colour),
            Some(value) if value.starts_with("url(") => Paint::Server,
            Some(value) => self::colour(value).map_or(parent, Paint::Colour),
        };
        let visible = match cascade.value("visibility") {
            Some("hidden" | "collapse") => false,
            Some("visible") => true,
            _ => self.visible,
        };
        let dashed = match cascade.value("stroke-dasharray") {
            None | Some("inherit") => self.dashed,
            Some(value) => value.split([',', ' ']).any(|dash| {
                let number = dash.trim_end_matches(|c: char| c == '%' || c.is_ascii_alphabetic());
                number.parse::<f64>().is_ok_and(|length| length > 0.0)
            }),
        };
        let opaque = |name: &str, parent: bool| match cascade.value(name) {
            None | Some("inherit") => parent,
            Some(value) => !is_zero(value),
        };
        let opaque = [opaque("stroke-opacity", self.opaque[0]), opaque("fill-opacity", self.opaque[1])];
        let (stroke, fill) = (paint("stroke", self.stroke), paint("fill", self.fill));
        Self { stroke, fill, colour, opaque, visible, dashed }
    }

    /// Stroke and fill as far as they can be seen.
    pub(super) fn seen(&self) -> [Paint; 2] {
        let seen = |paint, opaque| if opaque { paint } else { Paint::None };
        [seen(self.stroke, self.opaque[0]), seen(self.fill, self.opaque[1])]
    }

    /// The name of a layer by colour: "#rrggbb" of the stroke, else "fill #rrggbb".
    pub(super) fn layer(&self) -> Option<String> {
        let hex = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
        match (self.stroke, self.fill) {
            (Paint::Colour(stroke), _) => Some(hex(stroke)),
            (Paint::None, Paint::Colour(fill)) => Some(format!("fill {}", hex(fill))),
            _ => None,
        }
    }
}

fn colour(text: &str) -> Option<[u8; 3]> {
    Color::from_str(text).ok().map(|colour| [colour.red, colour.green, colour.blue])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_rank_by_importance_specificity_and_order() {
        let mut sheet = Sheet::default();
        sheet.add("/* x{} */ .a, path{stroke:red} path.a{stroke:#0F0} .a{stroke:blue} #p{stroke:gray} g > .a{fill:none} g > .b{stroke-width:1} @media print{.a{x:y}} @media screen{} *{stroke:black !important}");
        assert_eq!(sheet.unread, ["g > .a", "@media screen"]);
        let text =
            "<svg><path id='p' class='b a'/><path class='a' style='stroke: pink'/><rect class='a'/></svg>";
        let document = roxmltree::Document::parse(text).expect("xml");
        let found = |sheet: &Sheet| -> Vec<String> {
            let nodes = document.root_element().children();
            nodes
                .map(|node| Cascade::new(sheet, node).value("stroke").expect("a stroke").to_owned())
                .collect()
        };
        assert_eq!(found(&sheet), ["black"; 3]);
        assert!(sheet.rules.remove("*").is_some());
        assert_eq!(found(&sheet), ["gray", "pink", "blue"]);
        assert!(sheet.rules.remove("#p").is_some());
        assert_eq!(found(&sheet)[0], "#0F0");
    }
}
