//! Publishes file by file, where the target cannot be renamed: a mount point, or the current directory of the process.
//!
//! The hidden directories are in the target. The new build is written there first, and is **ready** when it is complete. Then the old files
//! move to **old** and the new ones to the target, their manifest last: this step publishes the build. A fault or a kill before it is
//! undone by moving everything back. After it only the old build is left to remove. The two directories are the journal: their contents
//! show the progress, also after a kill.

use std::path::{Path, PathBuf};

use crate::cli::publish::disk;
use crate::cli::publish::fault::PublishFault;
use crate::cli::publish::place::{PlaceRole, TargetPlace};
use crate::cli::publish::record::{PublishRecord, is_manifest};
use crate::cli::publish::retire::retire;
use crate::cli::publish::stage;
use crate::cli::publish::stage::StagedFile;
use crate::manifest::MANIFEST;

/// Replaces the build that `before` records by `files` in the target. Returns the present place of the old build.
///
/// # Errors
/// If the system refuses. The target is then unchanged; if that failed as well, the next publication restores it.
pub(super) fn publish(
    place: &TargetPlace,
    files: &[StagedFile<'_>],
    before: Option<&PublishRecord>,
) -> Result<PathBuf, PublishFault> {
    let ready = place.inside(PlaceRole::Ready);
    stage::write([&place.inside(PlaceRole::New), &ready], files, &place.target)?;
    if let Err(fault) = commit(place, files, before) {
        // The first fault is reported; the next publication tries again.
        let _ = undo(place);
        return Err(fault);
    }
    let _ = disk::sync_dir(&place.target);
    let _ = disk::remove_dir(&ready);
    Ok(place.inside(PlaceRole::Old))
}

fn commit(
    place: &TargetPlace,
    files: &[StagedFile<'_>],
    before: Option<&PublishRecord>,
) -> Result<(), PublishFault> {
    let (target, ready, old) = (&place.target, place.inside(PlaceRole::Ready), place.inside(PlaceRole::Old));
    disk::sync_dir(target).map_err(PublishFault::io("sync", target))?;
    disk::create_dir(&old).map_err(PublishFault::io("create", &old))?;
    let entries = disk::entries(target).map_err(PublishFault::io("read", target))?;
    for entry in entries.iter().filter(|entry| before.is_some_and(|before| before.names(entry))) {
        move_to(entry, &old)?;
    }
    let (manifest, others): (Vec<_>, Vec<_>) =
        files.iter().map(|(name, _)| ready.join(name)).partition(|file| is_manifest(file));
    for file in others {
        move_to(&file, target)?;
    }
    disk::sync_dir(target).map_err(PublishFault::io("sync", target))?;
    for file in manifest {
        move_to(&file, target)?;
    }
    Ok(())
}

/// Moves `entry` into `directory`, but never over an existing entry.
fn move_to(entry: &Path, directory: &Path) -> Result<(), PublishFault> {
    let to = directory.join(entry.file_name().unwrap_or_default());
    if disk::exists(&to) {
        return Err(PublishFault::Foreign(to));
    }
    disk::rename(entry, &to).map_err(PublishFault::io("move", entry))
}

/// Restores the target after an interrupted publication into it. The restoration may be interrupted itself.
fn undo(place: &TargetPlace) -> Result<Vec<PathBuf>, PublishFault> {
    let (target, ready, old) = (&place.target, place.inside(PlaceRole::Ready), place.inside(PlaceRole::Old));
    for file in PublishRecord::read(&ready).into_iter().flat_map(|record| record.files) {
        let (staged, published) = (ready.join(&file.path), target.join(&file.path));
        // A file that is no longer in ready has been moved, so the target's file is the new one.
        if !disk::exists(&staged) && disk::exists(&published) {
            move_to(&published, &ready)?;
        }
    }
    let mut kept = Vec::new();
    if disk::exists(&old) {
        for entry in disk::entries(&old).map_err(PublishFault::io("read", &old))? {
            // A file that appeared under the same name meanwhile stays, and the old file is kept beside it.
            match move_to(&entry, target) {
                Ok(()) | Err(PublishFault::Foreign(_)) => {}
                Err(fault) => return Err(fault),
            }
        }
        kept = retire(&old, None, &place.kept(&old))?;
    }
    let new = place.inside(PlaceRole::New);
    disk::rename(&ready, &new).map_err(PublishFault::io("set aside", &ready))?;
    disk::remove_tree(&new).map_err(PublishFault::io("remove", &new))?;
    Ok(kept)
}

/// Undoes or finishes a killed publication in the target. Returns the kept directories.
///
/// # Errors
/// If the system refuses.
pub(super) fn recover(place: &TargetPlace) -> Result<Vec<PathBuf>, PublishFault> {
    let [new, ready, old] = PlaceRole::ALL.map(|role| place.inside(role));
    if disk::exists(&new) {
        disk::remove_tree(&new).map_err(PublishFault::io("remove", &new))?;
    }
    if disk::is_plain(&ready.join(MANIFEST)) {
        return undo(place);
    }
    if disk::exists(&ready) {
        disk::remove_dir(&ready).map_err(PublishFault::io("remove", &ready))?;
    }
    if disk::exists(&old) {
        return retire(&old, PublishRecord::read(&place.target).as_ref(), &place.kept(&old));
    }
    Ok(Vec::new())
}
