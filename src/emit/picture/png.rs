//! Pictures as PNG: rasterised by zeno, smoothed, three colours of 8 bits, with the scale of 1:1 in their header.

use std::f64::consts::FRAC_PI_4;
use std::ops::Range;

use zeno::{Cap, Command, Fill, Join, Mask, Scratch, Stroke, Style, Vector};

use crate::emit::picture::png_file::png_file;
use crate::emit::picture::typeface::trace;
use crate::emit::picture::{Colour, Mark, Pen, Picture, Text};
use geom::{Arc, Path, Point, Segment};
use program::number::single;

/// A colour of 8 bits at its full strength.
const WHITE: u8 = 0xff;
/// Pixels that are passed over together where nothing covers them: as many as have their coverage in one number.
const GROUP: usize = 16;

impl Picture {
    /// The picture as a PNG with this number of pixels along its longer side; `None` if it has no extent.
    pub(in crate::emit) fn png(&self, longer: f64) -> Option<Vec<u8>> {
        let scale = longer / self.window.width().max(self.window.height());
        if !(scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let size = [count(self.window.width() * scale), count(self.window.height() * scale)];
        let mut canvas = Canvas {
            size,
            colors: vec![WHITE; 3 * size[0] as usize * size[1] as usize],
            origin: Point::new(self.window.min.x, self.window.max.y),
            scale,
            coverage: Vec::new(),
            scratch: Scratch::new(),
        };
        for mark in self.groups.iter().flat_map(|group| &group.marks) {
            match mark {
                Mark::Area { paths, ink } => canvas.area(paths, *ink),
                Mark::Line { path, pen } => canvas.line(path, *pen),
                Mark::Text(text) => canvas.text(text),
            }
        }
        png_file(size, &canvas.colors, count(1000.0 * scale))
    }
}

/// The pixels that are drawn on. Coordinates become pixels before they become singles, so that no large one loses its fraction.
struct Canvas {
    /// Columns and rows.
    size: [u32; 2],
    /// Red, green and blue of the pixels, row by row from the top.
    colors: Vec<u8>,
    /// The point at the upper left.
    origin: Point,
    /// Pixels a mm.
    scale: f64,
    /// How far a mark covers the pixels of its box, 0 to 255. It is kept for the next mark, as is `scratch`.
    coverage: Vec<u8>,
    scratch: Scratch,
}

impl Canvas {
    fn area(&mut self, paths: &[Path], ink: Colour) {
        let outline = self.outline(paths);
        self.paint(&outline, Fill::EvenOdd.into(), 0.0, ink);
    }

    fn line(&mut self, path: &Path, pen: Pen) {
        let outline = self.outline(std::slice::from_ref(path));
        let width = single(pen.width * self.scale);
        let dashes = pen.dash.map(|dash| dash.map(|mm| single(mm * self.scale)));
        let stroke = Stroke {
            width,
            join: Join::Round,
            start_cap: Cap::Round,
            end_cap: Cap::Round,
            dashes: dashes.as_ref().map_or(&[], |dashes| dashes),
            ..Stroke::default()
        };
        self.paint(&outline, stroke.into(), width, pen.ink);
    }

    fn text(&mut self, text: &Text) {
        let start = self.pixel(text.start(text.width()));
        let outline = trace(&text.content, start, text.size * self.scale);
        self.paint(&outline, Fill::NonZero.into(), 0.0, text.ink);
    }

    /// Paints an outline that is filled, or drawn by a pen of this `width` in pixels. Its box, as far as it is on the canvas, is rasterised.
    fn paint(&mut self, outline: &[Command], style: Style<'_>, width: f32, Colour(red, green, blue): Colour) {
        let bounds = self.scratch.bounds(outline, Fill::NonZero, None);
        let [columns, rows] = [
            pixels(bounds.min.x - width, bounds.max.x + width, self.size[0]),
            pixels(bounds.min.y - width, bounds.max.y + width, self.size[1]),
        ];
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let pitch = columns.len().next_multiple_of(GROUP);
        self.coverage.clear();
        self.coverage.resize(pitch * rows.len(), 0);
        let corner = [columns.start, rows.start].map(|pixel| single(f64::from(pixel)));
        let _placement = Mask::with_scratch(outline, &mut self.scratch)
            .style(style)
            .size(columns.end - columns.start, rows.end - rows.start)
            .offset(corner.map(|pixel| -pixel))
            .render_into(&mut self.coverage, Some(pitch));
        for (row, coverage) in rows.zip(self.coverage.chunks_exact(pitch)) {
            let start = 3 * (row * self.size[0] + columns.start) as usize;
            blend(&mut self.colors[start..start + 3 * columns.len()], coverage, [red, green, blue]);
        }
    }

    /// A point in pixels of single precision.
    fn place(&self, p: Point) -> Vector {
        let p = self.pixel(p);
        Vector::new(single(p.x), single(p.y))
    }

    /// A point in pixels, Y down.
    fn pixel(&self, p: Point) -> Point {
        Point::new((p.x - self.origin.x) * self.scale, (self.origin.y - p.y) * self.scale)
    }

    fn outline(&self, paths: &[Path]) -> Vec<Command> {
        let mut outline = Vec::new();
        for path in paths {
            let Some(start) = path.start() else { continue };
            outline.push(Command::MoveTo(self.place(start)));
            for segment in &path.segments {
                match segment {
                    Segment::Line(line) => outline.push(Command::LineTo(self.place(line.end))),
                    Segment::Arc(arc) => self.arc(arc, &mut outline),
                }
            }
            if path.closed {
                outline.push(Command::Close);
            }
        }
        outline
    }

    /// An arc as cubics of at most 45 degrees, which leave its circle by less than 1e-5 of the radius.
    fn arc(&self, arc: &Arc, outline: &mut Vec<Command>) {
        let segment = Segment::Arc(*arc);
        let pieces = (arc.sweep.abs() / FRAC_PI_4).ceil().max(1.0);
        let reach = 4.0 / 3.0 * libm::tan(arc.sweep.abs() / pieces / 4.0) * arc.radius;
        for k in 0..count(pieces) {
            let (from, to) = (f64::from(k) / pieces, f64::from(k + 1) / pieces);
            outline.push(Command::CurveTo(
                self.place(segment.point(from) + segment.tangent(from) * reach),
                self.place(segment.point(to) - segment.tangent(to) * reach),
                self.place(segment.point(to)),
            ));
        }
    }
}

/// Colours the pixels of a row by how far they are covered. Most of a large box is not: such pixels are passed over in groups.
fn blend(pixels: &mut [u8], coverage: &[u8], ink: [u8; 3]) {
    let (groups, _) = coverage.as_chunks::<GROUP>();
    for (pixels, group) in pixels.chunks_mut(3 * GROUP).zip(groups) {
        if u128::from_ne_bytes(*group) == 0 {
            continue;
        }
        for (pixel, part) in pixels.chunks_exact_mut(3).zip(group) {
            match *part {
                0 => {}
                u8::MAX => pixel.copy_from_slice(&ink),
                part => pixel.iter_mut().zip(ink).for_each(|(color, ink)| *color = mixed(*color, ink, part)),
            }
        }
    }
}

/// Two colours of 8 bits, mixed by the part of the second, 0 to 255, and rounded.
fn mixed(first: u8, second: u8, part: u8) -> u8 {
    let sum = u32::from(first) * u32::from(255 - part) + u32::from(second) * u32::from(part);
    u8::try_from((sum + 127) / 255).unwrap_or(u8::MAX)
}

/// The pixels of 0 to `count` that an extent touches.
fn pixels(from: f32, to: f32, count: u32) -> Range<u32> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturating casts, the second one of a rounded number"
    )]
    let [first, end] = [from.floor() as u32, to.ceil() as u32];
    first..end.min(count)
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
