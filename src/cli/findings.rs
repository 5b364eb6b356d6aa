//! Printed findings: the first few of a kind, the others only counted; and files that fail their proof.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::Path;

use crate::cli::escape::escaped_line;
use crate::cli::words::count_beyond;
use proof::verify::Finding;
use spec::units::count_text;

/// Number of findings of one kind in one file that are printed: enough to see whether the fault is local.
const SHOWN: usize = 3;

/// One line a finding. Of findings with the same file and code only the first few are listed, and the others counted.
pub(super) fn lines(findings: &[Finding]) -> Vec<String> {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    let mut lines = Vec::new();
    for finding in findings {
        let count = counts.entry((&finding.file, finding.code)).or_default();
        *count += 1;
        if *count <= SHOWN {
            lines.push(escaped_line(finding.to_string()));
        }
        if *count == SHOWN {
            let total = findings
                .iter()
                .filter(|other| (&other.file, other.code) == (&finding.file, finding.code))
                .count();
            let remainder =
                |more| format!("{}: {}: and {more} more", escaped_line(&finding.file), finding.code);
            lines.extend(count_beyond(total, SHOWN).map(remainder));
        }
    }
    lines
}

/// Endings of programs' names; the last is for LinuxCNC.
const PROGRAMS: [&str; 2] = ["gcode", "ngc"];

/// The findings, and the files to send with a report.
#[derive(Clone, Debug)]
pub struct Unproven {
    /// All findings in the files.
    pub findings: Vec<Finding>,
    /// The spec's name.
    pub(super) spec: String,
    /// The name of the machine profile in the spec.
    pub(super) profile: String,
}

impl Unproven {
    /// Whether the user's own profile may be the cause: all findings are in programs.
    fn may_be_the_profile(&self) -> bool {
        let is_program = |ending: &OsStr| PROGRAMS.iter().any(|program| ending == *program);
        let in_program = |finding: &Finding| Path::new(&finding.file).extension().is_some_and(is_program);
        spec::builtin_machine(&self.profile).is_none() && self.findings.iter().all(in_program)
    }

    /// The probable cause, as a heading.
    pub(super) fn heading(&self) -> String {
        let finding_count = count_text(self.findings.len(), "finding");
        if self.may_be_the_profile() {
            format!(
                "error: the programs for {} fail their proof: {finding_count}",
                escaped_line(&self.profile)
            )
        } else {
            format!("fault of this program: {finding_count} in the files that it made")
        }
    }

    /// The findings, and the remedy.
    pub(super) fn text(&self) -> String {
        let finding_lines = lines(&self.findings).join("\n");
        let (spec, profile, version) =
            (escaped_line(&self.spec), escaped_line(&self.profile), env!("CARGO_PKG_VERSION"));
        let send =
            format!("Send {spec}, the machine profile {profile}, the version {version} and these lines.");
        let blame = if self.may_be_the_profile() {
            "The profile may not fit its dialect: compare it with the built-in one (`stargrip-cam machines`). If it does \
             fit, this is a fault of this program: please report it."
        } else {
            "This is a fault of this program, not of your spec: please report it."
        };
        format!("{finding_lines}\nNothing was published. {blame} {send}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::verify::FindingCode;

    #[test]
    fn findings_of_one_kind_are_counted_after_the_first_few() {
        let finding =
            |line: usize, code: FindingCode| Finding::in_line(code, line, "x", "y").in_file("a.gcode");
        let mut findings: Vec<Finding> =
            (1..90).map(|line| finding(line, FindingCode::OutsideWorkArea)).collect();
        findings.push(finding(7, FindingCode::WrongFeed));
        let finding_lines = lines(&findings);
        assert_eq!(finding_lines.len(), SHOWN + 2);
        assert_eq!(finding_lines[SHOWN], "a.gcode: outside-work-area: and 86 more");
        assert!(finding_lines[SHOWN + 1].contains(":7: wrong-feed"));
    }
}

#[cfg(test)]
mod unproven_tests {
    use super::*;
    use proof::verify::FindingCode;

    fn unproven(profile: &str, file: &str) -> Unproven {
        let finding = Finding::in_line(FindingCode::WrongFeed, 7, "F5", "F6").in_file(file);
        Unproven { findings: vec![finding], spec: "star.toml".to_owned(), profile: profile.to_owned() }
    }

    #[test]
    fn a_finding_of_the_program_against_itself_is_its_own_fault() {
        let unproven_program = unproven("generic", "star-1-seal.gcode");
        assert_eq!(unproven_program.heading(), "fault of this program: 1 finding in the files that it made");
        let text = unproven_program.text();
        for part in [
            "star-1-seal.gcode:7: wrong-feed",
            "not of your spec: please report it",
            "Send star.toml",
            "generic",
        ] {
            assert!(text.contains(part), "{text}");
        }
        assert!(text.contains(env!("CARGO_PKG_VERSION")), "{text}");
    }

    #[test]
    fn a_profile_of_the_users_own_may_be_the_reason_for_a_wrong_program_and_for_nothing_else() {
        let program = unproven("own.toml", "star-1-seal.gcode");
        assert!(program.heading().contains("the programs for own.toml"), "{}", program.heading());
        assert!(unproven("own.toml", "star-1-seal.ngc").may_be_the_profile());
        assert!(program.text().contains("If it does fit, this is a fault of this program"));
        let drawing = unproven("own.toml", "outline.svg");
        assert!(drawing.heading().starts_with("fault of this program"), "{}", drawing.heading());
    }
}
