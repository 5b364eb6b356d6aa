//! A line that must not be in a program: whether it is found where it stands.

use stargrip_cam::pipeline::Built;

use crate::{findings_with, recounted};

/// What is found instead, if no finding of `code` is at one of the lines of `danger`, inserted before the line `insertion` of the program
/// `file` of `build`, whose lines are `lines`, or at most `reach` lines after them.
pub(super) fn missed(
    build: &Built,
    file: &str,
    lines: &[&str],
    insertion: usize,
    danger: &str,
    code: &str,
    reach: usize,
) -> Option<String> {
    let mut changed = lines.to_vec();
    changed.splice(insertion..insertion, danger.lines()).for_each(drop);
    let findings = findings_with(build, file, &recounted(&changed));
    let last = insertion + danger.lines().count();
    let is_near = |line: usize| (insertion + 1..=last + reach).contains(&line);
    if findings.iter().any(|finding| finding.code == code && finding.line.is_some_and(is_near)) {
        return None;
    }
    let codes: Vec<_> = findings.iter().take(5).map(|finding| (finding.code, finding.line)).collect();
    Some(format!("{danger:?}: no {code} at {last}: {codes:?}"))
}
