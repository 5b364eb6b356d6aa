//! Edits of published files: a byte, a token, a line or a block, with a manifest that covers it up.
//!
//! Every edit is judged by reading alone and by making the directory anew. An edit that is not found must be harmless, by a rule
//! that is written here and not in the verifier. `EDITS=4000 cargo test --test design edits:: -- --nocapture` prints the table of
//! docs/reliability.md; `EDITS_SEED=7` makes other edits.

mod directories;
mod edit;
mod harmless;
mod same_way;

use std::collections::BTreeMap;
use std::{env, thread};

use crate::support::dice::Dice;
use directories::{Directory, directories, kind_of, output_files};
use edit::{Unit, cover_up, edit};
use harmless::harmless;
use same_way::same_facts;
use stargrip_cam::pipeline::{prove_files, read_back};

/// The results of the edits of one kind.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    edits: usize,
    harmless: usize,
    by_reading: usize,
    by_bytes: usize,
}

fn number(name: &str, default: u64) -> u64 {
    env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

/// Makes `count` edits, all kinds of files and units in turn; the table, and the edits that were missed.
fn judged(count: u64, seed: u64) -> (BTreeMap<(String, Unit), Row>, Vec<String>) {
    let directories = directories();
    let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let (mut table, mut missed) = (BTreeMap::new(), Vec::new());
    let mut kinds: Vec<String> =
        directories.iter().flatten().map(|(name, _)| kind_of(name).to_owned()).collect();
    kinds.sort();
    kinds.dedup();
    for i in 0..usize::try_from(count).expect("a few thousand") {
        let unit = [Unit::Byte, Unit::Token, Unit::Line, Unit::Block][i % 4];
        let kind = &kinds[i / 4 % kinds.len()];
        let of_kind: Vec<(&Directory, &String, &Vec<u8>)> = directories
            .iter()
            .flat_map(|files| files.iter().map(move |(name, bytes)| (files, name, bytes)))
            .filter(|(_, name, _)| kind_of(name) == kind)
            .collect();
        let (files, name, bytes) = of_kind[dice.below(of_kind.len())];
        let (edited_bytes, change) = edit(bytes, unit, &mut dice);
        let mut edited = files.clone();
        edited.iter_mut().find(|(known, _)| known == name).expect("it").1 = edited_bytes;
        cover_up(&mut edited, name);
        let covered_up = &edited.iter().find(|(known, _)| known == name).expect("it").1;
        let row: &mut Row = table.entry((kind.clone(), unit)).or_default();
        row.edits += 1;
        let read = !read_back(&output_files(&edited)).findings.is_empty();
        let is_refused = !prove_files(&output_files(&edited)).findings.is_empty();
        row.by_reading += usize::from(read);
        row.by_bytes += usize::from(is_refused);
        if harmless(name, bytes, covered_up).is_some() {
            row.harmless += usize::from(!read);
            continue;
        }
        // The content of pictures and pages is not read, nor are comments without effect.
        let unread =
            ["preview", "pdf"].contains(&kind.as_str()) || kind == "gcode" && same_facts(bytes, covered_up);
        for (by, found) in [("reading", read || unread), ("bytes", is_refused)] {
            if !found {
                missed.push(format!("by {by}: {name} {unit:?} {change}"));
            }
        }
    }
    (table, missed)
}

#[test]
fn every_edit_is_found_or_harmless() {
    let (count, seed) = (number("EDITS", 96), number("EDITS_SEED", 1));
    let halves: Vec<_> = thread::scope(|scope| {
        let half = |seed: u64| scope.spawn(move || judged(count.div_ceil(2), seed));
        [half(seed), half(seed + 1_000_000)].into_iter().map(|half| half.join().expect("judged")).collect()
    });
    let mut table: BTreeMap<(String, Unit), Row> = BTreeMap::new();
    let mut missed = Vec::new();
    for (half, more) in halves {
        for (key, row) in half {
            let sum = table.entry(key).or_default();
            sum.edits += row.edits;
            sum.harmless += row.harmless;
            sum.by_reading += row.by_reading;
            sum.by_bytes += row.by_bytes;
        }
        missed.extend(more);
    }
    println!(
        "| file | edit | edits | found by reading | harmless, and not found | found with the bytes compared |"
    );
    println!("|---|---|---|---|---|---|");
    for ((kind, unit), row) in &table {
        let Row { edits, harmless, by_reading, by_bytes } = row;
        println!("| {kind} | {unit:?} | {edits} | {by_reading} | {harmless} | {by_bytes} |");
    }
    assert!(missed.is_empty(), "{} missed:\n{}", missed.len(), missed.join("\n"));
}
