//! Published numbers computed again, by formulas of this file and from the other files of the same directory.

use std::f64::consts::{PI, TAU};

use serde_json::Value;
use stargrip_cam::artifact::Kind;
use stargrip_cam::pipeline::Built;

use crate::support;

const GRIPPER: &str = include_str!("../../designs/paper-gripper.toml");
const CONICAL: &str = include_str!("../../designs/conical-stack.toml");
/// Rounding of a drawing's coordinates, mm.
const DIGIT: f64 = 1e-4;

fn text(built: &Built, file: &str) -> String {
    let file_found = built.files().find(|(name, _)| *name == file);
    let (_, bytes) = file_found.unwrap_or_else(|| panic!("no {file}"));
    String::from_utf8(bytes.into_owned()).expect("text")
}

fn json(built: &Built, file: &str) -> Value {
    serde_json::from_str(&text(built, file)).expect("JSON")
}

#[track_caller]
fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no number at {path}"))
}

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64, subject: &str) {
    assert!((value - expected).abs() <= tolerance, "{subject}: {value}, computed {expected}");
}

/// Length, mm, and area, mm^2, of each shape of a layer of an SVG: of its `d` with M, L, A and Z, or of its circle.
fn shapes(svg: &str, layer: &str) -> Vec<(f64, f64)> {
    let (_, rest) = svg.split_once(&format!("id=\"{layer}\"")).unwrap_or_else(|| panic!("no {layer}"));
    let (group, _) = rest.split_once("</g>").expect("its end");
    let attribute = |element: &str, name: &str| {
        element
            .split_once(&format!(" {name}=\""))
            .map(|(_, rest)| rest.split('"').next().unwrap_or("").to_owned())
    };
    let shape = |element: &str| {
        if let Some(r) = attribute(element, "r") {
            let r: f64 = r.parse().expect("a radius");
            return Some((TAU * r, PI * r * r));
        }
        attribute(element, "d").map(|d| measured(&d))
    };
    group.split('<').filter_map(shape).collect()
}

fn measured(d: &str) -> (f64, f64) {
    let mut words: Vec<String> = Vec::new();
    for letter in d.chars() {
        match letter {
            'M' | 'L' | 'A' | 'Z' => words.extend([letter.to_string(), String::new()]),
            ' ' | ',' => words.push(String::new()),
            other => words.last_mut().expect("a command first").push(other),
        }
    }
    words.retain(|word| !word.is_empty());
    let (mut length, mut twice) = (0.0, 0.0);
    let (mut pen, mut start, mut i) = ([0.0; 2], [0.0; 2], 0);
    let value = |i: usize| words[i].parse::<f64>().expect("a number");
    while i < words.len() {
        let (count, bulge) = match words[i].as_str() {
            "M" => {
                pen = [value(i + 1), value(i + 2)];
                start = pen;
                i += 3;
                continue;
            }
            "L" => (2, None),
            "A" => (7, Some((value(i + 1), words[i + 4] == "1", words[i + 5] == "1"))),
            _ => (0, None),
        };
        let end = if count == 0 { start } else { [value(i + count - 1), value(i + count)] };
        let chord = (end[0] - pen[0]).hypot(end[1] - pen[1]);
        twice += pen[0] * end[1] - pen[1] * end[0];
        match bulge {
            None => length += chord,
            Some((r, is_large, is_positive)) => {
                let small = 2.0 * (chord / 2.0 / r).min(1.0).asin();
                let angle = if is_large { TAU - small } else { small };
                length += r * angle;
                twice += (if is_positive { 1.0 } else { -1.0 }) * r * r * (angle - angle.sin());
            }
        }
        (pen, i) = (end, i + count + 1);
    }
    (length, twice.abs() / 2.0)
}

fn areas(svg: &str, layer: &str) -> Vec<f64> {
    shapes(svg, layer).into_iter().map(|(_, area)| area).collect()
}

/// Fabric, mass, seams and masks of the bill are those that the drawings hold.
#[test]
fn the_bill_is_that_of_the_drawings() {
    // The knife's kerf moves cut lines, so not with one.
    let conical = CONICAL.replace("[frame]\nkerf = \"0.2 mm\"\n", "");
    assert_ne!(conical, CONICAL);
    for text_of in [GRIPPER, &conical] {
        let spec = format!("{text_of}\n[fabric]\nareal_density = \"0.2 kg/m^2\"\n");
        let built = support::build(&spec).expect("a design");
        let bill = json(&built, "manifest.json");
        let (seal, outline) = (text(&built, "sheet-1-seal.svg"), text(&built, "sheet-1-outline.svg"));
        let (inner, outer) = (shapes(&seal, "seal-inner"), shapes(&seal, "seal-outer"));
        let (cut_areas, hole) = (areas(&outline, "cut-outside"), areas(&outline, "cut-hole"));
        let stars = bill["stars"].as_array().expect("stars");
        assert_eq!([stars.len(), inner.len(), outer.len(), cut_areas.len(), hole.len()], [3; 5]);
        let mut fabric = 0.0;
        for (k, star) in stars.iter().enumerate() {
            for (seam, (length, _)) in [inner[k], outer[k]].into_iter().enumerate() {
                let seam_value = |key: &str| number(star, &format!("/seams/{seam}/{key}"));
                close(seam_value("length_mm"), length + seam_value("overlap_mm"), 2e-3, "a seam");
                // Down and up along the seam, 3 mm far and 5.3 mm high, at the speed of sealing: 0.1 mm/s.
                let ramps = 2.0 * 3.0_f64.hypot(5.3);
                close(seam_value("time_s"), (seam_value("length_mm") + ramps) / 0.1, 0.02, "a seam's time");
            }
            let sheets = 2.0 * (cut_areas[k] - hole[k]);
            close(number(star, "/fabric_mm2"), sheets, 1200.0 * DIGIT, "a star's fabric");
            close(number(star, "/mass_g"), 0.2e-3 * sheets, 1e-3, "a star's mass");
            fabric += sheets;
        }
        close(number(&bill, "/fabric_mm2"), fabric, 0.4, "all fabric");
        close(number(&bill, "/mass_g"), 0.2e-3 * fabric, 2e-3, "all mass");
        for mask in bill["masks"].as_array().expect("masks") {
            let svg = text(&built, &format!("star-{}-mask.svg", mask["star"]));
            let windows = areas(&svg, "mask-window");
            let holes: f64 = windows.iter().chain(&areas(&svg, "registration")).sum();
            let area: f64 = areas(&svg, "mask-plate").iter().sum::<f64>() - holes;
            close(number(mask, "/window_mm2"), windows[0], 0.02, "a window");
            close(number(mask, "/area_mm2"), area, 0.3, "a mask");
            close(number(mask, "/volume_mm3"), 2.0 * area, 0.6, "a mask's volume");
        }
    }
}

/// The report's programs end when the moves of the published programs do, at the feeds written in them.
#[test]
fn the_reports_times_are_those_of_the_programs() {
    let built = support::build_with(GRIPPER, &[Kind::Report]);
    let page = text(&built, "report.html");
    let (_, rest) = page.split_once("id=\"data\">").expect("a block");
    let data: Value = serde_json::from_str(rest.split_once("</script>").expect("its end").0).expect("JSON");
    let bill = json(&built, "manifest.json");
    let programs = data["programs"].as_array().expect("programs");
    assert_eq!(programs.len(), 3);
    for (k, program) in programs.iter().enumerate() {
        let code = text(&built, &format!("star-{}-seal.gcode", k + 1));
        // Half of the last digit of the total, a second, and the stops at corners of travels.
        close(number(program, "/time_s"), moved(&code), 2.0, "a program's time");
        let seams: f64 =
            bill["stars"][k]["seams"].as_array().expect("seams").iter().map(|s| number(s, "/time_s")).sum();
        close(number(&bill["stars"][k], "/time_s"), seams, 2e-3, "a star's time");
        for seam in 0..2 {
            let shown_length = number(program, &format!("/seams/{seam}/length_mm"));
            close(
                shown_length,
                number(&bill["stars"][k], &format!("/seams/{seam}/length_mm")),
                1e-9,
                "a seam",
            );
        }
    }
    close(number(&data, "/bill/fabric_mm2"), number(&bill, "/fabric_mm2"), 0.0, "fabric");
}

/// Seconds of all moves after the operator starts, each at its feed; lines of words X, Y, Z, F alone.
fn moved(code: &str) -> f64 {
    let (mut position, mut feed, mut seconds, mut is_begun) = ([0.0; 3], 0.0, 0.0, false);
    for line in code.lines() {
        is_begun |= line == "M0";
        if !line.starts_with("G0 ") && !line.starts_with("G1 ") {
            continue;
        }
        let mut target: [f64; 3] = position;
        for word in line.split(' ').skip(1) {
            let value: f64 = word[1..].parse().expect("a number");
            match &word[..1] {
                "X" => target[0] = value,
                "Y" => target[1] = value,
                "Z" => target[2] = value,
                "F" => feed = value / 60.0,
                other => panic!("{other} in {line}"),
            }
        }
        if is_begun {
            seconds +=
                (target[0] - position[0]).hypot(target[1] - position[1]).hypot(target[2] - position[2])
                    / feed;
        }
        position = target;
    }
    seconds
}

/// Values of a prediction that follow from the spec, or from other values of it, by a formula.
#[test]
fn the_prediction_obeys_its_closed_forms() {
    let spec = format!(
        "{GRIPPER}mass = \"0.5 kg\"\n[fabric]\nareal_density = \"0.2 kg/m^2\"\nseal_strength = \"9 N/mm\"\n"
    );
    let built = support::build(&spec).expect("a design");
    let (prediction, bill) = (json(&built, "prediction.json"), json(&built, "manifest.json"));
    let value_at = |path: &str| number(&prediction, path);
    // Lengths in m, pressure in Pa, the fabric of the spec's defaults: E 128 MPa, nu 0.39, t 0.3 mm.
    let (n, radius, width, angle) = (5.0_f64, 0.050_f64, 0.030_f64, 30_f64.to_radians());
    let (p, e, nu, t, mu, g) = (37e3, 128e6, 0.39, 0.3e-3_f64, 0.3, 9.806_65);
    let (stretch, bending) = (e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)));
    let (sin, cos) = (angle / 2.0).sin_cos();
    let arm = ((radius + width) * (PI / n).sin() - width * cos) / sin;
    close(value_at("/arm_length_mm"), 1e3 * arm, 1e-9, "the arm");
    close(value_at("/bendability"), p * width.powi(3) / bending, 1e-6, "1/eps");
    close(value_at("/stretch"), p * width / stretch, 1e-12, "the stretch");
    let closed = value_at("/final_radius_mm");
    close(value_at("/contraction"), 1.0 - closed / 50.0, 1e-12, "the contraction");
    for end in 0..2 {
        let radius = value_at(&format!("/ranges/final_radius_mm/{}", 1 - end));
        close(value_at(&format!("/ranges/contraction/{end}")), 1.0 - radius / 50.0, 1e-12, "its range");
        let force = value_at(&format!("/stars/0/ranges/object_force_N/{end}"));
        close(value_at(&format!("/stars/0/ranges/payload_kg/{end}")), mu * force / g, 1e-12, "its payload");
    }
    let force = value_at("/object_force_N");
    close(value_at("/stars/0/payload_kg"), mu * force / g, 1e-12, "a star's payload");
    close(value_at("/payload_kg"), 3.0 * mu * force / g, 1e-12, "the payload");
    close(value_at("/verdict/force_N"), 3.0 * force, 1e-9, "the force");
    close(value_at("/verdict/needed_N"), 0.5 * g / mu, 1e-9, "the force that is needed");
    // The hole is cut 3 mm inside of the seam's inner edge.
    close(value_at("/hole_radius_mm"), 47.0, 1e-9, "the hole");
    close(value_at("/object_gap_mm"), value_at("/hole_radius_mm") - 40.0, 1e-9, "the gap");
    close(value_at("/graspable_radius_mm/0"), closed, 1e-12, "the smallest object");
    close(value_at("/burst_margin"), value_at("/burst_pressure_kPa") / 37.0, 1e-9, "the margin");
    close(value_at("/stack_mass_g"), number(&bill, "/mass_g"), 1e-3, "the mass");
    close(number(&bill, "/prediction/payload_kg"), value_at("/payload_kg"), 0.0, "the bill's payload");
}
