//! Writing a build where nobody sees it.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::publish::disk;
use crate::cli::publish::fault::PublishFault;

/// A file to publish: its name and content.
pub(super) type StagedFile<'a> = (&'a str, Cow<'a, [u8]>);

/// A whole build in a hidden directory, synced. It goes when it is dropped.
#[derive(Debug)]
pub(super) struct Staging {
    new: PathBuf,
    path: PathBuf,
    armed: bool,
}

impl Staging {
    /// Writes `files` into the new directory `path`, and then gives it the name `ready`. The directory and
    /// its files get the modes of `model` and of the files there, if there is one.
    pub(super) fn write(
        path: &Path,
        ready: &Path,
        files: &[StagedFile<'_>],
        model: &Path,
    ) -> Result<Self, PublishFault> {
        disk::create_dir(path).map_err(PublishFault::io("create", path))?;
        let mut staging = Self { new: path.to_owned(), path: path.to_owned(), armed: true };
        let mode = |path: &Path| Some(fs::symlink_metadata(path).ok()?.permissions());
        // Before the files: what nobody else may see is not seen while it is written.
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

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Lets it stay.
    pub(super) fn keep(mut self) {
        self.armed = false;
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // What is ready gets its first name again: under that one, no part of it is of use to anybody.
        if self.armed && (self.path == self.new || disk::rename(&self.path, &self.new).is_ok()) {
            // Failing to remove it harms nothing: the next publication does.
            let _ = disk::remove_tree(&self.new);
        }
    }
}
