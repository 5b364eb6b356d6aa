//! Windows: where the coating reaches the fabric, one at every reentrant corner.
//!
//! A window is the flat tube around a corner with both bands and the hole-side flap, cut off on both sides by a normal to
//! the **gripping edge** (the tube's edge that touches the object) at the arc length `extent` from the corner's
//! **apex**, the point where that edge is nearest to the axis. In the frame of corner 1, with the annulus's
//! centre P as the origin, `u(a)` the direction towards the axis turned by `a`, and `t(a)` its derivative:
//!
//! ```text
//!    cut: u(a) rho + t(a) c    a = angle of the cut, at most h = (pi - phi_e)/2;  c = its distance along the arm
//!    hole side: radius R_e + W + delta_h around P, then straight along t(h)
//!    outside:   radius q = R_e - delta_o around P, then straight; a vertex where q < 0
//! ```
//!
//! Creep moves every one of these inwards by itself: delta_h and delta_o shrink, and so does c.

use std::f64::consts::PI;

use crate::{Refusal, RefusalCode, Star};
use geom::{Arc, Isometry, Line, Path, Point, Segment, Vec2};
use spec::units::{Readable, hundredths_down};
use spec::{Mask, Seal, key};

/// Width of plate left between neighbouring windows, mm, where there is room for it: a strip of a 2 mm
/// plate that is narrower breaks when it is peeled off. At worst half of the plate between two apices stays.
const BRIDGE: f64 = 4.0;

/// Reach of one star's windows, mm along the gripping edge from a corner's apex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// End of the hinge's arc.
    pub(super) hinge: f64,
    /// As far as a window may reach.
    pub(super) most: f64,
}

/// The geometry from which the windows of one star are made.
#[derive(Clone, Copy)]
pub(super) struct Zone<'a> {
    star: &'a Star,
    /// From the gripping edge to the window's edge on the hole side.
    delta_h: f64,
    /// From the tube's outer edge to the window's edge outside.
    delta_o: f64,
    creep: f64,
}

/// The end of a window on one side: a line across the tube.
struct WindowCut {
    /// The point where it leaves the tube outside, or meets its mirror image.
    inner: Point,
    /// Whether `inner` is where it meets its mirror image.
    meets: bool,
    /// The point where it meets the hole-side flap's edge.
    outer: Point,
    /// Angles at which the round edges around P end: outside and at the hole.
    angles: [f64; 2],
}

impl<'a> Zone<'a> {
    pub(super) fn new(star: &'a Star, seal: &Seal, mask: &Mask) -> Self {
        let (delta_h, delta_o) = (seal.band.0 + seal.hole_allowance.0, seal.band.0);
        Self { star, delta_h, delta_o, creep: 0.0 }.crept(mask.creep.0)
    }

    /// This zone with `growth` more creep.
    fn crept(self, growth: f64) -> Self {
        Self {
            delta_h: self.delta_h - growth,
            delta_o: self.delta_o - growth,
            creep: self.creep + growth,
            ..self
        }
    }

    /// Greatest reach of the windows before the plate between them is too narrow or the arms end.
    ///
    /// The edge of the hole-side flap comes ever nearer to the tip's ray, the mirror line between two windows.
    pub(super) fn reach(&self) -> Reach {
        let star = self.star;
        let (alpha, h, grip) = (star.half_sector(), self.half(), star.r_e + star.w);
        let flap = grip + self.delta_h + self.creep;
        let bridge = BRIDGE.min((star.d_p - flap) * libm::sin(alpha));
        let room = star.d_p * libm::sin(alpha) - bridge / 2.0;
        let hinge = Self::hinge(star);
        let longest = if room < flap * libm::sin(h + alpha) {
            grip * (libm::asin(room / flap) - alpha)
        } else {
            let x = (room - flap * libm::sin(h + alpha)) / libm::sin(star.phi_i / 2.0);
            hinge + x.min(star.l)
        };
        Reach { hinge, most: longest }
    }

    /// From a corner's apex to the end of its hinge, along the gripping edge, mm.
    pub(super) fn hinge(star: &Star) -> f64 {
        (star.r_e + star.w) * (PI - star.phi_e) / 2.0
    }

    fn half(&self) -> f64 {
        (PI - self.star.phi_e) / 2.0
    }

    /// The window of corner 1, closed and counterclockwise, for cuts at `extent`.
    ///
    /// # Errors
    /// If creep leaves nothing of it.
    pub(super) fn window(&self, extent: f64) -> Result<Path, Refusal> {
        let hole = self.star.r_e + self.star.w + self.delta_h;
        let cut = self.cut(extent, hole).ok_or_else(|| self.nothing_left(extent))?;
        let round = self.star.r_e - self.delta_o;
        let mut side: Vec<Segment> = Vec::new();
        let outside_end = self.point(cut.angles[0], round.max(0.0), 0.0);
        if !cut.meets && round <= 0.0 {
            let vertex = Point::new(self.star.d_p - round / libm::cos(self.half()), 0.0);
            push(&mut side, vertex, cut.inner);
        } else if !cut.meets {
            push(&mut side, outside_end, cut.inner);
        }
        push(&mut side, cut.inner, cut.outer);
        push(&mut side, cut.outer, self.point(cut.angles[1], hole, 0.0));
        let center = Point::new(self.star.d_p, 0.0);
        let mirror = Isometry::mirror();
        let back: Vec<Segment> = side.iter().rev().map(|s| mirror.segment(&s.reversed())).collect();
        let mut segments = side;
        segments.push(Arc::new(center, hole, PI - cut.angles[1], 2.0 * cut.angles[1]).into());
        segments.extend(back);
        if !cut.meets && round > 0.0 {
            segments.push(Arc::new(center, round, PI + cut.angles[0], -2.0 * cut.angles[0]).into());
        }
        Ok(Path::closed(segments))
    }

    /// The point at radius `rho` in direction `a` from P, moved by `c` along the arm.
    fn point(&self, a: f64, rho: f64, c: f64) -> Point {
        let (sin, cos) = libm::sincos(a);
        Point::new(self.star.d_p, 0.0) + Vec2::new(-cos, sin) * rho + Vec2::new(sin, cos) * c
    }

    fn cut(&self, extent: f64, hole: f64) -> Option<WindowCut> {
        let (h, grip) = (self.half(), self.star.r_e + self.star.w);
        let (a, x) = if extent < grip * h { (extent / grip, 0.0) } else { (h, extent - grip * h) };
        let c = x - self.creep;
        let straight = a == h && c >= 0.0;
        let (top, hole_angle) = on_circle(hole, a, c, straight)?;
        // The crossing of the cut with the corner's ray.
        let axis = -c / libm::tan(a);
        let round = self.star.r_e - self.delta_o;
        let outer =
            if round > 0.0 { on_circle(round, a, c, straight) } else { straight.then_some((round, h)) };
        let outer = outer.filter(|(rho, _)| *rho > axis);
        let bottom = outer.map_or(axis, |(rho, _)| rho);
        if hole_angle <= 0.0 || bottom >= top {
            return None;
        }
        let inner = match outer {
            Some(_) => self.point(a, bottom, c),
            None => Point::new(self.point(a, axis, c).x, 0.0),
        };
        let angles = [outer.map_or(0.0, |(_, angle)| angle), hole_angle];
        Some(WindowCut { inner, meets: outer.is_none(), outer: self.point(a, top, c), angles })
    }

    fn nothing_left(&self, extent: f64) -> Refusal {
        let largest = Readable(hundredths_down(self.most_creep(extent)));
        let room = self.star.w + self.delta_h + self.delta_o + 2.0 * self.creep;
        let [creep, deep, long] = [self.creep, room, extent].map(Readable);
        let fault = format!(
            "a creep of {creep} mm leaves nothing of a window {deep} mm deep and {long} mm long on each side"
        );
        let remedy = format!("creep must be at most {largest} mm");
        Refusal::new(key::mask::CREEP, RefusalCode::NoWindow, fault, remedy)
    }

    /// The largest creep that leaves something of a window with cuts at `extent`, where this one leaves nothing.
    fn most_creep(&self, extent: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.creep);
        // Halved until the ends differ by rounding: a refusal may take its time.
        for _ in 0..60 {
            let creep = 0.5 * (low + high);
            let zone = self.crept(creep - self.creep);
            let hole = self.star.r_e + self.star.w + zone.delta_h;
            if zone.cut(extent, hole).is_some() { low = creep } else { high = creep }
        }
        low
    }
}

/// Appends the line from `a` to `b`, unless it is a point to rounding.
fn push(segments: &mut Vec<Segment>, a: Point, b: Point) {
    if a.distance(b) > 1e-9 {
        segments.push(Line::new(a, b).into());
    }
}

/// The crossing of the cut at angle `a`, moved by `c`, with the circle of `radius` around P, as its radius and angle; straight on beyond the
/// hinge.
fn on_circle(radius: f64, a: f64, c: f64, straight: bool) -> Option<(f64, f64)> {
    if straight {
        return Some((radius, a));
    }
    let square = radius * radius - c * c;
    (square >= 0.0).then(|| (square.sqrt(), a + libm::asin(c / radius)))
}
