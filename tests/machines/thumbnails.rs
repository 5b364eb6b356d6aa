//! Pictures in the header of programs: complete, and only where the profile requests them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use stargrip_cam::pipeline::read_back;
use stargrip_cam::spec::{Source, read_machine};

use crate::png::read_png;
use crate::{built, profile, spec_text, text};

const SEAL: &str = "star-1-seal.gcode";

fn with_pictures(name: &str) -> String {
    let text = profile(name);
    assert!(text.contains("thumbnails = false"));
    text.replace("thumbnails = false", "thumbnails = true")
}

/// The stated sizes, with the characters between them.
fn pictures(program: &str) -> Vec<(String, String)> {
    let mut list = Vec::new();
    let mut lines = program.lines();
    while let Some(line) = lines.next() {
        if let Some(size) = line.strip_prefix("; thumbnail begin ") {
            let body = lines.by_ref().take_while(|line| *line != "; thumbnail end");
            list.push((
                size.to_owned(),
                body.map(|line| line.strip_prefix("; ").expect("a comment")).collect(),
            ));
        }
    }
    list
}

#[test]
fn a_host_finds_two_pictures_of_their_sizes() {
    for name in ["generic", "klipper", "reprapfirmware"] {
        let build = built(&spec_text(""), &with_pictures(name));
        assert_eq!(read_back(&build.output_files()).findings, [], "{name}");
        for file in [SEAL, "star-1-trace.gcode"] {
            let program = text(&build, file);
            let found_pictures = pictures(&program);
            let expected: Vec<String> = found_pictures
                .iter()
                .zip([32, 300])
                .map(|((_, body), side)| format!("{side}x{side} {}", body.len()))
                .collect();
            assert_eq!(
                found_pictures.iter().map(|(size, _)| size.clone()).collect::<Vec<_>>(),
                expected,
                "{name}: {file}"
            );
            for ((_, body), side) in found_pictures.iter().zip([32, 300]) {
                let raster = read_png(&STANDARD.decode(body).expect("base64")).expect("a PNG");
                assert_eq!((raster.width, raster.height), (side, side), "{name}: {file}");
                let [corner, middle] = [0, side / 2].map(|at| raster.pixel(at, side / 8));
                assert!(corner.is_some() && middle.is_some(), "{name}: {file}");
            }
            assert!(program.len() < 600_000 && program.lines().all(|line| line.len() <= 72), "{name}");
        }
    }
}

#[test]
fn pictures_in_parentheses_are_refused() {
    let text = with_pictures("generic").replace("comments = \"semicolon\"", "comments = \"parentheses\"");
    let faults = read_machine(&Source::new("machine", &text)).expect_err("no host reads them");
    assert!(faults.to_string().contains("hosts read pictures only from comments with `;`"), "{faults}");
}
