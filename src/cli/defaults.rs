//! The user's defaults for new specs: `$XDG_CONFIG_HOME/stargrip-cam/config.toml`.

use std::env;
use std::path::PathBuf;

use crate::cli::failure::Failure;
use crate::cli::source_file::read_source;

/// The text of a new spec with the user's defaults, if there are any.
pub(super) fn written_into(text: String) -> Result<String, Failure> {
    match file().filter(|path| path.is_file()) {
        Some(path) => Ok(spec::with_defaults(&text, &read_source(&path)?)?),
        None => Ok(text),
    }
}

/// The file of defaults.
fn file() -> Option<PathBuf> {
    Some(folder()?.join("config.toml"))
}

/// The program's own folder in the system's directory for settings; `None` where the system has none.
pub(super) fn folder() -> Option<PathBuf> {
    let [data, home, config] = ["APPDATA", "HOME", "XDG_CONFIG_HOME"]
        .map(|name| env::var_os(name).filter(|path| !path.is_empty()).map(PathBuf::from));
    let usual = if cfg!(windows) { data } else { home.map(|home| home.join(".config")) };
    // The XDG standard ignores relative paths.
    let config = config.filter(|path| path.is_absolute()).or(usual)?;
    Some(config.join("stargrip-cam"))
}
