//! The scene: what it shows is the design, and a scene that is wrong is found.

mod support;

use std::borrow::Cow;
use std::f64::consts::PI;

use serde_json::Value;
use stargrip_cam::artifact::{Asked, Kind};
use stargrip_cam::design::round_tube;
use stargrip_cam::forecast::charts::charts;
use stargrip_cam::forecast::pose::{self, Pose};
use stargrip_cam::manifest::{MANIFEST, Manifest, sha256};
use stargrip_cam::pipeline::{self, Built, Forecast, Sources, read_back};
use stargrip_cam::verify::{GlbNode, GlbPart, OutputFiles, read_glb};

const SCENE: &str = "scene.glb";
const GRIPPER: &str = include_str!("../designs/paper-gripper.toml");

fn built(text: &str) -> Built {
    let sources = Sources { spec: text, machine: support::generic() };
    let asked = Asked { only: vec![Kind::Prediction], with: vec![Kind::SceneGlb] };
    pipeline::build(&support::read(text), &support::machine(), sources, &asked).expect("a gripper")
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
    for design in std::fs::read_dir("designs").expect("designs") {
        let text = std::fs::read_to_string(design.expect("a design").path()).expect("text");
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
        // Around each of the columns of corners the fabric is as long as before, less what chords cut off.
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
    let round = format!("{}\n[load]\npressure = \"37 kPa\"\n", include_str!("../designs/round-hinges.toml"));
    for text in [alone.as_str(), GRIPPER, &round] {
        let made = built(text);
        let Forecast { spec, design, prediction, .. } = &made.forecast;
        let prediction = prediction.as_ref().expect("a load");
        let stars = pose::inflated(spec, design, Some(prediction));
        let nodes = read_glb(&bytes(&made)).expect("a GLB");
        let chart = &charts(spec, design)[0];
        let row =
            chart.by_pressure.iter().find(|row| (row.pressure_kPa - 37.0).abs() < 1e-9).expect("its own");
        let drawn = Pose::of(&stars[0]);
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
        assert!((stars[0].rho_0 - touches).abs() < 1e-6, "{} {touches}", stars[0].rho_0);
        // Wider than a cylinder, as hinges are.
        let star = &design.distinct[0].star;
        assert!(stars[0].w > 1.02 * round_tube(star.w) && stars[0].w < star.w);
        let tube = part(&nodes, "stack/star 1", "tube");
        let columns: Vec<&[[f64; 3]]> = tube.inflated.chunks(16).collect();
        // Of each half of a sector eleven columns are a corner's, eleven a tip's; of each the first point lies at the hole, the ninth outside.
        let (corner, tip) = (columns[5], columns[16]);
        assert!((radius(&corner[0]) - stars[0].rho_0).abs() < 2e-3);
        assert!((radius(&tip[0]) - stars[0].d_t - stars[0].r_i).abs() < 2e-3);
        for column in [corner, tip] {
            assert!(
                (apart(&column[0], &column[8]) - stars[0].w).abs() < 2e-3,
                "{}",
                apart(&column[0], &column[8])
            );
        }
        let centre = {
            let scale = stars[0].d_t / radius(&tip[0]).max(1e-9);
            [tip[0][0] * scale, tip[0][1] * scale, tip[0][2]]
        };
        for column in &columns[11..22] {
            assert!((apart(&column[0], &centre) - stars[0].r_i).abs() < 2e-3);
        }
    }
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
        let middle = made.forecast.design.stack.height / 2.0;
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

/// Viewers built on three.js find what an animation moves by the name of its mesh.
#[test]
fn every_star_has_a_mesh_of_its_own_by_a_name_of_its_own() {
    let made = built(GRIPPER);
    let nodes = read_glb(&bytes(&made)).expect("a GLB");
    let meshes: Vec<&str> =
        nodes.iter().filter(|node| node.animated).map(|node| node.mesh.as_str()).collect();
    assert_eq!(meshes, ["fabric of star 1", "fabric of star 2", "fabric of star 3"]);
    // Their numbers are shared.
    let mut surfaces = Vec::new();
    let _ = with_document(&bytes(&made), |d| {
        let all = d["meshes"].as_array().expect("meshes").iter();
        let fabrics = all.filter(|mesh| meshes.iter().any(|name| mesh["name"] == **name));
        surfaces = fabrics.map(|mesh| mesh["primitives"].clone()).collect();
    });
    assert!(surfaces.len() == 3 && surfaces.windows(2).all(|pair| pair[0] == pair[1]), "{surfaces:?}");
    assert_found(
        &forged(|bytes| {
            with_document(&bytes, |d| {
                let (first, second) = (node(d, "star 1"), node(d, "star 2"));
                d["nodes"][second]["mesh"] = d["nodes"][first]["mesh"].clone();
            })
        }),
        "bad-glb stack/star 1, whose mesh",
    );
    assert_found(
        &forged(|bytes| {
            with_document(&bytes, |d| {
                let mesh = index(&d["nodes"][node(d, "star 1")]["mesh"]);
                d["meshes"][mesh]["name"] = "star 2".into();
            })
        }),
        "bad-glb stack/star 1, whose mesh",
    );
}

/// The arms are the longest straight sides of the tube's inner rim: rigid, whatever the star does.
#[test]
fn arms_keep_their_length() {
    for text in [GRIPPER, include_str!("../designs/round-hinges.toml")] {
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

/// Nothing of the fabric runs through the axis or beyond the flat star, and tips and corners stay on their rays.
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

/// The findings after a change of the scene, the manifest agreeing with it.
fn forged(change: impl Fn(Vec<u8>) -> Vec<u8>) -> Vec<String> {
    let made = built(GRIPPER);
    let own = |(name, bytes): (&str, Cow<'_, [u8]>)| (name.to_owned().into(), bytes.into_owned().into());
    let mut files = OutputFiles { files: made.files().map(own).collect() };
    let wrong = change(bytes(&made));
    assert!(wrong != bytes(&made), "the corruption changes nothing");
    let mut manifest: Manifest = serde_json::from_slice(files.get(MANIFEST).expect("one")).expect("JSON");
    for entry in manifest.files.iter_mut().filter(|entry| entry.path == SCENE) {
        (entry.bytes, entry.sha256) = (wrong.len(), sha256(&wrong));
    }
    for (name, content) in &mut files.files {
        match name.as_ref() {
            SCENE => *content = wrong.clone().into(),
            MANIFEST => *content = manifest.to_json().into(),
            _ => {}
        }
    }
    let findings = read_back(&files).findings;
    findings.iter().map(|finding| format!("{} {} {}", finding.file, finding.code, finding.found)).collect()
}

/// The file with another document of the same length, or a longer one.
fn with_document(bytes: &[u8], mut change: impl FnMut(&mut Value)) -> Vec<u8> {
    let length = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four")) as usize;
    let end = 20 + length(12);
    let mut document: Value = serde_json::from_slice(&bytes[20..end]).expect("JSON");
    change(&mut document);
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let word = |n: usize| u32::try_from(n).expect("small").to_le_bytes();
    let whole = 20 + text.len() + bytes.len() - end;
    [&bytes[..8], &word(whole), &word(text.len()), b"JSON", &text, &bytes[end..]].concat()
}

fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().expect("a number")).expect("a small one")
}

#[track_caller]
fn assert_found(findings: &[String], said: &str) {
    let found = findings.iter().any(|finding| finding.starts_with(&format!("{SCENE} {said}")));
    assert!(found, "no {said} in {findings:#?}");
}

#[test]
fn a_file_that_is_no_glb_is_found() {
    assert_found(&forged(|bytes| bytes[..bytes.len() - 4].to_vec()), "bad-glb no header");
    assert_found(
        &forged(|bytes| with_document(&bytes, |d| d["asset"]["version"] = "1.0".into())),
        "bad-glb another version",
    );
    // A number that leaves the box that its accessor says, one that is none, and a corner that is not there.
    let first = |word: [u8; 4]| {
        move |mut bytes: Vec<u8>| {
            let mut offset = 0;
            let _ = with_document(&bytes, |d| {
                let primitive = &d["meshes"][0]["primitives"][0];
                let accessor = &d["accessors"][index(&primitive["attributes"]["POSITION"])];
                offset = index(&d["bufferViews"][index(&accessor["bufferView"])]["byteOffset"]);
            });
            let at = 28
                + index(&Value::from(u32::from_le_bytes(bytes[12..16].try_into().expect("four"))))
                + offset;
            bytes[at..at + 4].copy_from_slice(&word);
            bytes
        }
    };
    assert_found(&forged(first(9.0_f32.to_le_bytes())), "bad-glb stack/plate 1: numbers");
    assert_found(&forged(first(f32::NAN.to_le_bytes())), "bad-glb stack/plate 1: numbers");
    let count = |bytes: Vec<u8>| with_document(&bytes, |d| d["accessors"][0]["count"] = 1e9.into());
    assert_found(&forged(count), "bad-glb");
}

/// The place of the node of this name.
fn node(document: &Value, name: &str) -> usize {
    document["nodes"].as_array().expect("nodes").iter().position(|node| node["name"] == name).expect("one")
}

#[test]
fn a_scene_of_something_else_is_found() {
    let changed = |change: fn(&mut Value)| forged(|bytes| with_document(&bytes, change));
    assert_found(
        &changed(|d| {
            let at = node(d, "star 2");
            d["nodes"][at]["translation"] = serde_json::json!([0.0, 0.0, 0.1]);
        }),
        "deviation stack/star 2",
    );
    assert_found(&changed(|d| d["nodes"][0]["name"] = "plate 9".into()), "bad-glb stack/plate 9");
    assert_found(
        &changed(|d| d["animations"] = serde_json::json!([])),
        "bad-glb stack/star 1, which inflates",
    );
    assert_found(
        &changed(|d| {
            for mesh in d["meshes"].as_array_mut().expect("meshes") {
                for primitive in mesh["primitives"].as_array_mut().expect("primitives") {
                    let _ = primitive.as_object_mut().expect("one").remove("targets");
                }
            }
        }),
        "bad-glb stack/star 1, which does not inflate",
    );
    // The mesh of a plate in place of a sheet's.
    assert_found(
        &changed(|d| {
            let at = node(d, "mask 1");
            d["nodes"][at]["mesh"] = 0.into();
        }),
        "bad-glb masks/mask 1 without mask",
    );
}
