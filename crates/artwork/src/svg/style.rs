//! Style: presentation attributes, `style`, and the rules of style sheets.

use roxmltree::Node;

use super::paint::Paint;
use super::properties::is_zero;
use super::sheet::{Declaration, StyleSheet, declared};

/// Whether a reader of SVG takes `value` for the property `name`; one that it does not take leaves others in force.
fn is_understood(name: &str, value: &str) -> bool {
    let is_global =
        ["inherit", "initial", "unset", "revert"].iter().any(|word| value.eq_ignore_ascii_case(word));
    is_global
        || match name {
            "stroke" | "fill" | "color" => Paint::declared(name, value, [0; 3]).is_some(),
            "visibility" => {
                ["visible", "hidden", "collapse"].iter().any(|word| value.eq_ignore_ascii_case(word))
            }
            "opacity" | "stroke-opacity" | "fill-opacity" | "stroke-width" => {
                let number = value.trim_end_matches(|c: char| c == '%' || c.is_ascii_alphabetic());
                number.trim_end().parse::<f64>().is_ok()
            }
            _ => !value.contains("var("),
        }
}

/// The declarations that apply to an element.
pub(super) struct Cascade<'a, 'd> {
    node: Node<'a, 'd>,
    declarations: Vec<Declaration>,
}

impl<'a, 'd> Cascade<'a, 'd> {
    pub(super) fn new(sheet: &StyleSheet, node: Node<'a, 'd>) -> Self {
        let mut declarations: Vec<Declaration> = sheet.matching(node).cloned().collect();
        let inline = node.attribute("style").unwrap_or_default();
        declarations.extend(declared(inline, |important| (important, u32::MAX, usize::MAX)));
        Self { node, declarations }
    }

    /// A property from `style` or a style sheet: the declaration of the highest rank that is understood, of equal ones the last.
    pub(super) fn styled(&self, name: &str) -> Option<&str> {
        let declarations = self.declarations.iter().filter(|declaration| declaration.name == name);
        let understood = declarations.filter(|declaration| is_understood(name, &declaration.value));
        understood.max_by_key(|declaration| declaration.rank).map(|declaration| declaration.value.as_str())
    }

    /// A property from `style`, a style sheet or an attribute.
    pub(super) fn value(&self, name: &str) -> Option<&str> {
        let attribute =
            || self.node.attribute(name).map(str::trim).filter(|value| is_understood(name, value));
        self.styled(name).or_else(attribute)
    }

    /// Whether a property has a value in this keyword, in capitals or not.
    pub(super) fn is(&self, name: &str, word: &str) -> bool {
        self.value(name).is_some_and(|value| value.eq_ignore_ascii_case(word))
    }

    /// Whether a number is not 0, of an element whose parent's is not where `parent` says so.
    fn is_nonzero(&self, name: &str, parent: bool) -> bool {
        match self.value(name) {
            None | Some("inherit" | "unset") => parent,
            Some(value) => !is_zero(value),
        }
    }

    /// Whether a property has values, none of which is understood.
    fn is_unclear(&self, name: &str) -> bool {
        self.value(name).is_none()
            && (self.node.attribute(name).is_some()
                || self.declarations.iter().any(|declaration| declaration.name == name))
    }

    /// A property that refers to another element; `None` if it refers to none.
    pub(super) fn applied(&self, name: &str) -> Option<&str> {
        self.value(name).filter(|value| !matches!(*value, "none" | "inherit"))
    }

    /// The paint of a stroke or a fill inside of an element with the paint `parent`, where `current` is the colour of the text.
    ///
    /// A paint that is not understood is visible: that of the parent, or one that names no layer.
    fn paint(&self, name: &str, parent: Paint, current: [u8; 3]) -> Paint {
        match self.value(name).and_then(|value| Paint::declared(name, value, current)) {
            Some(declared) => declared.unwrap_or(parent),
            None if self.is_unclear(name) && parent == Paint::None => Paint::Other,
            None => parent,
        }
    }
}

/// The inherited properties.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElementStyle {
    stroke: Paint,
    fill: Paint,
    colour: [u8; 3],
    /// Whether `stroke-opacity` and `fill-opacity` leave something to see.
    opaque: [bool; 2],
    /// Whether `stroke-width` does.
    wide: bool,
    pub(super) visible: bool,
    /// Whether strokes have gaps.
    pub(super) dashed: bool,
}

impl ElementStyle {
    /// The style of a document without declarations.
    pub(super) const INITIAL: Self = Self {
        stroke: Paint::None,
        fill: Paint::Colour([0; 3]),
        colour: [0; 3],
        opaque: [true; 2],
        wide: true,
        visible: true,
        dashed: false,
    };

    /// The style of an element in an element of this style.
    pub(super) fn inherited(&self, cascade: &Cascade<'_, '_>) -> Self {
        // What an element does not declare, or does not declare in a way that is understood, it has from its parent.
        // `currentColor` needs the colour first.
        let colour = match cascade.value("color").map(|value| Paint::declared("color", value, self.colour)) {
            Some(Some(Some(Paint::Colour(colour)))) => colour,
            _ => self.colour,
        };
        let visible = match cascade.value("visibility").map(str::to_ascii_lowercase).as_deref() {
            Some("hidden" | "collapse") => false,
            Some("visible" | "initial") => true,
            _ => self.visible,
        };
        let dashed = match cascade.value("stroke-dasharray") {
            None | Some("inherit") => self.dashed,
            Some(value) => value.split([',', ' ']).any(|dash| {
                let number = dash.trim_end_matches(|c: char| c == '%' || c.is_ascii_alphabetic());
                number.parse::<f64>().is_ok_and(|length| length > 0.0)
            }),
        };
        Self {
            stroke: cascade.paint("stroke", self.stroke, colour),
            fill: cascade.paint("fill", self.fill, colour),
            colour,
            opaque: [
                cascade.is_nonzero("stroke-opacity", self.opaque[0]),
                cascade.is_nonzero("fill-opacity", self.opaque[1]),
            ],
            wide: cascade.is_nonzero("stroke-width", self.wide),
            visible,
            dashed,
        }
    }

    /// Stroke and fill as far as they can be seen.
    pub(super) fn visible_paints(&self) -> [Paint; 2] {
        let paints = [(self.stroke, self.opaque[0] && self.wide), (self.fill, self.opaque[1])];
        paints.map(|(paint, is_visible)| if is_visible { paint } else { Paint::None })
    }

    /// Whether neither stroke nor fill can be seen.
    pub(super) fn is_unseen(&self) -> bool {
        self.visible_paints() == [Paint::None; 2]
    }

    /// The name of a layer by colour: "#rrggbb" of the stroke, else "fill #rrggbb". Paints that cannot be seen count where all cannot.
    pub(super) fn layer(&self) -> Option<String> {
        match if self.is_unseen() { [self.stroke, self.fill] } else { self.visible_paints() } {
            [Paint::Colour([r, g, b]), _] => Some(format!("#{r:02x}{g:02x}{b:02x}")),
            [Paint::None, Paint::Colour([r, g, b])] => Some(format!("fill #{r:02x}{g:02x}{b:02x}")),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The strokes of the elements inside of the root, by the cascade alone.
    fn strokes(sheet: &StyleSheet, text: &str) -> Vec<Option<String>> {
        let document = roxmltree::Document::parse(text).expect("xml");
        let nodes = document.root_element().children();
        nodes.map(|node| Cascade::new(sheet, node).value("stroke").map(str::to_owned)).collect()
    }

    fn sheet(text: &str) -> StyleSheet {
        let mut sheet = StyleSheet::new();
        sheet.add(text);
        sheet
    }

    #[test]
    fn rules_rank_by_importance_specificity_and_order() {
        let text =
            "<svg><path id='p' class='b a'/><path class='a' style='stroke: pink'/><rect class='a'/></svg>";
        let rules = "/* x{} */ .a, path{stroke:red} path.a{stroke:#0F0} .a{stroke:blue} #p{stroke:gray}";
        assert_eq!(strokes(&sheet(rules), text), ["gray", "pink", "blue"].map(|word| Some(word.to_owned())));
        let without_id = rules.replace("#p{stroke:gray}", "");
        assert_eq!(strokes(&sheet(&without_id), text)[0].as_deref(), Some("#0F0"));
        let important = format!("{rules} *{{stroke:black ! important}}");
        assert_eq!(strokes(&sheet(&important), text), ["black"; 3].map(|word| Some(word.to_owned())));
    }

    /// Each selector with the numbers of the elements that it matches.
    #[test]
    fn selectors_match_as_css_has_it() {
        // Each selector is applied to three elements in one parent. It matches those that the standard says, and no
        // rule is reported as unread.
        let text = "<svg class='top x' data-a='one two'><path id='p' class='a b'/><path class='a'/>\
            <rect class='b' lang='en-GB'/></svg>";
        for (selector, wanted) in [
            ("svg path", [1, 1, 0]),
            ("svg.top > path.a", [1, 1, 0]),
            ("svg.top.x>.b", [1, 0, 1]),
            (".a.b", [1, 0, 0]),
            ("path + path", [0, 1, 0]),
            ("path ~ rect", [0, 0, 1]),
            ("path:first-child", [1, 0, 0]),
            (":last-child", [0, 0, 1]),
            (":nth-child(2)", [0, 1, 0]),
            (":nth-child(odd)", [1, 0, 1]),
            (":nth-child(-n+2)", [1, 1, 0]),
            (":not(.a)", [0, 0, 1]),
            (":root path#p", [1, 0, 0]),
            ("[lang|=en]", [0, 0, 1]),
            ("[data-a~='two'] > [id]", [1, 0, 0]),
            ("path:hover", [0, 0, 0]),
            ("g path", [0, 0, 0]),
            ("* > .a", [1, 1, 0]),
        ] {
            let style_sheet = sheet(&format!("{selector}{{stroke:red}}"));
            let numbers = strokes(&style_sheet, text)
                .iter()
                .map(|stroke| u8::from(stroke.is_some()))
                .collect::<Vec<_>>();
            assert_eq!(numbers, wanted, "{selector}");
            assert!(style_sheet.unread.is_empty(), "{selector}");
        }
    }

    #[test]
    fn rules_that_are_not_applied_are_listed_with_their_effect() {
        let unread = |text: &str| {
            let style_sheet = sheet(text);
            style_sheet
                .unread
                .iter()
                .map(|rule| (rule.text.clone(), rule.changes_geometry))
                .collect::<Vec<_>>()
        };
        let listed = |text: &str, changes| vec![(text.to_owned(), changes)];
        assert_eq!(unread("a:has(b){fill:none;stroke:red}"), listed("a:has(b)", false));
        assert_eq!(unread("a:has(b){display:none}"), listed("a:has(b)", true));
        assert_eq!(unread("a:has(b){stroke-width:0}"), listed("a:has(b)", true));
        assert_eq!(unread("a:has(b){font-size:3px;stroke-width:1}"), []);
        assert_eq!(unread("@media (min-width: 3px){.a{d:none}}"), listed("@media (min-width: 3px)", true));
        assert_eq!(
            unread("@media print{.a{display:none}}@font-face{src:url(a;b)}@keyframes k{0%{opacity:0}}"),
            []
        );
        assert_eq!(unread("@media (prefers-color-scheme: dark){.a{stroke:white}}"), []);
        assert_eq!(unread("@import url(x.css); .a{stroke:red}"), listed("@import url(x.css)", true));
        let screen = sheet("@media screen{path{stroke:red}} .c{x:\"}\"} rect{stroke:blue;}");
        assert_eq!(strokes(&screen, "<svg><path/><rect/></svg>"), [Some("red".into()), Some("blue".into())]);
    }

    /// By CSS a declaration that a reader does not understand is as if it were not there.
    #[test]
    fn what_is_not_understood_leaves_the_rest_in_force() {
        for value in ["light-dark(red, blue)", "var(--x)", "oklch(1 2 3)", "device-cmyk(0,1,1,0)"] {
            let stroke_of = |attributes: &str| {
                strokes(&StyleSheet::new(), &format!("<svg><path {attributes}/></svg>")).remove(0)
            };
            assert_eq!(stroke_of(&format!("stroke='#f00' style='stroke:{value}'")).as_deref(), Some("#f00"));
            assert_eq!(stroke_of(&format!("style='stroke:#f00;stroke:{value}'")).as_deref(), Some("#f00"));
            assert_eq!(
                stroke_of(&format!("style='stroke:#f00 ! important;stroke:{value} !important'")).as_deref(),
                Some("#f00")
            );
            assert_eq!(stroke_of(&format!("style='stroke:{value}'")), None);
        }
    }
}
