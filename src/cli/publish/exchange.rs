//! Publishes in one step: a complete directory takes the target's name.
//!
//! A system that cannot exchange two names needs two renames. A kill between them leaves the old output under its hidden name, and the next
//! publication restores it.

use std::path::PathBuf;

use crate::cli::publish::disk;
use crate::cli::publish::fault::PublishFault;
use crate::cli::publish::place::{PlaceRole, TargetPlace};
use crate::cli::publish::stage::{StagedFile, Staging};

/// Replaces the target by `files`. Returns the present place of the old build, if there was one.
///
/// # Errors
/// If the system refuses; the target is then unchanged.
pub(super) fn publish(
    place: &TargetPlace,
    files: &[StagedFile<'_>],
) -> Result<Option<PathBuf>, PublishFault> {
    let (target, ready, old) = (&place.target, place.beside(PlaceRole::Ready), place.beside(PlaceRole::Old));
    let staging = Staging::write(&place.beside(PlaceRole::New), &ready, files, target)?;
    let left = if !disk::exists(target) {
        disk::rename(staging.path(), target).map_err(PublishFault::io("create", target))?;
        None
    } else if disk::exchange(staging.path(), target).is_ok() {
        Some(ready)
    } else {
        disk::rename(target, &old).map_err(PublishFault::io("set aside", target))?;
        if let Err(error) = disk::rename(staging.path(), target) {
            let _ = disk::rename(&old, target);
            return Err(PublishFault::Io("replace", target.clone(), error));
        }
        Some(old)
    };
    staging.keep();
    // The build is published. Without a synced name a power cut may at most restore the old build.
    let _ = disk::sync_dir(&place.parent);
    Ok(left)
}
