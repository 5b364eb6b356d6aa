//! Files read up to a limit; and files that get their names only when they are complete: each is written under another name, synced, and
//! renamed.

use std::fs;
use std::fs::{File, TryLockError};
use std::io;
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::process;

/// Suffix of unfinished files. Their names begin with a dot and the final name.
const UNFINISHED: &str = ".partial";

/// Whether `path` is "-", for standard input.
pub(super) fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// What is wrong with a place that is neither a file nor a directory.
pub(super) const SPECIAL: &str = "it is a pipe, a socket or a device; name a file";

/// Whether `path`, links followed, is a pipe, a socket or a device: opening it may wait for ever, and it may have no end.
pub(super) fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|entry| !entry.is_file() && !entry.is_dir())
}

/// Refuses `path` as an output if it is a pipe, a socket or a device.
pub(super) fn refuse_special(path: &Path) -> io::Result<()> {
    if is_special(path) { Err(io::Error::other(SPECIAL)) } else { Ok(()) }
}

/// The first `limit` bytes of the file `path`.
pub(super) fn first_bytes(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    // The buffer has its full size at once: growing would copy it.
    let length = file.metadata()?.len().min(limit);
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    let _ = file.take(limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The first `limit` bytes of the file `path`, or of standard input for "-".
pub(super) fn given_bytes(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    if !is_standard_input(path) {
        return first_bytes(path, limit);
    }
    let mut bytes = Vec::new();
    let _ = io::stdin().lock().take(limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The directory of a file, "." for a bare name.
pub(super) fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|dir| !dir.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// An unfinished file. It is removed if it is dropped before it is published.
#[derive(Debug)]
pub(super) struct WholeFile {
    file: BufWriter<File>,
    unfinished: PathBuf,
    target: PathBuf,
}

impl WholeFile {
    /// Begins the file `target`; a link is followed, so that it is kept. A pipe, a socket or a device is refused, not replaced.
    pub(super) fn begin(target: &Path) -> io::Result<Self> {
        refuse_special(target)?;
        let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
        let name = target.file_name().ok_or(io::ErrorKind::InvalidInput)?.to_string_lossy().into_owned();
        for number in 0.. {
            let unfinished_name = format!(".{name}.{}-{number}{UNFINISHED}", process::id());
            let unfinished = target.with_file_name(unfinished_name);
            match File::create_new(&unfinished) {
                Ok(file) => {
                    // [`sweep_leftovers`] takes this lock before it removes a file. If it was faster, the file is gone.
                    let _ = file.try_lock();
                    if unfinished.exists() {
                        return Ok(Self { file: BufWriter::new(file), unfinished, target });
                    }
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }

    /// Gives the file its name.
    pub(super) fn publish(mut self) -> io::Result<()> {
        self.file.flush()?;
        self.file.get_ref().sync_all()?;
        fs::rename(&self.unfinished, &self.target)?;
        // Some systems cannot sync a directory.
        let _ = File::open(directory_of(&self.target)).and_then(|dir| dir.sync_all());
        Ok(())
    }
}

/// Writes or replaces a file atomically.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = WholeFile::begin(path)?;
    file.write_all(bytes)?;
    file.publish()
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        // A published file no longer has this name.
        let _ = fs::remove_file(&self.unfinished);
    }
}

/// Removes what killed writers of the file `target` have left.
pub(super) fn sweep_own(target: &Path) {
    let target_name = target.file_name().unwrap_or_default().to_string_lossy();
    sweep_leftovers(directory_of(target), |name| name == target_name);
}

/// Removes unfinished files of killed writers from `dir`, if `is_ours` holds for the final name. A running writer holds a lock.
pub(super) fn sweep_leftovers(dir: &Path, is_ours: impl Fn(&str) -> bool) {
    for entry in fs::read_dir(dir).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let target_and_number = name.strip_prefix('.').and_then(|name| name.strip_suffix(UNFINISHED));
        let target_name = target_and_number.and_then(|name| name.rsplit_once('.')).map(|(name, _)| name);
        if !target_name.is_some_and(&is_ours) || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let Ok(file) = File::options().write(true).open(entry.path()) else { continue };
        match file.try_lock() {
            Ok(()) => {
                let _ = fs::remove_file(entry.path());
            }
            // The writer is running, or the system has no locks.
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(dir: &Path) -> Vec<String> {
        let entries = fs::read_dir(dir).expect("a folder").map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<String> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_has_its_name_when_it_is_whole() {
        let dir = tempfile::tempdir().expect("a folder");
        let target = dir.path().join("a.csv");
        fs::write(&target, "old").expect("written");
        let mut file = WholeFile::begin(&target).expect("begun");
        file.write_all(b"new").expect("written");
        assert_eq!(fs::read_to_string(&target).expect("there"), "old");
        drop(file);
        assert_eq!(names(dir.path()), ["a.csv"], "given up, it leaves nothing");
        let mut file = WholeFile::begin(&target).expect("begun");
        file.write_all(b"new").expect("written");
        file.publish().expect("published");
        assert_eq!(
            (fs::read_to_string(&target).expect("there").as_str(), names(dir.path())),
            ("new", vec!["a.csv".to_owned()])
        );
    }

    #[test]
    fn leftovers_go_and_what_is_at_work_stays() {
        let dir = tempfile::tempdir().expect("a folder");
        for name in [".a.csv.999999-0.partial", ".b.csv.999999-0.partial", ".a.csv.swp", "a.csv.partial"] {
            fs::write(dir.path().join(name), "half").expect("written");
        }
        let at_work = WholeFile::begin(&dir.path().join("a.csv")).expect("begun");
        sweep_leftovers(dir.path(), |name| name == "a.csv");
        let entries = names(dir.path());
        assert_eq!(entries.len(), 4, "{entries:?}");
        assert!(!entries.contains(&".a.csv.999999-0.partial".to_owned()), "{entries:?}");
        drop(at_work);
        assert_eq!(names(dir.path()), [".a.csv.swp", ".b.csv.999999-0.partial", "a.csv.partial"]);
    }
}
