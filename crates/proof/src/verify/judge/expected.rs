//! The expected content of a build's files, and the files in memory.

use crate::manifest::Manifest;
use crate::verify::{Finding, FindingCode};
use design::Design;
use spec::{Machine, Spec};
use std::borrow::Cow;

/// Everything that the files of a build must agree with. None of it was read from them but the spec and the profile.
#[derive(Clone, Copy, Debug)]
pub struct Expected<'a> {
    /// The exact geometry.
    pub design: &'a Design,
    /// The spec.
    pub spec: &'a Spec,
    /// The machine.
    pub machine: &'a Machine,
    /// The prediction as JSON, made anew; `None` for a spec without a load.
    pub prediction: Option<&'a str>,
    /// The figures that the manifest should give; its list of files does not matter.
    pub manifest: &'a Manifest,
}

/// The files of an output directory, by name.
#[derive(Clone, Debug, Default)]
pub struct OutputFiles<'a> {
    /// (name, content), in any order.
    pub files: Vec<(Cow<'a, str>, Cow<'a, [u8]>)>,
    /// Entries that are no regular files, with what each is: "a link". Their content is not known.
    pub others: Vec<(Cow<'a, str>, &'static str)>,
    /// Files that are longer than any file of a build, and are not read: (name, length in bytes).
    pub long: Vec<(Cow<'a, str>, u64)>,
}

impl<'a, N: Into<Cow<'a, str>>, B: Into<Cow<'a, [u8]>>> FromIterator<(N, B)> for OutputFiles<'a> {
    /// A directory of regular files alone.
    fn from_iter<I: IntoIterator<Item = (N, B)>>(files: I) -> Self {
        let files = files.into_iter().map(|(name, bytes)| (name.into(), bytes.into()));
        Self { files: files.collect(), ..Self::default() }
    }
}

impl OutputFiles<'_> {
    /// The content of the file called `name`.
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files.iter().find(|(known, _)| known == name).map(|(_, bytes)| bytes.as_ref())
    }

    /// The names of all entries.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let other_names = self.others.iter().map(|(name, _)| name.as_ref());
        let long = self.long.iter().map(|(name, _)| name.as_ref());
        self.files.iter().map(|(name, _)| name.as_ref()).chain(other_names).chain(long)
    }

    /// The finding that there is no file called `name`, which should be `allowed`: another entry has its name, or one that is not
    /// read, or none.
    pub fn lacks(&self, name: &str, allowed: &str) -> Finding {
        let other = self.others.iter().find(|(known, _)| known == name);
        let long = self.long.iter().find(|(known, _)| known == name);
        let finding = match (other, long) {
            (Some((_, what)), _) => {
                Finding::new(FindingCode::NotAFile, *what, format!("{allowed} as a regular file"))
            }
            (_, Some((_, bytes))) => Finding::new(
                FindingCode::Size,
                format!("{bytes} bytes"),
                format!("{allowed} as long as built"),
            ),
            (None, None) => Finding::new(FindingCode::MissingFile, "no such file", allowed),
        };
        finding.in_file(name)
    }
}
