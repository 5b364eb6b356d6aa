//! The tags that a DXF may hold, one by one: the frame around the entities, and every group code of an entity.
//!
//! A group code that a reader of shapes passes over can hide a line, lift it, widen it or scale it. The frame around the entities
//! in a file of this tool is in `dxf_frame.txt`, a record a line; other tags are refused.

use crate::verify::finding::quote;
use crate::verify::read::number;
use crate::verify::{Finding, FindingCode};

/// A record a line: its name, then `; code value`. `{...}` is a value that the drawing decides.
const FRAME: &str = include_str!("dxf_frame.txt");

/// Handle of the first layer; from here on they are counted up, layers first.
const FIRST_HANDLE: usize = 0x100;

/// The tags of an entity up to its numbers: (name, class).
const ENTITIES: [(&str, &str); 2] = [("LWPOLYLINE", "AcDbPolyline"), ("CIRCLE", "AcDbCircle")];

/// The data of the drawing that the frame of its file contains.
pub(in crate::verify) struct DxfFrame<'a> {
    /// Layers in order: (name, colour).
    pub(in crate::verify) layers: &'a [(&'a str, &'a str)],
    /// Lower left corner of the drawing.
    pub(in crate::verify) min: (f64, f64),
    /// Upper right corner.
    pub(in crate::verify) max: (f64, f64),
    /// Largest error of a number.
    pub(in crate::verify) tolerance: f64,
}

/// Reports the first tag of `text` that is not the expected one.
pub(in crate::verify) fn check(text: &str, frame: &DxfFrame<'_>) -> Result<(), Finding> {
    let seed = (0, String::new());
    let mut tags = Tags { frame, lines: text.lines(), line: 0, ahead: None, handle: FIRST_HANDLE, seed };
    for record in FRAME.lines() {
        match record {
            "{layers}" => tags.layers()?,
            "{entities}" => tags.entities()?,
            _ => tags.record(record)?,
        }
    }
    if let Some(tag) = tags.next()? {
        return Err(wrong(&tag, "the end of the file"));
    }
    let ((line, seed), right) = (tags.seed, format!("{:X}", tags.handle));
    if seed == right {
        return Ok(());
    }
    Err(Finding::in_line(FindingCode::UnknownWord, line, format!("$HANDSEED {seed}"), right))
}

struct Tag<'a> {
    line: usize,
    code: &'a str,
    value: &'a str,
}

fn wrong(tag: &Tag<'_>, allowed: &str) -> Finding {
    let fault = format!("{} {}", tag.code, quote(tag.value));
    Finding::in_line(FindingCode::UnknownWord, tag.line, fault, allowed)
}

/// The tags of a file, beside the frame that they should have.
struct Tags<'a> {
    frame: &'a DxfFrame<'a>,
    lines: std::str::Lines<'a>,
    line: usize,
    ahead: Option<Tag<'a>>,
    /// The next handle.
    handle: usize,
    /// Line and text of the handle that is declared free.
    seed: (usize, String),
}

impl<'a> Tags<'a> {
    fn next(&mut self) -> Result<Option<Tag<'a>>, Finding> {
        if let Some(tag) = self.ahead.take() {
            return Ok(Some(tag));
        }
        let Some(code) = self.lines.next() else { return Ok(None) };
        let line = self.line + 1;
        self.line += 2;
        let Some(value) = self.lines.next() else {
            let fault = "a group code without a value";
            return Err(Finding::in_line(FindingCode::Truncated, line, fault, "pairs of lines"));
        };
        Ok(Some(Tag { line, code: code.trim_ascii(), value }))
    }

    /// The next tag, if it has this group code.
    fn next_if(&mut self, code: &str) -> Result<Option<Tag<'a>>, Finding> {
        self.ahead = self.next()?;
        Ok(self.ahead.take_if(|tag| tag.code == code))
    }

    /// The next tag, which must have this group code.
    fn take(&mut self, code: &str, allowed: &str) -> Result<Tag<'a>, Finding> {
        match self.next()? {
            Some(tag) if tag.code == code => Ok(tag),
            Some(tag) => Err(wrong(&tag, &format!("{code} {allowed}"))),
            None => {
                let allowed = format!("{code} {allowed}");
                Err(Finding::in_line(FindingCode::Truncated, self.line, "the end of the file", allowed))
            }
        }
    }

    /// The next tag, which must have just this value.
    fn exactly(&mut self, code: &str, value: &str) -> Result<(), Finding> {
        let tag = self.take(code, value)?;
        if tag.value == value { Ok(()) } else { Err(wrong(&tag, &format!("{code} {value}"))) }
    }

    /// The tags that begin every object with a handle.
    fn object(&mut self, owner: &str, class: &str) -> Result<(), Finding> {
        self.exactly("5", &format!("{:X}", self.handle))?;
        self.handle += 1;
        self.exactly("330", owner)?;
        self.exactly("100", class)
    }

    /// A record of the frame.
    fn record(&mut self, record: &str) -> Result<(), Finding> {
        let mut parts = record.split("; ");
        self.exactly("0", parts.next().unwrap_or_default())?;
        for part in parts {
            let (code, value) = part.split_once(' ').unwrap_or((part, ""));
            let Some(name) = value.strip_prefix('{').and_then(|name| name.strip_suffix('}')) else {
                self.exactly(code, value)?;
                continue;
            };
            let tag = self.take(code, value)?;
            if name == "handseed" {
                self.seed = (tag.line, tag.value.to_owned());
                continue;
            }
            let right = self.frame.number(name);
            if !number::value(tag.value).is_some_and(|x| (x - right).abs() <= self.frame.tolerance) {
                return Err(wrong(&tag, &format!("{code} {right}")));
            }
        }
        Ok(())
    }

    fn layers(&mut self) -> Result<(), Finding> {
        for (name, colour) in self.frame.layers {
            self.exactly("0", "LAYER")?;
            self.object("2", "AcDbSymbolTableRecord")?;
            self.exactly("100", "AcDbLayerTableRecord")?;
            for (code, value) in
                [("2", *name), ("70", "0"), ("62", *colour), ("6", "Continuous"), ("390", "F")]
            {
                self.exactly(code, value)?;
            }
        }
        Ok(())
    }

    /// All entities, up to the end of their section. Their numbers are read elsewhere.
    fn entities(&mut self) -> Result<(), Finding> {
        // Circles and polylines only, each with the pairs that its class has, in their order. Whatever else follows is a finding
        // with the pair that was expected.
        while let Some(head) = self.next_if("0")? {
            let Some((_, class)) = ENTITIES.iter().find(|(name, _)| *name == head.value) else {
                if head.value == "ENDSEC" {
                    self.ahead = Some(head);
                    return Ok(());
                }
                return Err(wrong(&head, "LWPOLYLINE, CIRCLE"));
            };
            self.object("1F", "AcDbEntity")?;
            let layer = self.take("8", "a layer")?;
            if !self.frame.layers.iter().any(|(name, _)| *name == layer.value) {
                return Err(wrong(&layer, "a layer of the drawing"));
            }
            self.exactly("100", class)?;
            if head.value == "CIRCLE" {
                let _ = (self.take("10", "X")?, self.take("20", "Y")?);
                self.exactly("30", "0")?;
                let _ = self.take("40", "a radius")?;
                continue;
            }
            let _ = self.take("90", "a number of vertices")?;
            let flags = self.take("70", "0 or 1")?;
            if !matches!(flags.value, "0" | "1") {
                return Err(wrong(&flags, "70 0 or 1"));
            }
            while self.next_if("10")?.is_some() {
                let _ = (self.take("20", "Y")?, self.next_if("42")?);
            }
        }
        Ok(())
    }
}

impl DxfFrame<'_> {
    /// The value of the variable `name` of the frame.
    fn number(&self, name: &str) -> f64 {
        let (min, max) = (self.min, self.max);
        match name {
            "min_x" => min.0,
            "min_y" => min.1,
            "max_x" => max.0,
            "max_y" => max.1,
            "center_x" => min.0.midpoint(max.0),
            "center_y" => min.1.midpoint(max.1),
            "height" => max.1 - min.1,
            // With layer 0, which every file has.
            #[expect(clippy::cast_precision_loss, reason = "a dozen at most")]
            "layer_count" => self.layers.len() as f64 + 1.0,
            _ => f64::NAN,
        }
    }
}
