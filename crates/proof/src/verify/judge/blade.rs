//! The blade of a drag knife: where its tip goes while its axis makes the moves of a program.
//!
//! The tip trails the axis at a constant distance d, as a wheel trails a castor: with the blade's direction a and the direction b of the
//! axis's way, `da/ds = sin(b - a) / d`. It is integrated by the rule of Runge and Kutta of fourth order, in steps of a twentieth of d.

use crate::verify::Findings;
use crate::verify::judge::rules::{ContactCount, IronRules, Phase};
use crate::verify::judge::{Judge, seams::Sealed};
use crate::verify::read::gcode::{Move, Point3};
use geom::{Line, Point, Segment, Vec2};

/// Steps to the length of the offset.
const FINENESS: f64 = 20.0;
/// Most steps of one move: a way of metres.
const MOST_STEPS: f64 = 1e6;
/// Difference of directions that does not turn the blade, rad.
const ALIGNED: f64 = 1e-9;

/// The judge of cuts for a drag knife: shows its inner judge the moves of the tip in the place of those of the axis.
pub(super) struct BladeJudge<'a> {
    inner: Sealed<'a>,
    rules: &'a IronRules<'a>,
    count: ContactCount,
    offset: f64,
    /// Places where the blade comes down, of the cuts that are still to come.
    starts: std::vec::IntoIter<Point>,
    /// Direction from the tip to the axis in the current contact, rad.
    direction: Option<f64>,
}

impl<'a> BladeJudge<'a> {
    /// The judge of cuts that begin with the tip at `starts`, `offset` mm behind the axis.
    pub(super) fn new(inner: Sealed<'a>, rules: &'a IronRules<'a>, offset: f64, starts: Vec<Point>) -> Self {
        let (count, starts) = (ContactCount::default(), starts.into_iter());
        Self { inner, rules, count, offset, starts, direction: None }
    }

    /// The direction of the blade where a contact begins with the axis at `axis`: that of a tip at the start of the cut, if it is there.
    fn first_direction(&mut self, axis: Point) -> f64 {
        self.starts.next().map_or(0.0, |start| (axis - start).angle())
    }

    /// Shows the moves of the tip along `path` of the axis.
    fn follow(&mut self, step: &Move, path: &Segment, mut direction: f64, findings: &mut Findings) -> f64 {
        let is_straight = matches!(path, Segment::Line(_));
        let is_aligned = libm::sin(path.tangent(0.0).angle() - direction).abs() < ALIGNED;
        let length = path.length();
        let steps = (FINENESS * length / self.offset).ceil().clamp(1.0, MOST_STEPS);
        let steps = if is_straight && is_aligned { 1.0 } else { steps };
        let mut tip = path.start() - Vec2::unit(direction) * self.offset;
        let mut i = 0.0;
        while i < steps {
            let [t, end] = [i / steps, (i + 1.0) / steps];
            direction = turned(path, [t, end], direction, length / steps / self.offset);
            let next = path.point(end) - Vec2::unit(direction) * self.offset;
            let heights = [t, end].map(|fraction| step.from.z + (step.to.z - step.from.z) * fraction);
            let moved = (tip.distance(next) > 1e-9).then(|| Line::new(tip, next).into());
            let [from, to] =
                [(tip, heights[0]), (next, heights[1])].map(|(place, z)| Point3::new(place.x, place.y, z));
            self.inner.step(&Move { from, to, path: moved, ..*step }, findings);
            (tip, i) = (next, i + 1.0);
        }
        direction
    }
}

/// The direction of a blade that had `direction`, after the part of `path` between two fractions, which is `turns` offsets long.
fn turned(path: &Segment, [start, end]: [f64; 2], direction: f64, turns: f64) -> f64 {
    let middle = 0.5 * (start + end);
    let first = turns * slip(path, start, direction);
    let second = turns * slip(path, middle, direction + 0.5 * first);
    let third = turns * slip(path, middle, direction + 0.5 * second);
    let fourth = turns * slip(path, end, direction + third);
    direction + (first + 2.0 * second + 2.0 * third + fourth) / 6.0
}

/// The sine of the angle from a blade of `direction` to `path` at the fraction `t` of it.
fn slip(path: &Segment, t: f64, direction: f64) -> f64 {
    libm::sin(path.tangent(t).angle() - direction)
}

impl Judge for BladeJudge<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        let (phase, _) = self.rules.follow(&mut self.count, step);
        match (&step.path, phase) {
            (Some(path), Phase::Down | Phase::Contact | Phase::Up) => {
                let previous = self.direction;
                let direction = previous.unwrap_or_else(|| self.first_direction(path.start()));
                self.direction = Some(self.follow(step, path, direction, findings));
            }
            (_, Phase::Clear) => {
                self.direction = None;
                self.inner.step(step, findings);
            }
            (None, _) => self.inner.step(step, findings),
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.inner.end(findings);
    }

    fn deviation(&self) -> f64 {
        self.inner.deviation()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::Arc;

    fn direction_after(path: &Segment, direction: f64, offset: f64) -> f64 {
        let steps = (FINENESS * path.length() / offset).ceil();
        let mut direction = direction;
        let mut i = 0.0;
        while i < steps {
            direction =
                turned(path, [i / steps, (i + 1.0) / steps], direction, path.length() / steps / offset);
            i += 1.0;
        }
        direction
    }

    /// Behind a straight way of length s the tangent of half the angle falls by exp(-s / d); about its own tip the blade turns with the axis;
    /// along a circle it stays asin(d / R) behind.
    #[test]
    fn a_blade_trails_as_a_castor() {
        let line: Segment = Line::new(Point::ORIGIN, Point::new(1.0, 0.0)).into();
        let exact = 2.0 * libm::atan(libm::tan(0.5) * libm::exp(-1.0 / 0.4));
        assert!((direction_after(&line, 1.0, 0.4) - exact).abs() < 1e-6);
        let swivel: Segment = Arc::new(Point::ORIGIN, 0.25, 0.3, 1.2).into();
        assert!((direction_after(&swivel, 0.3, 0.25) - 1.5).abs() < 1e-6);
        let circle: Segment = Arc::new(Point::ORIGIN, 2.0, 0.0, 1.0).into();
        let lag = libm::asin(0.5 / 2.0);
        let start = std::f64::consts::FRAC_PI_2 - lag;
        assert!((direction_after(&circle, start, 0.5) - (start + 1.0)).abs() < 1e-6);
    }
}
