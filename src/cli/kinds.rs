//! The kinds of files that `build` makes and `check` proves: the same arguments for both.

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::artifact::{Kind, KindRequest};
use crate::cli::failure::tell;
use crate::manifest::ManifestFile;

/// The kinds of files to make.
#[derive(clap::Args, Clone, Debug)]
pub(super) struct Kinds {
    /// Make only these kinds; the spec, the machine profile and the manifest are always written.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = kind_parser(Kind::ALL))]
    only: Vec<Kind>,
    /// Make these kinds too, which are not made by default.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = extra_parser())]
    with: Vec<Kind>,
}

impl Kinds {
    /// The kinds as the request that `artifact` reads.
    pub(super) fn request(&self) -> KindRequest {
        KindRequest { only: self.only.clone(), with: self.with.clone() }
    }

    /// Reports the requested kinds that no file of `made` has.
    pub(super) fn tell_missing(&self, made: &[ManifestFile]) {
        let named = self.only.iter().chain(&self.with);
        let missing = named.filter(|kind| made.iter().all(|file| file.kind != **kind));
        let names: Vec<&str> = missing.map(|kind| kind.name()).collect();
        if !names.is_empty() {
            tell(&format!("note: this design has no {}", names.join(", ")));
        }
    }

    /// Whether neither `--only` nor `--with` names a kind.
    pub(super) fn is_default(&self) -> bool {
        self.only.is_empty() && self.with.is_empty()
    }
}

fn extra_parser() -> impl TypedValueParser<Value = Kind> {
    let extras: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_extra()).collect();
    kind_parser(&extras)
}

fn kind_parser(kinds: &[Kind]) -> impl TypedValueParser<Value = Kind> + use<> {
    PossibleValuesParser::new(kinds.iter().map(|kind| kind.name()))
        .try_map(|name| Kind::from_name(&name).ok_or("no such kind"))
}
