//! Pictures in the head of programs: there where the profile asks for them, whole, and nowhere else.

use stargrip_cam::pipeline::read_back;
use stargrip_cam::spec::{Source, read_machine};

use crate::{built, findings_with, profile, spec_text, text};

const SEAL: &str = "star-1-seal.gcode";

fn with_pictures(name: &str) -> String {
    let text = profile(name);
    assert!(text.contains("thumbnails = false"));
    text.replace("thumbnails = false", "thumbnails = true")
}

/// The sizes that are told, with the characters in between.
fn pictures(program: &str) -> Vec<(String, String)> {
    let mut out = Vec::new();
    let mut lines = program.lines();
    while let Some(line) = lines.next() {
        if let Some(size) = line.strip_prefix("; thumbnail begin ") {
            let body = lines.by_ref().take_while(|line| *line != "; thumbnail end");
            out.push((
                size.to_owned(),
                body.map(|line| line.strip_prefix("; ").expect("a comment")).collect(),
            ));
        }
    }
    out
}

#[test]
fn a_host_finds_two_pictures_and_the_proof_reads_them() {
    for name in ["generic", "klipper", "reprapfirmware"] {
        let build = built(&spec_text(""), &with_pictures(name));
        assert_eq!(read_back(&build.output_files()).findings, [], "{name}");
        for file in [SEAL, "star-1-trace.gcode"] {
            let program = text(&build, file);
            let found = pictures(&program);
            let told: Vec<String> = found
                .iter()
                .zip([32, 300])
                .map(|((_, body), side)| format!("{side}x{side} {}", body.len()))
                .collect();
            assert_eq!(
                found.iter().map(|(size, _)| size.clone()).collect::<Vec<_>>(),
                told,
                "{name}: {file}"
            );
            assert!(program.len() < 600_000 && program.lines().all(|line| line.len() <= 72), "{name}");
        }
    }
}

#[test]
fn a_picture_that_is_none_or_is_not_asked_for_is_found() {
    let build = built(&spec_text(""), &with_pictures("klipper"));
    let program = text(&build, SEAL);
    let codes = |text: &str| -> Vec<&str> {
        findings_with(&build, SEAL, text)
            .iter()
            .filter(|one| one.code == "other-comment")
            .map(|one| one.code)
            .collect()
    };
    let (_, body) = &pictures(&program)[1];
    let line = &body[640..704];
    let turned: String = line.chars().rev().collect();
    for edited in [
        // Its bytes are no PNG any more.
        program.replacen(line, &turned, 1),
        // Another size than it has, or another length.
        program.replacen("begin 300x300", "begin 301x300", 1),
        program.replacen(&format!("300x300 {}", body.len()), &format!("300x300 {}", body.len() - 1), 1),
        // Words between its lines.
        program.replacen("; thumbnail end", "; set the iron to 450 C\n; thumbnail end", 1),
        // It does not end.
        program.replace("; thumbnail end", "; thumbnail fin"),
        // It is there twice, or not at all.
        program.replacen("; thumbnail end", "; thumbnail end\n; thumbnail begin 32x32 0\n; thumbnail end", 1),
        program.replacen("; thumbnail begin 32x32", "; 32x32", 1),
    ] {
        assert_ne!(edited, program);
        assert!(!codes(&edited).is_empty(), "{}", &edited[..3000]);
    }
    // Where the profile asks for none.
    let plain = built(&spec_text(""), profile("klipper"));
    let head =
        program.find("; thumbnail begin").expect("one")..program.rfind("; thumbnail end").expect("one") + 15;
    let old = text(&plain, SEAL);
    let at = old.find("\nG90").expect("the start") + 1;
    let forged = format!("{}{}\n{}", &old[..at], &program[head], &old[at..]);
    assert!(findings_with(&plain, SEAL, &forged).iter().any(|one| one.code == "other-comment"));
}

#[test]
fn pictures_in_parentheses_are_refused() {
    let text = with_pictures("generic").replace("comments = \"semicolon\"", "comments = \"parentheses\"");
    let faults = read_machine(&Source::new("machine", &text)).expect_err("no host reads them");
    assert!(faults.to_string().contains("hosts read pictures behind `;` only"), "{faults}");
}
