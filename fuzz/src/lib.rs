//! What the fuzz targets do with the bytes they are given, without the fuzzer: `tests/laws/fuzzed.rs` runs the same functions
//! on the seeds in `corpus/`, so that neither a target nor a case that once failed can be forgotten.
//!
//! Each target asks more than that nothing panics. What is read holds no number that is none, what was accepted says the
//! same when it is written and read again, a message shows no control character, and a proof accepts nothing else than
//! what was built.

mod builds;
mod directory;
mod edits;
mod figures;
mod imports;
mod programs;
mod readers;
mod shown;
mod texts;

/// A name, as in `corpus/`, and what is done with the bytes.
pub type Target = (&'static str, fn(&[u8]));

/// All targets: `fuzz_targets/` has a file for each.
pub const TARGETS: [Target; 13] = [
    ("spec", texts::spec),
    ("machine", texts::machine),
    ("table", texts::table),
    ("gcode", programs::gcode),
    ("resume", programs::resume),
    ("svg", readers::svg),
    ("dxf", readers::dxf),
    ("import-svg", imports::svg),
    ("import-dxf", imports::dxf),
    ("pdf", readers::pdf),
    ("stl", readers::stl),
    ("manifest", figures::manifest),
    ("directory", directory::directory),
];

/// Does what the target called `name` does.
///
/// # Panics
/// If there is none of this name, or if what it asks for does not hold.
pub fn run(name: &str, bytes: &[u8]) {
    let (_, target) = TARGETS.iter().find(|(known, _)| *known == name).expect("a target of this name");
    target(bytes);
}
