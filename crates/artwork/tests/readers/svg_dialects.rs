//! SVG files as drawing programs write them, shortened.

use std::f64::consts::{PI, TAU};

use super::lookup::{element, lost, near, path};
use artwork::{Artwork, Options, Unit, Weight, read_svg};
use geom::Segment;

fn svg(text: &str) -> Artwork {
    read_svg(text.as_bytes(), &Options::new(0.01)).unwrap_or_else(|faults| panic!("{faults:?}"))
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
