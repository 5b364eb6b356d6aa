//! Golden files: every output of every shipped design; and the release program writes the same bytes.
//!
//! Three designs that have every feature between them are kept whole: `snapshots/<design>/` holds the files of a build. The
//! others have a digest, `snapshots/<design>.digest.snap`: a line a file, with its hash and the figures that the verifier reads
//! out of it, so that a person sees the changes. `INSTA_UPDATE=always` renews all of them.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::geom::{Bounds, Path as Curve};
use stargrip_cam::manifest::sha256;
use stargrip_cam::pipeline::{Built, Sources};
use stargrip_cam::spec::{Machine, Source};
use stargrip_cam::verify::gcode::{self, MoveKind};
use stargrip_cam::verify::{Drawing, SvgOrigin, read_dxf, read_stl, read_svg};
use stargrip_cam::{pipeline, spec};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The designs whose files are kept byte for byte.
const WHOLE: [&str; 3] = ["every-feature", "paper-five-points", "paper-gripper"];

/// Endings and words of file names that the whole designs must have between them.
const FEATURES: [&str; 16] = [
    "star-1-seal.gcode",
    "star-3-trace.gcode",
    "sheet-1-seal.gcode",
    "sheet-2-trace.gcode",
    "seal.svg",
    "seal.dxf",
    "outline.svg",
    "outline.dxf",
    "preview.svg",
    "star-2-mask-mirrored-a4.pdf",
    "mask-letter.pdf",
    "mask.stl",
    "mask.dxf",
    "plate-1-frame.svg",
    "plate-3-frame.dxf",
    "prediction.json",
];

/// (name, text) of every design, sorted by name.
fn designs() -> Vec<(String, String)> {
    let folder = |name: &str| fs::read_dir(Path::new(ROOT).join(name)).expect("designs/");
    let mut designs: Vec<(String, String)> = folder("designs")
        .chain(folder("designs/drawings"))
        .map(|entry| entry.expect("an entry").path())
        .chain([Path::new(ROOT).join("tests/golden/every-feature.toml")])
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).expect("a design"))
        })
        .collect();
    designs.sort();
    assert!(WHOLE.iter().all(|whole| designs.iter().any(|(name, _)| name == whole)), "{designs:?}");
    designs
}

fn build(text: &str) -> (Built, Machine) {
    build_with(text, &[])
}

fn build_with(text: &str, with: &[Kind]) -> (Built, Machine) {
    let mut reading = spec::read(&Source::new("design", text)).expect("a valid design");
    if let Some(drawing) = reading.spec.drawing.clone() {
        let file = Path::new(ROOT).join("designs/drawings").join(&drawing.file);
        reading = reading.with_drawing(&fs::read(file).expect("a drawing"));
    }
    let machine_text = spec::builtin_machine(&reading.spec.machine.profile).expect("a built-in profile");
    let machine = spec::read_machine(&Source::new("machine", machine_text)).expect("a valid profile");
    let sources = Sources { spec: text, machine: machine_text };
    let request = KindRequest { with: with.to_vec(), ..KindRequest::default() };
    let build =
        pipeline::build(&reading.spec, &machine, sources, &request).expect("a design that can be made");
    let proof = build.proof();
    assert_eq!(proof.findings, []);
    (build, machine)
}

/// The files of a build; spec and profile are copies of files that are in the repository anyway.
fn files(build: &Built) -> Vec<(String, Vec<u8>)> {
    let files = build
        .files()
        .filter(|(name, _)| !["spec.toml", "machine.toml", "drawing.svg", "drawing.dxf"].contains(name));
    files.map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
}

#[test]
fn every_output_of_every_design_is_golden() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new(ROOT).join("snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let mut changed = Vec::new();
    for (name, text) in designs() {
        let (build, machine) = build(&text);
        let files = files(&build);
        if WHOLE.contains(&name.as_str()) {
            changed.extend(differences(&Path::new(ROOT).join("snapshots").join(&name), &files));
        } else {
            let digest = digest(&files, &machine);
            settings.bind(|| insta::assert_snapshot!(format!("{name}.digest"), digest));
        }
    }
    assert!(changed.is_empty(), "not as they were, see CONTRIBUTING.md: {changed:#?}");
}

/// Pixels are rounded from singles: their bytes are the same in debug and in release.
#[test]
fn a_picture_of_pixels_is_golden() {
    let text = fs::read_to_string(Path::new(ROOT).join("designs/paper-gripper.toml")).expect("a design");
    let reading = spec::read(&Source::new("design", text.as_str())).expect("a valid design");
    let generic = spec::builtin_machine("generic").expect("built in");
    let machine = spec::read_machine(&Source::new("machine", generic)).expect("a valid profile");
    let sources = Sources { spec: &text, machine: generic };
    let request = KindRequest::only(&[Kind::PreviewPng]);
    let build = pipeline::build(&reading.spec, &machine, sources, &request).expect("a design");
    let pictures = build.artifacts.iter().filter(|file| file.output.kind == Kind::PreviewPng);
    let digests: Vec<String> =
        pictures.map(|file| format!("{} {}", file.name, sha256(&file.bytes))).collect();
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new(ROOT).join("snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("preview-png.digest", digests.join("\n")));
}

/// The files of `directory` that are not exactly `files`, by name; none after they were renewed.
fn differences(directory: &Path, files: &[(String, Vec<u8>)]) -> Vec<PathBuf> {
    let here = fs::read_dir(directory).into_iter().flatten().map(|entry| entry.expect("an entry").path());
    let wanted = files.iter().map(|(name, _)| directory.join(name));
    let all: BTreeSet<PathBuf> = here.chain(wanted).collect();
    let right = |path: &Path| files.iter().find(|(name, _)| directory.join(name) == path);
    let differs = |path: &PathBuf| fs::read(path).ok().as_ref() != right(path).map(|(_, bytes)| bytes);
    let mut changed: Vec<PathBuf> = all.into_iter().filter(differs).collect();
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        fs::create_dir_all(directory).expect("a directory");
        for path in changed.drain(..) {
            match right(&path) {
                Some((_, bytes)) => fs::write(&path, bytes).expect("a golden file"),
                None => fs::remove_file(&path).expect("a file that is no longer written"),
            }
        }
    }
    changed
}

/// The lines of a file, as the verifier reads them.
struct Drawn {
    paths: usize,
    length: f64,
    bounds: Bounds,
}

/// A line a file.
fn digest(files: &[(String, Vec<u8>)], machine: &Machine) -> String {
    let mut out = String::new();
    let width = files.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let heads = ["bytes", "paths", "length", "min x", "min y", "max x", "max y"];
    let [bytes, paths, length, x, y, u, v] = heads;
    let _ = writeln!(
        out,
        "{:width$} {bytes:>7} {paths:>6} {length:>11} {x:>9} {y:>9} {u:>9} {v:>9}  sha256",
        "file"
    );
    for (name, bytes) in files {
        let _ = write!(out, "{name:width$} {:>7}", bytes.len());
        match drawn(name, bytes, machine) {
            Some(Drawn { paths, length, bounds: Bounds { min, max } }) => {
                let _ = write!(out, " {paths:>6} {length:>11.3}");
                for x in [min.x, min.y, max.x, max.y] {
                    let _ = write!(out, " {x:>9.3}");
                }
            }
            None => {
                let _ = write!(out, " {:>6} {:>11} {:>9} {:>9} {:>9} {:>9}", "", "", "", "", "", "");
            }
        }
        let _ = writeln!(out, "  {}", sha256(bytes));
    }
    out
}

/// The lines that the verifier's readers find in a file; `None` for files without lines, for pages and for the picture.
fn drawn(name: &str, bytes: &[u8], machine: &Machine) -> Option<Drawn> {
    if name.ends_with("preview.svg") {
        return None;
    }
    let text = || std::str::from_utf8(bytes).expect("text");
    let on_layers = |drawing: Drawing| drawing.layers.into_values().flatten().collect::<Vec<Curve>>();
    let paths: Vec<Curve> = match Path::new(name).extension()?.to_str()? {
        "svg" => {
            let sheet = name.starts_with("sheet");
            on_layers(read_svg(text(), if sheet { SvgOrigin::LowerLeft } else { SvgOrigin::Axis }))
        }
        "dxf" => on_layers(read_dxf(text())),
        "gcode" => {
            let program = gcode::read_program(text(), gcode::Dialect::of(machine.controller.dialect));
            let feeds = program.moves.into_iter().filter(|step| step.kind == MoveKind::Feed);
            feeds.filter_map(|step| Some(Curve::open(vec![step.path?]))).collect()
        }
        "stl" => {
            let facets = read_stl(bytes).expect("a binary STL");
            facets.iter().map(outline).collect()
        }
        _ => return None,
    };
    let bounds = paths.iter().map(Curve::bounds).fold(Bounds::EMPTY, Bounds::union);
    Some(Drawn { paths: paths.len(), length: paths.iter().map(Curve::length).sum(), bounds })
}

/// A facet seen from above.
fn outline(facet: &[[f32; 3]; 3]) -> Curve {
    let corners = facet.map(|[x, y, _]| stargrip_cam::geom::Point::new(f64::from(x), f64::from(y)));
    let side = |i: usize| stargrip_cam::geom::Line::new(corners[i], corners[(i + 1) % 3]).into();
    Curve::closed(vec![side(0), side(1), side(2)])
}

#[test]
fn the_whole_designs_have_every_feature() {
    let designs = designs().into_iter().filter(|(name, _)| WHOLE.contains(&name.as_str()));
    let names: Vec<String> =
        designs.flat_map(|(_, text)| files(&build(&text).0)).map(|(name, _)| name).collect();
    for feature in FEATURES {
        assert!(names.iter().any(|name| name.ends_with(feature)), "no {feature} in {names:?}");
    }
}

/// The files of the program in the release profile; `make check` builds it first.
#[test]
#[ignore = "needs a release build: make check"]
fn the_release_program_writes_these_bytes() {
    let program = Path::new(ROOT).join("target/release/stargrip-cam");
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in designs() {
        let (spec, out) = (folder.path().join(format!("{name}.toml")), folder.path().join(&name));
        fs::write(&spec, &text).expect("written");
        for drawing in fs::read_dir(Path::new(ROOT).join("designs/drawings")).expect("drawings") {
            let drawing = drawing.expect("an entry").path();
            let name = drawing.file_name().expect("a name");
            let _ = fs::copy(&drawing, folder.path().join(name)).expect("copied");
        }
        let mut command = Command::new(&program);
        let _ = command.arg("build").args([&spec, &PathBuf::from("-o"), &out]);
        let built =
            command.args(["-q", "--with", "preview-png"]).output().expect("target/release/stargrip-cam");
        assert!(built.status.success(), "{name}: {}", String::from_utf8_lossy(&built.stderr));
        let here = build_with(&text, &[Kind::PreviewPng]).0;
        let files: Vec<(String, Vec<u8>)> =
            here.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect();
        assert_eq!(fs::read_dir(&out).expect("a directory").count(), files.len(), "{name}");
        for (file, bytes) in files {
            assert!(fs::read(out.join(&file)).expect(&file) == bytes, "{name}/{file} differs in release");
        }
    }
}

#[test]
fn a_second_build_gives_the_same_bytes() {
    for (name, text) in designs() {
        let (first, second) = (build(&text).0, build(&text).0);
        assert!(first.files().eq(second.files()), "{name} differs between two builds");
    }
}
