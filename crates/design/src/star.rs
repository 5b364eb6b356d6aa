//! The flat star: where its hinges and arms lie, exactly.
//!
//! All in the star's own frame: the axis at the origin, corner 1 on +X, counterclockwise from above.
//!
//! ```text
//!                    T   centre of the tip's annulus, on the ray at pi/n
//!                   / \
//!     arm, length l/   \          hinge arcs: tip pi - phi_i, corner pi - phi_e
//!                 /     \         tube: between radius R and R + W around T and P
//!       P -------+       +---
//!       centre of the reentrant corner's annulus, on the ray at 0, beyond the tube
//! ```

use std::f64::consts::PI;

use crate::star_fault::{arm_length, blamed, no_arm};
use crate::{Refusal, RefusalCode};
use geom::Point;
use spec::units::{Angle, Length, Most, Readable};
use spec::{StarSpec, key};

/// The flat geometry of a star that exists: every length positive. Lengths in mm, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Number of points n.
    pub n: u32,
    /// Inner radius rho_0.
    pub rho_0: f64,
    /// Tube width W.
    pub w: f64,
    /// Internal angle phi_i0 of the tips.
    pub phi_i: f64,
    /// External angle phi_e0 = phi_i0 + 2 pi / n of the reentrant corners.
    pub phi_e: f64,
    /// Inner radius of curvature R_i of the tips.
    pub r_i: f64,
    /// Inner radius of curvature R_e of the reentrant corners.
    pub r_e: f64,
    /// Arm length l.
    pub l: f64,
    /// Distance of a tip's centre T from the axis.
    pub d_t: f64,
    /// Distance of a reentrant corner's centre P from the axis, rho_0 + W + R_e.
    pub d_p: f64,
}

/// Largest distance of a tip from the axis, mm: 100 m, as for every length of a spec. A tip angle near 0 makes arms of
/// any length, and programs that fill any memory.
const LARGEST: f64 = 1e5;

impl Star {
    /// The star of `spec`.
    ///
    /// # Errors
    /// If the reentrant corners would be straight, the arms would have no length, or the star would be larger than 200 m.
    pub fn new(spec: &StarSpec) -> Result<Self, Refusal> {
        Self::for_band(spec, Length(0.0))
    }

    /// The star of `spec`; the changes that a refusal names leave a part of each arm to `band`.
    ///
    /// # Errors
    /// As for [`Star::new`].
    pub fn for_band(spec: &StarSpec, band: Length) -> Result<Self, Refusal> {
        let n = spec.points;
        let phi_i = spec.tip_angle.rad();
        let phi_e = phi_i + 2.0 * PI / f64::from(n);
        // Rounding may leave a corner that is straight to 1e-16; below a microradian no arc is left to seal.
        if phi_e >= PI - 1e-6 {
            let (tips, corners) = (spec.tip_angle, Readable(phi_e.to_degrees()));
            let fault = format!(
                "with {n} points and a tip angle of {tips} the reentrant corners would open to {corners} deg"
            );
            let widest = Most(180.0 - 360.0 / f64::from(n));
            let remedy = format!("tip_angle must be below {widest} deg for {n} points");
            return Err(Refusal::new(key::star::TIP_ANGLE, RefusalCode::StraightCorner, fault, remedy));
        }
        let l = arm_length(spec);
        if l <= 0.0 {
            return Err(no_arm(spec, l, band.0 / 2.0));
        }
        let (sin, cos) = libm::sincos(phi_i / 2.0);
        let (w, r_i, r_e) = (spec.tube_width.0, spec.tip_radius.0, spec.corner_radius.0);
        let d_p = spec.inner_radius.0 + w + r_e;
        let d_t = d_p * libm::cos(PI / f64::from(n)) - (w + r_i + r_e) * sin + l * cos;
        let star = Self { n, rho_0: spec.inner_radius.0, w, phi_i, phi_e, r_i, r_e, l, d_t, d_p };
        if star.tip_reach() > LARGEST {
            return Err(too_large(spec, &star));
        }
        Ok(star)
    }

    /// Whether its tips bend beyond the `opening` of a plate, mm: otherwise its arms fall through.
    pub(super) fn lies_on(&self, opening: f64) -> bool {
        self.d_t > opening
    }

    /// A spec of this star; rotation, pitch and inlet are the defaults.
    pub(super) fn spec(&self) -> StarSpec {
        StarSpec {
            inner_radius: Length(self.rho_0),
            tube_width: Length(self.w),
            tip_angle: Angle(self.phi_i.to_degrees()),
            tip_radius: Length(self.r_i),
            corner_radius: Length(self.r_e),
            ..StarSpec::paper(self.n)
        }
    }

    /// Half the angle of a sector, pi / n.
    pub fn half_sector(&self) -> f64 {
        PI / f64::from(self.n)
    }

    /// Direction of the ray of corner `k`, 1 to n.
    pub fn corner_ray(&self, k: u32) -> f64 {
        2.0 * f64::from(k - 1) * self.half_sector()
    }

    /// Direction of the ray of tip `k`, 1 to n.
    pub fn tip_ray(&self, k: u32) -> f64 {
        f64::from(2 * k - 1) * self.half_sector()
    }

    /// Centre P of the annulus of corner `k`.
    pub fn corner_center(&self, k: u32) -> Point {
        Point::polar(self.d_p, self.corner_ray(k))
    }

    /// Centre T of the annulus of tip `k`.
    pub fn tip_center(&self, k: u32) -> Point {
        Point::polar(self.d_t, self.tip_ray(k))
    }

    /// Distance from the axis to the outermost point of a tip's edge.
    pub fn tip_reach(&self) -> f64 {
        self.d_t + self.r_i + self.w
    }
}

fn too_large(spec: &StarSpec, star: &Star) -> Refusal {
    // Here it is large radii and widths that are out of line, and narrow tips.
    let key = blamed([
        (key::star::TIP_ANGLE, 30.0 / spec.tip_angle.0),
        (key::star::INNER_RADIUS, spec.inner_radius.0 / 50.0),
        (key::star::TUBE_WIDTH, spec.tube_width.0 / 30.0),
    ]);
    let fault = format!("the tips would lie {:.1} m from the axis", star.tip_reach() / 1000.0);
    let (largest, angle) = (Readable(LARGEST / 1000.0), spec.tip_angle);
    let remedy = format!("at most {largest} m: make tip_angle wider than {angle}, or the star smaller");
    Refusal::new(key, RefusalCode::TooLarge, fault, remedy)
}
