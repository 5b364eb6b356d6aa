//! Circular arcs.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::{Point, Vec2};

/// A circular arc: it starts at `start_angle` and turns by `sweep`, counterclockwise if positive.
///
/// Valid: `radius > 0`, `|sweep| <= 2 pi`, all fields finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Centre of the circle.
    pub center: Point,
    /// Radius of the circle, > 0.
    pub radius: f64,
    /// Direction from the centre to the first point, rad.
    pub start_angle: f64,
    /// Signed turn from the first to the last point, rad.
    pub sweep: f64,
}

impl Arc {
    /// The arc around `center` from `start_angle`, turning by `sweep` (rad).
    pub const fn new(center: Point, radius: f64, start_angle: f64, sweep: f64) -> Self {
        Self { center, radius, start_angle, sweep }
    }

    /// The point of the circle in direction `angle` from the centre.
    pub fn at_angle(&self, angle: f64) -> Point {
        self.center + Vec2::unit(angle) * self.radius
    }

    /// First point.
    pub fn start(&self) -> Point {
        self.at_angle(self.start_angle)
    }

    /// Last point.
    pub fn end(&self) -> Point {
        self.at_angle(self.end_angle())
    }

    /// Direction from the centre to the last point, rad (not reduced).
    pub fn end_angle(&self) -> f64 {
        self.start_angle + self.sweep
    }

    /// Length along the arc.
    pub fn length(&self) -> f64 {
        self.radius * self.sweep.abs()
    }

    /// Whether it turns counterclockwise.
    pub fn is_ccw(&self) -> bool {
        self.sweep > 0.0
    }

    /// Unit tangent, in the direction of travel, at fraction `t`.
    pub fn tangent(&self, t: f64) -> Vec2 {
        Vec2::unit(self.start_angle + t * self.sweep).perp() * self.sweep.signum()
    }

    /// Fraction in [0, 1] at which the arc points in direction `angle` from its centre, if it does.
    ///
    /// Directions within `slack` (rad) outside the ends count as the ends.
    pub fn fraction_of(&self, angle: f64, slack: f64) -> Option<f64> {
        if self.sweep == 0.0 {
            return None;
        }
        let turn = (angle - self.start_angle) * self.sweep.signum();
        let turn = turn.rem_euclid(TAU);
        let span = self.sweep.abs();
        if turn <= span {
            Some(turn / span)
        } else if turn - span <= slack {
            Some(1.0)
        } else if TAU - turn <= slack {
            Some(0.0)
        } else {
            None
        }
    }

    /// Fraction in [0, 1] of the point nearest to `p` (the start if `p` is the centre).
    pub fn nearest_fraction(&self, p: Point) -> f64 {
        let v = p - self.center;
        if v == Vec2::default() {
            return 0.0;
        }
        self.fraction_of(v.angle(), 0.0)
            .unwrap_or_else(|| if p.distance(self.start()) <= p.distance(self.end()) { 0.0 } else { 1.0 })
    }

    /// The part between the fractions `t0 <= t1`.
    pub fn part(&self, t0: f64, t1: f64) -> Self {
        Self { start_angle: self.start_angle + t0 * self.sweep, sweep: (t1 - t0) * self.sweep, ..*self }
    }

    /// The arc through `start` and `end` with the given bulge, tan(sweep / 4); `None` if it is straight or a point.
    pub fn from_bulge(start: Point, end: Point, bulge: f64) -> Option<Self> {
        let chord = end - start;
        let c = chord.length();
        if bulge == 0.0 || c == 0.0 {
            return None;
        }
        let sweep = 4.0 * libm::atan(bulge);
        let radius = c * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        // Signed distance from the chord's middle to the centre, positive to the left of the chord.
        let apothem = c * (1.0 - bulge * bulge) / (4.0 * bulge);
        let center = start.midpoint(end) + chord.perp() * (apothem / c);
        Some(Self { center, radius, start_angle: (start - center).angle(), sweep })
    }

    /// tan(sweep / 4), the measure of an arc between two given points that DXF calls bulge.
    pub fn bulge(&self) -> f64 {
        libm::tan(self.sweep / 4.0)
    }

    /// The points at which its circle is extreme in X or Y, as far as they lie on the arc.
    pub(super) fn extreme_points(&self) -> impl Iterator<Item = Point> + '_ {
        let r = self.radius;
        [(0.0, r, 0.0), (FRAC_PI_2, 0.0, r), (PI, -r, 0.0), (-FRAC_PI_2, 0.0, -r)]
            .into_iter()
            .filter(|(angle, _, _)| self.fraction_of(*angle, 0.0).is_some())
            .map(|(_, x, y)| self.center + Vec2::new(x, y))
    }
}
