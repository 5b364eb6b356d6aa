//! Publishing: an output directory appears whole or not at all, and nothing of anybody's is lost.
//!
//! The files are written into a hidden directory beside the target, which then takes the target's
//! place in one step ([`exchange`]), or file by file where that cannot be ([`journal`]). A target that holds
//! a file its manifest does not name is not touched. The old build is looked at once more before it goes
//! ([`retire`]). What a killed publication leaves behind, the next one in the same parent removes; two
//! at a time wait for each other. docs/reliability.md has the guarantees, and how they are measured.

mod disk;
mod exchange;
mod fault;
#[cfg(test)]
mod faults;
mod journal;
mod place;
mod record;
mod retire;
mod stage;

use std::fmt;
use std::path::{Path, PathBuf};

use crate::artifact::Kind;
use crate::cli::escape::shown;
use crate::cli::publish::place::TargetPlace;
use crate::cli::publish::record::PublishRecord;
use crate::cli::publish::stage::StagedFile;
use crate::manifest::MANIFEST;
use crate::pipeline::Proven;

pub use fault::PublishFault;

/// What a person should know of a publication; it prints as one line for each, with nothing if all is as usual.
#[derive(Debug, Default)]
pub struct Published {
    /// What the spec of the replaced build called its design, if it is another than the new one's.
    pub replaced: Option<String>,
    /// Files that were put into the target, or changed by hand, since it was built: where they are now.
    pub kept: Vec<PathBuf>,
    /// Why the old build could not be removed; it stays under a hidden name.
    pub left: Option<PublishFault>,
}

impl fmt::Display for Published {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(name) = &self.replaced {
            writeln!(f, "note: this replaces the build of another design, {}", shown(name))?;
        }
        for path in &self.kept {
            writeln!(f, "warning: not of the replaced build, or changed since: kept as {}", shown(path))?;
        }
        if let Some(fault) = &self.left {
            writeln!(f, "warning: {fault}; the old build is left there, and the next build here removes it")?;
        }
        Ok(())
    }
}

/// The kinds that the build in `target` has beside those that come by default; none where there is no build.
pub(super) fn extras_of(target: &Path) -> Vec<Kind> {
    let with = PublishRecord::read(target).map_or_else(Vec::new, |record| record.with);
    with.iter().filter_map(|name| Kind::from_name(name)).filter(|kind| kind.is_extra()).collect()
}

/// Puts the files of `proven` into the directory `target`, replacing what an earlier publication put there.
///
/// # Errors
/// See [`PublishFault`]; the target is then as it was before.
pub fn publish(target: &Path, proven: &Proven) -> Result<Published, PublishFault> {
    let files: Vec<StagedFile<'_>> = proven.built().files().collect();
    put(target, &files)
}

/// Puts proven `files` that are no build's, the manifest last, into the directory `target`.
///
/// # Errors
/// See [`PublishFault`]; the target is then as it was before.
pub(super) fn publish_files(target: &Path, files: &[(&str, Vec<u8>)]) -> Result<Published, PublishFault> {
    let files: Vec<StagedFile<'_>> =
        files.iter().map(|(name, bytes)| (*name, bytes.as_slice().into())).collect();
    put(target, &files)
}

/// Puts `files` (name, content) into the directory `target`.
fn put(target: &Path, files: &[StagedFile<'_>]) -> Result<Published, PublishFault> {
    let place = TargetPlace::new(target)?;
    let locks = place.lock();
    let mut kept = retire::sweep(&place, locks.alone())?;
    kept.extend(journal::recover(&place)?);
    let before = record::ours(&place.target)?;
    let after =
        files.iter().find(|(name, _)| *name == MANIFEST).and_then(|(_, bytes)| PublishRecord::parse(bytes));
    let by_files = || journal::publish(&place, files, before.as_ref()).map(Some);
    let old = if place.underfoot() {
        by_files()?
    } else {
        match exchange::publish(&place, files) {
            Err(fault) if fault.bound() && place.target.is_dir() => by_files()?,
            result => result?,
        }
    };
    let mut left = None;
    if let Some(old) = old {
        match retire::retire(&old, after.as_ref(), &place.kept(&old)) {
            Ok(more) => kept.extend(more),
            Err(fault) => left = Some(fault),
        }
    }
    let name = after.map(|record| record.name);
    let replaced = before.map(|record| record.name).filter(|old| name.as_ref().is_some_and(|new| new != old));
    Ok(Published { replaced, kept, left })
}
