//! Edits of a right file: changes that a person, a transfer or another program might make.

/// Choices that the fuzzer makes, a byte at a time; 0 once there are none left.
pub(super) struct Choices<'a>(&'a [u8]);

impl<'a> Choices<'a> {
    /// All of `bytes`.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// The next byte.
    pub(super) fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    /// The next number below `n`, 0 if that is 0.
    pub(super) fn below(&mut self, n: usize) -> usize {
        let number = self.numbered();
        if n == 0 { 0 } else { number % n }
    }

    /// A part of a whole, 0 to 1.
    pub(super) fn share(&mut self) -> f64 {
        f64::from(self.byte()) / 255.0
    }

    /// The next few bytes, with their number before them.
    pub(super) fn piece(&mut self) -> &'a [u8] {
        let length = usize::from(self.byte()).min(self.0.len());
        let (piece, rest) = self.0.split_at(length);
        self.0 = rest;
        piece
    }

    /// All remaining bytes.
    pub(super) fn rest(self) -> &'a [u8] {
        self.0
    }

    /// Whether it is empty.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn numbered(&mut self) -> usize {
        usize::from(self.byte()) << 8 | usize::from(self.byte())
    }
}

/// Most edits of one file: one for each rule that might look the other way.
const EDITS: usize = 6;

/// `bytes` after some edits, of lines, of numbers and of bytes.
pub(super) fn edited(bytes: &[u8], choices: &mut Choices<'_>) -> Vec<u8> {
    let mut out = bytes.to_vec();
    for _ in 0..EDITS {
        if choices.is_empty() {
            break;
        }
        out = match choices.byte() % 8 {
            0 => with_bytes(&out, choices),
            1 => with_number(&out, choices),
            kind => with_lines(&out, kind, choices),
        };
    }
    out
}

fn with_bytes(bytes: &[u8], choices: &mut Choices<'_>) -> Vec<u8> {
    // Two bytes of place reach any file of a small build.
    let start = choices.below(bytes.len() + 1);
    let end = (start + usize::from(choices.byte() % 16)).min(bytes.len());
    [&bytes[..start], choices.piece(), &bytes[end..]].concat()
}

/// Another number in place of one, or a digit more of it.
fn with_number(bytes: &[u8], choices: &mut Choices<'_>) -> Vec<u8> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.' || *byte == b'-';
    let starts: Vec<usize> =
        (0..bytes.len()).filter(|i| is_part(&bytes[*i]) && (*i == 0 || !is_part(&bytes[i - 1]))).collect();
    let Some(start) = starts.get(choices.below(starts.len())).copied() else { return bytes.to_vec() };
    let end = start + bytes[start..].iter().take_while(|byte| is_part(byte)).count();
    let old = std::str::from_utf8(&bytes[start..end]).unwrap_or_default();
    let number = old.parse::<f64>().unwrap_or(0.0);
    let new = match choices.byte() % 8 {
        0 => format!("{}", number + 0.001 * f64::from(choices.byte())),
        1 => format!("{}", number - 0.001 * f64::from(choices.byte())),
        2 => format!("{}", number * f64::from(choices.byte())),
        3 => format!("{}", -number),
        4 => format!("{old}{}", choices.byte() % 10),
        5 => format!("{}", number + f64::from(choices.byte())),
        6 => {
            ["0", "-0", "1e308", "nan", "inf", "1e-300", "", "00"][usize::from(choices.byte() % 8)].to_owned()
        }
        _ => String::from_utf8_lossy(choices.piece()).into_owned(),
    };
    [&bytes[..start], new.as_bytes(), &bytes[end..]].concat()
}

fn with_lines(bytes: &[u8], kind: u8, choices: &mut Choices<'_>) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    let (a, b) = (choices.below(lines.len()), choices.below(lines.len()));
    let count = 1 + usize::from(choices.byte() % 8);
    let until = (a + count).min(lines.len());
    let new;
    match kind {
        _ if lines.is_empty() => {}
        2 => drop(lines.drain(a..until)),
        3 => {
            let block = lines[a..until].to_vec();
            drop(lines.splice(b..b, block));
        }
        4 => lines.swap(a, b),
        5 => {
            new = [choices.piece(), b"\n"].concat();
            lines[a] = &new;
        }
        6 => {
            new = [choices.piece(), b"\n"].concat();
            lines.insert(a, &new);
        }
        // The end of a line after the beginning of another.
        _ => {
            let (from, to) = (lines[a], lines[b]);
            let (i, j) = (choices.below(from.len()), choices.below(to.len()));
            new = [&from[..i], &to[j..]].concat();
            lines[a] = &new;
        }
    }
    lines.concat()
}

/// A program whose last line counts its lines, as the writer of an edit would see to.
pub(super) fn counted(text: &str) -> String {
    let Some((body, last)) = text.trim_end_matches('\n').rsplit_once('\n') else { return text.to_owned() };
    let Some(mark) = last.find("end of program, ") else { return text.to_owned() };
    let close = if last.ends_with(')') { ")" } else { "" };
    format!("{body}\n{}end of program, {} lines{close}\n", &last[..mark], body.split('\n').count() + 1)
}
