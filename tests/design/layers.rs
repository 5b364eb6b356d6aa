//! Layers of files as drawing programs write them: the proposed roles make a design.

use crate::one_layer::{CLOSED_EDGE, HOSE, one_layer};
use crate::support;
use stargrip_cam::design::{Design, drawing_notes, propose_layers};
use stargrip_cam::spec::{self, LayerRole, Source};

/// The proposed layers of a file, after the spec with them was read and its design made.
pub(super) fn proposed(name: &str, text: &str) -> Vec<(String, LayerRole)> {
    let proposal =
        propose_layers(name, text.as_bytes(), None).unwrap_or_else(|refusals| panic!("{refusals}"));
    let spec = spec::drawing_starter("x", name, &proposal.layers, proposal.unit).expect("a name");
    let reading = spec::read(&Source::new("x", spec.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(text.as_bytes()).spec;
    let design = Design::new(&spec, &support::machine());
    let design = design.unwrap_or_else(|refusals| panic!("{name}: {:?}: {refusals}", proposal.layers));
    let ports = design
        .drawn_pieces()
        .map_or(0, |drawn| drawn.pieces.iter().map(|piece| piece.shape.ports.len()).sum::<usize>());
    assert!(ports > 0, "{name}: no port");
    proposal.layers.into_iter().map(|(layer, role, _)| (layer, role)).collect()
}

pub(super) fn assert_roles(proposal: &[(String, LayerRole)], expected: &[(&str, LayerRole)]) {
    let roles: Vec<(&str, LayerRole)> =
        proposal.iter().map(|(layer, role)| (layer.as_str(), *role)).collect();
    assert_eq!(roles, expected);
}

const BOTH: [(&str, LayerRole); 2] = [("air", LayerRole::Air), ("port", LayerRole::Port)];

/// Inkscape gives the root an id, and its layers labels and ids.
#[test]
fn inkscape_layers_have_their_labels() {
    let text = r##"<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<svg width="210mm" height="150mm" viewBox="0 0 210 150" version="1.1" id="svg1"
   inkscape:version="1.3.2 (091e20e, 2023-11-25)" sodipodi:docname="cushion.svg"
   xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
   xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
   xmlns="http://www.w3.org/2000/svg" xmlns:svg="http://www.w3.org/2000/svg">
  <sodipodi:namedview id="namedview1" pagecolor="#ffffff" inkscape:document-units="mm" inkscape:current-layer="layer2" />
  <defs id="defs1" />
  <g inkscape:label="air" inkscape:groupmode="layer" id="layer1">
    <rect style="fill:none;stroke:#0000ff;stroke-width:0.264583" id="rect1" width="120" height="80" x="20" y="30" ry="10" />
  </g>
  <g inkscape:groupmode="layer" id="layer2" inkscape:label="port">
    <path style="fill:none;stroke:#0000ff;stroke-width:0.264583" d="m 16,70 h 8" id="path1" />
  </g>
</svg>"##;
    assert_roles(&proposed("a.svg", text), &BOTH);
    // A group around both, as of a parent layer, tells nothing apart; a text on a layer of its own is left out.
    let nested = text
        .replace(
            "<g inkscape:label=\"air\"",
            "<g id=\"g9\" inkscape:label=\"Design\"><g inkscape:label=\"air\"",
        )
        .replace("</svg>", "</g><g id=\"n\" inkscape:label=\"notes\"><text id=\"t\">x</text></g></svg>");
    assert_roles(&proposed("a.svg", &nested), &[BOTH[0], BOTH[1], ("notes", LayerRole::Ignore)]);
    // With one layer the colours tell the figures apart.
    let one_layer_only = text
        .replace("</g>\n  <g inkscape:groupmode=\"layer\" id=\"layer2\" inkscape:label=\"port\">", "")
        .replace("#0000ff;stroke-width:0.264583\" d=", "#ff0000;stroke-width:0.264583\" d=");
    assert_roles(
        &proposed("a.svg", &one_layer_only),
        &[("#0000ff", LayerRole::Air), ("#ff0000", LayerRole::Port)],
    );
    // A figure beside the layers: its colour is theirs, so its own name gives it the role.
    let with_square = text.replace("</svg>", "<rect id=\"r2\" x=\"60\" y=\"50\" width=\"40\" height=\"40\" style=\"fill:none;stroke:#0000ff\"/></svg>");
    assert_roles(&proposed("a.svg", &with_square), &[BOTH[0], BOTH[1], ("r2", LayerRole::Air)]);
}

/// Illustrator, Figma and Affinity write a root id, a frame or an artboard around everything.
#[test]
fn frames_and_artboards_are_passed_over() {
    let shapes = "<g id=\"air\"><rect x=\"20\" y=\"30\" width=\"120\" height=\"80\"/></g><g id=\"port\"><path d=\"M 16 70 H 24\"/></g>";
    let root =
        "xmlns=\"http://www.w3.org/2000/svg\" width=\"210mm\" height=\"150mm\" viewBox=\"0 0 210 150\"";
    for text in [
        format!("<svg id=\"Layer_1\" {root}>{shapes}</svg>"),
        format!("<svg {root}><g id=\"Frame 1\">{shapes}</g></svg>"),
        format!("<svg {root}><g id=\"Artboard1\">{shapes}</g></svg>"),
        format!("<svg id=\"svg1\" {root}><g id=\"Artboard1\"><g id=\"design notes\">{shapes}</g></g></svg>"),
        // Figma names the figures themselves.
        format!(
            "<svg {root}><g id=\"Frame 1\">{}</g></svg>",
            "<rect id=\"air\" x=\"20\" y=\"30\" width=\"120\" height=\"80\" stroke=\"black\"/><path id=\"port\" d=\"M 16 70 H 24\" stroke=\"black\"/>"
        ),
    ] {
        assert_roles(&proposed("a.svg", &text), &BOTH);
    }
}

/// An entity of a block has the role of its own layer, not of the layer on which the block was inserted.
#[test]
fn layers_inside_of_blocks_count() {
    let dxf = "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|BLOCKS|0|BLOCK|2|B|10|0|20|0|\
        0|CIRCLE|5|A|8|AIR|10|50|20|50|40|40|0|LINE|5|B|8|PORT|10|86|20|50|11|94|21|50|0|ENDBLK|0|ENDSEC|\
        0|SECTION|2|ENTITIES|0|INSERT|5|C|8|0|2|B|10|0|20|0|0|ENDSEC|0|EOF|"
        .replace('|', "\n");
    assert_roles(&proposed("a.dxf", &dxf), &[("AIR", LayerRole::Air), ("PORT", LayerRole::Port)]);
}

/// A unit that is given replaces the guess, and a fault behind a missing unit is listed.
#[test]
fn a_unit_may_be_given_and_hides_no_fault() {
    let dxf = |y: &str| {
        format!("0|SECTION|2|ENTITIES|0|LINE|8|AIR|10|0|20|{y}|11|10|21|0|0|ENDSEC|0|EOF|").replace('|', "\n")
    };
    let proposal_in = |unit| propose_layers("a.dxf", dxf("0").as_bytes(), unit).expect("a drawing");
    let inches = proposal_in(artwork::Unit::from_name("in"));
    assert!((inches.size[0] - 254.0).abs() < 1e-9 && inches.no_unit.is_none(), "{inches:?}");
    let guessed = proposal_in(None);
    assert!((guessed.size[0] - 10.0).abs() < 1e-9 && guessed.no_unit.is_some(), "{guessed:?}");
    let refusals = propose_layers("a.dxf", dxf("30,5").as_bytes(), None).expect_err("a comma").to_string();
    assert!(refusals.contains("$INSUNITS") && refusals.contains("\"30,5\""), "{refusals}");
}

/// A layer that is switched off, or of which nothing can be read, is named.
#[test]
fn hidden_and_unread_layers_are_named() {
    let dxf = |kind: &str, flag: &str| {
        format!(
            "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|TABLES|0|TABLE|2|LAYER|0|LAYER|2|AIR|62|{flag}|0|ENDTAB|\
             0|ENDSEC|0|SECTION|2|ENTITIES|0|{kind}|5|A|8|AIR|10|50|20|50|40|40|0|LINE|5|B|8|PORT|10|86|20|50|11|94|21|50|\
             0|ENDSEC|0|EOF|"
        )
        .replace('|', "\n")
    };
    for (text, said) in
        [(dxf("CIRCLE", "-7"), "\"AIR\" is hidden"), (dxf("SOLID", "7"), "\"AIR\" can be read")]
    {
        let proposal = propose_layers("a.dxf", text.as_bytes(), None).expect("a drawing");
        assert_eq!(proposal.hidden.len(), usize::from(said.ends_with("hidden")), "{proposal:?}");
        let spec = spec::drawing_starter("x", "a.dxf", &proposal.layers, proposal.unit).expect("a name");
        let reading =
            spec::read(&Source::new("x", spec.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
        let spec = reading.with_drawing(text.as_bytes()).spec;
        let refusals = Design::new(&spec, &support::machine()).expect_err("no air");
        assert_eq!(refusals[0].code.to_string(), "nothing-drawn");
        assert!(refusals[0].found.contains(said), "{refusals}");
        assert!(!stargrip_cam::design::drawing_notes(&spec).is_empty());
    }
}

/// A role is proposed only if something can be sealed with it.
#[test]
fn proposals_can_be_sealed() {
    let roles = |file: &str, text: &str| -> Vec<(String, LayerRole)> {
        let proposal =
            propose_layers(file, text.as_bytes(), None).unwrap_or_else(|refusals| panic!("{refusals}"));
        proposal.layers.into_iter().map(|(layer, role, _)| (layer, role)).collect()
    };
    let layer = |text: &str, layer: &str| text.replace("|8|0|", &format!("|8|{layer}|"));
    // An outline alone is the edge of the air; its own holes are ignored.
    let own_layers = layer(CLOSED_EDGE, "cut-outside")
        + "0|CIRCLE|8|registration|10|30|20|30|40|2|0|CIRCLE|8|cut-hole|10|70|20|50|40|9|";
    assert_roles(
        &roles("a.dxf", &one_layer(&own_layers, "")),
        &[("cut-outside", LayerRole::Air), ("registration", LayerRole::Ignore), ("cut-hole", LayerRole::Air)],
    );
    // White is a background only where there is anything else.
    let white = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9in\" height=\"9in\" viewBox=\"0 0 9 9\"><path fill=\"#fff\" d=\"M1 1h6v6z\"/></svg>";
    assert_roles(&roles("a.svg", white), &[("fill #ffffff", LayerRole::Air)]);
    // The centre of a hole is no port, and a point on the edge is one.
    let holes =
        layer(CLOSED_EDGE, "outer") + "0|CIRCLE|8|inner|10|60|20|50|40|5|0|POINT|8|centres|10|60|20|50|";
    let text = one_layer(&holes, &layer(HOSE, "hose"));
    assert_roles(
        &proposed("a.dxf", &text),
        &[
            ("outer", LayerRole::Air),
            ("inner", LayerRole::Air),
            ("centres", LayerRole::Ignore),
            ("hose", LayerRole::Port),
        ],
    );
    // Points are no curves, whatever the name of their layer.
    for name in ["drill", "holes", "cut marks", "weld spots", "air"] {
        let points = layer(CLOSED_EDGE, "outer")
            + &format!("0|POINT|8|{name}|10|60|20|50|0|POINT|8|{name}|10|90|20|50|");
        assert_roles(
            &proposed("a.dxf", &one_layer(&points, &layer(HOSE, "hose"))),
            &[("outer", LayerRole::Air), (name, LayerRole::Ignore), ("hose", LayerRole::Port)],
        );
    }
    let point = layer(CLOSED_EDGE, "outer") + "0|POINT|8|place|10|20|20|50|";
    assert_roles(
        &proposed("a.dxf", &one_layer(&point, "")),
        &[("outer", LayerRole::Air), ("place", LayerRole::Port)],
    );
}

/// A fault on a layer that nobody needs is a note, and one on an edge is refused with its remedy.
#[test]
fn faults_of_single_elements_leave_the_rest() {
    let svg = |layer: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"140mm\" height=\"100mm\" viewBox=\"0 0 140 100\"><g id=\"air\"><rect x=\"20\" y=\"20\" width=\"100\" height=\"60\"/></g>\
             <g id=\"port\"><path d=\"M16 50H24\"/></g><g id=\"{layer}\"><path id=\"scrap\" d=\"M10 10 L NaN,NaN\"/><use id=\"u\" href=\"#u\"/></g></svg>"
        )
    };
    assert_roles(
        &proposed("a.svg", &svg("notes")),
        &[("air", LayerRole::Air), ("port", LayerRole::Port), ("notes", LayerRole::Ignore)],
    );
    let dxf = one_layer(
        CLOSED_EDGE,
        &(HOSE.replace("|8|0|", "|8|hose|")
            + "0|INSERT|8|scrap|5|77|2|none|10|0|20|0|0|SPLINE|8|scrap|5|78|71|3|"),
    );
    assert_roles(
        &proposed("a.dxf", &dxf),
        &[("0", LayerRole::Air), ("hose", LayerRole::Port), ("scrap", LayerRole::Ignore)],
    );
    let proposal = propose_layers("a.svg", svg("air").as_bytes(), None).expect("a drawing");
    assert_eq!(proposal.faults.len(), 2, "{proposal:?}");
    let spec = spec::drawing_starter("x", "a.svg", &proposal.layers, proposal.unit).expect("a name");
    let reading = spec::read(&Source::new("x", spec.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let refusals = Design::new(&reading.with_drawing(svg("air").as_bytes()).spec, &support::machine())
        .expect_err("faults");
    assert!(refusals.len() == 2 && refusals[0].remedy.contains("name \"scrap\""), "{refusals}");
}

/// What has neither id nor label nor colour has a name that both commands know, and labels may have line ends.
#[test]
fn every_figure_has_a_name() {
    let head = "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"140mm\" height=\"100mm\" viewBox=\"0 0 140 100\">";
    for paint in ["stroke=\"context-stroke\"", "stroke=\"url(#g)\"", "style=\"stroke:light-dark(red, blue)\""]
    {
        let text = format!(
            "{head}<path fill=\"none\" {paint} d=\"M20 20h100v60h-100z\"/><path fill=\"none\" stroke=\"#0000ff\" d=\"M16 50H24\"/></svg>"
        );
        let roles = proposed("a.svg", &text);
        assert!(roles[0].0.starts_with("path at line 1") && roles[1].0 == "#0000ff", "{roles:?}");
    }
    let text = format!(
        "{head}<g id=\"l1\" inkscape:label=\"air&#10;outer\"><rect x=\"20\" y=\"20\" width=\"100\" height=\"60\"/></g><g inkscape:label=\"port&#13;\"><path d=\"M16 50H24\"/></g></svg>"
    );
    assert_roles(&proposed("a.svg", &text), &[("air\nouter", LayerRole::Air), ("port\r", LayerRole::Port)]);
}

/// The names that a user gave decide before a colour, which every figure of an SVG has; a note tells where they differ. In a DXF a colour of its
/// own is an exception from the layer. Markers decorate a line.
#[test]
fn names_decide_before_colours() {
    let edge = "d=\"M0 0H100V60H0Z\"";
    let line = "d=\"M-4 30H4\"";
    let drawing = |air: &str, port: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"100mm\" viewBox=\"-10 -10 200 100\">\
             <g id=\"edges\"><path id=\"e\" stroke=\"#000000\" fill=\"none\" {edge}{air}/></g>\
             <g id=\"hoses\"><g><path id=\"h\" stroke=\"#000000\" {line}{port}/></g></g></svg>"
        )
    };
    let with_layers = |text: &str, layers: &str| {
        let spec = format!(
            "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = {{ {layers} }}\n[sheet]\ncopies = 1\n"
        );
        let reading = spec::read(&Source::new("x", &spec)).unwrap_or_else(|faults| panic!("{faults}"));
        reading.with_drawing(text.as_bytes()).spec
    };
    let plain = drawing("", "");
    let marked = drawing(" marker-end=\"url(#arrow)\"", " style=\"marker-start:url(#dot)\"");
    for text in [&plain, &marked] {
        for layers in [
            "air = [\"edges\"], port = [\"hoses\"]",
            "air = [\"#000000\"], port = [\"hoses\"]",
            "air = [\"#000000\"], port = [\"h\"]",
            "air = [\"edges\"], port = [\"#000000\"]",
        ] {
            let spec = with_layers(text, layers);
            let design = Design::new(&spec, &support::machine());
            let design = design.unwrap_or_else(|refusals| panic!("{layers}: {refusals}"));
            let pieces = &design.drawn_pieces().expect("a drawing").pieces;
            assert_eq!((pieces.len(), pieces[0].shape.ports.len()), (1, 1), "{layers}");
            let notes = drawing_notes(&spec);
            let differs = notes.iter().any(|note| note.contains("not that of the colour \"#000000\""));
            assert_eq!(differs, layers.contains('#'), "{layers}: {notes:?}");
        }
    }
}
