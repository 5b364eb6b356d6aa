//! Pressure and weight limits from fabric and friction.

use crate::mechanics::fault::StarFault;

/// The fabric of one sheet, in SI units.
///
/// The mechanics depends on `B`, `Y` and nu alone. If B and Y were measured, thickness and modulus are those of a homogeneous sheet that
/// has both ([`ElasticSheet::of_stiffnesses`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticSheet {
    /// Thickness t, m, above 0.
    pub thickness: f64,
    /// Young's modulus E, Pa, above 0.
    pub young_modulus: f64,
    /// Poisson ratio nu, in (-1, 0.5].
    pub poisson_ratio: f64,
}

/// Bendability from which the paper finds the hinge fully coiled, 1/eps ~ 10^3.
pub const FULL_ACTUATION: f64 = 1e3;
/// Stretch p W / Y above which the fabric is no longer called quasi-inextensible: 2 % of strain is a quarter
/// of the ring's overcoiling of the outer edge.
pub const INEXTENSIBLE: f64 = 0.02;
/// Standard gravity, m/s^2.
pub const GRAVITY: f64 = 9.806_65;

impl ElasticSheet {
    /// The fabric, checked.
    ///
    /// # Errors
    /// If a property is out of its range.
    pub fn new(thickness: f64, young_modulus: f64, poisson_ratio: f64) -> Result<Self, StarFault> {
        let is_poisson_ratio = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
        for (is_allowed, symbol, found, allowed) in [
            (thickness > 0.0 && thickness.is_finite(), "t", thickness, "above 0"),
            (young_modulus > 0.0 && young_modulus.is_finite(), "E", young_modulus, "above 0"),
            (is_poisson_ratio, "nu", poisson_ratio, "above -1, up to 0.5"),
        ] {
            if !is_allowed {
                return Err(StarFault::Dimension { symbol, found, allowed });
            }
        }
        Ok(Self { thickness, young_modulus, poisson_ratio })
    }

    /// The even sheet of bending stiffness `bending` (B, N m) and stretch stiffness `stretch` (Y, N per m): its thickness is
    /// `sqrt(12 (1 - nu^2) B / Y)`.
    ///
    /// # Errors
    /// If a property is out of its range.
    pub fn of_stiffnesses(bending: f64, stretch: f64, poisson_ratio: f64) -> Result<Self, StarFault> {
        let thickness = (12.0 * (1.0 - poisson_ratio.powi(2)) * bending / stretch).sqrt();
        Self::new(thickness, stretch / thickness, poisson_ratio)
    }

    /// Stretching modulus `Y = E t`, N per m.
    pub fn stretching_modulus(&self) -> f64 {
        self.young_modulus * self.thickness
    }

    /// Bending modulus `B = E t^3 / [12 (1 - nu^2)]`, N m.
    pub fn bending_modulus(&self) -> f64 {
        self.young_modulus * self.thickness.powi(3) / (12.0 * (1.0 - self.poisson_ratio.powi(2)))
    }

    /// Bendability `1/eps = p W^3 / B` at the gauge pressure `p` (Pa) and the tube width `width` (m).
    pub fn bendability(&self, p: f64, width: f64) -> f64 {
        p * width.powi(3) / self.bending_modulus()
    }

    /// Pressure for full actuation, `p_op = 10^3 B / W^3`, Pa.
    pub fn operating_pressure(&self, width: f64) -> f64 {
        FULL_ACTUATION * self.bending_modulus() / width.powi(3)
    }

    /// Load per length, N per m, under which a flap of two fused sheets buckles out of its plane: `pi^2 8 B / (4 L^2)`, clamped along one edge,
    /// free along the other, of the depth `depth` (L, m) between them. A sheet of twice the thickness has 8 B. Euler's column.
    pub fn flap_load(&self, depth: f64) -> f64 {
        8.0 * self.bending_modulus() * (std::f64::consts::PI / (2.0 * depth)).powi(2)
    }

    /// Stretch `p W / Y`: small while the fabric is quasi-inextensible.
    pub fn stretch(&self, p: f64, width: f64) -> f64 {
        p * width / self.stretching_modulus()
    }
}

/// Mass (kg) that friction holds: `m g = mu sum F`, with the radial forces `forces` (N) of all stars.
pub fn payload(friction: f64, forces: impl IntoIterator<Item = f64>) -> f64 {
    friction * forces.into_iter().sum::<f64>() / GRAVITY
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper_sheet() -> ElasticSheet {
        ElasticSheet::new(0.3e-3, 128e6, 0.39).expect("valid")
    }

    #[test]
    fn moduli_of_the_papers_fabric() {
        assert!((paper_sheet().bending_modulus() - 3.40e-4).abs() < 1e-6);
        assert_eq!(paper_sheet().stretching_modulus(), 38_400.0);
        let measured = ElasticSheet::of_stiffnesses(3.4e-4, 38_400.0, 0.39).expect("valid");
        assert!((measured.bending_modulus() / 3.4e-4 - 1.0).abs() < 1e-12);
        assert!((measured.stretching_modulus() / 38_400.0 - 1.0).abs() < 1e-12);
        assert!((measured.thickness / 0.3e-3 - 1.0).abs() < 1e-3);
        // 37 kPa in a tube of 30 mm: bendability 2,900, stretch 3 %.
        assert!((paper_sheet().bendability(37e3, 0.03) / 2940.0 - 1.0).abs() < 0.01);
        assert!((paper_sheet().operating_pressure(0.03) / 12.6e3 - 1.0).abs() < 0.01);
        assert!((paper_sheet().flap_load(3e-3) / 745.0 - 1.0).abs() < 0.01);
        assert!((paper_sheet().stretch(37e3, 0.03) - 0.0289).abs() < 1e-4);
    }

    #[test]
    fn operating_pressure_scales_as_published() {
        let p = paper_sheet().operating_pressure(0.03);
        let thicker = ElasticSheet { thickness: 3.0 * 0.3e-3, ..paper_sheet() };
        assert!((paper_sheet().operating_pressure(0.09) / (p / 27.0) - 1.0).abs() < 1e-12);
        assert!((thicker.operating_pressure(0.09) / p - 1.0).abs() < 1e-12);
    }

    #[test]
    fn fabrics_that_do_not_exist_are_refused() {
        assert!(ElasticSheet::new(0.0, 1e8, 0.3).is_err() && ElasticSheet::new(1e-4, f64::NAN, 0.3).is_err());
        assert!(ElasticSheet::new(1e-4, 1e8, 0.51).is_err() && ElasticSheet::new(1e-4, 1e8, -1.0).is_err());
    }
}
