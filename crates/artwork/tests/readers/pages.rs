//! Sizes of pages, their units, and encodings of files.

use artwork::{Artwork, AssumedUnit, Figure, Format, Options, Unit, read, read_dxf, read_svg};
use geom::Bounds;

/// A rectangle of 100 x 60 units at (20, 30) in an SVG with these attributes.
fn text(attributes: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' {attributes}>\
         <rect x='20' y='30' width='100' height='60'/></svg>"
    )
}

fn options(unit: Option<Unit>, assume: bool) -> Options {
    Options { unit, assume, ..Options::new(0.01) }
}

fn bounds(drawing: &Artwork) -> Bounds {
    let Figure::Path(path) = &drawing.elements[0].figure else { panic!("a path") };
    path.bounds()
}

/// The size of the rectangle by the unit that is given or stated.
fn size(attributes: &str, unit: Option<Unit>) -> [f64; 2] {
    let drawing = read_svg(text(attributes).as_bytes(), &options(unit, false));
    let bounds = bounds(&drawing.unwrap_or_else(|faults| panic!("{attributes}: {faults:?}")));
    [bounds.width(), bounds.height()]
}

/// A unit that is given makes of a page what the same unit behind its numbers would.
#[test]
fn a_given_unit_is_that_of_width_and_height() {
    for unit in [Unit::Pixel, Unit::Millimetre, Unit::Inch, Unit::Point] {
        for ratio in ["", "preserveAspectRatio='none'", "preserveAspectRatio='xMinYMax slice'"] {
            for view in ["viewBox='0 0 375 375'", "viewBox='-5 -5 375 250'", "viewBox='0 0 1000 10'"] {
                let page = |unit: &str| format!("width='500{unit}' height='400{unit}' {view} {ratio}");
                let wanted =
                    read_svg(text(&page(unit.name())).as_bytes(), &options(None, false)).expect("a drawing");
                for own in ["", "px", "mm"] {
                    let drawing = read_svg(text(&page(own)).as_bytes(), &options(Some(unit), false))
                        .expect("a drawing");
                    assert_eq!(bounds(&drawing), bounds(&wanted), "{own} {unit:?} {ratio} {view}");
                }
            }
        }
        // Without a size of the page a unit of the view box is the unit itself.
        let [width, height] = size("width='100%' viewBox='0 0 375 375'", Some(unit));
        assert!(
            (width / unit.millimetres() - 100.0).abs() < 1e-9
                && (height / unit.millimetres() - 60.0).abs() < 1e-9
        );
    }
    // With two scales.
    let [width, height] = size(
        "width='500' height='100' viewBox='0 0 100 100' preserveAspectRatio='none'",
        Some(Unit::Millimetre),
    );
    assert!((width - 500.0).abs() < 1e-9 && (height - 60.0).abs() < 1e-9);
}

/// The program that saved a file last says what its plain numbers are.
#[test]
fn the_last_writer_decides() {
    let illustrator = "<!-- Generator: Adobe Illustrator 26.0.0 -->";
    let read = |comment: &str, attributes: &str, assume: bool| {
        read_svg(format!("{comment}{}", text(attributes)).as_bytes(), &options(None, assume))
    };
    let view = "viewBox='0 0 288 144'";
    let new = "inkscape:version='1.3.2 (091e20e, 2023-11-25)'";
    let old = "inkscape:version='0.48.4 r9939'";
    let pixel = 25.4 / 96.0;
    for size in ["width='288' height='144'", "width='288px' height='144px'", ""] {
        let by_inkscape = read(illustrator, &format!("{view} {size} {new}"), false).expect("a drawing");
        assert!((by_inkscape.unit_mm - pixel).abs() < 1e-12, "{size}");
        // A stated size needs no note.
        assert_eq!(by_inkscape.notes.is_empty(), size.contains("px"), "{size}: {:?}", by_inkscape.notes);
        for comment in [illustrator, ""] {
            let attributes = format!("{view} {size} {old}");
            assert!(read(comment, &attributes, false).expect_err("unclear")[0].remedy.contains("px90"));
            let assumed = read(comment, &attributes, true).expect("a drawing");
            assert!((assumed.unit_mm - 25.4 / 90.0).abs() < 1e-12 && assumed.assumed.is_some());
        }
        let by_illustrator = read(illustrator, &format!("{view} {size}"), true).expect("a drawing");
        assert!((by_illustrator.unit_mm - 25.4 / 72.0).abs() < 1e-12, "{size}");
        assert!(by_illustrator.assumed.is_some() || !by_illustrator.notes.is_empty());
    }
    // Old Inkscape: a size in mm is one, with a view box; without it the coordinates are 1/90 in.
    let sized = read("", &format!("width='288mm' height='144mm' {view} {old}"), false).expect("a drawing");
    assert!((sized.unit_mm - 1.0).abs() < 1e-12);
    let no_view = format!("width='210mm' height='297mm' {old}");
    assert!(read("", &no_view, false).is_err());
    let assumed = read("", &no_view, true).expect("a drawing");
    assert!((assumed.unit_mm - 25.4 / 90.0).abs() < 1e-12);
    assert!((bounds(&assumed).max.y - (297.0 - 30.0 * 25.4 / 90.0)).abs() < 1e-9, "the page is 297 mm high");
    // Nothing is known.
    let unknown = read("", "width='288' height='144'", true).expect("a drawing");
    assert!(matches!(unknown.assumed, Some(AssumedUnit { unit: Unit::Millimetre, .. })));
}

/// Lines that end as on old Macs, and two bytes a character.
#[test]
fn encodings_and_line_ends_change_nothing() {
    let svg = text("width='140mm' height='100mm' viewBox='0 0 140 100'").replace("><rect", ">\n<rect");
    let dxf = "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|ENTITIES|0|CIRCLE|5|A|8|\u{e4}|10|0|20|0|40|9|0|ENDSEC|0|EOF|"
        .replace('|', "\n");
    let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    for (name, text) in [("a.svg", &svg), ("a.dxf", &dxf)] {
        let wanted = read(name, text.as_bytes(), &options(None, false)).expect("a drawing");
        for bytes in [
            text.replace('\n', "\r").into_bytes(),
            text.replace('\n', "\r\n").into_bytes(),
            wide(text),
            [&[0xff, 0xfe][..], &wide(text)].concat(),
            [&[0xef, 0xbb, 0xbf][..], text.as_bytes()].concat(),
        ] {
            let drawing = read(name, &bytes, &options(None, false))
                .unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
            assert_eq!(drawing.elements, wanted.elements, "{name}");
        }
    }
    assert_eq!(Format::of_name("\u{56fe}\u{7eb8}.SVG"), Some(Format::Svg));
    let latin: Vec<u8> = dxf.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect();
    let drawing = read_dxf(&latin, &options(None, false)).expect("a drawing");
    assert_eq!(drawing.elements[0].layers, ["\u{e4}"]);
}
