//! Publishing: an output directory appears complete or not at all, and no file of the user is lost.
//!
//! The files are written into a hidden directory beside the target, which then takes the target's place in one step ([`exchange`]). A mount
//! point and the current directory cannot be replaced so, and are refused. A target with a file that its manifest does not name is not touched. The old build is
//! checked again before it is removed ([`retire`]). The next publication in the same parent removes the rest of a killed one; concurrent
//! publications wait for each other. docs/reliability.md has the guarantees, and their measurements.

mod disk;
mod exchange;
mod fault;
#[cfg(test)]
mod faults;
mod place;
mod record;
mod retire;
mod stage;

use std::fmt;
use std::path::{Path, PathBuf};

use crate::cli::escape::escaped_line;
use crate::cli::publish::place::TargetPlace;
use crate::cli::publish::record::PublishRecord;
use crate::cli::publish::stage::StagedFile;
use crate::manifest::MANIFEST;
use crate::pipeline::Proven;
use proof::artifact::Kind;

pub use fault::PublishFault;

/// Notes on a publication; each prints as one line, and without notes nothing is printed.
#[derive(Debug, Default)]
pub struct Published {
    /// The design's name in the spec of the replaced build, if it differs from the new one.
    pub replaced: Option<String>,
    /// Files that were added to the target, or edited, since it was built: their present places.
    pub kept: Vec<PathBuf>,
    /// The reason why the old build could not be removed; it keeps a hidden name.
    pub left: Option<PublishFault>,
}

impl fmt::Display for Published {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(name) = &self.replaced {
            writeln!(f, "note: this replaces the build of another design, {}", escaped_line(name))?;
        }
        for path in &self.kept {
            writeln!(
                f,
                "warning: not of the replaced build, or changed since: kept as {}",
                escaped_line(path)
            )?;
        }
        if let Some(fault) = &self.left {
            writeln!(f, "warning: {fault}; the old build is left there, and the next build here removes it")?;
        }
        Ok(())
    }
}

/// The extra kinds that the build in `target` has; empty without a build.
pub(super) fn extras_of(target: &Path) -> Vec<Kind> {
    let files = PublishRecord::read(target).map_or_else(Vec::new, |record| record.files);
    let has_file = |kind: &Kind| kind.is_extra() && files.iter().any(|file| file.kind == kind.name());
    Kind::ALL.iter().copied().filter(has_file).collect()
}

/// Publishes the files of `proven` in the directory `target`, and replaces an earlier build there.
///
/// # Errors
/// See [`PublishFault`]; the target is then unchanged.
pub fn publish(target: &Path, proven: &Proven) -> Result<Published, PublishFault> {
    publish_files(target, &proven.built().files().collect::<Vec<_>>())
}

/// Publishes `files` (name, content), which are proven, in the directory `target`, the manifest last.
///
/// # Errors
/// See [`PublishFault`]; the target is then unchanged.
pub(super) fn publish_files(target: &Path, files: &[StagedFile<'_>]) -> Result<Published, PublishFault> {
    let place = TargetPlace::new(target)?;
    // Without a lock of the parent another publication may run beside the target.
    let [parent, _target] = place.lock();
    let mut kept_entries = retire::sweep(&place, parent.is_some())?;
    let before = record::read_record(&place.target)?;
    let after =
        files.iter().find(|(name, _)| *name == MANIFEST).and_then(|(_, bytes)| PublishRecord::parse(bytes));
    let mut sweep_fault = None;
    if let Some(old) = exchange::publish(&place, files)? {
        match retire::retire(&old, after.as_ref(), &place.kept_path()) {
            Ok(more) => kept_entries.extend(more),
            Err(fault) => sweep_fault = Some(fault),
        }
    }
    let name = after.map(|record| record.name);
    let replaced = before.map(|record| record.name).filter(|old| name.as_ref().is_some_and(|new| new != old));
    Ok(Published { replaced, kept: kept_entries, left: sweep_fault })
}
