//! Pictures as SVG: real text, so that it can be searched; in their true size, and in a browser no larger than the window.

use svg::Node;
use svg::node::element::Element;

use crate::emit::picture::{Anchor, Colour, Mark, Pen, Picture, Text};
use crate::emit::svg::SvgPage;
use geom::Path;
use program::number::Decimals;

/// A hundredth of a millimetre is enough for the eye.
const DECIMALS: u32 = 2;

/// Browsers shrink the picture to their window; printers and cutters use width and height.
const FITTED: &str = "max-width:100%;max-height:100%";

/// The first that a viewer has; see `typeface`.
const FACES: &str = "DejaVu Sans, Verdana, Arial, sans-serif";

impl Picture {
    /// The picture as an SVG document.
    pub(in crate::emit) fn svg(&self) -> String {
        let page = SvgPage { height: self.top, decimals: Decimals::exactly(DECIMALS) };
        let (x, y) = (page.decimals.text(self.window.min.x), page.y(self.window.max));
        let [w, h] = [self.window.width(), self.window.height()].map(|side| page.decimals.text(side));
        let mut document = page
            .document(&self.title, self.window.width())
            .set("height", format!("{h}mm"))
            .set("viewBox", format!("{x} {y} {w} {h}"))
            .set("style", FITTED);
        for group in &self.groups {
            let mut element = Element::new("g");
            element.assign("id", group.name.as_str());
            for mark in &group.marks {
                element.append(mark_element(&page, mark));
            }
            document.append(element);
        }
        format!("{document}\n")
    }
}

fn mark_element(page: &SvgPage, mark: &Mark) -> Element {
    match mark {
        Mark::Area { paths, ink } => {
            let mut element = Element::new("path");
            element.assign("d", page.data(paths));
            element.assign("fill", color(*ink));
            if paths.len() > 1 {
                element.assign("fill-rule", "evenodd");
            }
            element
        }
        Mark::Line { path, pen } => line(page, path, *pen),
        Mark::Text(text) => words(page, text),
    }
}

fn line(page: &SvgPage, path: &Path, pen: Pen) -> Element {
    let decimals = Decimals::exactly(3);
    let mut element = Element::new("path");
    element.assign("d", page.data(std::slice::from_ref(path)));
    element.assign("fill", "none");
    element.assign("stroke", color(pen.ink));
    element.assign("stroke-width", decimals.text(pen.width));
    element.assign("stroke-linejoin", "round");
    element.assign("stroke-linecap", "round");
    if let Some([dash, gap]) = pen.dash {
        element.assign("stroke-dasharray", format!("{} {}", decimals.text(dash), decimals.text(gap)));
    }
    element
}

fn words(page: &SvgPage, text: &Text) -> Element {
    let mut element = Element::new("text");
    element.assign("x", page.x(text.at));
    element.assign("y", page.y(text.at));
    element.assign("font-size", page.decimals.text(text.size));
    element.assign("font-family", FACES);
    let anchor = match text.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    element.assign("text-anchor", anchor);
    element.assign("fill", color(text.ink));
    element.append(svg::node::Text::new(text.content.as_str()));
    element
}

fn color(Colour(red, green, blue): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}
