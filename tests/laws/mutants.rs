//! Junk grown from real files: no reader panics on it, whatever bytes change.
//!
//! Every output of a shipped gripper and every spec is a seed; bytes are flipped, pieces cut out, doubled, swapped with other
//! seeds and words of the formats put in. The default is a short run that is the same every time;
//! `STARGRIP_MUTANTS=200000 cargo test --release --test laws mutants::` looks further, `STARGRIP_MUTANTS_SEED=7` elsewhere.

use std::path::Path;
use std::{env, fs};

use crate::support;
use crate::support::dice::Dice;
use stargrip_cam::pipeline::read_back;
use stargrip_cam::spec;
use stargrip_cam::spec::Source;
use stargrip_cam::verify::gcode::{Dialect, read_program};
use stargrip_cam::verify::{SvgOrigin, read_dxf, read_svg};

/// Words with a meaning for one of the readers.
const WORDS: [&[u8]; 24] = [
    b"1e308",
    b"-0",
    b"nan",
    b"99999999999999999999",
    b"\n",
    b"\r\n",
    b"\"",
    b"<",
    b"</svg>",
    b"&#0;",
    b"A1 1 0 1 1 ",
    b"G2 X0 Y0 I0 J0\n",
    b"M98 P1\n",
    b"N",
    b";",
    b"  0\nEOF\n",
    b" 42\n1e9\n",
    b"<<",
    b">>",
    b"[",
    b"stream\n",
    b" 0 R",
    b"[[stack.star]]\n",
    b"\xff\xfe",
];

fn number(name: &str, default: u64) -> u64 {
    env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

/// (name, content) of every seed: the files of two grippers, the shipped specs, the machine profile.
fn read_seeds() -> Vec<(String, Vec<u8>)> {
    let designs = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let mut paths: Vec<_> = fs::read_dir(designs)
        .expect("designs/")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .collect();
    paths.sort();
    let mut list = Vec::new();
    for path in paths {
        let text = fs::read_to_string(&path).expect("a design");
        if path.ends_with("conical-stack.toml") || path.ends_with("paper-five-points.toml") {
            let build = support::build(&text).expect("a design that can be made");
            list.extend(build.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())));
        }
        list.push(("spec.toml".to_owned(), text.into_bytes()));
    }
    list
}

fn mutate(seed: &[u8], other: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut mutant = seed.to_vec();
    for _ in 0..=dice.below(4) {
        let length = mutant.len();
        match dice.below(6) {
            0 if length > 0 => {
                let place = dice.below(length);
                mutant[place] ^= 1 << dice.below(8);
            }
            1 => {
                let _ = mutant.drain(dice.stretch(length, 200)).count();
            }
            2 => {
                let piece = mutant[dice.stretch(length, 200)].to_vec();
                let place = dice.below(length + 1);
                let _ = mutant.splice(place..place, piece).count();
            }
            3 => {
                let piece = other[dice.stretch(other.len(), 200)].to_vec();
                let range = dice.stretch(length, 200);
                let _ = mutant.splice(range, piece).count();
            }
            4 => mutant.truncate(dice.below(length + 1)),
            _ => {
                let word = WORDS[dice.below(WORDS.len())];
                let range = dice.stretch(length, 8);
                let _ = mutant.splice(range, word.iter().copied()).count();
            }
        }
    }
    mutant
}

/// Reads `bytes` in the format of `name`.
fn read(name: &str, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    match ending {
        "toml" => {
            if let Ok(source) = Source::from_bytes(name, bytes) {
                match name {
                    "machine.toml" => drop(spec::read_machine(&source).map_err(|faults| faults.to_string())),
                    _ => drop(spec::read(&source).map_err(|faults| faults.to_string())),
                }
            }
        }
        "gcode" => drop(read_program(&text, Dialect::GENERIC)),
        "svg" => {
            for origin in [SvgOrigin::Axis, SvgOrigin::LowerLeft] {
                let drawing = read_svg(&text, origin);
                let length: f64 =
                    drawing.layers.values().flatten().map(stargrip_cam::geom::Path::length).sum();
                assert!(length.is_finite());
            }
        }
        "dxf" => {
            let drawing = read_dxf(&text);
            let length: f64 = drawing.layers.values().flatten().map(stargrip_cam::geom::Path::length).sum();
            assert!(length.is_finite());
        }
        _ => {}
    }
}

#[test]
fn no_reader_panics_on_mutants() {
    let seeds = read_seeds();
    let mut dice = Dice(number("STARGRIP_MUTANTS_SEED", 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    for _ in 0..number("STARGRIP_MUTANTS", 1_500) {
        let (name, seed) = &seeds[dice.below(seeds.len())];
        let (_, other) = &seeds[dice.below(seeds.len())];
        read(name, &mutate(seed, other, &mut dice));
    }
}

/// The proof of a whole directory with one mutant in it always ends, and never without a finding.
#[test]
fn a_mutant_in_a_directory_is_found() {
    let build = support::build(support::PAPER).expect("a design");
    let mut dice = Dice(number("STARGRIP_MUTANTS_SEED", 1).wrapping_mul(0x2545_f491_4f6c_dd1d) | 1);
    for _ in 0..number("STARGRIP_MUTANTS", 1_500) / 50 {
        let mut archive = build.output_files();
        let index = dice.below(archive.files.len());
        let (name, seed) = archive.files[index].clone();
        let mutant = mutate(&seed, &seed, &mut dice);
        if mutant == *seed || name == "manifest.json" {
            continue;
        }
        archive.files[index].1 = mutant.into();
        assert!(!read_back(&archive).findings.is_empty(), "{name}");
    }
}
