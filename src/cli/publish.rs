//! Publishing: an output directory appears whole or not at all.
//!
//! The files are written into a staging directory beside the target, which then takes the target's
//! place in one step where the system can exchange two names, and in two renames where it cannot. In the
//! second case a kill between the renames leaves the old output under its hidden name; the next
//! publication puts it back first. A target that holds anything its manifest does not name is not touched.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::{fmt, fs, io};

use crate::manifest::{MANIFEST, Manifest};

/// Why nothing was published; the target is as it was.
#[derive(Debug)]
pub enum PublishFault {
    /// The target exists and is not a directory.
    NotADirectory(PathBuf),
    /// The target holds this entry, which no build of ours has written there.
    Foreign(PathBuf),
    /// The target has no name of its own, such as `/`.
    NoName(PathBuf),
    /// The system refused.
    Io(&'static str, PathBuf, io::Error),
}

impl fmt::Display for PublishFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotADirectory(path) => {
                write!(f, "{} exists and is not a directory; choose another with -o", path.display())
            }
            Self::Foreign(path) => write!(
                f,
                "{} is not named in a manifest beside it, so its directory is left alone; move it away or choose another directory with -o",
                path.display()
            ),
            Self::NoName(path) => {
                write!(f, "{} cannot be an output directory; name one with -o", path.display())
            }
            Self::Io(what, path, error) => write!(f, "cannot {what} {}: {error}", path.display()),
        }
    }
}

impl std::error::Error for PublishFault {}

/// Puts `files` (name, content) into the directory `target`, replacing what an earlier publication put there.
///
/// # Errors
/// See [`PublishFault`]; the target is then as it was before.
pub fn publish<'a>(
    target: &Path,
    files: impl Iterator<Item = (&'a str, std::borrow::Cow<'a, [u8]>)>,
) -> Result<(), PublishFault> {
    // A link is followed, so that the directory it names is replaced and not the link.
    let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
    let name = target.file_name().ok_or_else(|| PublishFault::NoName(target.clone()))?.to_owned();
    let parent = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent).map_err(io_error("create", parent))?;
    let _lock = lock(parent);
    let hidden = |suffix: &str| {
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(&name);
        hidden.push(suffix);
        parent.join(hidden)
    };
    let (staging, old) = (hidden(".stargrip-new"), hidden(".stargrip-old"));
    recover(&target, &old)?;
    check_ours(&target)?;
    remove(&staging)?;
    fs::create_dir(&staging).map_err(io_error("create", &staging))?;
    for (name, bytes) in files {
        write_file(&staging.join(name), &bytes)?;
    }
    replace(&staging, &target, &old)?;
    // What is left over is the old output under a hidden name; failing to remove it harms nothing.
    let _ = remove(&staging);
    let _ = remove(&old);
    Ok(())
}

fn io_error(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> PublishFault {
    let path = path.to_owned();
    move |error| PublishFault::Io(what, path, error)
}

/// Keeps other publications in the same parent waiting; systems that cannot lock directories go without.
fn lock(parent: &Path) -> Option<fs::File> {
    let file = fs::File::open(parent).ok()?;
    file.lock().ok()?;
    Some(file)
}

/// Puts an output back that a kill between two renames left under its hidden name.
fn recover(target: &Path, old: &Path) -> Result<(), PublishFault> {
    if old.exists() && !target.exists() {
        return fs::rename(old, target).map_err(io_error("restore", target));
    }
    remove(old)
}

fn remove(directory: &Path) -> Result<(), PublishFault> {
    match fs::remove_dir_all(directory) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(PublishFault::Io("remove", directory.to_owned(), error))
        }
        _ => Ok(()),
    }
}

/// Refuses a target with entries that its manifest does not name; an empty directory is ours to fill.
fn check_ours(target: &Path) -> Result<(), PublishFault> {
    if !target.exists() {
        return Ok(());
    }
    if !target.is_dir() {
        return Err(PublishFault::NotADirectory(target.to_owned()));
    }
    let named: Vec<String> = fs::read(target.join(MANIFEST))
        .ok()
        .and_then(|bytes| serde_json::from_slice::<Manifest>(&bytes).ok())
        .map(|manifest| {
            manifest.files.into_iter().map(|file| file.path).chain([MANIFEST.to_owned()]).collect()
        })
        .unwrap_or_default();
    for entry in fs::read_dir(target).map_err(io_error("read", target))? {
        let entry = entry.map_err(io_error("read", target))?;
        let ours = entry.file_name().to_str().is_some_and(|name| named.iter().any(|known| known == name));
        let plain = entry.file_type().is_ok_and(|kind| kind.is_file());
        if !(ours && plain) {
            return Err(PublishFault::Foreign(entry.path()));
        }
    }
    Ok(())
}

fn write_file(path: &Path, bytes: &[u8]) -> Result<(), PublishFault> {
    let mut file = fs::File::create_new(path).map_err(io_error("create", path))?;
    // Synced, so that after a power cut the new name never stands for empty files.
    file.write_all(bytes).and_then(|()| file.sync_all()).map_err(io_error("write", path))
}

/// Gives `staging` the name `target`.
fn replace(staging: &Path, target: &Path, old: &Path) -> Result<(), PublishFault> {
    if !target.exists() {
        return fs::rename(staging, target).map_err(io_error("create", target));
    }
    if exchange(staging, target) {
        return Ok(());
    }
    fs::rename(target, old).map_err(io_error("set aside", target))?;
    fs::rename(staging, target).map_err(|error| {
        let _ = fs::rename(old, target);
        PublishFault::Io("replace", target.to_owned(), error)
    })
}

/// Exchanges the two names in one step; false where the system cannot.
#[cfg(any(target_os = "linux", target_os = "android"))]
fn exchange(a: &Path, b: &Path) -> bool {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE).is_ok()
}

#[cfg(not(any(target_os = "linux", target_os = "android")))]
fn exchange(_: &Path, _: &Path) -> bool {
    false
}
