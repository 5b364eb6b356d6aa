//! Builds again whenever a file is saved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use crate::cli::source_file::read_source;

/// Interval of checks: fast enough for a user, and no load.
const PAUSE: Duration = Duration::from_millis(250);

/// Time of writing and length of every file; `None` if it does not exist.
type Stamps = BTreeMap<PathBuf, Option<(SystemTime, u64)>>;

/// Calls `build` with all of `specs`, and again with those that were saved, or whose drawing or machine profile was; never ends.
pub(super) fn on_every_save(specs: &[PathBuf], mut build: impl FnMut(&[PathBuf])) -> ! {
    let mut due = specs.to_vec();
    loop {
        let old_stamps: Vec<Stamps> = specs.iter().map(|spec| stamps(spec)).collect();
        build(&due);
        loop {
            sleep(PAUSE);
            let new_stamps = specs.iter().map(|spec| stamps(spec));
            let saved = specs
                .iter()
                .zip(old_stamps.iter().zip(new_stamps))
                .filter(|(_, (old_stamps, new_stamps))| *old_stamps != new_stamps);
            let saved: Vec<(&PathBuf, Stamps)> =
                saved.map(|(spec, (_, new_stamps))| (spec, new_stamps)).collect();
            // Editors remove a file for a moment while they save it.
            if !saved.is_empty()
                && saved.iter().all(|(spec, new_stamps)| new_stamps.get(*spec).is_some_and(Option::is_some))
            {
                due = saved.into_iter().map(|(spec, _)| spec.clone()).collect();
                break;
            }
        }
    }
}

fn stamps(spec: &Path) -> Stamps {
    let files = std::iter::once(spec.to_owned()).chain(named(spec));
    files.map(|file| (file.clone(), stamp(&file))).collect()
}

/// The files that a spec names: its drawing, and a profile of the user's own.
fn named(path: &Path) -> Vec<PathBuf> {
    let read = read_source(path).ok().and_then(|source| spec::read(&source).ok());
    let Some(reading) = read else { return Vec::new() };
    let profile = Some(reading.spec.machine.profile).filter(|name| spec::builtin_machine(name).is_none());
    let files = profile.into_iter().chain(reading.spec.drawing.map(|drawing| drawing.file));
    files.map(|name| path.with_file_name(name)).collect()
}

fn stamp(file: &Path) -> Option<(SystemTime, u64)> {
    let metadata = file.metadata().ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}
