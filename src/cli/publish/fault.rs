//! Reasons why a build was not published.

use std::path::{Path, PathBuf};
use std::{fmt, io};

use crate::cli::escape::escaped_line;

/// The reason why a build was not published; the target is unchanged.
#[derive(Debug)]
pub enum PublishFault {
    /// The target holds this entry, which the program did not write.
    Foreign(PathBuf),
    /// The target, or an entry of it, is not one that can be replaced: its path, and the reason with the remedy.
    Refused(PathBuf, &'static str),
    /// The target's name has this many bytes; the temporary names beside it would be too long.
    LongName(usize),
    /// The system refused.
    Io(&'static str, PathBuf, io::Error),
}

/// Longest name of an output directory, bytes: file systems take 255, `.NAME.stargrip-ready` needs 16 of them.
pub(super) const NAME_BYTES: usize = 235;

/// What is wrong with a target that is no directory.
pub(super) const NOT_A_DIRECTORY: &str = "exists and is not a directory; choose another with -o";

/// Remedy for a target in which the process runs.
pub(super) const CURRENT_DIRECTORY: &str = "is the current directory or holds it, and a build replaces its directory as a whole; choose \
                                            another with -o, such as -o out";

/// Remedy for a target that cannot be renamed.
pub(super) const MOUNT_POINT: &str =
    "is a mount point, and a build replaces its directory as a whole; choose a directory in it with -o";

impl PublishFault {
    /// The fault of the operation `operation` on `path`.
    pub(super) fn io(operation: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |error| Self::Io(operation, path, error)
    }

    /// The fault of replacing the directory `target`: a refusal where the system has something mounted there.
    pub(super) fn of_target(self, target: &Path) -> Self {
        use io::ErrorKind::{CrossesDevices, ResourceBusy};
        match self {
            Self::Io(_, _, error) if [CrossesDevices, ResourceBusy].contains(&error.kind()) => {
                Self::Refused(target.to_owned(), MOUNT_POINT)
            }
            fault => fault,
        }
    }
}

impl fmt::Display for PublishFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign(path) => write!(
                f,
                "{} is not named in a manifest beside it, so its directory is not changed; move it away or \
                 choose another directory",
                escaped_line(path)
            ),
            Self::Refused(path, why) => write!(f, "{} {why}", escaped_line(path)),
            Self::LongName(bytes) => write!(
                f,
                "the output directory's name has {bytes} bytes, at most {NAME_BYTES} are allowed; choose another with -o"
            ),
            Self::Io(what, path, error) => write!(f, "cannot {what} {}: {error}", escaped_line(path)),
        }
    }
}

impl std::error::Error for PublishFault {}
