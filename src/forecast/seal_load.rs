//! The load that pressure puts on the seal, against what the seal holds.
//!
//! At the inner edge of a hinge the fabric pulls with **k**(R*) p W on the seal, R* = R / W with the radius that the band
//! really makes; k is that of the membrane ring at its target, and grows like 1/R* for sharp hinges. A straight tube
//! pulls with p W / pi. Both are those of fabric that does not stretch: conservative where a sharp corner would yield.

use crate::design::StarDesign;
use crate::forecast::case::Case;
use crate::mechanics::hinge::ring::Ring;
use crate::mechanics::hinge::{HingeModel, seal_load};
use crate::mechanics::strength::burst_pressure;
use crate::units::{Length, LineForce, Pressure, Readable};
use std::f64::consts::FRAC_1_PI;
use std::fmt;

/// Roundest hinge that is advised, R*: rounder than ten widths no hinge is a hinge, and k is within 4 % of its limit.
const ROUNDEST: f64 = 10.0;
/// Sharpest hinge that is looked at, R*: there k is 1e5, more than any seal holds.
const SHARPEST: f64 = 1e-6;

/// k at R* = `r_star`, by the exact `ring` or its table; `None` outside their range.
pub fn factor(ring: &dyn HingeModel, r_star: f64) -> Option<f64> {
    ring.target(r_star).ok().and_then(|state| seal_load(r_star, &state))
}

/// Pressure (Pa) at which the seal peels at its sharpest hinge; `None` without a peel strength.
pub fn burst(case: &Case, ring: &dyn HingeModel) -> Option<f64> {
    let (peel, width) = (case.peel?, case.mechanism.width);
    let sharpest = case.realised.tip.min(case.realised.corner);
    factor(ring, sharpest / width).map(|k| burst_pressure(peel, width, k))
}

/// The least inner radius of a hinge at which its seal holds the pressure, rounded up to a hundredth of a mm so that
/// what is printed holds; `None` if no hinge is round enough, or pressure or peel strength are not known.
pub fn safe_radius(case: &Case) -> Option<Length> {
    let width = case.mechanism.width;
    let allowed = case.peel? / (case.pressure? * width);
    let (mut low, mut high) = (SHARPEST, ROUNDEST);
    if factor(&Ring, high)? > allowed {
        return None;
    }
    // k falls with R*. Each round halves the ratio's logarithm: after 60 the ends differ by rounding.
    for _ in 0..60 {
        let middle = f64::sqrt(low * high);
        if factor(&Ring, middle)? > allowed { low = middle } else { high = middle }
    }
    let hundredths = (Length::from_metres(high * width).0 * 100.0).ceil();
    Some(Length(hundredths / 100.0))
}

/// What is to be done about a hinge that bursts.
pub fn remedy(safe: Option<Length>) -> String {
    match safe {
        Some(radius) => format!("a radius of {radius} would hold"),
        None => "no radius would hold: less pressure, a narrower tube or a stronger seal".to_owned(),
    }
}

/// The load at one kind of place of a star's seal.
#[derive(Clone, Debug, PartialEq)]
pub struct SealLoad {
    /// Where.
    pub place: &'static str,
    /// The radius that the band makes; `None` on straight parts.
    pub radius: Option<Length>,
    /// Load over p W; `None` if the ring has no solution there.
    pub factor: Option<f64>,
    /// Force per length at the pressure of `[load]`; `None` without one.
    pub load: Option<LineForce>,
    /// Pressure at which the peel strength is reached; `None` without a `seal_strength`.
    pub burst: Option<Pressure>,
    /// Burst pressure over the pressure of `[load]`.
    pub margin: Option<f64>,
    /// The radius from which the margin is 1, where it is less and a radius helps.
    pub safe_radius: Option<Length>,
}

/// The loads at tips, corners, arms and inlet of `part`, whose case is `case`.
pub fn seal_loads(case: &Case, part: &StarDesign) -> Vec<SealLoad> {
    let width = case.mechanism.width;
    let channel = part.channel.map(|channel| Length(2.0 * channel.half_width).metres());
    let places = [
        ("tips", Some(case.realised.tip), Some(width)),
        ("corners", Some(case.realised.corner), Some(width)),
        ("arms", None, Some(width)),
        ("inlet", None, channel),
    ];
    let with_width = places.into_iter().filter_map(|(place, radius, width)| Some((place, radius, width?)));
    with_width.map(|(place, radius, width)| at_place(case, place, radius, width)).collect()
}

fn at_place(case: &Case, place: &'static str, radius: Option<f64>, width: f64) -> SealLoad {
    let factor = radius.map_or(Some(FRAC_1_PI), |radius| factor(&Ring, radius / width));
    let burst = factor.zip(case.peel).map(|(k, peel)| burst_pressure(peel, width, k));
    let margin = burst.zip(case.pressure).map(|(burst, p)| burst / p);
    let weak = margin.is_some_and(|margin| margin < 1.0) && radius.is_some();
    let load = factor.zip(case.pressure).map(|(k, p)| k * p * width);
    SealLoad {
        place,
        radius: radius.map(Length::from_metres),
        factor,
        load: load.map(LineForce::from_newtons_per_metre),
        burst: burst.map(Pressure::from_pascals),
        margin,
        safe_radius: if weak { safe_radius(case) } else { None },
    }
}

impl SealLoad {
    /// What is to be warned of, if anything.
    pub fn weakness(&self) -> Option<String> {
        let margin = self.margin.filter(|margin| *margin < 1.0)?;
        let remedy = match self.radius {
            Some(_) => remedy(self.safe_radius),
            None => "less pressure, a narrower tube or a stronger seal".to_owned(),
        };
        Some(format!("burst margin {:.2} at the {}; {remedy}", rounded_down(margin), self.place))
    }
}

/// A margin in hundredths, never shown as larger than it is.
fn rounded_down(margin: f64) -> f64 {
    (margin * 100.0).floor() / 100.0
}

impl fmt::Display for SealLoad {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "load at the {}: ", self.place)?;
        match self.factor {
            Some(factor) => write!(f, "{factor:.3} p W")?,
            None => write!(f, "unknown")?,
        }
        if let Some(radius) = self.radius {
            write!(f, " (radius {} mm)", Readable((radius.0 * 1000.0).round() / 1000.0))?;
        }
        if let Some(load) = self.load {
            write!(f, ", {:.3} N/mm", load.0)?;
        }
        if let Some(burst) = self.burst {
            write!(f, ", bursts at {:.1} kPa", burst.0)?;
        }
        if let Some(margin) = self.margin {
            write!(f, ", margin {:.2}", rounded_down(margin))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Star;
    use crate::spec::{Load, Source, Spec, StarSpec, read, starter};

    /// The paper's star with a seal of 1 N/mm.
    fn spec(kilopascals: f64) -> Spec {
        let mut spec = read(&Source::new("x", starter("x").expect("a name"))).expect("valid").spec;
        spec.fabric.seal_strength = Some(LineForce(1.0));
        let pressure = Some(Pressure(kilopascals));
        spec.load = Some(Load { pressure, ..Load::default() });
        spec
    }

    fn case(spec: &Spec) -> Case {
        Case::of(spec, &Star::new(&spec.stars[0]).expect("makeable")).expect("valid")
    }

    /// The digits are those that `cargo test --lib seal_loads_meet_the_table -- --nocapture` computes with 30 of them, by
    /// means that share nothing with the solver.
    #[test]
    fn the_ring_gives_the_loads_of_the_reference() {
        let known = [
            (1e-3, 116.675_389_518_699),
            (1.0 / 30.0, 3.805_316_595_082),
            (0.1, 1.478_853_797_965),
            (0.2, 0.897_775_795_927),
            (0.5, 0.549_695_025_461),
            (1.0, 0.433_905_868_948),
            (10.0, 0.329_862_118_570),
        ];
        for (r_star, k) in known {
            let found = factor(&Ring, r_star).expect("in range");
            assert!((found / k - 1.0).abs() < 1e-11, "{r_star}: {found}");
        }
    }

    #[test]
    fn the_radius_that_is_printed_holds() {
        for tenths in (90..1000).step_by(7) {
            let mut spec = spec(f64::from(tenths) * 0.1);
            let Some(safe) = safe_radius(&case(&spec)) else { continue };
            let text = remedy(Some(safe));
            let printed = text.split(' ').find_map(|word| word.parse::<f64>().ok()).expect("a number");
            spec.stars[0] = StarSpec {
                tip_radius: Length(printed),
                corner_radius: Length(printed),
                ..spec.stars[0].clone()
            };
            let Ok(star) = Star::new(&spec.stars[0]) else { continue };
            let round = Case::of(&spec, &star).expect("valid");
            let margin = burst(&round, &Ring).expect("known") / round.pressure.expect("given");
            assert!(margin >= 1.0 && (printed <= 1.0 || margin < 1.02), "{printed} mm: {margin}");
        }
    }

    #[test]
    fn beyond_a_straight_tube_no_radius_helps() {
        assert!(safe_radius(&case(&spec(100.0))).is_some());
        assert_eq!(safe_radius(&case(&spec(104.0))), None);
        assert!(remedy(None).contains("no radius"));
    }

    #[test]
    fn a_margin_below_one_never_reads_as_one() {
        assert_eq!(rounded_down(0.9999), 0.99);
        assert_eq!(rounded_down(1.0), 1.0);
    }
}
