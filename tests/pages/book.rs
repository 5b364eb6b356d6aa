//! The book's list names every page once, its first parts are short, links and paths lead somewhere, pictures exist and are small.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::home;
use crate::page::{Page, Piece, ends_in};

/// Largest size of a picture, bytes.
const LARGEST: u64 = 100_000;

/// Most words before the part "Reference": what somebody reads who makes grippers.
const MOST_WORDS: usize = 18_000;

/// The folders at the top of the repository that paths in back quotes begin with.
const FOLDERS: [&str; 12] = [
    "crates",
    "designs",
    "docs",
    "examples",
    "fuzz",
    "packaging",
    "python",
    "snapshots",
    "src",
    "templates",
    "tests",
    "web",
];

#[test]
fn the_book_has_every_page_once() {
    let listed = Page::named("docs/SUMMARY.md").links();
    let distinct: BTreeSet<String> = listed.iter().map(|name| format!("docs/{name}")).collect();
    assert_eq!(distinct.len(), listed.len(), "a page is listed twice: {listed:?}");
    let pages: BTreeSet<String> =
        Page::read_all().into_iter().map(|page| page.name).filter(|name| name.starts_with("docs/")).collect();
    assert_eq!(distinct, pages);
}

#[test]
fn the_parts_for_makers_are_short() {
    let list = Page::named("docs/SUMMARY.md").text;
    let (parts, _) = list.split_once("# Reference").expect("a part for reference");
    let pages = Page { name: "docs/SUMMARY.md".to_owned(), text: parts.to_owned() }.links();
    let words: usize =
        pages.iter().map(|name| Page::named(&format!("docs/{name}")).text.split_whitespace().count()).sum();
    assert!(pages.len() > 10 && words < MOST_WORDS, "{words} words in {} pages", pages.len());
}

/// `a/{b,c}` as `a/b` and `a/c`.
fn expanded(path: &str) -> Vec<String> {
    let Some((head, (list, tail))) =
        path.split_once('{').and_then(|(head, rest)| Some((head, rest.split_once('}')?)))
    else {
        return vec![path.to_owned()];
    };
    list.split(',').map(|word| format!("{head}{word}{tail}")).collect()
}

/// Whether `path` exists, whose last part may be a pattern such as `*.rs`.
fn exists(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let Some((head, tail)) = name.split_once('*') else { return path.exists() };
    let files = path.parent().and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
    files
        .map(|file| file.file_name().to_string_lossy().into_owned())
        .any(|name| name.starts_with(head) && name.ends_with(tail))
}

/// The paths in back quotes in the prose of `text`, of files of the repository.
fn paths(text: &str) -> Vec<String> {
    let mut is_code = false;
    let prose = text.lines().filter(|line| {
        is_code ^= line.starts_with("```");
        !is_code
    });
    let spans = prose.flat_map(|line| line.split('`').skip(1).step_by(2));
    let is_path = |span: &&str| {
        span.split_once('/').is_some_and(|(folder, _)| FOLDERS.contains(&folder))
            && !span.contains([' ', '<'])
    };
    spans.filter(is_path).flat_map(expanded).collect()
}

#[test]
fn every_path_in_back_quotes_exists() {
    let mut pages: Vec<(Page, &Path)> =
        Page::read_all().into_iter().map(|page| (page, Path::new(""))).collect();
    pages.extend(["ARCHITECTURE.md", "CONTRIBUTING.md"].map(|name| (Page::named(name), Path::new(""))));
    let crates = fs::read_dir(home().join("crates")).expect("a directory").flatten();
    let folders: Vec<_> = crates.map(|folder| Path::new("crates").join(folder.file_name())).collect();
    let readmes = folders.iter().filter(|folder| home().join(folder).join("README.md").exists());
    pages.extend(
        readmes.map(|folder| (Page::named(&folder.join("README.md").to_string_lossy()), folder.as_path())),
    );
    let (mut count, mut stale) = (0, Vec::new());
    for (page, folder) in &pages {
        for path in paths(&page.text) {
            count += 1;
            if !exists(&home().join(folder).join(&path)) && !exists(&home().join(&path)) {
                stale.push(format!("{}: {path}", page.name));
            }
        }
    }
    assert!(count > 100 && stale.is_empty(), "of {count} paths there are none of {stale:#?}");
}

/// A bare name could be of any crate, and nobody would see that there is no such file.
#[test]
fn contributing_names_files_by_their_whole_paths() {
    let page = Page::named("CONTRIBUTING.md").text;
    let is_bare = |span: &&str| ends_in(span, "rs") && !span.contains(['/', ' ']);
    let bare: Vec<&str> = page.split('`').skip(1).step_by(2).filter(is_bare).collect();
    assert!(bare.is_empty(), "without a path: {bare:?}");
}

#[test]
fn a_stale_path_is_seen() {
    assert_eq!(
        paths("`src/a.rs` and `x/y`, `tests/{b,c}/d`\n```sh\nls `src/e`\n```\n"),
        ["src/a.rs", "tests/b/d", "tests/c/d"]
    );
    assert!(exists(&home().join("crates/geom/src/*.rs")) && !exists(&home().join("crates/geom/src/*.py")));
}

#[test]
fn every_link_leads_somewhere() {
    let mut pages = Page::read_all();
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
    let mut pictures_shown = BTreeSet::new();
    for page in Page::read_all() {
        for piece in page.pieces() {
            if let Piece::Picture { file, words, .. } = piece {
                assert!(words.len() > 15, "{}: {file} has no words", page.name);
                let _ = pictures_shown.insert(file.trim_start_matches("docs/").to_owned());
            }
        }
    }
    let files = fs::read_dir(home().join("docs")).expect("a directory").map(|file| file.expect("a file"));
    let mut files_there = BTreeSet::new();
    for file in files {
        let name = file.file_name().into_string().expect("ASCII");
        if ["svg", "png", "webp"].iter().any(|ending| ends_in(&name, ending)) {
            assert!(file.metadata().expect("a file").len() < LARGEST, "{name} is too large");
            let _ = files_there.insert(name);
        }
    }
    assert_eq!(pictures_shown, files_there, "pictures that are shown, and that there are");
}
