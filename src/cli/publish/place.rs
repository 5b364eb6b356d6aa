//! The place of a publication: the target, its hidden neighbours, the locks.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::{env, fs};

use crate::cli::publish::disk;
use crate::cli::publish::fault::{CURRENT_DIRECTORY, MOUNT_POINT, NAME_BYTES, NOT_A_DIRECTORY, PublishFault};
use crate::cli::whole_file::directory_of;

/// The purpose of a hidden directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlaceRole {
    /// Incomplete: it can be removed at any time.
    New,
    /// A complete build before it takes the target's place, or an old one after the exchange.
    Ready,
    /// An old build, set aside.
    Old,
}

impl PlaceRole {
    pub(super) const ALL: [Self; 3] = [Self::New, Self::Ready, Self::Old];

    fn suffix(self) -> &'static str {
        match self {
            Self::New => ".stargrip-new",
            Self::Ready => ".stargrip-ready",
            Self::Old => ".stargrip-old",
        }
    }
}

/// A resolved target.
#[derive(Debug)]
pub(super) struct TargetPlace {
    /// The output directory; links in its path are resolved.
    pub(super) target: PathBuf,
    /// The directory that holds it.
    pub(super) parent: PathBuf,
    name: OsString,
    _made: Parents,
}

impl TargetPlace {
    /// The place that `target` names. A link is followed, so that the directory it names is replaced and not the link.
    /// Missing parents are made, and removed again with the place if nothing was put into them.
    pub(super) fn new(target: &Path) -> Result<Self, PublishFault> {
        let resolved = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
        let nameless =
            || PublishFault::Refused(resolved.clone(), "cannot be an output directory; name one with -o");
        let name = resolved.file_name().ok_or_else(nameless)?.to_owned();
        // A pipe or a device is refused before the lock, for opening it may wait for ever; so is a link to nothing, or to itself.
        if disk::exists(&resolved) && !resolved.is_dir() {
            return Err(PublishFault::Refused(resolved, NOT_A_DIRECTORY));
        }
        if is_current_dir(&resolved) {
            return Err(PublishFault::Refused(resolved, CURRENT_DIRECTORY));
        }
        if is_mount_point(&resolved) {
            return Err(PublishFault::Refused(resolved, MOUNT_POINT));
        }
        if name.as_encoded_bytes().len() > NAME_BYTES {
            return Err(PublishFault::LongName(name.as_encoded_bytes().len()));
        }
        let parent = directory_of(&resolved);
        let new_parents =
            Parents(parent.ancestors().filter(|path| !path.exists()).map(Path::to_owned).collect());
        fs::create_dir_all(parent).map_err(PublishFault::io("create", parent))?;
        let parent = fs::canonicalize(parent).map_err(PublishFault::io("find", parent))?;
        let target = parent.join(&name);
        Ok(Self { target, parent, name, _made: new_parents })
    }

    /// The hidden directory beside the target.
    pub(super) fn hidden_path(&self, role: PlaceRole) -> PathBuf {
        let mut hidden = OsString::from(".");
        hidden.push(&self.name);
        hidden.push(role.suffix());
        self.parent.join(hidden)
    }

    /// The name, without its number, under which entries of an old build are kept.
    pub(super) fn kept_path(&self) -> PathBuf {
        kept_beside(&self.parent, &self.name)
    }

    /// Blocks other publications in the same parent, and into the same target from elsewhere. Systems that cannot lock directories have no
    /// lock. The first lock is that of the parent.
    pub(super) fn lock(&self) -> [Option<File>; 2] {
        [&self.parent, &self.target].map(|directory| {
            let file = directory.is_dir().then(|| File::open(directory))?.ok()?;
            file.lock().ok()?;
            Some(file)
        })
    }

    /// All hidden directories beside the target, of any target: path, target's name, role.
    pub(super) fn hidden(&self) -> Vec<(PathBuf, OsString, PlaceRole)> {
        let entries = disk::entries(&self.parent).unwrap_or_default();
        let hidden_entries = entries.into_iter().filter_map(|path| {
            let name = path.file_name()?.to_str()?.strip_prefix('.')?;
            let name_and_role =
                |role: PlaceRole| Some((OsString::from(name.strip_suffix(role.suffix())?), role));
            let (owner, role) = PlaceRole::ALL.into_iter().find_map(name_and_role)?;
            let is_own = !owner.is_empty() && path.symlink_metadata().is_ok_and(|found| found.is_dir());
            is_own.then(|| (path.clone(), owner, role))
        });
        hidden_entries.collect()
    }
}

/// The name, without its number, under which a part of the target `name` in `parent` is kept.
pub(super) fn kept_beside(parent: &Path, name: &OsStr) -> PathBuf {
    let mut kept_name = name.to_owned();
    kept_name.push(".kept");
    parent.join(kept_name)
}

/// Whether the process's current directory is `target` or in it: renaming the target would take it from under the process.
fn is_current_dir(target: &Path) -> bool {
    let current = env::current_dir().and_then(fs::canonicalize);
    current.is_ok_and(|current| current.starts_with(target))
}

/// Whether another file system begins at `target`, which therefore cannot be renamed. A directory that is bound from the same file system is
/// not recognised here: its renaming fails.
#[cfg(unix)]
fn is_mount_point(target: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let devices = [target, directory_of(target)].map(|path| fs::metadata(path).map(|entry| entry.dev()));
    matches!(devices, [Ok(own), Ok(parent)] if own != parent)
}

#[cfg(not(unix))]
fn is_mount_point(_: &Path) -> bool {
    false
}

/// Parent directories made for a publication, deepest first. The empty ones are removed with it.
#[derive(Debug)]
struct Parents(Vec<PathBuf>);

impl Drop for Parents {
    fn drop(&mut self) {
        for made in &self.0 {
            let _ = disk::remove_dir(made);
        }
    }
}
