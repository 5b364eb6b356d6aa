//! The scene: it shows the design.

use std::f64::consts::PI;

use crate::readers::glb::{GlbNode, GlbPart, read_glb};
use serde_json::Value;
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::design::round_tube;
use stargrip_cam::forecast::charts::charts;
use stargrip_cam::forecast::pose::{self, Pose};
use stargrip_cam::pipeline::{self, Built, Forecast, Sources};

use crate::support;

const SCENE: &str = "scene.glb";
const GRIPPER: &str = include_str!("../../designs/paper-gripper.toml");

fn built(text: &str) -> Built {
    let sources = Sources { spec: text, machine: support::generic() };
    let request = KindRequest { only: vec![Kind::Prediction], with: vec![Kind::SceneGlb] };
    pipeline::build(&support::read(text), &support::machine(), sources, &request).expect("a gripper")
}

fn bytes(built: &Built) -> Vec<u8> {
    let (_, bytes) = built.files().find(|(name, _)| *name == SCENE).expect("a scene");
    bytes.into_owned()
}

fn nodes(text: &str) -> Vec<GlbNode> {
    read_glb(&bytes(&built(text))).expect("a GLB")
}

fn part<'a>(nodes: &'a [GlbNode], name: &str, material: &str) -> &'a GlbPart {
    let node = nodes.iter().find(|node| node.name == name).expect("a node");
    node.parts.iter().find(|part| part.material == material).expect("a part")
}

fn radius(p: &[f64; 3]) -> f64 {
    p[0].hypot(p[1])
}

#[test]
fn every_shipped_design_has_a_scene_that_is_proven_and_the_same_each_time() {
    let shipped = std::fs::read_dir("designs").expect("designs").map(|entry| entry.expect("a design").path());
    for design in shipped.filter(|path| path.is_file()) {
        let text = std::fs::read_to_string(design).expect("text");
        let made = built(&text);
        assert_eq!(made.proof().findings, []);
        assert_eq!(bytes(&made), bytes(&built(&text)));
    }
}

#[test]
fn the_stack_stands_as_designed_and_closes_on_its_object() {
    let made = built(GRIPPER);
    // Wider than the stars close by themselves.
    let predicted = 40.0;
    let nodes = read_glb(&bytes(&made)).expect("a GLB");
    for star in ["stack/star 1", "stack/star 2", "stack/star 3"] {
        let tube = part(&nodes, star, "tube");
        let least = |points: &[[f64; 3]]| points.iter().map(radius).fold(f64::INFINITY, f64::min);
        assert!((least(&tube.points) - 50.0).abs() < 1e-3);
        assert!((least(&tube.inflated) - predicted).abs() < 1e-3, "{predicted}");
        // Around each of the columns of corners the fabric is as long as before, minus the shortening by chords.
        for (flat, round) in tube.points.chunks(16).zip(tube.inflated.chunks(16)) {
            assert!((around(flat) - 60.0).abs() < 1e-2, "{}", around(flat));
            assert!((around(round) - 60.0).abs() < 0.01 * 60.0, "{}", around(round));
        }
    }
    let heights: Vec<f64> =
        (1..=3).map(|k| part(&nodes, &format!("stack/star {k}"), "tube").points[0][2]).collect();
    assert!((heights[1] - heights[0] - 40.0).abs() < 1e-3 && (heights[2] - heights[1] - 40.0).abs() < 1e-3);
}

fn around(ring: &[[f64; 3]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let side = |(a, b): (&[f64; 3], &[f64; 3])| (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2]);
    ring.iter().zip(next).map(side).sum()
}

/// Prediction, drawing and scene are of one star: the inner radius, the tube's width and the tips' radius of curvature.
#[test]
fn what_is_predicted_drawn_and_shown_is_one_pose() {
    let alone =
        GRIPPER.lines().filter(|line| !line.starts_with("object_radius")).collect::<Vec<_>>().join("\n");
    let round =
        format!("{}\n[load]\npressure = \"37 kPa\"\n", include_str!("../../designs/round-hinges.toml"));
    for text in [alone.as_str(), GRIPPER, &round] {
        let made = built(text);
        let Forecast { spec, design, prediction, .. } = &made.forecast;
        let prediction = prediction.as_ref().expect("a load");
        let stars = pose::inflated(spec, design, Some(prediction));
        let nodes = read_glb(&bytes(&made)).expect("a GLB");
        let chart = &charts(spec, design)[0];
        let row =
            chart.by_pressure.iter().find(|row| (row.pressure_kPa - 37.0).abs() < 1e-9).expect("its own");
        let drawn = Pose::new(&stars[0]);
        for (one, other) in [
            (row.pose.inner_radius_mm, drawn.inner_radius_mm),
            (row.pose.width_mm, drawn.width_mm),
            (row.pose.tip_radius_mm, drawn.tip_radius_mm),
            (row.pose.tip_centre_mm, drawn.tip_centre_mm),
        ] {
            assert!((one - other).abs() < 1e-6, "{:?} {drawn:?}", row.pose);
        }
        let closed = prediction.first.final_radius_mm.expect("known");
        assert_eq!(row.final_radius_mm, closed);
        let touches =
            spec.load.as_ref().and_then(|load| load.object_radius).map_or(closed, |object| object.0);
        assert!((stars[0].inner_radius - touches).abs() < 1e-6, "{} {touches}", stars[0].inner_radius);
        // Wider than a cylinder, as hinges are.
        let star = &design.assembly().expect("stars").distinct[0].star;
        assert!(stars[0].width > 1.02 * round_tube(star.w) && stars[0].width < star.w);
        let tube = part(&nodes, "stack/star 1", "tube");
        let columns: Vec<&[[f64; 3]]> = tube.inflated.chunks(16).collect();
        // In each half of a sector eleven columns are a corner's, eleven a tip's; in each the first point lies at the hole, the
        // ninth outside.
        let (corner, tip) = (columns[5], columns[16]);
        assert!((radius(&corner[0]) - stars[0].inner_radius).abs() < 2e-3);
        assert!((radius(&tip[0]) - stars[0].tip_centre - stars[0].tip_radius).abs() < 2e-3);
        for column in [corner, tip] {
            assert!(
                (apart(&column[0], &column[8]) - stars[0].width).abs() < 2e-3,
                "{}",
                apart(&column[0], &column[8])
            );
        }
        // Across it lies an ellipse as long as the fabric around it, by the sum of many chords.
        let rise = columns[16].iter().map(|point| point[2]).fold(f64::NEG_INFINITY, f64::max);
        let low = columns[16].iter().map(|point| point[2]).fold(f64::INFINITY, f64::min);
        let around = ellipse(stars[0].width / 2.0, (rise - low) / 2.0);
        assert!((around - 2.0 * star.w).abs() < 1e-3 * star.w, "{around} {}", star.w);
        let centre = {
            let scale = stars[0].tip_centre / radius(&tip[0]).max(1e-9);
            [tip[0][0] * scale, tip[0][1] * scale, tip[0][2]]
        };
        for column in &columns[11..22] {
            assert!((apart(&column[0], &centre) - stars[0].tip_radius).abs() < 2e-3);
        }
    }
}

/// The length of an ellipse with these half axes.
fn ellipse(a: f64, b: f64) -> f64 {
    let point = |k: u32| {
        let (sin, cos) = (2.0 * PI * f64::from(k) / 4096.0).sin_cos();
        (a * cos, b * sin)
    };
    (0..4096).map(|k| (point(k), point(k + 1))).map(|((x, y), (u, v))| (u - x).hypot(v - y)).sum()
}

fn apart(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[test]
fn the_object_stands_in_the_middle_of_the_stack() {
    let load = |more: &str| {
        format!("{}\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\n{more}", support::PAPER)
    };
    let size = |points: &[[f64; 3]], k: usize| {
        let ends = points.iter().map(|p| p[k]);
        [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max)]
    };
    for (more, height) in [
        ("", 60.0),
        ("object_shape = \"cylinder\"\nobject_height = \"200 mm\"\n", 200.0),
        ("object_height = \"80 mm\"\n", 80.0),
    ] {
        let made = built(&load(more));
        assert_eq!(made.proof().findings, [], "{more}");
        let nodes = read_glb(&bytes(&made)).expect("a GLB");
        let object = part(&nodes, "object/object", "object");
        let middle = made.forecast.design.assembly().expect("stars").stack.height / 2.0;
        let [low, high] = size(&object.points, 2);
        assert!(
            (low - middle + height / 2.0).abs() < 0.01 && (high - middle - height / 2.0).abs() < 0.01,
            "{more}: {low} {high}"
        );
        assert!(
            size(&object.points, 0)
                .iter()
                .chain(&size(&object.points, 1))
                .all(|end| (end.abs() - 30.0).abs() < 0.01)
        );
    }
}

/// Viewers built on three.js find the target of an animation by the name of its mesh.
#[test]
fn every_star_has_a_mesh_of_its_own_by_a_name_of_its_own() {
    let made = built(GRIPPER);
    let nodes = read_glb(&bytes(&made)).expect("a GLB");
    let meshes: Vec<&str> =
        nodes.iter().filter(|node| node.animated).map(|node| node.mesh.as_str()).collect();
    assert_eq!(meshes, ["fabric of star 1", "fabric of star 2", "fabric of star 3"]);
    // Their numbers are shared.
    let mut surfaces = Vec::new();
    let file = bytes(&made);
    let length = u32::from_le_bytes(file[12..16].try_into().expect("four")) as usize;
    let document: Value = serde_json::from_slice(&file[20..20 + length]).expect("JSON");
    for mesh in document["meshes"].as_array().expect("meshes") {
        if meshes.iter().any(|name| mesh["name"] == **name) {
            surfaces.push(mesh["primitives"].clone());
        }
    }
    assert!(surfaces.len() == 3 && surfaces.windows(2).all(|pair| pair[0] == pair[1]), "{surfaces:?}");
}

/// The arms are the longest straight sides of the tube's inner rim: rigid, whatever the star does.
#[test]
fn arms_keep_their_length() {
    for text in [GRIPPER, include_str!("../../designs/round-hinges.toml")] {
        let load = if text.contains("[load]") { "" } else { "\n[load]\npressure = \"37 kPa\"\n" };
        let nodes = nodes(&format!("{text}{load}"));
        let tube = part(&nodes, "stack/star 1", "tube");
        let longest = |points: &[[f64; 3]]| {
            let rim: Vec<[f64; 3]> = points.chunks(16).map(|ring| ring[0]).collect();
            let side = |pair: &[[f64; 3]]| (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1]);
            rim.windows(2).map(side).fold(0.0, f64::max)
        };
        assert!(longest(&tube.points) > 20.0);
        let [flat, inflated] = [&tube.points, &tube.inflated].map(|points| longest(points));
        // The width of an inflated tube is not quite that of its flat ends.
        assert!((flat - inflated).abs() < 1e-3 * flat, "{flat} {inflated}");
    }
}

/// No part of the fabric runs through the axis or beyond the flat star, and tips and corners stay on their rays.
#[test]
fn flaps_and_bands_go_along() {
    let nodes = nodes(GRIPPER);
    for material in ["fabric", "inner band", "outer band"] {
        let part = part(&nodes, "stack/star 1", material);
        assert_eq!(part.points.len(), part.inflated.len());
        for (from, to) in part.points.iter().zip(&part.inflated) {
            assert!((from[2] - to[2]).abs() < 1e-6);
            let turned = (to[1].atan2(to[0]) - from[1].atan2(from[0])).sin().abs();
            assert!(turned < (PI / 5.0).sin() && radius(to) > 5.0 && radius(to) < 250.0, "{from:?} {to:?}");
        }
    }
}

#[test]
fn nothing_inflates_without_a_pressure() {
    let nodes = nodes(support::PAPER);
    assert!(
        nodes.iter().all(|node| !node.animated && node.parts.iter().all(|part| part.inflated.is_empty()))
    );
    assert!(nodes.iter().any(|node| node.name == "stack/star 1"));
}

/// Plates, posts, masks and sheets have the extent and the volume or area of the design.
#[test]
fn rigid_parts_have_the_size_of_the_design() {
    for text in [GRIPPER, include_str!("../../designs/conical-stack.toml")] {
        let made = built(text);
        let (design, spec) = (&made.forecast.design, &made.forecast.spec);
        let frame = &design.assembly().expect("stars").frame;
        let near = |name: &str, found: f64, right: f64, edges: f64| {
            // Chords lie within 0.05 mm of their arcs; coordinates are rounded to thousandths.
            assert!((found - right).abs() <= 0.056 * edges, "{name}: {found} instead of {right}");
        };
        for node in read_glb(&bytes(&made)).expect("a GLB") {
            let first = &node.parts[0];
            let Some((kind, number)) = node.name.rsplit_once(' ') else { continue };
            let place = || number.parse::<usize>().expect("a number") - 1;
            match kind {
                "stack/plate" => {
                    let plate = frame.plates.iter().find(|plate| plate.numbers.contains(&(place() + 1)));
                    let plate = plate.expect("a plate");
                    let posts = f64::from(spec.frame.posts) * frame.post_diameter / 2.0;
                    let edges = 2.0 * PI * (frame.radius + plate.opening + posts) * frame.thickness;
                    near(&node.name, volume(first), frame.area(plate) * frame.thickness, edges);
                }
                "stack/post" => {
                    let (r, h) = (frame.post_diameter / 2.0, frame.post_length);
                    near(&node.name, volume(first), PI * r * r * h, 2.0 * PI * r * h);
                }
                "sheets/sheet" => {
                    let fabric = node.parts.iter().find(|part| part.material == "fabric").expect("fabric");
                    let size = |k: usize| {
                        let along = fabric.points.iter().map(|p| p[k]);
                        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
                    };
                    let sheet = &design.sheets[place()];
                    near(&node.name, size(0), sheet.width, 1.0);
                    near(&node.name, size(1), sheet.height, 1.0);
                }
                _ => {}
            }
        }
    }
}

/// The ends of a measure on the inflated fabric are as far apart as the prediction says; without the shell there is none.
#[test]
fn a_measure_lies_on_the_inflated_fabric() {
    let text = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\nair = [\"a\"]\nport = [\"p\"]\n\
                measure = [\"m\"]\n[load]\npressure = \"5 kPa\"\n[accuracy]\nmodel = \"MODEL\"\n";
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"80mm\" height=\"80mm\" viewBox=\"0 0 80 80\">\
               <g id=\"a\"><rect x=\"20\" y=\"20\" width=\"40\" height=\"40\"/></g><g id=\"p\"><path d=\"M40 16V24\"/></g>\
               <g id=\"m\"><path id=\"across\" d=\"M25 40H55\"/><circle id=\"top\" cx=\"40\" cy=\"40\" r=\"1\"/></g></svg>";
    for model in ["shell", "auto"] {
        let text = text.replace("MODEL", model);
        let reading =
            stargrip_cam::spec::read(&stargrip_cam::spec::Source::new("x", text.as_str())).expect("a spec");
        let sources = Sources { spec: &text, machine: support::generic() };
        let request = KindRequest { only: vec![Kind::Prediction], with: vec![Kind::SceneGlb] };
        let spec = reading.with_drawing(svg.as_bytes()).spec;
        let build = pipeline::build(&spec, &support::machine(), sources, &request).expect("a pouch");
        let nodes = read_glb(&bytes(&build)).expect("a GLB");
        let measure_nodes = nodes.iter().filter(|node| node.name.starts_with("measures/"));
        let names: Vec<&str> = measure_nodes.map(|node| node.name.as_str()).collect();
        let expected: &[&str] = if model == "shell" { &["measures/across", "measures/top"] } else { &[] };
        assert_eq!(names, expected);
        if names.is_empty() {
            continue;
        }
        let wire = part(&nodes, "measures/across", "measure");
        let predicted = &build.forecast.drawn.as_ref().expect("inflated").prediction.measures[0];
        let predicted = predicted.distance_mm.expect("measured");
        assert!((wire_span(&wire.points) - 30.0).abs() < 2e-3, "{}", wire_span(&wire.points));
        let inflated_distance = wire_span(&wire.inflated);
        assert!(
            (inflated_distance - predicted.finest_mesh.expect("inflated")).abs() < 2e-3,
            "{inflated_distance} {predicted:?}"
        );
        // On top of the fabric: as high as the corner of the fabric that is nearest to the middle.
        let top = part(&nodes, "measures/top", "measure").inflated.iter().map(|p| p[2]).fold(0.0, f64::max);
        let fabric = &part(&nodes, "pieces/piece", "tube").inflated;
        let highest = fabric.iter().map(|p| p[2]).fold(0.0, f64::max);
        assert!((top - highest).abs() < 1.5, "{top} {highest}");
        assert!(volume(wire) > 0.0, "its triangles face inwards");
    }
}

/// Distance of the ends of a straight wire, which has four corners around each: from the first corner to its like at the other end.
fn wire_span(points: &[[f64; 3]]) -> f64 {
    let (first, last) = (points[0], points[points.len() - 4]);
    (first[0] - last[0]).hypot(first[1] - last[1]).hypot(first[2] - last[2])
}

/// Volume inside of the triangles, mm^3, which all face outwards.
fn volume(part: &GlbPart) -> f64 {
    let sixfold = |[a, b, c]: &[usize; 3]| {
        let [a, b, c] = [part.points[*a], part.points[*b], part.points[*c]];
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    part.triangles.iter().map(sixfold).sum::<f64>() / 6.0
}
