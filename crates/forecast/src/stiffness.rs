//! From bench tests to the fabric's stiffnesses: B from the angle of a V-actuator, Y from the width of an inflated disc.
//!
//! Both invert `section`. A V-actuator's arms are those of the table, so B is found within its range. A disc wrinkles
//! at its rim, so its section is the tension field's, from its middle to the rim and with a whole turn kept: lambda = 1.

use inflatable::mechanics::fault::StarFault;
use inflatable::mechanics::hinge::section::{Section, arms};
use inflatable::mechanics::hinge::{Hinge, HingeModel, ring};
use inflatable::numerics::{RootFault, bracketed_root};
use std::f64::consts::{FRAC_PI_4, PI};
use std::fmt;

/// p W / Y of discs that are looked at.
const STRETCH: [f64; 2] = [2e-4, 0.1];
/// Places at which a V-actuator's angle is looked at.
const PLACES: u32 = 40;
/// Roots are found to this part.
const TOLERANCE: f64 = 1e-6;
/// Most by which arms let a hinge close further, deg: the largest delta of their tables, 14.3, and its mesh error of 3.1.
const MOST_ARMS: f64 = 17.4;
/// What the errors of both measured angles may add, deg.
const OFF_ANGLES: f64 = 2.0;

/// The least angle (rad) to which a hinge may close, with arms at the angle `flat` (rad) when it is flat, whatever its fabric, size and
/// pressure; below 0 if the arms would cross.
///
/// A hinge alone coils at most as the ring does for R* -> infinity, and its arms let it close further (`section::arms`).
pub fn least_angle(flat: f64) -> f64 {
    let arc = PI - flat;
    let arms = MOST_ARMS.to_radians() * libm::tanh(arc / FRAC_PI_4);
    PI - ring::limit().lambda * arc - arms - OFF_ANGLES.to_radians()
}

/// A V-actuator on the bench; SI units, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VBench {
    /// The flat hinge.
    pub hinge: Hinge,
    /// Gauge pressure, Pa.
    pub pressure: f64,
    /// Angle between its arms, inflated and free.
    pub inflated: f64,
}

/// A disc on the bench; SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscBench {
    /// Flat diameter between its bands, m.
    pub flat: f64,
    /// Diameter inflated, m.
    pub inflated: f64,
    /// Gauge pressure, Pa.
    pub pressure: f64,
}

/// A measurement that no stiffness explains.
#[derive(Clone, Debug, PartialEq)]
pub enum BenchFault {
    /// The angle lies outside of the range of the table's fabrics: from and to, rad.
    Angle(f64, [f64; 2]),
    /// The disc's inflated over its flat width lies outside of the range: from and to.
    Disc(f64, [f64; 2]),
    /// The table of arms does not reach a hinge of this size at this pressure.
    Beyond,
    /// The model refuses.
    Model(StarFault),
}

impl fmt::Display for BenchFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Angle(found, range) => {
                let [low, high] = range.map(f64::to_degrees);
                write!(
                    f,
                    "no stiffness of the fabric explains the V-actuator's {:.1} deg: at this pressure it closes to between {low:.1} and \
                     {high:.1} deg; check the pressure, and that both angles were measured at the arms' middle",
                    found.to_degrees()
                )
            }
            Self::Disc(found, [low, high]) => write!(
                f,
                "the disc's inflated width is {found:.3} of the flat one; it is {low:.3} if nothing stretches, and {high:.3} where \
                 p D / (2 Y) is 0.1; check that the width was measured across the seam, and at this pressure"
            ),
            Self::Beyond => {
                f.write_str(
                    "no fabric of the table of arms makes such a hinge at this pressure: it holds for t/W of 0.005 to 0.03, R* up to 1, 1/eps of \
                     100 to 10,000 and p W / Y up to 0.1; another pressure may do",
                )
            }
            Self::Model(fault) => fault.fmt(f),
        }
    }
}

impl From<StarFault> for BenchFault {
    fn from(fault: StarFault) -> Self {
        Self::Model(fault)
    }
}

impl From<RootFault> for BenchFault {
    fn from(fault: RootFault) -> Self {
        Self::Model(fault.into())
    }
}

impl VBench {
    /// The angle (rad) at which the hinge rests, of fabric of bending stiffness `bending` (N m), stretch stiffness `stretch`
    /// (N per m) and Poisson ratio `poisson`.
    ///
    /// # Errors
    /// If the table of arms does not reach it.
    pub fn predicted(&self, bending: f64, stretch: f64, poisson: f64) -> Result<f64, BenchFault> {
        let Self { hinge, pressure, .. } = *self;
        let w = hinge.width;
        let section =
            Section::by_ratios(pressure * w.powi(3) / bending, (bending / stretch).sqrt() / w, poisson);
        if section.arms(hinge.r_star, hinge.arc()).is_none() {
            return Err(BenchFault::Beyond);
        }
        let rest = section.target(hinge.r_star).map_err(StarFault::from)?;
        Ok(hinge.angle_of(&section, &rest))
    }

    /// Bending stiffness B (N m) with which the hinge rests at its angle, of fabric of stretch stiffness `stretch` (N per m) and
    /// Poisson ratio `poisson`. Of two the larger one: where fabric stretches much, softer fabric opens again.
    ///
    /// # Errors
    /// If no B of the table's reach makes that angle.
    pub fn bending_stiffness(&self, stretch: f64, poisson: f64) -> Result<f64, BenchFault> {
        let Self { hinge, pressure, inflated } = *self;
        let w = hinge.width;
        let [least_tau, .., most_tau] = arms::TAUS;
        // B = Y (W tau)^2, and 1/eps = p W^3 / B is 100 at least and p W / Y = tau^2 / eps.
        let [thinnest, thickest] =
            [least_tau * libm::exp(-arms::SLACK), most_tau].map(|tau| stretch * (w * tau).powi(2));
        let highest = thickest.min(pressure * w.powi(3) / arms::LEAST_BENDABILITY);
        let lowest = thinnest.max(pressure * w.powi(3) / arms::MOST_BENDABILITY);
        // Values at the table's edge are left out.
        let (lowest, highest) = (1.001 * lowest, 0.999 * highest);
        if lowest.is_nan() || lowest >= highest || pressure * w / stretch > STRETCH[1] {
            return Err(BenchFault::Beyond);
        }
        let excess =
            |log_b: f64| self.predicted(libm::exp(log_b), stretch, poisson).map(|angle| angle - inflated);
        let place =
            |k: u32| libm::log(highest) + f64::from(k) / f64::from(PLACES) * libm::log(lowest / highest);
        let mut previous = excess(place(0))?;
        let mut range = [previous, previous];
        for k in 1..=PLACES {
            let current = excess(place(k))?;
            if previous * current <= 0.0 {
                let root = bracketed_root(place(k - 1), place(k), TOLERANCE, excess)?;
                return Ok(libm::exp(root));
            }
            range = [range[0].min(current), range[1].max(current)];
            previous = current;
        }
        Err(BenchFault::Angle(inflated, range.map(|excess| inflated + excess)))
    }
}

impl DiscBench {
    /// Stretch stiffness Y (N per m) with which the disc is so wide, of fabric of bending stiffness `bending` (N m) and Poisson
    /// ratio `poisson`.
    ///
    /// # Errors
    /// If no Y makes it so wide.
    pub fn stretch_stiffness(&self, bending: f64, poisson: f64) -> Result<f64, BenchFault> {
        let (w, part) = (self.flat / 2.0, self.inflated / self.flat);
        let excess = |log_stretch: f64| -> Result<f64, BenchFault> {
            let stretch = self.pressure * w / libm::exp(log_stretch);
            Ok(self.part(bending, stretch, poisson)? - part)
        };
        let [lowest, highest] = STRETCH.map(libm::log);
        let [narrow, wide] = [excess(lowest)?, excess(highest)?];
        if narrow > 0.0 || wide < 0.0 {
            return Err(BenchFault::Disc(part, [part + narrow, part + wide]));
        }
        let root = bracketed_root(lowest, highest, TOLERANCE, excess)?;
        Ok(self.pressure * w / libm::exp(root))
    }

    /// Inflated over flat width.
    fn part(&self, bending: f64, stretch: f64, poisson: f64) -> Result<f64, BenchFault> {
        let w = self.flat / 2.0;
        let tau = (bending / stretch).sqrt() / w;
        let section = Section::by_ratios(self.pressure * w.powi(3) / bending, tau, poisson).slack();
        let [width, _] = section.disc().map_err(StarFault::from)?;
        Ok(width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_3;

    fn vee(inflated: f64) -> VBench {
        let hinge = Hinge { r_star: 0.1, width: 0.02, rest_angle: FRAC_PI_3 };
        VBench { hinge, pressure: 14e3, inflated }
    }

    #[test]
    fn the_angle_that_a_fabric_makes_gives_its_bending_stiffness_back() {
        let (b, y, nu) = (3.4e-4, 38_400.0_f64, 0.39);
        let section = Section::by_ratios(14e3 * 8e-6 / b, (b / y).sqrt() / 0.02, nu);
        let bench = vee(0.0);
        let rest = section.target(0.1).expect("in range");
        let stiffness = vee(bench.hinge.angle_of(&section, &rest)).bending_stiffness(y, nu).expect("found");
        assert!((stiffness / b - 1.0).abs() < 1e-4, "{stiffness}");
    }

    #[test]
    fn a_disc_that_does_not_stretch_is_the_published_balloon_and_one_that_does_gives_its_stiffness_back() {
        let disc = DiscBench { flat: 0.1, inflated: 0.0, pressure: 10e3 };
        // The part of Paulsen's balloon is 1 / int_0^1 dx / sqrt(1 - x^4), 0.76276.
        let stiff = disc.part(1e-5, 1e9, 0.39).expect("solved");
        assert!((stiff - 0.762_76).abs() < 2e-4, "{stiff}");
        let inflated = 0.1 * disc.part(3.4e-4, 20_000.0, 0.39).expect("solved");
        let stiffness = DiscBench { inflated, ..disc }.stretch_stiffness(3.4e-4, 0.39).expect("found");
        assert!((stiffness / 20_000.0 - 1.0).abs() < 1e-3, "{stiffness}");
    }

    #[test]
    fn no_hinge_of_any_model_closes_below_the_least_angle() {
        assert!((least_angle(58.7_f64.to_radians()).to_degrees() + 6.7).abs() < 0.1);
        for rest_angle in [10.0_f64, 60.0, 120.0, 175.0].map(f64::to_radians) {
            let least_angle_rad = least_angle(rest_angle);
            for r_star in [0.0, 0.02, 0.15, 1.0] {
                let hinge = Hinge { r_star, width: 0.02, rest_angle };
                let rest = ring::Ring.target(r_star).expect("in range");
                assert!(hinge.angle_of(&ring::Ring, &rest) > least_angle_rad, "{hinge:?}");
                for tau in [1.5e-3, 3.162e-3, 9.935e-3] {
                    for bendability in [100.0, 630.0, 1e4_f64.min(0.1 / (tau * tau))] {
                        let section = Section::by_ratios(bendability, tau, 0.39);
                        let Ok(rest) = section.target(r_star) else { continue };
                        assert!(
                            hinge.angle_of(&section, &rest) > least_angle_rad,
                            "{hinge:?} {tau} {bendability}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn what_no_fabric_does_is_refused_with_what_fabrics_do() {
        let fault = vee(1.0).bending_stiffness(38_400.0, 0.39).expect_err("too wide");
        assert!(matches!(fault, BenchFault::Angle(_, [low, high]) if low < high && high < 1.0), "{fault}");
        let disc = DiscBench { flat: 0.1, inflated: 0.06, pressure: 10e3 };
        let fault = disc.stretch_stiffness(3.4e-4, 0.39).expect_err("too narrow");
        assert!(matches!(fault, BenchFault::Disc(_, [low, high]) if low < 0.78 && high > low), "{fault}");
        let slow = VBench { pressure: 10.0, ..vee(0.7) };
        assert_eq!(slow.bending_stiffness(38_400.0, 0.39), Err(BenchFault::Beyond));
    }
}
