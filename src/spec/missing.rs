//! Required keys that are not written.

use std::ops::Range;

use crate::spec::FaultCode;
use crate::spec::fault::Fault;
use crate::spec::message::header;
use crate::spec::unknown::{Known, nearest, radius_of};

/// Required keys of one section that are not written.
pub(super) struct Missing {
    /// The section; "" for the keys before the first one.
    pub(super) section: &'static str,
    /// Whether the section itself is written.
    pub(super) is_written: bool,
    /// The span that the fault points to.
    pub(super) place: Range<usize>,
    /// Each key with an example of its value.
    pub(super) keys: Vec<(&'static str, &'static str)>,
}

/// The other product.
const DRAWING: &str = "or, for a drawing of your own:\n[drawing]\nfile = \"outline.svg\"\nlayers = { air = [\"chamber\"], port = [\"inlet\"] }";

impl Missing {
    /// The same without the keys that are only misspelt: an unknown key of the section, or an unknown
    /// section, that is near, or a diameter; `None` if nothing is left.
    pub(super) fn but_for(mut self, known: &[Known<'_>]) -> Option<Self> {
        let is_known = |section: &str| known.iter().any(|one| one.section == section);
        let misspelt = |section: &str, key: &str| {
            known.iter().filter(|one| one.section == section).any(|one| {
                let words = one.table.into_iter().flat_map(|table| &table.0).map(|entry| entry.key.as_str());
                let mut unknown =
                    words.filter(|word| !(one.keys.contains(word) || section.is_empty() && is_known(word)));
                unknown.any(|word| {
                    nearest(word, [key]).is_some() || radius_of(word).is_some_and(|radius| radius == key)
                })
            })
        };
        if !self.is_written && misspelt("", self.section) {
            return None;
        }
        let section = self.section;
        self.keys.retain(|(key, _)| !misspelt(section, key));
        (!self.keys.is_empty()).then_some(self)
    }

    /// The fault that reports the missing keys.
    pub(super) fn fault(self) -> Fault {
        let Self { section, is_written, place, keys } = self;
        let list = keys.iter().map(|(key, _)| format!("`{key}`")).collect::<Vec<_>>().join(", ");
        let lines = keys.iter().map(|(key, example)| format!("{key} = {example}")).collect::<Vec<_>>();
        let (message, help) = match (section, is_written) {
            ("", _) => (format!("the file has no {list}"), lines.join("\n")),
            (name, true) => (format!("{} has no {list}", header(name)), lines.join("\n")),
            ("star", false) => (
                format!("there is neither [star] nor [drawing]; a [star] needs {list}"),
                format!("[star]\n{}\n{DRAWING}", lines.join("\n")),
            ),
            (name, false) => (
                format!("there is no [{name}], which needs {list}"),
                format!("[{name}]\n{}", lines.join("\n")),
            ),
        };
        let label = if keys.len() == 1 { "this key is required" } else { "these keys are required" };
        let begin = if is_written { "" } else { "`stargrip-cam new` writes a whole spec to begin with; or " };
        Fault::error(FaultCode::MissingKey, place, message)
            .label(label)
            .help(format!("{begin}write for instance:\n{help}"))
    }
}
