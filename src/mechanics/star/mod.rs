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
//! Flat: `w = W`, `r = R`, `rho = rho_0`; this fixes l. Inflated: `w = W' = 2 W / pi`, the arms' width as
//! a cylinder, and `r = R / lambda`, because a coiled hinge keeps the length of its inner arc.

pub mod response;

use crate::mechanics::fault::StarFault;
use crate::mechanics::hinge::Hinge;
use std::f64::consts::{FRAC_2_PI, PI};

/// The flat dimensions of a star; lengths in m, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarGeometry {
    /// Number of points n, 3 or more.
    pub points: u32,
    /// Inner radius rho_0: from the axis to the tube's edge at a corner, above 0.
    pub inner_radius: f64,
    /// Tube width W, above 0.
    pub width: f64,
    /// Angle phi_i0 between the arms of a tip, above 0 and below `pi - 2 pi / n`.
    pub tip_angle: f64,
    /// Inner radius of curvature R_i of the tips, 0 or more.
    pub tip_radius: f64,
    /// Inner radius of curvature R_e of the corners, 0 or more.
    pub corner_radius: f64,
}

impl StarGeometry {
    /// The paper's star with `points` points: rho_0 = 50 mm, W = 30 mm, phi_i0 = 30 deg, sharp hinges.
    pub fn paper(points: u32) -> Self {
        Self {
            points,
            inner_radius: 0.05,
            width: 0.03,
            tip_angle: 30_f64.to_radians(),
            tip_radius: 0.0,
            corner_radius: 0.0,
        }
    }
}

/// A star that can be made: its arms have a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    geometry: StarGeometry,
    arm: f64,
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

impl Star {
    /// The star of these flat dimensions.
    ///
    /// # Errors
    /// If a dimension is out of its range, or the arms would have no length.
    pub fn new(geometry: StarGeometry) -> Result<Self, StarFault> {
        let StarGeometry { points, inner_radius, width, tip_angle, tip_radius, corner_radius } = geometry;
        let need = |holds: bool, symbol, found, allowed| {
            if holds { Ok(()) } else { Err(StarFault::Dimension { symbol, found, allowed }) }
        };
        let size = |x: f64| x > 0.0 && x.is_finite();
        let radius = |x: f64| x >= 0.0 && x.is_finite();
        need(points >= 3, "n", f64::from(points), "3 or more")?;
        need(size(inner_radius), "rho_0", inner_radius, "above 0")?;
        need(size(width), "W", width, "above 0")?;
        need(radius(tip_radius), "R_i", tip_radius, "0 or more")?;
        need(radius(corner_radius), "R_e", corner_radius, "0 or more")?;
        // A straight corner has no hinge and an infinite stiffness: it must turn by a microradian at least.
        let most = PI - 2.0 * PI / f64::from(points) - 1e-6;
        need(
            tip_angle > 0.0 && tip_angle < most,
            "phi_i0",
            tip_angle,
            "above 0 and below pi - 2 pi / n (in rad)",
        )?;
        let (sin, cos) = (0.5 * tip_angle).sin_cos();
        let reach = (inner_radius + width + corner_radius) * (PI / f64::from(points)).sin();
        let arm = (reach - (width + tip_radius + corner_radius) * cos) / sin;
        if size(arm) { Ok(Self { geometry, arm }) } else { Err(StarFault::ArmLength { found: arm }) }
    }

    /// The flat dimensions.
    pub fn geometry(&self) -> &StarGeometry {
        &self.geometry
    }

    /// Length l of the straight arms, m.
    pub fn arm_length(&self) -> f64 {
        self.arm
    }

    /// `2 pi / n`: by how much a corner's angle exceeds the tip's.
    pub fn turn(&self) -> f64 {
        2.0 * PI / f64::from(self.geometry.points)
    }

    /// The hinge at a tip.
    pub fn tip(&self) -> Hinge {
        let StarGeometry { width, tip_angle, tip_radius, .. } = self.geometry;
        Hinge { r_star: tip_radius / width, width, rest_angle: tip_angle }
    }

    /// The hinge at a reentrant corner.
    pub fn corner(&self) -> Hinge {
        let StarGeometry { width, tip_angle, corner_radius, .. } = self.geometry;
        Hinge { r_star: corner_radius / width, width, rest_angle: tip_angle + self.turn() }
    }

    /// Inflated width W' = 2 W / pi of the arms, m.
    pub fn inflated_width(&self) -> f64 {
        FRAC_2_PI * self.geometry.width
    }

    /// Inner radius rho of the inflated star at the tip angle `phi` (rad, below `pi - 2 pi / n`).
    ///
    /// For R = 0 this is the paper's rho(phi_i), with its derivative in place of the printed one, whose
    /// `cos(phi)/2` and `sin(phi)` should read `cos(phi/2)` and `sin(phi/2)`.
    pub fn radius(&self, phi: f64) -> Radius {
        let (sin, cos) = (0.5 * phi).sin_cos();
        let sector = (0.5 * self.turn()).sin();
        // r = R / lambda = R alpha_0 / (pi - phi) at both hinges, with derivatives r / (pi - phi), 2 r / (pi - phi)^2.
        let coiled = |radius: f64, hinge: Hinge, angle: f64| {
            let r = radius * hinge.arc() / (PI - angle);
            [r, r / (PI - angle), 2.0 * r / (PI - angle).powi(2)]
        };
        let tip = coiled(self.geometry.tip_radius, self.tip(), phi);
        let corner = coiled(self.geometry.corner_radius, self.corner(), phi + self.turn());
        let width = self.inflated_width();
        let across = width + tip[0] + corner[0];
        let value = self.arm * sin + across * cos - (width + corner[0]) * sector;
        let slope = 0.5 * (self.arm * cos - across * sin) + (tip[1] + corner[1]) * cos - corner[1] * sector;
        let curvature = -0.25 * (self.arm * sin + across * cos) - (tip[1] + corner[1]) * sin
            + (tip[2] + corner[2]) * cos
            - corner[2] * sector;
        Radius { value: value / sector, slope: slope / sector, curvature: curvature / sector }
    }

    /// Distance from the axis to the centres T of the flat tips' arcs, m.
    pub fn tip_distance(&self) -> f64 {
        let StarGeometry { inner_radius, width, corner_radius, tip_angle, tip_radius, .. } = self.geometry;
        let (sin, cos) = (0.5 * tip_angle).sin_cos();
        // T - P along the tip's ray, from P at rho_0 + W + R_e on the ray pi/n beside it.
        (inner_radius + width + corner_radius) * (0.5 * self.turn()).cos() + self.arm * cos
            - (width + tip_radius + corner_radius) * sin
    }

    /// Area of the flat tube seen from above, m^2: 2 n arms and 2 n annulus sectors.
    pub fn tube_area(&self) -> f64 {
        let StarGeometry { points, width, tip_radius, corner_radius, .. } = self.geometry;
        let sector = |radius: f64, arc: f64| arc * width * (radius + 0.5 * width);
        let point = 2.0 * self.arm * width
            + sector(tip_radius, self.tip().arc())
            + sector(corner_radius, self.corner().arc());
        f64::from(points) * point
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The paper's star with `points` points.
    pub(in crate::mechanics) fn paper_geometry(points: u32) -> StarGeometry {
        StarGeometry {
            points,
            inner_radius: 0.05,
            width: 0.03,
            tip_angle: 30.0_f64.to_radians(),
            tip_radius: 0.0,
            corner_radius: 0.0,
        }
    }

    #[test]
    fn arm_lengths_of_the_papers_stars() {
        let lengths = [155.72, 106.60, 69.72, 42.59, 22.15, 6.32];
        for (points, length) in (3..).zip(lengths) {
            let star = Star::new(paper_geometry(points)).expect("feasible");
            assert!((star.arm_length() * 1e3 - length).abs() < 0.005, "n = {points}: {}", star.arm_length());
        }
        let fault = Star::new(paper_geometry(9)).expect_err("no arms are left");
        assert!(matches!(fault, StarFault::ArmLength { found } if found < 0.0));
    }

    #[test]
    fn slopes_of_the_radius_are_its_derivatives() {
        let geometry = StarGeometry { tip_radius: 0.002, corner_radius: 0.004, ..paper_geometry(5) };
        let star = Star::new(geometry).expect("feasible");
        for phi in [-0.1, 0.0, 0.2, 0.5] {
            let step = 1e-5;
            let [below, at, above] = [-step, 0.0, step].map(|d| star.radius(phi + d));
            let slope = (above.value - below.value) / (2.0 * step);
            let curvature = (above.slope - below.slope) / (2.0 * step);
            assert!((slope - at.slope).abs() < 1e-9, "{slope} {}", at.slope);
            assert!((curvature - at.curvature).abs() < 1e-9, "{curvature} {}", at.curvature);
        }
    }

    #[test]
    fn zero_width_is_the_papers_main_text() {
        let star = Star::new(StarGeometry { width: 1e-9, ..paper_geometry(6) }).expect("feasible");
        let radius = star.radius(0.3).value;
        let expected = star.arm_length() * 0.15_f64.sin() / (PI / 6.0).sin();
        assert!((radius - expected).abs() < 1e-9);
    }

    #[test]
    fn all_lengths_scale_together() {
        let scaled = |eta: f64| {
            let g = StarGeometry { tip_radius: 0.002, corner_radius: 0.003, ..paper_geometry(5) };
            let star = Star::new(StarGeometry {
                inner_radius: eta * g.inner_radius,
                width: eta * g.width,
                tip_radius: eta * g.tip_radius,
                corner_radius: eta * g.corner_radius,
                ..g
            });
            let star = star.expect("feasible");
            [star.arm_length() / eta, star.radius(0.2).value / eta, star.tube_area() / (eta * eta)]
        };
        let one = scaled(1.0);
        for eta in [0.02, 2000.0] {
            for (a, b) in scaled(eta).into_iter().zip(one) {
                assert!((a / b - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn every_dimension_is_checked() {
        let bad = |change: fn(&mut StarGeometry)| {
            let mut geometry = paper_geometry(5);
            change(&mut geometry);
            Star::new(geometry).expect_err("must be refused")
        };
        let symbol = |fault| if let StarFault::Dimension { symbol, .. } = fault { symbol } else { "" };
        assert_eq!(symbol(bad(|g| g.points = 2)), "n");
        assert_eq!(symbol(bad(|g| g.inner_radius = 0.0)), "rho_0");
        assert_eq!(symbol(bad(|g| g.width = f64::NAN)), "W");
        assert_eq!(symbol(bad(|g| g.tip_radius = -1e-9)), "R_i");
        assert_eq!(symbol(bad(|g| g.corner_radius = f64::INFINITY)), "R_e");
        assert_eq!(symbol(bad(|g| g.tip_angle = 0.0)), "phi_i0");
        assert_eq!(symbol(bad(|g| (g.points, g.tip_angle) = (3, 60.0_f64.to_radians()))), "phi_i0");
        assert_eq!(symbol(bad(|g| g.tip_angle = 108.1_f64.to_radians())), "phi_i0");
    }
}
