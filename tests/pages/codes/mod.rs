//! docs/codes.md lists all codes of the program with their meanings, and no others.

mod files;
mod specs;

use std::fmt::Write;
use std::sync::LazyLock;

use stargrip_cam::design::RefusalCode;
use stargrip_cam::pipeline::{CommandCode, PrecautionCode};
use stargrip_cam::spec::{Code, FaultCode};
use stargrip_cam::verify::FindingCode;

use specs::Message;

/// Codes without a wrong input, or without a short one, as example; no finding is among them.
const WITHOUT: &[&str] = &[
    "edit",
    "open-quote",
    "own-value",
    "unknown-machine",
    "bands-meet",
    "curve-not-finite",
    "curves-crowded",
    "large-shell",
    "lines-fall-apart",
    "long-link",
    "long-ramp",
    "narrow-mouth",
    "no-package",
    "no-plate",
    "no-prediction",
    "no-press",
    "no-programs",
    "seam-crosses-itself",
    "seam-gap",
    "seam-of-two-processes",
    "seams-cross",
    "stars-overlap",
    "wrong-opening",
    "leaves-plane",
    "failed",
    "infeasible",
    "not-published",
];

/// The findings in files that are wrong on purpose.
static FINDINGS: LazyLock<Vec<Message>> = LazyLock::new(files::messages);

/// The lines of one module's table; `messages` are its examples.
fn table<C: Code>(codes: &[C], messages: &[Message]) -> String {
    let head = "| code | what it means, what to do | example |\n|---|---|---|\n".to_owned();
    codes.iter().fold(head, |mut text, code| {
        let example = messages.iter().find(|(own, _)| own == code.as_str()).map(|(_, message)| cell(message));
        let example = example.unwrap_or_default();
        // Writing to a String does not fail.
        let _ = writeln!(text, "| `{}` | {} | {example} |", code.as_str(), code.meaning());
        text
    })
}

/// A message in one cell of a table.
fn cell(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|").replace('<', "&lt;")
}

/// The tables of the page, in order, each as its lines.
fn tables(page: &str) -> Vec<String> {
    let mut tables: Vec<String> = Vec::new();
    let mut is_inside = false;
    for line in page.lines() {
        if line.starts_with('|') {
            if !is_inside {
                tables.push(String::new());
            }
            if let Some(table) = tables.last_mut() {
                *table += line;
                *table += "\n";
            }
        }
        is_inside = line.starts_with('|');
    }
    tables
}

#[test]
fn the_page_lists_every_code_with_its_meaning_and_a_message() {
    let [faults, refusals, precautions] = specs::messages();
    let right = [
        table(FaultCode::ALL, &faults),
        table(RefusalCode::ALL, &refusals),
        table(PrecautionCode::ALL, &precautions),
        table(CommandCode::ALL, &[]),
        table(FindingCode::ALL, &FINDINGS),
    ];
    let page = include_str!("../../../docs/codes.md").replace("\r\n", "\n");
    let shown_tables = tables(&page);
    assert_eq!(shown_tables.len(), right.len());
    let renewed =
        shown_tables.iter().zip(&right).fold(page.clone(), |page, (old, new)| page.replacen(old, new, 1));
    if crate::renews() {
        std::fs::write(crate::home().join("docs/codes.md"), &renewed).expect("written");
        return;
    }
    assert!(page == renewed, "docs/codes.md is out of date: renew it with INSTA_UPDATE=always");
    let bare: Vec<&str> =
        right.iter().flat_map(|table| table.lines()).filter_map(|line| line.strip_suffix(" |  |")).collect();
    let bare: Vec<&str> = bare.iter().filter_map(|line| line.split('`').nth(1)).collect();
    assert_eq!(bare, WITHOUT, "codes without an example");
}

/// A finding that no judge reports, or that no wrong file shows, is not listed.
#[test]
fn every_finding_has_a_file_that_is_wrong_in_just_that_way() {
    let words_shown: Vec<&str> = FINDINGS.iter().map(|(word, _)| word.as_str()).collect();
    let words = FindingCode::ALL.iter().map(|code| code.as_str());
    let missing: Vec<&str> = words.filter(|word| !words_shown.contains(word)).collect();
    assert!(missing.is_empty(), "add to EDITS or `messages` of tests/pages/codes/files.rs: {missing:?}");
}

#[test]
fn codes_are_kebab_case_in_order_and_each_once() {
    fn check<C: Code>(codes: &[C]) {
        let words: Vec<&str> = codes.iter().map(|code| code.as_str()).collect();
        assert!(words.windows(2).all(|pair| pair[0] < pair[1]), "{words:?}");
        for (word, code) in words.iter().zip(codes) {
            assert!(word.chars().all(|c| c == '-' || c.is_ascii_lowercase()), "{word}");
            assert!(code.meaning().ends_with('.') && code.meaning().len() < 120, "{word}");
        }
    }
    check(FaultCode::ALL);
    check(RefusalCode::ALL);
    check(PrecautionCode::ALL);
    check(CommandCode::ALL);
    check(FindingCode::ALL);
}
