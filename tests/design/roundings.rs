//! The shipped drawings, written again with few decimals and with Beziers alone: they stay the same pieces.

use std::fmt::Write;
use std::fs;
use std::path::Path as File;

use stargrip_cam::artwork::{self, Element, Figure, Options};
use stargrip_cam::design::{Design, DrawnPiece};
use stargrip_cam::geom::{Path, Point, Segment};
use stargrip_cam::spec::{self, Source};

use crate::support;

const DESIGNS: [(&str, &str); 4] = [
    ("bending-finger.toml", "bending-finger.svg"),
    ("hand-rest.toml", "hand-rest.svg"),
    ("letters.toml", "letters.svg"),
    ("pillow.toml", "pillow.dxf"),
];

/// The curves of a file written again.
#[derive(Clone, Copy, Debug)]
enum Form {
    /// Lines and arcs.
    Exact,
    /// Cubic Beziers alone, the lines too.
    Cubic,
}

/// The shape of the spec `text` with another drawing.
fn piece(text: &str, file: &str, bytes: &[u8]) -> DrawnPiece {
    let text = text.replace(file, "again.svg").replace("units =", "# units =");
    let reading = spec::read(&Source::new("again", &text)).unwrap_or_else(|faults| panic!("{faults}"));
    let design = Design::new(&reading.with_drawing(bytes).spec, &support::machine());
    let design = design.unwrap_or_else(|faults| panic!("{}", faults.to_string()));
    design.drawn_pieces().expect("a drawing").pieces[0].clone()
}

/// The elements as an SVG of so many decimals, on layers of their own names.
fn svg_of(elements: &[Element], decimals: usize, form: Form) -> String {
    let mut text = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2000mm\" height=\"2000mm\" viewBox=\"0 -2000 2000 2000\">\n",
    );
    for Element { layers, figure, .. } in elements {
        let groups = layers.iter().rev().filter(|name| !name.starts_with('#'));
        let groups: Vec<String> = groups.map(|name| format!("<g id=\"{name}\">")).collect();
        let stroke = layers.iter().find(|name| name.starts_with('#')).map_or("#000000", String::as_str);
        let data = match figure {
            Figure::Point(p) => format!("M{:.decimals$} {:.decimals$}Z", p.x, -p.y),
            Figure::Path(path) => data(path, decimals, form),
        };
        let ends = "</g>".repeat(groups.len());
        let _ = writeln!(text, "{}<path stroke=\"{stroke}\" d=\"{data}\"/>{ends}", groups.concat());
    }
    text + "</svg>\n"
}

fn data(path: &Path, decimals: usize, form: Form) -> String {
    let place = |p: Point| format!(" {:.decimals$} {:.decimals$}", p.x, -p.y);
    let mut data_text = format!("M{}", place(path.start().expect("a start")));
    for segment in &path.segments {
        // A fifth of a radian for a Bezier, whose distance from the arc is then below a nanometre; a quarter turn for an arc.
        let (length, step) = match (segment, form) {
            (Segment::Arc(arc), Form::Cubic) => (arc.sweep.abs(), 0.2),
            (Segment::Arc(arc), Form::Exact) => (arc.sweep.abs(), 1.6),
            (Segment::Line(_), _) => (0.0, 1.0),
        };
        let count = (length / step).ceil().max(1.0);
        let mut i = 0.0;
        while i < count {
            let part = segment.part(i / count, (i + 1.0) / count);
            i += 1.0;
            let command = match (part, form) {
                (Segment::Line(line), Form::Exact) => format!("L{}", place(line.end)),
                (Segment::Arc(arc), Form::Exact) => {
                    let (r, flag) = (arc.radius, u8::from(arc.sweep < 0.0));
                    format!("A {r:.decimals$} {r:.decimals$} 0 0 {flag}{}", place(arc.end()))
                }
                (part, Form::Cubic) => {
                    let reach = match part {
                        Segment::Line(line) => line.length() / 3.0,
                        Segment::Arc(arc) => arc.radius * 4.0 / 3.0 * (arc.sweep.abs() / 4.0).tan(),
                    };
                    let first = part.start() + part.tangent(0.0) * reach;
                    let second = part.end() - part.tangent(1.0) * reach;
                    format!("C{}{}{}", place(first), place(second), place(part.end()))
                }
            };
            data_text.push_str(&command);
        }
    }
    data_text + if path.closed { "Z" } else { "" }
}

/// Largest distance of the seams of one piece from those of the other.
fn distance(first: &DrawnPiece, other: &DrawnPiece) -> f64 {
    let lines = |piece: &DrawnPiece| -> Vec<Path> {
        piece.shape.seams.iter().map(|seam| seam.center_line.clone()).collect()
    };
    let (lines, other_lines) = (lines(first), lines(other));
    let places = lines.iter().flat_map(|line| &line.segments).map(|segment| segment.point(0.4));
    let distance_to_others =
        |p: Point| other_lines.iter().map(|line| line.distance(p)).fold(f64::INFINITY, f64::min);
    places.map(distance_to_others).fold(0.0, f64::max)
}

#[test]
fn drawings_of_any_rounding_and_form_are_the_same_pieces() {
    let dir = File::new(env!("CARGO_MANIFEST_DIR")).join("designs/drawings");
    for (spec, file) in DESIGNS {
        let text = fs::read_to_string(dir.join(spec)).expect("shipped");
        let bytes = fs::read(dir.join(file)).expect("shipped");
        let drawing = artwork::read(file, &bytes, &Options::new(1e-5)).expect("a drawing");
        let exact = piece(&text, file, svg_of(&drawing.elements, 12, Form::Exact).as_bytes());
        for form in [Form::Exact, Form::Cubic] {
            for decimals in 2..=8 {
                let rounded = piece(&text, file, svg_of(&drawing.elements, decimals, form).as_bytes());
                assert_eq!(rounded.shape.seams.len(), exact.shape.seams.len(), "{file} {form:?} {decimals}");
                let digits = i32::try_from(decimals).expect("few");
                let allowed = 0.002 + 5.0 * 10_f64.powi(-digits);
                let separation = distance(&rounded, &exact).max(distance(&exact, &rounded));
                assert!(separation <= allowed, "{file} {form:?} {decimals}: {separation}");
            }
        }
    }
}
