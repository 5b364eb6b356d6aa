//! The directories that are edited: together every kind of file, steady and chopped, in five dialects.

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::manifest::MANIFEST;
use stargrip_cam::pipeline::{Sources, build};
use stargrip_cam::spec;
use stargrip_cam::spec::Machine;
use stargrip_cam::verify::OutputFiles;

use crate::support;

/// A directory as it was published: names and contents.
pub(crate) type Directory = Vec<(String, Vec<u8>)>;

/// A small gripper on a machine of this name, with further sections.
fn small(machine: &str, chop: &str, rest: &str) -> String {
    format!(
        "schema = 1\nname = \"small\"\n[star]\npoints = 4\ninner_radius = \"12 mm\"\ntube_width = \"10 mm\"\n\
         tip_angle = \"40 deg\"\n[machine]\nprofile = \"{machine}\"\n{chop}{rest}"
    )
}

/// The directories that are edited.
pub(crate) fn directories() -> Vec<Directory> {
    let chop = "feed_floor = \"chop\"\n";
    let load = "[load]\npressure = \"37 kPa\"\n";
    let specs = [
        (format!("{}\n[mask]\nmirror = true\n", support::PAPER), "generic"),
        (small("klipper", "", "[stack]\ncount = 2\n"), "klipper"),
        (small("grbl", chop, ""), "grbl"),
        (small("marlin", chop, "[seal]\nband = \"1.5 mm\"\n"), "marlin"),
        (small("reprapfirmware", "", load), "reprapfirmware"),
    ];
    let published = |(text, machine): (String, &str)| {
        let profile = spec::builtin_machine(machine).expect("built in");
        let sources = Sources { spec: &text, machine: profile };
        let machine = Machine::builtin(machine).expect("built in");
        let built =
            build(&support::read(&text), &machine, sources, &KindRequest::default()).expect("a gripper");
        built.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
    };
    specs.into_iter().map(published).collect()
}

/// A directory as the verifier sees it.
pub(crate) fn output_files(files: &Directory) -> OutputFiles<'_> {
    files.iter().map(|(name, bytes)| (name, bytes)).collect()
}

/// A kind of file, as the table has it.
pub(crate) fn kind_of(name: &str) -> &str {
    match name {
        "spec.toml" | "machine.toml" | MANIFEST => name,
        "prediction.json" => "prediction",
        _ if name.contains("preview") => "preview",
        _ => name.rsplit_once('.').map_or(name, |(_, ending)| ending),
    }
}
