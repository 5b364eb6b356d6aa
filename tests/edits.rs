//! Edits of published files: a byte, a token, a line or a block, with a manifest that covers it up.
//!
//! Every edit is judged by reading alone and by making the directory anew. What is not found must be harmless, by a rule
//! that is written here and not in the verifier. `EDITS=2000 cargo test --test edits -- --nocapture` prints the table of
//! docs/reliability.md; `EDITS_SEED=7` makes other edits.

mod support;

use std::collections::BTreeMap;
use std::ops::Range;
use std::{env, thread};

use stargrip_cam::manifest::{MANIFEST, Manifest, sha256};
use stargrip_cam::pipeline::{Sources, build, prove_files, read_back};
use stargrip_cam::spec;
use stargrip_cam::spec::{Machine, Source};
use stargrip_cam::verify::OutputFiles;
use support::dice::Dice;

/// A directory as it was published: names and contents.
type Directory = Vec<(String, Vec<u8>)>;

/// What is edited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Unit {
    Byte,
    Token,
    Line,
    Block,
}

/// The edited content, and what was done to it.
fn edit(bytes: &[u8], unit: Unit, dice: &mut Dice) -> (Vec<u8>, String) {
    let pieces = pieces(bytes, unit);
    let (a, b) = (dice.below(pieces.len()), dice.below(pieces.len()));
    let (first, second) = (pieces[a.min(b)].clone(), pieces[a.max(b)].clone());
    let one = pieces[a].clone();
    let mut out = bytes.to_vec();
    let shown = |range: &Range<usize>| {
        String::from_utf8_lossy(&bytes[range.clone()]).chars().take(60).collect::<String>()
    };
    let what = match dice.below(5) {
        0 => {
            let _ = out.drain(one.clone()).count();
            format!("without {:?}", shown(&one))
        }
        1 => {
            let _ = out.splice(one.end..one.end, bytes[one.clone()].iter().copied()).count();
            format!("twice {:?}", shown(&one))
        }
        2 if unit != Unit::Byte => {
            let middle = &bytes[first.end.min(second.start)..second.start];
            let new = [&bytes[second.clone()], middle, &bytes[first.clone()]].concat();
            let _ = out.splice(first.start..second.end.max(first.end), new).count();
            format!("{:?} and {:?} swapped", shown(&first), shown(&second))
        }
        3 if unit == Unit::Token => {
            let new = other_token(&bytes[one.clone()], dice);
            let text = String::from_utf8_lossy(&new).into_owned();
            let _ = out.splice(one.clone(), new).count();
            format!("{:?} for {:?}", text, shown(&one))
        }
        _ => {
            let (from, to) = (pieces[b].clone(), one.clone());
            let new: Vec<u8> = if unit == Unit::Byte {
                let bit = 1 << dice.below(8);
                bytes[to.clone()].iter().map(|byte| byte ^ bit).collect()
            } else {
                bytes[from].to_vec()
            };
            let text = String::from_utf8_lossy(&new).chars().take(60).collect::<String>();
            let _ = out.splice(to.clone(), new).count();
            format!("{:?} for {:?}", text, shown(&to))
        }
    };
    (out, format!("at byte {}: {what}", one.start))
}

/// A number near to a token that is one; else the token in the other case.
fn other_token(token: &[u8], dice: &mut Dice) -> Vec<u8> {
    let digits: Vec<usize> = (0..token.len()).filter(|i| token[*i].is_ascii_digit()).collect();
    let mut out = token.to_vec();
    if digits.is_empty() {
        return token.iter().map(|byte| byte ^ (0x20 * u8::from(byte.is_ascii_alphabetic()))).collect();
    }
    let at = digits[dice.below(digits.len())];
    out[at] = b'0' + (out[at] - b'0' + 1 + u8::try_from(dice.below(9)).expect("below 9")) % 10;
    out
}

/// The content in pieces of a unit, without gaps for lines and blocks.
fn pieces(bytes: &[u8], unit: Unit) -> Vec<Range<usize>> {
    let lines = || {
        let mut start = 0;
        bytes.split_inclusive(|byte| *byte == b'\n').map(move |line| {
            start += line.len();
            start - line.len()..start
        })
    };
    let mut found: Vec<Range<usize>> = match unit {
        Unit::Byte => (0..bytes.len()).map(|i| i..i + 1).collect(),
        Unit::Line => lines().collect(),
        Unit::Block => {
            let lines: Vec<Range<usize>> = lines().collect();
            lines.chunks(6).map(|chunk| chunk[0].start..chunk[chunk.len() - 1].end).collect()
        }
        Unit::Token => {
            let blank = |i: usize| bytes[i].is_ascii_whitespace();
            let starts = (0..bytes.len()).filter(|i| !blank(*i) && (*i == 0 || blank(i - 1)));
            starts.map(|from| from..(from..bytes.len()).find(|i| blank(*i)).unwrap_or(bytes.len())).collect()
        }
    };
    if found.is_empty() {
        found.push(0..bytes.len());
    }
    found
}

/// Makes what else would tell of the edit agree with it: the count in a program's last line, size and hash in the manifest.
fn cover_up(files: &mut Directory, name: &str) {
    let at = files.iter().position(|(known, _)| known == name).expect("a file");
    if kind_of(name) == "gcode"
        && let Ok(text) = String::from_utf8(files[at].1.clone())
        && let Some((body, last)) = text.trim_end_matches('\n').rsplit_once('\n')
        && let Some(mark) = last.find("end of program, ")
    {
        let close = if last.ends_with(')') { ")" } else { "" };
        let lines = body.lines().count() + 1;
        files[at].1 = format!("{body}\n{}end of program, {lines} lines{close}\n", &last[..mark]).into_bytes();
    }
    if name == MANIFEST {
        return;
    }
    let (bytes, hash) = (files[at].1.len(), sha256(&files[at].1));
    let manifest = files.iter_mut().find(|(known, _)| known == MANIFEST).expect("one");
    let mut read: Manifest = serde_json::from_slice(&manifest.1).expect("a manifest");
    let entry = read.files.iter_mut().find(|entry| entry.path == name).expect("an entry");
    (entry.bytes, entry.sha256) = (bytes, hash);
    manifest.1 = read.to_json();
}

fn output_files(files: &Directory) -> OutputFiles<'_> {
    OutputFiles {
        files: files.iter().map(|(name, bytes)| (name.as_str().into(), bytes.as_slice().into())).collect(),
    }
}

/// Why an edit changes nothing that anybody makes or is told; `None` if it does.
fn harmless(name: &str, before: &[u8], after: &[u8]) -> Option<&'static str> {
    if before == after {
        return Some("the same bytes");
    }
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).ok();
    let (Some(a), Some(b)) = (text(before), text(after)) else {
        return match kind_of(name) {
            "stl" => same_solid(before, after).then_some("a normal off by less than 0.3 %"),
            "pdf" => same_page(before, after).then_some("a number off by less than 0.01 mm"),
            _ => None,
        };
    };
    match kind_of(name) {
        "spec.toml" | "machine.toml" => same_meaning(name, &a, &b).then_some("the same meaning"),
        "json" | MANIFEST => same_values(&a, &b).then_some("the same values"),
        "gcode" => same_way(&a, &b).then_some("the same way at the same speed, and nothing else said"),
        "dxf" if a.lines().map(str::trim).eq(b.lines().map(str::trim)) => Some("white space"),
        "svg" if same_but_blanks(&a, &b) => Some("white space"),
        kind @ ("svg" | "dxf") => {
            same_numbers(kind, &a, &b, 1e-3).then_some("a number off by less than asked for")
        }
        _ => None,
    }
}

/// The same figures and names, whatever the version of the tool: of another one only reading is a proof, and `verify` says so.
fn same_values(a: &str, b: &str) -> bool {
    let value = |text: &str| {
        let mut value: serde_json::Value = serde_json::from_str(text).ok()?;
        if let Some(version) = value.pointer_mut("/tool/version").filter(|version| version.is_string()) {
            *version = "any".into();
        }
        Some(value)
    };
    value(a).is_some() && value(a) == value(b)
}

/// The same but for blanks, and for blanks and zeros between the numbers of a path as SVG's grammar reads them.
fn same_but_blanks(a: &str, b: &str) -> bool {
    let parts = |text: &str| -> Vec<String> {
        let quoted = text.split('"').zip([false, true].into_iter().cycle());
        let part = |(part, quoted): (&str, bool)| {
            if quoted && part.starts_with('M') {
                format!("{:?}", path_words(part))
            } else {
                part.split_ascii_whitespace().collect()
            }
        };
        quoted.map(part).collect()
    };
    parts(a) == parts(b)
}

/// The letters and numbers of path data; flags of arcs are one digit and need no blank after them.
fn path_words(data: &str) -> Vec<(char, Option<f64>)> {
    let (mut out, mut rest) = (Vec::new(), data);
    let (mut letter, mut count) = (' ', 0);
    loop {
        rest = rest.trim_start_matches([' ', ',', '\n']);
        let Some(first) = rest.chars().next() else { return out };
        if first.is_ascii_alphabetic() {
            (letter, count, rest) = (first, 0, &rest[1..]);
            out.push((letter, None));
            continue;
        }
        let flag = letter == 'A' && matches!(count % 7, 3 | 4);
        let digits =
            rest.char_indices().find(|(i, c)| !(c.is_ascii_digit() || *c == '.' || *i == 0 && *c == '-'));
        let end = if flag { 1 } else { digits.map_or(rest.len(), |(i, _)| i) };
        let Some(Ok(number)) = rest.get(..end).map(str::parse::<f64>) else { return vec![('?', None)] };
        out.push((letter, Some(number)));
        (count, rest) = (count + 1, &rest[end..]);
    }
}

/// The same spec or profile, but for texts that nobody goes by: what a profile is called in the spec whose profile lies
/// beside it, and what it says of itself.
fn same_meaning(name: &str, a: &str, b: &str) -> bool {
    let read = |text: &str| {
        let source = Source::new(name, text);
        if name == "machine.toml" {
            let machine = spec::read_machine(&source).ok()?;
            Some(format!("{:?}", Machine { description: String::new(), ..machine }))
        } else {
            let mut spec = spec::read(&source).ok()?.spec;
            spec.machine.profile = String::new();
            Some(format!("{spec:?}"))
        }
    };
    let (a, b) = (read(a), read(b));
    a.is_some() && a == b
}

/// The same words but for numbers that are off by no more than `most`, mm.
fn same_numbers(kind: &str, a: &str, b: &str, most: f64) -> bool {
    let split = |text: &str| -> Vec<String> {
        text.split(|c: char| c.is_ascii_whitespace() || "\"'<>=,".contains(c))
            .filter(|word| !word.is_empty())
            .map(|word| word.trim_start_matches(|c: char| kind == "svg" && "MLA".contains(c)).to_owned())
            .filter(|word| !word.is_empty())
            .collect()
    };
    let (a, b) = (split(a), split(b));
    let near = |a: &str, b: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= most,
        _ => false,
    };
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| a == b || near(a, b))
}

/// The same, of bytes beyond text.
fn same_page(before: &[u8], after: &[u8]) -> bool {
    let text = |bytes: &[u8]| bytes.iter().map(|byte| char::from(*byte)).collect::<String>();
    same_numbers("pdf", &text(before), &text(after), 0.01)
}

fn same_solid(before: &[u8], after: &[u8]) -> bool {
    before.len() == after.len()
        && before[..84] == after[..84]
        && before[84..].chunks_exact(50).zip(after[84..].chunks_exact(50)).all(|(a, b)| {
            let number =
                |raw: &[u8], k: usize| f32::from_le_bytes(raw[4 * k..4 * k + 4].try_into().expect("four"));
            a[12..] == b[12..] && (0..3).all(|k| (number(a, k) - number(b, k)).abs() <= 0.003)
        })
}

/// A place on a program's way: X, Y, Z, feed.
type Place = [f64; 4];

/// The same lines that are no cuts, and between them the same way at the same feed: places at equal distances along it lie no
/// farther apart than 0.002 mm, whatever the moves it is made of.
fn same_way(a: &str, b: &str) -> bool {
    let is_progress = |line: &&str| line.contains("progress: percent=") || line.starts_with("M73 ");
    let mut said = a.lines().filter(is_progress);
    // The display stands still for longer where a progress is left out.
    let fewer = b.lines().filter(is_progress).all(|line| said.any(|known| known == line));
    let without = |text: &str| text.lines().filter(|line| !is_progress(line)).collect::<Vec<_>>().join("\n");
    let (a, b) = (ways(&without(a)), ways(&without(b)));
    if !fewer {
        return false;
    }
    let near = |a: &Place, b: &Place| (0..4).all(|k| (a[k] - b[k]).abs() <= 0.002);
    a.len() == b.len()
        && a.iter().zip(&b).all(|((said, one), (also, other))| {
            let (one, other) = (at_equal_distances(one), at_equal_distances(other));
            said == also && one.len() == other.len() && one.iter().zip(&other).all(|(a, b)| near(a, b))
        })
}

/// The way up to each line that is no cut, and the line.
fn ways(text: &str) -> Vec<(String, Vec<Place>)> {
    let mut at: Place = [0.0; 4];
    let (mut way, mut out) = (Vec::new(), Vec::new());
    // The last line counts the others.
    for line in text.lines().map(str::trim_end).filter(|line| !line.contains("end of program, ")) {
        let word = |letter: char| -> Option<f64> {
            let (_, rest) = line.split_once(letter)?;
            let end = rest.find(|c: char| !"+-.0123456789".contains(c)).unwrap_or(rest.len());
            rest[..end].parse().ok()
        };
        let from = at;
        if line.starts_with('G') && !line.starts_with("G4") {
            for (k, letter) in ['X', 'Y', 'Z', 'F'].into_iter().enumerate() {
                at[k] = word(letter).unwrap_or(at[k]);
            }
        }
        let arc = line.starts_with("G2") && !line.starts_with("G21") || line.starts_with("G3");
        if arc {
            let (i, j) = (word('I').unwrap_or(0.0), word('J').unwrap_or(0.0));
            let (x, y) = (from[0] + i, from[1] + j);
            let start = (-j).atan2(-i);
            let turn = (at[1] - y).atan2(at[0] - x) - start;
            let full = std::f64::consts::TAU;
            let turn =
                if line.starts_with("G3") { turn.rem_euclid(full) } else { turn.rem_euclid(full) - full };
            let radius = i.hypot(j);
            way.extend((1..100).map(|n| {
                let part = f64::from(n) / 100.0;
                let angle = start + part * turn;
                let z = from[2] + part * (at[2] - from[2]);
                [x + radius * angle.cos(), y + radius * angle.sin(), z, at[3]]
            }));
        }
        if arc || line.starts_with("G1") && !line.starts_with("G17") {
            way.push(at);
        } else {
            let said = if line.starts_with("G0") { String::from("G0") } else { line.to_owned() };
            out.push((said, std::mem::take(&mut way)));
            way.push(at);
        }
    }
    out
}

fn at_equal_distances(way: &[Place]) -> Vec<Place> {
    let length = |a: &Place, b: &Place| (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
    let whole: f64 = way.windows(2).map(|ends| length(&ends[0], &ends[1])).sum();
    let mut out: Vec<Place> = way.first().into_iter().chain(way.last()).copied().collect();
    let (mut done, mut next) = (0.0, 1);
    for ends in way.windows(2) {
        let here = length(&ends[0], &ends[1]);
        while next < 500 && f64::from(next) / 500.0 * whole <= done + here && here > 0.0 {
            let part = (f64::from(next) / 500.0 * whole - done) / here;
            let mut place: Place = std::array::from_fn(|k| ends[0][k] + part * (ends[1][k] - ends[0][k]));
            place[3] = ends[1][3];
            out.push(place);
            next += 1;
        }
        done += here;
    }
    out
}

/// The directories that are edited.
fn directories() -> Vec<Directory> {
    let sharp = format!("{}\n[mask]\nmirror = true\n", support::PAPER);
    let loaded = "schema = 1\nname = \"two\"\n[star]\npoints = 4\ninner_radius = \"12 mm\"\ntube_width = \"10 mm\"\n\
        tip_angle = \"40 deg\"\n[stack]\ncount = 2\n[machine]\nprofile = \"klipper\"\n";
    [(sharp.as_str(), "generic"), (loaded, "klipper")]
        .into_iter()
        .map(|(text, machine)| {
            let profile = spec::builtin_machine(machine).expect("built in");
            let sources = Sources { spec: text, machine: profile };
            let machine = Machine::builtin(machine).expect("built in");
            let built = build(&support::read(text), &machine, sources, &[]).expect("a gripper");
            built.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
        })
        .collect()
}

/// What became of the edits of one kind.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    edits: usize,
    harmless: usize,
    by_reading: usize,
    by_bytes: usize,
}

/// A kind of file, as the table has it.
fn kind_of(name: &str) -> &str {
    match name {
        "spec.toml" | "machine.toml" | MANIFEST => name,
        _ if name.contains("preview") => "preview",
        _ => name.rsplit_once('.').map_or(name, |(_, ending)| ending),
    }
}

fn number(name: &str, default: u64) -> u64 {
    env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

/// Makes `count` edits, all kinds of files and units in turn; the table, and what was missed.
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
        let (after, what) = edit(bytes, unit, &mut dice);
        let mut edited = files.clone();
        edited.iter_mut().find(|(known, _)| known == name).expect("it").1 = after;
        cover_up(&mut edited, name);
        let after = &edited.iter().find(|(known, _)| known == name).expect("it").1;
        let row: &mut Row = table.entry((kind.clone(), unit)).or_default();
        row.edits += 1;
        let read = !read_back(&output_files(&edited)).findings.is_empty();
        let made = !prove_files(&output_files(&edited)).findings.is_empty();
        row.by_reading += usize::from(read);
        row.by_bytes += usize::from(made);
        if harmless(name, bytes, after).is_some() {
            row.harmless += usize::from(!read);
            continue;
        }
        // What a picture shows is not read.
        let unread = kind == "preview";
        for (by, found) in [("reading", read || unread), ("bytes", made)] {
            if !found {
                missed.push(format!("by {by}: {name} {unit:?} {what}"));
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
