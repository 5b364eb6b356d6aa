//! The feed check in the pipeline: planned, read back, and only then written.

use crate::emit;
use crate::manifest::{FeedCheckManifest, ManifestFile, Tool, sha256};
use crate::pipeline::{Sources, no_programs};
use design::Refusals;
use geom::Path;
use program::plan;
use program::plan::{Program, Step};
use proof::artifact::{Artifact, Kind, Output, takes_packages};
use proof::verify;
use proof::verify::{FeedCheckTask, FileProof, Finding, FindingCode, Findings, Method, Proof, program_in};
use spec::{Machine, Source, Spec};
use std::borrow::Cow;

/// Ending of a package behind the name of its program.
pub const PACKAGE_ENDING: &str = ".3mf";

/// A feed check that was read back; only it can be written.
#[derive(Clone, Debug)]
pub struct ProvenFeedCheck {
    /// The program.
    pub text: String,
    /// The program in a package, for a machine that takes packages.
    pub package: Option<Vec<u8>>,
    /// The manifest of its file.
    pub manifest: FeedCheckManifest,
}

/// The reason why there is no feed check.
#[derive(Clone, Debug)]
pub enum FeedCheckFault {
    /// The profile contradicts the seal.
    Refused(Refusals),
    /// Findings in the program; each is a fault of this program.
    Wrong(Vec<Finding>),
}

/// The feed check of `spec` for `machine`, to be written to a file called `name`.
///
/// # Errors
/// If the profile sets limits that the check cannot keep, or if the program has findings.
pub fn feed_check(
    spec: &Spec,
    machine: &Machine,
    sources: Sources<'_>,
    name: &str,
) -> Result<ProvenFeedCheck, FeedCheckFault> {
    let is_pressed: Refusals = no_programs(spec, "a feed check").into_iter().collect();
    is_pressed.or_value(()).map_err(FeedCheckFault::Refused)?;
    let programs: Vec<Program> =
        plan::feed_checks(spec, machine).into_iter().map(|(_, program)| program).collect();
    plan::feed_check_refusals(spec, machine, &programs).or_value(()).map_err(FeedCheckFault::Refused)?;
    let (text, _, findings) = program_of(spec, machine, None);
    if !findings.is_empty() {
        let findings = findings.into_iter().map(|finding| finding.in_file(name)).collect();
        return Err(FeedCheckFault::Wrong(findings));
    }
    let bytes = text.as_bytes().to_vec();
    let program = Artifact { output: Output::new(Kind::TraceGcode), name: name.to_owned(), bytes };
    let package = package_of(spec, machine, &text);
    let packed = package.iter().map(|bytes| {
        let (output, name) = (Output::new(Kind::Trace3mf), format!("{name}{PACKAGE_ENDING}"));
        ManifestFile::new(&Artifact { output, name, bytes: bytes.clone() })
    });
    let manifest = FeedCheckManifest {
        tool: Tool::current(),
        name: spec.name.clone(),
        spec: sources.spec.to_owned(),
        machine: sources.machine.to_owned(),
        files: std::iter::once(ManifestFile::new(&program)).chain(packed).collect(),
    };
    Ok(ProvenFeedCheck { text, package, manifest })
}

/// The program `text` in a package; `None` where `machine` takes none.
fn package_of(spec: &Spec, machine: &Machine, text: &str) -> Option<Vec<u8>> {
    if !takes_packages(machine.controller.dialect) {
        return None;
    }
    emit::package(text, plan::feed_check_seconds(spec, machine, &plan::feed_checks(spec, machine)))
}

/// Proves the feed check `bytes` in the file `name` from its manifest.
pub fn prove_feed_check(name: &str, bytes: &[u8], manifest: &FeedCheckManifest) -> Proof {
    // The manifest holds spec and profile, from which the program is written again. The published one is read and
    // judged on its own. Bytes are compared only if this version wrote it.
    let mut findings = Findings::default();
    let sources = spec::read(&Source::new("spec", manifest.spec.as_str())).and_then(|reading| {
        Ok((reading.spec, spec::read_machine(&Source::new("machine", manifest.machine.as_str()))?))
    });
    let (spec, machine) = match sources {
        Ok(sources) => sources,
        Err(faults) => {
            let fault = faults.list().first().map_or("faults", |fault| &fault.message).to_owned();
            findings.add(FindingCode::Unreadable, fault, "spec and profile that `check` accepts");
            return Proof { findings: findings.into_vec(), ..Proof::default() };
        }
    };
    let hash = sha256(bytes);
    if !manifest.files.iter().any(|entry| entry.sha256 == hash) {
        findings.add(FindingCode::Hash, hash.clone(), "the hash in the manifest");
    }
    let other = (manifest.tool != Tool::current()).then(|| manifest.tool.version.clone());
    let is_package = name.ends_with(PACKAGE_ENDING);
    let text = if is_package {
        Cow::from(program_in(bytes, &mut findings).unwrap_or_default())
    } else {
        String::from_utf8_lossy(bytes)
    };
    let (right, deviation, wrong) = program_of(&spec, &machine, Some(text.as_ref()));
    let deviation = wrong.is_empty().then_some(deviation);
    findings.extend(wrong);
    let packed = if is_package { package_of(&spec, &machine, &right) } else { None };
    let right = packed.unwrap_or_else(|| right.into_bytes());
    let equal = right == bytes;
    if !equal && other.is_none() {
        findings.push(verify::first_difference(bytes, &right));
    }
    let method = if equal { Method::Bytes } else { Method::Reading };
    let file = FileProof {
        path: name.to_owned(),
        output: Output::new(if is_package { Kind::Trace3mf } else { Kind::TraceGcode }),
        by: method,
        sha256: hash,
        deviation,
    };
    let findings = findings.into_vec().into_iter().map(|finding| finding.in_file(name)).collect();
    Proof { findings, files: vec![file], written_by: other, unproven: Vec::new() }
}

/// The program; the largest deviation, mm, of `published`, or else of the program itself; and the findings.
fn program_of(spec: &Spec, machine: &Machine, published: Option<&str>) -> (String, f64, Vec<Finding>) {
    let checks = plan::feed_checks(spec, machine);
    let text = emit::feed_check(spec, machine, &checks);
    let steps = checks.iter().flat_map(|(_, program)| &program.steps);
    let lines = steps.filter_map(|step| match step {
        Step::Seal(pieces) => Some(Path::open(pieces.clone())),
        Step::Height(_)
        | Step::Heat(_)
        | Step::Pause(_)
        | Step::Cool(_)
        | Step::Travel(_)
        | Step::Seam(_)
        | Step::TouchDown(_)
        | Step::Lift(_)
        | Step::Trace(_) => None,
    });
    let task = FeedCheckTask { spec, machine, lines: lines.collect() };
    let mut findings = Findings::default();
    let deviation = task.check(published.unwrap_or(&text), &mut findings);
    (text, deviation, findings.into_vec())
}
