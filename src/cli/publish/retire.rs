//! Removes an old build, and nothing else.
//!
//! Only a file that a manifest names and that still has the recorded hash is removed. All other entries were added or edited since the
//! build, so they are kept: the directory gets a visible name and keeps only them. It is never removed with its content, so that a file
//! that appears at the last moment is kept as well.

use std::io;
use std::path::{Path, PathBuf};

use crate::cli::publish::disk;
use crate::cli::publish::fault::PublishFault;
use crate::cli::publish::place::{PlaceRole, TargetPlace, kept_beside};
use crate::cli::publish::record::{PublishRecord, is_manifest};

/// Number of names tried for a kept directory.
const NAMES: usize = 10_000;

/// Removes the build in `directory`; what must be kept takes the first free name of `kept_path`-1, `kept_path`-2, ... `successor` is the build in its
/// place: a file that equals one of its files is not kept. Returns the kept directories.
///
/// # Errors
/// If the system refuses; then the rest is still there.
pub(super) fn retire(
    directory: &Path,
    successor: Option<&PublishRecord>,
    kept_path: &Path,
) -> Result<Vec<PathBuf>, PublishFault> {
    let record = PublishRecord::read(directory);
    let entries = disk::entries(directory).map_err(PublishFault::io("read", directory))?;
    let (manifest, files): (Vec<_>, Vec<_>) = entries.into_iter().partition(|entry| is_manifest(entry));
    let clean = |entry: &PathBuf| {
        [record.as_ref(), successor].into_iter().flatten().any(|record| record.is_unchanged(entry))
    };
    // The manifest is removed last: after a kill it still names the program's files.
    let manifest = manifest.into_iter().filter(|_| record.is_some());
    for entry in files.into_iter().filter(clean).chain(manifest) {
        disk::remove_file(&entry).map_err(PublishFault::io("remove", &entry))?;
    }
    match disk::remove_dir(directory) {
        Ok(()) => Ok(Vec::new()),
        Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => keep(directory, kept_path),
        Err(error) => Err(PublishFault::Io("remove", directory.to_owned(), error)),
    }
}

/// Gives `directory` the first free name, and returns its kept entries.
fn keep(directory: &Path, kept_path: &Path) -> Result<Vec<PathBuf>, PublishFault> {
    let refused = |error| PublishFault::Io("give a visible name to", directory.to_owned(), error);
    for number in 1..=NAMES {
        let mut name = kept_path.to_owned().into_os_string();
        name.push(format!("-{number}"));
        let name = PathBuf::from(name);
        if disk::exists(&name) {
            continue;
        }
        match disk::rename(directory, &name) {
            Ok(()) => return disk::entries(&name).map_err(PublishFault::io("read", &name)),
            // The name was taken at this moment: a rename replaces no directory with content.
            Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => {}
            Err(error) => return Err(refused(error)),
        }
    }
    Err(refused(io::ErrorKind::AlreadyExists.into()))
}

/// Removes the rest of killed publications beside the target, whatever their targets were, and restores an output that one of them had set
/// aside. Returns the kept directories.
///
/// # Errors
/// If an entry of this target stays in the way; the rest of other targets is ignored.
pub(super) fn sweep(place: &TargetPlace, is_alone: bool) -> Result<Vec<PathBuf>, PublishFault> {
    let mut kept_entries = Vec::new();
    for role in PlaceRole::ALL {
        let path = place.hidden_path(role);
        kept_entries.extend(clear(&path, role, &place.target, &place.kept_path())?);
    }
    // Without a lock a hidden directory of another target may be one that is being written.
    for (path, name, role) in place.hidden().into_iter().filter(|_| is_alone) {
        let stem = kept_beside(&place.parent, &name);
        kept_entries.extend(clear(&path, role, &place.parent.join(name), &stem).unwrap_or_default());
    }
    Ok(kept_entries)
}

/// Removes or restores the hidden directory `path` of `target`.
fn clear(
    path: &Path,
    role: PlaceRole,
    target: &Path,
    kept_path: &Path,
) -> Result<Vec<PathBuf>, PublishFault> {
    if !disk::exists(path) {
        return Ok(Vec::new());
    }
    match role {
        PlaceRole::New => {
            disk::remove_tree(path).map_err(PublishFault::io("remove", path))?;
            Ok(Vec::new())
        }
        PlaceRole::Old if !disk::exists(target) => {
            disk::rename(path, target).map_err(PublishFault::io("restore", target))?;
            Ok(Vec::new())
        }
        PlaceRole::Ready | PlaceRole::Old => retire(path, PublishRecord::read(target).as_ref(), kept_path),
    }
}
