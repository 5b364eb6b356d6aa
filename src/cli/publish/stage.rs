//! Writes a build into a hidden staging directory.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::publish::disk;
use crate::cli::publish::fault::PublishFault;

/// A file to publish: its name and content.
pub(super) type StagedFile<'a> = (&'a str, Cow<'a, [u8]>);

/// A complete, synced build in a hidden directory. Dropping it removes the directory.
#[derive(Debug)]
pub(super) struct Staging {
    new: PathBuf,
    path: PathBuf,
    armed: bool,
}

impl Staging {
    /// Writes `files` into the new directory `path`, and then renames it to `ready`. The directory and its files get the modes of `model`
    /// and of the files in it, if it exists.
    pub(super) fn write(
        path: &Path,
        ready: &Path,
        files: &[StagedFile<'_>],
        model: &Path,
    ) -> Result<Self, PublishFault> {
        disk::create_dir(path).map_err(PublishFault::io("create", path))?;
        let mut staging = Self { new: path.to_owned(), path: path.to_owned(), armed: true };
        let mode = |path: &Path| Some(fs::symlink_metadata(path).ok()?.permissions());
        // The mode is set before the files are written, so that private files are never readable by others.
        if let Some(mode) = mode(model) {
            disk::set_permissions(path, mode).map_err(PublishFault::io("set the mode of", path))?;
        }
        for (name, bytes) in files {
            let file = path.join(name);
            let before = model.join(name);
            let mode = if disk::is_plain(&before) { mode(&before) } else { None };
            disk::write_new(&file, bytes, mode).map_err(PublishFault::io("write", &file))?;
        }
        disk::sync_dir(path).map_err(PublishFault::io("sync", path))?;
        disk::rename(path, ready).map_err(PublishFault::io("create", ready))?;
        ready.clone_into(&mut staging.path);
        Ok(staging)
    }

    /// The path of the staging directory.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Keeps the directory when it is dropped.
    pub(super) fn keep(mut self) {
        self.armed = false;
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // A ready directory gets its first name again, which marks it as incomplete.
        if self.armed && (self.path == self.new || disk::rename(&self.path, &self.new).is_ok()) {
            // A failed removal is harmless: the next publication removes it.
            let _ = disk::remove_tree(&self.new);
        }
    }
}
