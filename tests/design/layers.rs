//! Layers of files as drawing programs write them: the proposed roles make a design.

use stargrip_cam::design::{Design, propose_layers};
use stargrip_cam::spec::{self, LayerRole, Source};

use crate::support;

/// The proposed layers of a file, after the spec with them was read and its design made.
fn proposed(name: &str, text: &str) -> Vec<(String, LayerRole)> {
    let found = propose_layers(name, text.as_bytes(), None).unwrap_or_else(|refusals| panic!("{refusals}"));
    let spec = spec::drawing_starter("x", name, &found.layers, found.unit).expect("a name");
    let reading = spec::read(&Source::new("x", spec.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(text.as_bytes()).spec;
    let design = Design::new(&spec, &support::machine());
    let design = design.unwrap_or_else(|refusals| panic!("{name}: {:?}: {refusals}", found.layers));
    let ports = design.drawn().map_or(0, |piece| piece.shape.ports.len());
    assert!(ports > 0, "{name}: no port");
    found.layers.into_iter().map(|(layer, role, _)| (layer, role)).collect()
}

fn same(found: &[(String, LayerRole)], wanted: &[(&str, LayerRole)]) {
    let found: Vec<(&str, LayerRole)> = found.iter().map(|(layer, role)| (layer.as_str(), *role)).collect();
    assert_eq!(found, wanted);
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
    same(&proposed("a.svg", text), &BOTH);
    // A group around both, as of a parent layer, tells nothing apart; a text on a layer of its own is left out.
    let nested = text
        .replace(
            "<g inkscape:label=\"air\"",
            "<g id=\"g9\" inkscape:label=\"Design\"><g inkscape:label=\"air\"",
        )
        .replace("</svg>", "</g><g id=\"n\" inkscape:label=\"notes\"><text id=\"t\">x</text></g></svg>");
    same(&proposed("a.svg", &nested), &[BOTH[0], BOTH[1], ("notes", LayerRole::Ignore)]);
    // With one layer the colours tell the figures apart.
    let one = text
        .replace("</g>\n  <g inkscape:groupmode=\"layer\" id=\"layer2\" inkscape:label=\"port\">", "")
        .replace("#0000ff;stroke-width:0.264583\" d=", "#ff0000;stroke-width:0.264583\" d=");
    same(&proposed("a.svg", &one), &[("#0000ff", LayerRole::Air), ("#ff0000", LayerRole::Port)]);
    // A figure beside the layers: its colour is theirs, so its own name gives it the role.
    let beside = text.replace("</svg>", "<rect id=\"r2\" x=\"60\" y=\"50\" width=\"40\" height=\"40\" style=\"fill:none;stroke:#0000ff\"/></svg>");
    same(&proposed("a.svg", &beside), &[BOTH[0], BOTH[1], ("r2", LayerRole::Air)]);
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
        same(&proposed("a.svg", &text), &BOTH);
    }
}

/// An entity of a block has the role of its own layer, not of the layer on which the block was inserted.
#[test]
fn layers_inside_of_blocks_count() {
    let dxf = "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|BLOCKS|0|BLOCK|2|B|10|0|20|0|\
        0|CIRCLE|5|A|8|AIR|10|50|20|50|40|40|0|LINE|5|B|8|PORT|10|86|20|50|11|94|21|50|0|ENDBLK|0|ENDSEC|\
        0|SECTION|2|ENTITIES|0|INSERT|5|C|8|0|2|B|10|0|20|0|0|ENDSEC|0|EOF|"
        .replace('|', "\n");
    same(&proposed("a.dxf", &dxf), &[("AIR", LayerRole::Air), ("PORT", LayerRole::Port)]);
}

/// A unit that is given replaces the guess, and a fault behind a missing unit is listed.
#[test]
fn a_unit_may_be_given_and_hides_no_fault() {
    let dxf = |y: &str| {
        format!("0|SECTION|2|ENTITIES|0|LINE|8|AIR|10|0|20|{y}|11|10|21|0|0|ENDSEC|0|EOF|").replace('|', "\n")
    };
    let of = |unit| propose_layers("a.dxf", dxf("0").as_bytes(), unit).expect("a drawing");
    let inches = of(artwork::Unit::from_name("in"));
    assert!((inches.size[0] - 254.0).abs() < 1e-9 && inches.no_unit.is_none(), "{inches:?}");
    let guessed = of(None);
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
        let found = propose_layers("a.dxf", text.as_bytes(), None).expect("a drawing");
        assert_eq!(found.hidden.len(), usize::from(said.ends_with("hidden")), "{found:?}");
        let spec = spec::drawing_starter("x", "a.dxf", &found.layers, found.unit).expect("a name");
        let reading =
            spec::read(&Source::new("x", spec.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
        let spec = reading.with_drawing(text.as_bytes()).spec;
        let refusals = Design::new(&spec, &support::machine()).expect_err("no air");
        assert_eq!(refusals[0].code.to_string(), "nothing-drawn");
        assert!(refusals[0].found.contains(said), "{refusals}");
        assert!(!stargrip_cam::design::drawing_notes(&spec).is_empty());
    }
}
