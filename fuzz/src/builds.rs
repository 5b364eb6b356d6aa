//! Small grippers, whose files are edited.

use std::sync::OnceLock;

use stargrip_cam::artifact::{Format, Kind, KindRequest};
use stargrip_cam::pipeline::{Built, Sources, build};
use stargrip_cam::spec;
use stargrip_cam::spec::{Dialect, Machine, Source};
use stargrip_cam::verify::OutputFiles;

/// Names and contents of a directory.
pub(super) type Directory = Vec<(String, Vec<u8>)>;

/// Every profile that comes with the program, one for each dialect.
pub(super) const PROFILES: [&str; Dialect::ALL.len()] = Dialect::WORDS;

/// A gripper that is built in a moment, and that every machine can seal.
pub(super) const SMALL: &str = "schema = 1\nname = \"small\"\n[star]\npoints = 3\ninner_radius = \"12 mm\"\n\
    tube_width = \"10 mm\"\ntip_angle = \"40 deg\"\n[seal]\nspeed = \"10 mm/s\"\n";

/// The same so slow that some have to chop.
pub(super) const CHOPPED: &str = "schema = 1\nname = \"small\"\n[star]\npoints = 3\ninner_radius = \"12 mm\"\n\
    tube_width = \"10 mm\"\ntip_angle = \"40 deg\"\n[machine]\nfeed_floor = \"chop\"\n";

/// The files of `kinds` of a gripper on a built-in machine; all of them if none is named.
pub(super) fn built(spec_text: &str, name: &str, kinds: &[Kind]) -> Built {
    let machine = Machine::builtin(name).expect("built in");
    let section = if spec_text.contains("[machine]") { "" } else { "[machine]\n" };
    let spec_text = format!("{spec_text}{section}profile = \"{name}\"\n");
    let sources = Sources { spec: &spec_text, machine: spec::builtin_machine(name).expect("built in") };
    let spec = spec::read(&Source::new("spec.toml", spec_text.as_str())).expect("valid").spec;
    build(&spec, &machine, sources, &KindRequest::exactly(kinds)).expect("a gripper")
}

/// Directories that hold the programs of every dialect, chopped ones too, then the drawings, then the printed parts, then all.
/// Few files are proven in less time, and more often.
pub(super) fn directories() -> &'static [Directory] {
    static DIRECTORIES: OnceLock<Vec<Directory>> = OnceLock::new();
    DIRECTORIES.get_or_init(|| {
        let of = |formats: &[Format]| -> Vec<Kind> {
            Kind::ALL.iter().copied().filter(|kind| formats.contains(&kind.format())).collect()
        };
        let programs = of(&[Format::Gcode]);
        let mut out: Vec<Built> = PROFILES.iter().map(|name| built(SMALL, name, &programs)).collect();
        out.extend(["grbl", "marlin"].map(|name| built(CHOPPED, name, &programs)));
        out.push(built(SMALL, "generic", &of(&[Format::Svg, Format::Dxf])));
        out.push(built(SMALL, "generic", &of(&[Format::Pdf, Format::Stl])));
        out.push(built(SMALL, "generic", &[]));
        let files = |built: &Built| {
            built.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
        };
        out.iter().map(files).collect()
    })
}

/// A directory as the verifier sees it.
pub(super) fn output_files(files: &Directory) -> OutputFiles<'_> {
    files.iter().map(|(name, bytes)| (name, bytes)).collect()
}
