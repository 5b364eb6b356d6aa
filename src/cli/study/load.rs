//! From paths and arguments to a study.

use std::path::Path;

use crate::cli::escape::shown;
use crate::cli::failure::Failure;
use crate::cli::load::{Loaded, read_source};
use crate::cli::verbosity::Verbosity;
use crate::forecast::study::Study;
use crate::spec;
use crate::spec::study::{Axis, read_study};

/// The study in the file `path`, around the spec that it names.
pub(in crate::cli) fn loaded(path: &Path, verbosity: Verbosity) -> Result<Study, Failure> {
    let source = read_source(path)?;
    if spec::read(&source).is_ok() {
        let text = "this is a spec and varies no key: add --vary KEY=VALUES, or name a study file";
        return Err(Failure::Usage(text.to_owned()));
    }
    let file = read_study(&source)?;
    let spec = path.parent().unwrap_or(Path::new("")).join(&file.spec);
    if !spec.exists() {
        let text = format!("`spec` in {} names {}, and there is no such file", shown(path), shown(&spec));
        return Err(Failure::File(path.display().to_string(), text));
    }
    let around = Loaded::spoken(&spec, verbosity)?.with_stars("study")?;
    Ok(Study::new(&file, &around.source)?)
}

/// The spec at `path` with the values of `vary`, "KEY=VALUES" each.
pub(in crate::cli) fn varied(path: &Path, vary: &[String], verbosity: Verbosity) -> Result<Study, Failure> {
    let around = Loaded::spoken(path, verbosity)?.with_stars("study")?;
    let axes = vary.iter().map(|text| Axis::parse(text)).collect::<Result<Vec<_>, _>>();
    Study::vary(&around.source, axes.map_err(Failure::Message)?)?.map_err(Failure::Message)
}
