//! Golden files: every output of every shipped design; and the release program writes the same bytes.
//!
//! Four designs that have every feature between them are kept whole: `snapshots/<design>/` holds the files of a build. The
//! others have a digest, `snapshots/<design>.digest.snap`: a line a file, with its hash and the figures that the verifier reads
//! out of it, so that a person sees the changes. `INSTA_UPDATE=always` renews all of them.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use stargrip_cam::artifact::{Kind, KindRequest, Output, OutputPart};
use stargrip_cam::design::Paper;
use stargrip_cam::geom::{Bounds, Path as Curve};
use stargrip_cam::manifest::sha256;
use stargrip_cam::pipeline::{Built, Sources};
use stargrip_cam::spec::{KeyPath, Machine, Setting, Source, key};
use stargrip_cam::verify::gcode::{self, MoveKind};
use stargrip_cam::verify::{Drawing, SvgOrigin, read_dxf, read_stl, read_svg};
use stargrip_cam::{pipeline, spec};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The designs whose files are kept byte for byte.
const WHOLE: [&str; 4] = ["every-feature", "laser", "paper-five-points", "paper-gripper"];

/// (name, text) of every design, sorted by name.
fn designs() -> Vec<(String, String)> {
    let folder = |name: &str| fs::read_dir(Path::new(ROOT).join(name)).expect("designs/");
    let mut designs: Vec<(String, String)> = folder("designs")
        .chain(folder("designs/drawings"))
        .chain(folder("designs/press"))
        .chain(folder("tests/golden"))
        .map(|entry| entry.expect("an entry").path())
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

/// The kinds that come on request only. Their numbers are rounded from singles: their bytes are the same in debug and in release.
#[test]
fn the_extra_kinds_are_golden() {
    let text = fs::read_to_string(Path::new(ROOT).join("designs/paper-gripper.toml")).expect("a design");
    let extras: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_extra()).collect();
    let (build, _) = build_with(&text, &extras);
    let files = build.artifacts.iter().filter(|file| file.output.kind.is_extra());
    let digests: Vec<String> = files.map(|file| format!("{} {}", file.name, sha256(&file.bytes))).collect();
    for extra in extras {
        assert!(build.artifacts.iter().any(|file| file.output.kind == extra), "no {extra}");
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new(ROOT).join("snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("extras.digest", digests.join("\n")));
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
            let sheet = name.starts_with("sheet") || name.starts_with("paper");
            on_layers(read_svg(text(), if sheet { SvgOrigin::LowerLeft } else { SvgOrigin::Axis }))
        }
        "dxf" => on_layers(read_dxf(text())),
        "gcode" => {
            let program = gcode::read_program(text(), gcode::Dialect::new(machine.controller.dialect));
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

/// What distinguishes a file from others of its kind: the part that it shows, its paper, its face, and whether it is a tile of a mask.
fn features(output: &Output) -> [String; 4] {
    let Output { kind, part, tile, paper, mirrored, .. } = *output;
    let part = match part {
        OutputPart::Design => "the design",
        OutputPart::Sheet(_) => "a sheet",
        OutputPart::Star { .. } => "a star",
        OutputPart::Piece { .. } => "a piece",
        OutputPart::Plate(_) => "a plate",
        OutputPart::Paper(_) => "a sheet of paper",
    };
    [
        format!("{kind} of {part}"),
        format!("{kind} on {:?}", paper.and_then(Paper::name)),
        format!("{kind}, mirrored {mirrored}"),
        format!("{kind}, a tile {}", tile.is_some()),
    ]
}

/// Every kind that comes by default is golden, and those of stars are byte for byte: in all their features.
#[test]
fn the_whole_designs_have_every_feature() {
    let (mut kinds, mut all, mut whole) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
    for (name, text) in designs() {
        let build = build(&text).0;
        let outputs = build.artifacts.iter().map(|file| &file.output);
        kinds.extend(outputs.clone().map(|output| output.kind));
        if build.manifest.masks.is_empty() {
            continue;
        }
        let found = outputs.flat_map(features).collect::<Vec<_>>();
        if WHOLE.contains(&name.as_str()) {
            whole.extend(found.iter().cloned());
        }
        all.extend(found);
    }
    let missing: Vec<&Kind> =
        Kind::ALL.iter().filter(|kind| !kind.is_extra() && !kinds.contains(kind)).collect();
    assert!(missing.is_empty(), "no golden file of {missing:?}");
    let missing: Vec<&String> = all.difference(&whole).collect();
    assert!(missing.is_empty(), "not in {WHOLE:?}: {missing:?}");
}

/// Sections whose keys change the files of stars.
const OF_FILES: [&str; 9] = ["star", "stack", "inlet", "seal", "mask", "frame", "cut", "sheet", "machine"];

/// Keys of these sections that no golden design of stars sets: only drawings have them, they leave something out, or tests/design/cuts.rs
/// sets them.
const NOT_SET: [KeyPath; 5] =
    [key::inlet::NONE, key::mask::KIND, key::sheet::COPIES, key::sheet::TURN, key::cut::BLADE_OFFSET];

/// The key under which single stars differ.
const SINGLE_STARS: &str = "stack.star";

/// Whether `settings` have the key of `setting` with its value.
fn is_among(setting: &Setting, settings: &[Setting]) -> bool {
    settings.iter().any(|other| other.is_same_key(setting) && other.value == setting.value)
}

/// A key that no golden design sets could be lost between the spec and a program.
#[test]
fn every_key_that_changes_files_is_set_in_a_golden_design() {
    let sources: Vec<Source> = designs().into_iter().map(|(name, text)| Source::new(name, text)).collect();
    let starter = Source::new("starter", spec::starter("x").expect("a name"));
    let defaults = spec::form_settings(&starter);
    let keys_set: BTreeSet<String> = sources
        .iter()
        .flat_map(spec::form_settings)
        .filter(|setting| setting.given && !is_among(setting, &defaults))
        .map(|setting| format!("{}.{}", setting.section, setting.key))
        .collect();
    let names = key::ALL.iter().filter(|key| OF_FILES.contains(&key.section()) && !NOT_SET.contains(key));
    let missing: Vec<String> = names
        .map(ToString::to_string)
        .filter(|name| name != SINGLE_STARS && !keys_set.contains(name))
        .collect();
    assert!(missing.is_empty(), "set in tests/golden/every-feature.toml or laser.toml: {missing:?}");
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
