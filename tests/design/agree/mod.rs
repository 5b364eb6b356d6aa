//! A spec that `check` accepts is published by `build` and accepted by `verify`: every finding about outputs has a refusal before
//! it.
//!
//! 400 random specs with all kinds of files in `make test`; twenty thousand with
//! `STARGRIP_AGREE=20000 cargo test --release --locked --test design agree::`. `STARGRIP_AGREE_FROM=n` begins at case `n`.

mod machines;
mod named;
mod specs;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use stargrip_cam::pipeline::{Forecast, Sources, prove_files};
use stargrip_cam::spec;
use stargrip_cam::spec::{KeyPath, Source, key};
use stargrip_cam::verify::Finding;

use specs::{Case, case};

/// Number of specs in a run without a setting.
const CASES: u64 = 400;

fn number(variable: &str, default: u64) -> u64 {
    std::env::var(variable).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// The findings in the files of a spec that `check` accepts; `None` if it is refused.
fn findings(case: &Case, verified: bool) -> Option<Vec<Finding>> {
    let reading = spec::read(&Source::new("spec", case.spec.as_str())).ok()?;
    let machine = spec::read_machine(&Source::new("machine", case.machine.as_str())).ok()?;
    let forecast = Forecast::new(reading.spec, machine).ok()?;
    let built = forecast.build(Sources { spec: &case.spec, machine: &case.machine }, &case.asked);
    // `verify` makes every file again beside reading it.
    let list = if verified { prove_files(&built.output_files()).findings } else { built.proof().findings };
    Some(list)
}

/// Keys that no random spec sets: only predictions or drawings have them, or a case has them in another form.
const NOT_SET: [KeyPath; 15] = [
    key::fabric::POISSON_RATIO,
    key::fabric::BENDING_STIFFNESS,
    key::fabric::STRETCH_STIFFNESS,
    key::fabric::SHEAR_MODULUS,
    key::fabric::WARP,
    key::sheet::COPIES,
    key::load::OBJECT_DIAMETER,
    key::load::OBJECT_HEIGHT,
    key::load::OBJECT_SHAPE,
    key::load::CHAMBERS,
    key::load::PLATES,
    key::accuracy::RESPONSE,
    key::mask::KIND,
    key::build::WITH,
    key::build::LINK,
];

#[test]
fn random_specs_set_every_key() {
    let keys_set: BTreeSet<String> = (0..CASES)
        .flat_map(|number| spec::form_settings(&Source::new("spec", case(number).spec)))
        .filter(|setting| setting.given)
        .map(|setting| format!("{}.{}", setting.section, setting.key))
        .collect();
    // A press runs no program that could disagree: tests/design/pressed.rs sets its keys. A process has a name of its own in place of a
    // key's section.
    let is_expected = |key: &&KeyPath| {
        !["", "drawing", "press", "process"].contains(&key.section())
            && !NOT_SET.contains(key)
            && **key != key::stack::STAR
    };
    let names = key::ALL.iter().filter(is_expected).map(ToString::to_string);
    let missing: Vec<String> = names.filter(|name| !keys_set.contains(name)).collect();
    assert!(missing.is_empty(), "tests/design/agree/specs.rs never writes {missing:?}");
}

#[test]
fn what_check_lets_pass_build_publishes_and_verify_accepts() {
    let (first, cases) = (number("STARGRIP_AGREE_FROM", 0), number("STARGRIP_AGREE", CASES));
    let passed = AtomicUsize::new(0);
    let wrong: BTreeMap<u64, Vec<Finding>> = (first..first + cases)
        .into_par_iter()
        .filter_map(|n| {
            let case_findings = findings(&case(n), n % 3 == 0)?;
            let _ = passed.fetch_add(1, Ordering::Relaxed);
            (!case_findings.is_empty()).then_some((n, case_findings))
        })
        .collect();
    for (n, case_findings) in &wrong {
        eprintln!(
            "case {n}: {} findings, {:?}",
            case_findings.len(),
            case_findings.iter().take(2).map(ToString::to_string).collect::<Vec<_>>()
        );
    }
    let passed = passed.into_inner();
    println!("{passed} of {cases} specs were built");
    if let Some(n) = wrong.keys().next() {
        let Case { spec, machine, asked: request } = case(*n);
        panic!("{} of {passed}: case {n}\n{request:?}\n{spec}\n{machine}", wrong.len());
    }
    assert!(u64::try_from(passed).unwrap_or(0) > cases / 5, "only {passed} of {cases} specs were built");
}
