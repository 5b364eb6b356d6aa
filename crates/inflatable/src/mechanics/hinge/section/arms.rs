//! Effect of arms on a hinge: the angle by which it coils further, and the loss of stiffness.
//!
//! At the two mouths of a hinge hoop compression is let out into the arms, so between arms it coils to `alpha = lambda
//! alpha_0 + delta tanh(alpha_0 / 45 deg)`, with delta the **arms' angle**; and their compliance, the **arms' give** g, is that of g more
//! hinge, `C = p W^3 |V_bar''| / (alpha_0 + g)`. There are no formulas for delta and g: they were taken from V-actuators
//! with arms of 4 W, computed as shells (longer arms are more compliant, with the same coiling).
//!
//! Both depend on the flat arc alpha_0, on 1/eps, on `tau = t / [W sqrt(12 (1 - nu^2))]`, so that `p W / Y = tau^2 / eps`, and on R*. The grid
//! is regular in ln tau, in `ln(R* + 0.03)` and, from [`LEAST_BENDABILITY`] to where p W / Y is 0.1, in ln(1/eps); its arcs are [`ARCS`].
//! A hinge of more arc has the delta and g of the largest arc, its two mouths being apart; one of less arc, those of the least.

use crate::mechanics::hinge::Arms;
use std::f64::consts::FRAC_PI_4;
use std::sync::LazyLock;

/// Flat arcs of the grid, deg.
pub const ARCS: [f64; 3] = [120.0, 60.0, 30.0];
/// tau of the grid: from t/W = 0.01 at nu = 0.39 to 0.03 at nu = 0.49. From the first on stretch ends the pressures, not 1/eps.
pub const TAUS: [f64; 3] = [3.162e-3, 5.604e-3, 9.935e-3];
/// Distance beyond the first tau at which the table is still read, in logarithms: so that t/W = 0.01 at nu = 0.39 is inside.
pub const SLACK: f64 = 0.01;
/// R* of the grid.
pub const R_STARS: [f64; 6] = [0.0, 0.02, 0.06, 0.15, 0.4, 1.0];
/// Pressures of the grid.
pub const PRESSURES: usize = 6;
/// Least 1/eps.
pub const LEAST_BENDABILITY: f64 = 100.0;
/// Largest 1/eps.
pub const MOST_BENDABILITY: f64 = 1e4;
/// Largest p W / Y.
const MOST_STRETCH: f64 = 0.1;
/// Offset of R* before its logarithm is taken.
const SHARP: f64 = 0.03;
/// nu of the grid; others enter by tau and by lambda.
pub const POISSON: f64 = 0.39;

/// The grid's values, as they are shipped.
const SHIPPED: &str = include_str!("arms.txt");

/// Logarithms of the grid's tau and R*.
static LOGARITHMS: LazyLock<([f64; TAUS.len()], [f64; R_STARS.len()])> =
    LazyLock::new(|| (TAUS.map(libm::log), R_STARS.map(|r| libm::log(r + SHARP))));

/// Effect of arms on hinges of any arc: delta and g, rad, at each of [`ARCS`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmsByArc([[f64; 2]; ARCS.len()]);

impl ArmsByArc {
    /// The effect on a hinge with the flat arc `arc`, rad.
    pub fn at(&self, arc: f64) -> Arms {
        let [most, .., least] = ARCS;
        let place = arc.to_degrees().clamp(least, most);
        // The grid's arcs fall.
        let weights = weights(&ARCS.map(|arc| -arc), -place, 0.0).unwrap_or([f64::NAN; ARCS.len()]);
        let mut sum = [0.0; 2];
        for (weight, values) in weights.iter().zip(&self.0) {
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
        let [delta, give] = sum;
        Arms { angle: delta * libm::tanh(arc / FRAC_PI_4), give }
    }
}

/// 1/eps of the grid at one tau: regular in its logarithm.
pub fn bendabilities(tau: f64) -> [f64; PRESSURES] {
    let most = most_bendability(tau);
    #[expect(clippy::cast_precision_loss, reason = "a handful of pressures")]
    std::array::from_fn(|k| {
        LEAST_BENDABILITY * libm::pow(most / LEAST_BENDABILITY, k as f64 / (PRESSURES - 1) as f64)
    })
}

fn most_bendability(tau: f64) -> f64 {
    (MOST_STRETCH / (tau * tau)).min(MOST_BENDABILITY)
}

/// The arms of hinges at 1/eps = `bendability`, tau and R*; `None` outside of the table.
pub fn arms(bendability: f64, tau: f64, r_star: f64) -> Option<ArmsByArc> {
    static TABLE: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| read(SHIPPED).unwrap_or_default());
    let one_arc = TAUS.len() * R_STARS.len() * PRESSURES;
    if TABLE.len() != ARCS.len() * one_arc {
        return None;
    }
    let (taus, r_stars) = &*LOGARITHMS;
    let along_tau = weights(taus, libm::log(tau), SLACK)?;
    let along_r = weights(r_stars, libm::log(r_star + SHARP), 0.0)?;
    let up =
        libm::log(bendability / LEAST_BENDABILITY) / libm::log(most_bendability(tau) / LEAST_BENDABILITY);
    #[expect(clippy::cast_precision_loss, reason = "a handful of pressures")]
    let places: [f64; PRESSURES] = std::array::from_fn(|k| k as f64 / (PRESSURES - 1) as f64);
    let along_b = weights(&places, up, 0.0)?;
    let mut all = [[0.0; 2]; ARCS.len()];
    for (i, a) in along_tau.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
        for (j, b) in along_r.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
            for (k, c) in along_b.iter().enumerate() {
                for (arc, sum) in all.iter_mut().enumerate() {
                    let point = &TABLE[arc * one_arc + (i * R_STARS.len() + j) * PRESSURES + k];
                    sum.iter_mut().zip(point).for_each(|(sum, value)| *sum += a * b * c * value);
                }
            }
        }
    }
    Some(ArmsByArc(all))
}

/// Reads the lines of a table: phi_0, tau, R*, 1/eps, then in deg delta, its mesh error, g and its mesh error; returns delta and g.
fn read(text: &str) -> Option<Vec<[f64; 2]>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let numbers = lines.map(|line| {
        let words: Option<Vec<f64>> = line.split_whitespace().map(|word| word.parse().ok()).collect();
        let [_, _, _, _, delta, _, give, _] = words?[..] else { return None };
        Some([delta, give].map(f64::to_radians))
    });
    numbers.collect()
}

/// The weights of the places in the cubic through the four around `x`, or in the parabola through all three; `None` where `x` is
/// more than `slack` before the first or beyond the last.
fn weights<const N: usize>(places: &[f64; N], x: f64, slack: f64) -> Option<[f64; N]> {
    // A value at an end within rounding, also that of a text with three decimals, is inside.
    let rounding = 1e-6 * (places[N - 1] - places[0]);
    if !(places[0] - slack - rounding..=places[N - 1] + rounding).contains(&x) {
        return None;
    }
    let count = N.min(4);
    let first = places.iter().filter(|place| **place <= x).count().saturating_sub(2).min(N - count);
    let chosen = first..first + count;
    let factor = |i: usize| {
        let others = chosen.clone().filter(move |j| *j != i);
        others.map(|j| (x - places[j]) / (places[i] - places[j])).product::<f64>()
    };
    let weight = |i: usize| if chosen.contains(&i) { factor(i) } else { 0.0 };
    Some(std::array::from_fn(weight))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sha2::{Digest, Sha256};

    #[test]
    fn the_shipped_table_is_whole_and_on_its_grid() {
        let body: String =
            SHIPPED.lines().filter(|line| !line.starts_with('#')).flat_map(|line| [line, "\n"]).collect();
        let hash = Sha256::digest(body.as_bytes())
            .iter()
            .fold(String::new(), |text, byte| text + &format!("{byte:02x}"));
        assert!(SHIPPED.contains(&hash), "{hash}");
        let mut lines = body.lines();
        for arc in ARCS {
            for (tau, r_star) in TAUS.into_iter().flat_map(|tau| R_STARS.map(|r_star| (tau, r_star))) {
                for b in bendabilities(tau) {
                    let words: Vec<f64> = (lines.next().expect("a line").split(' '))
                        .map(|word| word.parse().expect("a number"))
                        .collect();
                    assert_eq!((180.0 - words[0], words[1], words[2]), (arc, tau, r_star));
                    assert!((words[3] / b - 1.0).abs() < 1e-5);
                    let arms = arms(b, tau, r_star).expect("on the grid").at(arc.to_radians());
                    let delta = arms.angle.to_degrees() / (arc / 45.0).tanh();
                    assert!((delta - words[4]).abs() < 2e-3, "{arms:?} {words:?}");
                    assert!((arms.give.to_degrees() - words[6]).abs() < 1e-2, "{arms:?} {words:?}");
                }
            }
        }
        assert_eq!(lines.next(), None);
    }

    #[test]
    fn it_ends_where_it_ends() {
        let tau = 4e-3;
        assert!(arms(100.0, tau, 0.0).is_some() && arms(6250.0, tau, 1.0).is_some());
        for (b, tau, r_star) in [
            (99.0, tau, 0.1),
            (6260.0, tau, 0.1),
            (500.0, 3.12e-3, 0.1),
            (500.0, 0.01, 0.1),
            (500.0, tau, 1.01),
        ] {
            assert_eq!(arms(b, tau, r_star), None, "{b} {tau} {r_star}");
        }
        assert_eq!(arms(f64::NAN, tau, 0.1), None);
        assert_eq!(arms(500.0, f64::NAN, 0.1), None);
    }

    #[test]
    fn it_leads_on_from_place_to_place() {
        // The table is continuous between the grid's places, and arms always let a hinge coil further.
        let mut before: Option<Arms> = None;
        for step in 0..=400 {
            let part = f64::from(step) / 400.0;
            let tau = TAUS[0] * (TAUS[2] / TAUS[0]).powf(part);
            let arms = arms(300.0 + 600.0 * part, tau, part * part).expect("inside").at(2.6 - 2.2 * part);
            assert!(arms.angle > 0.0 && arms.give > -0.2, "{part}: {arms:?}");
            if let Some(before) = before {
                assert!((arms.angle - before.angle).abs() < 0.005, "{part}: {before:?} {arms:?}");
                assert!((arms.give - before.give).abs() < 0.03, "{part}: {before:?} {arms:?}");
            }
            before = Some(arms);
        }
    }
}
