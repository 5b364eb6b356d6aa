//! Printed findings: the first few of a kind; the others are only counted.

use std::collections::BTreeMap;

use crate::cli::escape::shown;
use crate::verify::Finding;

/// Number of findings of one kind in one file that are printed: enough to see whether the fault is local.
const SHOWN: usize = 3;

/// One line a finding. Of findings with the same file and code only the first few are listed, and the others counted.
pub(super) fn lines(findings: &[Finding]) -> Vec<String> {
    let mut alike: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for finding in findings {
        *alike.entry((&finding.file, finding.code)).or_default() += 1;
    }
    let mut seen: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    let mut lines = Vec::new();
    for finding in findings {
        let kind = (finding.file.as_str(), finding.code);
        let (count, all) = (seen.entry(kind).or_default(), alike.get(&kind).copied().unwrap_or(0));
        *count += 1;
        if *count <= SHOWN {
            lines.push(shown(finding.to_string()));
        }
        if *count == SHOWN && all > SHOWN {
            lines.push(format!("{}: {}: and {} more", shown(&finding.file), finding.code, all - SHOWN));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::FindingCode;

    #[test]
    fn findings_of_one_kind_are_counted_after_the_first_few() {
        let finding = |line: usize, code: FindingCode| Finding::at(code, line, "x", "y").in_file("a.gcode");
        let mut findings: Vec<Finding> =
            (1..90).map(|line| finding(line, FindingCode::OutsideWorkArea)).collect();
        findings.push(finding(7, FindingCode::WrongFeed));
        let lines = lines(&findings);
        assert_eq!(lines.len(), SHOWN + 2);
        assert_eq!(lines[SHOWN], "a.gcode: outside-work-area: and 86 more");
        assert!(lines[SHOWN + 1].contains(":7: wrong-feed"));
    }
}
