//! Faults, warnings and notes of drawings at the terminal.

use crate::drawings::{NOTCH, folder, json};
use crate::support::program::{run, stderr, stdout};
use serde_json::Value;
use std::fs;

#[test]
fn a_drawing_without_figures_is_refused() {
    for (drawing, words) in [
        (
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9mm\" height=\"9mm\" viewBox=\"0 0 9 9\"/>",
            "no edge of air",
        ),
        ("", "d.svg: the file is empty; export the drawing again"),
    ] {
        let folder = folder(drawing);
        let output = run(folder.path(), &["new", "a", "--drawing", "d.svg"]);
        assert_eq!(output.status.code(), Some(1));
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
        assert!(!folder.path().join("a.toml").exists());
    }
    let folder = folder("");
    let output = run(folder.path(), &["new", "a", "--drawing", "e.svg"]);
    assert!(
        stderr(&output).contains("check its name") && !stderr(&output).contains("os error"),
        "{}",
        stderr(&output)
    );
}

/// Refusals of the spec of a drawing with these layers.
fn refused(layers: &str) -> Vec<Value> {
    let folder = folder(&format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"220mm\" height=\"100mm\" viewBox=\"0 0 220 100\">{layers}</svg>"
    ));
    let _ = run(folder.path(), &["new", "a", "--drawing", "d.svg"]);
    json(folder.path(), &["check", "a.toml", "--json"])["refused"].as_array().expect("refusals").clone()
}

/// The flaps of the two would lie on each other where they are drawn: each is a piece, and is cut by itself.
#[test]
fn separate_shapes_are_pieces() {
    let folder = folder(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"220mm\" height=\"100mm\" viewBox=\"0 0 220 100\">\
         <g id=\"air\"><rect x=\"20\" y=\"20\" width=\"120\" height=\"60\"/><rect x=\"145\" y=\"20\" width=\"40\" height=\"60\"/></g>\
         <g id=\"port\"><path d=\"M15 50H25M180 50H190\"/></g></svg>",
    );
    let dir = folder.path();
    let _ = run(dir, &["new", "a", "--drawing", "d.svg"]);
    let spec = fs::read_to_string(dir.join("a.toml")).expect("a spec");
    fs::write(
        dir.join("a.toml"),
        spec.replacen("# copies = 1", "copies = 2", 1) + "\n[mask]\nkind = \"separator\"\n",
    )
    .expect("written");
    let output = run(dir, &["check", "a.toml"]);
    let screen = stdout(&output);
    for piece in ["pieces 1, 3: 140 x 80 mm, 1 chamber, 1 port", "pieces 2, 4: 60 x 80 mm, 1 chamber, 1 port"]
    {
        assert!(screen.contains(piece), "{screen}{}", stderr(&output));
    }
    assert!(run(dir, &["build", "a.toml"]).status.success());
    assert!(run(dir, &["verify", "out/a"]).status.success());
    for file in ["piece-1-mask.svg", "piece-2-mask.svg", "piece-4-seal.gcode"] {
        assert!(dir.join("out/a").join(file).exists(), "{file}");
    }
}

#[test]
fn elements_of_one_line_are_told_apart_and_open_curves_have_no_areas() {
    let found = refused(
        "<g id=\"seam\"><line x1=\"20\" y1=\"20\" x2=\"80\" y2=\"80\"/><rect x=\"40\" y=\"40\" width=\"20\" height=\"20\"/></g>",
    );
    let cross = found.iter().find(|one| one["code"] == "curves-cross").expect("they do");
    let elements = cross["elements"].as_array().expect("both");
    assert!(elements.len() == 2 && elements[0] != elements[1], "{cross}");
    assert!(!cross["allowed"].as_str().expect("one").contains("unite"), "{cross}");
}

#[test]
fn warnings_are_in_json_and_in_the_picture() {
    let folder = folder(NOTCH);
    let dir = folder.path();
    let _ = run(dir, &["new", "a", "--drawing", "d.svg", "--units", "mm"]);
    let found = json(dir, &["check", "a.toml", "--json"]);
    let warnings = found["warnings"].as_array().expect("a list");
    let sharp: Vec<&Value> = warnings.iter().filter(|warning| warning["code"] == "sharp-corner").collect();
    assert_eq!(sharp.len(), 1, "{found}");
    assert!(
        sharp[0]["found"].as_str().is_some_and(|text| text.contains("and 1 more within 10 mm")),
        "{found}"
    );
    assert!(
        sharp[0]["elements"][0] == "n"
            && sharp[0]["at_mm"][1].as_f64().is_some_and(|y| (y - 35.0).abs() < 2.0),
        "{found}"
    );
    for input in ["d.svg", "a.toml"] {
        let before = fs::read(dir.join(input)).expect("an input");
        let output = run(dir, &["check", "a.toml", "--picture", input]);
        assert_eq!(output.status.code(), Some(1));
        assert!(
            stderr(&output).contains("is not a picture of a check: name another file"),
            "{}",
            stderr(&output)
        );
        assert_eq!(fs::read(dir.join(input)).expect("an input"), before);
    }
    fs::write(dir.join("p.svg"), "").expect("written");
    let _ = run(dir, &["check", "a.toml", "--picture", "p.svg"]);
    let output = run(dir, &["check", "a.toml", "--picture", "p.svg"]);
    let number = warnings.len();
    let picture = fs::read_to_string(dir.join("p.svg")).expect("a picture");
    assert!(picture.contains("sharper than the iron"), "{picture}");
    let noun = if number == 1 { "finding" } else { "findings" };
    assert!(
        stderr(&output).contains(&format!("note: p.svg shows the drawing and {number} {noun}")),
        "{}",
        stderr(&output)
    );
    // Without findings the picture is the drawing.
    let round = NOTCH.replace("H 90 V 65 H 82 V 95 H 5 Z", "H 5 Z");
    fs::write(dir.join("d.svg"), round).expect("written");
    let output = run(dir, &["check", "a.toml", "--picture", "p.svg"]);
    assert!(stderr(&output).contains("shows the drawing without findings"), "{}", stderr(&output));
    assert!(fs::read_to_string(dir.join("p.svg")).expect("a picture").contains("nothing found"));
    assert_eq!(json(dir, &["check", "a.toml", "--json"])["warnings"], serde_json::json!([]));
}

/// A port that is refused is not missing as well.
#[test]
fn a_port_without_room_is_one_error() {
    let files = folder(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"140mm\" viewBox=\"0 0 200 140\"><g id=\"air\">\
         <path id=\"o\" d=\"M 20 68 V 20 H 180 V 120 H 20 V 72 H 0 V 68 Z\"/></g>\
         <g id=\"port\"><path id=\"h\" d=\"M -2 70 H 2\"/></g></svg>",
    );
    let dir = files.path();
    let _ = run(dir, &["new", "a", "--drawing", "d.svg"]);
    let refused = json(dir, &["check", "a.toml", "--json"]);
    assert_eq!(refused["refused"].as_array().map(Vec::len), Some(1), "{refused}");
    assert_eq!(refused["refused"][0]["code"], "port-too-wide", "{refused}");
    // A port of a second piece that lies off its edge.
    let two = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"400mm\" height=\"140mm\" viewBox=\"0 0 400 140\"><g id=\"air\">\
         <path id=\"o\" d=\"M 20 20 H 180 V 120 H 20 Z M 220 20 H 320 V 120 H 220 Z\"/></g>\
         <g id=\"port\"><path id=\"h\" d=\"M 18 70 H 22\"/><path id=\"k\" d=\"M 360 70 H 364\"/></g></svg>";
    fs::write(dir.join("d.svg"), two).expect("written");
    let refused = json(dir, &["check", "a.toml", "--json"]);
    assert_eq!(refused["refused"].as_array().map(Vec::len), Some(1), "{refused}");
    assert_eq!(refused["refused"][0]["code"], "port-off-edge", "{refused}");
}

#[test]
fn a_refusal_has_the_notes_and_a_short_list() {
    let circle = |i: i32| format!("<circle id=\"c{i}\" cx=\"{}\" cy=\"40\" r=\"12\"/>", 20 + 40 * i);
    let circles = (0..9).map(circle).collect::<Vec<_>>().concat();
    let all = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"400mm\" height=\"80mm\" viewBox=\"0 0 400 80\"><g id=\"air\">{circles}</g>\
         <g id=\"cut\"><rect x=\"1\" y=\"1\" width=\"398\" height=\"78\"/></g><path id=\"hidden\" d=\"M 0 0 H 9\" display=\"none\"/></svg>"
    );
    let folder = folder(&all);
    let dir = folder.path();
    let _ = run(dir, &["new", "a", "--drawing", "d.svg"]);
    let output = run(dir, &["check", "a.toml"]);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(said.matches("error[chamber-without-port]").count(), 3, "{said}");
    assert!(said.contains("a.toml: 9 errors; not shown: 6 more chamber-without-port"), "{said}");
    assert!(
        said.contains("drawing: hidden (line 1): It is hidden (display: none), and is left out."),
        "{said}"
    );
    let refused = json(dir, &["check", "a.toml", "--json"]);
    assert_eq!(refused["refused"].as_array().map(Vec::len), Some(9), "{refused}");
    assert_eq!(refused["refused"][0]["elements"], serde_json::json!(["c0"]));
}

#[test]
fn a_damaged_drawing_is_told_without_infinities() {
    let folder = folder(NOTCH);
    let dir = folder.path();
    let _ = run(dir, &["new", "a", "--drawing", "d.svg", "--units", "mm"]);
    assert_eq!(run(dir, &["build", "a.toml", "-q", "-o", "o"]).status.code(), Some(0));
    let file = dir.join("o/sheet-1-seal.svg");
    let text = fs::read_to_string(&file).expect("a drawing");
    fs::write(&file, text + "edited\n").expect("written");
    let said = stdout(&run(dir, &["verify", "o"]));
    assert!(said.contains("sheet-1-seal.svg"), "{said}");
    for word in [" inf ", "-0.000", "formats-disagree"] {
        assert!(!said.contains(word), "{word}: {said}");
    }
}

/// Text at the root of a file lies on no layer: it has a name of its own, which can be ignored. The finding is printed once.
#[test]
fn lost_text_is_ignored_by_its_layer_or_its_name() {
    let text = "<text x=\"20\" y=\"20\">a</text></svg>";
    let folder = folder(&NOTCH.replacen("</svg>", text, 1));
    let dir = folder.path();
    let layers =
        "[drawing]\nfile = \"d.svg\"\nunits = \"mm\"\n[drawing.layers]\nair = [\"air\"]\nport = [\"port\"]\n";
    let spec =
        |more: &str| format!("schema = 1\nname = \"a\"\n{layers}{more}[inlet]\ntube_diameter = \"4 mm\"\n");
    fs::write(dir.join("a.toml"), spec("")).expect("written");
    let said = stderr(&run(dir, &["check", "a.toml"]));
    let name = said.split_once("name \"").and_then(|(_, rest)| rest.split('"').next()).expect("a name");
    assert!(said.contains("lost-geometry") && name.starts_with("text at line 1, column "), "{said}");
    assert_eq!(said.matches("is not read, and its layer has no curves").count(), 1, "{said}");
    // On a layer of edges it is left out.
    let beside = NOTCH.replacen("</g>", &text.replacen("</svg>", "</g>", 1), 1);
    fs::write(dir.join("d.svg"), beside).expect("written");
    let output = run(dir, &["check", "a.toml"]);
    assert!(output.status.success() && stdout(&output).contains("Text is not read"), "{}", stderr(&output));
    fs::write(dir.join("d.svg"), NOTCH.replacen("</svg>", text, 1)).expect("written");
    fs::write(dir.join("a.toml"), spec(&format!("ignore = [\"{name}\"]\n"))).expect("written");
    assert!(!stderr(&run(dir, &["check", "a.toml"])).contains("lost-geometry"));
    let grouped =
        NOTCH.replacen("</svg>", &format!("<g id=\"words\">{}", text.replacen("</svg>", "</g></svg>", 1)), 1);
    fs::write(dir.join("d.svg"), grouped).expect("written");
    fs::write(dir.join("a.toml"), spec("ignore = [\"words\"]\n")).expect("written");
    assert!(!stderr(&run(dir, &["check", "a.toml"])).contains("lost-geometry"));
}
