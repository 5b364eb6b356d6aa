//! `stargrip-cam verify`

use std::fmt::Write;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::cli::failure::{Failure, say};
use crate::cli::harmless::shown;
use crate::cli::{findings, summary};
use crate::pipeline::prove_files;
use crate::verify::{By, FileProof, OutputFiles, Proof};

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
    let proof = prove_files(&read_directory(&args.dir)?);
    say(&if args.json { json(&proof) } else { text(&args.dir, &proof) })?;
    if proof.findings.is_empty() { Ok(()) } else { Err(Failure::Said) }
}

fn json(proof: &Proof) -> String {
    let deviation: serde_json::Map<String, serde_json::Value> =
        proof.files.iter().map(|file| (file.path.clone(), json!(file.deviation))).collect();
    let proven: Vec<serde_json::Value> =
        proof.files.iter().map(|file| json!({ "path": file.path, "by": file.by })).collect();
    format!("{:#}\n", json!({ "findings": proof.findings, "deviation_mm": deviation, "proven": proven }))
}

fn text(dir: &Path, proof: &Proof) -> String {
    let mut text = String::new();
    for FileProof { path, deviation, by, .. } in &proof.files {
        let how = match by {
            By::Bytes => "made anew, equal to the byte",
            By::Reading => "read back",
            By::Hash => "only its hash was looked at",
        };
        let near = deviation.map_or(String::new(), |mm| format!("within {mm:.6} mm, "));
        let _ = writeln!(text, "{:28} {near}{how}", shown(path));
    }
    for line in findings::lines(&proof.findings) {
        let _ = writeln!(text, "{line}");
    }
    let verdict = match proof.findings.len() {
        0 => format!("proven, no findings; {}", summary::scope(proof)),
        n => format!("{n} findings"),
    };
    let _ = writeln!(text, "{}: {verdict}", shown(dir));
    text
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
