//! The kinds of files that `build` makes and `check` proves: the same arguments for both.

use std::collections::BTreeMap;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::cli::failure::{Failure, tell};
use crate::cli::load::Loaded;
use crate::cli::words::count_beyond;
use crate::pipeline::{Built, Forecast, no_requested_programs};
use design::Paper;
use proof::artifact::{Kind, KindRequest, Output, too_large};

/// The kinds of files to make.
#[derive(clap::Args, Clone, Debug)]
pub(super) struct Kinds {
    /// Make only these kinds; the spec, the machine profile and the manifest are always written.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = kind_parser(|_| true))]
    only: Vec<Kind>,
    /// Make these kinds too, which are not made by default.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = kind_parser(Kind::is_extra))]
    with: Vec<Kind>,
}

impl Kinds {
    /// The kinds as the request that `artifact` reads.
    pub(super) fn request(&self) -> KindRequest {
        KindRequest { only: self.only.clone(), with: self.with.clone() }
    }

    /// Refuses programs that the machine does not run.
    pub(super) fn refuse_programs(&self, loaded: &Loaded) -> Result<(), Failure> {
        no_requested_programs(&loaded.reading.spec, &loaded.machine, &self.request())
            .map_err(|refusals| loaded.refused(refusals))
    }

    /// Reports the kinds named in the options that the design of `built` does not have, and the files of `request` that are too large for
    /// their paper.
    pub(super) fn tell_missing(&self, built: &Built, request: &KindRequest) {
        let Built { forecast: Forecast { spec, design, .. }, manifest, .. } = built;
        let large = too_large(spec, design, request);
        let named = self.only.iter().chain(&self.with);
        let mut kinds: Vec<Kind> = manifest.files.iter().map(|file| file.kind).collect();
        kinds.extend(large.iter().map(|file| file.kind));
        let names: Vec<&str> = named.filter(|kind| !kinds.contains(kind)).map(|kind| kind.name()).collect();
        if !names.is_empty() {
            tell(&format!("note: this design has no {}", names.join(", ")));
        }
        tell(&left_out(&large));
    }

    /// Whether neither `--only` nor `--with` names a kind.
    pub(super) fn is_default(&self) -> bool {
        self.only.is_empty() && self.with.is_empty()
    }
}

/// Most files that a note names.
const SHOWN: usize = 4;

/// The notes on files that are too `large` for their paper, a line for each reason.
fn left_out(large: &[Output]) -> String {
    let mut by_reason: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for output in large {
        let reason = output.paper.map_or_else(String::new, Paper::excess);
        by_reason.entry(reason).or_default().push(output.name());
    }
    let line = |(reason, names): (String, Vec<String>)| {
        let number = names.len();
        let remainder =
            count_beyond(number, SHOWN).map_or_else(String::new, |more| format!(" and {more} more"));
        let list = names.into_iter().take(SHOWN).collect::<Vec<_>>().join(", ") + &remainder;
        let (verb, need) = if number == 1 { ("is", "it needs") } else { ("are", "each needs") };
        format!("note: {list} {verb} left out: {need} {reason}; SVG and DXF have no limit")
    };
    by_reason.into_iter().map(line).collect::<Vec<_>>().join("\n")
}

/// The parser of the kinds that are `allowed`.
fn kind_parser(allowed: fn(Kind) -> bool) -> impl TypedValueParser<Value = Kind> {
    let names = Kind::ALL.iter().filter(|kind| allowed(**kind)).map(|kind| kind.name());
    PossibleValuesParser::new(names).try_map(|name| Kind::from_name(&name).ok_or("no such kind"))
}
