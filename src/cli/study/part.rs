//! Parts of a study in a directory: each is a file of its own, with a **job** beside it, a line of JSON with the study, the number, the
//! length and the hash of the part.
//!
//! A job is written before its part, and both appear complete. So a part with the right job is done, and is not computed again. A part
//! without a job, or with another one, is foreign, and is not overwritten.

use std::fs;
use std::fs::{File, Metadata};
use std::io;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::cli::escape::shown;
use crate::cli::failure::Failure;
use crate::cli::study::rows::{StudyMonitor, StudyRows};
use crate::cli::whole_file::{WholeFile, sweep_leftovers, write_whole};
use forecast::study::Study;
use spec::digest::Running;

/// Description of a part.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct PartJob {
    /// Fingerprint of the study.
    pub(super) study: String,
    /// Number of the part, from 1.
    pub(super) part: usize,
    /// Number of all parts.
    pub(super) parts: usize,
    /// Its first row, and the one after its last.
    pub(super) rows: [usize; 2],
    /// Whether it has a line of units.
    pub(super) units: bool,
    /// Its length.
    pub(super) bytes: u64,
    /// Its hash.
    pub(super) sha256: String,
}

/// The parts of a study in a directory.
pub(in crate::cli) struct Parts<'a> {
    pub(in crate::cli) dir: &'a Path,
    pub(in crate::cli) study: &'a Study,
    /// Number of parts.
    pub(in crate::cli) of: usize,
    pub(in crate::cli) units: bool,
}

impl Parts<'_> {
    /// Computes the missing parts from `from` to `to`; returns how many existed already.
    pub(in crate::cli) fn compute(
        &self,
        [from, to]: [usize; 2],
        ear: &StudyMonitor<'_>,
    ) -> Result<usize, Failure> {
        self.refuse_other_division()?;
        let made = fs::create_dir_all(self.dir);
        made.map_err(|error| Failure::file("create", self.dir, &error))?;
        sweep_leftovers(self.dir, |name| name.starts_with("part-"));
        let fingerprint = self.study.fingerprint();
        let mut there = 0;
        for part in from..=to {
            if self.exists(part, &fingerprint)? {
                there += 1;
                // A run killed at the very end may have left them.
                self.rows(part, &self.path(part)).forget();
            } else {
                self.write(part, &fingerprint, ear)?;
            }
        }
        Ok(there)
    }

    /// Refuses a directory with parts of another number of parts: they could not be joined together.
    fn refuse_other_division(&self) -> Result<(), Failure> {
        let entries = fs::read_dir(self.dir).into_iter().flatten().flatten();
        let mut names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
        let Some(name) = names.find(|name| parts_of(name).is_some_and(|of| of != self.of)) else {
            return Ok(());
        };
        Err(Failure::Message(format!(
            "{} is one of {} parts, and this run is of {}: choose another directory, or the same number of parts",
            shown(self.dir.join(&name)),
            parts_of(&name).unwrap_or_default(),
            self.of
        )))
    }

    fn path(&self, part: usize) -> PathBuf {
        self.dir.join(name(part, self.of))
    }

    fn rows<'b>(&'b self, part: usize, path: &'b Path) -> StudyRows<'b> {
        StudyRows {
            study: self.study,
            range: self.study.part(part, self.of),
            header: true,
            units: self.units,
            target: Some(path),
        }
    }

    fn job(&self, part: usize, study: &str, (bytes, sha256): (u64, String)) -> PartJob {
        let rows = self.study.part(part, self.of);
        let rows = [rows.start, rows.end];
        PartJob { study: study.to_owned(), part, parts: self.of, rows, units: self.units, bytes, sha256 }
    }

    /// Whether the part is there, and complete.
    ///
    /// # Errors
    /// If it is damaged, or another file has its name.
    fn exists(&self, part: usize, study: &str) -> Result<bool, Failure> {
        let path = self.path(part);
        let Ok(metadata) = fs::symlink_metadata(&path) else { return Ok(false) };
        let right = |job: &PartJob| *job == self.job(part, study, (job.bytes, job.sha256.clone()));
        match job(&path).filter(right).filter(|_| metadata.is_file()) {
            Some(job) if metadata.len() == job.bytes => Ok(true),
            Some(_) => Err(damaged(&path)),
            None => Err(Failure::Message(format!(
                "{} is not a part of this study and is not overwritten; choose another directory",
                shown(path)
            ))),
        }
    }

    fn write(&self, part: usize, study: &str, ear: &StudyMonitor<'_>) -> Result<(), Failure> {
        let path = self.path(part);
        let rows = self.rows(part, &path);
        let written = || -> io::Result<()> {
            let mut hashed = Hashed { out: WholeFile::begin(&path)?, hash: Running::default(), bytes: 0 };
            rows.write(&mut hashed, ear)?;
            let Hashed { out, hash, bytes } = hashed;
            let job = serde_json::to_string(&self.job(part, study, (bytes, hash.finish())))? + "\n";
            write_whole(&path.with_extension("json"), job.as_bytes())?;
            out.publish()?;
            rows.forget();
            Ok(())
        };
        written().map_err(|error| match error.kind() {
            io::ErrorKind::Interrupted if ear.listening.has_heard() => {
                let text = format!(
                    "stopped in part {part} of {}; the same command continues where it stopped",
                    self.of
                );
                Failure::Stopped(text)
            }
            _ => Failure::file("write", &path, &error),
        })
    }
}

/// The name of a part; the alphabetical order of names is that of the parts.
pub(super) fn name(part: usize, parts: usize) -> String {
    let width = parts.to_string().len();
    format!("part-{part:0width$}-of-{parts}.csv")
}

/// The number of all parts in the name of one.
fn parts_of(name: &str) -> Option<usize> {
    name.strip_prefix("part-")?.strip_suffix(".csv")?.split_once("-of-")?.1.parse().ok()
}

/// Longest job that is read, bytes: far more than one has.
const TICKET: u64 = 1 << 16;

/// The job of the part at `path`; `None` also where it, or the part, is not a regular file: a link or a pipe may have no end.
pub(super) fn job(path: &Path) -> Option<PartJob> {
    let beside = path.with_extension("json");
    let length = |path: &Path| fs::symlink_metadata(path).ok().filter(Metadata::is_file).map(|own| own.len());
    let _ = length(path)?;
    let _ = length(&beside).filter(|length| *length <= TICKET)?;
    serde_json::from_str(&fs::read_to_string(beside).ok()?).ok()
}

/// The refusal of a part that [`is_sound`] says is none any more.
pub(super) fn damaged(path: &Path) -> Failure {
    let text =
        format!("{} is damaged: it is not as it was written; delete it, and compute it again", shown(path));
    Failure::Message(text)
}

/// Whether the file at `path` has the length and the hash of its job.
pub(super) fn is_sound(path: &Path, job: &PartJob) -> io::Result<bool> {
    let own = fs::symlink_metadata(path)?;
    if !own.is_file() || own.len() != job.bytes {
        return Ok(false);
    }
    let mut hashed = Hashed { out: io::sink(), hash: Running::default(), bytes: 0 };
    let _ = io::copy(&mut File::open(path)?, &mut hashed)?;
    let Hashed { hash, bytes, .. } = hashed;
    Ok(bytes == job.bytes && hash.finish() == job.sha256)
}

/// A writer that hashes and counts the bytes written through it.
struct Hashed<W> {
    out: W,
    hash: Running,
    bytes: u64,
}

impl<W: Write> Write for Hashed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.hash.update(&bytes[..count]);
        self.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
