//! Bad input, hostile names and huge specs are refused without a trace.

use crate::program::{assert_code, files};
use crate::support;
use crate::support::program::{run, stderr};
use std::fs;

#[test]
fn bad_input_is_refused_without_a_trace() {
    let dir = tempfile::tempdir().expect("a directory");
    let with = |from: &str, to: &str| support::PAPER.replace(from, to).into_bytes();
    let mut cases: Vec<Vec<u8>> = vec![
        Vec::new(),
        b"\xff\xfe\x00junk".to_vec(),
        vec![0; 4096],
        b"[[[[[[[[".to_vec(),
        "[".repeat(100_000).into_bytes(),
        format!("a = {}", "[".repeat(50_000)).into_bytes(),
        with("points = 5", "points = 1000000000"),
        with("points = 5", "points = -5"),
        with("points = 5", "points = 5.5"),
        with("points = 5", "points = 99999999999999999999999999"),
    ];
    for value in [
        "nan",
        "inf",
        "-50",
        "1e308",
        "\"nan mm\"",
        "\"inf mm\"",
        "\"-50 mm\"",
        "\"1e300 mm\"",
        "\"1e-300 mm\"",
        "\"0 mm\"",
        "\"5 parsec\"",
        "[]",
        "true",
    ] {
        cases.push(with("\"50 mm\"", value));
        cases.push(with("\"30 mm\"", value));
    }
    for angle in ["\"0 deg\"", "\"180 deg\"", "\"-1 deg\"", "\"1e-9 deg\"", "\"400 deg\""] {
        cases.push(with("\"30 deg\"", angle));
    }
    for (i, case) in cases.iter().enumerate() {
        fs::write(dir.path().join("bad.toml"), case).expect("written");
        let refused = run(dir.path(), &["build", "bad.toml"]);
        assert_code(&refused, 1);
        assert!(!dir.path().join("out").exists(), "case {i}");
        assert!(!stderr(&refused).is_empty());
    }
}

#[test]
fn a_huge_spec_is_refused_without_reading_it() {
    let dir = tempfile::tempdir().expect("a directory");
    fs::File::create(dir.path().join("huge.toml")).and_then(|file| file.set_len(100 << 20)).expect("a hole");
    let refused = run(dir.path(), &["build", "huge.toml"]);
    assert_code(&refused, 1);
    assert!(
        stderr(&refused).contains("1 MiB") || stderr(&refused).contains("1048576"),
        "{}",
        stderr(&refused)
    );
    assert_code(&run(dir.path(), &["build", "."]), 1);
}

#[test]
fn a_hostile_name_is_a_harmless_literal() {
    let dir = tempfile::tempdir().expect("a directory");
    let hostile = [
        "../../etc/passwd",
        "a) G0 Z-50 (",
        "x; M3 S1000",
        "<script>alert(1)</script>",
        "%",
        "é 星",
        "\\\"&]]>",
        "G0 Z-50",
    ];
    for (i, name) in hostile.iter().enumerate() {
        let literal = toml_string(name);
        let spec = support::PAPER.replace("\"paper star, 5 points\"", &literal);
        assert!(spec.contains(&literal));
        fs::write(dir.path().join("star.toml"), spec).expect("written");
        let out = format!("o{i}");
        assert_code(&run(dir.path(), &["build", "star.toml", "-o", &out]), 0);
        assert_code(&run(dir.path(), &["verify", &out]), 0);
        for (file, bytes) in files(&dir.path().join(&out)) {
            let ending = file.rsplit_once('.').map_or("", |(_, ending)| ending);
            if ending == "stl" {
                let head = &bytes[..80];
                let inert = |byte: &u8| byte.is_ascii_alphanumeric() || b" .,-_+=:/".contains(byte);
                assert!(head.iter().all(inert) && !head.starts_with(b"solid"), "{file}: {head:?}");
                continue;
            }
            if ending == "pdf" {
                // The title is the only place for a name; a bracket in it must not end its string.
                let text = String::from_utf8_lossy(&bytes).into_owned();
                let title = text.lines().find(|line| line.contains("/Title")).expect("a title");
                assert!(title.matches(['(', ')', '<', '>', '\\']).count() == 2, "{file}: {title}");
                assert!(!text.contains("/JavaScript") && !text.contains("/OpenAction"), "{file}");
                continue;
            }
            let text = String::from_utf8(bytes).expect("UTF-8");
            if ending == "dxf" {
                assert!(
                    text.is_ascii() && !text.contains("passwd") && !text.contains("script"),
                    "{file}: {name}"
                );
            }
            if ending == "json" {
                let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
                assert_eq!(json["name"], **name, "{file}");
            }
            if ending == "gcode" {
                assert!(text.is_ascii() && !text.contains(['(', ')', '%']), "{file}: {name}");
                assert!(text.lines().all(|line| line.matches(';').count() <= 1), "{file}: {name}");
                assert!(
                    !text
                        .lines()
                        .any(|line| line.starts_with("M3")
                            || line.contains("G0 Z-50") && !line.starts_with(';'))
                );
            }
            if ending == "svg" {
                assert!(!text.contains("<script"), "{file}");
            }
        }
    }
    for name in ["", "a\nG0 Z-50", "tab\there", "é\u{202e}x", &"x".repeat(81)] {
        let spec = support::PAPER.replace("\"paper star, 5 points\"", &toml_string(name));
        fs::write(dir.path().join("star.toml"), spec).expect("written");
        assert_code(&run(dir.path(), &["build", "star.toml", "-o", "no"]), 1);
    }
}

/// A TOML basic string.
fn toml_string(text: &str) -> String {
    let escaped: String = text
        .chars()
        .map(|c| match c {
            '"' | '\\' => format!("\\{c}"),
            c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
            c => c.to_string(),
        })
        .collect();
    format!("\"{escaped}\"")
}
