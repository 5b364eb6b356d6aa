//! docs/codes.md lists every code of the program with its meaning, and none else.

use std::fmt::Write;

use stargrip_cam::design::RefusalCode;
use stargrip_cam::pipeline::PrecautionCode;
use stargrip_cam::spec::{Code, FaultCode};
use stargrip_cam::verify::FindingCode;

/// The lines of one room's table.
fn table<C: Code>(codes: &[C]) -> String {
    codes.iter().fold("| code | what it means, what to do |\n|---|---|\n".to_owned(), |mut text, code| {
        // A String takes everything.
        let _ = writeln!(text, "| `{}` | {} |", code.as_str(), code.meaning());
        text
    })
}

/// The tables of the page, in order, each as its lines.
fn tables(page: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut inside = false;
    for line in page.lines() {
        if line.starts_with('|') {
            if !inside {
                found.push(String::new());
            }
            if let Some(table) = found.last_mut() {
                *table += line;
                *table += "\n";
            }
        }
        inside = line.starts_with('|');
    }
    found
}

#[test]
fn the_page_lists_every_code_with_its_meaning() {
    let right =
        [table(FaultCode::ALL), table(RefusalCode::ALL), table(PrecautionCode::ALL), table(FindingCode::ALL)];
    let page = include_str!("../docs/codes.md").replace("\r\n", "\n");
    let found = tables(&page);
    assert_eq!(found.len(), right.len());
    for (found, right) in found.iter().zip(&right) {
        assert!(found == right, "docs/codes.md must say:\n{right}");
    }
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
    check(FindingCode::ALL);
}
