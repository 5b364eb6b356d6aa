//! PDF at 1:1 for printers: pages of lines and curves, content streams uncompressed so that they can be read back.
//!
//! One user unit of the content is a millimetre. Every layer is a marked-content sequence under the layer's name. PDF
//! has no arcs: each becomes Bézier curves of at most 30 degrees, which leave the circle by less than 4e-7 of the radius.

use std::f64::consts::FRAC_PI_6;

use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, TextStr};

use design::{Layer, PaperPage};
use geom::{Arc, Path, Point, Segment};
use program::number::{Decimals, single};
use program::text::inert;

/// Points in a millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// Largest page without a larger unit, points: PDF 1.7, annex C.
const LARGEST: f64 = 14_400.0;
/// Decimals of a coordinate: a page is below 10 m, where single precision still resolves 0.001 mm.
const DECIMALS: u32 = 4;

/// The pages as a PDF document.
pub fn pdf(title: &str, pages: &[PaperPage]) -> Vec<u8> {
    let mut pdf = Pdf::new();
    let [catalog, tree, info] = [1, 2, 3].map(Ref::new);
    let ids: Vec<(Ref, Ref)> =
        pages.iter().zip((4..).step_by(2)).map(|(_, id)| (Ref::new(id), Ref::new(id + 1))).collect();
    let mut root = pdf.catalog(catalog);
    let _ = root.pages(tree);
    // Programs that print would otherwise offer to fit the page to the paper.
    root.viewer_preferences().pair(Name(b"PrintScaling"), Name(b"None")).finish();
    root.finish();
    let count = i32::try_from(pages.len()).unwrap_or(i32::MAX);
    pdf.pages(tree).kids(ids.iter().map(|(page, _)| *page)).count(count).finish();
    pdf.document_info(info).title(TextStr(&inert(title, 120))).finish();
    for (page, (id, content)) in pages.iter().zip(ids) {
        let (width, height) = (page.drawing.width * POINTS, page.drawing.height * POINTS);
        let unit = (width.max(height) / LARGEST).ceil().max(1.0);
        let mut dict = pdf.page(id);
        let _ = dict.media_box(Rect::new(0.0, 0.0, single(width / unit), single(height / unit)));
        if unit > 1.0 {
            let _ = dict.user_unit(single(unit));
        }
        let _ = dict.parent(tree).contents(content);
        let _ = dict.resources();
        dict.finish();
        pdf.stream(content, &stream(page, POINTS / unit)).finish();
    }
    // The document's identity must not change from build to build; it is made of the title.
    pdf.set_file_id((inert(title, 120).into_bytes(), inert(title, 120).into_bytes()));
    pdf.finish()
}

fn stream(page: &PaperPage, scale: f64) -> Vec<u8> {
    let mut content = Content::new();
    let _ = content.save_state().transform([single(scale), 0.0, 0.0, single(scale), 0.0, 0.0]);
    for (layer, shapes) in page.drawing.layers.iter().filter(|(_, shapes)| !shapes.is_empty()) {
        let _ = content.save_state();
        if *layer != Layer::PaperMark {
            let w = &page.window;
            let _ = content
                .rect(number(w.min.x), number(w.min.y), number(w.width()), number(w.height()))
                .clip_nonzero()
                .end_path();
        }
        let PaperPen { width, gray } = pen(*layer);
        let name = Name(layer.name().as_bytes());
        let _ = content.begin_marked_content(name).set_line_width(width).set_stroke_gray(gray);
        for shape in shapes {
            shape.paths().iter().for_each(|path| draw(&mut content, path));
            let _ = content.stroke();
        }
        let _ = content.end_marked_content().restore_state();
    }
    let _ = content.restore_state();
    content.finish().to_vec()
}

/// The strokes of a layer on paper.
struct PaperPen {
    /// mm
    width: f32,
    /// From 0, black, to 1, white.
    gray: f32,
}

/// The pen of `layer`: cut lines are black and thin, seams and text are grey and wide.
fn pen(layer: Layer) -> PaperPen {
    match layer {
        Layer::PaperMark => PaperPen { width: 0.15, gray: 0.0 },
        Layer::Label | Layer::Seal | Layer::SealInner | Layer::SealOuter => {
            PaperPen { width: 0.25, gray: 0.5 }
        }
        Layer::CutOutside
        | Layer::CutHole
        | Layer::CutValve
        | Layer::Registration
        | Layer::MaskWindow
        | Layer::MaskPlate
        | Layer::MaskJoint
        | Layer::PostHole
        | Layer::FrameOpening
        | Layer::SeparatorWindow
        | Layer::SeparatorEdge
        | Layer::FrameEdge => PaperPen { width: 0.1, gray: 0.0 },
    }
}

fn draw(content: &mut Content, path: &Path) {
    let Some(start) = path.start() else { return };
    let _ = content.move_to(number(start.x), number(start.y));
    let last = path.segments.len() - 1;
    for (i, segment) in path.segments.iter().enumerate() {
        let closes = path.closed && i == last;
        match segment {
            Segment::Line(_) if closes => {}
            Segment::Line(line) => {
                let _ = content.line_to(number(line.end.x), number(line.end.y));
            }
            Segment::Arc(arc) => curves(content, arc, closes.then_some(start)),
        }
    }
    if path.closed {
        let _ = content.close_path();
    }
}

/// An arc as curves; the last one ends at `end` if that is given.
fn curves(content: &mut Content, arc: &Arc, end: Option<Point>) {
    let count = (arc.sweep.abs() / FRAC_PI_6 - 1e-9).ceil().max(1.0);
    let handle = 4.0 / 3.0 * libm::tan(arc.sweep.abs() / count / 4.0) * arc.radius;
    let mut pieces_done = 0.0;
    while pieces_done < count {
        let (from, to) = (pieces_done / count, (pieces_done + 1.0) / count);
        let [start, stop] = [from, to].map(|part| arc.at_angle(arc.start_angle + part * arc.sweep));
        let (a, b) = (start + arc.tangent(from) * handle, stop - arc.tangent(to) * handle);
        let stop = end.filter(|_| to >= 1.0).unwrap_or(stop);
        let [x1, y1, x2, y2, x, y] = [a.x, a.y, b.x, b.y, stop.x, stop.y].map(number);
        let _ = content.cubic_to(x1, y1, x2, y2, x, y);
        pieces_done += 1.0;
    }
}

/// A coordinate as PDF writers take it.
fn number(x: f64) -> f32 {
    single(Decimals::exactly(DECIMALS).round(x))
}
