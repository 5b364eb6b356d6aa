//! The files of a build, compared with the required ones.
//!
//! The design decides which are required, not the manifest: it must name every file of the design, once and rightly, and no
//! others.

use std::collections::{BTreeMap, BTreeSet};

use crate::artifact::Output;
use crate::manifest::{MANIFEST, Manifest, ManifestFile};
use crate::verify::judge::files::figures::wrong;
use crate::verify::{Finding, FindingCode, OutputFiles};

/// The manifest's entries by the name of their file.
type Entries<'a> = BTreeMap<&'a str, &'a ManifestFile>;

/// The manifest of a directory.
pub(super) fn read(files: &OutputFiles<'_>) -> Result<Manifest, Finding> {
    let right = "the manifest of the build";
    let Some(bytes) = files.get(MANIFEST) else {
        return Err(wrong(files.lacks(MANIFEST, right).found, right));
    };
    serde_json::from_slice(bytes).map_err(|error| wrong(error.to_string(), right))
}

/// Names every file that is missing, superfluous or misnamed. The entries of those that are not; none without a manifest.
///
/// The design decides which files there must be. The order of the manifest is compared only if nothing else is wrong.
pub(super) fn check<'a>(
    files: &OutputFiles<'_>,
    manifest: Option<&'a Manifest>,
    expected: &[Output],
    findings: &mut Vec<Finding>,
) -> Entries<'a> {
    let order: Vec<String> = expected.iter().map(Output::name).collect();
    let expected_names: BTreeMap<String, &Output> =
        expected.iter().map(|output| (output.name(), output)).collect();
    let entries = manifest.map_or_else(Entries::new, |manifest| named(manifest, &expected_names, findings));
    for (name, output) in &expected_names {
        if manifest.is_some() && !entries.contains_key(name.as_str()) {
            let (fault, allowed) = ("not named in the manifest", format!("the {}", output.kind));
            findings.push(Finding::new(FindingCode::Manifest, fault, allowed).in_file(name));
        }
        if files.get(name).is_none() {
            findings.push(files.lacks(name, &format!("the {}", output.kind)));
        }
    }
    for name in files.names().filter(|name| *name != MANIFEST && !expected_names.contains_key(*name)) {
        let fault = "a file that the design does not have";
        let finding = Finding::new(FindingCode::UnnamedFile, fault, "only files of the design");
        findings.push(finding.in_file(name));
    }
    let listed = manifest.map_or(&[][..], |manifest| &manifest.files).iter().map(|entry| &entry.path);
    if manifest.is_some() && findings.is_empty() && !listed.eq(&order) {
        let fault = "files in another order";
        findings.push(Finding::new(FindingCode::Order, fault, "the order of a build").in_file(MANIFEST));
    }
    entries
}

/// The manifest's entries, of equal ones the first.
fn named<'a>(
    manifest: &'a Manifest,
    expected_names: &BTreeMap<String, &Output>,
    findings: &mut Vec<Finding>,
) -> Entries<'a> {
    let mut entries = Entries::new();
    let mut twice: BTreeSet<&str> = BTreeSet::new();
    for entry in &manifest.files {
        match expected_names.get(&entry.path) {
            None => findings.push(entry_fault(entry, "named in the manifest", "only files of the design")),
            Some(output) if entry.output() != **output => {
                let allowed = format!("the {}", output.kind);
                findings.push(entry_fault(entry, "named as another part or kind", &allowed));
            }
            _ => {}
        }
        if entries.contains_key(entry.path.as_str()) {
            // Said once, however often it is repeated.
            if twice.insert(&entry.path) {
                findings.push(entry_fault(entry, "named more than once", "named once"));
            }
        } else {
            let _ = entries.insert(entry.path.as_str(), entry);
        }
    }
    entries
}

fn entry_fault(entry: &ManifestFile, fault: &str, allowed: &str) -> Finding {
    Finding::new(FindingCode::Manifest, fault, allowed).in_file(&entry.path)
}
