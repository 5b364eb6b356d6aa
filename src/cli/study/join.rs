//! Joins parts into one file, whose bytes equal those of an undivided run.

use std::collections::BTreeMap;
use std::fs;
use std::fs::File;
use std::io;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use crate::cli::escape::shown;
use crate::cli::failure::{Failure, tell};
use crate::cli::study::part::{PartJob, damaged, is_sound, job, name};
use crate::cli::study::run::{refuse_no_table, refuse_parquet};
use crate::cli::verbosity::Verbosity;
use crate::cli::whole_file::{WholeFile, directory_of, sweep_own};

/// Number of parts in a list.
const SHOWN: usize = 20;

/// A part with its job.
type JoinedPart = (PathBuf, PartJob);

/// Joins the parts in `dir` to the file `output`.
pub(super) fn run(dir: &Path, output: &Path, verbosity: Verbosity) -> Result<(), Failure> {
    refuse_parquet(output)?;
    refuse_no_table(output)?;
    if is_part(output) && directory_of(output).canonicalize().ok() == dir.canonicalize().ok() {
        let text = format!("{} has the name of a part of the study: name another file", shown(output));
        return Err(Failure::Message(text));
    }
    let entries = fs::read_dir(dir).map_err(|error| Failure::file("read", dir, &error))?;
    let mut files: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| is_part(path)).collect();
    files.sort();
    let parts = whole(dir, &files)?;
    for (path, job) in &parts {
        let sound = is_sound(path, job).map_err(|error| Failure::file("read", path, &error))?;
        if !sound {
            return Err(damaged(path));
        }
    }
    sweep_own(output);
    let joined = || -> io::Result<()> {
        let mut file = WholeFile::begin(output)?;
        csv(&parts, &mut file)?;
        file.publish()
    };
    joined().map_err(|error| Failure::file("write", output, &error))?;
    let rows = parts.last().map_or(0, |(_, job)| job.rows[1]);
    if verbosity.is_heard() {
        tell(&format!("{} parts joined, {rows} rows", parts.len()));
    }
    Ok(())
}

fn is_part(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    name.starts_with("part-") && path.extension().is_some_and(|ending| ending == "csv")
}

/// All parts of one study in order, or a list of missing and foreign parts.
fn whole(dir: &Path, files: &[PathBuf]) -> Result<Vec<JoinedPart>, Failure> {
    let mut faults = Vec::new();
    let mut found: BTreeMap<usize, JoinedPart> = BTreeMap::new();
    let jobs: Vec<(&PathBuf, Option<PartJob>)> = files.iter().map(|path| (path, job(path))).collect();
    let first = jobs.iter().find_map(|(_, job)| job.as_ref());
    let Some(first) = first else {
        let text = format!("{} holds no parts; `study run STUDY --part k/N -o DIR` writes them", shown(dir));
        return Err(Failure::Message(text));
    };
    let alike =
        |job: &PartJob| (&job.study, job.parts, job.units) == (&first.study, first.parts, first.units);
    let mut others: BTreeMap<(usize, bool), Vec<&Path>> = BTreeMap::new();
    for (path, job) in jobs.iter().cloned() {
        match job.filter(|job| is_named(path, job)) {
            Some(job) if alike(&job) => {
                let _ = found.insert(job.part, (path.clone(), job));
            }
            Some(job) if job.study == first.study => {
                others.entry((job.parts, job.units)).or_default().push(path);
            }
            _ => faults.push(format!("{} is not a part of this study; move it elsewhere", shown(path))),
        }
    }
    for ((parts, units), paths) in others {
        let units = if units == first.units { "" } else { ", and differ in --units" };
        faults.push(format!(
            "{} are of {parts} parts{units}, and {} is of {}: move one kind to another directory",
            listed(paths.iter().map(shown)),
            name(first.part, first.parts),
            first.parts
        ));
    }
    let missing: Vec<usize> = (1..=first.parts).filter(|part| !found.contains_key(part)).collect();
    if !missing.is_empty() {
        faults.push(format!(
            "{} of {} parts are missing: {}; compute them with --part k/{}",
            missing.len(),
            first.parts,
            listed(missing.iter().map(ToString::to_string)),
            first.parts
        ));
    }
    if faults.is_empty() {
        Ok(found.into_values().collect())
    } else {
        Err(Failure::Message(faults.join("\n")))
    }
}

/// A list of at most [`SHOWN`] words.
fn listed(words: impl ExactSizeIterator<Item = String>) -> String {
    let more = if words.len() > SHOWN { ", ..." } else { "" };
    words.take(SHOWN).collect::<Vec<_>>().join(", ") + more
}

/// Whether the file's name is that of its part.
fn is_named(path: &Path, job: &PartJob) -> bool {
    path.file_name().is_some_and(|own| *own == *name(job.part, job.parts))
}

/// The header of the first, and all rows.
fn csv(parts: &[JoinedPart], out: &mut impl Write) -> io::Result<()> {
    for (i, (path, job)) in parts.iter().enumerate() {
        let mut file = BufReader::with_capacity(1 << 16, File::open(path)?);
        let mut header = Vec::new();
        for _ in 0..=usize::from(job.units) {
            let _ = file.read_until(b'\n', &mut header)?;
        }
        if i == 0 {
            out.write_all(&header)?;
        }
        let _ = io::copy(&mut file, out)?;
    }
    Ok(())
}
