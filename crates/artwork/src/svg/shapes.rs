//! Basic shapes as chains of pieces, in user units.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use geom::{Point, Vec2};
use roxmltree::Node;
use svgtypes::PointsParser;

use super::path_data;
use super::viewport::Viewport;
use crate::collector::CurveChain;
use crate::piece::Piece;

/// The tags of shapes.
pub(super) const TAGS: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// The chains of a shape; empty if SVG shows nothing for it.
pub(super) fn chains(node: Node<'_, '_>, viewport: Viewport) -> Result<Vec<CurveChain>, String> {
    let shape = BasicShape { node, viewport };
    match node.tag_name().name() {
        "path" => path_data::chains(node.attribute("d").unwrap_or_default()),
        "rect" => shape.rect(),
        "circle" | "ellipse" => shape.ellipse(),
        "line" => shape.line(),
        tag => shape.points(tag == "polygon"),
    }
}

struct BasicShape<'a, 'd> {
    node: Node<'a, 'd>,
    viewport: Viewport,
}

impl BasicShape<'_, '_> {
    /// A length along X (0), along Y (1) or of a radius (2); `None` if it is missing or "auto".
    fn length(&self, name: &str, axis: usize) -> Result<Option<f64>, String> {
        let value = self.node.attribute(name).filter(|value| value.trim() != "auto");
        value.map(|value| self.viewport.length(name, value, axis)).transpose()
    }

    fn size(&self, name: &str, axis: usize) -> Result<Option<f64>, String> {
        let length = self.length(name, axis)?;
        if length.is_some_and(|length| length < 0.0) {
            return Err(format!("Its {name} is negative."));
        }
        Ok(length)
    }

    /// The radii along X and Y; the other one in place of one that is missing.
    fn radii(&self) -> Result<[Option<f64>; 2], String> {
        let [rx, ry] = [self.size("rx", 0)?, self.size("ry", 1)?];
        Ok([rx.or(ry), ry.or(rx)])
    }

    fn point(&self, x: &str, y: &str) -> Result<Point, String> {
        Ok(Point::new(self.length(x, 0)?.unwrap_or(0.0), self.length(y, 1)?.unwrap_or(0.0)))
    }

    fn line(&self) -> Result<Vec<CurveChain>, String> {
        let (a, b) = (self.point("x1", "y1")?, self.point("x2", "y2")?);
        Ok(vec![CurveChain::single(Piece::Line(a, b), a)])
    }

    fn points(&self, closed: bool) -> Result<Vec<CurveChain>, String> {
        let text = self.node.attribute("points").unwrap_or_default();
        let points: Vec<Point> = PointsParser::from(text).map(|(x, y)| Point::new(x, y)).collect();
        // The parser ends at a fault without telling; so the numbers are counted.
        let count =
            svgtypes::NumberListParser::from(text).try_fold(0, |count, number| number.map(|_| count + 1));
        if count != Ok(2 * points.len()) {
            return Err("Its points are not pairs of numbers.".into());
        }
        let Some(&start) = points.first() else { return Ok(Vec::new()) };
        let pieces = points.windows(2).map(|pair| Piece::Line(pair[0], pair[1])).collect();
        Ok(vec![CurveChain { pieces, closed, start }])
    }

    fn ellipse(&self) -> Result<Vec<CurveChain>, String> {
        let center = self.point("cx", "cy")?;
        let is_circle = self.node.tag_name().name() == "circle";
        let [rx, ry] = if is_circle { [self.size("r", 2)?; 2] } else { self.radii()? };
        let (Some(rx), Some(ry)) = (rx, ry) else { return Ok(Vec::new()) };
        // A circle without a radius is read as a point.
        if (rx == 0.0) != (ry == 0.0) {
            return Ok(Vec::new());
        }
        let piece = Piece::ellipse(center, [Vec2::new(rx, 0.0), Vec2::new(0.0, ry)], 0.0, TAU);
        Ok(vec![CurveChain { pieces: vec![piece], closed: true, start: center }])
    }

    /// A rectangle from its left upper side on, in the order of SVG 2; corners are quarters of ellipses.
    fn rect(&self) -> Result<Vec<CurveChain>, String> {
        let origin = self.point("x", "y")?;
        let (w, h) = (self.size("width", 0)?.unwrap_or(0.0), self.size("height", 1)?.unwrap_or(0.0));
        if w == 0.0 || h == 0.0 {
            return Ok(Vec::new());
        }
        let [rx, ry] = self.radii()?;
        let (rx, ry) = (rx.unwrap_or(0.0).min(w / 2.0), ry.unwrap_or(0.0).min(h / 2.0));
        let (rx, ry) = if rx == 0.0 || ry == 0.0 { (0.0, 0.0) } else { (rx, ry) };
        let (u, v) = (Vec2::new(rx, 0.0), Vec2::new(0.0, ry));
        let mut pieces = Vec::with_capacity(8);
        // Each side, then the corner behind it: its centre and its first angle.
        let sides = [
            ([[rx, 0.0], [w - rx, 0.0], [w - rx, ry]], -FRAC_PI_2),
            ([[w, ry], [w, h - ry], [w - rx, h - ry]], 0.0),
            ([[w - rx, h], [rx, h], [rx, h - ry]], FRAC_PI_2),
            ([[0.0, h - ry], [0.0, ry], [rx, ry]], PI),
        ];
        for (places, first_angle) in sides {
            let [start, end, center] = places.map(|[x, y]| origin + Vec2::new(x, y));
            pieces.push(Piece::Line(start, end));
            if rx > 0.0 {
                pieces.push(Piece::ellipse(center, [u, v], first_angle, FRAC_PI_2));
            }
        }
        Ok(vec![CurveChain { pieces, closed: true, start: origin + Vec2::new(rx, 0.0) }])
    }
}
