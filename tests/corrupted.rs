//! The verifier can fail: for each of its findings a file that is wrong in just that way.
//!
//! Every corruption is a build of the paper's star with one file changed; unless the test is about the
//! hash, the manifest is changed too, as a careful forger would, so that only reading the file can tell.

mod support;

use std::borrow::Cow;
use std::ops::RangeInclusive;

use stargrip_cam::artifact::{Asked, Kind};
use stargrip_cam::manifest::{MANIFEST, Manifest, ManifestFile, sha256};
use stargrip_cam::pipeline::{Sources, prove_files, read_back};
use stargrip_cam::verify::{By, Finding, OutputFiles};
use support::PAPER;

const SEAL: &str = "star-1-seal.gcode";
const TRACE: &str = "star-1-trace.gcode";

fn output_files() -> OutputFiles<'static> {
    archive_of(support::PAPER)
}

fn archive_of(text: &str) -> OutputFiles<'static> {
    let build = support::build(text).expect("a gripper");
    let own = |(name, bytes): (&str, Cow<'_, [u8]>)| (name.to_owned().into(), bytes.into_owned().into());
    OutputFiles { files: build.files().map(own).collect() }
}

fn text(files: &OutputFiles<'_>, file: &str) -> String {
    String::from_utf8(files.get(file).expect("a file").to_vec()).expect("text")
}

fn replace(files: &mut OutputFiles<'static>, file: &str, bytes: Vec<u8>) {
    let entry = files.files.iter_mut().find(|(name, _)| name == file).expect("a file");
    entry.1 = bytes.into();
}

/// Makes the manifest agree with the files.
fn reseal(files: &mut OutputFiles<'static>) {
    let mut manifest: Manifest = serde_json::from_slice(files.get(MANIFEST).expect("one")).expect("JSON");
    for entry in &mut manifest.files {
        let bytes = files.get(&entry.path).expect("a file");
        (entry.bytes, entry.sha256) = (bytes.len(), sha256(bytes));
    }
    replace(files, MANIFEST, manifest.to_json());
}

/// The findings after `change` of `file`, with a manifest that agrees.
fn forged(file: &str, change: impl Fn(&str) -> String) -> Vec<Finding> {
    forged_in(support::PAPER, file, change)
}

fn forged_in(spec: &str, file: &str, change: impl Fn(&str) -> String) -> Vec<Finding> {
    let mut files = archive_of(spec);
    let before = text(&files, file);
    let after = change(&before);
    assert!(before != after, "the corruption changes nothing");
    replace(&mut files, file, after.into_bytes());
    reseal(&mut files);
    // By reading alone: bytes that are compared would find everything.
    read_back(&files).findings
}

#[track_caller]
fn assert_found(findings: &[Finding], code: &str, file: &str) {
    let found = findings.iter().any(|finding| finding.code == code && finding.file == file);
    assert!(found, "no {code} for {file} in {findings:#?}");
}

/// Changes the lines of a program, and makes its last line count them.
fn with_lines(program: &str, change: impl Fn(&mut Vec<String>)) -> String {
    let mut lines: Vec<String> = program.lines().map(str::to_owned).collect();
    change(&mut lines);
    let count = lines.len();
    let last = lines.last_mut().expect("lines");
    if last.starts_with("; end of program") {
        *last = format!("; end of program, {count} lines");
    }
    lines.join("\n") + "\n"
}

/// Index of the `n`-th line (from 0) that begins with `start`.
fn nth(lines: &[String], start: &str, n: usize) -> usize {
    let mut found = lines.iter().enumerate().filter(|(_, line)| line.starts_with(start));
    found.nth(n).map(|(i, _)| i).expect("such a line")
}

/// Index of the first move of seam `n` (from 0) at contact height.
fn contact(lines: &[String], n: usize) -> usize {
    nth(lines, "; seam:", n) + 2
}

/// The lines of `bad`, from 1, that are not those of `good`; the last one, which counts the others, does not matter.
fn changed(good: &str, bad: &str) -> RangeInclusive<usize> {
    let body = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let (mut good, mut bad) = (body(good), body(bad));
    drop((good.pop(), bad.pop()));
    let same = good.iter().zip(&bad).take_while(|(a, b)| a == b).count();
    let rest = good[same..].iter().rev().zip(bad[same..].iter().rev()).take_while(|(a, b)| a == b).count();
    same + 1..=bad.len() - rest
}

/// Where a fault is seen that `place` has: a line removed is missed by those around it.
fn around(place: &RangeInclusive<usize>) -> RangeInclusive<usize> {
    place.start().saturating_sub(2)..=place.end() + 2
}

/// The fault has its name, and the line that is blamed is where the program was changed.
#[track_caller]
fn assert_program_fault(code: &str, change: impl Fn(&mut Vec<String>)) {
    assert_blamed(code, change, around);
}

/// The same for what only shows further on in the program.
#[track_caller]
fn assert_later_fault(code: &str, change: impl Fn(&mut Vec<String>)) {
    assert_blamed(code, change, |place| *place.start()..=usize::MAX);
}

#[track_caller]
fn assert_blamed(
    code: &str,
    change: impl Fn(&mut Vec<String>),
    lines: impl Fn(&RangeInclusive<usize>) -> RangeInclusive<usize>,
) {
    let good = text(&output_files(), SEAL);
    let lines = lines(&changed(&good, &with_lines(&good, &change)));
    let findings = forged(SEAL, |program| with_lines(program, &change));
    let is_it = |finding: &&Finding| finding.code == code && finding.file == SEAL;
    let blamed: Vec<_> = findings.iter().filter(is_it).map(|finding| finding.line).collect();
    let found = blamed.iter().any(|line| line.is_some_and(|line| lines.contains(&line)));
    assert!(found, "{code} blames {blamed:?}, not a line of {lines:?}: {findings:#?}");
}

#[test]
fn an_untouched_build_has_no_findings() {
    let proof = prove_files(&output_files());
    assert_eq!(proof.findings, []);
    assert_eq!(proof.files.iter().filter(|file| file.deviation.is_some()).count(), 14);
    let by = |how: By| {
        proof.files.iter().filter(|file| file.by == how).map(|file| file.path.as_str()).collect::<Vec<_>>()
    };
    assert_eq!(by(By::Hash), ["spec.toml", "machine.toml"]);
    assert_eq!((by(By::Reading).len(), by(By::Bytes).len()), (0, 15));
}

#[test]
fn a_changed_byte_is_found_by_its_hash_in_every_file() {
    let whole = output_files();
    for (file, _) in &whole.files {
        let mut files = output_files();
        let mut bytes = files.get(file).expect("a file").to_vec();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        replace(&mut files, file, bytes);
        let findings = prove_files(&files).findings;
        assert!(!findings.is_empty(), "{file}");
        // A profile that means nothing any more is not even compared.
        let is_unread = findings.iter().any(|finding| finding.code == "unreadable" && finding.file == *file);
        if file != MANIFEST && !is_unread {
            assert_found(&findings, "hash", file);
        }
    }
}

#[test]
fn a_file_cut_short_anywhere_is_found() {
    let whole = output_files();
    for (file, bytes) in whole.files.iter().filter(|(file, _)| file != MANIFEST) {
        let mut short = output_files();
        replace(&mut short, file, bytes[..bytes.len() - 1].to_vec());
        assert_found(&prove_files(&short).findings, "size", file);
    }
    // A forger who fixes the manifest is told by the sentinel.
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
    let nothing = prove_files(&OutputFiles::default()).findings;
    assert_found(&nothing, "missing-file", "spec.toml");
    assert_found(&nothing, "missing-file", "machine.toml");
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
        "star-1-mask.pdf",
        "star-1-mask-a4.pdf",
        "star-1-mask-letter.pdf",
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

/// The design decides what each file is: a manifest that says otherwise is wrong, whatever the file holds.
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
        let at = program(manifest);
        manifest.files[at].kind = Kind::PreviewSvg;
    });
    assert_found(&as_picture, "manifest", SEAL);
    let twice = findings(&|manifest| manifest.files.push(manifest.files[program(manifest)].clone()));
    assert_found(&twice, "manifest", SEAL);
    // However often it is named, it is told once and read once.
    let often = findings(&|manifest| {
        let entry = manifest.files[program(manifest)].clone();
        manifest.files.extend(std::iter::repeat_n(entry, 3000));
    });
    let told = often.iter().filter(|finding| finding.file == SEAL).count();
    assert_eq!(told, 1, "{often:#?}");
    let gone = findings(&|manifest| {
        let _ = manifest.files.remove(program(manifest));
    });
    assert_found(&gone, "manifest", SEAL);
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

/// A build of some kinds says so, and then nothing else is asked for; everything deleted is no proof of anything.
#[test]
fn what_was_not_asked_for_is_not_missed_and_all_else_is() {
    let (spec, machine) = (support::read(PAPER), support::machine());
    let sources = Sources { spec: PAPER, machine: support::generic() };
    let some = stargrip_cam::pipeline::build(&spec, &machine, sources, &Asked::only(&[Kind::PreviewSvg]))
        .expect("a design");
    let proof = prove_files(&some.output_files());
    assert_eq!(proof.findings, []);
    assert_eq!(proof.files.len(), 3);
    let mut silent = some.clone();
    silent.manifest.only.clear();
    assert_found(&prove_files(&silent.output_files()).findings, "missing-file", SEAL);
}

/// What no reader looks at is seen by its bytes: a colour, a comment, a figure of the manifest.
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
fn a_moved_point_is_found() {
    assert_program_fault("deviation", |lines| {
        let i = contact(lines, 0) + 4;
        let x = lines[i].split_whitespace().nth(1).expect("a word")[1..].parse::<f64>().expect("a number");
        lines[i] = lines[i].replacen(&format!("X{x}"), &format!("X{}", x + 0.002), 1);
    });
}

#[test]
fn an_arc_for_a_controller_that_draws_none_is_found() {
    assert_program_fault("unknown-word", |lines| {
        let i = nth(lines, "G1 X", 40);
        lines[i] = lines[i].replacen("G1", "G3", 1) + " I1 J0";
    });
}

#[test]
fn a_loop_left_open_is_found() {
    assert_program_fault("open-loop", |lines| {
        let end = nth(lines, "; seam:", 1);
        // Without the last moves of the run; the way up begins where the run now ends.
        let _ = lines.drain(end - 12..end - 3);
    });
}

#[test]
fn a_cut_overlap_is_found() {
    assert_program_fault("missing-overlap", |lines| {
        // The way up, then the lift to travel height, then the travel stand before the next seam.
        let lift = nth(lines, "; seam:", 1) - 3;
        let _ = lines.remove(lift - 1);
    });
}

#[test]
fn a_late_start_and_a_cut_corner_are_found() {
    assert_program_fault("late-start", |lines| {
        // The way down ends where the first move in contact should.
        let i = contact(lines, 0);
        let first = lines.remove(i);
        lines[i - 1] = format!("{first} Z-0.3 F6");
    });
    // Told is the worst place, and it lies further on: past a sharp corner that is cut the way back is taken for the way there.
    assert_later_fault("deviation", |lines| {
        // The move that ends at a vertex of the path.
        let i = nth(lines, "G1 X271.7383 Y239.0098", 0);
        let _ = lines.remove(i);
    });
}

#[test]
fn going_back_is_found() {
    assert_program_fault("backwards", |lines| {
        let i = contact(lines, 0) + 2;
        let (there, back) = (lines[i].clone(), lines[i - 1].clone());
        lines.insert(i + 1, back);
        lines.insert(i + 2, there);
    });
}

#[test]
fn a_cold_or_wrongly_heated_iron_is_found() {
    assert_later_fault("cold-seal", |lines| {
        let pause = nth(lines, "M0", 0);
        let _ = lines.remove(pause);
    });
    assert_later_fault("cold-seal", |lines| {
        let heat = nth(lines, "; heat:", 0);
        lines[heat] = "; heat: temperature_C=180".to_owned();
    });
}

#[test]
fn a_wrong_feed_is_found() {
    assert_program_fault("wrong-feed", |lines| {
        let i = nth(lines, "G1 ", 0);
        lines[i] = lines[i].replace("F6", "F6.1");
    });
}

#[test]
fn fast_vertical_and_deep_moves_on_the_fabric_are_found() {
    assert_program_fault("rapid-in-contact", |lines| {
        let i = contact(lines, 0) + 1;
        lines[i] = lines[i].replacen("G1", "G0", 1);
    });
    assert_program_fault("plunge", |lines| {
        let i = contact(lines, 0);
        lines.insert(i, "G1 Z5".to_owned());
        lines.insert(i + 1, "G1 Z-0.3".to_owned());
    });
    assert_program_fault("too-deep", |lines| {
        let i = contact(lines, 0) + 1;
        lines[i] += " Z-0.4";
    });
}

#[test]
fn an_iron_at_rest_is_found() {
    // A tenth of the 2 mm band at 0.1 mm/s takes 2 s.
    assert_program_fault("iron-at-rest", |lines| lines.insert(contact(lines, 0) + 3, "G4 P2.1".to_owned()));
    assert_program_fault("iron-at-rest", |lines| lines.insert(contact(lines, 0) + 3, "M0".to_owned()));
    // Shorter, it leaves no scar, and the seam is late all the same.
    assert_program_fault("wrong-feed", |lines| lines.insert(contact(lines, 0) + 3, "G4 P1.9".to_owned()));
}

#[test]
fn a_move_off_the_sheet_is_found() {
    assert_program_fault("outside-work-area", |lines| {
        let i = nth(lines, "G0 X", 0);
        lines.insert(i, "G0 X-1 Y10".to_owned());
        lines.insert(i + 1, "G0 X2 Y10".to_owned());
    });
}

#[test]
fn missing_and_extra_seams_are_found() {
    // What is not there has no line.
    let missing = forged(SEAL, |program| {
        with_lines(program, |lines| {
            let (from, to) = (nth(lines, "; seam:", 1), nth(lines, "M2", 0) - 2);
            let _ = lines.drain(from..to);
        })
    });
    assert_found(&missing, "missing-seam", SEAL);
    assert_program_fault("extra-seam", |lines| {
        let at = nth(lines, "M2", 0);
        for (k, line) in
            ["G1 X50 Y50 F6", "G0 X50 Y60", "G0 Z5", "G1 X53 Y60 Z-0.3", "G1 X60 Y60", "G1 X63 Y60 Z5"]
                .into_iter()
                .enumerate()
        {
            lines.insert(at + k, line.to_owned());
        }
    });
}

#[test]
fn a_trace_that_touches_or_waits_or_lacks_a_path_is_found() {
    let low = forged(TRACE, |program| program.replace("G0 Z5 ", "G0 Z-0.3 "));
    assert_found(&low, "low-trace", TRACE);
    let hot = forged(TRACE, |program| {
        with_lines(program, |lines| {
            let i = nth(lines, "G0 Z30", 0);
            lines.insert(i + 1, "M0".to_owned());
        })
    });
    assert_found(&hot, "hot-trace", TRACE);
    let short = forged(TRACE, |program| {
        with_lines(program, |lines| {
            let (from, to) = (nth(lines, "G0 X", 2), nth(lines, "G0 Z30", 1));
            let _ = lines.drain(from..to);
        })
    });
    assert_found(&short, "missing-seam", TRACE);
}

#[test]
fn a_line_that_the_controller_would_not_read_is_found() {
    let insert = |line: &'static str| {
        move |lines: &mut Vec<String>| lines.insert(contact(lines, 0) + 3, line.to_owned())
    };
    assert_program_fault("unknown-word", insert("M104 S200"));
    assert_program_fault("bad-character", insert("(a comment that closes early) G0 Z-5"));
    assert_program_fault(
        "line-too-long",
        insert("; 34567890123456789012345678901234567890123456789012345678901234567890123"),
    );
    assert_later_fault("mode-unset", |lines| {
        let i = nth(lines, "G21", 0);
        let _ = lines.remove(i);
    });
}

#[test]
fn drawings_with_lost_doubled_or_opened_paths_are_found() {
    let svg = "sheet-1-outline.svg";
    let lines_without = |text: &str, part: &str| -> String {
        let kept: Vec<&str> = text.lines().filter(|line| !line.contains(part)).collect();
        kept.join("\n") + "\n"
    };
    assert_found(&forged(svg, |text| lines_without(text, "<circle")), "path-count", svg);
    assert_found(&forged(svg, |text| text.replacen(" Z\"", "\"", 1)), "open-loop", svg);
    let doubled = forged(svg, |text| {
        let path = text.lines().find(|line| line.contains("<path")).expect("a path");
        text.replacen(path, &format!("{path}\n{path}"), 1)
    });
    assert_found(&doubled, "path-length", svg);
    let moved = forged(svg, |text| text.replacen("<circle cx=\"", "<circle cx=\"1", 1));
    assert_found(&moved, "deviation", svg);
    let renamed = forged(svg, |text| text.replace("cut-hole", "engrave"));
    assert_found(&renamed, "unknown-layer", svg);
    let scaled = forged(svg, |text| text.replacen("mm\"", "px\"", 1));
    assert_found(&scaled, "wrong-scale", svg);
    let page = forged(svg, |text| text.replace("333.1", "334.1"));
    assert_found(&page, "wrong-size", svg);
}

#[test]
fn a_damaged_dxf_is_found() {
    let dxf = "sheet-1-seal.dxf";
    assert_found(&forged(dxf, |text| text.replace("  0\nEOF\n", "")), "truncated", dxf);
    let inches = forged(dxf, |text| text.replace("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n1\n"));
    assert_found(&inches, "wrong-scale", dxf);
    let hollow = forged(dxf, |text| text.replacen(" 42\n-0.", " 42\n0.", 1));
    assert_found(&hollow, "deviation", dxf);
}

#[test]
fn formats_that_disagree_are_found() {
    let dxf = "sheet-1-seal.dxf";
    let findings = forged(dxf, |text| text.replace("  8\nseal-inner\n", "  8\nseal-outer\n"));
    assert_found(&findings, "formats-disagree", dxf);
}

/// Without an inlet the outer loop closes too, and has an overlap that can be missing.
#[test]
fn a_closed_outer_loop_is_checked_for_its_overlap() {
    let spec = format!("{}\n[inlet]\nnone = true\n", support::PAPER);
    let findings = forged_in(&spec, SEAL, |program| {
        with_lines(program, |lines| {
            let park = nth(lines, "G0 Z30", 1);
            let _ = lines.remove(park - 2);
        })
    });
    assert_found(&findings, "missing-overlap", SEAL);
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

/// Only what the design asks for is opened, and only as far as the manifest says: no pipe, no device, no link, no foreign file.
#[cfg(unix)]
#[test]
fn verify_opens_nothing_but_what_the_design_names() {
    use std::fs;
    use std::process::Command;
    let shop = support::program::workshop();
    let built = support::program::run(shop.path(), &["build", "star.toml"]);
    assert!(built.status.success(), "{}", support::program::stderr(&built));
    let out = fs::read_dir(shop.path().join("out")).expect("out/").next().expect("one").expect("one").path();
    let pipe = Command::new("mkfifo").arg(out.join("pipe")).status().expect("mkfifo");
    assert!(pipe.success());
    std::os::unix::fs::symlink("/dev/zero", out.join("zero")).expect("a link");
    fs::remove_file(out.join(TRACE)).expect("removed");
    std::os::unix::fs::symlink("/dev/zero", out.join(TRACE)).expect("a link");
    // Holes that take no room, of 10 GB each: a foreign file, and one that the design names.
    for name in ["foreign", SEAL] {
        let file = fs::File::create(out.join(name)).expect("a file");
        file.set_len(10_000_000_000).expect("a hole");
    }
    let verified = support::program::run(shop.path(), &["verify", out.to_str().expect("UTF-8"), "--json"]);
    assert_eq!(verified.status.code(), Some(1));
    let said: serde_json::Value = serde_json::from_slice(&verified.stdout).expect("JSON");
    let findings = said["findings"].as_array().expect("a list");
    for (file, code) in [
        ("pipe", "unnamed-file"),
        ("zero", "unnamed-file"),
        ("foreign", "unnamed-file"),
        (TRACE, "size"),
        (SEAL, "size"),
    ] {
        assert!(findings.iter().any(|f| f["file"] == file && f["code"] == code), "{file}: {findings:#?}");
    }
}

/// The cost of a drawing grows with its length, and not with its square.
#[test]
fn a_drawing_of_300_000_subpaths_is_refused_at_once() {
    for body in ["<path d=\"{}\"/>", "<g>{}</g>"] {
        let piece = if body.contains("d=") { "M0 0L1 1" } else { "<circle transform=\"\" r=\"1\"/>" };
        let findings = forged("sheet-1-seal.svg", |svg| {
            let more = body.replace("{}", &piece.repeat(300_000));
            svg.replacen("</g>", &format!("{more}</g>"), 1)
        });
        assert!(!findings.is_empty());
    }
}
