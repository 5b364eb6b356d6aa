//! SVG drawings at 1:1 for cutters: millimetres, arcs as arcs, hairlines that are seen, an Inkscape layer for each layer.

use svg::node::element::Element;
use svg::{Document, Node};

use crate::emit::palette::ink;
use design::{Drawing, Origin, Shape};
use geom::{Path, Point, Segment};
use program::number::Decimals;
use program::text::inert;
use spec::Colours;
use spec::units::Length;

/// One pixel wide at any zoom, so that the line is seen. Inkscape treats it as its hairline; printer drivers of lasers get it as
/// the thinnest line there is, and so as a cut. Readers of outlines pass over it. It must be on every shape: the `vector-effect`
/// of a group does not apply to its members.
const HAIRLINE: [(&str, &str); 2] =
    [("stroke-width", "1"), ("style", "vector-effect:non-scaling-stroke;-inkscape-stroke:hairline")];

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// The drawing as an SVG document.
pub fn svg(title: &str, drawing: &Drawing, path: Length, colours: Colours) -> String {
    // A drawing with its origin in a corner has its y axis turned over. One around an axis keeps the axis at 0, 0 by
    // its view box. Layers are Inkscape's layers with one colour each.
    let decimals = Decimals::for_tolerance(path);
    let (page, mut document) = match drawing.origin {
        Origin::LowerLeft => {
            let page = SvgPage { height: drawing.height, decimals };
            (page, page.document(title, drawing.width))
        }
        Origin::Axis(corner) => {
            let sized = SvgPage { height: drawing.height, decimals }.document(title, drawing.width);
            let [x, y, w, h] = [corner.x, -(corner.y + drawing.height), drawing.width, drawing.height]
                .map(|number| decimals.text(number));
            (SvgPage { height: 0.0, decimals }, sized.set("viewBox", format!("{x} {y} {w} {h}")))
        }
    };
    document = document.set("xmlns:inkscape", INKSCAPE);
    for (layer, shapes) in &drawing.layers {
        let mut group = Element::new("g");
        group.assign("id", layer.name());
        group.assign("inkscape:groupmode", "layer");
        group.assign("inkscape:label", layer.name());
        group.assign("fill", "none");
        group.assign("stroke", ink(*layer, colours).svg);
        for shape in shapes {
            let mut shape = page.shape(shape);
            for (name, value) in HAIRLINE {
                shape.assign(name, value);
            }
            group.append(shape);
        }
        document.append(group);
    }
    format!("{document}\n")
}

/// The sheet seen as an SVG page: same millimetres, Y pointing down from the top edge.
#[derive(Clone, Copy)]
pub(super) struct SvgPage {
    pub(super) height: f64,
    pub(super) decimals: Decimals,
}

impl SvgPage {
    /// An empty document with a title.
    pub(super) fn document(&self, title: &str, width: f64) -> Document {
        let (w, h) = (self.decimals.text(width), self.decimals.text(self.height));
        let mut caption = Element::new("title");
        caption.append(svg::node::Text::new(inert(title, 120)));
        Document::new()
            .set("width", format!("{w}mm"))
            .set("height", format!("{h}mm"))
            .set("viewBox", format!("0 0 {w} {h}"))
            .add(caption)
    }

    pub(super) fn x(&self, p: Point) -> String {
        self.decimals.text(p.x)
    }

    pub(super) fn y(&self, p: Point) -> String {
        self.decimals.text(self.height - p.y)
    }

    fn shape(&self, shape: &Shape) -> Element {
        match shape {
            Shape::Path(path) => self.path(std::slice::from_ref(path)),
            Shape::Figure(paths) => self.path(paths),
            Shape::Circle { center, radius } => {
                let mut element = Element::new("circle");
                element.assign("cx", self.x(*center));
                element.assign("cy", self.y(*center));
                element.assign("r", self.decimals.text(*radius));
                element
            }
        }
    }

    /// One element, however many times the pen is lifted.
    fn path(&self, paths: &[Path]) -> Element {
        let mut element = Element::new("path");
        element.assign("d", self.data(paths));
        element
    }

    /// The paths as SVG path data.
    pub(super) fn data(&self, paths: &[Path]) -> String {
        let mut data =
            String::with_capacity(40 * paths.iter().map(|path| path.segments.len()).sum::<usize>());
        for path in paths {
            if !data.is_empty() {
                data.push(' ');
            }
            self.write(&mut data, path);
        }
        data
    }

    /// Appends the path as SVG path data.
    ///
    /// Arcs of more than 90 degrees are written as halves: SVG states only the ends, and near 180 degrees
    /// the centre that follows from them is worthless.
    fn write(&self, data: &mut String, path: &Path) {
        let Some(start) = path.start() else { return };
        self.point(data, "M", start);
        let last = path.segments.len() - 1;
        for (i, segment) in path.segments.iter().enumerate() {
            let closes = path.closed && i == last;
            match segment {
                // `Z` draws the last line of a closed path.
                Segment::Line(_) if closes => {}
                Segment::Line(line) => self.point(data, " L", line.end),
                Segment::Arc(arc) => {
                    let halves = if arc.sweep.abs() > std::f64::consts::FRAC_PI_2 { 2 } else { 1 };
                    let halves = if arc.sweep.abs() > std::f64::consts::PI { 4 } else { halves };
                    for k in 1..=halves {
                        // The closing arc ends at the very number at which the path began.
                        let end = if closes && k == halves {
                            start
                        } else {
                            segment.point(f64::from(k) / f64::from(halves))
                        };
                        data.push_str(" A");
                        self.decimals.write(data, arc.radius);
                        data.push(' ');
                        self.decimals.write(data, arc.radius);
                        // Y points down: counterclockwise turns become clockwise.
                        self.point(data, if arc.is_ccw() { " 0 0 0 " } else { " 0 0 1 " }, end);
                    }
                }
            }
        }
        if path.closed {
            data.push_str(" Z");
        }
    }

    fn point(&self, data: &mut String, command: &str, p: Point) {
        data.push_str(command);
        self.decimals.write(data, p.x);
        data.push(' ');
        self.decimals.write(data, self.height - p.y);
    }
}
