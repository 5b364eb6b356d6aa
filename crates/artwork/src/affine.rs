//! Affine maps of the plane.

use geom::{Point, Vec2};

/// The map p -> (a x + c y + e, b x + d y + f), named as in SVG.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    /// Image of the unit vector along X.
    pub(crate) x: Vec2,
    /// Image of the unit vector along Y.
    pub(crate) y: Vec2,
    /// Image of the origin.
    pub(crate) origin: Point,
}

impl Affine {
    /// The map that moves nothing.
    pub(crate) const IDENTITY: Self = Self::new([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    /// The map with the six numbers of an SVG matrix.
    pub(crate) const fn new([a, b, c, d, e, f]: [f64; 6]) -> Self {
        Self { x: Vec2::new(a, b), y: Vec2::new(c, d), origin: Point::new(e, f) }
    }

    /// A translation.
    pub(crate) const fn translate(x: f64, y: f64) -> Self {
        Self::new([1.0, 0.0, 0.0, 1.0, x, y])
    }

    /// Factors along X and Y.
    pub(crate) const fn scale(x: f64, y: f64) -> Self {
        Self::new([x, 0.0, 0.0, y, 0.0, 0.0])
    }

    /// A rotation about the origin by degrees; quarter turns are exact.
    pub(crate) fn rotate(degrees: f64) -> Self {
        let (sin, cos) = sin_cos_degrees(degrees);
        Self::new([cos, sin, -sin, cos, 0.0, 0.0])
    }

    /// The image of a point.
    pub(crate) fn point(&self, p: Point) -> Point {
        self.origin + self.vector(Vec2::new(p.x, p.y))
    }

    /// The image of a displacement.
    pub(crate) fn vector(&self, v: Vec2) -> Vec2 {
        self.x * v.x + self.y * v.y
    }

    /// This map of the images under `inner`.
    pub(crate) fn following(&self, inner: &Self) -> Self {
        Self { x: self.vector(inner.x), y: self.vector(inner.y), origin: self.point(inner.origin) }
    }
}

/// Sine and cosine of an angle in degrees; exact for multiples of 90.
pub(crate) fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        angle => libm::sincos(angle.to_radians()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inner_map_comes_first() {
        let map =
            Affine::translate(10.0, 0.0).following(&Affine::rotate(90.0)).following(&Affine::scale(2.0, 3.0));
        assert_eq!(map.point(Point::new(1.0, 1.0)), Point::new(7.0, 2.0));
        assert_eq!(Affine::IDENTITY.following(&map), map);
    }
}
