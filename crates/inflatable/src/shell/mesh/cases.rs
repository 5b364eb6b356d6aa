//! The regions of the cases: a hinge without arms, half a V-actuator, half a sector of a star.

use std::f64::consts::PI;

use crate::shell::mesh::strip::{Strip, StripSide};
use crate::shell::mesh::{Border, MarginWidths, MeshFault, Meshed, Sizes, plane, rim};
use crate::shell::mesh::{delaunay, sizing};

/// A hinge without arms: the sector of an annulus between two planes of symmetry, its centre at the origin.
#[cfg(test)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HingeSector {
    /// Inner radius R, at least 0; at 0 the inner rim is a point.
    pub r: f64,
    /// Width W.
    pub w: f64,
    /// Angle between the planes, rad: alpha_0, or half of it where the middle of the hinge is a plane of symmetry.
    pub arc: f64,
}

/// Half of a V-actuator: from the plane of symmetry through its hinge, whose centre is the origin, to the sealed end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfActuator {
    /// Inner radius R of the hinge, at least 0; at 0 the inner rim turns on a point.
    pub r: f64,
    /// Width W.
    pub w: f64,
    /// Length l of the arm, from the hinge's end to the sealed end.
    pub l: f64,
    /// Angle phi_0 between the arms, rad.
    pub phi_0: f64,
}

/// Half a sector of a star: from the plane through a reentrant corner, on the x axis, to the plane through the next tip, on
/// the ray at pi/n; the star's axis is the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSector {
    /// Number of points n.
    pub n: u32,
    /// Inner radius rho_0.
    pub rho_0: f64,
    /// Tube width W.
    pub w: f64,
    /// Angle phi_i0 of the tips, rad.
    pub phi_i: f64,
    /// Inner radius R_i of the tips.
    pub r_i: f64,
    /// Inner radius R_e of the reentrant corners.
    pub r_e: f64,
}

#[cfg(test)]
impl HingeSector {
    /// The mesh of this flat part.
    ///
    /// # Errors
    /// If a dimension is out of range.
    pub(crate) fn mesh(&self, sizes: &Sizes) -> Result<Meshed, MeshFault> {
        positive("the width W", self.w)?;
        sizes.check(self.w)?;
        radius("the inner radius R", self.r, self.w)?;
        check_angle("the arc", self.arc, PI)?;
        mesh(
            Strip::new(self.r, self.w).turn(StripSide::Left, self.r, self.arc),
            Border::Mirror(plane::SECOND),
            sizes,
            MarginWidths::default(),
        )
    }
}

impl HalfActuator {
    /// The mesh of this flat part.
    ///
    /// # Errors
    /// If a dimension is out of range.
    pub fn mesh(&self, sizes: &Sizes) -> Result<Meshed, MeshFault> {
        self.mesh_with(sizes, MarginWidths::default())
    }

    /// The mesh with the margin beyond both long rims. The sealed end has none.
    ///
    /// # Errors
    /// If a dimension is out of range.
    pub fn mesh_with(&self, sizes: &Sizes, margin: MarginWidths) -> Result<Meshed, MeshFault> {
        positive("the width W", self.w)?;
        sizes.check(self.w)?;
        radius("the inner radius R", self.r, self.w)?;
        arm(self.l, self.w)?;
        check_angle("the angle phi_0", self.phi_0, PI)?;
        let strip = Strip::new(self.r, self.w).turn(StripSide::Left, self.r, 0.5 * (PI - self.phi_0));
        mesh(strip.straight(self.l), Border::Rim(rim::END), sizes, margin)
    }
}

impl HalfSector {
    /// Arm length l, of `(rho_0 + W + R_e) sin(pi/n) = l sin(phi_i0/2) + (W + R_i + R_e) cos(phi_i0/2)`: the paper's, with
    /// corner radii.
    pub fn l(&self) -> f64 {
        let (sin, cos) = libm::sincos(0.5 * self.phi_i);
        let outer = self.w + self.r_e;
        ((self.rho_0 + outer) * libm::sin(self.half_angle()) - (outer + self.r_i) * cos) / sin
    }

    /// Angle between its planes, pi / n.
    pub fn half_angle(&self) -> f64 {
        PI / f64::from(self.n)
    }

    /// The mesh of this flat part.
    ///
    /// # Errors
    /// If a dimension is out of range, or there is no such star.
    pub fn mesh(&self, sizes: &Sizes) -> Result<Meshed, MeshFault> {
        self.mesh_with(sizes, MarginWidths::default())
    }

    /// The mesh with the margin beyond both rims.
    ///
    /// # Errors
    /// If a dimension is out of range, or there is no such star.
    pub fn mesh_with(&self, sizes: &Sizes, margin: MarginWidths) -> Result<Meshed, MeshFault> {
        check(self.n >= 3, "n", f64::from(self.n), "3 or more")?;
        positive("the inner radius rho_0", self.rho_0)?;
        positive("the width W", self.w)?;
        sizes.check(self.w)?;
        radius("the tips' radius R_i", self.r_i, self.w)?;
        radius("the corners' radius R_e", self.r_e, self.w)?;
        check_angle("the tips' angle phi_i0", self.phi_i, PI - 2.0 * self.half_angle())?;
        arm(self.l(), self.w)?;
        let phi_e = self.phi_i + 2.0 * self.half_angle();
        let strip = Strip::new(self.rho_0, self.w)
            .turn(StripSide::Right, self.r_e, 0.5 * (PI - phi_e))
            .straight(self.l())
            .turn(StripSide::Left, self.r_i, 0.5 * (PI - self.phi_i));
        mesh(strip, Border::Mirror(plane::SECOND), sizes, margin)
    }
}

fn mesh(strip: Strip, last: Border, sizes: &Sizes, margin: MarginWidths) -> Result<Meshed, MeshFault> {
    let (region, hinges) = strip.end(last);
    let sizing = sizing::Sizing::new(&region, &hinges, sizes);
    delaunay::fill(&region, &sizing)?.with_margin(margin, &sizing)
}

fn check(good: bool, name: &'static str, value: f64, allowed: &'static str) -> Result<(), MeshFault> {
    if good { Ok(()) } else { Err(MeshFault::Dimension { name, found: value, allowed }) }
}

fn positive(name: &'static str, value: f64) -> Result<(), MeshFault> {
    check(value > 0.0 && value.is_finite(), name, value, "more than 0")
}

/// A hinge's inner radius: a point, or an arc that the triangles around it can get small enough for.
fn radius(name: &'static str, value: f64, w: f64) -> Result<(), MeshFault> {
    let good = value == 0.0 || (value >= 1e-4 * w && value <= 100.0 * w);
    check(good, name, value, "0, or W/10000 to 100 W")
}

fn arm(value: f64, w: f64) -> Result<(), MeshFault> {
    let good = value >= 1e-4 * w && value <= 1000.0 * w;
    check(good, "the arm's length l", value, "W/10000 to 1000 W")
}

/// An angle between 0 and `maximum`.
fn check_angle(name: &'static str, value: f64, maximum: f64) -> Result<(), MeshFault> {
    check(value > 0.0 && value < maximum, name, value, "more than 0, and less than a straight hinge")
}
