//! `--fabric NAME`: a material by its name, from the user's own list, from those that come with the program, or from a file.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::defaults;
use crate::cli::escape::escaped_line;
use crate::cli::failure::{Failure, tell};
use crate::cli::source_file::read_source;
use crate::cli::whole_file::is_standard_input;
use spec::Source;

/// Argument of commands that take a spec.
#[derive(clap::Args, Clone, Debug, Default)]
pub(super) struct FabricArg {
    /// A fabric by its name, in place of the spec's values: materials/NAME.toml beside your defaults, "paper", or a file, such as what
    /// `calibrate` prints.
    #[arg(long, value_name = "NAME")]
    pub(super) fabric: Option<String>,
}

impl FabricArg {
    /// The spec `source` with the values of the fabric; tells which file they are from unless `quiet`.
    pub(super) fn written_into(&self, source: Source, quiet: bool) -> Result<Source, Failure> {
        let Some(name) = &self.fabric else { return Ok(source) };
        let fabric = material(name)?;
        if spec::seals_by_laser(&source) && gives_off_chlorine(name) {
            return Err(Failure::Message(chlorine_refused(name)));
        }
        let text = spec::with_material(&source, &fabric)?;
        if !quiet {
            tell(&format!("note: the values of the fabric are from {}", escaped_line(&fabric.name)));
        }
        Ok(Source::new(format!("{} with the fabric {name}", source.name), text))
    }
}

/// Names of polyvinyl chloride, in lower case: a laser makes hydrogen chloride of it.
const CHLORINATED: [&str; 3] = ["pvc", "vinyl", "polyvinylchlorid"];

/// Whether a fabric called `name` is PVC.
fn gives_off_chlorine(name: &str) -> bool {
    let plain: String = name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    CHLORINATED.iter().any(|word| plain.contains(word))
}

/// The message that no laser seals the fabric `name`.
fn chlorine_refused(name: &str) -> String {
    format!(
        "the fabric {} is PVC by its name, and the spec seals with a laser: the fumes are toxic and corrode the machine; take another \
         fabric, or seal it with an iron or a press",
        escaped_line(name)
    )
}

/// The ending of a material's file.
const ENDING: &str = "toml";

/// The material called `name`: of the user's own list, of the program, or of a file.
pub(super) fn material(name: &str) -> Result<Source, Failure> {
    let path = Path::new(name);
    if is_standard_input(path) || path.components().count() > 1 {
        return read_source(path);
    }
    let own_file = own_list().map(|list| list.join(format!("{name}.{ENDING}"))).filter(|file| file.is_file());
    if let Some(file) = own_file {
        return read_source(&file);
    }
    if let Some(text) = spec::builtin_material(name) {
        return Ok(Source::new(format!("the fabric {name} of this program"), text));
    }
    let is_file = path.exists() && !path.is_dir();
    if is_file { read_source(path) } else { Err(Failure::Message(unknown(name))) }
}

/// The folder of the user's own materials.
fn own_list() -> Option<PathBuf> {
    Some(defaults::folder()?.join("materials"))
}

/// The names of all materials in the order of the alphabet.
fn names() -> Vec<String> {
    let entries = own_list().and_then(|list| fs::read_dir(list).ok()).into_iter().flatten().flatten();
    let files = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|ending| ending == ENDING));
    let own_names = files.filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()));
    let mut names: Vec<String> = own_names.chain(spec::builtin_materials().map(str::to_owned)).collect();
    names.sort();
    names.dedup();
    names
}

/// The message that no material is called `name`, with the nearest one and the list.
fn unknown(name: &str) -> String {
    let all_names = names();
    let nearest = spec::nearest(name, all_names.iter().map(String::as_str));
    let suggestion =
        nearest.map_or(String::new(), |nearest| format!("; did you mean {}?", escaped_line(nearest)));
    let list: Vec<String> = all_names.iter().map(escaped_line).collect();
    let place =
        own_list().map_or(String::new(), |list| format!(" (yours are files in {})", escaped_line(list)));
    format!(
        "no fabric and no file is called {}; there are: {}{place}{suggestion}",
        escaped_line(name),
        list.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pvc_is_known_by_its_names() {
        for (name, is_chlorinated) in [
            ("PVC banner", true),
            ("materials/soft-pvc.toml", true),
            ("Poly-Vinyl-Chloride", true),
            ("vinyl", true),
            ("paper", false),
            ("TPU 70D nylon", false),
        ] {
            assert_eq!(gives_off_chlorine(name), is_chlorinated, "{name}");
        }
    }
}
