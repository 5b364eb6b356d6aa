//! `verify` of directories that another version wrote, or that were edited.

use crate::program::assert_code;
use crate::support::program::{run, stdout, workshop};
use std::fs;
use std::path::Path;

#[test]
fn verify_tells_what_is_wrong_and_fails() {
    let dir = workshop();
    assert_code(&run(dir.path(), &["build", "star.toml"]), 0);
    let file = dir.path().join("out/star/star-1-seal.gcode");
    fs::write(&file, fs::read_to_string(&file).expect("text").replace("F6", "F600")).expect("written");
    let verified = run(dir.path(), &["verify", "out/star"]);
    assert_code(&verified, 1);
    assert!(
        stdout(&verified).contains("star-1-seal.gcode:24: wrong-feed: found F600, allowed F6"),
        "{}",
        stdout(&verified)
    );
    assert_code(&run(dir.path(), &["verify", "nowhere"]), 1);
}

/// The manifest of out/star with `change` made in it.
fn edit_manifest(dir: &Path, change: impl Fn(&mut serde_json::Value)) {
    let path = dir.join("out/star/manifest.json");
    let mut manifest: serde_json::Value =
        serde_json::from_slice(&fs::read(&path).expect("it")).expect("JSON");
    change(&mut manifest);
    fs::write(&path, serde_json::to_vec_pretty(&manifest).expect("JSON")).expect("written");
}

/// No hash covers the version in the manifest, so it must not disable the comparison silently.
#[test]
fn a_directory_of_another_version_is_read_back_and_named() {
    let dir = workshop();
    let load = format!(
        "{}\n[load]\npressure = \"20 kPa\"\n",
        fs::read_to_string(dir.path().join("star.toml")).expect("it")
    );
    fs::write(dir.path().join("star.toml"), load).expect("written");
    assert_code(&run(dir.path(), &["build", "star.toml", "--with", "report", "-q"]), 0);
    edit_manifest(dir.path(), |manifest| manifest["tool"]["version"] = "9.8.7".into());
    let verify = |options: &[&str]| run(dir.path(), &[&["verify", "out/star"], options].concat());
    let json = || -> serde_json::Value {
        serde_json::from_slice(&verify(&["--json"]).stdout).expect("one JSON object")
    };

    let plain = verify(&[]);
    assert_code(&plain, 3);
    let said = stdout(&plain).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("out/star: written by 9.8.7: read back, not compared; no findings"), "{said}");
    assert!(!said.contains("not proven:"), "{said}");
    assert_code(&verify(&["--read-back"]), 0);
    let quiet = verify(&["-q"]);
    assert_code(&quiet, 3);
    assert!(stdout(&quiet).contains("written by 9.8.7"), "{}", stdout(&quiet));
    // Files equal to the byte are reported all the same.
    let found = json();
    assert_eq!(found["written_by"], "9.8.7");
    assert_eq!(found["unproven"], serde_json::json!([]));
    let by = |path: &str| {
        let all = found["proven"].as_array().expect("a list").iter();
        all.clone().find(|file| file["path"] == path).expect(path)["by"].clone()
    };
    assert_eq!((by("report.html"), by("star-1-seal.gcode")), ("bytes".into(), "bytes".into()));

    // No reader judges all of a report: a report that differs is listed as unproven.
    let report = dir.path().join("out/star/report.html");
    let text = fs::read_to_string(&report).expect("it").replace("200 C", "450 C");
    fs::write(&report, &text).expect("written");
    edit_manifest(dir.path(), |manifest| {
        let files = manifest["files"].as_array_mut().expect("a list");
        let entry = files.iter_mut().find(|file| file["path"] == "report.html").expect("it");
        entry["sha256"] = stargrip_cam::manifest::sha256(text.as_bytes()).into();
    });
    assert_eq!(json()["unproven"][0], "report.html");
    assert!(stdout(&verify(&[])).contains("not proven:"));
    // A finding remains one with every option.
    fs::write(&report, text.replace("450 C", "4500 C")).expect("written");
    assert_code(&verify(&["--read-back"]), 1);
}

/// Models change from version to version: an older directory with other predictions must not look damaged.
#[test]
fn predictions_of_another_version_are_unproven_and_no_finding() {
    let dir = workshop();
    let load = "\n[load]\npressure = \"20 kPa\"\nobject_diameter = \"80 mm\"\nmass = \"0.1 kg\"\n";
    let spec = dir.path().join("star.toml");
    fs::write(&spec, fs::read_to_string(&spec).expect("it") + load).expect("written");
    assert_code(&run(dir.path(), &["build", "star.toml", "-q"]), 0);
    edit_manifest(dir.path(), |manifest| manifest["tool"]["version"] = "0.0.9".into());
    let path = dir.path().join("out/star/prediction.json");
    let replace = |text: &str| {
        fs::write(&path, text).expect("written");
        edit_manifest(dir.path(), |manifest| {
            let files = manifest["files"].as_array_mut().expect("a list");
            let entry = files.iter_mut().find(|file| file["path"] == "prediction.json").expect("it");
            entry["sha256"] = stargrip_cam::manifest::sha256(text.as_bytes()).into();
            entry["bytes"] = text.len().into();
        });
        run(dir.path(), &["verify", "out/star", "--json"])
    };
    let mut prediction: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(&path).expect("it")).expect("JSON");
    prediction["payload_kg"] = 7.25.into();
    let other = replace(&format!("{prediction:#}\n"));
    assert_code(&other, 3);
    let proof: serde_json::Value = serde_json::from_slice(&other.stdout).expect("JSON");
    assert_eq!(proof["unproven"], serde_json::json!(["prediction.json"]));
    // A file that holds no numbers at all is damaged.
    assert_code(&replace("{"), 1);
}

/// The dialect of a profile is the same in all versions: a spec that names another one was not built from.
#[test]
fn a_profile_of_another_dialect_is_a_finding_whatever_version_wrote_it() {
    let dir = workshop();
    assert_code(&run(dir.path(), &["build", "star.toml", "-q"]), 0);
    let path = dir.path().join("out/star/spec.toml");
    let spec = fs::read_to_string(&path).expect("it") + "\n[machine]\nprofile = \"klipper\"\n";
    fs::write(&path, &spec).expect("written");
    edit_manifest(dir.path(), |manifest| {
        manifest["tool"]["version"] = "9.8.7".into();
        let files = manifest["files"].as_array_mut().expect("a list");
        let entry = files.iter_mut().find(|file| file["path"] == "spec.toml").expect("it");
        entry["sha256"] = stargrip_cam::manifest::sha256(spec.as_bytes()).into();
        entry["bytes"] = spec.len().into();
    });
    let verified = run(dir.path(), &["verify", "out/star", "--read-back", "-q"]);
    assert_code(&verified, 1);
    assert!(stdout(&verified).contains("machine.toml:1: differs"), "{}", stdout(&verified));
}
