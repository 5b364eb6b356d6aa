//! The coating: how thick the poured silicone stays.

use crate::design::MaskPlate;

/// Density of VPS-32 (Elite Double 32), kg/m^3, by its maker.
const DENSITY: f64 = 1160.0;
/// Standard gravity, m/s^2.
const GRAVITY: f64 = 9.806_65;
/// The time integral of the inverse viscosity until the silicone gels, 1/Pa: the range for pours from at once to
/// some minutes after mixing (mu = 7.1 Pa s exp(2.06e-3 t), Lee et al. 2016).
const FLUIDITY: [f64; 2] = [50.0, 68.0];

/// The assumptions of the thickness estimate, for reports.
pub const COATING_ASSUMES: &str = "VPS-32 of 1160 kg/m3, poured at once and drained on a vertical star, 50 to 68 /Pa until it gels (Lee et al. 2016); at the lower edge of a window of this extent";

impl MaskPlate {
    /// The drained thickness at a window's lower edge, from thin to thick, um.
    ///
    /// `sqrt(x / (rho g sin(theta) Phi))`, Lee et al. 2016, on a plane tilted by theta, at the distance x below
    /// the upper edge, here x = extent and theta = 90 degrees; Phi = ∫ dt / mu. Thickness grows like the root of x: the mean is
    /// two thirds of this. Less tilt leaves more: twice as much at 14.5 degrees.
    pub fn coating_um(&self) -> [f64; 2] {
        let x = self.extent / 1e3;
        let [least, most] = FLUIDITY;
        [most, least].map(|phi| 1e6 * (x / (DENSITY * GRAVITY * phi)).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use inflatable::geom::Path;

    use super::*;

    #[test]
    fn the_papers_coating_is_two_tenths_of_a_millimetre() {
        let plate = MaskPlate {
            plate: Path::default(),
            windows: Vec::new(),
            extent: 30.0,
            wanted: 30.0,
            border: 0.0,
        };
        let [thin, thick] = plate.coating_um();
        assert!(thin < 200.0 && 200.0 < thick, "{thin} to {thick} um, the paper has about 200");
    }
}
