//! Refusals, notes and limits, with their places.

#![expect(clippy::format_collect, reason = "short texts are put together")]

use std::fmt::Write;

use artwork::{Artwork, Fault, Figure, Limits, Note, Options, Place, Unit, Weight, read, read_dxf, read_svg};
use geom::Point;

fn options() -> Options {
    Options { unit: Some(Unit::Millimetre), ..Options::new(0.01) }
}

fn svg_text(body: &str) -> String {
    format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'>\n{body}</svg>")
}

fn svg(body: &str) -> Result<Artwork, Vec<Fault>> {
    read_svg(svg_text(body).as_bytes(), &options())
}

/// The reasons for which the file is refused, or the faults of its elements.
fn faults(body: &str) -> Vec<Fault> {
    svg(body).map_or_else(|faults| faults, |drawing| drawing.faults)
}

fn entities(pairs: &str) -> String {
    format!("0|SECTION|2|ENTITIES|{pairs}|0|ENDSEC|0|EOF").replace('|', "\n")
}

fn dxf_faults(text: &str) -> Vec<Fault> {
    read_dxf(text.as_bytes(), &options()).map_or_else(|faults| faults, |drawing| drawing.faults)
}

/// A chain of references is bounded as groups are: each level costs the stack and copies of all names around it.
#[test]
fn references_have_a_depth() {
    let chain: String = (0..5000).map(|i| format!("<use id='b{}' href='#b{i}'/>", i + 1)).collect();
    let found = faults(&format!("<defs><path id='b0' d='M0 0h1'/>{chain}</defs><use href='#b5000'/>"));
    assert!(found.len() == 1 && found[0].text.contains("more than 64 levels deep"), "{found:?}");
    assert!(svg("<defs><path id='a' d='M0 0h1'/><use id='b' href='#a'/></defs><use href='#b'/>").is_ok());
}

/// A parameter so large that a quarter of a turn is lost in it once was cut into quarters for ever.
#[test]
fn an_ellipse_ends_wherever_it_starts() {
    let text = entities("0|ELLIPSE|10|0|20|0|11|3|21|1|40|.4|41|5.5e105|42|3");
    let drawing = read_dxf(text.as_bytes(), &options()).expect("a drawing");
    assert!(matches!(&drawing.elements[0].figure, Figure::Path(path) if path.length() < 30.0));
}

#[test]
fn all_faults_are_told_at_once_with_their_places() {
    let found = faults(
        "<path id='p' d='M0 0L1'/>\n<circle r='-1'/>\n<g id='g' transform='turn(3)'><path d='M0 0'/></g>\n\
         <rect width='1em' height='1'/>\n<use id='u' href='#u'/>\n<polygon points='1 2 3'/>\n<path style='transform: none; d: none'/>\
         <line id='far' x2='2e6'/>\n<line id='inf' x2='1e999'/>\n<path id='css' style='transform:scale(2)' d='M0 0h1'/>",
    );
    let lines: Vec<_> = found.iter().map(|fault| fault.place.line).collect();
    assert_eq!(lines, [2, 3, 4, 5, 6, 7, 8, 9, 10].map(Some), "{found:#?}");
    assert_eq!(found[0].place.element.as_deref(), Some("p"));
    assert!(found.iter().all(|fault| !fault.remedy.is_empty()));
    let text = entities(
        "0|LINE|5|A|10|0|20|nan|11|1|21|1|0|CIRCLE|5|B|8|w|10|0|20|0|0|INSERT|5|C|2|none|10|0|20|0|0|SPLINE|5|D|71|3|10|1|20|1",
    );
    let found = dxf_faults(&text);
    let places: Vec<_> =
        found.iter().map(|fault| (fault.place.element.as_deref(), fault.place.line)).collect();
    assert_eq!(
        places,
        [
            (Some("LINE A"), Some(12)),
            (Some("CIRCLE B"), Some(17)),
            (Some("INSERT C"), Some(27)),
            (Some("SPLINE D"), Some(37))
        ]
    );
    assert_eq!(found[1].place.layers, ["w"]);
    assert_eq!(found[2].place.at, Some(Point::ORIGIN));
}

#[test]
fn a_page_has_no_negative_size() {
    for (size, side) in [("width='-9mm' height='9mm'", "width"), ("width='9mm' height='-1'", "height")] {
        let text = format!("<svg {size} viewBox='0 0 9 9'><path d='M0 0h1'/></svg>");
        for unit in [None, Some(artwork::Unit::Millimetre)] {
            let found = read_svg(text.as_bytes(), &Options { unit, ..options() }).expect_err(size);
            assert_eq!(found[0].text, format!("The {side} of the page is negative."));
        }
    }
    let nested = faults("<svg width='-1'><path d='M0 0h1'/></svg>");
    assert_eq!(nested[0].text, "Its width or height is negative.");
}

#[test]
fn other_formats_and_endings_are_named() {
    let says = |name: &str, bytes: &[u8], word: &str| {
        let found = read(name, bytes, &options()).expect_err(name);
        assert!(found.len() == 1 && found[0].to_string().contains(word), "{found:?}");
    };
    says("a.dxf", b"AutoCAD Binary DXF\r\n\x1a\0", "ASCII DXF");
    says("a.DXF", b"AC1032\0\0", "DWG");
    says("a.svg", b"\x1f\x8b\x08", "gunzip");
    says("a.svg", b"  0\nSECTION\n", "DXF, not SVG");
    says("a.dxf", b"<svg/>", "SVG, not DXF");
    says("a.pdf", b"%PDF", "\"pdf\"");
    says("a", b"", "no ending");
    says("a.svg", b"", "empty");
    says("a.svg", b"\xff\xfe<\0", "well-formed");
    says("a.svg", b"<svg>\n\n\xe4</svg>", "line 3");
    says("a.svg", b"<svg>", "well-formed");
    says("a.svg", b"<html/>", "<html>");
    says("a.dxf", b"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n", "end mark");
    says("a.dxf", b"0\nSECTION\nx\n", "line 3");
    says("a.dxf", b"0\nEOF\n", "ENTITIES");
    let wrong = Options::new(f64::NAN);
    assert!(read("a.svg", b"<svg/>", &wrong).expect_err("NaN")[0].text.contains("tolerance"));
}

#[test]
fn a_size_without_a_unit_is_a_fault_and_a_given_unit_wins() {
    for size in
        ["", "width='100' height='100'", "width='100%' height='100%' viewBox='0 0 5 5'", "viewBox='0 0 5 5'"]
    {
        let text = format!("<svg {size}><path d='M0 0h1'/></svg>");
        let found = read_svg(text.as_bytes(), &Options::new(0.01)).expect_err(size);
        assert!(found.len() == 1 && found[0].text.contains("physical size"), "{found:?}");
        let drawing = read_svg(text.as_bytes(), &options()).expect(size);
        let Figure::Path(path) = &drawing.elements[0].figure else { panic!("a path") };
        assert_eq!(path.length(), 1.0, "{size}");
    }
    let text = b"<svg width='14m' height='3m' viewBox='0 0 5 5'><path d='M0 0h1'/></svg>";
    let faults = read_svg(text, &Options::new(0.01)).expect_err("m is no unit of SVG");
    assert!(faults[0].text.contains("the width is \"14m\", which is no length with mm"), "{faults:?}");
    for (size, unit_mm) in
        [("width='96px' height='96px'", 25.4 / 96.0), ("width='1in' viewBox='0 0 10 10'", 2.54)]
    {
        let text = format!("<svg {size}><path d='M0 0h1'/></svg>");
        let drawing = read_svg(text.as_bytes(), &Options::new(0.01)).expect(size);
        assert!((drawing.unit_mm - unit_mm).abs() < 1e-12);
        let given = read_svg(text.as_bytes(), &options()).expect(size);
        // The unit is that of width and height: 10 units of the view box are 1 mm.
        let wanted = if size.contains("viewBox") { 0.1 } else { 1.0 };
        assert!((given.unit_mm - wanted).abs() < 1e-12, "{size}: {}", given.unit_mm);
        assert!(given.notes[0].text.contains("replaces"), "{:?}", given.notes);
    }
    let old = "<svg xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' inkscape:version='0.48.4 r9939' width='210mm' height='297mm'/>";
    assert!(read_svg(old.as_bytes(), &Options::new(0.01)).expect_err("90 dpi")[0].text.contains("1/90"));
}

#[test]
fn lost_geometry_is_noted_with_its_layers() {
    let drawing = svg(
        "<g id='notes'><text id='t'>x</text><image id='i' href='a.png'/></g><script id='s'/><use id='u' href='b.svg#x'/><use id='v' href='#x'/>\
         <rect id='r' width='1' height='1' clip-path='url(#c)' fill='url(#g)'/><path id='m' d='M0 0h1' style='marker-end:url(#a)'/>\
         <foo id='f'/><rect id='h' width='1' height='1' visibility='hidden'/><circle id='z'/><ellipse id='y' rx='2' ry='0'/><defs><text>unseen</text></defs>",
    )
    .expect("a drawing");
    let found = |weight| -> Vec<&str> {
        let notes = drawing.notes.iter().filter(|note: &&Note| note.weight == weight);
        notes.map(|note| note.place.element.as_deref().unwrap_or_default()).collect()
    };
    assert_eq!(found(Weight::Annotation), ["t"]);
    assert_eq!(found(Weight::Lost), ["i", "s", "u", "v", "f"]);
    assert_eq!(found(Weight::Information), ["r", "m", "z", "y"]);
    assert_eq!(found(Weight::Hidden), ["h"]);
    assert_eq!(found(Weight::Changed), ["r"]);
    assert_eq!(drawing.notes[0].place.layers, ["t", "notes"]);
    assert_eq!(drawing.elements.iter().map(|element| element.id.as_str()).collect::<Vec<_>>(), ["r", "m"]);
}

#[test]
fn figures_without_length_are_points() {
    let drawing =
        svg("<circle id='a' cx='1' cy='2' r='0'/><path id='b' d='M3 4zM5 5'/><line id='c' x1='5' x2='5'/>");
    let drawing = drawing.expect("a drawing");
    let points: Vec<_> = drawing.elements.iter().map(|element| element.figure.clone()).collect();
    let point = |x, y| Figure::Point(Point::new(x, y));
    assert_eq!(points, [point(1.0, 8.0), point(3.0, 6.0), point(5.0, 10.0)]);
    assert_eq!(drawing.notes.len(), 3);
}

#[test]
fn subpaths_have_numbers_and_ends_that_meet_are_closed() {
    let drawing = svg("<path id='a' d='M0 0h3v3h-3zM5 5l1 0 0 1 -1 -1M7 7h1'/>").expect("a drawing");
    let found = drawing.elements.iter().map(|element| match &element.figure {
        Figure::Path(path) => (element.id.as_str(), path.closed, path.segments.len()),
        Figure::Point(_) => panic!("{element:?}"),
    });
    assert_eq!(found.collect::<Vec<_>>(), [("a", true, 4), ("a#2", true, 3), ("a#3", false, 1)]);
}

#[test]
fn references_cannot_multiply_work() {
    // Ten levels of ten references: 10^10 lines.
    let mut body = "<g id='g0'><path d='M0 0h1'/></g>".to_owned();
    for level in 1..=10 {
        let uses = format!("<use href='#g{}'/>", level - 1).repeat(10);
        write!(body, "<g id='g{level}'>{uses}</g>").expect("a string");
    }
    let found = faults(&body);
    assert!(found.len() == 1 && found[0].text.contains("more than"), "{found:?}");
    // The same text again and again.
    let long = "1 ".repeat(100_000);
    let body = format!("<path id='p' d='M0 0L{long}'/>{}", "<use href='#p'/>".repeat(2000));
    assert!(faults(&body)[0].text.contains("more than"));
    // References in a circle, and deep groups.
    let circle = faults("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>");
    assert!(circle.iter().all(|fault| fault.text.contains("itself")), "{circle:?}");
    let deep = format!("{}{}", "<g>".repeat(5000), "</g>".repeat(5000));
    assert!(faults(&deep)[0].text.contains("levels"));
    // Blocks: each inserts the one before a million times.
    let block = "0|SECTION|2|BLOCKS|0|BLOCK|2|a|10|0|20|0|0|LINE|10|0|20|0|11|1|21|0|0|ENDBLK\
                 |0|BLOCK|2|b|10|0|20|0|0|INSERT|2|a|10|0|20|0|70|1000|71|1000|0|ENDBLK\
                 |0|BLOCK|2|c|10|0|20|0|0|INSERT|2|c|10|0|20|0|0|ENDBLK|0|ENDSEC";
    let file = |name: &str| {
        format!(
            "{}\n{}",
            block.replace('|', "\n"),
            entities(&format!("0|INSERT|2|{name}|10|0|20|0|70|32767|71|32767"))
        )
    };
    assert!(dxf_faults(&file("b"))[0].text.contains("more than"));
    assert!(dxf_faults(&file("c"))[0].text.contains("itself"));
}

#[test]
fn the_parser_is_not_asked_for_more_than_linear_work() {
    let attributes: String = (0..300).map(|i| format!(" a{i}='1'")).collect();
    assert!(faults(&format!("<!-- ' --><path{attributes}/>"))[0].text.contains("attributes"));
    let spaces: String = (0..5000).map(|i| format!("<g xmlns:a{i}='b'/>")).collect();
    assert!(faults(&spaces)[0].text.contains("namespaces"));
    let laughs = "<!DOCTYPE svg [<!ENTITY a 'ha'><!ENTITY b '&a;&a;'>]><svg>&b;</svg>";
    assert!(read_svg(laughs.as_bytes(), &options()).expect_err("entities")[0].text.contains("entities"));
    let long =
        format!("<!DOCTYPE svg [<!ENTITY a '{}'>]><svg>{}</svg>", "x".repeat(100_000), "&a;".repeat(1000));
    assert!(read_svg(long.as_bytes(), &options()).expect_err("entities")[0].text.contains("entities"));
    let external = "<!DOCTYPE svg [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><svg width='1mm' viewBox='0 0 1 1'><text>&a;</text></svg>";
    assert!(read_svg(external.as_bytes(), &options()).is_err());
}

#[test]
fn limits_hold() {
    let limits = Limits { segments: 10, ..Limits::default() };
    let text = svg_text("<path d='M0 0h1h1h1h1h1h1h1h1h1h1h1'/>");
    let found = read_svg(text.as_bytes(), &Options { limits, ..options() }).expect_err("eleven lines");
    assert!(found[0].text.contains("more than 10 lines"), "{found:?}");
    let limits = Limits { bytes: 10, ..Limits::default() };
    assert!(
        read_svg(text.as_bytes(), &Options { limits, ..options() }).expect_err("bytes")[0]
            .text
            .contains("bytes")
    );
    let many = "<path/>".repeat(600_000);
    assert!(faults(&many)[0].text.contains("more than"));
}

#[test]
fn places_are_told_in_words() {
    let place = Place {
        element: Some("path3".into()),
        line: Some(7),
        at: Some(Point::new(1.0, 2.0)),
        ..Place::default()
    };
    assert_eq!(place.to_string(), "path3 (line 7) at (1.000, 2.000) mm");
    let place = Place { element: Some("path at line 7".into()), line: Some(7), ..Place::default() };
    assert_eq!(place.to_string(), "path at line 7");
}
