//! The book's list names every page once, links lead to a page, pictures exist and are small.

use std::collections::BTreeSet;
use std::fs;

use crate::home;
use crate::page::{Page, Piece, ends_in};

/// Largest size of a picture, bytes.
const LARGEST: u64 = 100_000;

#[test]
fn the_book_has_every_page_once() {
    let listed = Page::named("docs/SUMMARY.md").links();
    let distinct: BTreeSet<String> = listed.iter().map(|name| format!("docs/{name}")).collect();
    assert_eq!(distinct.len(), listed.len(), "a page is listed twice: {listed:?}");
    let there: BTreeSet<String> =
        Page::all().into_iter().map(|page| page.name).filter(|name| name.starts_with("docs/")).collect();
    assert_eq!(distinct, there);
}

#[test]
fn every_link_leads_somewhere() {
    let mut pages = Page::all();
    pages.extend(["docs/SUMMARY.md", "ARCHITECTURE.md", "CONTRIBUTING.md"].map(Page::named));
    let mut astray = Vec::new();
    for page in &pages {
        for link in page.links() {
            if link.starts_with("https://") {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let folder = page.name.rsplit_once('/').map_or("", |(folder, _)| folder);
            let target = match file {
                "" => page.name.clone(),
                file if folder.is_empty() => file.to_owned(),
                file => format!("{folder}/{file}"),
            };
            let is_there = home().join(&target).exists()
                && (anchor.is_empty() || Page::named(&target).anchors().iter().any(|other| other == anchor));
            // The book ends at docs/.
            let is_inside = folder.is_empty() || !file.contains("..");
            if !is_there || !is_inside {
                astray.push(format!("{}: {link}", page.name));
            }
        }
    }
    assert!(astray.is_empty(), "{astray:#?}");
}

#[test]
fn every_picture_is_shown_small_and_said_in_words() {
    let mut shown = BTreeSet::new();
    for page in Page::all() {
        for piece in page.pieces() {
            if let Piece::Picture { file, words, .. } = piece {
                assert!(words.len() > 15, "{}: {file} has no words", page.name);
                let _ = shown.insert(file.trim_start_matches("docs/").to_owned());
            }
        }
    }
    let files = fs::read_dir(home().join("docs")).expect("a directory").map(|file| file.expect("a file"));
    let mut there = BTreeSet::new();
    for file in files {
        let name = file.file_name().into_string().expect("ASCII");
        if ends_in(&name, "svg") || ends_in(&name, "png") {
            assert!(file.metadata().expect("a file").len() < LARGEST, "{name} is too large");
            let _ = there.insert(name);
        }
    }
    assert_eq!(shown, there, "pictures that are shown, and that there are");
}
