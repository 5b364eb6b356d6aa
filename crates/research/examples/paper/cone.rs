//! The cone test: its balance, and the **offset**, the force that a cone has where the star would be at rest.
//!
//! A tube that is pushed in by d on a small patch loses the volume A per d there, so it pushes back with p A. With the radii of
//! curvature `R_m` along its meridian and `R_h` along the corner, cone included, the patch is an ellipse of `A = 2 pi d sqrt(R_m R_h)`.

use research::cone::Balance;
use research::stars::draw::PAPER_PRESSURES;
use stargrip_cam::forecast::model_selection::{corrected, tabled};
use stargrip_cam::mechanics::star::response::Inflated;
use std::f64::consts::PI;
use std::fmt::Write;

use super::stars::case;

/// gamma of the paper's cone, rad.
const HALF_ANGLE: f64 = PI / 6.0;

/// A cone that touches the corners of a star at rest; SI units.
pub(crate) struct Touch {
    /// Number of corners n.
    pub(crate) corners: u32,
    /// Half the cone's angle gamma, rad.
    pub(crate) half_angle: f64,
    /// p.
    pub(crate) pressure: f64,
    /// w, inflated width of the tube.
    pub(crate) width: f64,
    /// rho_eq, which is the cone's radius in the star's plane.
    pub(crate) radius: f64,
    /// Inner radius of the coiled corner's hinge.
    pub(crate) inner: f64,
    /// Radial force over opening of the star, N per m.
    pub(crate) spring: f64,
}

impl Touch {
    /// e = (w/2) (1 / cos(gamma) - 1): by how much the tube bulges into the cone above the star's plane, m along the radius.
    pub(crate) fn bulge(&self) -> f64 {
        0.5 * self.width * (1.0 / self.half_angle.cos() - 1.0)
    }

    /// Radial force of all corners by how far the cone dents them, N per m along the radius.
    fn dent(&self) -> f64 {
        let cosine = self.half_angle.cos();
        let along = 1.0 / (cosine * (1.0 / (self.inner + self.width) + 1.0 / self.radius));
        let patch = 2.0 * PI * (0.5 * self.width * along).sqrt();
        f64::from(self.corners) * self.pressure * patch * cosine.powi(2)
    }

    /// The offset, N: the star opens and its tubes are dented, together by the bulge.
    pub(crate) fn offset(&self) -> f64 {
        self.bulge() / (1.0 / self.spring + 1.0 / self.dent())
    }

    /// The same of a star whose arms are fixed.
    pub(crate) fn held(&self) -> f64 {
        self.bulge() * self.dent()
    }

    /// Area of contact at one corner, m^2: its pressure has the radial part cos(gamma).
    pub(crate) fn area(&self, force: f64) -> f64 {
        force / (f64::from(self.corners) * self.pressure * self.half_angle.cos())
    }
}

/// The paper's cone in its star of five points, by `section`.
fn touch(kilopascals: f64) -> Touch {
    let (case, pressure) = case(5, kilopascals);
    let model = tabled(&case, pressure).expect("in range");
    let case = corrected(&case, &model).expect("in range");
    let star = &case.mechanism;
    let inflated = Inflated::new(star, &model, pressure).expect("in range");
    let rest = inflated.linear_rest();
    let own = Touch {
        corners: star.points,
        half_angle: HALF_ANGLE,
        pressure,
        width: star.inflated_width(),
        radius: rest.radius,
        inner: star.corner_radius / inflated.hinges()[1].lambda,
        spring: 0.0,
    };
    let opening = own.bulge();
    let force = inflated.linear_force(rest.radius + opening, &rest).expect("in reach");
    Touch { spring: force / opening, ..own }
}

/// The balance of forces, and the offset.
pub(crate) fn tables() -> [String; 2] {
    let ratio = |balance: Balance| balance.ratio(HALF_ANGLE, 0.1).expect("slides");
    let (derived, published) = (ratio(Balance::Derived), ratio(Balance::Published));
    let balance = format!(
        "| balance | F_s / P, gamma = 30 deg, mu = 0.1 |\n|---|---|\n| derived | {derived:.4} |\n| published | {published:.4} |\n\n"
    );
    let mut out = String::from(
        "| p | w | bulge e | area of contact of a corner | p A of a corner | offset of F | the same with arms held in place: A, offset |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for pressure in PAPER_PRESSURES {
        let own = touch(pressure);
        let (force, most) = (own.offset(), own.held());
        let _ = writeln!(
            out,
            "| {pressure} kPa | {:.1} mm | {:.2} mm | {:.1} mm^2 | {:.2} N | {force:.1} N | {:.0} mm^2, {most:.0} N |",
            1e3 * own.width,
            1e3 * own.bulge(),
            1e6 * own.area(force),
            own.pressure * own.area(force),
            1e6 * own.area(most)
        );
    }
    [balance, out + "\n"]
}
