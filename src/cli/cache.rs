//! A cache of slow answers. The key is a hash of the question's text and of the program that answers.
//!
//! The folder is `$XDG_CACHE_HOME/stargrip-cam`, or `~/.cache/stargrip-cam`, on Windows in `%LOCALAPPDATA%`. It may be deleted at any time.
//! A file that cannot be read, or is damaged, counts as missing; an answer that cannot be written is not kept.

use std::env;
use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

use crate::cli::whole_file::write_whole;
use spec::digest::{of_parts, sha256};

/// The cache; without a directory it stores nothing.
pub(super) struct Cache {
    dir: Option<PathBuf>,
}

impl Cache {
    /// The user's cache; without a directory if it is `unwanted` or the system names none.
    pub(super) fn new(unwanted: bool) -> Self {
        let home = if cfg!(windows) {
            absolute_path("LOCALAPPDATA")
        } else {
            absolute_path("HOME").map(|home| home.join(".cache"))
        };
        let base = absolute_path("XDG_CACHE_HOME").or(home);
        Self { dir: base.filter(|_| !unwanted).map(|base| base.join(env!("CARGO_PKG_NAME"))) }
    }

    /// The key of a question. It changes with the program's version and with its build.
    pub(super) fn key(&self, question: &[&str]) -> String {
        let program = self.dir.as_ref().and_then(|_| {
            let path = ELSEWHERE.get().cloned().map_or_else(env::current_exe, Ok);
            path.and_then(fs::read).ok()
        });
        let program = program.unwrap_or_default();
        let parts = [&program[..], env!("CARGO_PKG_VERSION").as_bytes()];
        of_parts(parts.into_iter().chain(question.iter().map(|part| part.as_bytes())))
    }

    /// The parts of a stored answer; `None` if there is none or it is damaged.
    pub(super) fn get(&self, key: &str) -> Option<Vec<Vec<u8>>> {
        let path = self.dir.as_ref()?.join(key);
        let stored = fs::read(Some(path).filter(|path| path.is_file())?).ok()?;
        let (sum, content) = divided_at_line(&stored)?;
        if sum != sha256(content).as_bytes() {
            return None;
        }
        let (lengths, mut rest) = divided_at_line(content)?;
        let lengths: Vec<usize> = serde_json::from_slice(lengths).ok()?;
        let mut parts = Vec::new();
        for length in lengths {
            let (part, remaining) = rest.split_at_checked(length)?;
            parts.push(part.to_vec());
            rest = remaining;
        }
        Some(parts)
    }

    /// Stores an answer atomically: its checksum, the lengths of its parts, and the parts.
    pub(super) fn store(&self, key: &str, parts: &[Vec<u8>]) {
        let Some(dir) = &self.dir else { return };
        let lengths: Vec<usize> = parts.iter().map(Vec::len).collect();
        let content = [format!("{lengths:?}\n").as_bytes(), &parts.concat()].concat();
        let stored = [format!("{}\n", sha256(&content)).as_bytes(), &content].concat();
        let _ = fs::create_dir_all(dir).and_then(|()| write_whole(&dir.join(key), &stored));
    }
}

/// The path in a variable of the environment, if it is an absolute one.
fn absolute_path(variable: &str) -> Option<PathBuf> {
    env::var_os(variable).map(PathBuf::from).filter(|path| path.is_absolute())
}

/// The first line without its end, and the rest.
fn divided_at_line(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    Some((&bytes[..end], &bytes[end + 1..]))
}

/// The library with this program's code, if it is not in the process's own file.
static ELSEWHERE: OnceLock<PathBuf> = OnceLock::new();

/// Sets the `file` with this program's code: a library that another program has loaded. Keys then depend on it, not on that program. Only
/// the first call has an effect.
pub fn code_is_in(file: PathBuf) {
    let _ = ELSEWHERE.set(file);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_torn_or_of_another_question_is_not_there() {
        let dir = tempfile::tempdir().expect("a folder");
        let cache = Cache { dir: Some(dir.path().join("new")) };
        let key = cache.key(&["ab", "c"]);
        assert_ne!(key, cache.key(&["a", "bc"]));
        assert_eq!(cache.get(&key), None);
        let parts = [b"x\n".to_vec(), Vec::new(), vec![0, 255]];
        cache.store(&key, &parts);
        assert_eq!(cache.get(&key), Some(parts.to_vec()));
        let path = dir.path().join("new").join(&key);
        let bytes = fs::read(&path).expect("kept");
        for torn in [0, 10, 64, 65, bytes.len() - 1] {
            fs::write(&path, &bytes[..torn]).expect("written");
            assert_eq!(cache.get(&key), None, "{torn}");
        }
        let entries: Vec<_> = fs::read_dir(dir.path().join("new")).expect("a folder").collect();
        assert_eq!(entries.len(), 1);
        Cache { dir: None }.store(&key, &parts);
    }
}
