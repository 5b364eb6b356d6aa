//! PDF files against the pages they should be.

use crate::verify::finding::quote;
use crate::verify::judge::files::drawings;
use crate::verify::judge::files::layers::{in_file, pen};
use crate::verify::read::pdf::{PdfPage, read_document};
use crate::verify::{FindingCode, Findings};
use design::{Layer, PaperPage, Shape};

/// Required accuracy of paper, mm: PDF states numbers in single precision and curves for arcs.
const TOLERANCE: f64 = 0.01;

/// Reads a PDF and compares it page by page; its largest deviation, mm.
pub(super) fn check(bytes: &[u8], pages: &[PaperPage], title: &str, findings: &mut Findings) -> f64 {
    let (found, strings) = read_document(bytes, findings);
    let title = in_file(title, 120);
    if strings != [title.as_bytes(); 3] {
        let found =
            strings.iter().map(|bytes| quote(&String::from_utf8_lossy(bytes))).collect::<Vec<_>>().join(", ");
        findings.add(FindingCode::WrongTitle, found, format!("three times {}", quote(&title)));
    }
    if found.len() != pages.len() {
        findings.add(FindingCode::PageCount, format!("{} pages", found.len()), format!("{}", pages.len()));
    }
    found.iter().zip(pages).map(|(found, exact)| page(found, exact, findings)).fold(0.0, f64::max)
}

/// The layers on which something is drawn.
fn drawn(exact: &PaperPage) -> impl Iterator<Item = &(Layer, Vec<Shape>)> {
    exact.drawing.layers.iter().filter(|(_, shapes)| !shapes.is_empty())
}

/// Every layer is clipped to the page's window, but the marks around it; drawn with its pen; and restored after.
fn operators(found: &PdfPage, exact: &PaperPage, findings: &mut Findings) {
    let mut right = vec!["q", "cm"];
    for (layer, shapes) in drawn(exact) {
        right.push("q");
        if *layer != Layer::PaperMark {
            right.extend(["re", "W", "n"]);
        }
        right.extend(["BMC", "w", "G"]);
        right.extend(shapes.iter().map(|_| "S"));
        right.extend(["EMC", "Q"]);
    }
    right.push("Q");
    let same = found.operators.iter().zip(&right).take_while(|(a, b)| a == b).count();
    if same < right.len().max(found.operators.len()) {
        let at = |words: &[&str]| words.get(same).map_or("the end".to_owned(), |word| (*word).to_owned());
        let words: Vec<&str> = found.operators.iter().map(String::as_str).collect();
        let found = format!("{} as operator {} of page {}", at(&words), same + 1, exact.name);
        findings.add(FindingCode::UnknownWord, found, at(&right));
    }
}

fn page(found: &PdfPage, exact: &PaperPage, findings: &mut Findings) -> f64 {
    let (w, h) = (exact.drawing.width, exact.drawing.height);
    if (found.size.0 - w).abs() > TOLERANCE || (found.size.1 - h).abs() > TOLERANCE {
        let size = format!("page {}: {:.3} x {:.3} mm", exact.name, found.size.0, found.size.1);
        findings.add(FindingCode::WrongSize, size, format!("{w} x {h} mm"));
    }
    operators(found, exact, findings);
    for (layer, _) in drawn(exact) {
        let pen = pen(*layer);
        let wrong = |(name, width, gray): &&(String, _, _)| {
            *name == layer.name() && (*width, *gray) != (Some(pen.0), Some(pen.1))
        };
        if let Some((_, width, gray)) = found.strokes.iter().find(wrong) {
            let found = format!("strokes of width {width:?} and grey {gray:?} on layer {}", layer.name());
            findings.add(FindingCode::UnknownWord, found, format!("{pen:?}"));
        }
    }
    let window = exact.window;
    for (layer, clip) in &found.clips {
        let off = clip.min.distance(window.min).max(clip.max.distance(window.max));
        if off > TOLERANCE || layer == Layer::PaperMark.name() {
            findings.add(FindingCode::WrongClip, format!("{clip} on layer {layer}"), window.to_string());
        }
    }
    drawings::compare(&found.drawing, &exact.drawing, TOLERANCE, findings)
}
