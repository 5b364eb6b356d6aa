//! Writes a build into a hidden staging directory.

use std::borrow::Cow;
use std::fs;
use std::path::Path;

use crate::cli::publish::disk;
use crate::cli::publish::fault::PublishFault;

/// A file to publish: its name and content.
pub(super) type StagedFile<'a> = (&'a str, Cow<'a, [u8]>);

/// Writes `files` into the new directory `new`, syncs them, and then renames it to `ready`. The directory and its files get the modes of
/// `model` and of the files in it, if it exists. After a fault the directory is removed.
pub(super) fn write(
    [new, ready]: [&Path; 2],
    files: &[StagedFile<'_>],
    model: &Path,
) -> Result<(), PublishFault> {
    disk::create_dir(new).map_err(PublishFault::io("create", new))?;
    fill(new, files, model)
        .and_then(|()| disk::rename(new, ready).map_err(PublishFault::io("create", ready)))
        .inspect_err(|_| {
            // A failed removal is harmless: the next publication removes it.
            let _ = disk::remove_tree(new);
        })
}

fn fill(path: &Path, files: &[StagedFile<'_>], model: &Path) -> Result<(), PublishFault> {
    // The mode is set before the files are written, so that private files are never readable by others.
    if let Some(model_mode) = mode(model) {
        disk::set_permissions(path, model_mode).map_err(PublishFault::io("set the mode of", path))?;
    }
    for (name, bytes) in files {
        let file = path.join(name);
        let old_file = model.join(name);
        let file_mode = if disk::is_plain(&old_file) { mode(&old_file) } else { None };
        disk::write_new(&file, bytes, file_mode).map_err(PublishFault::io("write", &file))?;
    }
    disk::sync_dir(path).map_err(PublishFault::io("sync", path))
}

fn mode(path: &Path) -> Option<fs::Permissions> {
    Some(fs::symlink_metadata(path).ok()?.permissions())
}

/// Removes the directory `ready`, which was not published. It gets its first name again, which marks it as incomplete.
pub(super) fn discard([new, ready]: [&Path; 2]) {
    if disk::rename(ready, new).is_ok() {
        let _ = disk::remove_tree(new);
    }
}
