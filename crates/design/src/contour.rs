//! Contours: curves at a constant distance from the tube's edge, trimmed where they meet themselves.
//!
//! A contour lies on one **side** of the tube, at a distance `delta` from that side's edge: 0 is the
//! edge itself, half a band the centre line of the band, band plus allowance the cut. On each side
//! every hinge of one kind is **convex** (its arc grows with delta: the corners seen from the hole, the
//! tips seen from outside) and every hinge of the other kind is **concave** (its arc shrinks with delta
//! and, once used up, becomes a vertex that eats into the arms).
//!
//! With `q = R - delta` the remaining concave radius and `m` the smallest allowed radius (0: a vertex), the arc has radius
//! `max(q, m)`; its centre moves along the hinge's ray by `(max(q, m) - q) / sin(phi/2)` and each arm loses `(max(q, m) - q)
//! cot(phi/2)`. Where the arms have no length left, neighbouring convex arcs meet on the concave hinge's ray.

use std::f64::consts::PI;

use crate::Star;
use geom::{Arc, Line, Path, Point, Segment};

/// An edge of the tube: towards the hole in the star's middle, or outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The inner edge.
    Hole,
    /// The outer edge.
    Outside,
}

impl Side {
    /// The loop's name in files and reports.
    pub fn loop_name(self) -> &'static str {
        match self {
            Self::Hole => "inner",
            Self::Outside => "outer",
        }
    }
}

/// The part of the star to which a segment of a contour belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Arm j, 1 to 2n; arm 2k - 1 runs from corner k to tip k, arm 2k from tip k to corner k + 1.
    Arm(u32),
    /// Tip k.
    Tip(u32),
    /// Reentrant corner k.
    Corner(u32),
}

/// A closed contour, counterclockwise from the beginning of arm 1 (or of tip 1 where no arm is left).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// Segments of the contour with their parts of the star. Hinges that shrank to a vertex have none.
    pub parts: Vec<(Part, Segment)>,
    /// Remaining length of each arm; 0 if the contour has no straight parts.
    pub arm: f64,
}

/// One hinge as the contour passes it, in the frame of its ray.
#[derive(Clone, Copy)]
pub(super) struct ContourHinge {
    /// Distance of the arc's centre from the axis.
    pub(super) center: f64,
    /// Radius of the arc, 0 for a vertex.
    pub(super) radius: f64,
    /// Half the angle of the arc.
    pub(super) half: f64,
}

/// A contour by the part that repeats n times.
#[derive(Clone, Copy)]
pub(super) enum Trimmed {
    /// Hinges with arms between them.
    Arms {
        /// Each corner.
        corner: ContourHinge,
        /// Each tip.
        tip: ContourHinge,
        /// Length of each arm.
        arm: f64,
    },
    /// Only the corners' arcs, which meet on the tips' rays.
    Corners(ContourHinge),
    /// Only the tips' arcs, which meet on the corners' rays.
    Tips(ContourHinge),
}

impl Star {
    /// The contour on `side` at distance `delta >= 0`, its concave hinges at least `least_radius` round.
    ///
    /// `None` if nothing is left: the hole is closed.
    pub fn contour(&self, side: Side, delta: f64, least_radius: f64) -> Option<Contour> {
        let parts = match self.trimmed(side, delta, least_radius)? {
            Trimmed::Arms { corner, tip, arm } => return Some(self.with_arms(corner, tip, arm)),
            Trimmed::Corners(hinge) => (1..=self.n)
                .map(|k| k % self.n + 1)
                .map(|k| (Part::Corner(k), self.corner_arc(k, hinge).into()))
                .collect(),
            Trimmed::Tips(hinge) => {
                (1..=self.n).map(|k| (Part::Tip(k), self.tip_arc(k, hinge).into())).collect()
            }
        };
        Some(Contour { parts, arm: 0.0 })
    }

    /// The offset contour, trimmed but not yet drawn.
    pub(super) fn trimmed(&self, side: Side, delta: f64, least_radius: f64) -> Option<Trimmed> {
        // Signed radii before trimming; their sum is always W + R_i + R_e.
        let (corner_radius, tip_radius) = match side {
            Side::Hole => (self.r_e + self.w + delta, self.r_i - delta),
            Side::Outside => (self.r_e - delta, self.r_i + self.w + delta),
        };
        if side == Side::Hole && delta >= self.rho_0 {
            return None;
        }
        let mut corner =
            ContourHinge { center: self.d_p, radius: corner_radius, half: (PI - self.phi_e) / 2.0 };
        let mut tip = ContourHinge { center: self.d_t, radius: tip_radius, half: (PI - self.phi_i) / 2.0 };
        let (concave, phi, axis) = match side {
            Side::Hole => (&mut tip, self.phi_i, -1.0),
            Side::Outside => (&mut corner, self.phi_e, 1.0),
        };
        let growth = (least_radius - concave.radius).max(0.0);
        concave.radius += growth;
        concave.center += axis * growth / libm::sin(phi / 2.0);
        let arm = self.l - growth / libm::tan(phi / 2.0);
        // An arm as short as a rounding error does not count: the smallest real ones are 1e6 times longer.
        if arm > 1e-9 * self.l {
            return Some(Trimmed::Arms { corner, tip, arm });
        }
        let half = self.convex_arcs_meet(side, corner_radius, tip_radius)?;
        Some(match side {
            Side::Hole => Trimmed::Corners(ContourHinge { half, ..corner }),
            Side::Outside => Trimmed::Tips(ContourHinge { half, ..tip }),
        })
    }

    fn with_arms(&self, corner: ContourHinge, tip: ContourHinge, arm: f64) -> Contour {
        let mut parts = Vec::with_capacity(4 * self.n as usize);
        for k in 1..=self.n {
            let next = k % self.n + 1;
            let [corner_arc, next_corner_arc] = [k, next].map(|k| self.corner_arc(k, corner));
            let tip_arc = self.tip_arc(k, tip);
            parts.push((Part::Arm(2 * k - 1), Line::new(corner_arc.end(), tip_arc.start()).into()));
            if tip.radius > 0.0 {
                parts.push((Part::Tip(k), tip_arc.into()));
            }
            parts.push((Part::Arm(2 * k), Line::new(tip_arc.end(), next_corner_arc.start()).into()));
            if corner.radius > 0.0 {
                parts.push((Part::Corner(next), next_corner_arc.into()));
            }
        }
        Contour { parts, arm }
    }

    /// Half the angle of a convex arc that runs from one concave hinge's ray to the next.
    fn convex_arcs_meet(&self, side: Side, corner_radius: f64, tip_radius: f64) -> Option<f64> {
        let a = self.half_sector();
        // On the concave ray, at distance t from the axis, the circle of radius r around distance d on
        // the convex ray is met where t^2 - 2 t d cos a + d^2 = r^2: from the hole at the smaller root.
        let (d, r, sign) = match side {
            Side::Hole => (self.d_p, corner_radius, -1.0),
            Side::Outside => (self.d_t, tip_radius, 1.0),
        };
        let square = r * r - (d * libm::sin(a)).powi(2);
        let t = d * libm::cos(a) + sign * square.sqrt();
        // NaN where the circle does not reach the ray.
        if t.is_nan() || t <= 0.0 {
            return None;
        }
        let meeting = Point::polar(t, a) - Point::new(d, 0.0);
        Some(match side {
            Side::Hole => PI - meeting.angle(),
            Side::Outside => meeting.angle(),
        })
    }

    /// The arc of corner `k`, which turns clockwise; of radius 0 for a vertex.
    fn corner_arc(&self, k: u32, hinge: ContourHinge) -> Arc {
        let ray = self.corner_ray(k);
        Arc::new(Point::polar(hinge.center, ray), hinge.radius, ray + PI + hinge.half, -2.0 * hinge.half)
    }

    /// The arc of tip `k`, which turns counterclockwise; of radius 0 for a vertex.
    fn tip_arc(&self, k: u32, hinge: ContourHinge) -> Arc {
        let ray = self.tip_ray(k);
        Arc::new(Point::polar(hinge.center, ray), hinge.radius, ray - hinge.half, 2.0 * hinge.half)
    }
}

impl Trimmed {
    /// Area of one sector of angle 2 pi / n of the star of `turns` inside the contour, mm^2: the sum of half of x dy - y dx along it.
    pub(super) fn sector_area(&self, turns: &Turns) -> f64 {
        // An arc around a point at the distance c that turns by 2 h: r^2 h + c r sin h if it bulges outwards.
        match self {
            Self::Tips(tip) => swept_area(tip, 1.0, libm::sin(tip.half)),
            Self::Corners(corner) => swept_area(corner, -1.0, libm::sin(corner.half)),
            Self::Arms { corner, tip, .. } => {
                let Turns { corner: (sin_corner, cos_corner), tip: (sin_tip, cos_tip), sector: (sin, cos) } =
                    turns;
                // From the corner's end to the tip's start; the other arm is its mirror image.
                let from = Point::new(corner.center - corner.radius * cos_corner, corner.radius * sin_corner);
                let (along, across) = (tip.center + tip.radius * cos_tip, -tip.radius * sin_tip);
                let to = Point::new(along * cos - across * sin, along * sin + across * cos);
                swept_area(tip, 1.0, *sin_tip) + swept_area(corner, -1.0, *sin_corner) + from.x * to.y
                    - from.y * to.x
            }
        }
    }
}

fn swept_area(hinge: &ContourHinge, sign: f64, sin: f64) -> f64 {
    let ContourHinge { center, radius, half } = *hinge;
    sign * radius * radius * half + center * radius * sin
}

/// Sines and cosines of half the angles of a star: the same for all of its contours that have arms.
pub(super) struct Turns {
    /// Of a corner's arc.
    corner: (f64, f64),
    /// Of a tip's arc.
    tip: (f64, f64),
    /// Of a sector.
    sector: (f64, f64),
}

impl Turns {
    pub(super) fn new(star: &Star) -> Self {
        let [corner, tip] = [star.phi_e, star.phi_i].map(|phi| libm::sincos((PI - phi) / 2.0));
        Self { corner, tip, sector: libm::sincos(star.half_sector()) }
    }
}

impl Contour {
    /// The contour as a closed path.
    pub fn path(&self) -> Path {
        Path::closed(self.parts.iter().map(|(_, segment)| *segment).collect())
    }

    /// Arc length from the beginning to the middle of the first segment of `part`; `None` if it has none.
    pub fn middle_of(&self, part: Part) -> Option<f64> {
        let mut start = 0.0;
        for (p, segment) in &self.parts {
            if *p == part {
                return Some(start + segment.length() / 2.0);
            }
            start += segment.length();
        }
        None
    }
}
