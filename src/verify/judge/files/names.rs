//! The files of a build, compared with the required ones.
//!
//! The design decides which are required, not the manifest: it must name every file of the design, once and rightly, and no
//! others.

use std::collections::{BTreeMap, BTreeSet};

use crate::artifact::Output;
use crate::manifest::{MANIFEST, Manifest, ManifestFile};
use crate::verify::{Finding, FindingCode, OutputFiles};

/// The manifest's entries by the name of their file.
type Entries<'a> = BTreeMap<&'a str, &'a ManifestFile>;

/// The manifest of a directory.
pub(in crate::verify) fn read(files: &OutputFiles<'_>) -> Result<Manifest, Finding> {
    let read = files.get(MANIFEST).map(serde_json::from_slice::<Manifest>);
    let found = match read {
        Some(Ok(manifest)) => return Ok(manifest),
        Some(Err(error)) => error.to_string(),
        None => "no such file".to_owned(),
    };
    Err(Finding::new(FindingCode::Manifest, found, "the manifest of the build").in_file(MANIFEST))
}

/// Names every file that is missing, superfluous or misnamed. The entries of those that are not; none without a manifest.
pub(in crate::verify) fn check<'a>(
    files: &OutputFiles<'_>,
    manifest: Option<&'a Manifest>,
    wanted: &[Output],
    findings: &mut Vec<Finding>,
) -> Entries<'a> {
    let order: Vec<String> = wanted.iter().map(Output::name).collect();
    let wanted: BTreeMap<String, &Output> = wanted.iter().map(|output| (output.name(), output)).collect();
    let entries = manifest.map_or_else(Entries::new, |manifest| named(manifest, &wanted, findings));
    let mut blame = |file: &str, code: FindingCode, found: &str, allowed: String| {
        findings.push(Finding::new(code, found, allowed).in_file(file));
    };
    for (name, output) in &wanted {
        if manifest.is_some() && !entries.contains_key(name.as_str()) {
            blame(name, FindingCode::Manifest, "not named in the manifest", format!("a {}", output.kind));
        }
        if files.get(name).is_none() {
            blame(name, FindingCode::MissingFile, "no such file", format!("a {}", output.kind));
        }
    }
    for (name, _) in files.files.iter().filter(|(name, _)| *name != MANIFEST) {
        if !wanted.contains_key(name.as_ref()) {
            let found = "a file that the design does not have";
            blame(name, FindingCode::UnnamedFile, found, "only files of the design".to_owned());
        }
    }
    let listed = manifest.map_or(&[][..], |manifest| &manifest.files).iter().map(|entry| &entry.path);
    if manifest.is_some() && findings.is_empty() && !listed.eq(&order) {
        let found = "files in another order";
        findings.push(Finding::new(FindingCode::Order, found, "the order of a build").in_file(MANIFEST));
    }
    entries
}

/// The manifest's entries, of equal ones the first.
fn named<'a>(
    manifest: &'a Manifest,
    wanted: &BTreeMap<String, &Output>,
    findings: &mut Vec<Finding>,
) -> Entries<'a> {
    let mut entries = Entries::new();
    let mut twice: BTreeSet<&str> = BTreeSet::new();
    for entry in &manifest.files {
        let mut blame = |found: &str, allowed: String| {
            findings.push(Finding::new(FindingCode::Manifest, found, allowed).in_file(&entry.path));
        };
        match wanted.get(&entry.path) {
            None => blame("named in the manifest", "only files of the design".to_owned()),
            Some(output) if entry.output() != **output => {
                blame("named as another part or kind", format!("a {}", output.kind));
            }
            _ => {}
        }
        if entries.contains_key(entry.path.as_str()) {
            // Said once, however often it is repeated.
            if twice.insert(&entry.path) {
                blame("named more than once", "named once".to_owned());
            }
        } else {
            let _ = entries.insert(entry.path.as_str(), entry);
        }
    }
    entries
}
