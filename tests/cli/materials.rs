//! Lists of materials: what `calibrate` prints is a fabric that every command takes by its name.

use std::fs;
use std::path::Path;

use crate::support::program::{run, run_with_settings, stderr, stdout_of_success, workshop};

#[track_caller]
fn done(dir: &Path, args: &[&str]) -> String {
    stdout_of_success(args, &run_with_settings(dir, args))
}

const RESULTS: &str = "strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n1,190,0.2,-0.3,86,seal\n\
    2,190,0.2,-0.3,82,seal\n3,190,0.2,-0.3,89,seal\n";

#[test]
fn what_calibrate_prints_is_a_fabric_of_every_command() {
    let dir = workshop();
    let list = dir.path().join("settings/stargrip-cam/materials");
    fs::create_dir_all(&list).expect("made");
    fs::write(dir.path().join("results.csv"), RESULTS).expect("written");
    let printed = done(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    fs::write(list.join("ripstop.toml"), printed).expect("written");
    let mut chopped = fs::read_to_string(dir.path().join("star.toml")).expect("written");
    chopped += "[machine]\nprofile = \"grbl\"\nfeed_floor = \"chop\"\n";
    fs::write(dir.path().join("star.toml"), chopped).expect("written");
    let _ = done(
        dir.path(),
        &["build", "star.toml", "-o", "made", "--fabric", "ripstop", "--only", "seal-gcode"],
    );
    let spec = fs::read_to_string(dir.path().join("made/spec.toml")).expect("written");
    assert!(
        spec.contains("seal_strength = \"3.145 N/mm\"") && spec.contains("speed = \"0.2 mm/s\""),
        "{spec}"
    );
    assert!(!spec.contains("young_modulus") && !spec.contains("specimens"), "{spec}");
    let program = fs::read_to_string(dir.path().join("made/star-1-seal.gcode")).expect("written");
    assert!(program.contains("heat: temperature_C=190"), "{program}");
    // The directory alone states every value: without the list it is proven.
    assert_eq!(run(dir.path(), &["verify", "made"]).status.code(), Some(0));
    for command in ["check", "predict"] {
        let _ = done(dir.path(), &[command, "star.toml", "--fabric", "ripstop"]);
    }
    let _ = done(dir.path(), &["new", "one", "--fabric", "ripstop"]);
    let wish = ["new", "wish", "--object", "70 mm", "--mass", "100 g", "--fabric", "ripstop"];
    let _ = done(dir.path(), &wish);
    for file in ["one.toml", "wish.toml"] {
        let spec = fs::read_to_string(dir.path().join(file)).expect("written");
        for line in ["seal_strength = \"3.145 N/mm\"", "temperature = \"190 C\"", "speed = \"0.2 mm/s\""] {
            assert!(spec.lines().any(|written| written.starts_with(line)), "{file}: {line}\n{spec}");
        }
        let _ = done(dir.path(), &["check", file, "--only", "preview-svg"]);
    }
}

#[test]
fn an_unknown_fabric_is_answered_with_the_list() {
    let dir = workshop();
    let list = dir.path().join("settings/stargrip-cam/materials");
    fs::create_dir_all(&list).expect("made");
    fs::write(list.join("ripstop.toml"), "[fabric]\nthicknes = \"1 mm\"\n").expect("written");
    for (fabric, part) in [
        ("ripstpo", "did you mean ripstop?"),
        ("leather", "there are: paper, ripstop"),
        ("ripstop", "unknown-key"),
        ("no/such.toml", "cannot read no/such.toml"),
        (".", "no fabric and no file is called .; there are: paper, ripstop"),
    ] {
        let output = run_with_settings(dir.path(), &["check", "star.toml", "--fabric", fabric]);
        assert_eq!(output.status.code(), Some(1), "{fabric}");
        assert!(stderr(&output).contains(part), "{fabric}: {}", stderr(&output));
    }
}
