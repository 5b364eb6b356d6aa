//! PDF files against the pages they should be.

use crate::design::{Layer, PaperPage};
use crate::verify::judge::files::drawings;
use crate::verify::read::pdf::{PdfPage, read_pdf};
use crate::verify::{FindingCode, Findings};

/// How exact paper has to be, mm: PDF states numbers in single precision and curves for arcs.
const TOLERANCE: f64 = 0.01;

/// Reads a PDF and compares it page by page; its largest deviation, mm.
pub(in crate::verify) fn check(bytes: &[u8], pages: &[PaperPage], findings: &mut Findings) -> f64 {
    let found = read_pdf(bytes, findings);
    if found.len() != pages.len() {
        findings.add(
            FindingCode::PageCount,
            None,
            format!("{} pages", found.len()),
            format!("{}", pages.len()),
        );
    }
    found.iter().zip(pages).map(|(found, exact)| page(found, exact, findings)).fold(0.0, f64::max)
}

fn page(found: &PdfPage, exact: &PaperPage, findings: &mut Findings) -> f64 {
    let (w, h) = (exact.drawing.width, exact.drawing.height);
    if (found.size.0 - w).abs() > TOLERANCE || (found.size.1 - h).abs() > TOLERANCE {
        let size = format!("page {}: {:.3} x {:.3} mm", exact.name, found.size.0, found.size.1);
        findings.add(FindingCode::WrongSize, None, size, format!("{w} x {h} mm"));
    }
    let window = exact.window;
    for (layer, clip) in &found.clips {
        let off = clip.min.distance(window.min).max(clip.max.distance(window.max));
        if off > TOLERANCE || layer == Layer::PaperMark.name() {
            findings.add(
                FindingCode::WrongClip,
                None,
                format!("{clip:?} on layer {layer}"),
                format!("{window:?}"),
            );
        }
    }
    drawings::compare(&found.drawing, &exact.drawing, TOLERANCE, findings)
}
