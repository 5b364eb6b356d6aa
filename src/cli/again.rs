//! Builds anew whenever a file is saved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use crate::cli::load::read_source;
use crate::spec;

/// Between two looks: soon enough for a person, and no load.
const PAUSE: Duration = Duration::from_millis(250);

/// Of every file when it was written and how long it is; `None` while it is not there.
type Stamps = BTreeMap<PathBuf, Option<(SystemTime, u64)>>;

/// Calls `build`, and again whenever a spec of `specs` or the machine profile that it names is another; never ends.
pub(super) fn on_every_save(specs: &[PathBuf], mut build: impl FnMut()) -> ! {
    loop {
        let before = stamps(specs);
        build();
        loop {
            sleep(PAUSE);
            let now = stamps(specs);
            // Editors take a file away for a moment when they save it.
            if now != before && specs.iter().all(|spec| now.get(spec).is_some_and(Option::is_some)) {
                break;
            }
        }
    }
}

fn stamps(specs: &[PathBuf]) -> Stamps {
    let files = specs.iter().flat_map(|spec| [Some(spec.clone()), profile(spec)]).flatten();
    files.map(|file| (file.clone(), stamp(&file))).collect()
}

/// The profile that a spec names, if it is a file of one's own.
fn profile(spec: &Path) -> Option<PathBuf> {
    let source = read_source(spec).ok()?;
    let name = spec::read(&source).ok()?.spec.machine.profile;
    let builtin = spec::builtin_machine(&name).is_some();
    (!builtin).then(|| spec.with_file_name(name))
}

fn stamp(file: &Path) -> Option<(SystemTime, u64)> {
    let known = file.metadata().ok()?;
    Some((known.modified().ok()?, known.len()))
}
