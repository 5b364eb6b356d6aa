//! Publishes in one step: a complete directory takes the target's name.
//!
//! A system that cannot exchange two names needs two renames. A kill between them leaves the old output under its hidden name, and the next
//! publication restores it.

use std::path::{Path, PathBuf};

use crate::cli::publish::disk;
use crate::cli::publish::fault::PublishFault;
use crate::cli::publish::place::{PlaceRole, TargetPlace};
use crate::cli::publish::stage;
use crate::cli::publish::stage::StagedFile;

/// Replaces the target by `files`. Returns the present place of the old build, if there was one.
///
/// # Errors
/// If the system refuses; the target is then unchanged.
pub(super) fn publish(
    place: &TargetPlace,
    files: &[StagedFile<'_>],
) -> Result<Option<PathBuf>, PublishFault> {
    let [new, ready, old] = PlaceRole::ALL.map(|role| place.hidden_path(role));
    stage::write([&new, &ready], files, &place.target)?;
    let old_directory =
        take_place(&place.target, ready.clone(), old).inspect_err(|_| stage::discard([&new, &ready]))?;
    // The build is published. Without a synced name a power cut may at most restore the old build.
    let _ = disk::sync_dir(&place.parent);
    Ok(old_directory)
}

/// Gives `ready` the name of the target.
fn take_place(target: &Path, ready: PathBuf, old: PathBuf) -> Result<Option<PathBuf>, PublishFault> {
    if !disk::exists(target) {
        disk::rename(&ready, target).map_err(PublishFault::io("create", target))?;
        return Ok(None);
    }
    if disk::exchange(&ready, target).is_ok() {
        return Ok(Some(ready));
    }
    disk::rename(target, &old)
        .map_err(|error| PublishFault::io("set aside", target)(error).of_target(target))?;
    disk::rename(&ready, target).map_err(PublishFault::io("replace", target)).inspect_err(|_| {
        let _ = disk::rename(&old, target);
    })?;
    Ok(Some(old))
}
