//! Reads PDF drawings: pages in millimetres, their lines and curves by marked content.
//!
//! Only what a drawing at 1:1 needs is understood; anything else is a finding, because a reader that skipped it could
//! not say what the printer draws.

mod content;
mod object;
mod page;

use std::collections::BTreeMap;

use crate::verify::read::pdf::object::{Object, Scan};
use crate::verify::{FindingCode, Findings};

pub use page::PdfPage;

/// Millimetres in a point.
const POINT: f64 = 25.4 / 72.0;

/// The objects of a file by number.
type Objects<'a> = BTreeMap<u32, (Object<'a>, Option<&'a [u8]>)>;

/// Reads the pages of a PDF file; what is wrong with it goes to `findings`.
pub fn read_pdf(bytes: &[u8], findings: &mut Findings) -> Vec<PdfPage> {
    if !bytes.starts_with(b"%PDF-1.") {
        findings.add(FindingCode::BadPdf, 1, "no %PDF-1. at the beginning", "a PDF file");
        return Vec::new();
    }
    let Some((objects, trailer)) = objects(bytes, findings) else { return Vec::new() };
    let object = |reference: Option<&Object<'_>>| objects.get(&reference?.target()?);
    let tree = object(trailer.get("Root")).and_then(|(catalog, _)| object(catalog.get("Pages")));
    let Some((tree, _)) = tree else {
        findings.add(FindingCode::BadPdf, None, "no page tree", "a catalog with pages");
        return Vec::new();
    };
    let mut pages = Vec::new();
    for kid in tree.get("Kids").map_or(&[][..], Object::items) {
        let content = object(Some(kid)).and_then(|(page, _)| {
            let (_, stream) = object(page.get("Contents"))?;
            Some((page, (*stream)?, extent(page)?))
        });
        let Some((page, stream, size)) = content else {
            findings.add(
                FindingCode::BadPdf,
                None,
                "a page without size or content",
                "a MediaBox at 0 0 and one stream",
            );
            continue;
        };
        for key in ["Rotate", "CropBox", "Annots"].into_iter().filter(|key| page.get(key).is_some()) {
            findings.add(FindingCode::Transform, None, format!("a page with /{key}"), "a page as it is");
        }
        let unit = page.get("UserUnit").and_then(Object::number).unwrap_or(1.0);
        pages.push(content::read(stream, size, unit * POINT, findings));
    }
    pages
}

/// Width and height of a page, mm.
fn extent(page: &Object<'_>) -> Option<(f64, f64)> {
    let unit = page.get("UserUnit").map_or(Some(1.0), Object::number)?;
    let numbers: Option<Vec<f64>> = page.get("MediaBox")?.items().iter().map(Object::number).collect();
    match numbers?[..] {
        [0.0, 0.0, w, h] if w > 0.0 && h > 0.0 => Some((w * unit * POINT, h * unit * POINT)),
        _ => None,
    }
}

/// All objects and the trailer's dictionary.
fn objects<'a>(bytes: &'a [u8], findings: &mut Findings) -> Option<(Objects<'a>, Object<'a>)> {
    let mut scan = Scan::new(bytes);
    let mut objects = Objects::new();
    let mut refuse = |found: String| {
        findings.add(FindingCode::BadPdf, None, found, "objects as PDF 1.7 has them");
        None
    };
    loop {
        match scan.object() {
            Some(Object::Number(number)) => {
                let (generation, word) = (scan.object(), scan.object());
                if generation != Some(Object::Number(0.0)) || word != Some(Object::Word("obj")) {
                    return refuse(format!("no object at byte {}", scan.position()));
                }
                let Some(value) = scan.object() else {
                    return refuse(format!("no value at byte {}", scan.position()));
                };
                let mut stream = None;
                let mut end = scan.object();
                if end == Some(Object::Word("stream")) {
                    if value.get("Filter").is_some() {
                        return refuse(format!("a compressed stream at byte {}", scan.position()));
                    }
                    let length = value.get("Length").and_then(Object::number).and_then(whole);
                    stream = length.and_then(|length| scan.stream(length));
                    if stream.is_none() || scan.object() != Some(Object::Word("endstream")) {
                        return refuse(format!("a stream without its length at byte {}", scan.position()));
                    }
                    end = scan.object();
                }
                let number = whole(number).and_then(|number| u32::try_from(number).ok());
                if number.and_then(|number| objects.insert(number, (value, stream))).is_some() {
                    return refuse(format!("an object twice at byte {}", scan.position()));
                }
                if end != Some(Object::Word("endobj")) {
                    return refuse(format!("no endobj at byte {}", scan.position()));
                }
            }
            Some(Object::Word("xref")) => break,
            _ => return refuse(format!("no object at byte {}", scan.position())),
        }
    }
    while let Some(object) = scan.object() {
        if object == Object::Word("trailer") {
            return scan.object().map(|trailer| (objects, trailer));
        }
    }
    refuse("no trailer".to_owned())
}

fn whole(x: f64) -> Option<usize> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the guard says so")]
    let n = (x >= 0.0 && x.fract() == 0.0).then_some(x as usize);
    n
}
