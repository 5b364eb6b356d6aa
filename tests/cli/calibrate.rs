//! `calibrate` as a user runs it: settings of a seal and constants of a fabric from tables of bench tests.

use crate::machines::{fails, json_of};
use crate::support;
use crate::support::program::{done_silently, run, stderr, stdout};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const HEAD: &str = "strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n";

/// A table in which each setting (speed) has these peel forces.
pub(super) fn table(settings: &[(f64, &[f64])]) -> String {
    let rows = settings.iter().flat_map(|(speed, peels)| peels.iter().map(move |peel| (speed, peel)));
    let rows = rows.zip(1..).map(|((speed, peel), i)| format!("{i},200,{speed},-0.3,{peel},\n"));
    HEAD.to_owned() + &rows.collect::<String>()
}

fn calibration(text: &str) -> TempDir {
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("results.csv"), text).expect("written");
    dir
}

#[test]
fn calibrate_chooses_the_fastest_that_holds() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0]), (0.5, &[50.0, 51.0, 49.0])]));
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    for words in
        ["[fabric]\nseal_strength = \"1.920 N/mm\"", "speed = \"0.5 mm/s\"", "temperature = \"200 C\""]
    {
        assert!(answer.contains(words), "{words}: {answer}");
    }
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1.8 N/mm"]);
    assert!(answer.contains("speed = \"0.1 mm/s\""), "{answer}");
    let answer =
        done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1.8 N/mm", "--margin", "1"]);
    assert!(answer.contains("speed = \"0.5 mm/s\""), "{answer}");
    // A table as spreadsheets save it.
    let dir = calibration(&format!("\u{feff}{}", table(&[(0.1, &[74.0, 75.0, 76.0])]).replace('\n', "\r\n")));
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    assert!(answer.contains("speed = \"0.1 mm/s\""), "{answer}");
}

/// Without a required strength even the weakest seal would pass, so nothing is chosen without one.
#[test]
fn calibrate_takes_the_need_from_the_spec_or_asks() {
    let dir = calibration(&table(&[(0.1, &[149.0, 150.0, 151.0]), (0.5, &[50.0, 51.0, 49.0])]));
    let asked = run(dir.path(), &["calibrate", "results.csv"]);
    assert_eq!(asked.status.code(), Some(1));
    let answer = stdout(&asked);
    let holds: Vec<_> = answer.lines().filter_map(|line| line.split_whitespace().last()).collect();
    assert_eq!(holds, ["holds/(N/mm)", "1.920", "5.920"], "{answer}");
    assert!(answer.lines().all(|line| line.starts_with("# ")), "{answer}");
    assert!(stderr(&asked).contains("give the required strength by --needed FORCE, or by --spec SPEC"));
    // At 30 kPa the corners of the paper's star pull with k p W = 3.8 * 0.03 * 30 = 3.4 N/mm; 1 kPa is held by every seal.
    for (pressure, speed) in [("30 kPa", "0.1 mm/s"), ("1 kPa", "0.5 mm/s")] {
        let spec = format!("{}[load]\npressure = \"{pressure}\"\n", support::PAPER);
        fs::write(dir.path().join("star.toml"), spec).expect("written");
        let answer = done_silently(
            dir.path(),
            &["calibrate", "results.csv", "--spec", "star.toml", "--margin", "1.2"],
        );
        assert!(answer.contains(&format!("speed = \"{speed}\"")), "{answer}");
        assert!(answer.starts_with(&format!("# at {pressure} the seal has to hold ")), "{answer}");
    }
    fs::write(dir.path().join("star.toml"), support::PAPER).expect("written");
    let args = ["calibrate", "results.csv", "--spec", "star.toml"];
    let _ = fails(dir.path(), &args, 1, &["star.toml: [load] has no pressure; write one, or give --needed"]);
    let both = [&args[..], &["--needed", "1 N/mm"]].concat();
    let _ = fails(dir.path(), &both, 2, &["cannot be used with"]);
}

/// The pull of sharp hinges has no printed range. The strength that is chosen holds for sure, and one that may not is not chosen.
#[test]
fn calibrate_covers_the_pull_of_sharp_hinges() {
    let spec = format!(
        "{}[fabric]\nthickness = \"0.6 mm\"\n[load]\npressure = \"15 kPa\"\nobject_diameter = \"120 mm\"\n",
        support::PAPER.replace("50 mm", "120 mm").replace("30 mm", "60 mm")
    );
    let holds = |newtons: f64| {
        let peels = [newtons - 1.0, newtons, newtons + 1.0];
        let dir = calibration(&table(&[(0.1, &peels)]));
        fs::write(dir.path().join("star.toml"), &spec).expect("written");
        let found = run(dir.path(), &["calibrate", "results.csv", "--spec", "star.toml"]);
        let answer = if found.status.success() { stdout(&found) } else { stderr(&found) };
        let strength = answer.lines().find(|line| line.starts_with("seal_strength")).map(ToOwned::to_owned);
        let Some(strength) = strength else {
            assert!(
                answer.contains("the strongest setting holds") && answer.contains("a larger tip_radius"),
                "{answer}"
            );
            return None;
        };
        let strong = spec.replace("[load]", &format!("{strength}\n[load]"));
        fs::write(dir.path().join("strong.toml"), strong).expect("written");
        let args = ["check", "strong.toml", "--json"];
        assert_eq!(json_of(&done_silently(dir.path(), &args))["verdict"]["holds"], true, "{answer}");
        assert!(answer.contains("so the margin is "), "{answer}");
        Some(strength)
    };
    // 14.4 N/mm are 1.5 times the predicted pull.
    assert_eq!(holds(361.0), None);
    let [mut weak, mut strong] = [361.0, 1500.0];
    assert!(holds(strong).is_some());
    for _ in 0..6 {
        let middle = f64::midpoint(weak, strong);
        if holds(middle).is_some() { strong = middle } else { weak = middle }
    }
}

/// The pull of a drawing is that of its shell. The command that `coupon` prints works as soon as the table is filled in.
#[test]
fn calibrate_takes_the_need_of_a_drawing_from_its_shell() {
    let dir = tempfile::tempdir().expect("a directory");
    let designs = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs/drawings");
    let spec = fs::read_to_string(designs.join("pillow.toml")).expect("a spec");
    let _ = fs::copy(designs.join("pillow.dxf"), dir.path().join("pillow.dxf")).expect("a drawing");
    let load = "\n[load]\npressure = \"10 kPa\"\n";
    for (name, more, asked) in [("soft.toml", "", true), ("hard.toml", load, false)] {
        fs::write(dir.path().join(name), format!("{spec}{more}")).expect("written");
        let answer = done_silently(dir.path(), &["coupon", name, "-o", "c", "--only", "strips"]);
        assert_eq!(answer.contains(&format!("write `pressure` into [load] of {name}")), asked, "{answer}");
        let command =
            answer.lines().find_map(|line| line.split_once("then: stargrip-cam ")).expect("a command").1;
        let filled = table(&[(0.1, &[149.0, 150.0, 151.0]), (0.5, &[5.0, 5.1, 4.9])]);
        fs::write(dir.path().join("c/results.csv"), filled).expect("written");
        fs::write(dir.path().join(name), format!("{spec}{load}")).expect("written");
        let args: Vec<&str> = command.split(' ').chain(["--json"]).collect();
        let found = json_of(&done_silently(dir.path(), &args));
        let predicted = json_of(&done_silently(dir.path(), &["predict", name, "--json"]));
        // Its wrinkles are too fine to resolve: folds may pull as hard as the upper end of the range.
        let pull = &predicted["chambers"][0]["ranges"]["seal_pull_N_per_mm"][1];
        assert_eq!(&found["needed_N_mm"], pull);
        assert!(pull.as_f64().is_some_and(|pull| pull > 0.1), "{pull}");
        assert_eq!(found["chosen"]["speed_mm_s"], 0.1);
        fs::remove_dir_all(dir.path().join("c")).expect("removed");
    }
}

#[test]
fn calibrate_reads_many_settings() {
    let settings: Vec<(f64, &[f64])> =
        (1..=40_000).map(|i| (f64::from(i) / 50.0, &[50.0, 50.0, 50.0][..])).collect();
    let dir = calibration(&table(&settings));
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    assert!(answer.contains("speed = \"800 mm/s\""), "{answer}");
}

#[test]
fn calibrate_says_what_data_do_not_support() {
    for (text, words) in [
        (HEAD.to_owned(), "no row has a `peel_N`: write the force"),
        (table(&[(0.1, &[74.0, 75.0]), (0.5, &[50.0])]), "no setting has 3 specimens; tested settings: 2"),
        (table(&[(0.1, &[20.0, 75.0, 130.0])]), "every setting's standard deviation is above 25 %"),
        (
            table(&[(0.1, &[74.0, 75.0, 76.0])]),
            "the strongest setting holds 2.920 N/mm, but 75.000 N/mm are needed",
        ),
        (table(&[(0.1, &[0.0, 0.0, 0.0])]), "the strongest setting holds 0.000 N/mm"),
    ] {
        let dir = calibration(&text);
        let args = ["calibrate", "results.csv", "--needed", "50 N/mm"];
        let _ = fails(dir.path(), &args, 1, &["results.csv: the data do not support a choice", words]);
    }
    // A seal without strength is refused, whatever strength is required.
    let dir = calibration(&table(&[(0.1, &[0.0, 0.0, 0.0])]));
    let args = ["calibrate", "results.csv", "--needed", "0.0001 N/mm"];
    let _ = fails(dir.path(), &args, 1, &["the strongest setting holds 0.000 N/mm"]);
}

#[test]
fn calibrate_names_the_line_it_cannot_read() {
    let good = table(&[(0.1, &[74.0, 75.0, 76.0])]);
    for (text, words) in [
        (String::new(), &["error[no-header]: an empty table", "results.csv"][..]),
        (
            "a,b\n1,2\n".to_owned(),
            &["error[no-header]", "results.csv:1:1", "must have the columns `temperature_C`, `speed_mm_s`"],
        ),
        (
            good.replacen("speed_mm_s", "speed", 1),
            &["error[unit]", "results.csv:1:21", "must be `speed_mm_s`"],
        ),
        (
            good.replace(',', ";").replace("0.1", "0,1"),
            &[
                "error[decimal-comma]: `speed_mm_s` is `0,1`",
                "results.csv:2:7",
                "results.csv:4:7",
                "write 0.1",
            ],
        ),
        (
            good.replace("0.1", "0,1"),
            &[
                "error[cell-count]: 7 cells",
                "results.csv:2:1",
                "must be 6, as the header has",
                "with a point: 10.5",
            ],
        ),
        (good.replace(",75,\n", ",75,\n\n\n7,200\n"), &["error[cell-count]: 2 cells", "results.csv:6:1"]),
        (
            good.replace(",75,", ",75 N,"),
            &["error[cell]: `peel_N` is `75 N`", "results.csv:3:16", "a number is needed"],
        ),
        (good.replace(",75,", ",-75,"), &["`peel_N` is `-75`", "must be at least 0"]),
        (good.replace(",75,", ",inf,").replace(",76,", ",nan,"), &["`inf`", "`nan`", "2 errors"]),
        (good.replacen("200,", "hot,", 1), &["`temperature_C` is `hot`", "results.csv:2:3"]),
        (
            good.replacen(",74,", ",74,\"peel", 1),
            &["error[open-quote]", "results.csv:2:1", "check for a quote that is not closed"],
        ),
    ] {
        let dir = calibration(&text);
        let _ = fails(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"], 1, words);
    }
    let dir = calibration(&good);
    fs::write(dir.path().join("bytes.csv"), b"\xff\xfe").expect("written");
    let _ = fails(dir.path(), &["calibrate", "bytes.csv"], 1, &["bytes.csv", "UTF-8"]);
    let _ = fails(dir.path(), &["calibrate", "missing.csv"], 1, &["cannot read missing.csv"]);
    for (args, words) in [
        (&["--needed", "1"][..], "write the force per length as a number and one of N/mm"),
        (&["--needed=-1 N/mm"], "must be more than 0 N/mm"),
        (&["--needed", "0 N/mm"], "must be more than 0 N/mm"),
        (&["--needed", "nan N/mm"], "write the force per length"),
        (&["--needed", "1,2 N/mm"], "write \"1.2 N/mm\""),
        (&["--margin", "nan"], "must be at least 1 and at most 100"),
        (&["--margin", "0"], "must be at least 1 and at most 100"),
        (&["--flat-angle", "30"], "--inflated-angle"),
    ] {
        let _ = fails(dir.path(), &[&["calibrate", "results.csv"][..], args].concat(), 2, &[words]);
    }
}

/// Tips of W 30 mm, as sharp as the band allows (R 1 mm) and rounder: `calibrate` recovers the fabric from the predictions of `actuator`.
#[test]
fn calibrate_finds_the_fabric_that_the_bench_shows() {
    for (tip_radius, radius) in [("0 mm", "1mm"), ("3 mm", "3mm")] {
        finds_the_fabric(tip_radius, radius);
    }
}

fn finds_the_fabric(tip_radius: &str, radius: &str) {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let star = format!("[star]\ntip_radius = \"{tip_radius}\"\n");
    let spec = support::PAPER.replacen("[star]\n", &star, 1) + "[load]\npressure = \"5 kPa\"\n";
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let asked = format!(
        "actuator --model section --json --tube-width 30mm --radius {radius} --angle 60deg --arm-length 120mm --pressure 12kPa"
    );
    let predicted = json_of(&done_silently(dir.path(), &asked.split(' ').collect::<Vec<_>>()));
    let angle = predicted["angle_deg"].as_f64().expect("a number").to_string();
    let bench = ["--flat-angle", "60", "--inflated-angle", &angle, "--angle-pressure", "12 kPa"];
    let call = [&["calibrate", "results.csv", "--spec", "spec.toml"][..], &bench].concat();
    let answer = done_silently(dir.path(), &call);
    // B of 0.3 mm at 128 MPa is 0.340 N mm.
    assert!(answer.contains("[fabric]\n# of the V-actuator at 12 kPa; a degree less or more"), "{answer}");
    assert!(
        answer.contains("\nbending_stiffness = \"0.340 N mm\"\n") && answer.contains("seal_strength"),
        "{answer}"
    );
    assert_eq!(answer.matches("[fabric]").count(), 1, "{answer}");
    // At its pressure lambda is that of `section`, for the unchanged fabric.
    assert!(
        answer.contains("# lambda predicted (section): ") && answer.contains("; measured is +0.0 %\n"),
        "{answer}"
    );
    let alone = [&["calibrate", "--spec", "spec.toml"][..], &bench].concat();
    let told = done_silently(dir.path(), &alone);
    assert!(
        told.contains("[fabric]\n") && told.contains("= \"0.340 N mm\"\n") && !told.contains("seal"),
        "{told}"
    );
    let told = json_of(&done_silently(dir.path(), &[&alone[..], &["--json"]].concat()));
    assert!(told["chosen"].is_null() && told["coiling"]["model"] == "section", "{told}");
    let disc = ["--disc-width", "77.2 mm", "--disc-pressure", "10 kPa", "--json"];
    let both = json_of(&done_silently(dir.path(), &[&call[..], &disc].concat()));
    let stretch = both["fabric"]["stretch_stiffness_N_mm"].as_f64().expect("a number");
    assert!((5.0..100.0).contains(&stretch), "{both}");
    // The bench results do not depend on the strips.
    fs::write(dir.path().join("results.csv"), HEAD).expect("written");
    let thin = run(dir.path(), &call);
    assert_eq!(thin.status.code(), Some(1));
    assert!(stdout(&thin).contains("\nbending_stiffness = \"0.340 N mm\"\n"), "{}", stdout(&thin));
}

#[test]
fn calibrate_reads_the_spec_once_and_warns_once() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let spec = support::PAPER.to_owned() + "[load]\npressure = \"5 kPa\"\n[seal]\ntemperature = \"270 C\"\n";
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let call =
        "calibrate results.csv --spec spec.toml --flat-angle 60 --inflated-angle 40 --angle-pressure 12kPa";
    let output = run(dir.path(), &call.split(' ').collect::<Vec<_>>());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output).matches("warning[ptfe]").count(), 1, "{}", stderr(&output));
}

#[test]
fn calibrate_refuses_what_no_bench_shows() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let spec = support::PAPER.to_owned() + "[load]\npressure = \"20 kPa\"\n";
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let refused = |args: &[&str], code: i32, words: &[&str]| {
        let call = [&["calibrate", "results.csv", "--spec", "spec.toml"][..], args].concat();
        let _ = fails(dir.path(), &call, code, words);
    };
    refused(&["--flat-angle", "30", "--inflated-angle", "31"], 1, &["at most the flat one, 30 deg"]);
    let crossed = ["--flat-angle", "58.7 deg", "--inflated-angle", "-100 deg"];
    refused(&crossed, 1, &["is -100 deg", "at least -6.6 deg", "check the sign", "between the arms"]);
    let wide = ["--flat-angle", "60", "--inflated-angle", "59", "--angle-pressure", "20 kPa"];
    refused(&wide, 1, &["--inflated-angle", "no stiffness of the fabric explains", "closes to between"]);
    refused(&["--angle-pressure", "20 kPa"], 2, &["--inflated-angle"]);
    let _ = fails(dir.path(), &["calibrate"], 2, &["<RESULTS>"]);
    let needless = ["calibrate", "--flat-angle", "30", "--inflated-angle", "9", "--needed", "1 N/mm"];
    let _ = fails(dir.path(), &needless, 2, &["RESULTS"]);
    refused(&["--disc-width", "78 mm"], 2, &["--disc-pressure"]);
    refused(&["--disc-width", "60 mm", "--disc-pressure", "10 kPa"], 1, &["0.600 of the flat one"]);
    refused(&["--disc-width", "100 mm", "--disc-pressure", "10 kPa"], 2, &["less than 100 mm"]);
}

#[test]
fn calibrate_compares_lambda_with_the_prediction() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let needed = ["--needed", "1 N/mm"];
    let angles =
        [&["calibrate", "results.csv", "--flat-angle", "30", "--inflated-angle", "-12"][..], &needed]
            .concat();
    let answer = done_silently(dir.path(), &angles);
    assert!(answer.starts_with("# lambda measured: 1.280\n# lambda predicted (ring): 1.2"), "{answer}");
    assert!(answer.contains("seal_strength"), "{answer}");
    // The results of the V-actuator do not depend on the strips.
    fs::write(dir.path().join("results.csv"), HEAD).expect("written");
    let thin = run(dir.path(), &angles);
    assert_eq!(thin.status.code(), Some(1));
    assert!(stdout(&thin).contains("# lambda measured: 1.280") && stderr(&thin).contains("no row has"));
    for (flat, inflated) in
        [("0", "60"), ("180", "60"), ("nan", "60"), ("30", "180"), ("30", "-180"), ("30", "inf")]
    {
        let args = ["calibrate", "results.csv", "--flat-angle", flat, "--inflated-angle", inflated];
        let _ = fails(dir.path(), &args, 2, &["and less than 180"]);
    }
    for ratio in ["nan", "0", "-1", "1e300"] {
        let ratio = format!("--radius-ratio={ratio}");
        let _ = fails(
            dir.path(),
            &[&angles[..], &[&ratio]].concat(),
            2,
            &["--radius-ratio", "must be more than 0"],
        );
    }
}
