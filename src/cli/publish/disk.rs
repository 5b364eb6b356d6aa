//! The file operations that publishing consists of.
//!
//! No other file of this module changes the disk. So a test can make each operation fail, or be the last one of a killed process
//! (`faults.rs`).

use std::fs::{File, Permissions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

#[cfg(test)]
use crate::cli::publish::faults::step;

/// Called before each operation; a test injects its fault here.
#[cfg(not(test))]
#[expect(clippy::unnecessary_wraps, reason = "in tests it fails")]
fn step(_: DiskStep, _: &Path) -> io::Result<()> {
    Ok(())
}

/// The kind of the next operation, as far as systems differ in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DiskStep {
    Rename,
    Exchange,
    Other,
}

pub(super) fn create_dir(path: &Path) -> io::Result<()> {
    step(DiskStep::Other, path)?;
    fs::create_dir(path)
}

/// Writes a new file and syncs it, so that a power cut leaves no empty file under this name.
pub(super) fn write_new(path: &Path, bytes: &[u8], permissions: Option<Permissions>) -> io::Result<()> {
    step(DiskStep::Other, path)?;
    let mut file = File::create_new(path)?;
    if let Some(permissions) = permissions {
        file.set_permissions(permissions)?;
    }
    let (first, rest) = bytes.split_at(bytes.len() / 2);
    file.write_all(first)?;
    step(DiskStep::Other, path)?; // a full disk leaves half of a file
    file.write_all(rest)?;
    file.sync_all()
}

pub(super) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    step(DiskStep::Rename, from)?;
    fs::rename(from, to)
}

pub(super) fn remove_file(path: &Path) -> io::Result<()> {
    step(DiskStep::Other, path)?;
    fs::remove_file(path)
}

/// Removes an empty directory; one that is not empty stays as it is.
pub(super) fn remove_dir(path: &Path) -> io::Result<()> {
    step(DiskStep::Other, path)?;
    fs::remove_dir(path)
}

/// Removes a directory of partly written files, if it exists.
pub(super) fn remove_tree(path: &Path) -> io::Result<()> {
    step(DiskStep::Other, path)?;
    #[cfg(unix)]
    if fs::metadata(path).is_ok_and(|found| found.permissions().readonly()) {
        use std::os::unix::fs::PermissionsExt;
        let _ = fs::set_permissions(path, Permissions::from_mode(0o700));
    }
    match fs::remove_dir_all(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

pub(super) fn set_permissions(path: &Path, permissions: Permissions) -> io::Result<()> {
    step(DiskStep::Other, path)?;
    fs::set_permissions(path, permissions)
}

/// The entries of a directory, sorted.
pub(super) fn entries(directory: &Path) -> io::Result<Vec<PathBuf>> {
    step(DiskStep::Other, directory)?;
    let paths = fs::read_dir(directory)?.map(|entry| Ok(entry?.path()));
    let mut paths = paths.collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

/// Syncs the names in a directory, so that they survive a power cut, where the system can.
pub(super) fn sync_dir(path: &Path) -> io::Result<()> {
    step(DiskStep::Other, path)?;
    if !cfg!(unix) {
        return Ok(()); // elsewhere a directory cannot be opened as a file
    }
    match File::open(path).and_then(|directory| directory.sync_all()) {
        // Some network file systems sync no directories.
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => {
            Ok(())
        }
        other => other,
    }
}

/// Exchanges two names in one step.
///
/// # Errors
/// If the system refuses, or cannot exchange names.
#[cfg(any(target_os = "linux", target_os = "android"))]
pub(super) fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    step(DiskStep::Exchange, a)?;
    Ok(renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_os = "android")))]
pub(super) fn exchange(a: &Path, _: &Path) -> io::Result<()> {
    step(DiskStep::Exchange, a)?;
    Err(io::ErrorKind::Unsupported.into())
}

/// Whether an entry of this name exists; a dangling link counts.
pub(super) fn exists(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// Whether this name is a regular file: no link, pipe, device or directory.
pub(super) fn is_plain(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_file())
}
