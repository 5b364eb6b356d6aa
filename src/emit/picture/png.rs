//! Pictures as PNG: drawn by tiny-skia, smoothed, three colours of 8 bits, with the scale of 1:1 in their header.

use std::f64::consts::FRAC_PI_4;

use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, PixmapMut, Stroke, StrokeDash, Transform,
};

use crate::emit::picture::png_file::png_file;
use crate::emit::picture::typeface::trace;
use crate::emit::picture::{Colour, Mark, Pen, Picture, Text};
use geom::{Arc, Path, Point, Segment};
use program::number::single;

impl Picture {
    /// The picture as a PNG with this number of pixels along its longer side; `None` if it has no extent.
    pub(in crate::emit) fn png(&self, longer: f64) -> Option<Vec<u8>> {
        let scale = longer / self.window.width().max(self.window.height());
        let mut pixels =
            Pixmap::new(count(self.window.width() * scale), count(self.window.height() * scale))?;
        pixels.fill(tiny_skia::Color::WHITE);
        let origin = Point::new(self.window.min.x, self.window.max.y);
        let mut canvas = Canvas { pixels: pixels.as_mut(), origin, scale };
        for mark in self.groups.iter().flat_map(|group| &group.marks) {
            match mark {
                Mark::Area { paths, ink } => canvas.area(paths, *ink),
                Mark::Line { path, pen } => canvas.line(path, *pen),
                Mark::Text(text) => canvas.text(text),
            }
        }
        encoded(&pixels, scale)
    }
}

/// The pixels that are drawn on. Coordinates become pixels before they become singles, so that no large one loses its fraction.
struct Canvas<'a> {
    pixels: PixmapMut<'a>,
    /// The point at the upper left.
    origin: Point,
    /// Pixels a mm.
    scale: f64,
}

impl Canvas<'_> {
    fn area(&mut self, paths: &[Path], ink: Colour) {
        let Some(path) = self.outline(paths) else { return };
        self.pixels.fill_path(&path, &paint(ink), FillRule::EvenOdd, Transform::identity(), None);
    }

    fn line(&mut self, path: &Path, pen: Pen) {
        let Some(path) = self.outline(std::slice::from_ref(path)) else { return };
        let length = |mm: f64| single(mm * self.scale);
        let stroke = Stroke {
            width: length(pen.width),
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            dash: pen.dash.and_then(|dash| StrokeDash::new(dash.map(length).to_vec(), 0.0)),
            ..Stroke::default()
        };
        self.pixels.stroke_path(&path, &paint(pen.ink), &stroke, Transform::identity(), None);
    }

    fn text(&mut self, text: &Text) {
        let start = self.pixel(text.start(text.width()));
        let Some(path) = trace(&text.content, start, text.size * self.scale).finish() else { return };
        self.pixels.fill_path(&path, &paint(text.ink), FillRule::Winding, Transform::identity(), None);
    }

    /// A point in pixels, Y down.
    fn pixel(&self, p: Point) -> Point {
        Point::new((p.x - self.origin.x) * self.scale, (self.origin.y - p.y) * self.scale)
    }

    fn outline(&self, paths: &[Path]) -> Option<tiny_skia::Path> {
        let mut builder = PathBuilder::new();
        for path in paths {
            let Some(start) = path.start().map(|start| self.pixel(start)) else { continue };
            builder.move_to(single(start.x), single(start.y));
            for segment in &path.segments {
                match segment {
                    Segment::Line(line) => {
                        let end = self.pixel(line.end);
                        builder.line_to(single(end.x), single(end.y));
                    }
                    Segment::Arc(arc) => self.arc(arc, &mut builder),
                }
            }
            if path.closed {
                builder.close();
            }
        }
        builder.finish()
    }

    /// An arc as cubics of at most 45 degrees, which leave its circle by less than 1e-5 of the radius.
    fn arc(&self, arc: &Arc, builder: &mut PathBuilder) {
        let segment = Segment::Arc(*arc);
        let pieces = (arc.sweep.abs() / FRAC_PI_4).ceil().max(1.0);
        let reach = 4.0 / 3.0 * libm::tan(arc.sweep.abs() / pieces / 4.0) * arc.radius;
        for k in 0..count(pieces) {
            let (from, to) = (f64::from(k) / pieces, f64::from(k + 1) / pieces);
            let [a, b, end] = [
                segment.point(from) + segment.tangent(from) * reach,
                segment.point(to) - segment.tangent(to) * reach,
                segment.point(to),
            ]
            .map(|p| self.pixel(p));
            builder.cubic_to(
                single(a.x),
                single(a.y),
                single(b.x),
                single(b.y),
                single(end.x),
                single(end.y),
            );
        }
    }
}

fn encoded(pixels: &Pixmap, scale: f64) -> Option<Vec<u8>> {
    // All pixels are opaque, so premultiplied colours are the plain ones.
    let colors = pixels.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]);
    let colors: Vec<u8> = colors.collect();
    png_file([pixels.width(), pixels.height()], &colors, count(1000.0 * scale))
}

fn paint(Colour(red, green, blue): Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, 0xff);
    paint
}

/// The nearest whole number, at least 1.
fn count(x: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a saturating cast of at least 1"
    )]
    let count = x.round().max(1.0) as u32;
    count
}
