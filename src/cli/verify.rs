//! `stargrip-cam verify`

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::io::stdout;
use std::path::{Path, PathBuf};

use crate::answer::proof::{json, scope};
use crate::cli::escape::{argument, escaped_line};
use crate::cli::failure::{Failure, say};
use crate::cli::feedcheck::manifest_path;
use crate::cli::load::DRAWING_LIMIT;
use crate::cli::terminal::{fitted, width};
use crate::cli::verbosity::Verbosity;
use crate::cli::whole_file::{directory_of, first_bytes};
use crate::cli::words::count_beyond;
use crate::cli::{findings, progress};
use crate::manifest::MANIFEST;
use crate::pipeline::{PublishedBuild, prove_feed_check};
use proof::verify::{FileProof, FindingCode, Method, OutputFiles, Proof};
use spec::Code;
use spec::units::count_text;

/// Arguments of `verify`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The directory that `build` or `coupon` published, or the program that `feedcheck` wrote.
    dir: PathBuf,
    /// Accept a directory of another version, which is read back only: exit code 0 instead of 3.
    #[arg(long)]
    read_back: bool,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Largest file that is read back, bytes, whatever the manifest states: above the size of a build's files, and small enough for memory.
const FILE_LIMIT: u64 = 1 << 28;

/// The files from which the list of expected files follows.
const SOURCES: [&str; 5] = ["spec.toml", "machine.toml", MANIFEST, "drawing.svg", "drawing.dxf"];

/// Largest of these files that is read, bytes, but for the drawing: far more than a thousand stars need.
const SOURCE_LIMIT: u64 = 1 << 24;
/// Bytes that a file may be longer than twice the length in its manifest, and is still read: its line ends may have become
/// longer, and a short file may be another one.
const EXCESS: u64 = 1 << 16;

/// Most builds that are listed.
const MOST_BUILDS: usize = 10;

/// Reads the directory and proves it.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let proof = if args.dir.is_file() {
        feed_check(&args.dir)?
    } else {
        holds_a_build(&args.dir)?;
        let (published, files) = read_directory(&args.dir)?;
        progress::with_line(args.verbosity, "proving", |_| published.prove(&files))
    };
    let right = proof.findings.is_empty();
    let accepted = proof.written_by.is_none() || args.read_back;
    match args.verbosity {
        Verbosity { json: true, .. } => say(&json(&proof))?,
        Verbosity { quiet: true, .. } if right && accepted => {}
        Verbosity { quiet: true, .. } => say(&fitted(&faults(&args.dir, &proof), width(&stdout())))?,
        _ => say(&fitted(&text(&args.dir, &proof), width(&stdout())))?,
    }
    match (right, accepted) {
        (false, _) => Err(Failure::Reported),
        (true, false) => Err(Failure::NotCompared),
        (true, true) => Ok(()),
    }
}

/// Proves the program of a feed check from the manifest beside it.
fn feed_check(path: &Path) -> Result<Proof, Failure> {
    let manifest_file = manifest_path(path);
    let manifest = read(&manifest_file, SOURCE_LIMIT).map_err(|_| {
        let dir = directory_of(path);
        let name =
            if dir.join(MANIFEST).is_file() { format!(": {}", escaped_line(dir)) } else { String::new() };
        Failure::Message(format!(
            "{} is not the program of a feed check: a file of a build is proven with its directory; name \
             the directory{name}",
            escaped_line(path)
        ))
    })?;
    let manifest = serde_json::from_slice(&manifest).map_err(|error| {
        Failure::Message(format!("{} is not a manifest: {error}", escaped_line(&manifest_file)))
    })?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Ok(prove_feed_check(&name, &read(path, FILE_LIMIT)?, &manifest))
}

/// Refuses a directory without a build; names builds in it, since it may be their parent.
pub(super) fn holds_a_build(dir: &Path) -> Result<(), Failure> {
    if SOURCES[..3].iter().any(|name| dir.join(name).exists()) {
        return Ok(());
    }
    let entries = fs::read_dir(dir).map_err(|error| Failure::file("read", dir, &error))?;
    let entries_within = entries.filter_map(Result::ok).map(|entry| entry.path());
    let mut builds: Vec<String> =
        entries_within.filter(|path| path.join(MANIFEST).is_file()).map(argument).collect();
    if builds.is_empty() {
        let remedy = "name the directory that `build` or `coupon` published";
        return Err(Failure::Message(format!(
            "{} is not a build: it has no spec.toml, machine.toml or {MANIFEST}; {remedy}",
            escaped_line(dir)
        )));
    }
    builds.sort();
    let number = builds.len();
    let command = |build| format!("\n  stargrip-cam verify {build}");
    let list: String = builds.into_iter().take(MOST_BUILDS).map(command).collect();
    let remainder =
        count_beyond(number, MOST_BUILDS).map_or_else(String::new, |more| format!("\n  and {more} more"));
    let contents =
        if number == 1 { "a build is in it".to_owned() } else { format!("{number} builds are in it") };
    Err(Failure::Message(format!("{} is not a build, but {contents}:{list}{remainder}", escaped_line(dir))))
}

fn text(dir: &Path, proof: &Proof) -> String {
    let mut text = String::new();
    for FileProof { path, deviation, by, .. } in &proof.files {
        let method = match by {
            Method::Bytes => "equal to a new build, byte for byte",
            Method::Reading => "read back",
            Method::Hash => "only its hash was compared",
        };
        let deviation_text =
            deviation.filter(|mm| mm.is_finite()).map_or(String::new(), |mm| format!("within {mm:.6} mm, "));
        let _ = writeln!(text, "{:28} {deviation_text}{method}", escaped_line(path));
    }
    text + &faults(dir, proof)
}

/// The text of the findings, and the last line.
fn faults(dir: &Path, proof: &Proof) -> String {
    let mut text: String = findings::lines(&proof.findings).into_iter().map(|line| line + "\n").collect();
    if let Some(source) = changed_source(proof) {
        let _ = writeln!(
            text,
            "{source} was changed after the build, or its hash in {MANIFEST} was, and the other files are compared with it: \
             restore it, or build again"
        );
    }
    text.push_str(&verdict(dir, proof));
    text
}

/// The first source of the design that is not the one that was built from.
fn changed_source(proof: &Proof) -> Option<&'static str> {
    let mut sources = SOURCES.into_iter().filter(|name| *name != MANIFEST);
    sources.find(|name| {
        proof.findings.iter().any(|found| found.file == *name && found.code == FindingCode::Hash.as_str())
    })
}

/// The last line: whether the directory is proven, and the meaning for one of another version.
fn verdict(dir: &Path, proof: &Proof) -> String {
    let mut parts = Vec::new();
    if let Some(version) = &proof.written_by {
        parts.push(format!("written by {}: read back, not compared", escaped_line(version)));
    }
    match proof.findings.len() {
        0 if proof.written_by.is_some() => {
            let (equal, file_count) = (proof.equal(), proof.files.len());
            parts.push(format!(
                "no findings; {}; {equal} of {file_count} files equal those of this version to the byte",
                scope(proof)
            ));
        }
        0 => parts.push(format!("proven, no findings; {}", scope(proof))),
        n => parts.push(count_text(n, "finding")),
    }
    if !proof.unproven.is_empty() {
        parts.push(format!(
            "not proven: {}",
            proof.unproven.iter().map(escaped_line).collect::<Vec<_>>().join(", ")
        ));
    }
    format!("{}: {}\n", escaped_line(dir), parts.join("; "))
}

/// The files of a directory. Only files that its design has are read, and none that is much longer than its manifest states; of all others
/// only the name is recorded.
pub(super) fn read_directory(dir: &Path) -> Result<(PublishedBuild, OutputFiles<'static>), Failure> {
    let (mut names, mut files) = (Vec::new(), OutputFiles::default());
    for entry in fs::read_dir(dir).map_err(|error| Failure::file("read", dir, &error))? {
        let entry = entry.map_err(|error| Failure::file("read", dir, &error))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        // An entry that is not a regular file is not opened; the proof reports it.
        match entry.file_type() {
            Ok(kind) if kind.is_file() => names.push(name),
            kind => files.others.push((name.into(), kind.map_or("an entry without a type", named))),
        }
    }
    names.sort();
    files.others.sort();
    for name in SOURCES {
        if names.iter().any(|known| known == name) {
            let limit = if name.starts_with("drawing.") { DRAWING_LIMIT } else { SOURCE_LIMIT };
            add(&mut files, dir, name, limit)?;
        }
    }
    let published = PublishedBuild::read(&files);
    let wanted_names: BTreeSet<String> = published.required_names().into_iter().collect();
    let stated: BTreeMap<&str, usize> = published.stated_sizes().collect();
    for name in names {
        if files.names().any(|known| known == name) {
            continue;
        }
        // Without a manifest no file is judged.
        if !wanted_names.contains(&name) || stated.is_empty() {
            files.files.push((name.into(), Vec::new().into()));
            continue;
        }
        let twice = |bytes: &usize| (*bytes as u64).saturating_mul(2).saturating_add(EXCESS);
        add(&mut files, dir, &name, stated.get(name.as_str()).map_or(SOURCE_LIMIT, twice).min(FILE_LIMIT))?;
    }
    files.files.sort();
    Ok((published, files))
}

/// Adds the file `name` of `dir` to `files`: its content, or only its length if that is above `limit`.
fn add(files: &mut OutputFiles<'static>, dir: &Path, name: &str, limit: u64) -> Result<(), Failure> {
    let path = dir.join(name);
    let bytes = read(&path, limit.saturating_add(1))?;
    if bytes.len() as u64 <= limit {
        files.files.push((name.to_owned().into(), bytes.into()));
    } else {
        let file = path.metadata().map_err(|error| Failure::file("read", &path, &error))?;
        files.long.push((name.to_owned().into(), file.len()));
    }
    Ok(())
}

/// What an entry is that is no regular file.
fn named(kind: fs::FileType) -> &'static str {
    if kind.is_symlink() {
        "a link"
    } else if kind.is_dir() {
        "a directory"
    } else {
        "a pipe, a socket or a device"
    }
}

fn read(path: &Path, limit: u64) -> Result<Vec<u8>, Failure> {
    first_bytes(path, limit).map_err(|error| Failure::file("read", path, &error))
}
