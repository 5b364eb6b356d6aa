//! Reads SVG drawings: scale, groups, and the shapes that lines and arcs can express.

use std::f64::consts::TAU;

use roxmltree::{Document, Node};

use crate::verify::finding::quote;
use crate::verify::read::{number, svg_path};
use crate::verify::{Drawing, Finding, FindingCode, Findings};
use geom::{Arc, Isometry, Line, Path, Point, Vec2};

/// Groups inside groups beyond this depth are refused: drawings need two or three, and the walk is recursive.
const DEPTH: usize = 32;

/// The place of the drawing's own origin on the page, whose Y runs down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SvgOrigin {
    /// At the page's lower left: y = height - y of the file (sheets).
    LowerLeft,
    /// At the origin of the file's own coordinates: y = - y of the file (masks and frames).
    Axis,
}

/// Reads an SVG file. Paths are listed by the `id` of the innermost group that has one, else under "".
///
/// One user unit must be one millimetre, and nothing may be transformed: a reader that ignores either would
/// cut another size.
pub fn read_svg(text: &str, origin: SvgOrigin) -> Drawing {
    match parse(text) {
        Ok(document) => read_document(&document, origin),
        Err(finding) => Drawing { findings: vec![finding], ..Drawing::default() },
    }
}

/// The XML of a file.
pub(in crate::verify) fn parse(text: &str) -> Result<Document<'_>, Finding> {
    Document::parse(text).map_err(|error| {
        let line = usize::try_from(error.pos().row).ok();
        Finding::in_line(FindingCode::BadXml, line, quote(&error.to_string()), "well-formed XML")
    })
}

/// Reads what [`read_svg`] reads.
pub(in crate::verify) fn read_document(document: &Document<'_>, origin: SvgOrigin) -> Drawing {
    let (drawing, findings) = (Drawing::default(), Findings::default());
    let mut reader = SvgReader { flip: Isometry::mirror(), drawing, findings };
    let root = document.root_element();
    if root.tag_name().name() == "svg" {
        let height = reader.page(root);
        if origin == SvgOrigin::LowerLeft {
            reader.flip.shift = Vec2::new(0.0, height);
        }
        reader.group(root, "", 0);
    } else {
        reader.findings.add(FindingCode::BadXml, quote(root.tag_name().name()), "a root element svg");
    }
    Drawing { findings: reader.findings.into_vec(), ..reader.drawing }
}

struct SvgReader {
    flip: Isometry,
    drawing: Drawing,
    findings: Findings,
}

impl SvgReader {
    /// Adds a finding about an element.
    fn blame(
        &mut self,
        node: Node<'_, '_>,
        code: FindingCode,
        fault: impl Into<String>,
        allowed: impl Into<String>,
    ) {
        self.findings.add_at(code, line_of(node), fault, allowed);
    }

    /// Checks the scale; returns the height in user units (0 if there is none).
    fn page(&mut self, root: Node<'_, '_>) -> f64 {
        let [width, height] = ["width", "height"]
            .map(|name| root.attribute(name)?.trim().strip_suffix("mm").and_then(number::value));
        let view = root.attribute("viewBox").and_then(|view| numbers_in(view, |c| matches!(c, ' ' | ',')));
        let (Some(width), Some(height), Some(&[left_edge, top, w, h])) = (width, height, view.as_deref())
        else {
            let attributes =
                ["width", "height", "viewBox"].map(|name| quote(root.attribute(name).unwrap_or("")));
            let allowed = "width and height in mm, and a viewBox";
            self.blame(root, FindingCode::WrongScale, attributes.join(", "), allowed);
            return 0.0;
        };
        if width != w || height != h || width <= 0.0 || height <= 0.0 {
            let fault = format!("{width} x {height} mm for {w} x {h} user units");
            self.blame(root, FindingCode::WrongScale, fault, "1 user unit = 1 mm, and a size > 0");
        }
        self.drawing.page = Some((width, height));
        self.drawing.corner = Some((left_edge, top));
        h
    }

    fn group(&mut self, node: Node<'_, '_>, id: &str, depth: usize) {
        if depth > DEPTH {
            self.blame(node, FindingCode::TooDeep, "groups in groups", format!("{DEPTH} levels"));
            return;
        }
        for child in node.children().filter(Node::is_element) {
            // Finding the number of a line takes another pass through the file.
            if self.findings.is_full() {
                return;
            }
            if let Some(transform) = child.attribute("transform") {
                self.blame(child, FindingCode::Transform, quote(transform), "coordinates that are final");
            }
            match child.tag_name().name() {
                "g" => {
                    let id = child.attribute("id").unwrap_or(id);
                    let _ = self.drawing.layer_mut(id);
                    self.group(child, id, depth + 1);
                }
                "text" => {
                    let text: String =
                        child.descendants().filter_map(|n| n.text().filter(|_| n.is_text())).collect();
                    self.drawing.texts.push((id.to_owned(), text));
                }
                "title" | "desc" | "metadata" | "style" | "defs" => {}
                name => self.shape(child, name, id),
            }
        }
    }

    fn shape(&mut self, node: Node<'_, '_>, name: &str, id: &str) {
        let paths = match name {
            "path" => {
                let (paths, fault) = svg_path::parse(node.attribute("d").unwrap_or(""));
                self.findings.extend(fault.map(|fault| Finding { line: line_of(node), ..fault }));
                paths
            }
            "circle" => Vec::from_iter(self.circle(node)),
            "line" => self.numbers(node, ["x1", "y1", "x2", "y2"]).map_or_else(Vec::new, |[a, b, c, d]| {
                vec![Path::open(vec![Line::new(Point::new(a, b), Point::new(c, d)).into()])]
            }),
            "rect" => Vec::from_iter(self.rect(node)),
            "polyline" | "polygon" => Vec::from_iter(self.points(node, name == "polygon")),
            _ => {
                self.blame(node, FindingCode::UnknownWord, quote(name), "shapes of lines and arcs");
                Vec::new()
            }
        };
        let flipped = paths.into_iter().map(|path| self.flip.path(&path));
        self.drawing.layer_mut(id).extend(flipped);
    }

    /// Attributes that are numbers; absent ones are 0, as in the SVG standard.
    fn numbers<const N: usize>(&mut self, node: Node<'_, '_>, names: [&str; N]) -> Option<[f64; N]> {
        let mut values = [0.0; N];
        for (value, name) in values.iter_mut().zip(names) {
            let Some(text) = node.attribute(name) else { continue };
            let Some(number) = number::value(text.trim()) else {
                let fault = format!("{name}={}", quote(text));
                self.blame(node, FindingCode::BadNumber, fault, "a plain number");
                return None;
            };
            *value = number;
        }
        Some(values)
    }

    fn circle(&mut self, node: Node<'_, '_>) -> Option<Path> {
        let [x, y, r] = self.numbers(node, ["cx", "cy", "r"])?;
        if r <= 0.0 {
            self.blame(node, FindingCode::BadNumber, format!("r={r}"), "a radius > 0");
            return None;
        }
        Some(Path::closed(vec![Arc::new(Point::new(x, y), r, 0.0, TAU).into()]))
    }

    fn rect(&mut self, node: Node<'_, '_>) -> Option<Path> {
        let [x, y, w, h, rx, ry] = self.numbers(node, ["x", "y", "width", "height", "rx", "ry"])?;
        if w <= 0.0 || h <= 0.0 || rx != 0.0 || ry != 0.0 {
            let fault = format!("{w} x {h}, corners {rx}, {ry}");
            self.blame(node, FindingCode::BadNumber, fault, "a size > 0 and sharp corners");
            return None;
        }
        let corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)].map(|(x, y)| Point::new(x, y));
        Some(chain(&corners, true))
    }

    fn points(&mut self, node: Node<'_, '_>, closed: bool) -> Option<Path> {
        let text = node.attribute("points").unwrap_or("");
        let numbers = numbers_in(text, |c| c.is_ascii_whitespace() || c == ',');
        let Some(numbers) = numbers.filter(|n| n.len() % 2 == 0) else {
            self.blame(node, FindingCode::BadNumber, quote(text), "pairs of numbers");
            return None;
        };
        let points: Vec<Point> = numbers.chunks_exact(2).map(|xy| Point::new(xy[0], xy[1])).collect();
        Some(chain(&points, closed))
    }
}

/// The numbers of a list, with characters between them that are `is_separator`.
fn numbers_in(text: &str, is_separator: impl Fn(char) -> bool) -> Option<Vec<f64>> {
    text.split(is_separator).filter(|word| !word.is_empty()).map(number::value).collect()
}

/// The lines from point to point.
fn chain(points: &[Point], closed: bool) -> Path {
    let back = points.first().filter(|_| closed && points.len() > 1);
    let next = points.iter().skip(1).chain(back);
    let segments = points.iter().zip(next).map(|(a, b)| Line::new(*a, *b).into()).collect();
    Path { segments, closed }
}

/// Line of an element in the file.
pub(in crate::verify) fn line_of(node: Node<'_, '_>) -> Option<usize> {
    usize::try_from(node.document().text_pos_at(node.range().start).row).ok()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn svg(body: &str) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"80mm\" viewBox=\"0 0 100 80\">\n{body}\n</svg>\n"
        )
    }

    fn codes(text: &str) -> Vec<&'static str> {
        read_svg(text, SvgOrigin::LowerLeft).findings.iter().map(|finding| finding.code).collect()
    }

    #[test]
    fn groups_shapes_and_the_flip() {
        let body = "<title>t</title><g id=\"seal\"><path d=\"M10 70 A10 10 0 0 0 20 60 L30 60\"/>\
            <g><line x1=\"1\" y1=\"2\" x2=\"3\" y2=\"2\"/></g></g>\
            <g id=\"holes\"><circle cx=\"50\" cy=\"40\" r=\"1.5\"/><rect x=\"1\" y=\"2\" width=\"3\" height=\"4\"/>\
            <polygon points=\"0,0 3,0 3,4\"/><polyline points=\"0 0 3 0 3 4\"/><text x=\"1\" y=\"1\">up</text></g>";
        let drawing = read_svg(&svg(body), SvgOrigin::LowerLeft);
        assert_eq!(drawing.findings, []);
        assert_eq!(drawing.page, Some((100.0, 80.0)));
        let seal = drawing.layer("seal");
        assert_eq!(seal.len(), 2);
        assert!(seal[0].start().is_some_and(|p| p.distance(Point::new(10.0, 10.0)) < 1e-9));
        assert!(seal[0].end().is_some_and(|p| p.distance(Point::new(30.0, 20.0)) < 1e-9));
        // Sweep 0 turns counterclockwise on the page; about (20, 70) of the file it would be (10, 60).
        let geom::Segment::Arc(arc) = seal[0].segments[0] else { panic!() };
        assert!(arc.is_ccw() && arc.center.distance(Point::new(10.0, 20.0)) < 1e-9, "{arc:?}");
        let lengths: Vec<f64> = drawing.layer("holes").iter().map(Path::length).collect();
        assert_eq!(lengths, [3.0 * std::f64::consts::PI, 14.0, 12.0, 7.0]);
        assert_eq!(drawing.texts, [("holes".to_owned(), "up".to_owned())]);
        assert!(drawing.layer("nowhere").is_empty());
        let axis = read_svg(&svg(body), SvgOrigin::Axis);
        assert!(axis.layer("seal")[0].start().is_some_and(|p| p.distance(Point::new(10.0, -70.0)) < 1e-9));
    }

    #[test]
    fn every_seeded_fault_is_found() {
        for (body, code) in [
            ("<g transform=\"scale(2)\"/>", "transform"),
            ("<path transform=\"\" d=\"\"/>", "transform"),
            ("<path d=\"M0 0 C 1 1 2 2 3 3\"/>", "unknown-word"),
            ("<ellipse/>", "unknown-word"),
            ("<use href=\"#a\"/>", "unknown-word"),
            ("<svg/>", "unknown-word"),
            ("<circle r=\"1in\"/>", "bad-number"),
            ("<circle r=\"-1\"/>", "bad-number"),
            ("<rect width=\"1\" height=\"1\" rx=\"1\"/>", "bad-number"),
            ("<polyline points=\"1 2 3\"/>", "bad-number"),
            ("<g", "bad-xml"),
        ] {
            assert_eq!(codes(&svg(body)), [code], "{body}");
        }
        for (from, to) in [
            ("100mm", "100"),
            ("100mm", "378px"),
            ("80mm", "80.1mm"),
            ("0 0 100 80", "0 0 100"),
            ("viewBox", "box"),
        ] {
            assert_eq!(codes(&svg("").replacen(from, to, 1)), ["wrong-scale"], "{to}");
        }
        assert_eq!(codes("<html/>"), ["bad-xml"]);
        assert_eq!(codes(""), ["bad-xml"]);
        assert_eq!(codes(&svg(&format!("{}{}", "<g>".repeat(100), "</g>".repeat(100)))), ["too-deep"]);
    }

    #[test]
    fn depth_and_entities_are_no_bombs() {
        let deep = svg(&"<g>".repeat(300_000));
        assert_eq!(codes(&deep), ["bad-xml"]);
        let closed = svg(&format!("{}{}", "<g>".repeat(300_000), "</g>".repeat(300_000)));
        assert_eq!(codes(&closed).len(), 1);
        let bomb =
            format!("<!DOCTYPE svg [<!ENTITY a \"&b;&b;\"><!ENTITY b \"x\">]>{}", svg("<text>&a;</text>"));
        assert_eq!(codes(&bomb), ["bad-xml"]);
    }

    #[test]
    fn finding_has_its_line() {
        let drawing = read_svg(&svg("\n\n<ellipse/>"), SvgOrigin::Axis);
        assert_eq!(drawing.findings[0].line, Some(4));
    }

    proptest! {
        #[test]
        fn any_text_is_read(text in "\\PC*") {
            let _ = read_svg(&text, SvgOrigin::LowerLeft);
        }

        #[test]
        fn any_path_is_read(d in "([MLHVAZmlc][0-9 .,eE+-]{0,20}){0,8}|\\PC*") {
            let d = d.replace(['&', '<', '"'], " ");
            let drawing = read_svg(&svg(&format!("<path d=\"{d}\"/>")), SvgOrigin::LowerLeft);
            prop_assert!(drawing.layer("").iter().all(|path| path.length().is_finite()));
        }
    }
}
