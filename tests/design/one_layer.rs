//! Files with one layer of edges: their ports, points and open outlines.

use crate::layers::{assert_roles, proposed};
use crate::support;
use stargrip_cam::design::{Design, propose_layers};
use stargrip_cam::spec::{self, LayerRole, Source};

/// A cushion of 100 x 60 mm on layer "0" of a DXF, drawn with `edge`, and more entities.
pub(super) fn one_layer(edge: &str, entities: &str) -> String {
    format!(
        "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|ENTITIES|{edge}{entities}0|ENDSEC|0|EOF|"
    )
    .replace('|', "\n")
}

pub(super) const CLOSED_EDGE: &str =
    "0|LWPOLYLINE|8|0|5|2F|90|4|70|1|10|20|20|20|10|120|20|20|10|120|20|80|10|20|20|80|";

pub(super) const HOSE: &str = "0|LINE|8|0|5|30|10|16|20|50|11|24|21|50|";

/// The four sides and a round corner, one of them drawn the other way.
fn open_edges() -> String {
    let line = |handle: &str, [a, b]: [[f64; 2]; 2]| {
        format!("0|LINE|8|0|5|{handle}|10|{}|20|{}|11|{}|21|{}|", a[0], a[1], b[0], b[1])
    };
    let lines = [
        line("A1", [[20.0, 20.0], [120.0, 20.0]]),
        line("A2", [[120.0, 60.0], [120.0, 20.0]]),
        line("A3", [[100.0, 80.0], [20.0, 80.005]]),
        line("A4", [[20.0, 80.0], [20.0, 20.0]]),
    ];
    lines.concat() + "0|ARC|8|0|5|A5|10|100|20|60|40|20|50|0|51|90|"
}

/// Handles name single entities where a file has one layer and no colours; edges may be lines whose ends meet.
#[test]
fn a_dxf_of_one_layer_has_its_port_by_name() {
    let expected = [("0", LayerRole::Air), ("LINE 30", LayerRole::Port)];
    assert_roles(&proposed("a.dxf", &one_layer(CLOSED_EDGE, HOSE)), &expected);
    assert_roles(&proposed("a.dxf", &one_layer(&open_edges(), HOSE)), &expected);
    // A weld that ends on the edge is none, and a point at a corner is left out.
    let hose_and_marks =
        format!("{HOSE}0|LINE|8|0|5|31|10|90|20|50|11|105|21|50|0|POINT|8|0|5|32|10|20|20|20|");
    let text = one_layer(CLOSED_EDGE, &hose_and_marks);
    let proposal = propose_layers("a.dxf", text.as_bytes(), None).expect("a drawing");
    assert_roles(
        &proposal.layers.into_iter().map(|(layer, role, _)| (layer, role)).collect::<Vec<_>>(),
        &expected,
    );
    // Without handles the line of the file counts.
    let text = one_layer(CLOSED_EDGE, HOSE).replace("\n5\n2F", "").replace("\n5\n30", "");
    assert!(proposed("a.dxf", &text)[1].0.starts_with("LINE at line "));
    // In an SVG ids and places do.
    for (id, name) in [("id=\"h\"", "h"), ("", "path at line 1, column ")] {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"140mm\" height=\"100mm\" viewBox=\"0 0 140 100\" fill=\"none\" stroke=\"black\">\
             <path d=\"M20 20h100v60\"/><path d=\"M120 80h-100v-60\"/><path {id} d=\"M16 50H24\"/></svg>"
        );
        let roles = proposed("a.svg", &text);
        assert!(
            roles[0] == ("#000000".to_owned(), LayerRole::Air) && roles[1].0.starts_with(name),
            "{roles:?}"
        );
        assert_eq!((roles.len(), roles[1].1), (2, LayerRole::Port));
    }
}

/// Points and texts on the layer of the edge are left out, on a layer of their own refused unless it is ignored.
#[test]
fn points_and_texts_beside_edges_are_left_out() {
    let text = one_layer(
        CLOSED_EDGE,
        &format!(
            "{}0|POINT|8|0|10|70|20|50|0|POINT|8|0|10|0|20|0|0|TEXT|8|0|5|9|10|60|20|50|1|FRONT|0|HATCH|8|0|10|0|20|0|\
             0|POINT|8|hose|10|16|20|50|0|POINT|8|hose|10|20|20|50|",
            HOSE.replace("|8|0|", "|8|hose|")
        ),
    );
    assert_roles(&proposed("a.dxf", &text), &[("0", LayerRole::Air), ("hose", LayerRole::Port)]);
    let check = |text: &str, layers: &str| {
        let spec =
            format!("schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.dxf\"\n[drawing.layers]\n{layers}\n");
        let reading =
            spec::read(&Source::new("x", spec.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
        let spec = reading.with_drawing(text.as_bytes()).spec;
        Design::new(&spec, &support::machine())
            .map(|design| design.drawn_pieces().map(|piece| piece.notes.clone()))
    };
    let notes = check(&text, "air = [\"0\"]\nport = [\"hose\"]").expect("a design").expect("a drawing");
    let counts = |word: &str| notes.iter().filter(|note| note.contains(word)).count();
    assert_eq!((notes.len(), counts("4 points"), counts("Texts")), (2, 1, 1), "{notes:?}");
    // A role whose layer has nothing but a text or a point is an error.
    for alone in ["0|TEXT|8|cut|5|9|10|60|20|50|1|A|", "0|POINT|8|cut|5|9|10|60|20|50|"] {
        let text = one_layer(CLOSED_EDGE, &(HOSE.replace("|8|0|", "|8|hose|") + alone));
        let refusals = check(&text, "air = [\"0\"]\nport = [\"hose\"]\ncut = [\"cut\"]").expect_err("no cut");
        assert!(refusals[0].code == "lost-geometry", "{refusals}");
        assert!(check(&text, "air = [\"0\"]\nport = [\"hose\"]\nignore = [\"cut\"]").is_ok());
    }
}

/// An SVG with black `curves` and a red hose on the left.
fn with_hose(curves: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"140mm\" height=\"100mm\" viewBox=\"0 0 140 100\" fill=\"none\">\
         <g stroke=\"#000000\">{curves}</g><path stroke=\"#ff0000\" d=\"M16 50h8\"/></svg>"
    )
}

/// An outline that is open where a short line crosses its gap is the edge of the air, in one curve or several, alone or around others. Such a
/// curve inside of an edge is a weld.
#[test]
fn an_outline_that_is_open_at_the_hose_is_an_edge() {
    let edge_and_port = [("#000000", LayerRole::Air), ("#ff0000", LayerRole::Port)];
    for curves in [
        "<path d=\"M20 55V80H120V20H20V45\"/>",
        "<path d=\"M20 20H120V80H20V55M20 45V20\"/>",
        "<path d=\"M20 20H120V80H20V55\"/><path d=\"M20 45V20\"/><circle cx=\"70\" cy=\"50\" r=\"6\"/>",
    ] {
        assert_roles(&proposed("a.svg", &with_hose(curves)), &edge_and_port);
    }
    let open = CLOSED_EDGE
        .replace("|70|1|", "|70|0|")
        .replace("|90|4|", "|90|6|")
        .replace("|10|20|20|20|", "|10|20|20|45|10|20|20|20|")
        + "10|20|20|55|";
    let of_one_layer = [("0", LayerRole::Air), ("LINE 30", LayerRole::Port)];
    assert_roles(&proposed("a.dxf", &one_layer(&open, HOSE)), &of_one_layer);
    let weld = "<rect x=\"20\" y=\"20\" width=\"100\" height=\"60\"/><g stroke=\"#0000ff\">\
                <path d=\"M60 45V35H90V65H60V55\"/></g><path stroke=\"#00ff00\" d=\"M58 50h4\"/>";
    let roles = propose_layers("a.svg", with_hose(weld).as_bytes(), None).expect("a drawing").layers;
    assert!(roles.iter().any(|(layer, role, _)| layer == "#0000ff" && *role == LayerRole::Seam), "{roles:?}");
}
