//! `coupon` as a user runs it: programs, drawings, tables, refusals.

use crate::machines::{fails, json_of, names, read, workshop_of};
use crate::support;
use crate::support::program::{done_silently, run, stderr, stdout, workshop};
use std::fs;

#[test]
fn coupon_writes_programs_numbered_drawings_and_a_table() {
    let dir = workshop();
    let args = ["coupon", "star.toml", "--temperatures", "180 C,200 C", "--speeds", "0.5 mm/s"];
    let answer = done_silently(dir.path(), &args);
    assert_eq!(
        names(&dir.path().join("coupons")),
        [
            "burst.gcode",
            "burst.svg",
            "disc.gcode",
            "disc.svg",
            "machine.toml",
            "manifest.json",
            "results.csv",
            "spec.toml",
            "strips-180C-500um-s.gcode",
            "strips-180C-500um-s.svg",
            "strips-200C-500um-s.gcode",
            "strips-200C-500um-s.svg",
            "strips.svg",
            "v-actuator.gcode",
            "v-actuator.svg",
        ]
    );
    assert!(answer.starts_with("wrote 5 programs and 6 drawings to coupons\n"), "{answer}");
    assert!(
        answer.contains("look at coupons/strips.svg") && answer.contains("calibrate coupons/results.csv"),
        "{answer}"
    );
    let table = read(dir.path(), "coupons/results.csv");
    assert_eq!(table.lines().count(), 1 + 6);
    assert!(
        table.starts_with("strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n1,180,0.5,"),
        "{table}"
    );
    for (name, seams) in [("strips-180C-500um-s", 3), ("disc", 1), ("burst", 5)] {
        let drawing = read(dir.path(), &format!("coupons/{name}.svg"));
        let document = roxmltree::Document::parse(&drawing).expect("XML");
        let count = |id: &str| {
            let group = document.descendants().find(|node| node.attribute("id") == Some(id));
            group.expect(id).children().filter(roxmltree::Node::is_element).count()
        };
        assert_eq!(count("seal-outer"), seams, "{name}");
        assert!(count("label") >= seams, "{name}");
    }
    // The directory must always be a new one.
    let before = names(&dir.path().join("coupons"));
    let _ = fails(dir.path(), &args, 1, &["coupons exists already; choose another name"]);
    assert_eq!(names(&dir.path().join("coupons")), before);
    let answer = done_silently(dir.path(), &["coupon", "star.toml", "-o", "again", "--repeats", "1", "-v"]);
    for name in names(&dir.path().join("again")) {
        assert!(answer.contains(&format!("again/{name}")), "{name}: {answer}");
    }
    let _ = fails(dir.path(), &["coupon", "star.toml", "-o", "no/where"], 1, &["cannot create no/where"]);
}

#[test]
fn coupons_are_proven_as_builds_are() {
    let dir = workshop();
    let answer = done_silently(
        dir.path(),
        &["coupon", "star.toml", "--only", "disc,strips", "--speeds", "0.5 mm/s", "--json"],
    );
    let json = json_of(&answer);
    assert_eq!(json["programs"], serde_json::json!(["strips-200C-500um-s.gcode", "disc.gcode"]));
    assert_eq!(json["times"][1]["program"], "disc.gcode");
    assert!(json["times"][1]["time_s"].as_f64().is_some_and(|time| time > 3600.0), "{json}");
    let found = names(&dir.path().join("coupons"));
    assert!(!found.iter().any(|name| name.starts_with("burst") || name.starts_with("v-")), "{found:?}");
    let manifest = json_of(&read(dir.path(), "coupons/manifest.json"));
    assert_eq!(manifest["pieces"][1]["name"], "disc");
    assert_eq!(manifest["pieces"][1]["seams"][0]["name"], "disc");
    let verify = |code: i32| {
        let output = run(dir.path(), &["verify", "coupons"]);
        assert_eq!(output.status.code(), Some(code), "{}\n{}", stdout(&output), stderr(&output));
        stdout(&output)
    };
    assert!(verify(0).contains("proven, no findings"));
    // The user may edit the table.
    let table = dir.path().join("coupons/results.csv");
    fs::write(&table, fs::read_to_string(&table).expect("it").replace(",,", ",82,")).expect("written");
    let _ = verify(0);
    // A change of a program is found at its line, and one of a drawing or of the profile's lines in its file.
    for (name, from, to, word) in [
        ("disc.gcode", " F6\n", " F600\n", "wrong-feed"),
        ("disc.gcode", "; set the iron to 200 C", "; set the iron to 400 C", "other-comment"),
        (
            "strips-200C-500um-s.gcode",
            "; seam: seam=2 piece=strip-2",
            "; seam: seam=2 piece=strip-3",
            "other-comment",
        ),
        ("disc.svg", "<path", "<path ", "differs"),
        ("machine.toml", "\"M2\"", "\"M30\"", "differs"),
        ("manifest.json", "\"time_s\": ", "\"time_s\": 1", "differs"),
    ] {
        let path = dir.path().join("coupons").join(name);
        let good = fs::read_to_string(&path).expect("it");
        assert!(good.contains(from), "{name}: {from}");
        fs::write(&path, good.replacen(from, to, 1)).expect("written");
        let answer = verify(1);
        assert!(answer.contains(name) && answer.contains(word), "{name}: {answer}");
        fs::write(&path, good).expect("written");
    }
    let _ = verify(0);
    fs::remove_file(dir.path().join("coupons/disc.svg")).expect("removed");
    assert!(verify(1).contains("missing-file"));
    let _ = fails(
        dir.path(),
        &["coupon", "star.toml", "--only", "discs"],
        2,
        &["strips, disc, v-actuator, burst"],
    );
}

#[test]
fn a_hose_that_fits_no_coupon_is_refused() {
    let dir = workshop();
    let spec = format!("{}\n[inlet]\ntube_diameter = \"25 mm\"\n", support::PAPER);
    fs::write(dir.path().join("star.toml"), spec).expect("written");
    let _ = fails(
        dir.path(),
        &["coupon", "star.toml", "--only", "v-actuator"],
        1,
        &["inlet-meets-arm", "no room on the V-actuator", "tube_diameter", "other coupons only"],
    );
    assert_eq!(names(dir.path()), ["star.toml"]);
}

#[test]
fn coupon_refuses_bad_settings_and_writes_nothing() {
    let dir = workshop();
    for (args, code, words) in [
        (["--temperatures", "300 C"], 2, "the temperature must be more than 40 C and less than 300 C"),
        (["--temperatures", "nan C"], 2, "write the temperature as a number and one of C"),
        (["--temperatures", "200"], 2, "write the temperature as a number and one of C"),
        (
            ["--temperatures", "180 C,180 C"],
            1,
            "cannot be told apart; temperatures must differ by at least 1 C",
        ),
        (["--temperatures", "180.1 C,180.3 C"], 1, "--repeats"),
        (["--speeds", "0 mm/s"], 2, "must be at least 0.001 mm/s and at most 1000 mm/s"),
        (["--speeds", "0.1 mm/s,0.1001 mm/s"], 1, "at least 0.001 mm/s"),
        (["--heights", "0.5 mm"], 2, "must be at least -20 mm and at most 0 mm"),
        (["--heights", "-21 mm"], 2, "must be at least -20 mm"),
        (["--repeats", "0"], 2, "1..=20"),
        (["--repeats", "21"], 2, "1..=20"),
    ] {
        let _ = fails(dir.path(), &[&["coupon", "star.toml"][..], &args].concat(), code, &[words]);
    }
    // Without options the grid is the spec's: strips that `calibrate` would refuse are not sealed.
    let cold = read(dir.path(), "star.toml") + "\n[seal]\ntemperature = \"30 C\"\n";
    fs::write(dir.path().join("cold.toml"), cold).expect("written");
    let words = ["a temperature of 30 C; it must be more than 40 C and less than 300 C"];
    let _ = fails(dir.path(), &["coupon", "cold.toml"], 1, &words);
    fs::remove_file(dir.path().join("cold.toml")).expect("removed");
    // A disc is sealed once.
    let disc = ["coupon", "star.toml", "--only", "disc", "--repeats", "5"];
    let _ = fails(dir.path(), &disc, 2, &["--repeats is for strips"]);
    assert_eq!(names(dir.path()), ["star.toml"]);
}

/// A drawing has no tips: the other kinds are made, and the set is never empty.
#[test]
fn coupons_of_a_drawing_have_no_v_actuator() {
    let dir = workshop();
    let _ = done_silently(dir.path(), &["coupon", "star.toml", "-o", "stars", "--only", "v-actuator", "-q"]);
    let cushion = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90mm\" height=\"90mm\" viewBox=\"0 0 90 90\">\
                   <g id=\"air\"><path d=\"M 20 20 H 70 V 70 H 20 Z\"/></g><g id=\"port\"><path d=\"M 16 45 H 24\"/></g></svg>";
    fs::write(dir.path().join("d.svg"), cushion).expect("written");
    let _ = done_silently(dir.path(), &["new", "d", "--drawing", "d.svg"]);
    for only in ["v-actuator", "disc,v-actuator"] {
        let _ =
            fails(dir.path(), &["coupon", "d.toml", "--only", only], 1, &["leave v-actuator out of --only"]);
    }
    assert!(!dir.path().join("coupons").exists());
    let _ = done_silently(dir.path(), &["coupon", "d.toml", "--only", "disc", "-q"]);
}

#[test]
fn coupons_do_not_press_a_rigid_tip_into_the_bed() {
    let dir = workshop_of(300, 300);
    let profile = read(dir.path(), "mine.toml")
        .replacen("spring_loaded = true", "spring_loaded = false", 1)
        .replacen("contact = \"-0.3 mm\"", "contact = \"0 mm\"", 1);
    fs::write(dir.path().join("mine.toml"), profile).expect("written");
    let strips = ["coupon", "star.toml", "--only", "strips", "--heights"];
    let low = [&strips[..], &["-0.5 mm"]].concat();
    let words = [
        "a height of -0.5 mm; it must be 0 mm for the profile's tip without a spring",
        "`spring_loaded = true`",
    ];
    let _ = fails(dir.path(), &low, 1, &words);
    let answer = done_silently(dir.path(), &["coupon", "star.toml", "--only", "disc"]);
    assert!(answer.contains("wrote 1 program and 1 drawing to coupons"), "{answer}");
}

#[test]
fn coupons_stay_within_the_work_area() {
    // A bed of 220 mm takes four strips in a row, and all the pouches.
    let small = workshop_of(220, 220);
    let _ = done_silently(small.path(), &["coupon", "star.toml", "--repeats", "2"]);
    for name in names(&small.path().join("coupons")).iter().filter(|name| name.contains(".gcode")) {
        for word in read(small.path(), &format!("coupons/{name}"))
            .lines()
            .filter(|line| line.starts_with('G'))
            .flat_map(str::split_whitespace)
        {
            if word.starts_with(['X', 'Y']) {
                let at: f64 = word[1..].parse().expect("a number");
                assert!((0.0..=220.0).contains(&at), "{name}: {word}");
            }
        }
    }
    let words = [
        "the coupon strips-200C-",
        "the machine reaches 0 to 220.0 mm, 0 to 220.0 mm",
        "repeats",
        "[work_area]",
    ];
    let _ = fails(small.path(), &["coupon", "star.toml", "-o", "more", "--repeats", "10"], 1, &words);
    assert!(!small.path().join("more").exists());
    let tiny = workshop_of(100, 100);
    let _ = fails(
        tiny.path(),
        &["coupon", "star.toml", "--speeds", "1 mm/s", "--repeats", "1"],
        1,
        &["coupon disc needs X"],
    );
    assert!(!tiny.path().join("coupons").exists());
}
