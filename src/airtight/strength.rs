//! The load that pressure puts on the seal, against what the seal holds.
//!
//! At the inner edge of a hinge the fabric pulls with k(R*) p W on the seal, R* = R / W with the radius that the band
//! really makes; k is that of the membrane ring at its target, and grows like 1/R* for sharp hinges. A straight tube
//! pulls with p W / pi. Both are those of fabric that does not stretch: conservative where a sharp corner would yield.

use std::f64::consts::PI;
use std::fmt;

use crate::design::StarDesign;
use crate::mechanics::hinge::ring::Ring;
use crate::mechanics::hinge::{HingeModel, seal_load};
use crate::spec::Spec;
use crate::units::Readable;

/// The load at one kind of place of a star's seal.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Where.
    pub place: &'static str,
    /// The radius that the band makes, mm; `None` on straight parts.
    pub radius: Option<f64>,
    /// Load over p W; `None` if the ring has no solution there.
    pub factor: Option<f64>,
    /// Force per length at the pressure of `[load]`, N/mm; `None` without one.
    pub load: Option<f64>,
    /// Pressure at which the peel strength is reached, kPa; `None` without a `seal_strength`.
    pub burst: Option<f64>,
    /// Burst pressure over the pressure of `[load]`.
    pub margin: Option<f64>,
    /// The radius at which the margin would be 1, mm, where it is less and a radius helps.
    pub safe_radius: Option<f64>,
}

/// k(R*) of the ring at its target; `None` outside its range.
fn ring_factor(r_star: f64) -> Option<f64> {
    Ring.target(r_star).ok().and_then(|state| seal_load(r_star, &state))
}

/// The loads at tips, corners, arms and inlet of one star.
pub fn seal_loads(spec: &Spec, part: &StarDesign) -> Vec<Load> {
    let w = part.star.w;
    let mut places = vec![
        ("tips", Some(part.realised_tip().radius), w),
        ("corners", Some(part.realised_corner().radius), w),
        ("arms", None, w),
    ];
    if let Some(channel) = part.channel {
        places.push(("inlet", None, 2.0 * channel.half_width));
    }
    places.into_iter().map(|(place, radius, width)| load(spec, place, radius, width)).collect()
}

fn load(spec: &Spec, place: &'static str, radius: Option<f64>, width: f64) -> Load {
    let factor = radius.map_or(Some(1.0 / PI), |radius| ring_factor(radius / width));
    let pressure = spec.load.as_ref().and_then(|load| load.pressure).map(|pressure| pressure.0);
    let strength = spec.fabric.seal_strength.map(|strength| strength.0);
    // kPa mm is N/m.
    let load = factor.zip(pressure).map(|(k, p)| k * p * width * 1e-3);
    let burst = factor.zip(strength).map(|(k, t)| t / (k * width * 1e-3));
    let margin = burst.zip(pressure).map(|(burst, p)| burst / p);
    let safe_radius = match (radius, margin, strength, pressure) {
        (Some(radius), Some(margin), Some(t), Some(p)) if margin < 1.0 => {
            safe_radius(radius / width, t / (p * width * 1e-3)).map(|r_star| r_star * width)
        }
        _ => None,
    };
    Load { place, radius, factor, load, burst, margin, safe_radius }
}

/// R* above `from` at which k is `wanted`; `None` if no hinge is round enough, k being above 1/pi.
fn safe_radius(from: f64, wanted: f64) -> Option<f64> {
    // Rounder than ten widths no hinge is a hinge.
    let (mut low, mut high) = (from, 10.0);
    if ring_factor(high)? > wanted {
        return None;
    }
    // Forty halvings of ten widths: far below a micrometre.
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if ring_factor(middle)? > wanted { low = middle } else { high = middle }
    }
    Some(high)
}

impl Load {
    /// What is to be warned of, if anything.
    pub fn weakness(&self) -> Option<String> {
        let margin = self.margin.filter(|margin| *margin < 1.0)?;
        let remedy = match (self.safe_radius, self.radius) {
            (Some(radius), _) => format!("; a radius of {radius:.1} mm would hold"),
            (None, Some(_)) => {
                "; no radius would hold: less pressure, a narrower tube or a stronger seal".to_owned()
            }
            (None, None) => "; less pressure, a narrower tube or a stronger seal".to_owned(),
        };
        Some(format!("burst margin {margin:.2} at the {}{remedy}", self.place))
    }
}

impl fmt::Display for Load {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "load at the {}: ", self.place)?;
        match self.factor {
            Some(factor) => write!(f, "{factor:.3} p W")?,
            None => write!(f, "unknown")?,
        }
        if let Some(radius) = self.radius {
            write!(f, " (radius {} mm)", Readable((radius * 1e3).round() / 1e3))?;
        }
        if let Some(load) = self.load {
            write!(f, ", {load:.3} N/mm")?;
        }
        if let Some(burst) = self.burst {
            write!(f, ", bursts at {burst:.1} kPa")?;
        }
        if let Some(margin) = self.margin {
            write!(f, ", margin {margin:.2}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_gives_the_known_loads() {
        for (r_star, k) in [(0.1, 1.479), (0.2, 0.898), (0.5, 0.550)] {
            let found = ring_factor(r_star).expect("in range");
            assert!((found - k).abs() < 2e-3, "{r_star}: {found}");
        }
        let sharp = ring_factor(1.0 / 30.0).expect("in range");
        assert!((sharp - 3.8).abs() < 0.06, "{sharp}");
    }

    #[test]
    fn a_safe_radius_is_just_safe() {
        let safe = safe_radius(0.03, 1.0).expect("reachable");
        assert!((ring_factor(safe).expect("in range") - 1.0).abs() < 1e-6);
        assert_eq!(safe_radius(0.03, 0.3), None);
    }
}
