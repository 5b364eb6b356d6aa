//! The model for MuJoCo, read as XML: its ring closes, and by virtual work its springs press on the object as predicted.

use roxmltree::{Document, Node};
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::pipeline::{self, Sources, no_requested_programs};
use stargrip_cam::spec::{Machine, Source, read};

const SPEC: &str = "schema = 1\nname = \"a model\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\n\
                    tip_angle = \"30 deg\"\n[stack]\ncount = 2\nrotation = \"36 deg\"\n";
const LOAD: &str = "[load]\npressure = \"37 kPa\"\nobject_radius = \"38 mm\"\nobject_height = \"90 mm\"\nobject_shape = \"cylinder\"\n\
                    friction = 0.4\n";

/// The text of the model of `spec`, and the predicted force on the object.
fn model(spec: &str) -> (String, f64) {
    let gripper = read(&Source::new("spec.toml", spec)).expect("valid").spec;
    let machine = Machine::builtin("generic").expect("built in");
    let request = KindRequest { with: vec![Kind::Mjcf], ..KindRequest::default() };
    let sources = Sources { spec, machine: "" };
    let built = pipeline::build(&gripper, &machine, sources, &request).expect("a gripper");
    let file = built.artifacts.iter().find(|file| file.output.kind == Kind::Mjcf).expect("a model");
    let force = built.forecast.prediction.expect("a load").first.object_force_N.unwrap_or(0.0);
    (String::from_utf8(file.bytes.clone()).expect("UTF-8"), force)
}

fn named<'a, 'input>(document: &'a Document<'input>, tag: &str, name: &str) -> Node<'a, 'input> {
    let mut nodes = document.descendants().filter(|node| node.has_tag_name(tag));
    nodes.find(|node| node.attribute("name") == Some(name)).unwrap_or_else(|| panic!("no {tag} {name}"))
}

fn numbers(node: Node<'_, '_>, attribute: &str) -> Vec<f64> {
    let text = node.attribute(attribute).unwrap_or_else(|| panic!("no {attribute}"));
    text.split(' ').map(|number| number.parse().expect("a number")).collect()
}

/// The pins of a star: where its links begin, m.
fn pins_of(document: &Document<'_>, star: u32) -> Vec<[f64; 3]> {
    let mut place = [0.0; 3];
    let mut pins = Vec::new();
    for arm in 1..=10 {
        let step = numbers(named(document, "body", &format!("star-{star}-arm-{arm}")), "pos");
        place = std::array::from_fn(|axis| place[axis] + step[axis]);
        pins.push(place);
    }
    pins
}

/// The torque of the spring of joint `name` at the angle 0, N m, with its sign turned.
fn torque_at_zero(document: &Document<'_>, name: &str) -> f64 {
    let joint = named(document, "joint", name);
    numbers(joint, "stiffness")[0] * numbers(joint, "springref")[0]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn its_ring_closes_around_the_object() {
    let (text, _) = model(&format!("{SPEC}{LOAD}"));
    let document = Document::parse(&text).expect("XML");
    for star in [1, 2] {
        let pins = pins_of(&document, star);
        let links: Vec<f64> = (0..10).map(|i| distance(pins[i], pins[(i + 1) % 10])).collect();
        assert!(links.iter().all(|link| (link - links[0]).abs() < 1e-8), "{links:?}");
        let anchor = numbers(named(&document, "connect", &format!("star-{star}-ring")), "anchor");
        assert!((0..3).all(|axis| (pins[9][axis] + anchor[axis] - pins[0][axis]).abs() < 1e-8));
        for corner in 1..=5 {
            let size = numbers(named(&document, "geom", &format!("star-{star}-corner-{corner}")), "size")[0];
            let [x, y, _] = pins[2 * (corner - 1)];
            assert!((x.hypot(y) - size - 0.038).abs() < 1e-8, "{corner}");
        }
    }
    // Star 2 is turned, and lies higher.
    let [low, high] = [1, 2].map(|star| pins_of(&document, star)[0]);
    assert!(low[1].abs() < 1e-9 && high[1].atan2(high[0]).to_degrees() > 35.9 && high[2] > low[2] + 0.02);
    assert_eq!(numbers(named(&document, "geom", "object"), "size"), [0.038, 0.045]);
    assert!(text.contains("friction=\"0.4\"") && text.contains("masses are those of 0.3 kg/m^2"), "{text}");
}

#[test]
fn its_springs_press_as_predicted() {
    let (text, force) = model(&format!("{SPEC}{LOAD}"));
    let document = Document::parse(&text).expect("XML");
    // Tips turn clockwise where they open.
    let torque =
        5.0 * (torque_at_zero(&document, "star-1-tip-1") - torque_at_zero(&document, "star-1-corner-2"));
    let pins = pins_of(&document, 1);
    // The corner's pin is at L sin(a) / sin(36 deg), where the tip opens by twice as much as a grows.
    let opposite_side = pins[0][0] * 36.0_f64.to_radians().sin();
    let slope = (distance(pins[0], pins[1]).powi(2) - opposite_side * opposite_side).sqrt()
        / 36.0_f64.to_radians().sin()
        / 2.0;
    assert!((torque / slope / force - 1.0).abs() < 1e-5, "{torque} {slope} {force}");
    let tendon = named(&document, "fixed", "star-1-corner-1");
    assert_eq!(tendon.children().filter(Node::is_element).count(), 9);
    let product = numbers(tendon, "stiffness")[0] * numbers(tendon, "springlength")[0];
    assert!((product + torque_at_zero(&document, "star-1-corner-2")).abs() < 1e-8);
}

#[test]
fn without_an_object_it_is_closed_and_without_a_pressure_there_is_none() {
    let (text, _) = model(&format!("{SPEC}[load]\npressure = \"37 kPa\"\n"));
    assert!(
        text.contains("radial stiffness of the closed star") && !text.contains("name=\"object\""),
        "{text}"
    );
    assert!(text.contains("friction is not set"), "{text}");
    for spec in [SPEC.to_owned(), format!("{SPEC}[load]\nobject_radius = \"38 mm\"\n")] {
        let gripper = read(&Source::new("spec.toml", spec.as_str())).expect("valid").spec;
        let machine = Machine::builtin("generic").expect("built in");
        let refused = no_requested_programs(&gripper, &machine, &KindRequest::exactly(&[Kind::Mjcf]));
        let refusals = refused.expect_err("no pressure");
        assert!(refusals.iter().any(|refusal| refusal.found.contains("mjcf")), "{refusals:?}");
    }
}
