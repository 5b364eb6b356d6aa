//! The requested kinds of files of a design.

use crate::artifact::Kind;
use crate::spec::Spec;

/// The kinds of files that a build makes. Its manifest records them, so that `verify` knows the expected files. Their number and names
/// follow from the design.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KindRequest {
    /// The only kinds to make; empty: all that come by default.
    pub only: Vec<Kind>,
    /// Kinds to make in addition.
    pub with: Vec<Kind>,
}

impl KindRequest {
    /// These kinds and no others; all default kinds if `kinds` is empty.
    pub fn only(kinds: &[Kind]) -> Self {
        Self { only: kinds.to_vec(), with: Vec::new() }
    }

    /// Adds the kinds that `spec` names in `[build]`, unless `only` is set.
    #[must_use]
    pub fn of_spec(mut self, spec: &Spec) -> Self {
        if self.only.is_empty() {
            self.add(spec.build.with.iter().filter_map(|extra| Kind::from_name(extra.name())));
        }
        self
    }

    /// Adds these kinds.
    pub fn add(&mut self, kinds: impl IntoIterator<Item = Kind>) {
        for kind in kinds {
            if !self.with.contains(&kind) {
                self.with.push(kind);
            }
        }
    }

    /// Whether files of `kind` are made.
    pub fn takes(&self, kind: Kind) -> bool {
        let named = if self.only.is_empty() { !kind.is_extra() } else { self.only.contains(&kind) };
        named || kind.is_source() || self.with.contains(&kind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extras_come_where_they_are_named_and_sources_always() {
        let kinds = |request: &KindRequest| -> Vec<Kind> {
            Kind::ALL.iter().copied().filter(|kind| request.takes(*kind)).collect()
        };
        let extras: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_extra()).collect();
        assert!(extras.contains(&Kind::PreviewPng), "{extras:?}");
        let all = kinds(&KindRequest::default());
        assert_eq!(all.len() + extras.len(), Kind::ALL.len());
        assert!(extras.iter().all(|extra| !all.contains(extra)));
        let with = KindRequest { with: extras, ..KindRequest::default() };
        assert_eq!(kinds(&with), Kind::ALL);
        let some = KindRequest { only: vec![Kind::SealGcode], with: vec![Kind::PreviewPng] };
        let sources: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_source()).collect();
        assert_eq!(kinds(&some), [&sources[..], &[Kind::SealGcode, Kind::PreviewPng]].concat());
        assert_eq!(
            kinds(&KindRequest::only(&[Kind::PreviewPng])),
            [&sources[..], &[Kind::PreviewPng]].concat()
        );
    }
}
