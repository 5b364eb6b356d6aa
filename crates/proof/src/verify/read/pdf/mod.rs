//! Reads PDF drawings: pages in millimetres, their lines and curves by marked content.
//!
//! Only the features that a drawing at 1:1 needs are understood; anything else is a finding, because a reader that skipped it
//! would not see what the printer draws.

mod content;
mod object;

use std::collections::{BTreeMap, BTreeSet};

use crate::verify::read::pdf::object::{PdfObject, PdfScan};
use crate::verify::{FindingCode, Findings};

pub use content::PdfPage;

/// Millimetres in a point.
const POINT: f64 = 25.4 / 72.0;

/// The objects of a file by number.
type PdfObjects<'a> = BTreeMap<u32, Indirect<'a>>;

/// The keys that each kind of object may have; a key that is not here could run, hide or turn something.
const KEYS: [(&str, &[&str]); 6] = [
    ("Catalog", &["Type", "ViewerPreferences", "Pages"]),
    ("Pages", &["Type", "Kids", "Count"]),
    ("Page", &["Type", "MediaBox", "UserUnit", "Parent", "Contents", "Resources"]),
    ("Info", &["Title"]),
    ("Stream", &["Length"]),
    ("Trailer", &["Size", "Root", "Info", "ID"]),
];

/// Per cent signs of a file without comments: `%PDF`, the line of bytes beyond ASCII, `%%EOF`.
const SIGNS: usize = 4;

/// Reads the pages of a PDF file; its faults go to `findings`.
pub fn read_pdf(bytes: &[u8], findings: &mut Findings) -> Vec<PdfPage> {
    read_document(bytes, findings).0
}

/// The same, with the strings of the file: its title, and twice its identity.
pub(in crate::verify) fn read_document<'a>(
    bytes: &'a [u8],
    findings: &mut Findings,
) -> (Vec<PdfPage>, Vec<&'a [u8]>) {
    let nothing = (Vec::new(), Vec::new());
    if !bytes.starts_with(b"%PDF-1.7\n") {
        findings.add_at(FindingCode::BadPdf, 1, "no %PDF-1.7 at the beginning", "a PDF file");
        return nothing;
    }
    if bytes.split(|byte| *byte == b'%').count() != SIGNS + 1 || !bytes.trim_ascii_end().ends_with(b"%%EOF") {
        findings.add(FindingCode::BadPdf, "comments, or no end", "no comments, and %%EOF last");
    }
    let mut scan = PdfScan::new(bytes);
    let (objects, trailer) = match file(&mut scan) {
        Ok(parts) => parts,
        Err(found) => {
            let found = format!("{found} at byte {}", scan.position());
            findings.add(FindingCode::BadPdf, found, "objects as PDF 1.7 has them");
            return nothing;
        }
    };
    let mut walk = PageWalk { objects: &objects, seen: BTreeSet::new(), findings };
    let root = trailer.get("Root").and_then(|root| walk.follow(root, "Catalog"));
    let scaling = root.and_then(|catalog| catalog.value.get("ViewerPreferences"));
    if root.is_some() && scaling != Some(&PdfObject::Dict([("PrintScaling", PdfObject::Name("None"))].into()))
    {
        walk.refuse("no /PrintScaling /None, without which pages are printed smaller");
    }
    let tree = root.and_then(|catalog| walk.follow(catalog.value.get("Pages")?, "Pages"));
    let info = trailer.get("Info").and_then(|info| walk.follow(info, "Info"));
    walk.keys(&trailer, "Trailer");
    let Some(tree) = tree else {
        findings.add(FindingCode::BadPdf, "no page tree", "a catalog with pages");
        return nothing;
    };
    let kids = tree.value.get("Kids").map_or(&[][..], PdfObject::items);
    #[expect(clippy::cast_precision_loss, reason = "pages are few")]
    let (count, size) = (kids.len() as f64, objects.len() as f64 + 1.0);
    let says = |object: &PdfObject<'_>, key: &str| object.get(key).and_then(PdfObject::number);
    if says(&tree.value, "Count") != Some(count) || says(&trailer, "Size") != Some(size) {
        walk.refuse("another number of pages or objects than declared");
    }
    let pages = kids.iter().filter_map(|kid| walk.page(kid)).collect();
    if walk.seen.len() != objects.len() {
        walk.refuse("objects that nothing refers to");
    }
    let title = info.and_then(|info| info.value.get("Title"));
    let strings = title.into_iter().chain(trailer.get("ID").map_or(&[][..], PdfObject::items));
    (pages, strings.filter_map(PdfObject::text).collect())
}

/// The way from the trailer to all that it refers to.
struct PageWalk<'a, 'b> {
    objects: &'b PdfObjects<'a>,
    seen: BTreeSet<u32>,
    findings: &'b mut Findings,
}

impl<'a, 'b> PageWalk<'a, 'b> {
    fn refuse(&mut self, found: impl Into<String>) {
        self.findings.add(FindingCode::BadPdf, found, "objects as this tool writes them");
    }

    /// The object of `reference`, which must be of this kind, and not have been met before.
    fn follow(&mut self, reference: &PdfObject<'_>, kind: &str) -> Option<&'b Indirect<'a>> {
        let number = reference.target()?;
        let object = self.objects.get(&number)?;
        if !self.seen.insert(number) {
            self.refuse(format!("object {number} in two places"));
        }
        self.keys(&object.value, kind);
        if object.stream.is_some() != (kind == "Stream") {
            self.refuse(format!("object {number} with or without a stream"));
        }
        Some(object)
    }

    /// Checks that a dictionary has the keys of its kind, and names its kind.
    fn keys(&mut self, object: &PdfObject<'_>, kind: &str) {
        let allowed = KEYS.iter().find(|(name, _)| *name == kind).map_or(&[][..], |(_, keys)| *keys);
        let PdfObject::Dict(entries) = object else {
            self.refuse(format!("a {kind} that is not a dictionary"));
            return;
        };
        for key in entries.keys().filter(|key| !allowed.contains(key)) {
            let (found, allowed) = (format!("/{key} in a {kind}"), format!("/{}", allowed.join(" /")));
            self.findings.add(FindingCode::UnknownWord, found, allowed);
        }
        let missing = allowed.iter().find(|key| **key != "UserUnit" && !entries.contains_key(*key));
        if let Some(missing) = missing {
            self.refuse(format!("a {kind} without /{missing}"));
        }
        if entries.get("Type").is_some_and(|name| *name != PdfObject::Name(kind)) {
            self.refuse(format!("another /Type than /{kind}"));
        }
    }

    fn page(&mut self, kid: &PdfObject<'_>) -> Option<PdfPage> {
        let content = self.follow(kid, "Page").and_then(|page| {
            let stream = self.follow(page.value.get("Contents")?, "Stream")?.stream?;
            Some((&page.value, stream, extent(&page.value)?))
        });
        let Some((page, stream, size)) = content else {
            let (found, allowed) = ("a page without size or content", "a MediaBox at 0 0 and one stream");
            self.findings.add(FindingCode::BadPdf, found, allowed);
            return None;
        };
        // Resources can bring in fonts and pictures, which no drawing has.
        if page.get("Resources") != Some(&PdfObject::Dict(BTreeMap::new())) {
            self.refuse("a page with resources");
        }
        let parent = page.get("Parent").and_then(PdfObject::target).and_then(|n| self.objects.get(&n));
        let kids = parent.and_then(|parent| parent.value.get("Kids"));
        if !kids.is_some_and(|kids| kids.items().contains(kid)) {
            self.refuse("a page whose parent does not have it");
        }
        let unit = page.get("UserUnit").and_then(PdfObject::number).unwrap_or(1.0);
        Some(content::read(stream, size, unit * POINT, self.findings))
    }
}

/// Width and height of a page, mm.
fn extent(page: &PdfObject<'_>) -> Option<(f64, f64)> {
    let unit = page.get("UserUnit").map_or(Some(1.0), PdfObject::number)?;
    let numbers: Option<Vec<f64>> = page.get("MediaBox")?.items().iter().map(PdfObject::number).collect();
    match numbers?[..] {
        [0.0, 0.0, w, h] if w > 0.0 && h > 0.0 => Some((w * unit * POINT, h * unit * POINT)),
        _ => None,
    }
}

/// An object of a file.
struct Indirect<'a> {
    /// Its offset, by which other readers find it.
    at: usize,
    value: PdfObject<'a>,
    stream: Option<&'a [u8]>,
}

/// All objects, and the trailer's dictionary; an error is what was found instead.
fn file<'a>(scan: &mut PdfScan<'a>) -> Result<(PdfObjects<'a>, PdfObject<'a>), &'static str> {
    let mut objects = PdfObjects::new();
    let table = loop {
        let (at, word) = scan.word();
        if word == "xref" {
            break at;
        }
        let number: u32 = word.parse().map_err(|_| "no object")?;
        let object = indirect(scan, at)?;
        if objects.insert(number, object).is_some() {
            return Err("an object twice");
        }
    };
    offsets(scan, &objects)?;
    let trailer = (scan.word().1 == "trailer").then(|| scan.object()).flatten().ok_or("no trailer")?;
    let start = (scan.word().1 == "startxref").then(|| scan.word().1.parse()).ok_or("no startxref")?;
    if start != Ok(table) {
        return Err("a startxref that does not point to xref");
    }
    if scan.is_done() { Ok((objects, trailer)) } else { Err("something after the end") }
}

/// An object whose number has been read.
fn indirect<'a>(scan: &mut PdfScan<'a>, at: usize) -> Result<Indirect<'a>, &'static str> {
    if (scan.word().1, scan.word().1) != ("0", "obj") {
        return Err("no object");
    }
    let value = scan.object().ok_or("no value")?;
    let mut end = scan.word().1;
    let mut stream = None;
    if end == "stream" {
        let length = value.get("Length").and_then(PdfObject::number).and_then(whole);
        stream = length.and_then(|length| scan.stream(length));
        if stream.is_none() || scan.word().1 != "endstream" {
            return Err("a stream without its length");
        }
        end = scan.word().1;
    }
    if end == "endobj" { Ok(Indirect { at, value, stream }) } else { Err("no endobj") }
}

/// Checks the table of offsets by which other readers find the objects.
fn offsets(scan: &mut PdfScan<'_>, objects: &PdfObjects<'_>) -> Result<(), &'static str> {
    let mut word = || scan.word().1;
    if (word(), word().parse()) != ("0", Ok(objects.len() + 1))
        || [word(), word(), word()] != ["0000000000", "65535", "f"]
    {
        return Err("another head of xref");
    }
    for (number, object) in (1..).zip(objects) {
        let right =
            *object.0 == number && word().parse() == Ok(object.1.at) && [word(), word()] == ["00000", "n"];
        if !right {
            return Err("an object that is not at its place in xref");
        }
    }
    Ok(())
}

fn whole(x: f64) -> Option<usize> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked by the guard")]
    let n = (x >= 0.0 && x.fract() == 0.0).then_some(x as usize);
    n
}
