//! `stargrip-cam verify`

use std::fmt::Write;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::cli::failure::{Failure, say, shown};
use crate::verify;
use crate::verify::OutputFiles;

/// Arguments of `verify`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The directory that a build published.
    dir: PathBuf,
    /// Print one JSON object and nothing else.
    #[arg(long)]
    json: bool,
}

/// Largest file that is read back, bytes: far above what a build writes, far below what hurts.
const FILE_LIMIT: u64 = 1 << 30;

/// Reads the directory and proves it.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let proof = verify::prove_files(&read_directory(&args.dir)?);
    if args.json {
        let deviation: serde_json::Map<String, serde_json::Value> =
            proof.deviations.iter().map(|(file, mm)| (file.clone(), json!(mm))).collect();
        say(&format!("{:#}\n", json!({ "findings": proof.findings, "deviation_mm": deviation })))?;
    } else {
        let mut text = String::new();
        for (file, mm) in &proof.deviations {
            let _ = writeln!(text, "{:28} within {mm:.6} mm", shown(file));
        }
        for finding in &proof.findings {
            let _ = writeln!(text, "{}", shown(finding.to_string()));
        }
        let verdict = match proof.findings.len() {
            0 => "proven, no findings".to_owned(),
            n => format!("{n} findings"),
        };
        let _ = writeln!(text, "{}: {verdict}", shown(&args.dir));
        say(&text)?;
    }
    if proof.findings.is_empty() { Ok(()) } else { Err(Failure::Said) }
}

fn read_directory(dir: &Path) -> Result<OutputFiles<'static>, Failure> {
    let mut files = Vec::new();
    let entries = fs::read_dir(dir).map_err(|error| Failure::file("read", dir, &error))?;
    for entry in entries {
        let entry = entry.map_err(|error| Failure::file("read", dir, &error))?;
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        let mut bytes = Vec::new();
        // An entry that cannot be read as a file is kept as an empty one: the proof will say that it is wrong.
        if entry.file_type().is_ok_and(|kind| kind.is_file()) {
            let _ = fs::File::open(&path)
                .and_then(|file| file.take(FILE_LIMIT).read_to_end(&mut bytes))
                .map_err(|error| Failure::file("read", &path, &error))?;
        }
        files.push((name.into(), bytes.into()));
    }
    files.sort();
    Ok(OutputFiles { files })
}
