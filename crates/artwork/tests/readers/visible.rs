//! Figures that can be seen, and annotations beside them.

use artwork::{Artwork, Figure, Options, Weight, read_dxf, read_svg};

fn svg(body: &str) -> Artwork {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='99mm' height='99mm' viewBox='0 0 99 99'>{body}</svg>"
    );
    read_svg(text.as_bytes(), &Options::new(0.01)).unwrap_or_else(|faults| panic!("{body}: {faults:?}"))
}

fn ids(drawing: &Artwork) -> Vec<&str> {
    drawing.elements.iter().map(|element| element.id.as_str()).collect()
}

/// A frame with each way to have no paint, beside a shape that is seen.
#[test]
fn figures_without_visible_paint_are_left_out_with_one_note() {
    for paint in [
        "fill='none'",
        "fill='none' stroke='none'",
        "fill='transparent'",
        "fill='NONE' style='stroke:transparent'",
        "fill='rgba(0, 0, 0, 0)'",
        "fill='#ffffff00'",
        "fill='#fff0'",
        "fill='rgb(0 0 0 / 0%)'",
        "fill='none' stroke='red' stroke-width='0'",
        "fill='none' stroke='red' style='stroke-width:0px'",
        "fill='none' stroke='red' stroke-opacity='0'",
        "fill-opacity='0'",
        "class='ghost'",
        "style='fill:none ! important;fill:red'",
    ] {
        let frame = format!("<rect id='frame' width='9' height='9' {paint}/>");
        let drawing = svg(&format!(
            "<style>g > rect.ghost{{fill:none}}</style><g>{frame}{}</g><path id='shape' d='M0 0h9v9z'/>",
            frame.replace("'frame'", "'frame2'")
        ));
        assert_eq!(ids(&drawing), ["shape"], "{paint}");
        let hidden: Vec<_> = drawing.notes.iter().filter(|note| note.weight == Weight::Hidden).collect();
        assert!(hidden.len() == 1 && hidden[0].places().count() == 2, "{paint}: {:?}", drawing.notes);
        assert!(hidden[0].to_string().starts_with("frame") && hidden[0].to_string().contains("and 1 more"));
        // In a file without anything visible the figures are all that there is.
        let alone = svg(&format!("<style>g > rect.ghost{{fill:none}}</style><g>{frame}</g>"));
        assert_eq!(ids(&alone), ["frame"], "{paint}");
        assert!(alone.notes.iter().any(|note| note.text.starts_with("No figure has a visible")));
    }
}

/// A colour that is not read is a colour nevertheless.
#[test]
fn paints_that_are_not_understood_are_visible() {
    for paint in [
        "stroke='context-stroke'",
        "style='stroke:light-dark(red, blue)'",
        "style='stroke:var(--edge)'",
        "style='stroke:oklch(50% .1 20)'",
        "stroke='url(#g)'",
        "stroke='red' stroke-width='0.1px'",
        "stroke='rgb(0 0 0 / 1%)'",
    ] {
        let drawing = svg(&format!("<path id='p' fill='none' {paint} d='M0 0h9'/><path id='q' d='M0 0h9'/>"));
        assert_eq!(ids(&drawing), ["p", "q"], "{paint}");
    }
    for (paint, layer) in [
        ("stroke='#ff0000' style='stroke:light-dark(blue, red)'", "#ff0000"),
        ("stroke='blue' style='stroke:#00f icc-color(a, 1)'", "#0000ff"),
        ("style='stroke:url(#g) lime'", "#00ff00"),
        ("style='stroke:lime ! important;stroke:red'", "#00ff00"),
        ("style='stroke:lime;stroke:var(--x)'", "#00ff00"),
    ] {
        let drawing = svg(&format!("<path id='p' fill='none' {paint} d='M0 0h9'/>"));
        assert_eq!(drawing.elements[0].layers, ["p", layer], "{paint}");
    }
}

#[test]
fn hidden_by_selectors_of_every_kind() {
    for selector in [
        ".a.b",
        "g .a",
        "g > path",
        "svg g path.a",
        "path:nth-child(2)",
        "rect + path",
        "#p:not(.c)",
        "[id=p]",
    ] {
        let drawing = svg(&format!(
            "<style>{selector}{{display:none}}</style><g><rect id='r' width='9' height='9'/><path id='p' class='a b' d='M0 0h9'/></g>"
        ));
        assert_eq!(ids(&drawing), ["r"], "{selector}");
        assert!(drawing.notes.iter().all(|note| note.weight == Weight::Hidden), "{:?}", drawing.notes);
    }
    // A selector that is not read may colour, but not hide.
    let weight = |body: &str| {
        svg(&format!("<style>p:has(a){{{body}}}</style><path d='M0 0h9'/>"))
            .notes
            .first()
            .map(|note| note.weight)
    };
    assert_eq!(weight("stroke:red;fill:none"), Some(Weight::Information));
    assert_eq!(weight("visibility:hidden"), Some(Weight::Lost));
    assert_eq!(weight("font-weight:bold"), None);
}

/// Rules for every element of a large file would take hours; a usual number of them does not.
#[test]
fn style_sheets_cannot_multiply_work() {
    let rules = |number: usize| {
        let rules: Vec<String> =
            (0..number).map(|i| format!("g path ~ path.a{}{{stroke:red}}", i % 7)).collect();
        rules.concat()
    };
    let paths = "<path class='a0 a1 a2 a3 a4 a5 a6' d='M0 0h9'/>".repeat(5000);
    assert_eq!(svg(&format!("<style>{}</style><g>{paths}</g>", rules(7))).elements.len(), 5000);
    let text = format!(
        "<svg width='9mm' height='9mm' viewBox='0 0 9 9'><style>{}</style>{paths}</svg>",
        rules(5000)
    );
    let faults = read_svg(text.as_bytes(), &Options::new(0.01)).expect_err("too many");
    assert!(faults[0].text.contains("too many rules"), "{faults:?}");
}

/// A circle of radius 5 about (10, 20) by a square, turned about a point in each spelling of it.
#[test]
fn transforms_have_origins() {
    for origin in ["10 20", "10px, 20px", "10 20 5", "10.10101% 20.2020202%"] {
        for how in [format!("transform-origin='{origin}'"), format!("style='transform-origin:{origin}'")] {
            let drawing =
                svg(&format!("<rect x='10' y='20' width='4' height='2' transform='rotate(90)' {how}/>"));
            let Figure::Path(path) = &drawing.elements[0].figure else { panic!("a path") };
            let bounds = path.bounds();
            // From (10, 20) on, 2 to the left and 4 down; y is up, so the page's 99 mm count.
            for (side, wanted) in [bounds.min.x, bounds.max.x, bounds.min.y, bounds.max.y]
                .into_iter()
                .zip([8.0, 10.0, 75.0, 79.0])
            {
                assert!((side - wanted).abs() < 1e-4, "{how}: {bounds:?}");
            }
        }
    }
    for origin in ["center", "center center", "50%"] {
        let drawing = svg(&format!(
            "<rect x='40' y='45' width='19' height='9' transform='rotate(180)' transform-origin='{origin}'/>"
        ));
        let Figure::Path(path) = &drawing.elements[0].figure else { panic!("a path") };
        assert!(
            (path.bounds().min.x - 40.0).abs() < 1e-9 && (path.bounds().min.y - 45.0).abs() < 1e-9,
            "{origin}"
        );
    }
    let corner = svg("<rect width='9' height='9' transform='rotate(180)' transform-origin='bottom right'/>");
    let Figure::Path(path) = &corner.elements[0].figure else { panic!("a path") };
    assert!((path.bounds().max.x - 198.0).abs() < 1e-9 && (path.bounds().min.y + 99.0).abs() < 1e-9);
    let faulty =
        svg("<rect width='9' height='9' transform='rotate(1)' transform-origin='here'/><path d='M0 0h1'/>");
    assert!(faulty.faults.len() == 1 && faulty.elements.len() == 1, "{:?}", faulty.faults);
    let idle = svg("<rect width='9' height='9' style='transform-origin:here;transform-box:fill-box'/>");
    assert!(idle.faults.is_empty() && idle.elements.len() == 1, "{:?}", idle.faults);
}

/// All kinds of annotations on the layer of an edge are one note, in blocks as well.
#[test]
fn annotations_are_one_note() {
    let kinds = ["TEXT", "MTEXT", "DIMENSION", "LEADER", "HATCH", "ATTRIB", "XLINE", "RAY", "MULTILEADER"];
    let entities: Vec<String> = kinds.iter().map(|kind| format!("0|{kind}|8|0|10|1|20|2|")).collect();
    let entities = entities.concat();
    let text = format!(
        "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|BLOCKS|0|BLOCK|2|b|10|0|20|0|{entities}0|ENDBLK|0|ENDSEC|\
         0|SECTION|2|ENTITIES|{entities}0|INSERT|8|edge|2|b|10|0|20|0|0|CIRCLE|8|edge|10|0|20|0|40|9|0|ENDSEC|0|EOF|"
    );
    let drawing = read_dxf(text.replace('|', "\n").as_bytes(), &Options::new(0.01)).expect("a drawing");
    assert_eq!((drawing.elements.len(), drawing.notes.len()), (1, 1));
    let places: Vec<_> = drawing.notes[0].places().collect();
    assert!(drawing.notes[0].weight == Weight::Annotation && places.len() == 2 * kinds.len());
    assert!(places.iter().all(|place| place.layers == ["0"] || place.layers == ["edge"]), "{places:?}");
}
