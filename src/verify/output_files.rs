//! An output directory in memory.

use std::borrow::Cow;

/// The files of an output directory, by name.
#[derive(Clone, Debug, Default)]
pub struct OutputFiles<'a> {
    /// (name, content), in any order.
    pub files: Vec<(Cow<'a, str>, Cow<'a, [u8]>)>,
}

impl OutputFiles<'_> {
    /// The content of the file called `name`.
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files.iter().find(|(known, _)| known == name).map(|(_, bytes)| bytes.as_ref())
    }
}
