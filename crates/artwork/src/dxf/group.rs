//! Group codes: pairs of lines, and the records they make.

use crate::collector::ReadingStop;
use crate::{Fault, Place};

/// A code and its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct CodeGroup<'a> {
    pub(super) code: i32,
    pub(super) value: &'a str,
}

/// All groups up to the end of the file; group `i` is on the lines `2 i + 1` and `2 i + 2`.
pub(super) fn groups(text: &str, max_groups: usize) -> Result<Vec<CodeGroup<'_>>, Vec<Fault>> {
    // A group is two lines: a code and a value. Blanks around values do not count, but in texts (code 1). Reading ends
    // at the end mark; a file without one may be cut off and is refused.
    let mut lines = text.lines();
    let mut groups = Vec::new();
    while let Some(first) = lines.next() {
        let line = 2 * groups.len() + 1;
        let Ok(code) = first.trim().parse::<i32>() else {
            if first.trim().is_empty() && lines.all(|rest| rest.trim().is_empty()) {
                break;
            }
            let beginning: String = first.trim().chars().take(20).collect();
            return Err(Fault::single(
                Place::line(line),
                format!("\"{beginning}\" is not a group code."),
                "Export the drawing as ASCII DXF again.",
            ));
        };
        let Some(value) = lines.next() else {
            return Err(Fault::single(
                Place::line(line),
                "The file ends within a group.",
                "Copy or export the file again: it is cut off.",
            ));
        };
        if groups.len() >= max_groups {
            let text = format!("The file has more than {max_groups} groups.");
            return Err(Fault::single(Place::line(line), text, "Split the drawing."));
        }
        let value = if code == 1 { value } else { value.trim() };
        groups.push(CodeGroup { code, value });
        if code == 0 && value == "EOF" {
            return Ok(groups);
        }
    }
    Err(Fault::single(
        Place::line(2 * groups.len()),
        "The file has no end mark (0, EOF); it may be cut off.",
        "Export it again, or add the lines 0 and EOF if it is complete.",
    ))
}

/// An entity or a table entry: a type (code 0) and the groups up to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct EntityRecord<'a, 'g> {
    /// Type of the record, such as LINE.
    pub(super) kind: &'a str,
    /// Groups of the record without the type and without the data of other programs (codes from 1000).
    pub(super) groups: &'g [CodeGroup<'a>],
    /// The line of its type.
    pub(super) line: usize,
}

/// A reason for which a record is not read.
#[derive(Debug)]
pub(super) enum Flaw {
    /// It is faulty: the finding and its line.
    At { text: String, line: usize },
    /// It is left out, because it is not read, lies in another plane or in another file: the text of the note.
    Lost(String),
    /// A limit is exceeded; the fault is recorded.
    Limit,
}

impl From<ReadingStop> for Flaw {
    fn from(_: ReadingStop) -> Self {
        Self::Limit
    }
}

impl<'a> EntityRecord<'a, '_> {
    /// The first value of a code.
    pub(super) fn text(&self, code: i32) -> Option<&'a str> {
        self.groups.iter().find(|group| group.code == code).map(|group| group.value)
    }

    /// All values of a code as numbers.
    pub(super) fn numbers(&self, code: i32) -> Result<Vec<f64>, Flaw> {
        let of_code = self.groups.iter().enumerate().filter(|(_, group)| group.code == code);
        of_code.map(|(i, group)| self.parse(i, group)).collect()
    }

    /// The number of group `i`.
    pub(super) fn parse(&self, i: usize, group: &CodeGroup<'_>) -> Result<f64, Flaw> {
        group.value.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(|| {
            let value: String = group.value.chars().take(20).collect();
            let text = format!("Code {} of {} is \"{value}\", not a finite number.", group.code, self.kind);
            Flaw::At { text, line: self.line + 2 * (i + 1) + 1 }
        })
    }

    /// The first number of a code.
    pub(super) fn optional(&self, code: i32) -> Result<Option<f64>, Flaw> {
        let of_code = self.groups.iter().enumerate().find(|(_, group)| group.code == code);
        of_code.map(|(i, group)| self.parse(i, group)).transpose()
    }

    /// The first number of a code, or `default`.
    pub(super) fn number_or(&self, code: i32, default: f64) -> Result<f64, Flaw> {
        Ok(self.optional(code)?.unwrap_or(default))
    }

    /// The number of a code that must be there.
    pub(super) fn number(&self, code: i32) -> Result<f64, Flaw> {
        self.optional(code)?.ok_or_else(|| self.flaw(format!("{} has no value of code {code}.", self.kind)))
    }

    /// A flag word; 0 if it is missing.
    pub(super) fn flags(&self, code: i32) -> Result<i64, Flaw> {
        let number = self.number_or(code, 0.0)?;
        #[expect(clippy::cast_possible_truncation, reason = "flags are small, and a cast saturates")]
        Ok(number as i64)
    }

    /// A flaw of the whole record.
    pub(super) fn flaw(&self, text: String) -> Flaw {
        Flaw::At { text, line: self.line }
    }

    /// The flaw of a record whose type is not read.
    pub(super) fn unknown(&self) -> Flaw {
        Flaw::Lost(format!("Entities of type {} are not read; it is left out.", self.kind))
    }
}

/// The records of a section.
pub(super) fn records<'a, 'g>(groups: &'g [CodeGroup<'a>], first_group: usize) -> Vec<EntityRecord<'a, 'g>> {
    let mut starts: Vec<usize> = (0..groups.len()).filter(|&i| groups[i].code == 0).collect();
    starts.push(groups.len());
    let record = |pair: &[usize]| {
        let body = &groups[pair[0] + 1..pair[1]];
        let end = body.iter().position(|group| group.code >= 1000).unwrap_or(body.len());
        EntityRecord {
            kind: groups[pair[0]].value,
            groups: &body[..end],
            line: 2 * (first_group + pair[0]) + 1,
        }
    };
    starts.windows(2).map(record).collect()
}
