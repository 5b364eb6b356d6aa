//! The edits: a byte, a token, a line or a block taken out, doubled, swapped or replaced, and a manifest that covers it up.

use std::ops::Range;

use stargrip_cam::manifest::{MANIFEST, Manifest, sha256};

use super::directories::{Directory, kind_of};
use crate::support::dice::Dice;

/// The unit of an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Unit {
    Byte,
    Token,
    Line,
    Block,
}

/// The edited content, and the description of the edit.
pub(crate) fn edit(bytes: &[u8], unit: Unit, dice: &mut Dice) -> (Vec<u8>, String) {
    let pieces = pieces_of(bytes, unit);
    let (a, b) = (dice.below(pieces.len()), dice.below(pieces.len()));
    let (first, second) = (pieces[a.min(b)].clone(), pieces[a.max(b)].clone());
    let piece = pieces[a].clone();
    let mut edited = bytes.to_vec();
    let quoted = |range: &Range<usize>| {
        String::from_utf8_lossy(&bytes[range.clone()]).chars().take(60).collect::<String>()
    };
    let change = match dice.below(5) {
        0 => {
            let _ = edited.drain(piece.clone()).count();
            format!("without {:?}", quoted(&piece))
        }
        1 => {
            let _ = edited.splice(piece.end..piece.end, bytes[piece.clone()].iter().copied()).count();
            format!("twice {:?}", quoted(&piece))
        }
        2 if unit != Unit::Byte => {
            let middle = &bytes[first.end.min(second.start)..second.start];
            let new = [&bytes[second.clone()], middle, &bytes[first.clone()]].concat();
            let _ = edited.splice(first.start..second.end.max(first.end), new).count();
            format!("{:?} and {:?} swapped", quoted(&first), quoted(&second))
        }
        3 if unit == Unit::Token => {
            let new = other_token(&bytes[piece.clone()], dice);
            let text = String::from_utf8_lossy(&new).into_owned();
            let _ = edited.splice(piece.clone(), new).count();
            format!("{:?} for {:?}", text, quoted(&piece))
        }
        _ => {
            let (from, to) = (pieces[b].clone(), piece.clone());
            let new: Vec<u8> = if unit == Unit::Byte {
                let bit = 1 << dice.below(8);
                bytes[to.clone()].iter().map(|byte| byte ^ bit).collect()
            } else {
                bytes[from].to_vec()
            };
            let text = String::from_utf8_lossy(&new).chars().take(60).collect::<String>();
            let _ = edited.splice(to.clone(), new).count();
            format!("{:?} for {:?}", text, quoted(&to))
        }
    };
    (edited, format!("at byte {}: {change}", piece.start))
}

/// A number near to a token that is one; else the token in the other case.
fn other_token(token: &[u8], dice: &mut Dice) -> Vec<u8> {
    let digits: Vec<usize> = (0..token.len()).filter(|i| token[*i].is_ascii_digit()).collect();
    let mut token_out = token.to_vec();
    if digits.is_empty() {
        return token.iter().map(|byte| byte ^ (0x20 * u8::from(byte.is_ascii_alphabetic()))).collect();
    }
    let digit = digits[dice.below(digits.len())];
    token_out[digit] =
        b'0' + (token_out[digit] - b'0' + 1 + u8::try_from(dice.below(9)).expect("below 9")) % 10;
    token_out
}

/// The content in pieces of a unit, without gaps for lines and blocks.
fn pieces_of(bytes: &[u8], unit: Unit) -> Vec<Range<usize>> {
    let lines = || {
        let mut start = 0;
        bytes.split_inclusive(|byte| *byte == b'\n').map(move |line| {
            start += line.len();
            start - line.len()..start
        })
    };
    let mut ranges: Vec<Range<usize>> = match unit {
        Unit::Byte => (0..bytes.len()).map(|i| i..i + 1).collect(),
        Unit::Line => lines().collect(),
        Unit::Block => {
            let line_ranges: Vec<Range<usize>> = lines().collect();
            line_ranges.chunks(6).map(|chunk| chunk[0].start..chunk[chunk.len() - 1].end).collect()
        }
        Unit::Token => {
            let blank = |i: usize| bytes[i].is_ascii_whitespace();
            let starts = (0..bytes.len()).filter(|i| !blank(*i) && (*i == 0 || blank(i - 1)));
            starts.map(|from| from..(from..bytes.len()).find(|i| blank(*i)).unwrap_or(bytes.len())).collect()
        }
    };
    if ranges.is_empty() {
        ranges.push(0..bytes.len());
    }
    ranges
}

/// Makes all other traces of the edit agree with it: the count in a program's last line, size and hash in the manifest.
pub(crate) fn cover_up(files: &mut Directory, name: &str) {
    let index = files.iter().position(|(known, _)| known == name).expect("a file");
    if kind_of(name) == "gcode"
        && let Ok(text) = String::from_utf8(files[index].1.clone())
        && let Some((body, last)) = text.trim_end_matches('\n').rsplit_once('\n')
        && let Some(mark) = last.find("end of program, ")
    {
        let close = if last.ends_with(')') { ")" } else { "" };
        let lines = body.lines().count() + 1;
        files[index].1 =
            format!("{body}\n{}end of program, {lines} lines{close}\n", &last[..mark]).into_bytes();
    }
    if name == MANIFEST {
        return;
    }
    let (bytes, hash) = (files[index].1.len(), sha256(&files[index].1));
    let manifest = files.iter_mut().find(|(known, _)| known == MANIFEST).expect("one");
    let mut read: Manifest = serde_json::from_slice(&manifest.1).expect("a manifest");
    let entry = read.files.iter_mut().find(|entry| entry.path == name).expect("an entry");
    (entry.bytes, entry.sha256) = (bytes, hash);
    manifest.1 = read.to_json();
}
