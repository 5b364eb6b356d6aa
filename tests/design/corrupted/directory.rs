//! Whole directories: which files there are, their hashes, the manifest, the spec they were made from.

use super::{SEAL, TRACE, archive_of, assert_found, forged, forged_in, output_files, replace, reseal};
use crate::support::{self, PAPER};
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::manifest::{MANIFEST, Manifest, ManifestFile};
use stargrip_cam::pipeline::{Sources, prove_files, read_back};
use stargrip_cam::verify::{Method, OutputFiles};

#[test]
fn an_untouched_build_has_no_findings() {
    let proof = prove_files(&output_files());
    assert_eq!(proof.findings, []);
    assert_eq!(proof.files.iter().filter(|file| file.deviation.is_some()).count(), 11);
    let proven_by = |how: Method| {
        proof.files.iter().filter(|file| file.by == how).map(|file| file.path.as_str()).collect::<Vec<_>>()
    };
    assert_eq!(proven_by(Method::Hash), ["spec.toml", "machine.toml"]);
    assert_eq!((proven_by(Method::Reading).len(), proven_by(Method::Bytes).len()), (0, 15));
}

#[test]
fn a_changed_byte_is_found_by_its_hash_in_every_file() {
    let directory = output_files();
    for (file, _) in &directory.files {
        let mut files = output_files();
        let mut bytes = files.get(file).expect("a file").to_vec();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        replace(&mut files, file, bytes);
        let findings = prove_files(&files).findings;
        assert!(!findings.is_empty(), "{file}");
        // A profile that cannot be read any more is not even compared.
        let is_unread = findings.iter().any(|finding| finding.code == "unreadable" && finding.file == *file);
        if file != MANIFEST && !is_unread {
            assert_found(&findings, "hash", file);
        }
    }
}

#[test]
fn a_file_cut_short_anywhere_is_found() {
    let directory = output_files();
    for (file, bytes) in directory.files.iter().filter(|(file, _)| file != MANIFEST) {
        let mut short = output_files();
        replace(&mut short, file, bytes[..bytes.len() - 1].to_vec());
        assert_found(&prove_files(&short).findings, "size", file);
    }
    // Where a forger has fixed the manifest, the sentinel shows the cut.
    for keep in [0, 1, 500, 5_000, 12_000] {
        let findings = forged(SEAL, |program| program[..keep].to_owned());
        assert_found(&findings, "truncated", SEAL);
    }
    let findings = forged(TRACE, |program| program[..program.len() - 1].to_owned());
    assert_found(&findings, "truncated", TRACE);
}

#[test]
fn missing_and_unnamed_files_are_found() {
    let mut files = output_files();
    files.files.retain(|(name, _)| name != TRACE);
    files.files.push(("notes.txt".into(), b"mine".as_slice().into()));
    let findings = prove_files(&files).findings;
    assert_found(&findings, "missing-file", TRACE);
    assert_found(&findings, "unnamed-file", "notes.txt");
}

#[test]
fn a_directory_without_its_spec_profile_or_manifest_is_refused() {
    for file in ["spec.toml", "machine.toml"] {
        let mut files = output_files();
        files.files.retain(|(name, _)| name != file);
        assert_found(&prove_files(&files).findings, "missing-file", file);
    }
    let mut files = output_files();
    replace(&mut files, MANIFEST, b"{}".to_vec());
    assert_found(&prove_files(&files).findings, "manifest", MANIFEST);
    let empty_findings = prove_files(&OutputFiles::default()).findings;
    assert_found(&empty_findings, "missing-file", "spec.toml");
    assert_found(&empty_findings, "missing-file", "machine.toml");
}

#[test]
fn a_spec_that_cannot_be_read_or_made_is_found() {
    let findings = forged("spec.toml", |spec| spec.replace("points", "pionts"));
    assert_found(&findings, "unreadable", "spec.toml");
    let findings = forged("spec.toml", |spec| spec.replace("points = 5", "points = 9"));
    assert_found(&findings, "no-arm", "spec.toml");
}

/// Another star than the one the files were made for.
#[test]
fn every_file_of_another_star_is_found() {
    let findings = forged("spec.toml", |spec| spec.replace("\"30 mm\"", "\"30.01 mm\""));
    for file in [
        SEAL,
        TRACE,
        "sheet-1-seal.svg",
        "sheet-1-seal.dxf",
        "sheet-1-outline.svg",
        "sheet-1-outline.dxf",
        "star-1-mask.svg",
        "star-1-mask.dxf",
        "plate-1-frame.svg",
        "plate-1-frame.dxf",
    ] {
        assert_found(&findings, "deviation", file);
    }
    assert_found(&findings, "manifest", MANIFEST);
}

#[test]
fn a_manifest_with_other_figures_is_found() {
    let mut files = output_files();
    let mut manifest: Manifest = serde_json::from_slice(files.get(MANIFEST).expect("one")).expect("JSON");
    manifest.stars[0].seam_mm += 1.0;
    replace(&mut files, MANIFEST, manifest.to_json());
    assert_found(&prove_files(&files).findings, "manifest", MANIFEST);
}

/// The design decides the kind of each file: a manifest that differs is wrong, whatever the content of the file.
#[test]
fn a_manifest_does_not_decide_what_is_proven() {
    let findings = |change: &dyn Fn(&mut Manifest)| {
        let mut files = output_files();
        let mut manifest: Manifest = serde_json::from_slice(files.get(MANIFEST).expect("one")).expect("JSON");
        change(&mut manifest);
        replace(&mut files, MANIFEST, manifest.to_json());
        read_back(&files).findings
    };
    let program =
        |manifest: &Manifest| manifest.files.iter().position(|f| f.path == SEAL).expect("a program");
    let as_picture = findings(&|manifest| {
        let index = program(manifest);
        manifest.files[index].kind = Kind::PreviewSvg;
    });
    assert_found(&as_picture, "manifest", SEAL);
    let twice = findings(&|manifest| manifest.files.push(manifest.files[program(manifest)].clone()));
    assert_found(&twice, "manifest", SEAL);
    // A file that is named often is reported once and read once.
    let repeated = findings(&|manifest| {
        let entry = manifest.files[program(manifest)].clone();
        manifest.files.extend(std::iter::repeat_n(entry, 3000));
    });
    let of_seal = repeated.iter().filter(|finding| finding.file == SEAL).count();
    assert_eq!(of_seal, 1, "{repeated:#?}");
    let unlisted = findings(&|manifest| {
        let _ = manifest.files.remove(program(manifest));
    });
    assert_found(&unlisted, "manifest", SEAL);
    let evil = findings(&|manifest| {
        let entry = manifest.files[0].clone();
        manifest.files.push(ManifestFile { path: "evil.gcode".to_owned(), ..entry });
    });
    assert_found(&evil, "manifest", "evil.gcode");
    let unknown = {
        let mut files = output_files();
        let text = String::from_utf8(files.get(MANIFEST).expect("one").to_vec()).expect("text");
        replace(&mut files, MANIFEST, text.replace("\"seal-svg\"", "\"poem\"").into_bytes());
        read_back(&files).findings
    };
    assert_found(&unknown, "manifest", MANIFEST);
    assert!(unknown[0].found.contains("poem"), "{unknown:?}");
}

/// A build of some kinds states them, and then nothing else is required; a directory without files proves nothing.
#[test]
fn what_was_not_asked_for_is_not_missed_and_all_else_is() {
    let (spec, machine) = (support::read(PAPER), support::machine());
    let sources = Sources { spec: PAPER, machine: support::generic() };
    let preview_only =
        stargrip_cam::pipeline::build(&spec, &machine, sources, &KindRequest::exactly(&[Kind::PreviewSvg]))
            .expect("a design");
    let proof = prove_files(&preview_only.output_files());
    assert_eq!(proof.findings, []);
    assert_eq!(proof.files.len(), 3);
    let mut silent = preview_only.clone();
    silent.manifest.only.clear();
    assert_found(&prove_files(&silent.output_files()).findings, "missing-file", SEAL);
}

/// A detail that no reader checks is compared by its bytes: a colour, a comment, a figure of the manifest.
#[test]
fn a_byte_that_no_reader_looks_at_differs() {
    let mut files = output_files();
    let preview = String::from_utf8(files.get("sheet-1-preview.svg").expect("one").to_vec()).expect("text");
    replace(&mut files, "sheet-1-preview.svg", preview.replacen("#f7f7f4", "#f7f7f5", 1).into_bytes());
    reseal(&mut files);
    assert_eq!(read_back(&files).findings, []);
    assert_found(&prove_files(&files).findings, "differs", "sheet-1-preview.svg");
    let mut files = output_files();
    let manifest = String::from_utf8(files.get(MANIFEST).expect("one").to_vec()).expect("text");
    let (before, after) = manifest.split_once("\"area_mm2\": ").expect("plates");
    replace(&mut files, MANIFEST, format!("{before}\"area_mm2\": 1{after}").into_bytes());
    assert_found(&prove_files(&files).findings, "differs", MANIFEST);
}

#[test]
fn bytes_that_are_not_text_are_found() {
    let mut files = output_files();
    replace(&mut files, SEAL, vec![0xff; 100]);
    reseal(&mut files);
    assert_found(&prove_files(&files).findings, "not-text", SEAL);
}

#[test]
fn a_forged_prediction_is_found() {
    let spec = format!("{}\n[load]\npressure = \"37 kPa\"\n", support::PAPER);
    let file = "prediction.json";
    let findings =
        forged_in(&spec, file, |json| json.replacen("\"contraction\": 0.", "\"contraction\": 0.9", 1));
    assert_found(&findings, "prediction", file);
    assert_eq!(prove_files(&archive_of(&spec)).findings, []);
    let without_load = forged_in(&spec, "spec.toml", |spec| spec.replace("37 kPa", "36 kPa"));
    assert_found(&without_load, "prediction", file);
}

/// Only the files of the design are opened, and only as far as the manifest states: no pipe, no device, no link, no foreign file.
#[cfg(unix)]
#[test]
fn verify_opens_nothing_but_what_the_design_names() {
    use std::fs;
    use std::process::Command;
    let shop = support::program::workshop();
    let built = support::program::run(shop.path(), &["build", "star.toml"]);
    assert!(built.status.success(), "{}", support::program::stderr(&built));
    let folder =
        fs::read_dir(shop.path().join("out")).expect("out/").next().expect("one").expect("one").path();
    let pipe = Command::new("mkfifo").arg(folder.join("pipe")).status().expect("mkfifo");
    assert!(pipe.success());
    std::os::unix::fs::symlink("/dev/zero", folder.join("zero")).expect("a link");
    fs::remove_file(folder.join(TRACE)).expect("removed");
    std::os::unix::fs::symlink("/dev/zero", folder.join(TRACE)).expect("a link");
    // Holes that take no room, of 10 GB each: a foreign file, and one that the design names.
    for name in ["foreign", SEAL] {
        let file = fs::File::create(folder.join(name)).expect("a file");
        file.set_len(10_000_000_000).expect("a hole");
    }
    let verified = support::program::run(shop.path(), &["verify", folder.to_str().expect("UTF-8"), "--json"]);
    assert_eq!(verified.status.code(), Some(1));
    let verdict: serde_json::Value = serde_json::from_slice(&verified.stdout).expect("JSON");
    let findings = verdict["findings"].as_array().expect("a list");
    for (file, code) in [
        ("pipe", "unnamed-file"),
        ("zero", "unnamed-file"),
        ("foreign", "unnamed-file"),
        (TRACE, "not-a-file"),
        (SEAL, "size"),
    ] {
        assert!(findings.iter().any(|f| f["file"] == file && f["code"] == code), "{file}: {findings:#?}");
    }
    let of_link: Vec<_> = findings.iter().filter(|f| f["file"] == TRACE).collect();
    assert_eq!(of_link.len(), 1, "{of_link:#?}");
    assert_eq!(of_link[0]["found"], "a link");
    let of_seal: Vec<_> = findings.iter().filter(|f| f["file"] == SEAL).collect();
    assert_eq!(of_seal.len(), 1, "{of_seal:#?}");
    assert_eq!(of_seal[0]["found"], "10000000000 bytes");
    // Without the manifest only certain findings are listed.
    let manifest = folder.join("manifest.json");
    fs::rename(&manifest, shop.path().join("moved")).expect("moved");
    std::os::unix::fs::symlink("../../moved", &manifest).expect("a link");
    let verified = support::program::run(shop.path(), &["verify", folder.to_str().expect("UTF-8"), "--json"]);
    let verdict: serde_json::Value = serde_json::from_slice(&verified.stdout).expect("JSON");
    let findings = verdict["findings"].as_array().expect("a list");
    assert_eq!((&findings[0]["file"], &findings[0]["found"]), (&"manifest.json".into(), &"a link".into()));
    assert!(findings[1..].iter().all(|f| f["code"] == "unnamed-file"), "{findings:#?}");
}

/// A file that is longer than its manifest states, or is not named there, is judged as a whole.
#[test]
fn a_longer_file_is_judged_as_a_whole() {
    use std::fs;
    let shop = support::program::workshop();
    let built = support::program::run(shop.path(), &["build", "star.toml", "-q", "-o", "out"]);
    assert!(built.status.success(), "{}", support::program::stderr(&built));
    let folder = shop.path().join("out");
    let codes_and_findings = || {
        let verified = support::program::run(shop.path(), &["verify", "out", "--json"]);
        let verdict: serde_json::Value = serde_json::from_slice(&verified.stdout).expect("JSON");
        let findings = verdict["findings"].as_array().expect("a list").clone();
        findings.into_iter().map(|f| (f["code"].clone(), f["found"].clone())).collect::<Vec<_>>()
    };
    let codes = |findings: &[(serde_json::Value, serde_json::Value)]| {
        findings.iter().map(|(code, _)| code.as_str().expect("a code").to_owned()).collect::<Vec<_>>()
    };
    let good = fs::read_to_string(folder.join(SEAL)).expect("a program");
    let windows = good.replace('\n', "\r\n");
    fs::write(folder.join(SEAL), &windows).expect("written");
    let findings = codes_and_findings();
    assert_eq!(codes(&findings), ["size", "hash", "differs"], "{findings:?}");
    assert_eq!(findings[0].1, format!("{} bytes", windows.len()));
    assert_eq!(findings[2].1, "carriage returns (CR)");
    fs::write(folder.join(SEAL), good.clone() + "; a note, and more words\n").expect("written");
    let findings = codes_and_findings();
    assert_eq!(codes(&findings), ["size", "hash", "truncated", "differs"], "{findings:?}");
    fs::write(folder.join(SEAL), good).expect("written");
    let manifest = fs::read_to_string(folder.join("manifest.json")).expect("a manifest");
    let unnamed = manifest.replacen(SEAL, "other.gcode", 1);
    fs::write(folder.join("manifest.json"), unnamed).expect("written");
    let findings = codes_and_findings();
    assert_eq!(codes(&findings), ["manifest", "manifest"], "{findings:?}");
}
