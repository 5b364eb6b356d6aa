//! Measures of a drawing, and chambers at pressures of their own.

use stargrip_cam::design::{Design, DrawnPieces, Refusals};
use stargrip_cam::forecast::drawn::measures::{MeasurePrediction, MeasuredQuantity};
use stargrip_cam::forecast::drawn::text::text;
use stargrip_cam::forecast::drawn::{InflatedDrawing, inflate, of_spec};
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::forecast::shell::Detail;
use stargrip_cam::forecast::shell::star::ShellRefusal;
use stargrip_cam::shell::cases::Watch;
use stargrip_cam::spec::units::Length;
use stargrip_cam::spec::{Machine, MeasuredFigure, Source, Spec, WrittenMeasure, read};

/// A spec and the pieces of its drawing.
struct Drawn {
    spec: Spec,
    pieces: DrawnPieces,
}

/// Two pouches of 40 x 100 mm, 40 mm apart, and `measures`, as a drawing at `kilopascals`.
fn pouches(measures: &str, kilopascals: &str) -> Drawn {
    drawing(
        "<rect x=\"30\" y=\"30\" width=\"40\" height=\"100\"/><rect id=\"right\" x=\"110\" y=\"30\" width=\"40\" height=\"100\"/>",
        "<path d=\"M50 26V34\"/><path d=\"M130 26V34\"/>",
        measures,
        kilopascals,
    )
}

/// A drawing on a page of 200 x 160 mm.
fn drawing(air: &str, ports: &str, measures: &str, kilopascals: &str) -> Drawn {
    let layer = if measures.is_empty() { "" } else { "\"m\"" };
    let text = format!(
        "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\nair = [\"a\"]\nport = [\"p\"]\nmeasure = [{layer}]\n\
         [load]\npressure = \"{kilopascals} kPa\"\n"
    );
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"160mm\" viewBox=\"0 0 200 160\">\
         <g id=\"a\">{air}</g><g id=\"p\">{ports}</g><g id=\"m\">{measures}</g></svg>"
    );
    let reading = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(svg.as_bytes()).spec;
    let pieces = pieces_of(&spec).unwrap_or_else(|refusals| panic!("{refusals}"));
    Drawn { spec, pieces }
}

fn pieces_of(spec: &Spec) -> Result<DrawnPieces, Refusals> {
    let design = Design::new(spec, &Machine::builtin("generic").expect("built in"))?;
    Ok(design.drawn_pieces().expect("a drawing").clone())
}

fn inflated(Drawn { spec, pieces }: &Drawn) -> InflatedDrawing {
    inflate(spec, pieces, Detail::Coarse, &Watch::default()).unwrap_or_else(|why| panic!("{why:?}"))
}

fn by_name<'d>(drawing: &'d InflatedDrawing, name: &str) -> &'d MeasurePrediction {
    drawing.prediction.measures.iter().find(|measure| measure.measure == name).expect(name)
}

/// Asserts the flat value exactly and the inflated one within `range`.
#[track_caller]
fn assert_within(quantity: Option<MeasuredQuantity>, flat: f64, range: std::ops::RangeInclusive<f64>) {
    let quantity = quantity.expect("measured");
    let value = quantity.inflated.expect("inflated").value;
    assert!((quantity.flat - flat).abs() < 1e-3 * flat.abs() && range.contains(&value), "{quantity:?}");
}

/// The middle of a pouch contracts by 35.8 %, its corners stay: extents hide the answer. A tube as long as wide without ends has 36.34 %.
#[test]
fn the_middle_of_a_pouch_contracts() {
    let measures = "<path id=\"middle\" d=\"M30 80H70\"/><path id=\"end\" d=\"M110 130H150\"/>\
        <path id=\"hook\" d=\"M50 50V80H70\"/><circle id=\"top\" cx=\"130\" cy=\"80\" r=\"1\"/>";
    let drawing = inflated(&pouches(measures, "14"));
    assert_within(by_name(&drawing, "middle").distance_mm, 40.0, 25.5..=25.9);
    // The end seam folds; this mesh holds it longer than the mean of its folds, 34.5 mm.
    assert_within(by_name(&drawing, "end").distance_mm, 40.0, 35.8..=36.8);
    assert_within(by_name(&drawing, "hook").angle_deg, 90.0, 88.0..=92.0);
    assert_eq!(["middle", "end", "top"].map(|name| by_name(&drawing, name).chamber), [1, 2, 2]);
    let (top, chamber) = (by_name(&drawing, "top"), &drawing.prediction.chambers[1]);
    let height = top.height_mm.and_then(|height| height.inflated).expect("inflated").value;
    assert!((height / chamber.height_mm.expect("inflated").value - 1.0).abs() < 0.02, "{height}");
    // The chamber lies best on its flat place, so its middle does not move.
    assert_within(top.x_mm, 130.0, 129.9..=130.1);
    assert_within(top.y_mm, 80.0, 79.9..=80.1);
}

/// A bent tube of flat inner radius 60.11 mm and 20 mm between its seams, at 14 kPa.
#[test]
fn a_bent_tube_has_a_radius() {
    let air = "<path d=\"M 180.11 100 A 80.11 80.11 0 0 0 38.632 48.506 L 53.953 61.362 A 60.11 60.11 0 0 1 160.11 100 Z\"/>";
    let curve = "<path id=\"inside\" d=\"M 156.118 78.459 A 60.11 60.11 0 0 0 70.858 47.427\"/>";
    let drawing = inflated(&drawing(air, "<path d=\"M170.11 96V104\"/>", curve, "14"));
    assert_within(by_name(&drawing, "inside").radius_mm, 60.11, 50.0..=51.0);
}

/// Measures change no other number, and without a shell they have their flat values.
#[test]
fn measures_only_look() {
    let line = "<path id=\"middle\" d=\"M30 80H70\"/>";
    let Drawn { spec, pieces } = pouches(line, "1");
    let flat = of_spec(&spec, &pieces, &Watch::default()).expect("flat");
    let distance = by_name(&flat, "middle").distance_mm.expect("measured");
    assert_eq!((distance.flat, distance.inflated), (40.0, None));
    let measured = inflated(&Drawn { spec, pieces }).prediction;
    let unmeasured = inflated(&pouches("", "1")).prediction;
    assert_eq!((measured.chambers, unmeasured.measures), (unmeasured.chambers, Vec::new()));
}

/// A square pouch has two stable shapes here: one of the seams across folds in the middle of the higher one, which so is far shorter there. Its
/// measure has a range that holds both, and a warning says that other folds may differ by more.
#[test]
fn a_measure_on_folds_has_a_range() {
    let air = "<rect x=\"80\" y=\"60\" width=\"40\" height=\"40\"/>";
    let measures = "<path id=\"along\" d=\"M100 60V100\"/><path id=\"across\" d=\"M80 80H120\"/>";
    let square = drawing(air, "<path d=\"M90 56V64\"/>", measures, "5.4");
    let answer = inflated(&square);
    let folded = ["along", "across"].map(|name| by_name(&answer, name).distance_mm.expect("measured"));
    let shorter = if value(Some(folded[0])) < value(Some(folded[1])) { folded[0] } else { folded[1] };
    let [low, high] = shorter.range.expect("two shapes");
    assert!(low < value(Some(shorter)) && value(Some(shorter)) < 30.0 && high > 36.0, "{shorter:?}");
    let warnings = &answer.prediction.evidence.warnings;
    assert!(warnings.iter().any(|warning| warning.text.contains("where folds lie")), "{warnings:?}");
    let page = text(&square.spec, &answer.prediction, false);
    assert!(page.lines().any(|line| line.contains("distance") && line.contains(" to ")), "{page}");
}

/// Between plates a pouch presses with the pressure on the area that touches them; bent fabric bears a part of it at the edge of that area.
#[test]
fn a_pouch_presses_on_plates() {
    let mut pouch = pouches("", "14");
    pouch.spec.load.as_mut().expect("a load").plates = Some(Length(15.0));
    let answer = inflated(&pouch);
    for chamber in &answer.prediction.chambers {
        let plates = chamber.plates.expect("plates");
        // 14 kPa are 0.014 N/mm^2.
        let by_area = plates.force_N.value / (0.014 * plates.contact_area_mm2.value);
        assert!(by_area > 0.98 && by_area < 1.6, "{plates:?}");
        let height = chamber.height_mm.expect("inflated");
        assert!((height.value - 15.0).abs() < 0.05 + height.mesh_error, "{height:?}");
    }
    let page = text(&pouch.spec, &answer.prediction, false);
    assert!(page.contains("force on each plate") && page.contains("contact area"), "{page}");
}

/// The flat values of `measure` on two pouches.
fn flat_measure(measure: &str) -> Result<MeasurePrediction, PredictFault> {
    let Drawn { spec, pieces } = pouches(measure, "1");
    of_spec(&spec, &pieces, &Watch::default()).map(|drawing| drawing.prediction.measures[0].clone())
}

/// A point on a band is taken at the edge; one beside the piece, and a measure of two chambers, are refused by name.
#[test]
fn measures_lie_in_one_chamber() {
    let moved = flat_measure("<path id=\"wide\" d=\"M29 80H71\"/>").expect("on the band");
    assert_eq!((moved.moved_mm, moved.distance_mm.map(|distance| distance.flat)), (1.0, Some(40.0)));
    for (measure, word) in [
        ("<path id=\"far\" d=\"M50 80H90\"/>", "more than 10 mm from the air"),
        ("<path id=\"both\" d=\"M50 80H130\"/>", "from one chamber to another"),
    ] {
        let fault = flat_measure(measure).expect_err("refused");
        assert!(fault.what.contains(word) && fault.remedy.is_some(), "{fault}");
    }
}

/// A measure of the spec lies on its points or on an element; a name of two elements, or of nothing, is refused.
#[test]
fn a_spec_measures_what_it_names() {
    let pouch = pouches("", "1");
    let line = [[30.0, 80.0], [70.0, 80.0]].map(|point| point.map(Length)).to_vec();
    let span = measured(&pouch, MeasuredFigure::Points(line)).expect("in one chamber");
    assert_eq!((span.measure.as_str(), span.distance_mm.map(|distance| distance.flat)), ("span", Some(40.0)));
    let edge = measured(&pouch, MeasuredFigure::Named("right".to_owned())).expect("an element");
    assert_eq!(
        (edge.chamber, edge.x_mm.map(|place| place.flat)),
        (2, Some(130.0)),
        "the middle of a closed one"
    );
    for (name, words) in [("a", "the name of 2 elements"), ("spam", "nothing called \"spam\"")] {
        let refusal = measured(&pouch, MeasuredFigure::Named(name.to_owned())).expect_err("refused");
        assert!(refusal.contains(words), "{refusal}");
    }
}

/// The flat values of the measure "span" of `figure` on `pouch`.
fn measured(pouch: &Drawn, figure: MeasuredFigure) -> Result<MeasurePrediction, String> {
    let mut spec = pouch.spec.clone();
    let measure = WrittenMeasure { name: "span".to_owned(), figure };
    spec.drawing.as_mut().expect("a drawing").measures = vec![measure];
    let pieces = pieces_of(&spec).map_err(|refusals| refusals.to_string())?;
    let flat = of_spec(&spec, &pieces, &Watch::default()).expect("flat");
    Ok(flat.prediction.measures[0].clone())
}

/// A strip of 40 x 80 mm, parted along its middle by a wall; a hose into each half, and a line across each end. `chambers` are the lines of
/// `[load.chambers]`.
fn bimorph(chambers: &str) -> Result<InflatedDrawing, ShellRefusal> {
    let text = format!(
        "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\nair = [\"a\"]\nseam = [\"w\"]\nport = [\"p\"]\n\
         measure = [\"m\"]\n[fabric]\nthickness = \"0.1 mm\"\n[load]\npressure = \"10 kPa\"\n[load.chambers]\n{chambers}"
    );
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"80mm\" viewBox=\"0 0 200 80\">\
        <g id=\"a\"><rect x=\"20\" y=\"20\" width=\"80\" height=\"40\"/></g><g id=\"w\"><path id=\"wall\" d=\"M20 40H100\"/></g>\
        <g id=\"p\"><path id=\"upper\" d=\"M16 30H24\"/><path id=\"lower\" d=\"M16 50H24\"/></g>\
        <g id=\"m\"><path id=\"base\" d=\"M30 20V60\"/><path id=\"tip\" d=\"M90 20V60\"/></g></svg>";
    let reading = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(svg.as_bytes()).spec;
    let design = Design::new(&spec, &Machine::builtin("generic").expect("built in"))
        .unwrap_or_else(|refusals| panic!("{refusals}"));
    inflate(&spec, design.drawn_pieces().expect("a drawing"), Detail::Coarse, &Watch::default())
}

/// The angle between tip and base, and the turn of the tip, deg.
fn bend(drawing: &InflatedDrawing) -> [f64; 2] {
    let [base, tip] = ["base", "tip"].map(|name| by_name(drawing, name));
    assert_eq!(tip.angle_to.as_deref(), Some("base"));
    [value(tip.angle_deg), value(tip.direction_deg) - value(base.direction_deg)]
}

fn value(quantity: Option<MeasuredQuantity>) -> f64 {
    quantity.and_then(|quantity| quantity.inflated).expect("inflated").value
}

/// A strip bends to the side of the higher pressure, and as far to either side.
#[test]
fn a_strip_bends_to_the_chamber_of_higher_pressure() {
    let [equal, upper, lower] = ["", "lower = \"0 kPa\"", "upper = \"0 kPa\""]
        .map(|chambers| bimorph(chambers).unwrap_or_else(|why| panic!("{why:?}")));
    assert!(bend(&equal)[0] < 0.1, "{:?}", bend(&equal));
    let ([angle, turn], [mirrored_angle, mirrored_turn]) = (bend(&upper), bend(&lower));
    // The ends of the pouches pull the strip to the inflated side; its first line runs from the upper edge to the lower one.
    assert!(angle > 3.0 && (angle - turn.abs()).abs() < 0.1, "{angle} {turn}");
    assert!(turn < 0.0 && mirrored_turn > 0.0, "{turn} {mirrored_turn}");
    assert!((angle - mirrored_angle).abs() < 0.05 * angle, "{angle} {mirrored_angle}");
    let [full, half] = [&equal, &upper].map(|drawing| drawing.prediction.volume_mm3.expect("inflated").value);
    assert!((0.4..0.6).contains(&(half / full)), "{half} of {full}");
}

#[test]
fn pressures_of_chambers_are_those_of_ports() {
    for (chambers, words) in [
        ("uper = \"0 kPa\"", ["no port is called \"uper\"", "did you mean \"upper\"?"]),
        ("upper = \"0 kPa\"\nlower = \"0 kPa\"", ["no pressure in the chamber", "above 0"]),
    ] {
        let Err(ShellRefusal::Fault(fault)) = bimorph(chambers) else { panic!("{chambers} is taken") };
        assert!(fault.what.contains(words[0]), "{fault}");
        assert!(fault.remedy.as_ref().is_some_and(|remedy| remedy.contains(words[1])), "{fault}");
    }
}
