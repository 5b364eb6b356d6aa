//! The manifest of a directory, and whether it still describes the directory.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::cli::publish::disk;
use crate::cli::publish::fault::{NOT_A_DIRECTORY, PublishFault};
use crate::cli::whole_file::first_bytes;
use crate::manifest::{MANIFEST, sha256};

/// Largest manifest that is read, bytes: ten times that of sixty-four stars.
const LARGEST: u64 = 1 << 24;

/// Largest file of a build, bytes: `verify` reads no larger one.
const LARGEST_FILE: u64 = 1 << 28;

/// What is wrong with an entry that is not replaced.
const LINK: &str = "is a link, so its directory is not changed; move it away or choose another directory";
const READ_ONLY: &str = "is read-only and is not changed; allow writing to it or choose another directory";

/// The part of a manifest that publishing needs. All versions of the program write it alike.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct PublishRecord {
    /// The design's name in the spec.
    pub(super) name: String,
    /// All files beside the manifest.
    pub(super) files: Vec<Recorded>,
}

/// One file.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Recorded {
    /// Name of the file, without a path.
    pub(super) path: String,
    /// The name of its kind.
    #[serde(default)]
    pub(super) kind: String,
    bytes: u64,
    sha256: String,
}

impl PublishRecord {
    /// The record in `directory`, if it exists.
    pub(super) fn read(directory: &Path) -> Option<Self> {
        let path = directory.join(MANIFEST);
        let size = fs::symlink_metadata(&path).ok().filter(fs::Metadata::is_file)?.len();
        let bytes = if size <= LARGEST { fs::read(path).ok()? } else { return None };
        Self::parse(&bytes)
    }

    /// The record in the bytes of a manifest.
    pub(super) fn parse(bytes: &[u8]) -> Option<Self> {
        let mut record: Self = serde_json::from_slice(bytes).ok()?;
        // A path that leads out of the directory is ignored, whatever program wrote the manifest.
        record.files.retain(|file| Path::new(&file.path).file_name().is_some_and(|name| *name == *file.path));
        Some(record)
    }

    fn find(&self, entry: &Path) -> Option<&Recorded> {
        let name = entry.file_name()?.to_str()?;
        self.files.iter().find(|file| file.path == name)
    }

    /// Whether `entry` is a file that the record names, or the manifest itself.
    pub(super) fn names(&self, entry: &Path) -> bool {
        disk::is_plain(entry) && (is_manifest(entry) || self.find(entry).is_some())
    }

    /// Whether `entry` is a file that the record names and still has the recorded bytes.
    pub(super) fn is_unchanged(&self, entry: &Path) -> bool {
        let Some(file) = self.find(entry).filter(|_| disk::is_plain(entry)) else { return false };
        // The length is compared first, so that no foreign file is read, whatever length the manifest states.
        let is_as_long = fs::metadata(entry).is_ok_and(|found| found.len() == file.bytes);
        if !is_as_long || file.bytes > LARGEST_FILE {
            return false;
        }
        let read = first_bytes(entry, file.bytes + 1);
        read.is_ok_and(|bytes| bytes.len() as u64 == file.bytes && sha256(&bytes) == file.sha256)
    }
}

pub(super) fn is_manifest(entry: &Path) -> bool {
    entry.file_name().is_some_and(|name| name == MANIFEST)
}

/// The record of the build in `target`; `None` if there is no target or it is empty.
///
/// # Errors
/// If no record names one of its entries, or if the directory is write-protected.
pub(super) fn read_record(target: &Path) -> Result<Option<PublishRecord>, PublishFault> {
    if !disk::exists(target) {
        return Ok(None);
    }
    let metadata = fs::metadata(target).map_err(PublishFault::io("read", target))?;
    if !metadata.is_dir() {
        return Err(PublishFault::Refused(target.to_owned(), NOT_A_DIRECTORY));
    }
    if !writable(target) {
        return Err(PublishFault::Refused(target.to_owned(), READ_ONLY));
    }
    let record = PublishRecord::read(target);
    for entry in disk::entries(target).map_err(PublishFault::io("read", target))? {
        if entry.is_symlink() {
            return Err(PublishFault::Refused(entry, LINK));
        }
        if !record.as_ref().is_some_and(|record| record.names(&entry)) {
            return Err(PublishFault::Foreign(entry));
        }
        if fs::metadata(&entry).is_ok_and(|metadata| metadata.permissions().readonly()) {
            return Err(PublishFault::Refused(entry, READ_ONLY));
        }
    }
    Ok(record)
}

/// Whether the directory may be written to. A directory without any write permission is protected, even for root.
fn writable(directory: &Path) -> bool {
    #[cfg(any(target_os = "linux", target_os = "android"))]
    if rustix::fs::access(directory, rustix::fs::Access::WRITE_OK).is_err() {
        return false;
    }
    fs::metadata(directory).is_ok_and(|found| !found.permissions().readonly())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_held_by_its_bytes_whatever_length_the_manifest_says() {
        let dir = tempfile::tempdir().expect("a directory");
        let entry = dir.path().join("a");
        fs::write(&entry, "a").expect("written");
        let hash = sha256(b"a");
        for (bytes, held) in [(1, true), (0, false), (2, false), (u64::MAX, false)] {
            let text = format!(
                r#"{{"name": "n", "files": [{{"path": "a", "bytes": {bytes}, "sha256": "{hash}"}}]}}"#
            );
            assert_eq!(
                PublishRecord::parse(text.as_bytes()).expect("a record").is_unchanged(&entry),
                held,
                "{bytes}"
            );
        }
        let record =
            PublishRecord::parse(br#"{"name": "n", "files": [{"path": "a", "bytes": 1, "sha256": "0"}]}"#);
        assert!(!record.expect("a record").is_unchanged(&entry));
    }
}
