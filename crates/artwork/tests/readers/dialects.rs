//! Files as drawing programs write them, shortened.

#![expect(clippy::format_push_string, clippy::needless_for_each, reason = "short texts are put together")]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use artwork::{Artwork, Element, Figure, Options, Unit, Weight, read_dxf, read_svg};
use geom::{Path, Point, Segment};

fn svg(text: &str) -> Artwork {
    read_svg(text.as_bytes(), &Options::new(0.01)).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn dxf(text: &str) -> Artwork {
    read_dxf(text.as_bytes(), &Options::new(0.01)).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn element<'d>(drawing: &'d Artwork, id: &str) -> &'d Element {
    let found = drawing.elements.iter().find(|element| element.id == id);
    found.unwrap_or_else(|| {
        panic!("no {id} in {:?}", drawing.elements.iter().map(|e| &e.id).collect::<Vec<_>>())
    })
}

fn path<'d>(drawing: &'d Artwork, id: &str) -> &'d Path {
    match &element(drawing, id).figure {
        Figure::Path(path) => path,
        Figure::Point(point) => panic!("{id} is the point {point:?}"),
    }
}

fn near(p: Point, x: f64, y: f64) -> bool {
    p.distance(Point::new(x, y)) < 1e-9
}

/// The texts of the notes on lost geometry, each with its element.
fn lost(drawing: &Artwork) -> Vec<(String, String)> {
    let is_lost = |weight| matches!(weight, Weight::Lost | Weight::Changed | Weight::Annotation);
    let lost = drawing.notes.iter().filter(|note| is_lost(note.weight));
    lost.map(|note| (note.place.element.clone().unwrap_or_default(), note.text.clone())).collect()
}

#[test]
fn inkscape_layers_labels_clones_and_hidden_layers() {
    let drawing = svg(r##"<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!-- Created with Inkscape (http://www.inkscape.org/) -->
<svg width="210mm" height="297mm" viewBox="0 0 210 297" version="1.1" id="svg5" inkscape:version="1.2.2 (b0a8486541, 2022-12-01)"
   sodipodi:docname="rest.svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
   xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" xmlns="http://www.w3.org/2000/svg">
  <sodipodi:namedview id="namedview7" pagecolor="#ffffff" inkscape:document-units="mm"/>
  <defs id="defs2"/>
  <g inkscape:label="chamber" inkscape:groupmode="layer" id="layer1" transform="translate(10,20)">
    <path style="fill:none;stroke:#0000FF;stroke-width:0.26" d="m 50,50 a 20,20 0 0 1 -20,20 20,20 0 0 1 -20,-20 20,20 0 0 1 20,-20 20,20 0 0 1 20,20 z" id="path10" sodipodi:type="arc"/>
    <rect style="fill:none;stroke:rgb(255, 0, 0)" id="rect12" width="40" height="30" x="60" y="10" ry="5" inkscape:label="weld"/>
    <use x="0" y="0" xlink:href="#rect12" id="use14" transform="translate(0,100)" xmlns:xlink="http://www.w3.org/1999/xlink"/>
    <text x="1" y="2" id="text16"><tspan>note</tspan></text>
  </g>
  <g inkscape:label="old" inkscape:groupmode="layer" id="layer2" style="display:none"><path d="M0 0L1 1" id="p3"/></g>
</svg>"##);
    assert_eq!(drawing.unit_mm, 1.0);
    assert_eq!(drawing.elements.len(), 3);
    let circle = path(&drawing, "path10");
    assert!(circle.closed && circle.segments.len() == 4 && (circle.length() - 40.0 * PI).abs() < 1e-9);
    assert!(near(circle.start().unwrap(), 60.0, 297.0 - 70.0));
    assert_eq!(element(&drawing, "path10").layers, ["path10", "#0000ff", "layer1", "chamber", "svg5"]);
    assert_eq!(element(&drawing, "path10").line, Some(9));
    let rect = path(&drawing, "rect12");
    assert_eq!(rect.segments.len(), 8);
    assert!((rect.length() - (60.0 + 40.0 + 10.0 * PI)).abs() < 1e-9 && rect.largest_gap() < 1e-12);
    let copy = element(&drawing, "use14 > rect12");
    assert_eq!(copy.layers, ["rect12", "weld", "#ff0000", "use14", "layer1", "chamber", "svg5"]);
    assert!(near(path(&drawing, "use14 > rect12").start().unwrap(), 75.0, 297.0 - 130.0));
    assert_eq!(lost(&drawing).len(), 1);
    assert_eq!(lost(&drawing)[0].0, "text16");
    assert!(
        drawing.notes.iter().any(|note| note.place.element.as_deref() == Some("layer2")),
        "{:?}",
        drawing.notes
    );
}

/// CSS has units in capitals, too, and quarters of a millimetre; programs leave a blank before the unit.
#[test]
fn units_are_read_in_all_spellings() {
    let read = |[width, height, r]: [&str; 3]| {
        let text = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 200 100"><circle id="c" r="{r}"/></svg>"#
        );
        read_svg(text.as_bytes(), &Options::new(0.01))
    };
    for (size, r) in [
        (["200mm", "100mm"], "10"),
        (["200MM", "10Cm"], "10"),
        (["800Q", "400q"], "1e1"),
        (["200 mm", " 100  mm "], "10"),
        (["2E2mm", "1e+2MM"], "10"),
    ] {
        let drawing = read([size[0], size[1], r]).unwrap_or_else(|faults| panic!("{size:?}: {faults:?}"));
        assert!((drawing.unit_mm - 1.0).abs() < 1e-12, "{size:?}: {}", drawing.unit_mm);
        let circle = path(&drawing, "c");
        assert!((circle.length() - 20.0 * PI).abs() < 1e-9, "{size:?}: {}", circle.length());
    }
    // A pixel is 25.4/96 mm, a quarter 0.25 mm.
    let drawing = read(["200mm", "100mm", "40Q"]).expect("a drawing");
    assert!((path(&drawing, "c").length() - 2.0 * PI * 10.0 * 96.0 / 25.4).abs() < 1e-9);
    for wrong in ["200 m m", "mm", "200 mmm", "2 00mm", ""] {
        assert!(read([wrong, wrong, "10"]).is_err(), "{wrong}");
    }
}

#[test]
fn a_dashed_line_is_read_whole_with_a_note() {
    let notes = |group: &str, path: &str| {
        let text = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="99mm" height="99mm" viewBox="0 0 99 99"><g stroke="red" {group}><path {path} d="M0 0h9"/></g></svg>"#
        );
        let drawing = read_svg(text.as_bytes(), &Options::new(0.01)).expect("a drawing");
        assert!((drawing.elements.len(), drawing.unit_mm) == (1, 1.0));
        drawing.notes.into_iter().filter(|note| note.text.contains("dashed")).count()
    };
    let dashes = r#"stroke-dasharray="4 2""#;
    assert_eq!(
        [notes("", dashes), notes(dashes, ""), notes("", r#"style="stroke-dasharray:1mm,0""#)],
        [1; 3]
    );
    assert_eq!(
        [notes("", ""), notes("", r#"stroke-dasharray="0""#), notes(dashes, r#"stroke-dasharray="none""#)],
        [0; 3]
    );
    assert_eq!(notes(dashes, r#"stroke="none""#), 0);
}

/// Of a switch the first child is drawn whose conditions hold, and no element whose own do not.
#[test]
fn conditional_elements_are_drawn_where_their_conditions_hold() {
    let read = |body: &str| {
        let text = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="99mm" height="99mm" viewBox="0 0 99 99">{body}</svg>"#
        );
        let drawing = read_svg(text.as_bytes(), &Options::new(0.01)).expect("a drawing");
        let ids: Vec<String> = drawing.elements.iter().map(|element| element.id.clone()).collect();
        (ids.join(" "), drawing.notes)
    };
    let line = |id: &str, condition: &str| format!(r#"<path id="{id}" {condition} d="M0 0h9"/>"#);
    let feature = |name: &str| format!(r#"requiredFeatures="http://www.w3.org/TR/SVG11/feature#{name}""#);
    let met = [
        String::new(),
        feature("Shape"),
        r#"systemLanguage="de, en-GB""#.into(),
        r#"systemLanguage="EN""#.into(),
    ];
    let unmet = [
        feature("Extensibility"),
        r#"requiredFeatures="""#.into(),
        r#"requiredFeatures="org.example""#.into(),
        r#"requiredExtensions="http://ns.adobe.com/Extensibility/1.0/""#.into(),
        r#"systemLanguage="xx""#.into(),
        r#"systemLanguage="english""#.into(),
    ];
    for good in &met {
        for bad in &unmet {
            let both = line("bad", bad) + &line("good", good);
            assert_eq!(read(&both).0, "good", "{both}");
            let (found, notes) =
                read(&format!("<switch><title>t</title>{both}{}</switch>", line("later", "")));
            assert_eq!(found, "good", "{both}");
            // The language of a reader is not known.
            let told = notes.iter().any(|note| note.text.contains("It is hidden (systemLanguage \""));
            assert_eq!(told, bad.starts_with("systemLanguage"), "{notes:?}");
        }
    }
    let (none, notes) = read(&line("bad", r#"systemLanguage="de""#));
    assert!(
        none.is_empty() && notes[0].text == "It is hidden (systemLanguage \"de\"), and is left out.",
        "{notes:?}"
    );
}

#[test]
fn illustrator_entities_classes_switch_and_its_pixels() {
    let text = r#"<?xml version="1.0" encoding="utf-8"?>
<!-- Generator: Adobe Illustrator 24.0.1, SVG Export Plug-In . SVG Version: 6.00 Build 0)  -->
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd" [
	<!ENTITY ns_extend "http://ns.adobe.com/Extensibility/1.0/">
	<!ENTITY ns_svg "http://www.w3.org/2000/svg">
]>
<svg version="1.1" id="Layer_1" xmlns:x="&ns_extend;" xmlns="&ns_svg;" x="0px" y="0px" width="288px" height="144px"
	 viewBox="0 0 288 144" style="enable-background:new 0 0 288 144;" xml:space="preserve">
<style type="text/css">
	.st0{fill:none;stroke:#ED1C24;stroke-miterlimit:10;}
	.st1{display:none;}
</style>
<switch>
	<foreignObject requiredExtensions="&ns_extend;" x="0" y="0" width="1" height="1"/>
	<g>
		<polyline class="st0" points="72,72 144,72 144,0 "/>
		<line class="st0" x1="0" y1="144" x2="72" y2="144"/>
		<g class="st1"><circle cx="1" cy="1" r="1"/></g>
	</g>
</switch>
</svg>"#;
    let faults = read_svg(text.as_bytes(), &Options::new(0.01)).expect_err("px of Illustrator");
    assert!(faults.len() == 1 && faults[0].remedy.contains("pt"), "{faults:?}");
    let options = Options { unit: Some(Unit::Point), ..Options::new(0.01) };
    let drawing = read_svg(text.as_bytes(), &options).expect("a drawing");
    assert_eq!(drawing.elements.len(), 2);
    assert_eq!(drawing.elements[0].layers, ["#ed1c24", "Layer_1"]);
    let bend = path(&drawing, "polyline at line 16");
    assert!(!bend.closed && (bend.length() - 50.8).abs() < 1e-12);
    assert!(near(bend.start().unwrap(), 25.4, 25.4) && near(bend.end().unwrap(), 50.8, 50.8));
    // A responsive export has no size, and the same unit.
    let responsive = text.replacen(r#"width="288px" height="144px""#, "", 1);
    let drawing = read_svg(responsive.as_bytes(), &Options::new(0.01)).expect("a drawing");
    let bend = path(&drawing, "polyline at line 16");
    assert!(
        near(bend.start().unwrap(), 25.4, 25.4)
            && drawing.notes.iter().any(|note| note.text.contains("1/72 in"))
    );
    // The newer export writes no size and no name at all.
    let bare = r#"<svg id="a" data-name="Layer 1" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 72 72"><path d="M0 0h72"/></svg>"#;
    assert!(read_svg(bare.as_bytes(), &Options::new(0.01)).is_err());
    let drawing = read_svg(bare.as_bytes(), &options).expect("a drawing");
    assert_eq!(drawing.elements[0].layers, ["fill #000000", "a", "Layer 1"]);
    assert!(near(path(&drawing, "path at line 1, column 88").start().unwrap(), 0.0, 25.4));
}

#[test]
fn aspect_ratios_nested_frames_and_symbols() {
    let drawing = svg(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="4in" height="100mm" viewBox="0 0 100 100">
<symbol id="s" viewBox="0 0 10 10"><circle id="c" cx="5" cy="5" r="5"/></symbol>
<use id="u" href="#s" x="10" y="20" width="20" height="40"/>
<svg id="n" x="50" y="0" width="50" height="50" viewBox="0 0 1 1"><line id="l" x2="100%" y2="1"/></svg>
<svg id="stretch" y="50" width="20" height="50" viewBox="0 0 10 10" preserveAspectRatio="none"><line id="m" x2="10" y2="10"/></svg>
</svg>"##,
    );
    // 101.6 mm x 100 mm for 100 x 100: the box is centred, 0.8 mm at each side.
    let circle = path(&drawing, "u > c");
    let [Segment::Arc(arc)] = circle.segments[..] else { panic!("{circle:?}") };
    assert!(near(arc.center, 20.8, 60.0) && (arc.radius - 10.0).abs() < 1e-12 && arc.sweep.abs() == TAU);
    assert!(near(path(&drawing, "l").end().unwrap(), 100.8, 50.0));
    assert!(near(path(&drawing, "m").end().unwrap(), 20.8, 0.0));
}

/// Figma, Affinity and Illustrator clip by the page or the artboard, which hides nothing.
#[test]
fn clips_around_all_that_they_clip_are_idle() {
    let page = |clip: &str, more: &str| {
        svg(&format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="100mm" height="50mm" viewBox="0 0 100 50">
<defs><rect id="page" width="100" height="50"/><clipPath id="c">{clip}</clipPath></defs>
<g id="g" transform="scale(2)" clip-path="url(#c)"><path id="p" d="M1 1H40"/>{more}</g></svg>"#
        ))
    };
    for clip in [
        r#"<rect width="50" height="25"/>"#,
        r#"<path d="M0 0V25H50V0z"/>"#,
        r##"<use xlink:href="#page" transform="scale(.5)"/>"##,
    ] {
        assert_eq!(lost(&page(clip, "")), [], "{clip}");
        let text = lost(&page(clip, r#"<path id="q" d="M1 1H51"/>"#));
        assert!(text.len() == 1 && text[0].0 == "g" && text[0].1.contains("clip-path url(#c)"), "{text:?}");
    }
    for clip in [
        r#"<rect width="50" height="0.5"/>"#,
        r#"<circle r="90"/>"#,
        r#"<path d="M0 0H50V25H30V2H20V25H0z"/>"#,
        r#"<rect width="50" height="25"/><rect width="50" height="25"/>"#,
    ] {
        assert_eq!(lost(&page(clip, "")).len(), 1, "{clip}");
    }
}

/// A DXF file with the given header variables, tables, blocks and entities, from "code value" pairs separated by bars.
fn file(sections: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (name, body) in sections {
        text.push_str(&format!("0|SECTION|2|{name}|{body}|0|ENDSEC|"));
    }
    text.push_str("0|EOF|");
    text.replace('|', "\r\n")
}

const MM: (&str, &str) = ("HEADER", "9|$ACADVER|1|AC1015|9|$INSUNITS|70|     4");

#[test]
fn fusion_360_sketches_with_arcs_circles_and_splines() {
    let drawing = dxf(&file(&[
        ("HEADER", "9|$ACADVER|1|AC1015|9|$INSUNITS|70|5|9|$MEASUREMENT|70|1"),
        (
            "ENTITIES",
            "0|LINE|5|2F|100|AcDbEntity|8|0|100|AcDbLine|10|-1.0|20|0.0|30|0.0|11|1.0|21|0.0|31|0.0\
             |0|ARC|5|30|8|0|100|AcDbCircle|10|1.0|20|1.0|30|0.0|40|1.0|100|AcDbArc|50|270.0|51|90.0\
             |0|CIRCLE|5|31|8|0|10|0.0|20|0.0|30|0.0|40|2.5\
             |0|SPLINE|5|32|8|0|210|0|220|0|230|1|70|8|71|3|72|8|73|4|74|0|42|1e-7|43|1e-7|44|1e-10|40|0|40|0|40|0|40|0|40|1|40|1|40|1|40|1\
             |10|0|20|0|30|0|10|1|20|2|30|0|10|3|20|2|30|0|10|4|20|0|30|0",
        ),
    ]));
    assert_eq!(drawing.unit_mm, 10.0);
    let line = path(&drawing, "LINE 2F");
    assert!(near(line.start().unwrap(), -10.0, 0.0) && near(line.end().unwrap(), 10.0, 0.0));
    let arc = path(&drawing, "ARC 30");
    assert!(near(arc.start().unwrap(), 10.0, 0.0) && near(arc.end().unwrap(), 10.0, 20.0));
    assert!((arc.length() - 10.0 * PI).abs() < 1e-12 && !arc.closed);
    assert!(path(&drawing, "CIRCLE 31").closed);
    let spline = path(&drawing, "SPLINE 32");
    assert!(near(spline.end().unwrap(), 40.0, 0.0) && (spline.bounds().max.y - 15.0).abs() < 0.011);
    assert!(drawing.notes.is_empty(), "{:?}", drawing.notes);
}

#[test]
fn rhino_rational_circles_bulges_and_layers() {
    // A circle as Rhino writes closed curves: a rational quadratic of nine points.
    let w = 0.5_f64.sqrt();
    let ring = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
    let mut spline = "0|SPLINE|5|4A|8|Weld|70|5|71|2|72|12|73|9|74|0".to_owned();
    [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4].iter().for_each(|k| spline.push_str(&format!("|40|{k}")));
    ring.iter()
        .enumerate()
        .for_each(|(i, _)| spline.push_str(&format!("|41|{}", if i % 2 == 1 { w } else { 1.0 })));
    ring.iter().for_each(|(x, y)| spline.push_str(&format!("|10|{}|20|{}|30|0", 10 * x, 10 * y)));
    let slot =
        "0|LWPOLYLINE|5|4B|8|Cut|90|4|70|1|43|0.0|10|0|20|0|10|30|20|0|42|1|10|30|20|10|10|0|20|10|42|1";
    let drawing = dxf(&file(&[MM, ("ENTITIES", &format!("{spline}|{slot}"))]));
    let circle = path(&drawing, "SPLINE 4A");
    assert!(circle.closed && circle.segments.len() == 4, "{}", circle.segments.len());
    assert!((circle.length() - 20.0 * PI).abs() < 1e-9);
    let slot = path(&drawing, "LWPOLYLINE 4B");
    assert_eq!((slot.segments.len(), slot.closed), (4, true));
    assert!((slot.length() - (60.0 + 10.0 * PI)).abs() < 1e-9 && slot.largest_gap() < 1e-12);
    assert!((slot.bounds().max.x - 35.0).abs() < 1e-12);
    assert_eq!(element(&drawing, "LWPOLYLINE 4B").layers, ["Cut"]);
    // Characters outside of the code page.
    let text = "0|LINE|5|4C|8|K\\U+00F6rper \\U+4E2D\\U+|10|0|20|0|11|9|21|0";
    let drawing = dxf(&file(&[MM, ("ENTITIES", text)]));
    assert_eq!(element(&drawing, "LINE 4C").layers, ["K\u{f6}rper \u{4e2d}\\U+"]);
}

#[test]
fn librecad_layers_off_blocks_and_ellipses() {
    let tables = "0|TABLE|2|LAYER|70|3|0|LAYER|5|10|2|0|70|0|62|7|0|LAYER|5|11|2|Hidden|70|0|62|-3|0|LAYER|5|12|2|Ice|70|1|62|3|0|ENDTAB";
    let blocks = "0|BLOCK|5|20|8|0|2|part|70|0|10|5|20|0|30|0|3|part|1||0|CIRCLE|5|21|8|0|10|5|20|0|40|1\
                  |0|LINE|5|22|8|edge|10|5|20|0|11|6|21|0|0|ENDBLK|5|23|8|0";
    let entities = "0|INSERT|5|30|8|weld|2|PART|10|100|20|50|30|0|41|2|42|3|50|90\
                    |0|INSERT|5|31|8|row|2|part|10|0|20|0|70|3|71|2|44|10|45|20\
                    |0|LINE|5|32|8|Hidden|10|0|20|0|11|1|21|1\
                    |0|INSERT|5|33|8|ice|2|part|10|0|20|0\
                    |0|ELLIPSE|5|34|8|0|10|0|20|0|30|0|11|0|21|20|31|0|40|0.5|41|0|42|3.141592653589793\
                    |0|TEXT|5|35|8|notes|10|7|20|8|40|2.5|1|inlet\
                    |0|POINT|5|36|8|port|10|3|20|4|30|0";
    let drawing = dxf(&file(&[MM, ("TABLES", tables), ("BLOCKS", blocks), ("ENTITIES", entities)]));
    // Scaled by 2 and 3, turned by 90 deg, with its base point (5, 0) at (100, 50): an ellipse.
    let ellipse = path(&drawing, "INSERT 30 > CIRCLE 21");
    assert!(ellipse.closed && ellipse.segments.len() > 8);
    let bounds = ellipse.bounds();
    assert!((bounds.min.x - 97.0).abs() < 0.011 && (bounds.max.y - 52.0).abs() < 0.011, "{bounds:?}");
    assert_eq!(element(&drawing, "INSERT 30 > CIRCLE 21").layers, ["weld"]);
    assert_eq!(element(&drawing, "INSERT 30 > LINE 22").layers, ["edge", "weld"]);
    assert!(near(path(&drawing, "INSERT 30 > LINE 22").end().unwrap(), 100.0, 52.0));
    let copy = path(&drawing, "INSERT 31[3,2] > CIRCLE 21");
    assert!(near(copy.start().unwrap(), 21.0, 20.0) && copy.segments.len() == 1);
    assert_eq!(drawing.elements.len(), 2 + 12 + 2);
    // A half ellipse with its major axis along y: it goes to the left.
    let half = path(&drawing, "ELLIPSE 34");
    assert!(near(half.start().unwrap(), 0.0, 20.0) && near(half.end().unwrap(), 0.0, -20.0));
    assert!((half.bounds().min.x + 10.0).abs() < 0.011 && half.bounds().max.x < 0.011);
    assert!(matches!(element(&drawing, "POINT 36").figure, Figure::Point(p) if p == Point::new(3.0, 4.0)));
    let [(id, text)] = &lost(&drawing)[..] else { panic!("{:?}", drawing.notes) };
    assert!(id == "TEXT 35" && text.contains("Texts"));
    let text = drawing.notes.iter().find(|note| note.weight == Weight::Annotation).expect("a note");
    assert_eq!(
        (text.place.at, &text.place.layers[..]),
        (Some(Point::new(7.0, 8.0)), &["notes".to_owned()][..])
    );
    let hidden: Vec<_> = drawing.notes.iter().filter_map(|note| note.place.element.as_deref()).collect();
    assert_eq!(hidden, ["LINE 32", "INSERT 33", "TEXT 35"]);
}

#[test]
fn freecad_r12_polylines_without_a_unit() {
    let text = file(&[
        ("HEADER", "9|$ACADVER|1|AC1009"),
        (
            "ENTITIES",
            "0|POLYLINE|8|none|66|1|70|1|0|VERTEX|8|none|10|0.0|20|0.0|0|VERTEX|8|none|10|10.0|20|0.0|42|1.0\
             |0|VERTEX|8|none|10|10.0|20|10.0|0|VERTEX|8|none|10|0.0|20|10.0|0|SEQEND",
        ),
    ]);
    let faults = read_dxf(text.as_bytes(), &Options::new(0.01)).expect_err("no unit");
    assert!(faults[0].text.contains("$INSUNITS") && faults[0].remedy.contains("mm"), "{faults:?}");
    for (code, what) in [
        ("0", "The file has no unit"),
        ("7", "The file's unit is not read"),
        ("12", "The file's unit is not read"),
    ] {
        let head = format!("9|$ACADVER|1|AC1015|9|$INSUNITS|70|{code}");
        let text = file(&[("HEADER", &head), ("ENTITIES", "0|LINE|8|0|10|0|20|0|11|9|21|0")]);
        let faults = read_dxf(text.as_bytes(), &Options::new(0.01)).expect_err("no unit");
        assert!(faults[0].text.starts_with(&format!("{what}: $INSUNITS is {code}")), "{faults:?}");
    }
    let options = Options { unit: Some(Unit::Inch), ..Options::new(0.01) };
    let drawing = read_dxf(text.as_bytes(), &options).expect("a drawing");
    let outline = path(&drawing, "POLYLINE at line 15");
    assert!(outline.closed && (outline.length() / 25.4 - (30.0 + 5.0 * PI)).abs() < 1e-9);
}

#[test]
fn qcad_mirrored_planes_and_heights() {
    let entities = "0|ARC|5|1|8|a|10|-10|20|0|30|0|40|5|50|0|51|90|210|0|220|0|230|-1\
                    |0|LWPOLYLINE|5|2|8|a|90|2|70|0|38|3.5|10|-1|20|0|42|0.5|10|-2|20|0|210|0|220|0|230|-1\
                    |0|ELLIPSE|5|3|8|a|10|10|20|0|30|0|11|5|21|0|31|0|40|1|41|0|42|1.5707963267948966|210|0|220|0|230|-1\
                    |0|LINE|5|4|8|a|10|0|20|0|30|0|11|1|21|0|31|2|210|0|220|0|230|-1\
                    |0|CIRCLE|5|5|8|a|10|0|20|0|40|1|210|1|220|0|230|0";
    let drawing = dxf(&file(&[MM, ("ENTITIES", entities)]));
    let arc = path(&drawing, "ARC 1");
    assert!(near(arc.start().unwrap(), 5.0, 0.0) && near(arc.end().unwrap(), 10.0, 5.0));
    let [Segment::Arc(arc)] = arc.segments[..] else { panic!("an arc") };
    assert!(near(arc.center, 10.0, 0.0) && (arc.sweep + FRAC_PI_2).abs() < 1e-12);
    // In its own plane it goes left and bulges to its right side, up; mirrored in x it goes right, and up still.
    let bulge = path(&drawing, "LWPOLYLINE 2");
    assert!(near(bulge.start().unwrap(), 1.0, 0.0) && near(bulge.end().unwrap(), 2.0, 0.0));
    let bounds = bulge.bounds();
    assert!((bounds.max.y - 0.25).abs() < 1e-12 && bounds.min.y.abs() < 1e-12, "{bounds:?}");
    // The centre of an ellipse is in world coordinates; it turns clockwise from its major axis.
    let ellipse = path(&drawing, "ELLIPSE 3");
    assert!(near(ellipse.start().unwrap(), 15.0, 0.0) && near(ellipse.end().unwrap(), 10.0, -5.0));
    assert_eq!(ellipse.segments.len(), 1);
    let found = lost(&drawing);
    assert_eq!(found.iter().map(|row| row.0.as_str()).collect::<Vec<_>>(), ["LINE 4", "CIRCLE 5"]);
    assert!(drawing.notes.iter().any(|note| note.text.contains("z = 3.5")), "{:?}", drawing.notes);
}

#[test]
fn ezdxf_metres_fit_points_and_paper_space() {
    let entities = "0|SPLINE|5|2F|330|1F|100|AcDbEntity|8|0|100|AcDbSpline|70|1024|71|3|72|0|73|0|74|4|42|1e-9|43|1e-10|44|1e-10\
                    |11|0|21|0|31|0|11|0.01|21|0.01|31|0|11|0.02|21|0|31|0|11|0.03|21|0.01|31|0\
                    |0|MTEXT|5|30|8|0|67|1|10|0|20|0|30|0|1|hello\
                    |0|HATCH|5|31|8|fill|10|0|20|0|30|0|1001|ACAD|1010|0|1020|0|1030|0";
    let drawing = dxf(&file(&[("HEADER", "9|$ACADVER|1|AC1024|9|$INSUNITS|70|6"), ("ENTITIES", entities)]));
    assert_eq!(drawing.unit_mm, 1000.0);
    let spline = path(&drawing, "SPLINE 2F");
    let gap =
        |x, y| spline.segments.iter().map(|s| s.distance(Point::new(x, y))).fold(f64::INFINITY, f64::min);
    for (x, y) in [(0.0, 0.0), (10.0, 10.0), (20.0, 0.0), (30.0, 10.0)] {
        assert!(gap(x, y) < 0.01, "{x}, {y}");
    }
    assert_eq!(lost(&drawing).iter().map(|row| row.0.as_str()).collect::<Vec<_>>(), ["HATCH 31"]);
}

/// What cannot be seen is left out with a note; names know which of them are its own.
#[test]
fn hidden_elements_and_own_names() {
    let drawing = svg(
        "<svg id='root' width='9mm' height='9mm' viewBox='0 0 9 9'><style>.x{opacity:0}</style><g id='l'><rect id='a' width='1' height='1' opacity='0.0'/>\
         <rect id='b' class='x' width='1' height='1'/><g style='opacity:0%'><rect id='c' width='1' height='1'/></g>\
         <rect id='d' width='1' height='1' fill='none' stroke='red' stroke-opacity='0'/><rect id='e' width='1' height='1' opacity='.2'/></g></svg>",
    );
    let hidden = drawing.notes.iter().filter(|note| note.weight == Weight::Hidden);
    assert_eq!(
        hidden.filter_map(|note| note.place.element.as_deref()).collect::<Vec<_>>(),
        ["a", "b", "g at line 1, column 191", "d"]
    );
    assert_eq!(drawing.root, ["root"]);
    let names: Vec<_> = drawing.elements.iter().map(|e| (e.layers.join(" "), e.own_names)).collect();
    assert_eq!(names, [("e fill #000000 l root".to_owned(), 2)]);
    // The names of groups give a role before the colour does.
    assert_eq!(drawing.elements[0].names().collect::<Vec<_>>(), ["e", "e", "l", "root", "fill #000000"]);
    assert_eq!(drawing.elements[0].colour_name(), Some("fill #000000"));
}

/// The places of a hatch and of a polyline are points of theirs, not their heights.
#[test]
fn hatches_and_polylines_have_places() {
    let text = "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|ENTITIES|\
        0|HATCH|5|A|8|L|10|0|20|0|30|0|2|SOLID|70|1|91|1|92|2|10|7|20|8|\
        0|POLYLINE|5|B|8|L|10|0|20|0|0|VERTEX|10|3|20|4|30|0|0|VERTEX|10|5|20|4|30|5|0|SEQEND|0|ENDSEC|0|EOF|";
    let drawing = dxf(&text.replace('|', "\n"));
    let places: Vec<_> = drawing.notes.iter().map(|note| (note.weight, note.place.at)).collect();
    let at = |x, y| Some(Point::new(x, y));
    assert_eq!(places, [(Weight::Annotation, at(7.0, 8.0)), (Weight::Changed, at(3.0, 4.0))]);
    assert_eq!(drawing.notes[1].text, "It is not flat (z 0 to 5); it is read as if z were 0.");
    assert_eq!(drawing.elements[0].own_names, 1);
}
