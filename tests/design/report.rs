//! The report: one page with the content of the other files, without anything that a browser would run or fetch.

use proptest::prelude::*;
use serde_json::Value;
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::forecast::charts::{AtRadius, charts};
use stargrip_cam::geom::Point;
use stargrip_cam::pipeline::{self, Built, Interface, Sources};

use crate::readers::html::read_html;

use crate::support;

const REPORT: &str = "report.html";
const GRIPPER: &str = include_str!("../../designs/paper-gripper.toml");

fn built(text: &str) -> Built {
    let sources = Sources { spec: text, machine: support::generic() };
    let request = KindRequest { only: vec![Kind::Prediction], with: vec![Kind::Report] };
    pipeline::build(&support::read(text), &support::machine(), sources, &request).expect("a gripper")
}

fn page(built: &Built) -> String {
    let (_, bytes) = built.files().find(|(name, _)| *name == REPORT).expect("a report");
    String::from_utf8(bytes.into_owned()).expect("text")
}

fn block_of(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"data\">").expect("a block");
    serde_json::from_str(rest.split_once("</script>").expect("its end").0).expect("JSON")
}

#[test]
fn every_shipped_design_has_a_report_that_is_proven_small_and_the_same_each_time() {
    let shipped = std::fs::read_dir("designs").expect("designs").map(|entry| entry.expect("a design").path());
    for design in shipped.filter(|path| path.is_file()) {
        let text = std::fs::read_to_string(design).expect("text");
        let gripper = built(&text);
        assert_eq!(gripper.proof().findings, []);
        let read = read_html(&page(&gripper)).map(|report| report.title);
        assert_eq!(read, Ok(gripper.forecast.spec.name.clone()));
        assert_eq!(page(&gripper), page(&built(&text)));
        assert!(page(&gripper).len() < 1_000_000, "{} bytes", page(&gripper).len());
    }
}

#[test]
fn curves_meet_the_prediction() {
    for model in ["auto", "fit", "ring", "section"] {
        let text = format!("{GRIPPER}\n[accuracy]\nmodel = \"{model}\"\n");
        let gripper = built(&text).forecast;
        let prediction = gripper.prediction.as_ref().expect("a load");
        let chart_list = charts(&gripper.spec, &gripper.design);
        assert_eq!(chart_list.len(), 1);
        for chart in chart_list {
            let star_prediction = &prediction.stars[chart.star - 1];
            assert_eq!(chart.model, star_prediction.model);
            let row =
                chart.by_pressure.iter().find(|row| (row.pressure_kPa - 37.0).abs() < 1e-9).expect("its own");
            assert_eq!(Some(row.final_radius_mm), star_prediction.final_radius_mm, "{model}");
            assert_eq!(row.radius_range_mm, star_prediction.ranges.final_radius_mm, "{model}");
            assert_eq!(row.object_force_N, star_prediction.object_force_N, "{model}");
            // On the object, which is wider than the star closes.
            assert!((row.pose.inner_radius_mm - 40.0).abs() < 1e-6, "{model}: {:?}", row.pose);
            let points = chart.by_points.iter().find(|row| row.points == 5).expect("its own");
            assert_eq!(Some(points.contraction), star_prediction.contraction, "{model}");
            let forces = &chart.by_radius;
            let rising = |pair: &[AtRadius]| {
                pair[0].radius_mm < pair[1].radius_mm && pair[0].force_N < pair[1].force_N
            };
            assert!(forces.windows(2).all(rising) && forces.len() > 30, "{forces:?}");
            let wider = forces.iter().position(|row| row.radius_mm > 40.0).expect("wider ones");
            let [low, high] = [forces[wider - 1], forces[wider]];
            let share = (40.0 - low.radius_mm) / (high.radius_mm - low.radius_mm);
            let interpolated = low.force_N + (high.force_N - low.force_N) * share;
            assert!(
                (interpolated / star_prediction.object_force_N.expect("held") - 1.0).abs() < 0.01,
                "{interpolated}"
            );
        }
    }
}

/// Values that `predict` calls unknown are not drawn, and the page is proven all the same.
#[test]
fn what_is_unknown_has_no_curve_and_no_pose() {
    let wide = support::PAPER.replace("50 mm", "130 mm");
    let text = format!("{wide}\n[load]\npressure = \"37 kPa\"\nobject_radius = \"100 mm\"\n");
    let gripper = built(&text);
    assert_eq!(gripper.proof().findings, []);
    let star_prediction = &gripper.forecast.prediction.as_ref().expect("a load").first;
    assert_eq!(
        (star_prediction.final_radius_mm, star_prediction.contraction, star_prediction.object_force_N),
        (None, None, None)
    );
    let chart = &charts(&gripper.forecast.spec, &gripper.forecast.design)[0];
    assert!(chart.by_pressure.iter().all(|row| row.radius_range_mm.is_some()));
    assert!(chart.by_pressure.iter().all(|row| (row.pressure_kPa - 37.0).abs() > 1e-9));
    assert!(chart.by_points.iter().all(|row| row.points != 5 && row.contraction_range.is_some()));
    assert_eq!(chart.by_radius, []);
    // At its own pressure the radius is known, at a third of it unknown.
    let gripper = built(&GRIPPER.replace("\"37 kPa\"", "\"2 kPa\"")).forecast;
    let chart = &charts(&gripper.spec, &gripper.design)[0];
    assert!(chart.by_pressure.iter().all(|row| row.radius_range_mm.is_some()) && chart.by_pressure.len() > 8);
    assert!(chart.by_pressure.len() < 24, "{}", chart.by_pressure.len());
}

/// The page lists the precautions of `check`, in its order.
#[test]
fn it_warns_of_what_check_warns_of() {
    let gripper = built(GRIPPER);
    let watch = block_of(&page(&gripper))["watch"].clone();
    let warnings: Vec<Value> = gripper
        .forecast
        .precautions(Interface::Command("spec.toml"))
        .iter()
        .map(|one| serde_json::json!({ "code": one.code.to_string(), "text": one.text }))
        .collect();
    assert!(warnings.len() >= 2);
    assert_eq!(watch, Value::Array(warnings));
}

/// Steps end at the times of the program, and none before its predecessor.
#[test]
fn a_timeline_ends_with_its_program() {
    let gripper = built(GRIPPER).forecast;
    for program in &gripper.programs {
        let times = program.timeline(&gripper.spec, &gripper.machine);
        assert_eq!(times.len(), program.steps.len());
        assert_eq!(times.last(), Some(&program.time));
        assert!(times.windows(2).all(|pair| pair[0] <= pair[1]), "{times:?}");
    }
    let block = block_of(&page(&built(GRIPPER)));
    let ends =
        |program: &Value| program["steps"].as_array().and_then(|steps| steps.last()?["end_s"].as_f64());
    for program in block["programs"].as_array().expect("programs") {
        assert_eq!(ends(program), program["time_s"].as_f64());
    }
}

#[test]
fn without_a_load_it_says_what_is_known() {
    let block = block_of(&page(&built(support::PAPER)));
    assert!(block["prediction"].is_null() && block["charts"] == Value::Array(Vec::new()));
    assert_eq!(block["parts"][0]["points"], 5);
}

#[test]
fn the_page_says_what_manifest_and_prediction_say() {
    let gripper = built(GRIPPER);
    let report = read_html(&page(&gripper)).expect("a page that only shows its figures");
    assert_eq!(report.title, "paper gripper, three stars");
    let files: Vec<(&str, Value)> = gripper
        .files()
        .filter(|(name, _)| ["prediction.json", "manifest.json"].contains(name))
        .map(|(name, bytes)| (name, serde_json::from_slice(&bytes).expect("JSON")))
        .collect();
    let [(_, prediction), (_, manifest)] = &files[..] else { panic!("{files:?}") };
    assert_eq!(&report.data["prediction"], prediction);
    for (key, value) in report.data["bill"].as_object().expect("a bill") {
        assert_eq!(value, &manifest[key], "{key}");
    }
    let (_, scene) = gripper.forecast.spec.load.as_ref().map(|load| (load, report.scene)).expect("a load");
    assert!(scene.starts_with(b"glTF"));
}

/// Each seam is drawn once, within 0.05 mm of the design's.
#[test]
fn the_player_draws_every_seam_where_it_is() {
    let gripper = built(GRIPPER);
    let data = block_of(&page(&gripper));
    let design = &gripper.forecast.design;
    let mut runs = 0;
    for program in data["programs"].as_array().expect("programs") {
        for step in program["steps"].as_array().expect("steps").iter().filter(|step| step["do"] == "seal") {
            let index = step["seam"].as_u64().and_then(|seam| usize::try_from(seam).ok()).expect("a seam");
            let seam = &program["seams"][index];
            let placed = design
                .assembly()
                .expect("stars")
                .stars
                .iter()
                .find(|star| seam["star"] == star.index)
                .expect("a star");
            let side = usize::from(seam["loop"] == "outer");
            let run = placed
                .placement
                .path(&design.assembly().expect("stars").part(placed).shape.seams[side].run());
            let steps = step["path"].as_array().expect("a path").iter();
            let steps: Vec<f64> = steps.map(|x| x.as_f64().expect("a number") / 100.0).collect();
            let (mut pen, mut length) = (Point::ORIGIN, 0.0);
            for (k, step) in steps.chunks_exact(2).enumerate() {
                let next = Point::new(pen.x + step[0], pen.y + step[1]);
                length += if k > 0 { pen.distance(next) } else { 0.0 };
                pen = next;
                let deviation =
                    run.segments.iter().map(|one| one.distance(pen)).fold(f64::INFINITY, f64::min);
                assert!(deviation <= 0.05, "{deviation} mm beside {seam}");
            }
            assert!((length / run.length() - 1.0).abs() < 1e-3, "{length} mm of {}", run.length());
            runs += 1;
        }
    }
    assert_eq!(runs, 2 * design.assembly().expect("stars").stars.len());
}

/// The interface, which the tests above rely on, refuses content that could run or fetch something.
#[test]
fn a_page_that_could_run_or_fetch_something_else_is_refused() {
    let right = page(&built(GRIPPER));
    for (from, to, says) in [
        ("<footer>", "<footer onclick=\"x()\">", "an attribute `onclick`"),
        ("<footer>", "<iframe></iframe><footer>", "an element `iframe`"),
        ("<footer>", "<p>http://example.org</p><footer>", "an address of a network"),
        ("<footer>", "<script>alert(1)</script><footer>", "5 styles and scripts"),
        ("\"use strict\";", "\"use strict\"; alert(1);", "a policy"),
        ("default-src 'none'", "default-src *", "a policy"),
    ] {
        let fault = read_html(&right.replacen(from, to, 1)).expect_err(to);
        assert!(fault.starts_with(says), "{to}: {fault}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Whatever the name of a spec, its page runs only its own scripts, and shows the name.
    #[test]
    fn names_are_inert(words in prop::collection::vec(prop::sample::select(vec![
        "</script>", "<script>alert(1)</script>", "<!--", "-->", "]]>", "'\" onload='x()'", "&lt;", "&#60;", "\u{2028}", "{{DATA}}",
        "https://example.org", "\u{e9}\u{1F600}", "</title>", "javascript:", " ", "\\u003c", "${x}", "`",
    ]), 1..5)) {
        let name: String = words.concat().chars().take(80).collect();
        prop_assume!(!name.trim().is_empty());
        let quoted = serde_json::to_string(&name).expect("a text");
        let text = support::PAPER.lines().map(|line| if line.starts_with("name") { format!("name = {quoted}") } else { line.to_owned() });
        let text = text.collect::<Vec<_>>().join("\n");
        prop_assume!(stargrip_cam::spec::read(&stargrip_cam::spec::Source::new("x", text.clone())).is_ok());
        let gripper = built(&text);
        prop_assert_eq!(gripper.proof().findings, []);
        let report = read_html(&page(&gripper)).expect("a page that only shows its figures");
        prop_assert_eq!(&report.data["name"], &name);
        prop_assert_eq!(report.title, name);
    }
}

/// A drawing's page has its chambers and, where the shell was computed, the inflated surface; without it the page states so.
#[test]
fn a_drawing_has_a_report_and_a_scene_of_its_own() {
    let pillow = include_str!("../../designs/drawings/pillow.toml");
    for model in ["shell", "auto"] {
        let text = format!("{pillow}\n[load]\npressure = \"10 kPa\"\n[accuracy]\nmodel = \"{model}\"\n");
        let drawing = include_bytes!("../../designs/drawings/pillow.dxf");
        let reading =
            stargrip_cam::spec::read(&stargrip_cam::spec::Source::new("x", text.as_str())).expect("a spec");
        let sources = Sources { spec: &text, machine: support::generic() };
        let request = KindRequest { only: vec![Kind::Prediction], with: vec![Kind::Report, Kind::SceneGlb] };
        let result =
            pipeline::build(&reading.with_drawing(drawing).spec, &support::machine(), sources, &request);
        let gripper = result.unwrap_or_else(|refusals| panic!("{refusals}"));
        assert_eq!(gripper.proof().findings, []);
        assert_eq!(read_html(&page(&gripper)).map(|report| report.title), Ok("pillow".to_owned()));
        let block = block_of(&page(&gripper));
        let prediction = &block["drawing"]["prediction"];
        let (_, file) = gripper.files().find(|(name, _)| *name == "prediction.json").expect("a prediction");
        assert_eq!(*prediction, serde_json::from_slice::<Value>(&file).expect("JSON"));
        assert!(block["parts"][0]["tube"].is_array() && block["stack"].is_null());
        let (_, scene) = gripper.files().find(|(name, _)| *name == "scene.glb").expect("a scene");
        let inflates = String::from_utf8_lossy(&scene).contains("\"inflate\"");
        assert_eq!(inflates, model == "shell");
        assert_eq!(prediction["volume_mm3"].is_null(), model != "shell");
    }
}
