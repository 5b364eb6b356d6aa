//! PDF objects: names, numbers, arrays, dictionaries, references and streams, read in the order of the file.

use std::collections::BTreeMap;

use crate::verify::read::number;

/// Arrays and dictionaries inside each other beyond this depth are refused: the walk is recursive.
const DEPTH: usize = 16;

/// One object.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum PdfObject<'a> {
    /// A number.
    Number(f64),
    /// `/Name`.
    Name(&'a str),
    /// A string, as it is in the file.
    Text(&'a [u8]),
    /// `[ ... ]`.
    Array(Vec<PdfObject<'a>>),
    /// `<< ... >>`.
    Dict(BTreeMap<&'a str, PdfObject<'a>>),
    /// `n 0 R`.
    Reference(u32),
    /// A keyword or an operator.
    Word(&'a str),
}

impl<'a> PdfObject<'a> {
    /// The value of `key`, if this is a dictionary that has it.
    pub(super) fn get(&self, key: &str) -> Option<&Self> {
        if let Self::Dict(entries) = self { entries.get(key) } else { None }
    }

    /// The elements, if this is an array.
    pub(super) fn items(&self) -> &[Self] {
        if let Self::Array(items) = self { items } else { &[] }
    }

    /// The value, if this is a number.
    pub(super) fn number(&self) -> Option<f64> {
        if let Self::Number(x) = self { Some(*x) } else { None }
    }

    /// The bytes, if this is a string.
    pub(super) fn text(&self) -> Option<&'a [u8]> {
        if let Self::Text(bytes) = self { Some(bytes) } else { None }
    }

    /// The number of the object that this refers to.
    pub(super) fn target(&self) -> Option<u32> {
        if let Self::Reference(n) = self { Some(*n) } else { None }
    }
}

/// Reads objects off the front of bytes.
#[derive(Clone)]
pub(super) struct PdfScan<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> PdfScan<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// The position of the reader, in bytes.
    pub(super) fn position(&self) -> usize {
        self.at
    }

    /// The next word, and its offset.
    pub(super) fn word(&mut self) -> (usize, &'a str) {
        self.skip_blanks();
        (self.at, self.regular())
    }

    /// Whether the input is at its end.
    pub(super) fn is_done(&mut self) -> bool {
        self.skip_blanks();
        self.at >= self.bytes.len()
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while let Some(byte) = self.peek() {
            if byte == b'%' {
                while self.peek().is_some_and(|b| b != b'\n' && b != b'\r') {
                    self.at += 1;
                }
            } else if is_blank(byte) {
                self.at += 1;
            } else {
                break;
            }
        }
    }

    /// The next object; `None` at the end or where nothing can be read.
    pub(super) fn object(&mut self) -> Option<PdfObject<'a>> {
        self.nested(0)
    }

    fn nested(&mut self, depth: usize) -> Option<PdfObject<'a>> {
        if depth > DEPTH {
            return None;
        }
        self.skip_blanks();
        match (self.peek()?, self.bytes.get(self.at + 1)) {
            (b'/', _) => {
                self.at += 1;
                Some(PdfObject::Name(self.regular()))
            }
            (b'<', Some(b'<')) => {
                self.at += 2;
                self.dict(depth)
            }
            (b'[', _) => {
                self.at += 1;
                let mut items = Vec::new();
                loop {
                    self.skip_blanks();
                    if self.peek()? == b']' {
                        self.at += 1;
                        return Some(PdfObject::Array(items));
                    }
                    items.push(self.nested(depth + 1)?);
                }
            }
            (b'(', _) => self.literal(),
            // This tool writes no strings in hexadecimal.
            (b'<' | b')' | b']' | b'>' | b'{' | b'}', _) => None,
            _ => {
                let word = self.regular();
                let Some(value) = number::value(word) else { return Some(PdfObject::Word(word)) };
                Some(self.reference(word).unwrap_or(PdfObject::Number(value)))
            }
        }
    }

    fn dict(&mut self, depth: usize) -> Option<PdfObject<'a>> {
        let mut entries = BTreeMap::new();
        loop {
            self.skip_blanks();
            if self.bytes.get(self.at..)?.starts_with(b">>") {
                self.at += 2;
                return Some(PdfObject::Dict(entries));
            }
            let PdfObject::Name(key) = self.nested(depth + 1)? else { return None };
            let value = self.nested(depth + 1)?;
            // A key that occurs twice is read differently by different readers.
            if entries.insert(key, value).is_some() {
                return None;
            }
        }
    }

    /// `n 0 R`, of which `first` has been read.
    fn reference(&mut self, first: &str) -> Option<PdfObject<'a>> {
        let target: u32 = first.parse().ok()?;
        let mut ahead = self.clone();
        if ahead.word().1 != "0" || ahead.word().1 != "R" {
            return None;
        }
        self.at = ahead.at;
        Some(PdfObject::Reference(target))
    }

    /// A string in brackets, which may hold pairs of brackets and escapes.
    fn literal(&mut self) -> Option<PdfObject<'a>> {
        let (mut open, start) = (0_usize, self.at + 1);
        loop {
            match self.peek()? {
                b'(' => open += 1,
                b')' => open -= 1,
                b'\\' => self.at += 1,
                _ => {}
            }
            self.at += 1;
            if open == 0 {
                return Some(PdfObject::Text(self.bytes.get(start..self.at - 1)?));
            }
        }
    }

    fn regular(&mut self) -> &'a str {
        let start = self.at;
        let ends = |b: &u8| {
            is_blank(*b) || matches!(b, b'(' | b')' | b'<' | b'>' | b'[' | b']' | b'{' | b'}' | b'/' | b'%')
        };
        let rest = self.bytes.get(start..).unwrap_or_default();
        self.at += rest.iter().position(ends).unwrap_or(rest.len());
        // Bytes that are not text are not a word of this tool either.
        std::str::from_utf8(&self.bytes[start..self.at]).unwrap_or("\u{fffd}")
    }

    /// The bytes of a stream of `length`, whose dictionary and keyword have been read.
    pub(super) fn stream(&mut self, length: usize) -> Option<&'a [u8]> {
        if self.bytes.get(self.at..)?.starts_with(b"\r\n") {
            self.at += 2;
        } else if self.peek()? == b'\n' {
            self.at += 1;
        } else {
            return None;
        }
        let bytes = self.bytes.get(self.at..self.at.checked_add(length)?)?;
        self.at += length;
        Some(bytes)
    }
}

/// White space of the standard without NUL, which is unusual in a text and not passed over by every reader.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b'\t' | b'\n' | b'\x0c' | b'\r' | b' ')
}
