//! The bodies of the fuzz targets, without the fuzzer: `tests/laws/fuzzed.rs` runs the same functions on the seeds in `corpus/`,
//! so that no target and no case that once failed is left out.
//!
//! Each target checks more than the absence of panics. Every number that was read is finite, an accepted input is the same when
//! it is written and read again, a message shows no control character, and a proof accepts only a real build.

mod builds;
mod directory;
mod edits;
mod figures;
mod imports;
mod programs;
mod readers;
mod shown;
mod texts;

/// A name, as in `corpus/`, and the function for the bytes.
pub type Target = (&'static str, fn(&[u8]));

/// All targets: `fuzz_targets/` has a file for each.
pub const TARGETS: [Target; 12] = [
    ("spec", texts::spec),
    ("machine", texts::machine),
    ("table", texts::table),
    ("gcode", programs::gcode),
    ("resume", programs::resume),
    ("svg", readers::svg),
    ("dxf", readers::dxf),
    ("import-svg", imports::svg),
    ("import-dxf", imports::dxf),
    ("stl", readers::stl),
    ("manifest", figures::manifest),
    ("directory", directory::directory),
];

/// Runs the target called `name`.
///
/// # Panics
/// If there is no target of this name, or if one of its checks fails.
pub fn run(name: &str, bytes: &[u8]) {
    let (_, target) = TARGETS.iter().find(|(known, _)| *known == name).expect("a target of this name");
    target(bytes);
}
