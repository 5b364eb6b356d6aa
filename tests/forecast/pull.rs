//! The pull of a drawing at two bars.

use stargrip_cam::design::Design;
use stargrip_cam::forecast::drawn::text::text;
use stargrip_cam::forecast::drawn::{inflate, of_spec};
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::forecast::shell::Detail;
use stargrip_cam::shell::cases::Watch;
use stargrip_cam::spec::{Machine, Source, Spec, read};

/// A pouch of 100 x 40 mm with `bars` and more of its `load`; the page is 140 x 80 mm.
fn pouch(bars: &str, load: &str) -> (Spec, Design) {
    let text = format!(
        "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = {{ air = [\"a\"], port = [\"p\"], pull = [{}] }}\n\
         [load]\npressure = \"14 kPa\"\n{load}\n",
        if bars.is_empty() { "" } else { "\"b\"" }
    );
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"140mm\" height=\"80mm\" viewBox=\"0 0 140 80\">\
         <g id=\"a\"><rect x=\"20\" y=\"20\" width=\"100\" height=\"40\"/></g><g id=\"p\"><path d=\"M20 38V42\"/></g>\
         <g id=\"b\">{bars}</g></svg>"
    );
    let reading = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(svg.as_bytes()).spec;
    let design = Design::new(&spec, &Machine::builtin("generic").expect("built in"))
        .unwrap_or_else(|refusals| panic!("{refusals}"));
    (spec, design)
}

const LONG_SEAMS: &str = "<path id=\"top\" d=\"M20 18H120\"/><path id=\"bottom\" d=\"M20 60H120\"/>";

/// A bar on the band holds the edge beside it; what hangs on the bars lies on the curve.
#[test]
fn a_pouch_lifts_what_its_curve_says() {
    // The bars lie on the band and on the edge. The answer is compared with the closed form of an endless pouch, and the lifted mass with the rows
    // of the curve on both sides of it.
    let (spec, design) = pouch(LONG_SEAMS, "mass = \"2 kg\"");
    let pieces = design.drawn_pieces().expect("a drawing");
    let drawing = inflate(&spec, pieces, Detail::Coarse, &Watch::default()).expect("a shell").prediction;
    let pull = drawing.pull.clone().expect("bars");
    assert_eq!((pull.bars.clone(), pull.chamber), (["top", "bottom"].map(str::to_owned), 1));
    assert!((pull.distance_mm - 40.0).abs() < 1e-6);
    // 152 N without ends, by arcs that stretch; and 1 - 2/pi of the length.
    assert!((140.0..154.0).contains(&pull.blocked_force_N.value), "{:?}", pull.blocked_force_N);
    assert!((10.0..14.6).contains(&pull.free_stroke_mm.value), "{:?}", pull.free_stroke_mm);
    let lifted = pull.lifted_mm.expect("2 kg are lifted").value;
    let weight = 2.0 * 9.80665;
    let [_, force, error] = *pull.curve.iter().rfind(|row| row[0] <= lifted).expect("a row");
    assert!(weight <= force + error, "{weight} N at {lifted} mm, below {force} N");
    if let Some([_, force, error]) = pull.curve.iter().find(|row| row[0] >= lifted) {
        assert!(force - error <= weight, "{weight} N at {lifted} mm, above {force} N");
    }
    let page = text(&spec, &drawing, false);
    for words in ["pull between top and bottom, flat 40 mm apart", "blocked force", "stroke under 2 kg"] {
        assert!(page.contains(words), "{words}: {page}");
    }
}

/// Bars and their loads that no chamber can have, each with its remedy.
#[test]
fn wrong_bars_are_refused() {
    // Each row has one fault in its bars or loads, which `check` finds without the shell. The problem is named, and what to do.
    let top = "<path id=\"top\" d=\"M20 20H120\"/>";
    for (bars, load, problem, remedy) in [
        (top, "", "role `pull` has 1 figures, and bars are two", "draw two straight lines"),
        (
            "<path id=\"top\" d=\"M20 20H120\"/><path id=\"ring\" d=\"M20 60Q70 70 120 60\"/>",
            "",
            "bar \"ring\" is no straight line",
            "along a straight seam",
        ),
        (
            "<path id=\"top\" d=\"M20 20H120\"/><path id=\"askew\" d=\"M20 40L70 60\"/>",
            "",
            "bar \"askew\" does not lie along a straight seam",
            "along a straight seam",
        ),
        (
            "<path id=\"top\" d=\"M20 20H120\"/><path id=\"away\" d=\"M20 79H120\"/>",
            "",
            "bar \"away\" lies more than",
            "along a straight seam",
        ),
        (
            "<path id=\"top\" d=\"M20 20H120\"/><path id=\"again\" d=\"M20 19H120\"/>",
            "",
            "bars \"top\" and \"again\" are 0 mm apart",
            "seams",
        ),
        (LONG_SEAMS, "plates = \"8 mm\"", "between plates or between bars", "delete `plates`"),
        ("", "mass = \"2 kg\"", "no layer has the role `pull`", ""),
    ] {
        let (spec, design) = pouch(bars, load);
        let pieces = design.drawn_pieces().expect("a drawing");
        let PredictFault { what: text, remedy: advice, .. } =
            of_spec(&spec, pieces, &Watch::default()).expect_err(problem);
        assert!(text.contains(problem), "{text}");
        assert!(advice.unwrap_or_default().contains(remedy), "{text}");
    }
}
