//! One fault at a time in paper, solids, masks and plates, with a manifest that covers it up; each is found.

use stargrip_cam::artifact::Artifact;
use stargrip_cam::manifest::ManifestFile;
use stargrip_cam::pipeline::{Built, prove_files, read_back};
use stargrip_cam::verify::Finding;

use crate::support;

fn build_paper() -> Built {
    support::build(support::PAPER).expect("a design")
}

/// The findings if the content of `file` is changed and the manifest agrees.
fn forged(file: &str, change: impl Fn(&[u8]) -> Vec<u8>) -> Vec<Finding> {
    forged_in(build_paper(), file, change)
}

fn forged_in(mut build: Built, file: &str, change: impl Fn(&[u8]) -> Vec<u8>) -> Vec<Finding> {
    let artifact: &mut Artifact =
        build.artifacts.iter_mut().find(|artifact| artifact.name == file).expect("a file");
    let bytes = change(&artifact.bytes);
    assert_ne!(artifact.bytes, bytes, "nothing was forged");
    artifact.bytes = bytes;
    build.manifest.files = build.artifacts.iter().map(ManifestFile::new).collect();
    read_back(&build.output_files()).findings
}

#[track_caller]
fn assert_found(file: &str, code: &str, change: impl Fn(&[u8]) -> Vec<u8>) {
    let findings = forged(file, change);
    let is_found = findings.iter().any(|finding| finding.code == code && finding.file == file);
    assert!(is_found, "no {code} for {file} in {findings:#?}");
}

/// Replaces the first `from` after `anchor` by a text of the same length, so that offsets still hold.
fn swap<'a>(anchor: &'a str, from: &'a str, to: &'a str) -> impl Fn(&[u8]) -> Vec<u8> + 'a {
    assert_eq!(from.len(), to.len());
    move |bytes| {
        let find = |needle: &[u8], start: usize| {
            let place = bytes[start..].windows(needle.len()).position(|window| window == needle);
            start + place.expect("what is to be forged")
        };
        let place = find(from.as_bytes(), find(anchor.as_bytes(), 0));
        let mut forged = bytes.to_vec();
        forged[place..place + to.len()].copy_from_slice(to.as_bytes());
        forged
    }
}

const PAPER: &str = "star-1-mask-a4.pdf";

/// Nothing reads pages: a page that is not the one of this version is a finding whatever it shows.
#[test]
fn paper_that_is_not_the_written_one_is_found() {
    for change in [
        swap("stream", "2.8346457", "2.8000000"),
        swap("/MediaBox", "595.2756 841.8898", "612.0000 792.0000"),
        swap("/mask-plate BMC", "\nS\n", "\nn\n"),
        swap("/PrintScaling", "/None", "/Nine"),
    ] {
        let mut build = build_paper();
        let page = build.artifacts.iter_mut().find(|artifact| artifact.name == PAPER).expect("a page");
        page.bytes = change(&page.bytes);
        build.manifest.files = build.artifacts.iter().map(ManifestFile::new).collect();
        let findings = prove_files(&build.output_files()).findings;
        let is_found = findings.iter().any(|finding| finding.code == "differs" && finding.file == PAPER);
        assert!(is_found, "{findings:#?}");
    }
}

const SOLID: &str = "star-1-mask.stl";

/// Changes facet `i` of a solid: 12 numbers.
fn facet(i: usize, change: impl Fn(&mut [f32])) -> impl Fn(&[u8]) -> Vec<u8> {
    move |bytes| {
        let start = 84 + 50 * i;
        let mut numbers: Vec<f32> = bytes[start..start + 48]
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes(b.try_into().expect("four")))
            .collect();
        change(&mut numbers);
        let mut forged = bytes.to_vec();
        for (slot, number) in forged[start..start + 48].chunks_exact_mut(4).zip(numbers) {
            slot.copy_from_slice(&number.to_le_bytes());
        }
        forged
    }
}

#[test]
fn solids_with_holes_turned_or_moved_facets_are_found() {
    assert_found(SOLID, "not-watertight", facet(0, |n| n[3] += 0.01));
    // A facet turned inside out.
    assert_found(SOLID, "not-watertight", facet(5, |n| (0..3).for_each(|k| n.swap(3 + k, 6 + k))));
    assert_found(SOLID, "bad-stl", facet(3, |n| n[4] = f32::NAN));
    assert_found(SOLID, "bad-stl", |bytes| bytes[..bytes.len() - 1].to_vec());
    // One millimetre becomes one inch, or the whole moves: closed, but elsewhere.
    let moved = |scale: f32, shift: f32| {
        move |bytes: &[u8]| {
            let mut forged = bytes.to_vec();
            let count = (bytes.len() - 84) / 50;
            for i in 0..count {
                let change = facet(i, |n| n[3..].iter_mut().for_each(|x| *x = *x * scale + shift));
                forged = change(&forged);
            }
            forged
        }
    };
    assert_found(SOLID, "wrong-volume", moved(1.01, 0.0));
    assert_found(SOLID, "deviation", moved(1.0, 0.1));
}

/// The bytes with every corner and normal changed alike.
fn every_corner(bytes: &[u8], change: impl Fn(&mut [f32])) -> Vec<u8> {
    let count = (bytes.len() - 84) / 50;
    (0..count)
        .fold(bytes.to_vec(), |out, i| facet(i, |n| n.chunks_exact_mut(3).skip(1).for_each(&change))(&out))
}

/// A face that is sunk in, and a mask of the other side.
#[test]
fn solids_with_a_sunken_face_or_of_another_side_are_found() {
    // A triangle of the upper face, without the walls down to it.
    assert_found(SOLID, "not-watertight", facet(0, |n| [5, 8, 11].iter().for_each(|z| n[*z] -= 0.4)));
    // The whole upper face: closed, but thinner.
    let sunk = |bytes: &[u8]| every_corner(bytes, |p| p[2] = if p[2] > 1.0 { 1.6 } else { 0.0 });
    assert_found(SOLID, "deviation", sunk);
    let other =
        support::build(&support::PAPER.replace("[star]", "[mask]\nmirror = true\n[star]")).expect("a design");
    let file = "star-1-mask-mirrored.stl";
    let mirrored =
        other.artifacts.iter().find(|artifact| artifact.name == file).expect("a file").bytes.clone();
    assert_found(SOLID, "deviation", |_| mirrored.clone());
    assert_found(SOLID, "wrong-title", |_| mirrored.clone());
}

const BED: &str = "[mask]\nbed = \"220 mm x 220 mm\"\n[star]";

/// Pieces as the design has them, one of which is out of place: no file alone shows it.
#[test]
fn pieces_that_do_not_go_together_are_found() {
    let divided = || support::build(&support::PAPER.replace("[star]", BED)).expect("a design");
    assert_eq!(read_back(&divided().output_files()).findings, []);
    let file = "star-1-mask-piece-2.stl";
    let moved = |by: f32| move |bytes: &[u8]| every_corner(bytes, |p| p[0] += by);
    let joints = |findings: &[Finding]| findings.iter().any(|finding| finding.code == "wrong-joint");
    assert!(joints(&forged_in(divided(), file, moved(0.3))));
    assert!(!joints(&forged_in(divided(), file, moved(0.001))));
    let gripper = divided();
    let mut files = gripper.output_files();
    files.files.retain(|(name, _)| name != file);
    assert!(joints(&read_back(&files).findings));
}

#[test]
fn masks_and_plates_of_another_size_are_found() {
    let replace = |from: &'static str, to: &'static str| {
        move |bytes: &[u8]| {
            String::from_utf8(bytes.to_vec()).expect("text").replacen(from, to, 1).into_bytes()
        }
    };
    for (file, from, to, code) in [
        ("plate-1-frame.svg", "r=\"55\"", "r=\"55.002\"", "deviation"),
        ("plate-1-frame.dxf", " 40\n55\n", " 40\n55.002\n", "deviation"),
        ("star-1-mask.svg", "r=\"1.5\"", "r=\"1.503\"", "deviation"),
        ("star-1-mask.dxf", " 40\n1.5\n", " 40\n1.503\n", "deviation"),
        ("star-1-mask.svg", "mask-window", "mask-winnow", "unknown-layer"),
        ("star-1-mask.svg", " Z", "", "open-loop"),
    ] {
        assert_found(file, code, replace(from, to));
    }
}

#[test]
fn posts_and_plates_of_another_number_or_length_are_found() {
    for change in [
        |build: &mut Built| build.manifest.posts[0].length_mm += 1.0,
        |build: &mut Built| build.manifest.posts[0].count += 1,
        |build: &mut Built| build.manifest.plates.clear(),
        |build: &mut Built| build.manifest.stars[0].clear_radius_mm += 0.1,
    ] {
        let mut build = build_paper();
        change(&mut build);
        let findings = read_back(&build.output_files()).findings;
        assert!(findings.iter().any(|finding| finding.code == "manifest"), "{findings:#?}");
    }
}

#[test]
fn a_mask_of_the_other_face_is_no_mask_of_this_one() {
    let text = format!("{}\n[mask]\nmirror = true\n", support::PAPER);
    let mut build = support::build(&text).expect("a design");
    let index_of =
        |name: &str| build.artifacts.iter().position(|artifact| artifact.name == name).expect("a mask");
    let (first, other) = (index_of("star-1-mask.svg"), index_of("star-1-mask-mirrored.svg"));
    let bytes = build.artifacts[first].bytes.clone();
    build.artifacts[first].bytes = std::mem::replace(&mut build.artifacts[other].bytes, bytes);
    build.manifest.files = build.artifacts.iter().map(ManifestFile::new).collect();
    let findings = read_back(&build.output_files()).findings;
    for name in ["star-1-mask.svg", "star-1-mask-mirrored.svg"] {
        assert!(findings.iter().any(|f| f.code == "deviation" && f.file == name), "{findings:#?}");
    }
}

/// Replaces the first `from` of a text.
fn replaced<'a>(from: &'a str, to: &'a str) -> impl Fn(&[u8]) -> Vec<u8> + 'a {
    move |bytes| {
        let text = String::from_utf8(bytes.to_vec()).expect("text");
        assert!(text.contains(from), "no {from:?}");
        text.replacen(from, to, 1).into_bytes()
    }
}

/// Other programs read attributes that a reader of shapes passes over.
#[test]
fn what_hides_moves_or_widens_a_drawing_is_found() {
    for file in ["sheet-1-outline.svg", "sheet-1-seal.svg", "star-1-mask.svg", "plate-1-frame.svg"] {
        for (from, to, code) in [
            ("<svg ", "<svg style=\"transform:scale(1.2)\" ", "unknown-word"),
            ("<svg ", "<svg x=\"10\" ", "unknown-word"),
            ("<svg ", "<svg onload=\"alert(1)\" ", "unknown-word"),
            ("<svg ", "<svg preserveAspectRatio=\"none\" ", "unknown-word"),
            ("<svg ", "<?xml-stylesheet href=\"a.css\"?><svg ", "unknown-word"),
            ("<title>", "<style>path{display:none}</style><title>", "unknown-word"),
            ("</title>", "</title><!-- note -->", "unknown-word"),
            ("</title>", "</title>words", "unknown-word"),
            ("<title>", "<title>not ", "wrong-title"),
            (" id=", " display=\"none\" id=", "unknown-word"),
            (" id=", " clip-path=\"url(#a)\" id=", "unknown-word"),
            ("fill=\"none\"", "fill=\"black\"", "unknown-word"),
            ("fill=\"none\" ", "", "unknown-word"),
            ("stroke-width=\"1\"", "stroke-width=\"30\"", "unknown-word"),
            ("stroke-width=\"1\" ", "", "unknown-word"),
            ("non-scaling-stroke;", "non-scaling-stroke;display:none;", "unknown-word"),
            ("inkscape:groupmode=\"layer\" ", "", "unknown-word"),
            (
                "inkscape:groupmode=\"layer\" ",
                "inkscape:groupmode=\"layer\" inkscape:collect=\"always\" ",
                "unknown-word",
            ),
            ("inkscape:label=\"", "inkscape:label=\"not-", "unknown-word"),
            ("/namespaces/inkscape", "/namespaces/other", "unknown-word"),
            ("stroke=\"#", "stroke=\"#1", "unknown-word"),
            ("viewBox=\"", "viewBox=\"1", "wrong-size"),
        ] {
            assert_found(file, code, replaced(from, to));
        }
    }
    let holes_last = |bytes: &[u8]| {
        let text = String::from_utf8(bytes.to_vec()).expect("text");
        let (head, rest) = text.split_at(text.find("<g ").expect("groups"));
        let body = rest.strip_suffix("</svg>\n").expect("an end");
        let groups: Vec<&str> = body.split_inclusive("</g>\n").collect();
        let turned: String = groups.iter().rev().copied().collect();
        format!("{head}{turned}</svg>\n").into_bytes()
    };
    assert_found("sheet-1-outline.svg", "order", holes_last);
}

#[test]
fn what_hides_moves_or_widens_a_plan_is_found() {
    for file in ["sheet-1-outline.dxf", "sheet-1-seal.dxf", "star-1-mask.dxf", "plate-1-frame.dxf"] {
        for (from, to) in [
            ("100\nAcDbEntity\n  8\n", "100\nAcDbEntity\n 60\n1\n  8\n"),
            ("100\nAcDbEntity\n  8\n", "100\nAcDbEntity\n 67\n1\n  8\n"),
            ("$MEASUREMENT\n 70\n1\n", "$MEASUREMENT\n 70\n0\n"),
            ("$EXTMAX\n 10\n", "$EXTMAX\n 10\n1"),
            ("AcDbLayerTableRecord\n  2\n0\n 70\n0\n", "AcDbLayerTableRecord\n  2\n0\n 70\n1\n"),
            (" 62\n", " 62\n-"),
            ("  0\nEOF\n", "999\nnote\n  0\nEOF\n"),
            ("  2\nENTITIES\n", "  2\nENTITIES\n  0\nTEXT\n  8\nlabel\n  1\nTHIS SIDE DOWN\n"),
        ] {
            assert_found(file, "unknown-word", replaced(from, to));
        }
    }
    for (from, to) in [
        ("AcDbPolyline\n", "AcDbPolyline\n 38\n100\n"),
        ("AcDbPolyline\n", "AcDbPolyline\n 43\n20\n"),
        ("AcDbPolyline\n", "AcDbPolyline\n 39\n1\n"),
    ] {
        assert_found("sheet-1-seal.dxf", "unknown-word", replaced(from, to));
    }
}

#[test]
fn solids_with_other_normals_notes_or_corners_are_found() {
    assert_found(SOLID, "bad-stl", facet(0, |n| n[2] = -n[2]));
    assert_found(SOLID, "bad-stl", facet(7, |n| n[0] += 0.01));
    let byte = |at: usize| {
        move |bytes: &[u8]| {
            let mut forged = bytes.to_vec();
            forged[at] ^= 1;
            forged
        }
    };
    assert_found(SOLID, "wrong-title", byte(3));
    assert_found(SOLID, "bad-stl", byte(84 + 49));
    // One corner, in all of its facets.
    let moved = |bytes: &[u8]| {
        let corner = bytes[84 + 12..84 + 20].to_vec();
        let x = f32::from_le_bytes(corner[..4].try_into().expect("four")) + 0.01;
        let mut forged = bytes.to_vec();
        for at in (84..bytes.len()).step_by(50).flat_map(|facet| [12, 24, 36].map(|k| facet + k)) {
            if bytes[at..at + 8] == corner {
                forged[at..at + 4].copy_from_slice(&x.to_le_bytes());
            }
        }
        forged
    };
    assert_found(SOLID, "deviation", moved);
}

/// Every figure and name of a manifest, one at a time; but the version of its tool, which another may have.
#[test]
fn no_figure_of_a_manifest_can_be_edited_unseen() {
    use serde_json::Value;
    fn leaves(value: &Value, path: &str, paths: &mut Vec<String>) {
        match value {
            Value::Object(map) => {
                map.iter().for_each(|(key, value)| leaves(value, &format!("{path}/{key}"), paths));
            }
            Value::Array(list) => {
                list.iter().enumerate().for_each(|(i, value)| leaves(value, &format!("{path}/{i}"), paths));
            }
            _ => paths.push(path.to_owned()),
        }
    }
    let build = build_paper();
    let manifest = serde_json::to_value(&build.manifest).expect("plain data");
    let mut places = Vec::new();
    leaves(&manifest, "", &mut places);
    for place in places.iter().filter(|place| *place != "/tool/version") {
        let mut edited = manifest.clone();
        let leaf = edited.pointer_mut(place).expect("a leaf");
        *leaf = match leaf {
            Value::Number(number) if number.is_u64() => Value::from(number.as_u64().expect("whole") + 1),
            Value::Number(number) => Value::from(number.as_f64().expect("a number") + 0.001),
            _ => Value::from("x"),
        };
        let mut files = build.output_files();
        let last = files.files.last_mut().expect("the manifest");
        last.1 = serde_json::to_vec(&edited).expect("JSON").into();
        assert!(!read_back(&files).findings.is_empty(), "{place}");
    }
    let mut files = build.output_files();
    let mut with_note = manifest.clone();
    let _ = with_note.as_object_mut().expect("an object").insert("note".to_owned(), Value::from("x"));
    files.files.last_mut().expect("the manifest").1 = serde_json::to_vec(&with_note).expect("JSON").into();
    assert!(!read_back(&files).findings.is_empty());
}
