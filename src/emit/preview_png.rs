//! A picture of one sheet in pixels.

use std::f64::consts::FRAC_PI_4;

use tiny_skia::{Color, FillRule, Paint, PathBuilder, Pixmap, Stroke, Transform};

use crate::design::{Design, Side};
use crate::geom::{Path, Point, Segment};

/// Pixels along the longer side.
const LONGER: f64 = 1600.0;

/// The picture of sheet number `sheet` as a PNG.
pub fn preview_png(design: &Design, sheet: usize) -> Option<Vec<u8>> {
    let layout = design.sheets.iter().find(|layout| layout.index == sheet)?;
    let scale = LONGER / layout.width.max(layout.height);
    let mut canvas = Canvas {
        pixels: Pixmap::new(pixels(layout.width * scale), pixels(layout.height * scale))?,
        to_pixels: Transform::from_row(
            single(scale),
            0.0,
            0.0,
            -single(scale),
            0.0,
            single(layout.height * scale),
        ),
    };
    canvas.pixels.fill(Color::from_rgba8(0xf7, 0xf7, 0xf4, 0xff));
    for placed in design.on_sheet(sheet) {
        let part = design.part(placed);
        let place = |path: &Path| placed.placement.path(path);
        canvas.fill(&[place(&part.outline.outside), place(&part.outline.hole)], [0xdf, 0xe6, 0xee]);
        canvas.fill(&part.realised_edges.each_ref().map(place), [0x9c, 0xc3, 0xe6]);
        for side in [Side::Hole, Side::Outside] {
            for seam in part.seams.iter().filter(|seam| seam.side == side) {
                canvas.stroke(&place(&seam.center_line), part.band, [0xe8, 0xa3, 0x3d]);
            }
        }
    }
    canvas.encoded()
}

fn pixels(x: f64) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1600")]
    let pixels = x.ceil().max(1.0) as u32;
    pixels
}

/// The nearest single: far finer than a pixel.
fn single(x: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "rounded, that is what is wanted")]
    let single = x as f32;
    single
}

struct Canvas {
    pixels: Pixmap,
    to_pixels: Transform,
}

impl Canvas {
    fn fill(&mut self, paths: &[Path], color: [u8; 3]) {
        let Some(path) = outline(paths) else { return };
        self.pixels.fill_path(&path, &paint(color), FillRule::EvenOdd, self.to_pixels, None);
    }

    fn stroke(&mut self, path: &Path, width: f64, color: [u8; 3]) {
        let Some(path) = outline(std::slice::from_ref(path)) else { return };
        let stroke = Stroke { width: single(width), ..Stroke::default() };
        self.pixels.stroke_path(&path, &paint(color), &stroke, self.to_pixels, None);
    }

    fn encoded(self) -> Option<Vec<u8>> {
        let mut out = Vec::new();
        let mut encoder = png::Encoder::new(&mut out, self.pixels.width(), self.pixels.height());
        encoder.set_color(png::ColorType::Rgb);
        let opaque = self.pixels.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]);
        let opaque: Vec<u8> = opaque.collect();
        let mut writer = encoder.write_header().ok()?;
        writer.write_image_data(&opaque).ok()?;
        writer.finish().ok()?;
        Some(out)
    }
}

fn paint(color: [u8; 3]) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(color[0], color[1], color[2], 0xff);
    paint
}

/// The paths with arcs as cubics of at most 45 degrees, which leave a circle by less than 1e-6 of its radius.
fn outline(paths: &[Path]) -> Option<tiny_skia::Path> {
    let at = |p: Point| (single(p.x), single(p.y));
    let mut out = PathBuilder::new();
    for path in paths {
        let Some(start) = path.start() else { continue };
        let (x, y) = at(start);
        out.move_to(x, y);
        for segment in &path.segments {
            match segment {
                Segment::Line(line) => {
                    let (x, y) = at(line.end);
                    out.line_to(x, y);
                }
                Segment::Arc(arc) => {
                    let count = (arc.sweep.abs() / FRAC_PI_4).ceil().max(1.0);
                    let reach = 4.0 / 3.0 * (arc.sweep.abs() / count / 4.0).tan() * arc.radius;
                    let mut from = 0.0;
                    while from < count {
                        let (a, b) = (from / count, (from + 1.0) / count);
                        let c = segment.point(a) + segment.tangent(a) * reach;
                        let d = segment.point(b) - segment.tangent(b) * reach;
                        let ((cx, cy), (dx, dy), (x, y)) = (at(c), at(d), at(segment.point(b)));
                        out.cubic_to(cx, cy, dx, dy, x, y);
                        from += 1.0;
                    }
                }
            }
        }
        if path.closed {
            out.close();
        }
    }
    out.finish()
}
