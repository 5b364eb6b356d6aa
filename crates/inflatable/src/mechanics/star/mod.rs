//! The **star** as a mechanism: rigid arms of constant length between tips and reentrant corners.
//!
//! All corners move together, so the tip's angle `phi_i` is the only coordinate: the corner's is
//! `phi_e = phi_i + 2 pi / n`. With `T` the centre of a tip's inner arc, `P` that of a corner's, arms of length `l`
//! and tubes of width `w`, projecting T - P on the normal of the tip's ray gives
//!
//! ```text
//! (rho + w + r_e) sin(pi/n) = l sin(phi_i/2) + (w + r_i + r_e) cos(phi_i/2)
//! ```
//!
//! Flat: `w = W`, `r = R`, `rho = rho_0`; this fixes l, which is given here. Inflated: `w = W'`, 2 W / pi as a cylinder or the width of a
//! [`Correction`], and `r = R / lambda`, because a coiled hinge keeps the length of its inner arc.
//!
//! On `[0, pi - 2 pi / n)` rho is **concave** in phi_i: sin and cos of half the angle are, and so are the terms of the
//! coiled hinges, `R_i cos(phi/2) / (pi - phi)` and `R_e [cos(phi/2) - sin(pi/n)] / (pi - 2 pi/n - phi)`, which are
//! means of a falling cosine over an interval. So rho has one maximum, at which the arms lock:
//! no force on the corners opens the star any further.

pub mod bearing;
pub mod correction;
pub mod grasp;
pub mod residuals;
pub mod response;

pub use self::correction::Correction;

use crate::mechanics::hinge::Hinge;
use crate::numerics::{RootFault, bracketed_root};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The dimensions of a star as a mechanism; lengths in m, angles in rad. They must be those of a possible flat star: see each range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mechanism {
    /// Number of points n, 3 or more.
    pub points: u32,
    /// Length l of the straight arms, above 0.
    pub arm: f64,
    /// Flat tube width W, above 0.
    pub width: f64,
    /// Flat angle phi_i0 between the arms of a tip, above 0 and below `pi - 2 pi / n`.
    pub tip_angle: f64,
    /// Flat inner radius of curvature R_i of the tips, 0 or more.
    pub tip_radius: f64,
    /// Flat inner radius of curvature R_e of the corners, 0 or more.
    pub corner_radius: f64,
    /// Corrections of inflation beyond hinges and rigid arms.
    pub correction: Correction,
}

/// Radius and its derivatives by the tip's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radius {
    /// Inner radius rho, m.
    pub value: f64,
    /// drho/dphi_i, m per rad.
    pub slope: f64,
    /// d2rho/dphi_i2, m per rad^2.
    pub curvature: f64,
}

/// The widest opening of an inflated star.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widest {
    /// The tips' angle, rad.
    pub angle: f64,
    /// Inner radius, m.
    pub radius: f64,
}

/// Part of the way from its rest to the straight corner over which a star is followed: at the straight corner itself the
/// corner's terms are 0 / 0, and a thousandth before it their slope is still good to 1e-9.
const NEARLY_STRAIGHT: f64 = 0.999;
/// Angle of the widest opening, rad: the radius is flat there, so 1e-9 moves it by less than rounding.
const WIDEST_TOLERANCE: f64 = 1e-9;

impl Mechanism {
    /// `2 pi / n`: by how much a corner's angle exceeds the tip's.
    pub fn turn(&self) -> f64 {
        2.0 * PI / f64::from(self.points)
    }

    /// `sin(pi / n)`.
    pub fn sector_sine(&self) -> f64 {
        /// Sines for as many points as a spec may have, for designs in millions.
        #[expect(clippy::cast_precision_loss, reason = "a few points")]
        static KNOWN: LazyLock<[f64; 65]> =
            LazyLock::new(|| std::array::from_fn(|n| libm::sin(PI / n as f64)));
        let sine = usize::try_from(self.points).ok().and_then(|points| KNOWN.get(points));
        sine.copied().unwrap_or_else(|| libm::sin(0.5 * self.turn()))
    }

    /// The hinge at a tip.
    pub fn tip(&self) -> Hinge {
        let Self { width, tip_angle, tip_radius, .. } = *self;
        Hinge { r_star: tip_radius / width, width, rest_angle: tip_angle }
    }

    /// The hinge at a reentrant corner.
    pub fn corner(&self) -> Hinge {
        let Self { width, tip_angle, corner_radius, .. } = *self;
        Hinge { r_star: corner_radius / width, width, rest_angle: tip_angle + self.turn() }
    }

    /// Inflated width W' of the arms, m; that of cylinders is 2 W / pi.
    pub fn inflated_width(&self) -> f64 {
        self.correction.width * self.width
    }

    /// Inner radius rho of the inflated star at the tip angle `phi` (rad, below `pi - 2 pi / n`).
    ///
    /// For R = 0 this is the paper's rho(phi_i), with its derivative in place of the printed one, whose
    /// `cos(phi)/2` and `sin(phi)` should read `cos(phi/2)` and `sin(phi/2)`.
    pub fn radius(&self, phi: f64) -> Radius {
        let sector = self.sector_sine();
        let (sin, cos) = libm::sincos(0.5 * phi);
        let tip = coiled(self.tip_radius, self.tip(), phi);
        let corner = coiled(self.corner_radius, self.corner(), phi + self.turn());
        let width = self.inflated_width();
        let half_chord = width + tip[0] + corner[0];
        let rim = self.correction.rim_offset * self.width;
        let value = self.arm * sin + half_chord * cos - (width + corner[0]) * sector + rim;
        let slope =
            0.5 * (self.arm * cos - half_chord * sin) + (tip[1] + corner[1]) * cos - corner[1] * sector;
        let curvature = -0.25 * (self.arm * sin + half_chord * cos) - (tip[1] + corner[1]) * sin
            + (tip[2] + corner[2]) * cos
            - corner[2] * sector;
        Radius { value: value / sector, slope: slope / sector, curvature: curvature / sector }
    }

    /// The largest inner radius between the tip angle `start_angle` (rad) and an almost straight corner.
    pub fn widest(&self, start_angle: f64) -> Widest {
        self.widest_from(start_angle, &self.radius(start_angle))
    }

    /// [`Mechanism::widest`] with the radius at `start_angle` given.
    fn widest_from(&self, start_angle: f64, start: &Radius) -> Widest {
        if start.slope <= 0.0 {
            return Widest { angle: start_angle, radius: start.value };
        }
        let straight = PI - self.turn();
        let last = start_angle + NEARLY_STRAIGHT * (straight - start_angle);
        let angle = if self.tip_radius == 0.0 && self.corner_radius == 0.0 {
            // l cos(phi/2) = W' sin(phi/2).
            last.min(2.0 * libm::atan2(self.arm, self.inflated_width()))
        } else if self.radius(last).slope >= 0.0 {
            last
        } else {
            // The slope changes its sign between the two, so there is a root.
            bracketed_root(start_angle, last, WIDEST_TOLERANCE, |phi| {
                Ok::<_, RootFault>(self.radius(phi).slope)
            })
            .unwrap_or(start_angle)
        };
        Widest { angle, radius: self.radius(angle).value }
    }
}

/// The coiled radius r = R / lambda = R alpha_0 / (pi - phi) of `hinge`, whose flat one is `radius`, with its derivatives r / (pi - phi) and
/// 2 r / (pi - phi)^2, at its angle phi.
fn coiled(radius: f64, hinge: Hinge, angle: f64) -> [f64; 3] {
    if radius == 0.0 {
        return [0.0; 3];
    }
    let r = radius * hinge.arc() / (PI - angle);
    [r, r / (PI - angle), 2.0 * r / (PI - angle).powi(2)]
}

#[cfg(test)]
pub(in crate::mechanics) mod tests {
    use super::*;

    /// The mechanism of a flat star of inner radius `rho_0`, whose arms are as long as its other dimensions make them.
    pub(in crate::mechanics) fn flat(rho_0: f64, mechanism: Mechanism) -> Mechanism {
        let Mechanism { points, width, tip_angle, tip_radius, corner_radius, .. } = mechanism;
        let (sin, cos) = libm::sincos(0.5 * tip_angle);
        let reach = (rho_0 + width + corner_radius) * libm::sin(PI / f64::from(points));
        Mechanism { arm: (reach - (width + tip_radius + corner_radius) * cos) / sin, ..mechanism }
    }

    /// The paper's star with `points` points.
    pub(in crate::mechanics) fn paper(points: u32) -> Mechanism {
        let sharp = Mechanism {
            points,
            arm: 0.0,
            width: 0.03,
            tip_angle: 30.0_f64.to_radians(),
            tip_radius: 0.0,
            corner_radius: 0.0,
            correction: Correction::default(),
        };
        flat(0.05, sharp)
    }

    #[test]
    fn arm_lengths_of_the_papers_stars() {
        let lengths = [155.72, 106.60, 69.72, 42.59, 22.15, 6.32];
        for (points, length) in (3..).zip(lengths) {
            assert!((paper(points).arm * 1e3 - length).abs() < 0.005, "n = {points}: {}", paper(points).arm);
        }
    }

    #[test]
    fn slopes_of_the_radius_are_its_derivatives() {
        let star = flat(0.05, Mechanism { tip_radius: 0.002, corner_radius: 0.004, ..paper(5) });
        for phi in [-0.1, 0.0, 0.2, 0.5] {
            let step = 1e-5;
            let [below, center, above] = [-step, 0.0, step].map(|d| star.radius(phi + d));
            let slope = (above.value - below.value) / (2.0 * step);
            let curvature = (above.slope - below.slope) / (2.0 * step);
            assert!((slope - center.slope).abs() < 1e-9, "{slope} {}", center.slope);
            assert!((curvature - center.curvature).abs() < 1e-9, "{curvature} {}", center.curvature);
        }
    }

    #[test]
    fn zero_width_is_the_papers_main_text() {
        let star = flat(0.05, Mechanism { width: 1e-9, ..paper(6) });
        let radius = star.radius(0.3).value;
        let expected = star.arm * libm::sin(0.15_f64) / libm::sin(PI / 6.0);
        assert!((radius - expected).abs() < 1e-9);
    }

    #[test]
    fn all_lengths_scale_together() {
        let scaled = |eta: f64| {
            let unscaled = flat(0.05, Mechanism { tip_radius: 0.002, corner_radius: 0.003, ..paper(5) });
            let star = Mechanism {
                arm: eta * unscaled.arm,
                width: eta * unscaled.width,
                tip_radius: eta * unscaled.tip_radius,
                corner_radius: eta * unscaled.corner_radius,
                ..unscaled
            };
            [star.radius(0.2).value / eta, star.widest(0.2).radius / eta]
        };
        let unscaled = scaled(1.0);
        for eta in [0.02, 2000.0] {
            for (a, b) in scaled(eta).into_iter().zip(unscaled) {
                assert!((a / b - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_widest_opening_is_the_widest_of_a_dense_grid() {
        let round =
            |points, r_i, r_e| flat(0.05, Mechanism { tip_radius: r_i, corner_radius: r_e, ..paper(points) });
        for star in [paper(3), paper(5), paper(7), paper(8), round(7, 0.002, 0.0), round(6, 0.001, 0.004)] {
            let (start_angle, widest) = (0.1, star.widest(0.1));
            let last = start_angle + NEARLY_STRAIGHT * (PI - star.turn() - start_angle);
            let grid = (0..=5000).map(|i| start_angle + (last - start_angle) * f64::from(i) / 5000.0);
            let (mut largest, mut previous) = (0.0_f64, f64::INFINITY);
            for phi in grid {
                let radius = star.radius(phi);
                largest = largest.max(radius.value);
                assert!(radius.slope < previous, "concave: {star:?} at {phi}");
                previous = radius.slope;
            }
            assert!((largest / widest.radius - 1.0).abs() < 1e-6, "{star:?}: {largest} {widest:?}");
        }
        // Eight points of the paper: short arms lock at 33.5 mm, far below the flat 50 mm.
        assert!((paper(8).widest(0.0).radius * 1e3 - 33.5).abs() < 0.05);
    }
}
